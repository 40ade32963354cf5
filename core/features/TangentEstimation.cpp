// SPDX-License-Identifier: BSD-3-Clause
#include "features/TangentEstimation.h"

#include "base/AllVectors.h"
#include "base/Frames.h"
#include "base/Parallel.h"
#include "base/PointGrid.h"
#include "base/sequences/Quantiles.h"
#include "base/sequences/Sequences.h"
#include "model/AppearanceModel.h"
#include "scene/Units.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>

namespace meam
{
namespace
{
constexpr double SceneLeafShare = 0.03;  // of the diameter, in a scene,
constexpr double ModelLeafShare = 0.02;  // and in a model, whose points are exact
constexpr double RadiusShare = 0.06;     // of the diameter, and no less than a segment needs; of measured points more:
constexpr double RadiusInliers = 4.0;    // times the inlier distance,
constexpr double RadiusSpacings = 3.0;   // and times the spacing of the points,
constexpr double MostRadiusShare = 0.12; // of the diameter, at most
constexpr double InlierShare = 0.012;    // of the diameter; of measured points more:
constexpr double InlierNoise = 2.2;      // standard deviations of their noise,
constexpr double MostInlierShare = 0.03; // of the diameter, at most
constexpr double CandidateShare = 0.3;   // of the radius: lines are tried through one point in each cube of this side
constexpr int FewestInliers = 4;         // of a line: one through three points of a band of edge points is chance
constexpr int MeasuredPoints = 400;      // around so many noise and spacing are measured,
constexpr int FewestForNoise = 12;       // noise where there are so many neighbours
constexpr double NoiseQuantile = 0.25;   // of their distances from a plane: more where edges are curved or planes many
constexpr double SegmentShare = 0.15;    // of the diameter
constexpr double SegmentReach = 1.25;    // lengths of a segment, the radius at least: its ends have to see all of it
constexpr double SegmentGap = 0.2;       // of that length: a longer gap ends a segment

constexpr int Lanes = 8; // offsets that are looked at together

float squaredDistanceToLine(const Eigen::Vector3f& offset, const Eigen::Vector3f& direction)
{
  return offset.cross(direction).squaredNorm();
}

/// Neighbours of a point, relative to it, coordinate by coordinate, with room for `Lanes` more.
class Neighbours
{
public:
  int size() const { return this->Count; }
  const float* x() const { return this->Offsets.x.data(); }
  const float* y() const { return this->Offsets.y.data(); }
  const float* z() const { return this->Offsets.z.data(); }
  Eigen::Vector3f at(int k) const { return this->Offsets[k]; }

  void gather(const PointGrid& grid, const Eigen::Vector3f& centre, double radius)
  {
    const float limit = static_cast<float>(radius) * static_cast<float>(radius);
    this->Count = 0;
    grid.forEachRange(centre, radius,
      [&](int begin, int end)
      {
        const std::size_t most = static_cast<std::size_t>(this->Count) + end - begin + Lanes;
        if (this->Offsets.size() < most)
        {
          this->Offsets.resize(2 * most);
        }
        for (int k = begin; k < end; ++k)
        {
          // Without a branch: half of them would be predicted wrongly.
          const Eigen::Vector3f offset = grid.sorted()[k] - centre;
          this->Offsets.set(this->Count, offset);
          this->Count += offset.squaredNorm() <= limit ? 1 : 0;
        }
      });
  }

private:
  SoAPoints Offsets;
  int Count = 0;
};

/// How many of the offsets lie within sqrt(limit) of the line through the origin.
MEAM_ALL_VECTORS
int lineSupport(const float* x, const float* y, const float* z, int count, const Eigen::Vector3f& line, float limit)
{
  const float lx = line.x(), ly = line.y(), lz = line.z();
  int support = 0;
#pragma omp simd reduction(+ : support)
  for (int k = 0; k < count; ++k)
  {
    const float cx = y[k] * lz - z[k] * ly, cy = z[k] * lx - x[k] * lz, cz = x[k] * ly - y[k] * lx;
    support += cx * cx + cy * cy + cz * cz <= limit ? 1 : 0;
  }
  return support;
}

constexpr int Moments = 10; // their number, sums of x, y and z, of xx, xy, xz, yy, yz and zz

/// Adds up those of the offsets within sqrt(limit) of the line through the origin.
MEAM_ALL_VECTORS
void addMoments(const float* x, const float* y, const float* z, int count, const Eigen::Vector3f& line, float limit,
  double (*moments)[Lanes])
{
  const float lx = line.x(), ly = line.y(), lz = line.z();
  double sums[Moments][Lanes] = {};
  float shares[Lanes];
  for (int begin = 0; begin < count; begin += Lanes)
  {
#pragma omp simd
    for (int lane = 0; lane < Lanes; ++lane)
    {
      const int k = begin + lane;
      const float cx = y[k] * lz - z[k] * ly, cy = z[k] * lx - x[k] * lz, cz = x[k] * ly - y[k] * lx;
      shares[lane] = (k < count) & (cx * cx + cy * cy + cz * cz <= limit) ? 1.0f : 0.0f;
    }
#pragma omp simd
    for (int lane = 0; lane < Lanes; ++lane)
    {
      const int k = begin + lane;
      const double share = shares[lane];
      const double dx = share * x[k], dy = share * y[k], dz = share * z[k];
      sums[0][lane] += share;
      sums[1][lane] += dx;
      sums[2][lane] += dy;
      sums[3][lane] += dz;
      sums[4][lane] += dx * dx;
      sums[5][lane] += dx * dy;
      sums[6][lane] += dx * dz;
      sums[7][lane] += dy * dy;
      sums[8][lane] += dy * dz;
      sums[9][lane] += dz * dz;
    }
  }
  for (int i = 0; i < Moments; ++i)
  {
    std::copy_n(sums[i], Lanes, moments[i]);
  }
}

/// Principal axis of the offsets near a line, zero when they have no extent.
Eigen::Vector3f principalAxis(const Neighbours& offsets, const Eigen::Vector3f& line, float limit)
{
  double lanes[Moments][Lanes];
  addMoments(offsets.x(), offsets.y(), offsets.z(), offsets.size(), line, limit, lanes);
  double m[Moments];
  for (int i = 0; i < Moments; ++i)
  {
    m[i] = std::accumulate(lanes[i], lanes[i] + Lanes, 0.0);
  }
  // Offsets are small, so sums about the origin lose nothing.
  const Eigen::Vector3d sum(m[1], m[2], m[3]);
  Eigen::Matrix3d products;
  products << m[4], m[5], m[6], m[5], m[7], m[8], m[6], m[8], m[9];
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(products - sum * sum.transpose() / m[0]);
  return solver.eigenvalues()[2] > 0.0 ? solver.eigenvectors().col(2).cast<float>().eval() : Eigen::Vector3f::Zero();
}

/// Tangent at a point from its neighbours' offsets; zero when no line is supported. Lines through the point and some of
/// its neighbours are tried, as in Algorithm 2; the sphere makes the neighbourhood the same wherever the point lies,
/// and the inliers' axis uses all of them instead of one far point.
Eigen::Vector3f robustLine(
  const Neighbours& offsets, const Neighbours& candidates, double inlierDistance, int fewestInliers)
{
  const float limit = static_cast<float>(inlierDistance * inlierDistance);
  int best = 0;
  float farthest = 0.0f;
  Eigen::Vector3f direction = Eigen::Vector3f::Zero();
  for (int k = 0; k < candidates.size(); ++k)
  {
    const Eigen::Vector3f candidate = candidates.at(k);
    const float length = candidate.norm();
    if (length <= static_cast<float>(inlierDistance))
    {
      continue;
    }
    const Eigen::Vector3f line = candidate / length;
    const int support = lineSupport(offsets.x(), offsets.y(), offsets.z(), offsets.size(), line, limit);
    if (support > best || (support == best && length > farthest))
    {
      best = support;
      farthest = length;
      direction = line;
    }
  }
  return best < fewestInliers ? Eigen::Vector3f::Zero() : principalAxis(offsets, direction, limit);
}

/// Whether a point lies in a run of its neighbours along a line, with gaps of at most `gap`, that is `length` long.
bool isOnSegment(
  const Neighbours& offsets, const Eigen::Vector3f& line, double inlierDistance, double length, double gap)
{
  const float limit = static_cast<float>(inlierDistance * inlierDistance);
  std::vector<float> places{ 0.0f };
  for (int k = 0; k < offsets.size(); ++k)
  {
    if (squaredDistanceToLine(offsets.at(k), line) <= limit)
    {
      places.push_back(offsets.at(k).dot(line));
    }
  }
  std::sort(places.begin(), places.end());
  auto first = std::lower_bound(places.begin(), places.end(), 0.0f), last = first;
  while (first != places.begin() && *first - *(first - 1) <= gap)
  {
    --first;
  }
  while (last + 1 != places.end() && *(last + 1) - *last <= gap)
  {
    ++last;
  }
  return *last - *first >= length;
}

/// What the edge points themselves say of how they were measured, mm.
struct PointStatistics
{
  double noise = 0.0;   ///< standard deviation of a coordinate
  double spacing = 0.0; ///< median distance of a point to its nearest
};

/// Lines that meet mostly lie in a plane: the points' distances from it are noise. Where they are curved or there are
/// several planes these are larger, so a low quantile counts.
PointStatistics statisticsOf(const Points& edges, const std::vector<int>& kept, const PointGrid& grid, double radius,
  const TangentEstimationSettings& settings)
{
  const int stride = static_cast<int>(kept.size()) / MeasuredPoints + 1;
  const int count = (static_cast<int>(kept.size()) + stride - 1) / stride;
  constexpr double unknown = -1.0; // a mark
  std::vector<double> deviations(count, unknown), distances(count, unknown);
  parallelFor(count, settings.threads, {},
    [&](int begin, int end, int)
    {
      Neighbours offsets;
      for (int k = begin; k < end; ++k)
      {
        offsets.gather(grid, edges[kept[k * stride]], radius);
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
        double nearest = std::numeric_limits<double>::infinity();
        for (int i = 0; i < offsets.size(); ++i)
        {
          const Eigen::Vector3d d = offsets.at(i).cast<double>();
          sum += d;
          products += d * d.transpose();
          nearest = d.isZero() ? nearest : std::min(nearest, d.norm());
        }
        if (std::isfinite(nearest))
        {
          distances[k] = nearest;
        }
        const double size = offsets.size();
        if (size >= FewestForNoise)
        {
          Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
          solver.computeDirect(products - sum * sum.transpose() / size, Eigen::EigenvaluesOnly);
          deviations[k] = std::sqrt(std::max(0.0, solver.eigenvalues()[0]) / (size - 3.0));
        }
      }
    });
  const auto known = [&](std::vector<double>& values)
  { values.erase(std::remove(values.begin(), values.end(), unknown), values.end()); };
  known(deviations);
  known(distances);
  return { quantileOf(deviations, NoiseQuantile), quantileOf(distances, 0.5) };
}

/// Tangents at the points `kept`, by lines through points of `ends`; with the length of a `segment`, 0 for none, of
/// those that lie on one. `grid` is of all points; cells of both are of `radius`, that of the settings or the part.
/// Lengths of the settings that are 0 follow the points, too.
Points robustTangents(const Points& edges, const std::vector<int>& kept, const PointGrid& grid, const PointGrid& ends,
  double radius, double segment, double partDiameter, const TangentEstimationSettings& settings,
  const Progress& progress)
{
  double inlierDistance = settings.inlierDistance > 0.0 ? settings.inlierDistance : InlierShare * partDiameter;
  if (settings.followsNoise && (settings.radius <= 0.0 || settings.inlierDistance <= 0.0))
  {
    const PointStatistics statistics = statisticsOf(edges, kept, grid, radius, settings);
    if (settings.inlierDistance <= 0.0)
    {
      inlierDistance =
        std::clamp(InlierNoise * statistics.noise, InlierShare * partDiameter, MostInlierShare * partDiameter);
    }
    if (settings.radius <= 0.0)
    {
      const double wanted = std::max(RadiusInliers * inlierDistance, RadiusSpacings * statistics.spacing);
      radius = std::max(radius, std::min(wanted, MostRadiusShare * partDiameter));
    }
  }
  Points tangents(kept.size());
  parallelFor(static_cast<int>(kept.size()), settings.threads, progress,
    [&](int begin, int end, int)
    {
      Neighbours offsets, candidates;
      for (int i = begin; i < end; ++i)
      {
        const Eigen::Vector3f& centre = edges[kept[i]];
        offsets.gather(grid, centre, radius);
        candidates.gather(ends, centre, radius);
        tangents[i] = robustLine(offsets, candidates, inlierDistance, FewestInliers);
        if (segment > 0.0 && !isOnSegment(offsets, tangents[i], inlierDistance, segment, SegmentGap * segment))
        {
          tangents[i].setZero();
        }
      }
    });
  return tangents;
}

/// Algorithms 1 and 2 of the paper, on the points that are kept.
Points tileTangents(const Points& points, const Eigen::Vector3d& viewDirection,
  const TangentEstimationSettings& settings, const Progress& progress)
{
  // The projection plane: that of x and y for a view along z, as in the paper.
  constexpr double along = 0.999; // cosine, 1 but for rounding
  const bool alongZ = std::abs(viewDirection.z()) > along;
  const Eigen::Matrix3f frame = frameAround(viewDirection.cast<float>());
  const Eigen::Vector3f right = alongZ ? Eigen::Vector3f::UnitX().eval() : frame.col(1).eval();
  const Eigen::Vector3f down = alongZ ? Eigen::Vector3f::UnitY().eval() : frame.col(2).eval();
  const double tile = settings.tilePixels * settings.pixelSize;
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<int>> tiles;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    tiles[{ static_cast<std::int64_t>(std::floor(points[i].dot(right) / tile)),
            static_cast<std::int64_t>(std::floor(points[i].dot(down) / tile)) }]
      .push_back(static_cast<int>(i));
  }
  Points tangents(points.size(), Eigen::Vector3f::Zero());
  const float limit = static_cast<float>(settings.lineDistance * settings.lineDistance);
  constexpr std::size_t mostPerTile = 4000; // the work grows with its cube
  std::size_t done = 0;
  for (const auto& [place, members] : tiles)
  {
    if (members.size() > mostPerTile)
    {
      throw Error("A tile holds " + std::to_string(members.size()) +
                  " edge points, each pair of which makes a line to try: use smaller tiles or a larger leaf size.");
    }
    for (const int j : members)
    {
      report(progress, static_cast<double>(done++) / points.size());
      std::size_t best = 0;
      Eigen::Vector3f direction = Eigen::Vector3f::Zero();
      for (const int k : members)
      {
        const Eigen::Vector3f line = (points[k] - points[j]).normalized();
        if (k == j || !line.allFinite() || line.isZero())
        {
          continue;
        }
        const std::size_t score = std::count_if(members.begin(), members.end(),
          [&](int m) { return squaredDistanceToLine(points[m] - points[j], line) < limit; });
        if (score > best)
        {
          best = score;
          direction = line;
        }
      }
      if (best > settings.lineSupport * members.size())
      {
        tangents[j] = direction;
      }
    }
  }
  return tangents;
}
}

TangentEstimationSettings paperTangentSettings()
{
  TangentEstimationSettings settings;
  settings.method = TangentMethod::Tiles;
  settings.leafSize = 1.0;
  return settings;
}

namespace
{
/// What stays of the points `local`, in the frame in which they are thinned and all of them finite: indices, tangents
/// in that frame, weights. `given` are tangents that they have already, or none. `tiles` gives the tangents at points
/// by Algorithms 1 and 2.
struct LocalTangents
{
  std::vector<int> points;
  Points tangents;
  std::vector<float> weights;
};
LocalTangents estimate(const Points& local, const Points& given, double partDiameter, double leafShare,
  const std::function<Points(const std::vector<int>&)>& tiles, const TangentEstimationSettings& settings,
  const Progress& progress)
{
  const bool robust = settings.method != TangentMethod::Tiles && given.empty();
  const auto length = [&](double value, double share)
  {
    if (value != 0.0)
    {
      return value;
    }
    if (!(partDiameter > 0.0))
    {
      throw Error("The part's diameter is not known, so lengths cannot follow it: connect the part's model, or give "
                  "the leaf size, radius and inlier distance in mm.");
    }
    return share * partDiameter;
  };
  const double leaf = length(settings.leafSize, leafShare);
  double radius = 0.0, segment = 0.0;
  ThinnedPoints kept;
  PointGrid grid, ends; // of all points, and of those that lines are tried through
  std::vector<std::function<void()>> works{ [&] { kept = thinWithWeights(local, leaf); } };
  if (robust)
  {
    radius = length(std::max(0.0, settings.radius), RadiusShare);
    if (settings.method == TangentMethod::LineSegments)
    {
      segment = length(std::max(0.0, settings.segmentLength), SegmentShare);
      radius = std::max(radius, SegmentReach * segment);
    }
    length(settings.inlierDistance, InlierShare);
    works.push_back(
      [&]
      {
        const auto sparse =
          mapped<Eigen::Vector3f>(thinPoints(local, CandidateShare * radius), [&](const int i) { return local[i]; });
        ends = PointGrid(sparse, radius);
      });
    works.push_back([&] { grid = PointGrid(local, radius); });
  }
  inParallel(settings.threads, works);
  Points tangents;
  if (robust)
  {
    tangents = robustTangents(local, kept.indices, grid, ends, radius, segment, partDiameter, settings, progress);
  }
  else if (given.empty())
  {
    tangents = tiles(kept.indices);
  }
  else
  {
    for (const int i : kept.indices)
    {
      tangents.push_back(given[i]);
    }
  }
  LocalTangents found;
  for (std::size_t k = 0; k < tangents.size(); ++k)
  {
    if (tangents[k].allFinite() && !tangents[k].isZero())
    {
      found.points.push_back(kept.indices[k]);
      found.tangents.push_back(tangents[k]);
      found.weights.push_back(kept.weights[k]);
    }
  }
  report(progress, 1.0);
  return found;
}
}

ThinnedEdges estimateTangents(const LocalCloud& edges, double partDiameter, const Eigen::Vector3d& viewDirection,
  const TangentEstimationSettings& settings, const Progress& progress)
{
  const PointCloud& all = edges.cloud;
  requirePoints(all.points, "The scene's edge cloud");
  if (partDiameter > 0.0)
  {
    requireSameUnits(all.points, partDiameter);
  }
  std::vector<int> finite;
  finite.reserve(all.size());
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (all.points[i].allFinite())
    {
      finite.push_back(static_cast<int>(i));
    }
  }
  const PointCloud local = finite.size() < all.size() ? all.subset(finite) : all;
  const auto tiles = [&](const std::vector<int>& kept)
  {
    // The paper's plane is that of the scene's own coordinates.
    const Eigen::Isometry3d T_scene_local = edges.T_local_scene.inverse();
    Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
    turn.linear() = edges.T_local_scene.linear();
    return moved(
      tileTangents(moved(local.subset(kept).points, T_scene_local), viewDirection, settings, progress), turn);
  };
  LocalTangents found = estimate(local.points, local.tangents, partDiameter, SceneLeafShare, tiles, settings, progress);
  ThinnedEdges result;
  result.edges.T_local_scene = edges.T_local_scene;
  result.edges.fromScan = edges.fromScan;
  result.edges.cloud.points.reserve(found.points.size());
  for (const int k : found.points)
  {
    result.indices.push_back(finite[k]);
    result.edges.cloud.points.push_back(local.points[k]);
  }
  result.edges.cloud.tangents = std::move(found.tangents);
  result.edges.cloud.weights = std::move(found.weights);
  return result;
}

std::vector<AppearanceModel> estimateTangents(std::vector<AppearanceModel> models, double partDiameter,
  const TangentEstimationSettings& settings, const Progress& progress)
{
  const double share = 1.0 / static_cast<double>(models.size());
  TangentEstimationSettings exact = settings;
  exact.followsNoise = false;
  for (std::size_t v = 0; v < models.size(); ++v)
  {
    requirePoints(models[v].cloud.points, "The edge cloud");
    const Progress ofView = subProgress(progress, share * v, share * (v + 1));
    const PointCloud cloud = finitePoints(std::move(models[v].cloud));
    const auto tiles = [&](const std::vector<int>& kept)
    { return tileTangents(cloud.subset(kept).points, models[v].direction.cast<double>(), exact, ofView); };
    // In the part frame, so that views share the cubes.
    LocalTangents found = estimate(cloud.points, cloud.tangents, partDiameter, ModelLeafShare, tiles, exact, ofView);
    models[v].cloud = cloud.subset(found.points); // without weights: a view that sees a point, sees it
    models[v].cloud.tangents = std::move(found.tangents);
  }
  return models;
}
}
