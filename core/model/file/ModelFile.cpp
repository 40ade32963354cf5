// SPDX-License-Identifier: BSD-3-Clause
#include "model/file/ModelFile.h"

#include "base/Error.h"
#include "base/Frames.h"
#include "io/parsing/FileBytes.h"
#include "io/parsing/NamedArrays.h"
#include "model/file/DerivedFields.h"
#include "model/file/ModelValidation.h"

#include <algorithm>
#include <fstream>

namespace meam
{
namespace
{
// As PNG's: no text, and changed by every transfer that takes it for one.
constexpr std::string_view Signature("\x89MEAM\r\n\x1a", 8);

using Numbers = std::vector<double>;

Eigen::Isometry3d transformAt(const Numbers& numbers, std::size_t at) { return transformOf(numbers.data() + at); }

// Numbers of a row: a symmetry in each.
constexpr std::size_t DiscreteRow = 16;  // row-major 4 x 4
constexpr std::size_t ContinuousRow = 6; // axis, point on it
constexpr std::size_t NearRow = 18;      // row-major 4 x 4, overlap, deviation
constexpr std::size_t Calibration = 5;   // constant and slope of place and rotation, poses

/// Calls take(numbers, at) for each whole row of an array.
template <typename Take>
void forEachRow(const NamedArrays& arrays, const char* name, std::size_t row, Take&& take)
{
  const Numbers numbers = arrays.get<double>(name);
  if (numbers.size() % row != 0)
  {
    throw Error("is damaged: its array '" + std::string(name) + "' ends within a symmetry");
  }
  for (std::size_t at = 0; at < numbers.size(); at += row)
  {
    take(numbers, at);
  }
}

void setSymmetries(NamedArrays& arrays, const Symmetries& symmetries)
{
  Numbers discrete, continuous, near;
  for (const Eigen::Isometry3d& T : symmetries.discrete)
  {
    appendNumbersOf(T, discrete);
  }
  for (const ContinuousSymmetry& symmetry : symmetries.continuous)
  {
    continuous.insert(continuous.end(), symmetry.axis.data(), symmetry.axis.data() + 3);
    continuous.insert(continuous.end(), symmetry.point.data(), symmetry.point.data() + 3);
  }
  for (const NearSymmetry& symmetry : symmetries.near)
  {
    appendNumbersOf(symmetry.T, near);
    near.push_back(symmetry.overlap);
    near.push_back(symmetry.deviation);
  }
  arrays.set("SymmetriesDiscrete", discrete);
  arrays.set("SymmetriesContinuous", continuous);
  arrays.set("NearSymmetries", near);
}

Symmetries symmetriesOf(const NamedArrays& arrays)
{
  Symmetries symmetries;
  forEachRow(arrays, "SymmetriesDiscrete", DiscreteRow,
    [&](const Numbers& numbers, std::size_t at) { symmetries.discrete.push_back(transformAt(numbers, at)); });
  forEachRow(arrays, "SymmetriesContinuous", ContinuousRow,
    [&](const Numbers& numbers, std::size_t at)
    {
      symmetries.continuous.push_back(
        { Eigen::Vector3d(numbers.data() + at), Eigen::Vector3d(numbers.data() + at + 3) });
    });
  forEachRow(arrays, "NearSymmetries", NearRow,
    [&](const Numbers& numbers, std::size_t at) {
      symmetries.near.push_back({ transformAt(numbers, at), numbers[at + 16], numbers[at + 17] });
    });
  return symmetries;
}

void setCalibration(NamedArrays& arrays, const ModelCalibration& calibration)
{
  const auto& [place, rotation, poses] = calibration;
  if (poses > 0)
  {
    arrays.set("Calibration",
      Numbers{ place.constant, place.slope, rotation.constant, rotation.slope, static_cast<double>(poses) });
  }
}

/// None in the file of a model that was not calibrated.
ModelCalibration calibrationOf(const NamedArrays& arrays)
{
  const Numbers numbers = arrays.get<double>("Calibration");
  if (numbers.empty())
  {
    return {};
  }
  if (numbers.size() != Calibration)
  {
    throw Error("is damaged: its calibration has " + std::to_string(numbers.size()) + " numbers");
  }
  return { { numbers[0], numbers[1] }, { numbers[2], numbers[3] }, static_cast<int>(std::clamp(numbers[4], 0.0, 1e9)) };
}

/// A model's clouds have no weights.
void setCloud(NamedArrays& arrays, const std::string& name, const PointCloud& cloud)
{
  arrays.set(name + "Points", cloud.points);
  arrays.set(name + "Normals", cloud.normals);
  arrays.set(name + "Tangents", cloud.tangents);
  arrays.set(name + "PointIds", cloud.pointIds);
  std::vector<std::uint8_t> types(cloud.edgeTypes.size());
  std::transform(cloud.edgeTypes.begin(), cloud.edgeTypes.end(), types.begin(),
    [](EdgeType type) { return static_cast<std::uint8_t>(type); });
  arrays.set(name + "EdgeTypes", types);
}

/// Arrays of the points are empty or as long as these.
PointCloud cloudOf(const NamedArrays& arrays, const std::string& name)
{
  PointCloud cloud;
  cloud.points = arrays.points(name + "Points");
  cloud.normals = arrays.points(name + "Normals");
  cloud.tangents = arrays.points(name + "Tangents");
  cloud.pointIds = arrays.get<int>(name + "PointIds");
  for (const std::uint8_t type : arrays.get<std::uint8_t>(name + "EdgeTypes"))
  {
    if (type > static_cast<std::uint8_t>(EdgeType::HoleBorder))
    {
      throw Error("is damaged: it has edge points of a type that is not known");
    }
    cloud.edgeTypes.push_back(static_cast<EdgeType>(type));
  }
  const std::size_t count = cloud.size();
  for (const std::size_t length :
    { cloud.normals.size(), cloud.tangents.size(), cloud.pointIds.size(), cloud.edgeTypes.size() })
  {
    if (length != 0 && length != count)
    {
      throw Error("is damaged: the arrays of '" + name + "' have different lengths");
    }
  }
  return cloud;
}

void setTable(NamedArrays& arrays, const std::string& name, const PairTable& table)
{
  arrays.set(name + "Offsets", table.offsets);
  arrays.set(name + "References", table.references);
  arrays.set(name + "Referreds", table.referreds);
  arrays.set(name + "Angles", table.angles);
  arrays.set(name + "ViewBits", table.viewBits);
}

PairTable tableOf(const NamedArrays& arrays, const std::string& name)
{
  PairTable table;
  table.offsets = arrays.get<std::uint32_t>(name + "Offsets");
  table.references = arrays.get<std::uint32_t>(name + "References");
  table.referreds = arrays.get<std::uint32_t>(name + "Referreds");
  table.angles = arrays.get<float>(name + "Angles");
  table.viewBits = arrays.get<std::uint32_t>(name + "ViewBits");
  return table;
}

NamedArrays arraysOf(const TrainedModel& model)
{
  NamedArrays arrays;
  arrays.set("Digest", model.digest);
  arrays.set("Diameter", Numbers{ model.diameter });
  arrays.set("Features", std::vector<std::int32_t>{ static_cast<std::int32_t>(model.settings.features) });
  arrays.set("SurfaceDistanceStep", Numbers{ model.settings.surface.distanceStep });
  arrays.set("SurfaceAngleStep", Numbers{ model.settings.surface.angleStep });
  arrays.set("SurfaceLeafSize", Numbers{ model.settings.surface.leafSize });
  arrays.set("Feature", std::vector<std::int32_t>{ static_cast<std::int32_t>(model.settings.feature) });
  arrays.set("DistanceStep", Numbers{ model.settings.distanceStep });
  arrays.set("AngleStep", Numbers{ model.settings.angleStep });
  arrays.set("ViewMerging", std::vector<std::int32_t>{ static_cast<std::int32_t>(model.settings.merging) });
  arrays.set("VoxelSize", Numbers{ model.settings.voxelSize });
  arrays.set("LeafSize", Numbers{ model.settings.leafSize });
  arrays.set("CoVisibilityDirections", std::vector<std::int32_t>{ model.settings.coVisibilityDirections });
  arrays.set("ViewDirections", model.viewDirections);
  setCloud(arrays, "Edge", model.edges);
  arrays.set("ViewBits", model.edgeViews);
  arrays.set("VisibleBits", model.edgeVisible);
  setCloud(arrays, "Surface", model.surface);
  setSymmetries(arrays, model.symmetries);
  setTable(arrays, "Table", model.table);
  setCloud(arrays, "SurfacePair", model.surfacePairPoints);
  setTable(arrays, "SurfaceTable", model.surfaceTable);
  setCalibration(arrays, model.calibration);
  setDerived(arrays, model);
  return arrays;
}

/// A number in [0, choices).
int choiceOf(const NamedArrays& arrays, const char* name, int choices)
{
  const auto value = arrays.value<std::int32_t>(name);
  if (value < 0 || value >= choices)
  {
    throw Error("has a '" + std::string(name) + "' that is not known here");
  }
  return value;
}

TrainedModel modelOf(const NamedArrays& arrays)
{
  TrainedModel model;
  model.digest = arrays.text("Digest");
  model.diameter = arrays.value<double>("Diameter");
  model.settings.features = static_cast<Features>(choiceOf(arrays, "Features", 3));
  model.settings.surface.distanceStep = arrays.value<double>("SurfaceDistanceStep");
  model.settings.surface.angleStep = arrays.value<double>("SurfaceAngleStep");
  model.settings.surface.leafSize = arrays.value<double>("SurfaceLeafSize");
  model.settings.feature = static_cast<PairFeatureKind>(choiceOf(arrays, "Feature", 2));
  model.settings.distanceStep = arrays.value<double>("DistanceStep");
  model.settings.angleStep = arrays.value<double>("AngleStep");
  model.settings.merging = static_cast<ViewMerging>(choiceOf(arrays, "ViewMerging", 3));
  model.settings.voxelSize = arrays.value<double>("VoxelSize");
  model.settings.leafSize = arrays.value<double>("LeafSize");
  model.settings.coVisibilityDirections = arrays.value<std::int32_t>("CoVisibilityDirections");
  model.viewDirections = arrays.points("ViewDirections");
  model.edges = cloudOf(arrays, "Edge");
  model.edgeViews = arrays.get<std::uint32_t>("ViewBits");
  model.edgeVisible = arrays.get<std::uint32_t>("VisibleBits");
  model.surface = cloudOf(arrays, "Surface");
  model.symmetries = symmetriesOf(arrays);
  model.table = tableOf(arrays, "Table");
  model.surfacePairPoints = cloudOf(arrays, "SurfacePair");
  model.surfaceTable = tableOf(arrays, "SurfaceTable");
  model.calibration = calibrationOf(arrays);
  return model;
}
}

void writeModel(const std::string& path, const TrainedModel& model)
{
  requireModel(model);
  std::string bytes(Signature);
  const std::uint32_t version = TrainedModel::FormatVersion;
  bytes.append(reinterpret_cast<const char*>(&version), sizeof(version));
  writeFile(path, bytes + arraysOf(model).packed());
}

TrainedModel readModel(const std::string& path)
{
  const std::string bytes = readFile(path);
  std::string_view content = bytes;
  if (content.substr(0, Signature.size()) != Signature)
  {
    throw Error("The file '" + path +
                "' is not a trained model, or was changed on its way as if it were text: give the "
                "file that training saved.");
  }
  content.remove_prefix(Signature.size());
  std::uint32_t version = 0;
  if (content.size() >= sizeof(version))
  {
    std::memcpy(&version, content.data(), sizeof(version));
    content.remove_prefix(sizeof(version));
  }
  try
  {
    requireModelVersion(version);
    TrainedModel model;
    std::optional<DerivedFields> derived;
    try
    {
      const NamedArrays arrays = NamedArrays::unpacked(content);
      model = modelOf(arrays);
      derived = derivedOf(arrays);
    }
    catch (const Error& error)
    {
      refuseModel(std::string(error.what()) + ".");
    }
    requireModel(model);
    if (derived)
    {
      model.deriveFields(*std::move(derived));
    }
    else
    {
      model.deriveFields();
    }
    return model;
  }
  catch (const Error& error)
  {
    throw Error("The file '" + path + "' cannot be used. " + error.what());
  }
}

bool isModel(const std::string& path)
{
  char start[Signature.size()] = {};
  std::ifstream(path, std::ios::binary).read(start, sizeof(start));
  return std::string_view(start, sizeof(start)) == Signature;
}
}
