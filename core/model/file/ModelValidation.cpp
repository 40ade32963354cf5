// SPDX-License-Identifier: BSD-3-Clause
#include "model/file/ModelValidation.h"

#include "base/Error.h"
#include "base/Frames.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace meam
{
namespace
{
constexpr double LeastDiameter = 1e-6; // mm; of less single precision cannot take the inverse
constexpr double MostDiameter = 1e9;   // mm
constexpr double MostExtent = 2.0;     // of the points along an axis, over the diameter; 1 but for rounding
constexpr float MostAngle = 3.15f;     // radians; pi but for rounding
constexpr double Rotation = 1e-3;      // rounding of axes, off unit vectors

bool isMotion(const Eigen::Isometry3d& T) { return isRigid(T.matrix()); }

void requireFinite(const Points& points, const char* what)
{
  if (!std::all_of(points.begin(), points.end(), [](const auto& p) { return p.allFinite(); }))
  {
    refuseModel("is damaged: its " + std::string(what) + " are not numbers.");
  }
}

/// Grids are laid about these points, with cells as large as the diameter tells.
void requireExtent(const Points& points, double diameter, const char* what)
{
  Eigen::AlignedBox3f box;
  for (const auto& point : points)
  {
    box.extend(point);
  }
  if (!points.empty() && !(box.sizes().maxCoeff() <= MostExtent * diameter))
  {
    refuseModel("is damaged: its " + std::string(what) + " lie farther apart than its diameter.");
  }
}

void requireEdges(const TrainedModel& model)
{
  const std::size_t count = model.edges.size();
  if (count == 0 || model.edges.tangents.size() != count)
  {
    refuseModel("has no edge points with tangents.");
  }
  if (count > TrainedModel::MostEdges)
  {
    refuseModel("is damaged: it has " + std::to_string(count) + " edge points.");
  }
  if (model.edgeViews.size() != count || model.edgeVisible.size() != count)
  {
    refuseModel("is damaged: not every edge point has its views.");
  }
  requireFinite(model.edges.points, "edge points");
  requireFinite(model.edges.tangents, "tangents");
  requireExtent(model.edges.points, model.diameter, "edge points");
}

void requireViews(const TrainedModel& model)
{
  const std::size_t views = model.viewDirections.size();
  if (views < 1 || views > TrainedModel::MaximumViews)
  {
    refuseModel("is damaged: it has " + std::to_string(views) + " views.");
  }
  for (const Eigen::Vector3f& direction : model.viewDirections)
  {
    if (!(std::abs(direction.norm() - 1.0f) < Rotation))
    {
      refuseModel("is damaged: its view directions are not unit vectors.");
    }
  }
  // Every edge point was seen somewhere, and in a view that exists.
  for (const std::uint32_t bits : model.edgeViews)
  {
    if (bits == 0 || (static_cast<std::uint64_t>(bits) >> views) != 0)
    {
      refuseModel("is damaged: its 'ViewBits' name a view that does not exist.");
    }
  }
}

void requireSurface(const TrainedModel& model)
{
  if (model.surface.normals.size() != model.surface.size())
  {
    refuseModel("has a surface without normals.");
  }
  requireFinite(model.surface.points, "surface points");
  requireFinite(model.surface.normals, "normals");
  requireExtent(model.surface.points, model.diameter, "surface points");
}

void requireSymmetries(const Symmetries& symmetries)
{
  const bool sound = std::all_of(symmetries.discrete.begin(), symmetries.discrete.end(), isMotion) &&
                     std::all_of(symmetries.near.begin(), symmetries.near.end(),
                       [](const NearSymmetry& near)
                       { return isMotion(near.T) && std::isfinite(near.overlap) && std::isfinite(near.deviation); }) &&
                     std::all_of(symmetries.continuous.begin(), symmetries.continuous.end(),
                       [](const ContinuousSymmetry& symmetry)
                       { return std::abs(symmetry.axis.norm() - 1.0) < Rotation && symmetry.point.allFinite(); });
  if (!sound)
  {
    refuseModel("is damaged: its symmetries are not rigid motions.");
  }
}

/// `what` names the points that make the pairs.
void requireTable(const PairTable& table, std::size_t points, std::int64_t numberOfKeys, const char* what)
{
  const auto isPoint = [&](std::uint32_t index) { return index < points; };
  bool sound =
    table.offsets.size() == static_cast<std::size_t>(numberOfKeys) + 1 && table.referreds.size() == table.size() &&
    table.angles.size() == table.size() && table.viewBits.size() == table.size() && table.offsets.front() == 0 &&
    table.offsets.back() == table.size() && std::is_sorted(table.offsets.begin(), table.offsets.end()) &&
    std::all_of(table.references.begin(), table.references.end(), isPoint) &&
    std::all_of(table.referreds.begin(), table.referreds.end(), isPoint) &&
    std::all_of(table.angles.begin(), table.angles.end(), [](float angle) { return std::abs(angle) < MostAngle; });
  const auto sortedWithin = [&](std::uint32_t begin, std::uint32_t end)
  { return std::is_sorted(table.references.begin() + begin, table.references.begin() + end); };
  for (std::size_t key = 0; sound && key + 1 < table.offsets.size(); ++key)
  {
    sound = sortedWithin(table.offsets[key], table.offsets[key + 1]);
  }
  if (!sound)
  {
    refuseModel("is damaged: its pair table does not fit its " + std::string(what) + " points.");
  }
}

void requireCalibration(const ModelCalibration& calibration)
{
  for (const LogisticRegression& line : { calibration.place, calibration.rotation })
  {
    if (!std::isfinite(line.constant) || !(line.slope > 0.0) || !std::isfinite(line.slope))
    {
      refuseModel("is damaged: its calibration is none.");
    }
  }
}

/// Those that make pairs.
void requireSurfacePairs(const TrainedModel& model)
{
  const PointCloud& points = model.surfacePairPoints;
  if (points.normals.size() != points.size() || points.size() > TrainedModel::MostEdges)
  {
    refuseModel("is damaged: its surface points that make pairs have no normals, or are too many.");
  }
  requireFinite(points.points, "surface points");
  requireFinite(points.normals, "normals");
  requireExtent(points.points, model.diameter, "surface points");
}

/// Tables are there of those features that the model holds.
void requireTables(const TrainedModel& model)
{
  const auto require =
    [](bool isHeld, const PairTable& table, const PointCloud& points, std::int64_t keys, const char* what)
  {
    if (isHeld)
    {
      requireTable(table, points.size(), keys, what);
    }
    else if (table.size() > 0 || !table.offsets.empty())
    {
      refuseModel("is damaged: it has a pair table of " + std::string(what) + " points, which it does not hold.");
    }
  };
  const Features features = model.settings.features;
  require(hasEdges(features), model.table, model.edges, model.quantizer().numberOfKeys(), "edge");
  require(hasSurface(features), model.surfaceTable, model.surfacePairPoints, model.surfaceQuantizer().numberOfKeys(),
    "surface");
}
}

void refuseModel(const std::string& what)
{
  throw Error("The trained model " + what +
              " Train the model again, and save it as .meam, or from VTK as .vtpc with the data mode 'Binary'.");
}

void requireModelVersion(double version)
{
  if (version != TrainedModel::FormatVersion)
  {
    std::ostringstream message;
    message << "The trained model has format version " << version << ", this program reads version "
            << TrainedModel::FormatVersion << ": train the model again.";
    throw Error(message.str());
  }
}

void requireModelSettings(const TrainedModel& model)
{
  if (!(model.diameter > LeastDiameter && model.diameter < MostDiameter))
  {
    refuseModel("has no diameter.");
  }
  const MEAMHashingSettings& settings = model.settings;
  if (!(settings.distanceStep > 0.0 && settings.distanceStep <= 1.0) ||
      !(settings.angleStep >= 1.0 && settings.angleStep <= 90.0))
  {
    refuseModel("has a distance step or an angle step that is out of range.");
  }
  const SurfacePairSettings& surface = settings.surface;
  if (!(surface.distanceStep > 0.0 && surface.distanceStep <= 1.0) ||
      !(surface.angleStep >= 1.0 && surface.angleStep <= 90.0) || !(surface.leafSize > 0.0 && surface.leafSize <= 1.0))
  {
    refuseModel("has a distance step, an angle step or a leaf size of surface points that is out of range.");
  }
  if (!std::isfinite(settings.voxelSize) || !std::isfinite(settings.leafSize))
  {
    refuseModel("has a voxel size or a leaf size that is not a number.");
  }
  if (std::max(model.quantizer().numberOfKeys(), model.surfaceQuantizer().numberOfKeys()) > TrainedModel::MostKeys)
  {
    refuseModel("has a distance step or an angle step that is too small.");
  }
}

void requireModel(const TrainedModel& model)
{
  requireModelSettings(model);
  requireEdges(model);
  requireViews(model);
  requireSurface(model);
  requireSymmetries(model.symmetries);
  requireSurfacePairs(model);
  requireTables(model);
  requireCalibration(model.calibration);
}
}
