// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/BOPEvaluation.h"

#include "base/sequences/Sequences.h"
#include "features/PCLConversion.h"
#include "mesh/ConvexHull.h"
#include "mesh/TriangleMesh.h"
#include "simulation/Rasterizer.h"

#include <Eigen/LU>

#include <pcl/kdtree/kdtree_flann.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meam
{
namespace
{
constexpr double VisibleShare = 0.1;         // of a copy that has to be found
constexpr double VisibilityTolerance = 15.0; // mm a surface may lie behind the measured one and still be visible
constexpr double SymmetryStep = 0.01;        // of the diameter: no vertex moves more between turns about an axis
constexpr double ReferenceWidth = 640;       // of the image whose pixels MSPD counts
constexpr double OffRay = 0.05;              // pixels a point of a scan may be off its ray, in the mean
constexpr double Infinity = std::numeric_limits<double>::infinity();

/// Distances (mm) of the nearest surface of a part from the camera in a part of the image, 0 where there is none.
struct Rendering
{
  int left = 0, top = 0, width = 0, height = 0;
  std::vector<float> distances;

  float at(int column, int row) const
  {
    const int u = column - this->left, v = row - this->top;
    return u < 0 || v < 0 || u >= this->width || v >= this->height
             ? 0.0f
             : this->distances[static_cast<std::size_t>(v) * this->width + u];
  }
};

Eigen::Vector2d onImage(const Eigen::Vector3d& point, const Camera& camera)
{
  return { camera.fx * point.x() / point.z() + camera.cx, camera.fy * point.y() / point.z() + camera.cy };
}

/// The whole group: turns about an axis in steps, each with and without what is left beside it. Of a ball the turns
/// about one axis: any other is asked for when two poses are compared.
std::vector<Eigen::Isometry3d> equalPoses(const Symmetries& symmetries, const Points& vertices, double diameter)
{
  std::vector<Eigen::Isometry3d> turns{ Eigen::Isometry3d::Identity() };
  if (!symmetries.continuous.empty())
  {
    const ContinuousSymmetry& symmetry = symmetries.continuous.front();
    double farthest = 0.0;
    for (const auto& vertex : vertices)
    {
      farthest = std::max(farthest, symmetry.axis.cross(vertex.cast<double>() - symmetry.point).norm());
    }
    const int steps = std::max(1, static_cast<int>(std::ceil(2.0 * M_PI * farthest / (SymmetryStep * diameter))));
    for (int k = 1; k < steps; ++k)
    {
      turns.push_back(turnAbout(symmetry.axis, 2.0 * M_PI * k / steps, symmetry.point));
    }
  }
  std::vector<Eigen::Isometry3d> group = turns;
  for (const Eigen::Isometry3d& S : symmetries.discrete)
  {
    for (const Eigen::Isometry3d& turn : turns)
    {
      group.push_back(S * turn);
    }
  }
  return group;
}
}

Camera cameraOfCloud(const OrganizedCloud& cloud)
{
  // u z = fx x + cx z for every point, and the same for v.
  Eigen::Matrix2d normalU = Eigen::Matrix2d::Zero(), normalV = Eigen::Matrix2d::Zero();
  Eigen::Vector2d rightU = Eigen::Vector2d::Zero(), rightV = Eigen::Vector2d::Zero();
  const auto forEach = [&](auto&& visit)
  {
    for (std::size_t i = 0; i < cloud.size(); ++i)
    {
      const Eigen::Vector3d p = cloud.points[i].cast<double>();
      if (p.allFinite() && p.z() > 0.0)
      {
        const std::size_t row = i / cloud.width, column = i % cloud.width;
        visit(p.x() / p.z(), p.y() / p.z(), static_cast<double>(column), static_cast<double>(row));
      }
    }
  };
  double count = 0.0;
  forEach(
    [&](double x, double y, double u, double v)
    {
      const Eigen::Vector2d a(x, 1.0), b(y, 1.0);
      normalU += a * a.transpose();
      normalV += b * b.transpose();
      rightU += u * a;
      rightV += v * b;
      ++count;
    });
  const Eigen::Vector2d U = normalU.ldlt().solve(rightU), V = normalV.ldlt().solve(rightV);
  Camera camera;
  camera.width = cloud.width;
  camera.height = cloud.height;
  camera.fx = U.x();
  camera.cx = U.y();
  camera.fy = V.x();
  camera.cy = V.y();
  double off = 0.0;
  forEach([&](double x, double y, double u, double v)
    { off += std::hypot(camera.fx * x + camera.cx - u, camera.fy * y + camera.cy - v); });
  if (!(count >= 4.0 && camera.fx > 0.0 && camera.fy > 0.0 && off / count < OffRay))
  {
    throw Error(
      "The scan's points are not on the rays of a pinhole camera, one for each pixel: give the organized cloud "
      "in the frame of the camera that took it.");
  }
  return camera;
}

struct BOPEvaluation::Impl
{
  TriangleMesh mesh;
  double diameter;
  Symmetries symmetries;
  std::vector<Eigen::Isometry3d> equal; ///< the identity first
  Eigen::Vector3d middle;               ///< of the vertices
  double radius;                        ///< mm, of the vertices about it
  pcl::KdTreeFLANN<pcl::PointXYZ> vertices;

  double add(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const
  {
    const auto apart = [&](const Eigen::Vector3f& vertex)
    { return (a * vertex.cast<double>() - b * vertex.cast<double>()).norm(); };
    return sumOf(this->mesh.vertices, apart) / this->mesh.vertices.size();
  }

  double adi(const Eigen::Isometry3d& estimate, const Eigen::Isometry3d& truth) const
  {
    const Eigen::Isometry3f toEstimate = (estimate.inverse() * truth).cast<float>();
    double sum = 0.0;
    pcl::Indices nearest(1);
    std::vector<float> squared(1);
    for (const auto& vertex : this->mesh.vertices)
    {
      const Eigen::Vector3f p = toEstimate * vertex;
      this->vertices.nearestKSearch(pcl::PointXYZ(p.x(), p.y(), p.z()), 1, nearest, squared);
      sum += std::sqrt(squared[0]);
    }
    return sum / this->mesh.vertices.size();
  }

  /// Least over the symmetries of the largest of distance(estimate, true) over the vertices.
  template <typename Distance>
  double largest(const Eigen::Isometry3d& estimate, const Eigen::Isometry3d& truth, Distance&& distance) const
  {
    double least = Infinity;
    const auto ask = [&](const Eigen::Isometry3d& equalTruth)
    {
      double most = 0.0;
      for (std::size_t i = 0; i < this->mesh.vertices.size() && most < least; ++i)
      {
        const Eigen::Vector3d vertex = this->mesh.vertices[i].cast<double>();
        most = std::max(most, distance(estimate * vertex, equalTruth * vertex));
      }
      least = std::min(least, most);
    };
    for (const Eigen::Isometry3d& S : this->equal)
    {
      ask(truth * S);
    }
    if (!this->symmetries.continuous.empty())
    {
      ask(nearestEqual(truth, estimate, this->symmetries));
    }
    return least;
  }

  double mssd(const Eigen::Isometry3d& estimate, const Eigen::Isometry3d& truth) const
  {
    return this->largest(
      estimate, truth, [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return (a - b).norm(); });
  }

  /// False when no vertex of one is within `reach` (mm) of a vertex of the other.
  bool mayBeWithin(double reach, const Eigen::Isometry3d& estimate, const Eigen::Isometry3d& truth) const
  {
    return (estimate * this->middle - truth * this->middle).norm() < 2.0 * this->radius + reach;
  }

  double mspd(const Eigen::Isometry3d& estimate, const Eigen::Isometry3d& truth, const Camera& camera) const
  {
    return this->largest(estimate, truth,
      [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b)
      { return a.z() > 0.0 && b.z() > 0.0 ? (onImage(a, camera) - onImage(b, camera)).norm() : Infinity; });
  }

  Rendering render(const Eigen::Isometry3d& T, const Camera& camera) const
  {
    Rendering result;
    std::vector<Eigen::Vector3d> points;
    std::vector<Eigen::Vector2d> pixels;
    Eigen::AlignedBox2d box;
    for (const auto& vertex : this->mesh.vertices)
    {
      points.push_back(T * vertex.cast<double>());
      pixels.push_back(onImage(points.back(), camera));
      if (!(points.back().z() > 0.0))
      {
        return result; // not in front of the camera
      }
      box.extend(pixels.back());
    }
    const Eigen::Vector2d low = box.min().cwiseMax(Eigen::Vector2d::Zero());
    const Eigen::Vector2d high = box.max().cwiseMin(Eigen::Vector2d(camera.width - 1.0, camera.height - 1.0));
    if (!((high - low).minCoeff() >= 0.0))
    {
      return result;
    }
    result.left = static_cast<int>(low.x());
    result.top = static_cast<int>(low.y());
    result.width = static_cast<int>(high.x()) - result.left + 1;
    result.height = static_cast<int>(high.y()) - result.top + 1;
    result.distances.assign(static_cast<std::size_t>(result.width) * result.height, 0.0f);
    const Eigen::Vector2d corner(result.left, result.top);
    for (const auto& t : this->mesh.triangles)
    {
      const Eigen::Vector3d inverse(1.0 / points[t[0]].z(), 1.0 / points[t[1]].z(), 1.0 / points[t[2]].z());
      forEachPixel({ pixels[t[0]] - corner, pixels[t[1]] - corner, pixels[t[2]] - corner }, result.width, result.height,
        [&](int u, int v, const Eigen::Vector3d& weights)
        {
          const double depth = 1.0 / weights.dot(inverse); // 1 / z is linear on the image
          const Eigen::Vector3d ray(
            (u + result.left - camera.cx) / camera.fx, (v + result.top - camera.cy) / camera.fy, 1.0);
          const float distance = static_cast<float>(depth * ray.norm());
          float& nearest = result.distances[static_cast<std::size_t>(v) * result.width + u];
          nearest = nearest == 0.0f ? distance : std::min(nearest, distance);
        });
    }
    return result;
  }

  /// `measured`: distances of the scan, 0 where there is none.
  std::array<double, BOPThresholds> vsd(
    const Rendering& estimate, const Rendering& truth, const std::vector<float>& measured, const Camera& camera) const
  {
    std::array<int, BOPThresholds> wrong{};
    int both = 0, either = 0;
    const auto isVisible = [](float distance, float seen)
    { return distance > 0.0f && (seen == 0.0f || distance - seen <= static_cast<float>(VisibilityTolerance)); };
    const int left = std::min(estimate.left, truth.left), top = std::min(estimate.top, truth.top);
    const int right = std::max(estimate.left + estimate.width, truth.left + truth.width);
    const int bottom = std::max(estimate.top + estimate.height, truth.top + truth.height);
    for (int row = top; row < bottom; ++row)
    {
      for (int column = left; column < right; ++column)
      {
        const float ofEstimate = estimate.at(column, row), ofTruth = truth.at(column, row);
        const float seen = measured[static_cast<std::size_t>(row) * camera.width + column];
        const bool truthIn = isVisible(ofTruth, seen);
        const bool estimateIn = isVisible(ofEstimate, seen) || (truthIn && ofEstimate > 0.0f);
        either += truthIn || estimateIn ? 1 : 0;
        if (truthIn && estimateIn)
        {
          ++both;
          const double share = std::abs(ofEstimate - ofTruth) / this->diameter;
          for (int k = 0; k < BOPThresholds; ++k)
          {
            wrong[k] += share >= bopThreshold(k) ? 1 : 0;
          }
        }
      }
    }
    std::array<double, BOPThresholds> cost;
    for (int k = 0; k < BOPThresholds; ++k)
    {
      cost[k] = either > 0 ? static_cast<double>(wrong[k] + either - both) / either : 1.0;
    }
    return cost;
  }

  BOPErrors errors(const Eigen::Isometry3d& estimate, const Eigen::Isometry3d& truth, const Rendering& ofEstimate,
    const Rendering& ofTruth, const std::vector<float>& measured, const Camera& camera) const
  {
    BOPErrors result;
    result.add = this->add(estimate, truth);
    result.adi = this->adi(estimate, truth);
    result.mssd = this->mssd(estimate, truth);
    result.mspd = this->mspd(estimate, truth, camera);
    result.vsd = this->vsd(ofEstimate, ofTruth, measured, camera);
    return result;
  }
};

namespace
{
std::vector<float> distancesOf(const OrganizedCloud& scan)
{
  return mapped<float>(scan.points, [&](const auto& point) { return point.allFinite() ? point.norm() : 0.0f; });
}

/// Whether each true pose has to be found.
std::vector<char> targetsOf(const Poses& truths)
{
  const bool isVisibilityKnown =
    std::any_of(truths.begin(), truths.end(), [](const Pose& pose) { return pose.visibleFraction > 0.0; });
  return mapped<char>(
    truths, [&](const Pose& truth) { return !isVisibilityKnown || truth.visibleFraction >= VisibleShare ? 1 : 0; });
}

/// Of each estimate the true pose that it takes, error(e, t) < threshold, among those that may be taken; or -1.
template <typename ErrorOf>
std::vector<int> matches(int estimates, const std::vector<char>& mayBeTaken, double threshold, ErrorOf&& errorOf)
{
  std::vector<char> isFree = mayBeTaken;
  std::vector<int> matched;
  for (int e = 0; e < estimates; ++e)
  {
    int best = -1;
    double least = threshold;
    for (std::size_t t = 0; t < isFree.size(); ++t)
    {
      if (isFree[t] && errorOf(e, t) < least)
      {
        least = errorOf(e, t);
        best = static_cast<int>(t);
      }
    }
    if (best >= 0)
    {
      isFree[best] = 0;
    }
    matched.push_back(best);
  }
  return matched;
}

/// How many targets are found.
template <typename ErrorOf>
int found(int estimates, const std::vector<char>& isTarget, double threshold, ErrorOf&& errorOf)
{
  const std::vector<int> matched = matches(estimates, isTarget, threshold, errorOf);
  return static_cast<int>(std::count_if(matched.begin(), matched.end(), [](int t) { return t >= 0; }));
}
}

BOPEvaluation::BOPEvaluation(const TriangleMesh& mesh, const Symmetries& symmetries, double partDiameter)
  : Data(std::make_unique<Impl>())
{
  if (mesh.triangles.empty())
  {
    throw Error("The part has no triangles: give the mesh that the poses are of.");
  }
  // Vertices of no triangle are not of the part.
  TriangleMesh& part = this->Data->mesh;
  std::vector<int> number(mesh.vertices.size(), -1);
  for (auto t : mesh.triangles)
  {
    for (int& corner : t)
    {
      if (number[corner] < 0)
      {
        number[corner] = static_cast<int>(part.vertices.size());
        part.vertices.push_back(mesh.vertices[corner]);
      }
      corner = number[corner];
    }
    part.triangles.push_back(t);
  }
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& vertex : part.vertices)
  {
    sum += vertex.cast<double>();
  }
  this->Data->middle = sum / part.vertices.size();
  this->Data->radius = 0.0;
  for (const auto& vertex : part.vertices)
  {
    this->Data->radius = std::max(this->Data->radius, (vertex.cast<double>() - this->Data->middle).norm());
  }
  if (!sum.allFinite() || !(this->Data->radius > 0.0))
  {
    throw Error("The part's mesh has no extent, or vertices that are not finite: clean it first.");
  }
  this->Data->diameter = partDiameter > 0.0 ? partDiameter : diameter(part.vertices);
  this->Data->symmetries = symmetries;
  this->Data->equal = equalPoses(symmetries, part.vertices, this->Data->diameter);
  this->Data->vertices.setInputCloud(toPCL(part.vertices));
}

BOPEvaluation::~BOPEvaluation() = default;

BOPErrors BOPEvaluation::errors(
  const Eigen::Isometry3d& estimate, const Eigen::Isometry3d& truth, const OrganizedCloud& scan) const
{
  const Camera camera = cameraOfCloud(scan);
  return this->Data->errors(estimate, truth, this->Data->render(estimate, camera), this->Data->render(truth, camera),
    distancesOf(scan), camera);
}

BOPRecall BOPEvaluation::recall(
  const Poses& estimates, const Poses& truths, const OrganizedCloud& scan, const Progress& progress) const
{
  BOPRecall recall;
  const std::vector<char> isTarget = targetsOf(truths);
  recall.targets = static_cast<int>(std::count(isTarget.begin(), isTarget.end(), 1));
  const int count = std::min(static_cast<int>(estimates.size()), recall.targets);
  if (count == 0)
  {
    return recall;
  }
  const Camera camera = cameraOfCloud(scan);
  const std::vector<float> measured = distancesOf(scan);
  const auto renderings =
    mapped<Rendering>(truths, [&](const Pose& truth) { return this->Data->render(truth.T_scene_model, camera); });
  // So far apart no threshold of a distance is met; on the image they may still be in the same place.
  const Impl& part = *this->Data;
  const double reach = bopThreshold(BOPThresholds - 1) * part.diameter;
  BOPErrors none;
  none.add = none.adi = none.mssd = Infinity;
  none.vsd.fill(1.0);
  std::vector<std::vector<BOPErrors>> errors(count, std::vector<BOPErrors>(truths.size(), none));
  for (int e = 0; e < count; ++e)
  {
    report(progress, static_cast<double>(e) / count);
    const Eigen::Isometry3d& T = estimates[e].T_scene_model;
    const Rendering rendering = part.render(T, camera);
    for (std::size_t t = 0; t < truths.size(); ++t)
    {
      const Eigen::Isometry3d& truth = truths[t].T_scene_model;
      if (part.mayBeWithin(reach, T, truth))
      {
        errors[e][t] = part.errors(T, truth, rendering, renderings[t], measured, camera);
      }
      else
      {
        errors[e][t].mspd = part.mspd(T, truth, camera);
      }
    }
  }
  const double diameter = part.diameter;
  for (int k = 0; k < BOPThresholds; ++k)
  {
    const double threshold = bopThreshold(k);
    recall.add[k] = found(count, isTarget, threshold * diameter, [&](int e, int t) { return errors[e][t].add; });
    recall.adi[k] = found(count, isTarget, threshold * diameter, [&](int e, int t) { return errors[e][t].adi; });
    recall.mssd[k] = found(count, isTarget, threshold * diameter, [&](int e, int t) { return errors[e][t].mssd; });
    recall.mspd[k] = found(count, isTarget, 100.0 * threshold * camera.width / ReferenceWidth,
      [&](int e, int t) { return errors[e][t].mspd; });
    for (int tau = 0; tau < BOPThresholds; ++tau)
    {
      recall.vsd[k] += found(count, isTarget, threshold, [&](int e, int t) { return errors[e][t].vsd[tau]; });
    }
    recall.vsd[k] /= BOPThresholds;
  }
  return recall;
}

BOPRanking BOPEvaluation::ranking(const Poses& estimates, const Poses& truths) const
{
  const Impl& part = *this->Data;
  const double reach = bopMillimeters(BOPThresholds - 1);
  std::vector<std::vector<double>> errors(estimates.size(), std::vector<double>(truths.size(), Infinity));
  for (std::size_t e = 0; e < estimates.size(); ++e)
  {
    for (std::size_t t = 0; t < truths.size(); ++t)
    {
      const Eigen::Isometry3d &T = estimates[e].T_scene_model, &truth = truths[t].T_scene_model;
      errors[e][t] = part.mayBeWithin(reach, T, truth) ? part.mssd(T, truth) : Infinity;
    }
  }
  const std::vector<char> isTarget = targetsOf(truths), every(truths.size(), 1);
  BOPRanking ranking;
  ranking.targets = static_cast<int>(std::count(isTarget.begin(), isTarget.end(), 1));
  for (int k = 0; k < BOPThresholds; ++k)
  {
    const std::vector<int> matched = matches(
      static_cast<int>(estimates.size()), every, bopMillimeters(k), [&](int e, std::size_t t) { return errors[e][t]; });
    for (std::size_t e = 0; e < estimates.size(); ++e)
    {
      if (matched[e] < 0 || isTarget[matched[e]])
      {
        ranking.poses[k].emplace_back(probabilityOrScore(estimates[e]), matched[e] >= 0);
      }
    }
  }
  return ranking;
}

void BOPRanking::add(const BOPRanking& image)
{
  this->targets += image.targets;
  for (int k = 0; k < BOPThresholds; ++k)
  {
    this->poses[k].insert(this->poses[k].end(), image.poses[k].begin(), image.poses[k].end());
  }
}

double BOPRanking::averagePrecision() const
{
  double sum = 0.0;
  for (const Ranking& ranking : this->poses)
  {
    sum += meam::averagePrecision(ranking, this->targets);
  }
  return sum / BOPThresholds;
}
}
