// SPDX-License-Identifier: BSD-3-Clause
#include "pose/objective/DepthFit.h"

#include "pose/PoseTolerances.h"
#include "pose/verification/PoseEvidence.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
// Shares of the diameter
constexpr double OffPose = 0.003;        // by which a pose and the samples of its part are not exact
constexpr double IndependentSide = 0.08; // side of the squares that tell something of their own each: pose errors and
                                         // other bodies are alike over so much
constexpr float SplatReach = 0.007f;     // from a surface sample to the points about it: half of the least spacing
constexpr float LayerDepth = 0.01f;      // of the nearest surface in a cell, that its mean is taken of
constexpr float FlattestCell = 0.4f;     // cosine towards the sensor: flatter surface is measured badly
constexpr float FacingAtAll = 0.05f;     // the same: flatter surface is out of sight
constexpr double MostOfCell = 3.0;       // nats: more is of another body, or at a rim
constexpr double MostOfRotation = 6.0;   // nats: what the model leaves out is trusted no more than 400 to 1
constexpr int SplatPoints = 5;           // the sample and one to each side
}

DepthFit::DepthFit(const Scene& scene, const TrainedModel& model)
  : InScene(scene)
  , Model(model)
  , Deviation(static_cast<float>(std::hypot(scene.quality.smoothing * scene.quality.noise, OffPose * model.diameter)))
  , Near(static_cast<float>(UnexplainedDistance * model.diameter))
{
}

bool DepthFit::tells(const Scene& scene, const TrainedModel& model)
{
  return scene.quality.isKnown() && haveSurfaces(scene, model);
}

const DepthFit::Rendered::Cell& DepthFit::Rendered::at(int column, int row) const
{
  static const Cell nothing;
  const int x = column - this->left, y = row - this->top;
  const bool isInside = x >= 0 && y >= 0 && x < this->width && y < this->height;
  return isInside ? this->cells[static_cast<std::size_t>(y) * this->width + x] : nothing;
}

DepthFit::Rendered DepthFit::render(const Eigen::Isometry3d& T_scene_model) const
{
  const FineDepth& depth = this->InScene.fineDepth;
  const PointCloud& surface = this->Model.surface;
  const auto diameter = static_cast<float>(this->Model.diameter);
  const Eigen::Vector3f towards = this->Model.visibility->towards(T_scene_model, this->InScene.sensor);
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  std::vector<int> facing;
  std::vector<float> cosines; // of these samples
  for (std::size_t k = 0; k < surface.size(); ++k)
  {
    const float cosine = surface.normals[k].dot(towards);
    if (cosine >= FacingAtAll)
    {
      facing.push_back(static_cast<int>(k));
      cosines.push_back(cosine);
    }
  }
  SoAPoints splats;
  splats.resize(SplatPoints * facing.size());
  for (std::size_t k = 0; k < facing.size(); ++k)
  {
    // Along axes of the scene, so that two poses leave the same cells between splats empty.
    const Eigen::Vector3f point = T * surface.points[facing[k]], normal = T.linear() * surface.normals[facing[k]];
    const Eigen::Vector3f x = SplatReach * diameter * normal.unitOrthogonal(), y = normal.cross(x);
    const Eigen::Vector3f splat[SplatPoints] = { point, point + x, point - x, point + y, point - y };
    for (int i = 0; i < SplatPoints; ++i)
    {
      splats.set(SplatPoints * k + i, splat[i]);
    }
  }
  struct Point
  {
    int column, row;
    float depth, cosine;
  };
  std::vector<Point> points;
  points.reserve(splats.size());
  int left = depth.columns(), right = -1, top = depth.rows(), bottom = -1;
  DepthGrid::Places places;
  const int count = static_cast<int>(splats.size());
  for (int begin = 0; begin < count; begin += SoABlock)
  {
    const int size = std::min(SoABlock, count - begin);
    depth.findPlaces(Eigen::Isometry3f::Identity(), splats, begin, size, places);
    for (int k = 0; k < size; ++k)
    {
      if (places.cells[k] < depth.cellCount())
      {
        const int column = places.cells[k] % depth.columns(), row = places.cells[k] / depth.columns();
        points.push_back({ column, row, places.depths[k], cosines[(begin + k) / SplatPoints] });
        left = std::min(left, column);
        right = std::max(right, column);
        top = std::min(top, row);
        bottom = std::max(bottom, row);
      }
    }
  }
  if (points.empty())
  {
    return {};
  }
  Rendered rendered{ left, top, right - left + 1, bottom - top + 1, {} };
  rendered.cells.resize(static_cast<std::size_t>(rendered.width) * rendered.height);
  const auto indexOf = [&](const Point& point)
  { return static_cast<std::size_t>(point.row - top) * rendered.width + (point.column - left); };
  std::vector<float> nearest(rendered.cells.size(), std::numeric_limits<float>::max());
  for (const Point& point : points)
  {
    float& first = nearest[indexOf(point)];
    first = std::min(first, point.depth);
  }
  const float layer = LayerDepth * diameter;
  for (const Point& point : points)
  {
    if (point.depth < nearest[indexOf(point)] + layer)
    {
      Rendered::Cell& cell = rendered.cells[indexOf(point)];
      cell.depth += point.depth;
      cell.cosine += point.cosine;
      ++cell.count;
    }
  }
  for (Rendered::Cell& cell : rendered.cells)
  {
    const float share = 1.0f / static_cast<float>(std::max(cell.count, 1));
    cell.depth *= share;
    cell.cosine *= share;
  }
  return rendered;
}

double DepthFit::logOdds(const Rendered& a, const Rendered& b) const
{
  const FineDepth& depth = this->InScene.fineDepth;
  const int right = std::max(a.left + a.width, b.left + b.width), bottom = std::max(a.top + a.height, b.top + b.height);
  double sum = 0.0;
  for (int row = std::min(a.top, b.top); row < bottom; ++row)
  {
    for (int column = std::min(a.left, b.left); column < right; ++column)
    {
      const Rendered::Cell &ofA = a.at(column, row), &ofB = b.at(column, row);
      const auto isFlat = [](const Rendered::Cell& cell) { return cell.count > 0 && cell.cosine < FlattestCell; };
      if ((ofA.count == 0 && ofB.count == 0) || isFlat(ofA) || isFlat(ofB))
      {
        continue;
      }
      const float measured = depth.depthIn(column, row);
      if (std::isnan(measured))
      {
        continue;
      }
      const float behindA = (measured - ofA.depth) * ofA.cosine, behindB = (measured - ofB.depth) * ofB.cosine;
      sum += this->lossOf(ofB, behindB, behindA) - this->lossOf(ofA, behindA, behindB);
    }
  }
  const ScanQuality& quality = this->InScene.quality;
  const double side = std::max(IndependentSide * this->Model.diameter, quality.smoothing * quality.pointDistance);
  const double share = depth.cellSize() / side;
  return std::clamp(share * share * sum, -MostOfRotation, MostOfRotation);
}

/// Negative log likelihood of the depth in a cell. `behind`: mm, of what was measured there behind the part,
/// `behindOther`: behind the part at the other pose.
double DepthFit::lossOf(const Rendered::Cell& cell, float behind, float behindOther) const
{
  if (cell.count == 0) // another body, beside the part
  {
    return behindOther > this->Near ? 0.0 : MostOfCell; // which lies by chance where the other pose has its surface
  }
  const float deviations = behind / this->Deviation;
  return std::abs(behind) > this->Near ? MostOfCell : std::min(MostOfCell, 0.5 * deviations * deviations);
}
}
