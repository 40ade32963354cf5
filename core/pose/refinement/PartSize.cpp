// SPDX-License-Identifier: BSD-3-Clause
#include "pose/refinement/PartSize.h"

#include "base/Bounds.h"
#include "base/Parallel.h"
#include "pose/refinement/PoseResiduals.h"
#include "pose/refinement/SizeEquations.h"

#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

namespace meam
{
namespace
{
// Shares of the diameter
constexpr double SizeWindow = 0.03;  // from a point of the part to edge points that count
constexpr double FirstAcross = 0.02; // across tangents and surface, in the first step
constexpr double LastAcross = 0.005; // and in the last one
constexpr double HiddenBy = 0.005;   // in front of an edge: what lies there has edges of its own
constexpr int SizeSteps = 6;
constexpr int SizeStride = 2; // of the visible points one of so many
// What a thinner part has of relief and of sides is as narrow as what a sensor smooths, and its edges draw each other
// near: along an axis a pixel is so much of the length at most, and the length LeastLength at least.
constexpr double LargestPixel = 0.025;
constexpr double OfPixel = 1.0; // that an edge of the scan is off, all alike
constexpr double Stays = 1e12;  // the information, of all points, that keeps a length as it is

/// Points as on a part that is longer by `factors`, about `middle`.
SoAOrientedPoints stretched(
  const SoAOrientedPoints& columns, const Eigen::Vector3f& middle, const Eigen::Vector3f& factors, bool areNormals)
{
  const Eigen::Vector3f ofDirections = areNormals ? Eigen::Vector3f(factors.cwiseInverse()) : factors;
  SoAOrientedPoints result;
  result.resize(columns.size());
  for (std::size_t k = 0; k < columns.size(); ++k)
  {
    result.set(k, middle + factors.cwiseProduct(columns.points[k] - middle),
      ofDirections.cwiseProduct(columns.directions[k]).normalized());
  }
  return result;
}
}

PartSize measurePartSize(const Poses& poses, const Scene& scene, const TrainedModel& model, int threads)
{
  const PoseFitter fitter(scene, model);
  const Eigen::Array3d extent = bounds(model.surface.points).sizes().cast<double>();
  const Eigen::Array3d pixel = scene.depth.pitch() / extent;
  const Eigen::Array<bool, 3, 1> isTooThin = pixel > LargestPixel || extent < LeastLength * model.diameter;
  constexpr double notTold = std::numeric_limits<double>::quiet_NaN();
  if (isTooThin.all())
  {
    return { Eigen::Vector3d::Constant(notTold), Eigen::Vector3d::Constant(notTold) };
  }
  const Eigen::Vector3f middle = model.visibility->middle();
  const double window = SizeWindow * model.diameter;
  const float hiddenBy = static_cast<float>(HiddenBy * model.diameter);

  Poses at = poses;
  std::vector<VisiblePart> parts(at.size());
  std::vector<SizeEquations::OfLengths> ofPoses(at.size());
  PartSize size;
  const auto growth = [&](const SizeEquations::OfLengths& all)
  {
    Eigen::Matrix3d information = all.information;
    information.diagonal().array() += isTooThin.select(Eigen::Array3d::Constant(Stays), Eigen::Array3d::Ones());
    return Eigen::Vector3d(information.ldlt().solve(all.right));
  };
  for (int step = 0; step < SizeSteps; ++step)
  {
    const double across = (FirstAcross + (LastAcross - FirstAcross) * step / (SizeSteps - 1)) * model.diameter;
    const Eigen::Vector3f factors = size.factors.cast<float>();
    std::vector<std::optional<SizeEquations>> equations(at.size());
    parallelForEach(static_cast<int>(at.size()), threads, {},
      [&](int i)
      {
        fitter.update(parts[i], at[i], SizeStride);
        const Eigen::Isometry3d T = at[i].T_scene_model;
        SizeEquations& fit = equations[i].emplace(fitter.middle(T), T.linear());
        const Eigen::Isometry3f Tf = T.cast<float>();
        const SoAOrientedPoints edges = moved(stretched(parts[i].edges, middle, factors, false), Tf);
        EdgeIndex::Means means =
          EdgeIndex::meansAround(scene.edgeIndex.neighbours(edges, window, across, 0.0), edges, window, across);
        for (std::size_t k = 0; k < means.weights.size(); ++k)
        {
          const bool isHidden = scene.depth.relation(edges.points[k], hiddenBy) == DepthMap::Relation::Hidden;
          means.weights[k] = isHidden ? 0.0f : std::min(means.weights[k], 1.0f);
        }
        addLineResiduals(fit, edges, means.offsets, means.weights);
        addSurfaceResiduals(fit, scene.depth, moved(stretched(parts[i].surface, middle, factors, true), Tf),
          { static_cast<float>(across), std::numeric_limits<float>::infinity(), true });
        ofPoses[i] = fit.ofLengths();
      });
    SizeEquations::OfLengths all;
    for (const SizeEquations::OfLengths& one : ofPoses)
    {
      all.information += one.information;
      all.right += one.right;
    }
    const Eigen::Vector3d grown = growth(all);
    size.factors += grown;
    if (step + 1 == SizeSteps) // the jackknife: without one pose at a time
    {
      Eigen::Vector3d squares = Eigen::Vector3d::Zero();
      for (const SizeEquations::OfLengths& one : ofPoses)
      {
        squares += (growth({ all.information - one.information, all.right - one.right }) - grown).cwiseAbs2();
      }
      const double count = static_cast<double>(at.size());
      size.deviations = (squares.array() * (count - 1.0) / count + (OfPixel * pixel).square()).sqrt();
    }
    for (std::size_t i = 0; i < at.size(); ++i)
    {
      at[i].T_scene_model = equations[i]->motionFor(grown) * at[i].T_scene_model;
    }
  }
  size.factors = isTooThin.select(notTold, size.factors);
  return size;
}

std::string sizeWords(const Eigen::Vector3d& factors)
{
  Eigen::Index axis;
  factors.array().isNaN().select(0.0, (factors.array() - 1.0).abs()).maxCoeff(&axis);
  char words[64];
  std::snprintf(words, sizeof words, "%.2f times as long along %c as in the CAD file", factors[axis], "xyz"[axis]);
  return words;
}

std::string sizesWords(const Eigen::Vector3d& factors)
{
  std::string all;
  for (int axis = 0; axis < 3 && !factors.array().isNaN().all(); ++axis)
  {
    char factor[16];
    std::snprintf(factor, sizeof factor, "%.2f", factors[axis]);
    all += (all.empty() ? "" : ", ") + std::string(std::isnan(factors[axis]) ? "not told" : factor) + " along " +
           "xyz"[axis];
  }
  return all;
}

std::string untoldWords(const Eigen::Vector3d& factors, const std::string& parts)
{
  std::string axes;
  for (int axis = 0; axis < 3 && !factors.array().isNaN().all(); ++axis)
  {
    if (std::isnan(factors[axis]))
    {
      axes += (axes.empty() ? "" : " and ") + std::string(1, "xyz"[axis]);
    }
  }
  return axes.empty() ? ""
                      : "How long " + parts + " are along " + axes +
                          " cannot be checked in this scan: a longer or shorter part looks the same.";
}
}
