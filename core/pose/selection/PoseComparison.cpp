// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/PoseComparison.h"

#include "pose/PoseTolerances.h"

#include <algorithm>

namespace meam
{
namespace
{
// In measured surface points, which count 1
constexpr double OfEdge = 3.0;    // a scene edge point that one of the two alone explains: images have fewer edges
constexpr double OfHidden = 0.5;  // times that, by an edge that the part itself hides: what is visible is not exact
constexpr double OfPast = 2.25;   // a predicted surface point that the sensor saw past: sparser than measured ones
constexpr double OfMissing = 1.0; // a predicted edge point on measured surface without an edge: images lose edges
}

PoseComparison::PoseComparison(const Scene& scene, const TrainedModel& model, const PoseComparisonSettings& settings)
  : InScene(scene)
  , Model(model)
  , Settings(settings)
  , Explained(static_cast<float>(ExplainedDistance * model.diameter))
  , Unexplained(static_cast<float>(UnexplainedDistance * model.diameter))
{
}

PoseComparison::Fit PoseComparison::explained(const Eigen::Isometry3d& T_scene_model) const
{
  const DistanceField& surface = this->Model.surfaceDistance;
  const float far = this->Unexplained;
  const auto near = static_cast<float>(0.5 * FieldCell * this->Model.diameter);
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  const Eigen::Isometry3f toModel = T_scene_model.inverse().cast<float>();
  const PointGrid& measured = this->InScene.surface;
  Fit explained;
  measured.forEachBlock(T * surface.middle(), surface.radius() + far,
    [&](int begin, int count)
    {
      float distances[SoABlock];
      surface.at(toModel, measured.sorted(), begin, count, distances);
      for (int k = 0; k < count; ++k)
      {
        explained.byDistance += std::max(0.0f, 1.0f - distances[k] / far);
        explained.lying += std::clamp((far - distances[k]) / (far - near), 0.0f, 1.0f);
      }
    });
  return explained;
}

void PoseComparison::predict(Contender& one) const
{
  const TrainedModel& model = this->Model;
  const float far = this->Unexplained;
  const Eigen::Isometry3f T = one.T_scene_model.cast<float>();
  one.visible = model.visibility->visible(one.T_scene_model, this->InScene.sensor, this->InScene.depth.pitch());
  const PredictedVisibility::Visible& visible = *one.visible;
  std::vector<DepthMap::Relation> relations;
  const auto those = [&](const SoAPoints& points, DepthMap::Relation wanted)
  {
    const int count = static_cast<int>(points.size());
    relations.resize(points.size());
    this->InScene.depth.relations(T, points, 0, count, far, relations.data());
    SoAPoints found;
    for (int k = 0; k < count; ++k)
    {
      if (relations[k] == wanted)
      {
        found.add(points[k]);
      }
    }
    return found;
  };
  SoAPoints surface;
  surface.resize(this->Settings.freeSpace ? visible.surface.size() : 0);
  for (std::size_t k = 0; k < surface.size(); ++k)
  {
    surface.set(k, model.surface.points[visible.surface[k]]);
  }
  one.predicted = { those(surface, DepthMap::Relation::InFront),
    those(visible.edges.points, DepthMap::Relation::OnSurface) };
}

PoseComparison::Contender PoseComparison::contender(const Eigen::Isometry3d& T_scene_model) const
{
  Contender one{ T_scene_model, this->explained(T_scene_model), nullptr, {} };
  this->predict(one);
  return one;
}

double PoseComparison::contradicted(const Contender& one, const Contender& other) const
{
  const TrainedModel& model = this->Model;
  const float far = this->Unexplained;
  const float alone = this->Settings.sameVisibility ? far : 0.0f; // so far from what the other predicts
  const Eigen::Isometry3f T = one.T_scene_model.cast<float>();
  const Eigen::Isometry3f toOther = (other.T_scene_model.inverse() * one.T_scene_model).cast<float>(); // part to part
  std::vector<float> distances; // to what the other predicts
  const auto lookUp = [&](const SoAPoints& points, const DistanceField& field)
  {
    distances.resize(points.size());
    field.at(toOther, points, 0, static_cast<int>(points.size()), distances.data());
  };
  double sum = 0.0;
  lookUp(one.predicted.passed, model.surfaceDistance);
  for (const float distance : distances)
  {
    sum += distance >= alone ? OfPast : 0.0;
  }
  const SoAPoints& edges = one.predicted.edges;
  lookUp(edges, model.edgeDistance);
  for (std::size_t k = 0; k < edges.size(); ++k)
  {
    sum += distances[k] >= alone && this->InScene.edgeGrid().nearest(T * edges[k], far) < 0 ? OfMissing : 0.0;
  }
  return sum;
}

double PoseComparison::advantage(const Contender& one, const Contender& other) const
{
  return this->advantageElsewhere(one, other, &Fit::byDistance) + this->advantageByEdges(one, other) -
         this->contradicted(one, other);
}

double PoseComparison::advantage(const Eigen::Isometry3d& T_scene_model, const Contender& other, double enough) const
{
  return this->advantageOfOne(T_scene_model, other, enough, &Fit::byDistance);
}

double PoseComparison::advantageOfTurn(
  const Eigen::Isometry3d& T_scene_model, const Contender& other, double enough) const
{
  return this->advantageOfOne(T_scene_model, other, enough, &Fit::lying);
}

double PoseComparison::advantageOfOne(
  const Eigen::Isometry3d& T_scene_model, const Contender& other, double enough, double Fit::*kind) const
{
  Contender one{ T_scene_model, this->explained(T_scene_model), nullptr, {} };
  const double elsewhere = this->advantageElsewhere(one, other, kind);
  const double most = elsewhere + this->advantageByEdges(one, other);
  if (most < enough)
  {
    return most;
  }
  this->predict(one);
  return elsewhere + this->advantageByEdges(one, other) - this->contradicted(one, other);
}

double PoseComparison::advantageElsewhere(const Contender& one, const Contender& other, double Fit::*kind) const
{
  return one.explained.*kind - other.explained.*kind + this->contradicted(other, one);
}

double PoseComparison::advantageByEdges(const Contender& one, const Contender& other) const
{
  const TrainedModel& model = this->Model;
  const float far = this->Unexplained;
  const float near = this->Explained;
  const Eigen::Isometry3d& a = one.T_scene_model;
  const Eigen::Isometry3d& b = other.T_scene_model;
  const Eigen::Isometry3f toA = a.inverse().cast<float>();
  const Eigen::Isometry3f toB = b.inverse().cast<float>();
  const DistanceField& surface = model.surfaceDistance;
  const DistanceField& edges = model.edgeDistance;
  const DistanceField& whole = model.surface.empty() ? edges : surface;
  // Every edge near one of the two.
  const Eigen::Vector3f middleA = a.cast<float>() * whole.middle();
  const Eigen::Vector3f middleB = b.cast<float>() * whole.middle();
  const Eigen::Vector3f between = 0.5f * (middleA + middleB);
  // What a scene edge counts that an edge of the part explains.
  const auto ofEdge = [&](const Contender& pose, const Eigen::Vector3f& inModel)
  {
    const bool isVisible = !pose.visible || pose.visible->edgeGrid().nearest(inModel, near) >= 0;
    return isVisible ? OfEdge : OfHidden * OfEdge;
  };
  const PointGrid& measured = this->InScene.edgeGrid();
  double sum = 0.0;
  measured.forEachBlock(between, whole.radius() + near + (middleA - between).norm(),
    [&](int begin, int count)
    {
      const SoAPoints& points = measured.sorted();
      float ofA[SoABlock], ofB[SoABlock];
      edges.at(toA, points, begin, count, ofA);
      edges.at(toB, points, begin, count, ofB);
      for (int k = 0; k < count; ++k)
      {
        const bool byA = ofA[k] < near && ofB[k] >= far, byB = ofB[k] < near && ofA[k] >= far;
        if (!byA && !byB)
        {
          continue;
        }
        const Eigen::Vector3f point = points[begin + k];
        const Eigen::Vector3f inA = toA * point, inB = toB * point;
        if (model.surface.empty() || surface.at(inA) < far || surface.at(inB) < far) // else another object's
        {
          sum += byA ? ofEdge(one, inA) : -ofEdge(other, inB);
        }
      }
    });
  return sum;
}
}
