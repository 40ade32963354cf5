// SPDX-License-Identifier: BSD-3-Clause
#include "pose/objective/SurfaceMisfit.h"

#include "base/sequences/Quantiles.h"
#include "pose/PoseTolerances.h"
#include "pose/verification/EvidenceCounts.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

namespace meam
{
namespace
{
constexpr float Steepest = 0.3f;     // cosine towards the sensor: flatter surface is measured badly
constexpr float OfOther = 0.5f;      // of the distance, to another surface of the part: what is nearer is that one's
constexpr int LeastCells = 3;        // of the depth map in a patch: fewer tell no average
constexpr double LeastPatches = 3.0; // so many full ones: fewer tell of a corner
constexpr double DeviationsOfMedian = 1.4826;   // standard deviations in a median absolute one, of normal noise
constexpr double VarianceOfMedian = M_PI / 2.0; // of many, against the mean's
constexpr double OfUnevenness = 2.5;            // a right pose lies off by so much of the scan's unevenness,
constexpr double OfPose = 4e-4;                 // and of the diameter, for poses and their parts' samples are not exact

constexpr double Uneven = 0.01; // of the diameter: a scan that is so uneven excuses half

constexpr double Block = 3.0;       // patches, the side of a block
constexpr double Filled = 0.6;      // of the points of the fullest patch: others are cut off,
constexpr double FilledBlock = 0.8; // and blocks with fewer than so much of
constexpr double FullBlocks = 0.25; // what these of all have: the fullest have two layers, of parts that lie on others
constexpr double FlattestBlocks = 0.1; // of the blocks, and not the single flattest one

double meanSquareOffPlane(const Points& points, double patch)
{
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3f& point : points)
  {
    mean += point.cast<double>();
  }
  mean /= static_cast<double>(points.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3f& point : points)
  {
    const Eigen::Vector3d from = point.cast<double>() - mean;
    scatter += from * from.transpose();
  }
  const Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors(); // normal first
  struct Patch
  {
    double sum = 0.0, count = 0.0;
  };
  std::map<std::pair<int, int>, Patch> patches;
  double fullest = 0.0;
  for (const Eigen::Vector3f& point : points)
  {
    const Eigen::Vector3d at = axes.transpose() * (point.cast<double>() - mean);
    Patch& one = patches[{ std::floor(at.y() / patch), std::floor(at.z() / patch) }];
    one.sum += at.x();
    fullest = std::max(fullest, ++one.count);
  }
  double sum = 0.0, count = 0.0;
  for (const auto& [place, one] : patches)
  {
    if (one.count >= Filled * fullest)
    {
      sum += one.sum * one.sum / (one.count * one.count);
      ++count;
    }
  }
  return sum / count;
}
}

double scanUnevenness(const Points& surface, const Eigen::Vector3d& towards, double patch)
{
  const Eigen::Vector3f x = towards.unitOrthogonal().cast<float>();
  const Eigen::Vector3f y = towards.cast<float>().cross(x);
  const float side = static_cast<float>(Block * patch);
  std::map<std::pair<int, int>, Points> blocks;
  for (const Eigen::Vector3f& point : surface)
  {
    blocks[{ std::floor(point.dot(x) / side), std::floor(point.dot(y) / side) }].push_back(point);
  }
  std::vector<double> sizes;
  for (const auto& [place, points] : blocks)
  {
    sizes.push_back(static_cast<double>(points.size()));
  }
  const double full = FilledBlock * quantileOf(sizes, 1.0 - FullBlocks);
  std::vector<double> squares;
  for (const auto& [place, points] : blocks)
  {
    if (static_cast<double>(points.size()) >= full)
    {
      squares.push_back(meanSquareOffPlane(points, patch));
    }
  }
  if (squares.empty())
  {
    return 0.0;
  }
  std::sort(squares.begin(), squares.end());
  const auto flattest = static_cast<std::size_t>(FlattestBlocks * static_cast<double>(squares.size()));
  return std::sqrt(squares[std::min(std::max<std::size_t>(flattest, 1), squares.size() - 1)]);
}

SurfaceMisfit::SurfaceMisfit(const Scene& scene, const TrainedModel& model)
  : InScene(scene)
  , Model(model)
{
  const double uneven =
    scanUnevenness(scene.depth.means(), scene.sensor.towards(Eigen::Vector3d::Zero()), PatchSize * model.diameter);
  this->Expected = std::hypot(OfUnevenness * uneven, OfPose * model.diameter);
  const double share = this->Expected / (Uneven * model.diameter);
  this->Excused = share * share / (1.0 + share * share);
}

double SurfaceMisfit::at(const Eigen::Isometry3d& T_scene_model) const
{
  const TrainedModel& model = this->Model;
  const DepthMap& depth = this->InScene.depth;
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  const auto visible = model.visibility->visible(T_scene_model, this->InScene.sensor, depth.pitch());
  const Eigen::Vector3f towards = T.linear() * model.visibility->towards(T_scene_model, this->InScene.sensor);
  const Eigen::Isometry3f toModel = T.inverse();
  const float most = std::min(static_cast<float>(FitDistance * model.diameter), OtherFace * model.thickness);
  const float distinct = static_cast<float>(ExplainedDistance * model.diameter);
  const float patch = static_cast<float>(PatchSize * model.diameter);
  struct Off
  {
    std::array<int, 3> patch; ///< of the part
    int cell;
    float distance; ///< mm
  };
  std::vector<Off> offs;
  for (std::size_t k = 0; k < visible->surface.size(); ++k)
  {
    const Eigen::Vector3f& inModel = model.surface.points[visible->surface[k]];
    const Eigen::Vector3f normal = T.linear() * model.surface.normals[visible->surface[k]];
    const Eigen::Vector3f point = T * inModel;
    const int cell = visible->isInner[k] && normal.dot(towards) >= Steepest ? depth.cellAt(point) : -1;
    if (cell < 0 || !depth.isMeasured(cell) || depth.normalIn(cell).dot(normal) < FacingSurface)
    {
      continue;
    }
    const float off = (depth.meanIn(cell) - point).dot(normal);
    // Beside a rim that is too thin to be measured lies another surface of the part.
    const bool isOther =
      std::abs(off) > distinct && model.surfaceDistance.at(toModel * depth.meanIn(cell)) < OfOther * std::abs(off);
    if (std::abs(off) < most && !isOther)
    {
      const Eigen::Array3i place = (inModel.array() / patch).floor().cast<int>();
      offs.push_back({ { place.x(), place.y(), place.z() }, cell, off });
    }
  }
  std::stable_sort(offs.begin(), offs.end(),
    [](const Off& a, const Off& b) { return std::tie(a.patch, a.cell) < std::tie(b.patch, b.cell); });
  double squares = 0.0, all = 0.0; // cells
  std::vector<float> inPatch;      // mm, of a cell each
  for (std::size_t first = 0; first < offs.size();)
  {
    inPatch.clear();
    std::size_t next = first;
    while (next < offs.size() && offs[next].patch == offs[first].patch)
    {
      const int cell = offs[next].cell;
      float sum = 0.0f, count = 0.0f;
      for (; next < offs.size() && offs[next].patch == offs[first].patch && offs[next].cell == cell; ++next)
      {
        sum += offs[next].distance;
        ++count;
      }
      inPatch.push_back(sum / count);
    }
    const double cells = static_cast<double>(inPatch.size());
    if (cells >= LeastCells)
    {
      // Not the mean: cells at a step of the part have some of both its sides.
      const double middle = medianOf(inPatch);
      std::transform(inPatch.begin(), inPatch.end(), inPatch.begin(),
        [middle](float distance) { return std::abs(distance - static_cast<float>(middle)); });
      const double deviation = DeviationsOfMedian * medianOf(inPatch);
      squares += cells * (middle * middle - VarianceOfMedian * deviation * deviation / cells);
      all += cells;
    }
    first = next;
  }
  return all >= LeastPatches * LeastCells ? std::sqrt(std::max(squares, 0.0) / all) : 0.0;
}
}
