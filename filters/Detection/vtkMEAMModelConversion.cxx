// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMModelConversion.h"

#include "base/Error.h"
#include "base/sequences/Sequences.h"
#include "model/AppearanceModel.h"
#include "model/file/ModelValidation.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMCloudConversion.h"
#include "vtkMEAMSymmetryConversion.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkUnsignedIntArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace vtkMEAMConversion
{
namespace
{
using meam::Error;
using meam::refuseModel;

constexpr vtkIdType CalibrationNumbers = 5; // constant and slope of place and rotation, poses

std::string nameOf(vtkPartitionedDataSetCollection* input, unsigned int index)
{
  const char* name = input->HasMetaData(index) ? input->GetMetaData(index)->Get(vtkCompositeDataSet::NAME()) : nullptr;
  return name ? name : "";
}

/// The first partition at a place, or null.
vtkDataSet* partitionOf(vtkPartitionedDataSetCollection* input, unsigned int index)
{
  vtkPartitionedDataSet* set = input->GetPartitionedDataSet(index);
  return set && set->GetNumberOfPartitions() > 0 ? set->GetPartition(0) : nullptr;
}

void addPartition(vtkPartitionedDataSetCollection* output, const std::string& name, vtkDataSet* data)
{
  vtkNew<vtkPartitionedDataSet> set;
  set->SetNumberOfPartitions(1);
  set->SetPartition(0, data);
  const unsigned int index = output->GetNumberOfPartitionedDataSets();
  output->SetPartitionedDataSet(index, set);
  output->GetMetaData(index)->Set(vtkCompositeDataSet::NAME(), name.c_str());
}

void setFieldVectors(vtkDataObject* output, const char* name, const meam::Points& values)
{
  std::vector<float> numbers;
  for (const auto& value : values)
  {
    numbers.insert(numbers.end(), value.data(), value.data() + 3);
  }
  output->GetFieldData()->AddArray(arrayOf<vtkDoubleArray>(name, numbers, 3));
}

void setFieldInteger(vtkDataObject* output, const char* name, std::size_t value)
{
  output->GetFieldData()->AddArray(arrayOf<vtkIntArray>(name, std::array{ value }));
}

std::string fieldText(vtkDataObject* input, const char* name)
{
  auto* array = vtkStringArray::SafeDownCast(input->GetFieldData()->GetAbstractArray(name));
  return array && array->GetNumberOfValues() == 1 ? array->GetValue(0) : std::string();
}

/// The field data of that name, or null when its length is another one.
vtkDataArray* fieldArray(vtkDataObject* input, const char* name, vtkIdType values)
{
  vtkDataArray* array = input->GetFieldData()->GetArray(name);
  return array && array->GetNumberOfValues() == values ? array : nullptr;
}

/// Vector `index` of field data of 3-vectors; NaN when it is not there.
Eigen::Vector3d fieldVector(vtkDataObject* input, const char* name, vtkIdType count, vtkIdType index)
{
  Eigen::Vector3d vector = Eigen::Vector3d::Constant(NAN);
  if (vtkDataArray* array = fieldArray(input, name, 3 * count))
  {
    for (int i = 0; i < 3; ++i)
    {
      const int components = array->GetNumberOfComponents(); // a single vector may come as 1 x 3 or 3 x 1
      const vtkIdType value = 3 * index + i;
      vector[i] = array->GetComponent(value / components, static_cast<int>(value % components));
    }
  }
  return vector;
}

/// The same, made a unit vector; zero when it is not there.
Eigen::Vector3f fieldDirection(vtkDataObject* input, const char* name, vtkIdType count, vtkIdType index)
{
  const Eigen::Vector3d direction = fieldVector(input, name, count, index);
  const double length = direction.norm();
  if (!(length > 0.0 && std::isfinite(length)))
  {
    return Eigen::Vector3f::Zero();
  }
  // What was written as a unit vector comes back bit by bit.
  return (std::abs(length - 1.0) < 1e-5 ? direction : (direction / length).eval()).cast<float>();
}

void setView(vtkPolyData* output, const Eigen::Vector3f& direction, std::size_t index)
{
  setFieldVectors(output, "ViewDirection", { direction });
  setFieldInteger(output, "ViewIndex", index);
}

std::string viewName(std::size_t index) { return "View " + std::to_string(index); }

/// Flat arrays as a row of points, of no visible extent inside the part.
vtkSmartPointer<vtkImageData> newRow(std::size_t length, const Eigen::Vector3f& place, double diameter)
{
  auto row = vtkSmartPointer<vtkImageData>::New();
  row->SetDimensions(static_cast<int>(length), 1, 1);
  row->SetOrigin(place.x(), place.y(), place.z());
  const double spacing = 1e-3 * diameter / static_cast<double>(std::max<std::size_t>(length, 1));
  row->SetSpacing(spacing, spacing, spacing);
  return row;
}

/// What is read from a file, with everything that may be wrong with it.
class ModelReader
{
public:
  explicit ModelReader(vtkPartitionedDataSetCollection* input)
    : Input(input)
  {
  }

  meam::TrainedModel read() const
  {
    this->checkVersion();
    meam::TrainedModel model;
    model.diameter = this->number("Diameter");
    model.digest = fieldText(this->Input, "Digest");
    this->readSettings(model.settings);
    requireModelSettings(model);
    this->readEdges(model);
    this->readViews(model);
    this->readSurface(model);
    if (hasEdges(model.settings.features))
    {
      model.table = this->table("", this->count("NumberOfPairs"), model.quantizer().numberOfKeys());
    }
    if (hasSurface(model.settings.features))
    {
      this->readSurfacePairs(model);
    }
    model.symmetries = symmetriesOf(this->Input);
    model.calibration = calibrationOf(this->Input);
    requireModel(model);
    model.deriveFields();
    return model;
  }

private:
  void checkVersion() const
  {
    vtkDataArray* version = fieldArray(this->Input, "FormatVersion", 1);
    if (!version)
    {
      throw Error("This is not a trained model: it has no field data 'FormatVersion'. Use the output of MEAMHashing, "
                  "or a file saved from it.");
    }
    meam::requireModelVersion(version->GetComponent(0, 0));
    const std::string units = fieldText(this->Input, "Units");
    if (units != "mm")
    {
      refuseModel("is in '" + units + "', not in mm.");
    }
  }

  double number(const char* name) const
  {
    vtkDataArray* array = fieldArray(this->Input, name, 1);
    const double value = array ? array->GetComponent(0, 0) : NAN;
    if (!std::isfinite(value))
    {
      refuseModel("is incomplete: it has no field data '" + std::string(name) + "'.");
    }
    return value;
  }

  /// A number in [0, choices).
  int choice(const char* name, int choices) const
  {
    const double value = this->number(name);
    if (!(value >= 0.0 && value < choices))
    {
      refuseModel("has a '" + std::string(name) + "' that is not known here.");
    }
    return static_cast<int>(value);
  }

  vtkIdType count(const char* name) const
  {
    const double value = this->number(name);
    if (!(value >= 0.0 && value <= 2147483647.0))
    {
      refuseModel("is damaged: '" + std::string(name) + "' is not a count.");
    }
    return static_cast<vtkIdType>(value);
  }

  void readSettings(meam::MEAMHashingSettings& settings) const
  {
    settings.features = static_cast<meam::Features>(this->choice("Features", 3));
    settings.surface.distanceStep = this->number("SurfaceDistanceStep");
    settings.surface.angleStep = this->number("SurfaceAngleStep");
    settings.surface.leafSize = this->number("SurfaceLeafSize");
    settings.feature = static_cast<meam::PairFeatureKind>(this->choice("Feature", 2));
    settings.distanceStep = this->number("DistanceStep");
    settings.angleStep = this->number("AngleStep");
    settings.merging = static_cast<meam::ViewMerging>(this->choice("ViewMerging", 3));
    settings.voxelSize = this->number("VoxelSize");
    settings.leafSize = this->number("LeafSize");
    settings.coVisibilityDirections = static_cast<int>(this->count("CoVisibilityDirections"));
  }

  /// A partition by name, of the length that was written. A reader may hand out another piece, or an empty
  /// one, for a file that it cannot parse: hence the name in the piece itself and the count.
  vtkDataSet* piece(const std::string& name, vtkIdType points) const
  {
    for (unsigned int i = 0; i < this->Input->GetNumberOfPartitionedDataSets(); ++i)
    {
      vtkDataSet* data = partitionOf(this->Input, i);
      if (nameOf(this->Input, i) == name && data)
      {
        if (fieldText(data, "Piece") != name || data->GetNumberOfPoints() != points)
        {
          refuseModel("is damaged: its piece '" + name + "' has " + std::to_string(data->GetNumberOfPoints()) +
                      " points instead of " + std::to_string(points) +
                      ", or is another one. The file may be truncated.");
        }
        return data;
      }
    }
    refuseModel("is incomplete: its piece '" + name +
                "' is missing. The file may be truncated, or the folder beside it was not copied along.");
  }

  template <typename T>
  std::vector<T> values(vtkDataSet* data, const char* name) const
  {
    vtkDataArray* array = data->GetPointData()->GetArray(name);
    const vtkIdType count = data->GetNumberOfPoints();
    if (!array || array->GetNumberOfComponents() != 1 || array->GetNumberOfTuples() != count)
    {
      refuseModel("is damaged: its array '" + std::string(name) + "' is missing or too short.");
    }
    std::vector<T> result(count);
    if (array->GetDataType() == vtkTypeTraits<T>::VTK_TYPE_ID)
    {
      const T* from = static_cast<const T*>(array->GetVoidPointer(0));
      std::copy(from, from + count, result.begin());
      return result;
    }
    for (vtkIdType i = 0; i < count; ++i)
    {
      result[i] = static_cast<T>(array->GetComponent(i, 0));
    }
    return result;
  }

  void readEdges(meam::TrainedModel& model) const
  {
    vtkDataSet* edges = this->piece("Edges", this->count("NumberOfEdgePoints"));
    model.edges = toCloud(vtkPointSet::SafeDownCast(edges));
    model.edgeViews = this->values<std::uint32_t>(edges, "ViewBits");
    model.edgeVisible = this->values<std::uint32_t>(edges, "VisibleBits");
  }

  void readViews(meam::TrainedModel& model) const
  {
    const vtkIdType views = this->count("NumberOfViews");
    if (views < 1 || views > meam::TrainedModel::MaximumViews)
    {
      refuseModel("is damaged: it has " + std::to_string(views) + " views.");
    }
    // A view is there as long as it has edge points.
    std::vector<vtkIdType> members(views, 0);
    for (const std::uint32_t bits : model.edgeViews)
    {
      for (vtkIdType v = 0; v < views; ++v)
      {
        members[v] += bits >> v & 1u;
      }
    }
    for (vtkIdType v = 0; v < views; ++v)
    {
      const Eigen::Vector3f direction = fieldDirection(this->Input, "ViewDirections", views, v);
      if (direction.isZero())
      {
        refuseModel("is incomplete: it has no field data 'ViewDirections'.");
      }
      model.viewDirections.push_back(direction);
      if (members[v] > 0)
      {
        this->piece(viewName(v), members[v]);
      }
    }
  }

  void readSurface(meam::TrainedModel& model) const
  {
    const vtkIdType points = this->count("NumberOfSurfacePoints");
    if (points == 0)
    {
      return;
    }
    model.surface = toCloud(vtkPointSet::SafeDownCast(this->piece("Surface", points)));
    if (model.surface.empty())
    {
      refuseModel("is damaged: its piece 'Surface' is not a cloud.");
    }
  }

  void readSurfacePairs(meam::TrainedModel& model) const
  {
    const vtkIdType points = this->count("NumberOfSurfacePairPoints");
    if (points > 0)
    {
      model.surfacePairPoints = toCloud(vtkPointSet::SafeDownCast(this->piece("SurfacePairPoints", points)));
    }
    model.surfaceTable =
      this->table("Surface", this->count("NumberOfSurfacePairs"), model.surfaceQuantizer().numberOfKeys());
  }

  /// `name` stands before those of the pieces.
  meam::PairTable table(const std::string& name, vtkIdType entries, std::int64_t keys) const
  {
    meam::PairTable table;
    table.offsets = this->values<std::uint32_t>(this->piece(name + "PairTableBuckets", keys + 1), "Offset");
    if (entries > 0)
    {
      vtkDataSet* data = this->piece(name + "PairTableEntries", entries);
      table.references = this->values<std::uint32_t>(data, "Reference");
      table.referreds = this->values<std::uint32_t>(data, "Referred");
      table.angles = this->values<float>(data, "Angle");
      table.viewBits = this->values<std::uint32_t>(data, "ViewBits");
    }
    return table;
  }

  vtkPartitionedDataSetCollection* Input;
};
}

std::array<double, 3> middleOf(vtkDataObject* input)
{
  auto* data = vtkDataSet::SafeDownCast(input);
  if (auto* model = vtkPartitionedDataSetCollection::SafeDownCast(input))
  {
    for (unsigned int i = 0; i < model->GetNumberOfPartitionedDataSets(); ++i)
    {
      data = nameOf(model, i) == "Surface" ? partitionOf(model, i) : data;
    }
  }
  std::array<double, 3> middle{};
  if (data && data->GetNumberOfPoints() > 0)
  {
    data->GetCenter(middle.data());
  }
  return middle;
}

std::vector<meam::AppearanceModel> toAppearanceModels(vtkPartitionedDataSetCollection* input)
{
  std::vector<meam::AppearanceModel> models;
  for (unsigned int i = 0; i < input->GetNumberOfPartitionedDataSets(); ++i)
  {
    auto* points = vtkPointSet::SafeDownCast(partitionOf(input, i));
    meam::AppearanceModel model;
    model.name = nameOf(input, i);
    if (points)
    {
      model.direction = fieldDirection(points, "ViewDirection", 1, 0);
      model.viewpoint = fieldVector(points, "Viewpoint", 1, 0).cast<float>();
      model.wholePart = fieldArray(points, "WholePart", 1) != nullptr;
    }
    if (!points || model.direction.isZero())
    {
      throw Error("Partition " + std::to_string(i) + " ('" + model.name +
                  "') is not an appearance model: it has no points or no field data 'ViewDirection'. Use the output of "
                  "VisibilityExtraction, BoundaryExtraction or TangentEstimation.");
    }
    model.cloud = toCloud(points);
    models.push_back(std::move(model));
  }
  if (models.empty())
  {
    throw Error("The collection has no appearance models: use the output of VisibilityExtraction.");
  }
  return models;
}

void fromAppearanceModels(const std::vector<meam::AppearanceModel>& models, vtkPartitionedDataSetCollection* output)
{
  for (std::size_t i = 0; i < models.size(); ++i)
  {
    vtkNew<vtkPolyData> points;
    fromCloud(models[i].cloud, points);
    setView(points, models[i].direction, i);
    if (models[i].viewpoint.allFinite())
    {
      setFieldVectors(points, "Viewpoint", { models[i].viewpoint });
    }
    if (models[i].wholePart)
    {
      setFieldInteger(points, "WholePart", 1);
    }
    addPartition(output, models[i].name, points);
  }
}

meam::ModelCalibration calibrationOf(vtkDataObject* input)
{
  vtkDataArray* numbers = fieldArray(input, "Calibration", CalibrationNumbers);
  if (!numbers)
  {
    return {};
  }
  const auto number = [&](int k) { return numbers->GetVariantValue(k).ToDouble(); }; // 5 x 1 or 1 x 5
  return { { number(0), number(1) }, { number(2), number(3) },
    static_cast<int>(std::clamp(number(4), 0.0, 1e9)) }; // a count, whatever a file says
}

void setCalibration(vtkDataObject* output, const meam::ModelCalibration& calibration)
{
  const auto& [place, rotation, poses] = calibration;
  if (poses == 0)
  {
    return;
  }
  const std::array numbers{ place.constant, place.slope, rotation.constant, rotation.slope, double(poses) };
  output->GetFieldData()->AddArray(arrayOf<vtkDoubleArray>("Calibration", numbers));
}

meam::TrainedModel toTrainedModel(vtkPartitionedDataSetCollection* input) { return ModelReader(input).read(); }

void fromTrainedModel(const meam::TrainedModel& model, vtkPartitionedDataSetCollection* output)
{
  for (std::size_t v = 0; v < model.viewDirections.size(); ++v)
  {
    const std::vector<int> members =
      meam::indicesWhere(model.edges.size(), [&](int i) { return model.edgeViews[i] >> v & 1u; });
    vtkNew<vtkPolyData> view;
    fromCloud(model.edges.subset(members), view);
    setView(view, model.viewDirections[v], v);
    setFieldText(view, "Piece", viewName(v));
    addPartition(output, viewName(v), view);
  }

  vtkNew<vtkPolyData> edges;
  fromCloud(model.edges, edges);
  edges->GetPointData()->AddArray(arrayOf<vtkUnsignedIntArray>("ViewBits", model.edgeViews));
  edges->GetPointData()->AddArray(arrayOf<vtkUnsignedIntArray>("VisibleBits", model.edgeVisible));
  vtkNew<vtkPolyData> surface;
  fromCloud(model.surface, surface);
  vtkNew<vtkPolyData> surfacePairPoints;
  fromCloud(model.surfacePairPoints, surfacePairPoints);
  const auto add = [&](const std::string& name, vtkDataSet* data)
  {
    if (data->GetNumberOfPoints() > 0) // an empty piece does not come back from a file
    {
      setFieldText(data, "Piece", name);
      addPartition(output, name, data);
    }
  };
  add("Edges", edges);
  add("Surface", surface);
  add("SurfacePairPoints", surfacePairPoints);
  const auto addTable = [&](const std::string& table, const meam::PairTable& pairs)
  {
    const auto buckets = newRow(pairs.offsets.size(), model.edges.points.front(), model.diameter);
    buckets->GetPointData()->AddArray(arrayOf<vtkUnsignedIntArray>("Offset", pairs.offsets));
    add(table + "PairTableBuckets", buckets);
    const auto entries = newRow(pairs.size(), model.edges.points.front(), model.diameter);
    entries->GetPointData()->AddArray(arrayOf<vtkUnsignedIntArray>("Reference", pairs.references));
    entries->GetPointData()->AddArray(arrayOf<vtkUnsignedIntArray>("Referred", pairs.referreds));
    entries->GetPointData()->AddArray(arrayOf<vtkFloatArray>("Angle", pairs.angles));
    entries->GetPointData()->AddArray(arrayOf<vtkUnsignedIntArray>("ViewBits", pairs.viewBits));
    add(table + "PairTableEntries", entries);
  };
  addTable("", model.table);
  addTable("Surface", model.surfaceTable);

  setFieldInteger(output, "FormatVersion", meam::TrainedModel::FormatVersion);
  setFieldText(output, "Units", "mm");
  setFieldText(output, "Digest", model.digest);
  setDiameter(output, model.diameter);
  setFieldInteger(output, "Features", static_cast<std::size_t>(model.settings.features));
  setFieldValue(output, "SurfaceDistanceStep", model.settings.surface.distanceStep);
  setFieldValue(output, "SurfaceAngleStep", model.settings.surface.angleStep);
  setFieldValue(output, "SurfaceLeafSize", model.settings.surface.leafSize);
  setFieldInteger(output, "Feature", static_cast<std::size_t>(model.settings.feature));
  setFieldValue(output, "DistanceStep", model.settings.distanceStep);
  setFieldValue(output, "AngleStep", model.settings.angleStep);
  setFieldInteger(output, "ViewMerging", static_cast<std::size_t>(model.settings.merging));
  setFieldValue(output, "VoxelSize", model.settings.voxelSize);
  setFieldValue(output, "LeafSize", model.settings.leafSize);
  setFieldInteger(output, "CoVisibilityDirections", model.settings.coVisibilityDirections);
  setFieldVectors(output, "ViewDirections", model.viewDirections);
  setFieldInteger(output, "NumberOfViews", model.viewDirections.size());
  setFieldInteger(output, "NumberOfEdgePoints", model.edges.size());
  setFieldInteger(output, "NumberOfSurfacePoints", model.surface.size());
  setFieldInteger(output, "NumberOfPairs", model.table.size());
  setFieldInteger(output, "NumberOfSurfacePairPoints", model.surfacePairPoints.size());
  setFieldInteger(output, "NumberOfSurfacePairs", model.surfaceTable.size());
  setFieldValue(output, "TableBytes", static_cast<double>(model.table.bytes() + model.surfaceTable.bytes()));
  setCalibration(output, model.calibration);
  setSymmetries(output, model.symmetries);
}
}
