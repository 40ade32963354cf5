// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMConversion.h"

#include "features/TangentEstimation.h"

#include "vtkCellArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStructuredGrid.h"
#include "vtkTriangleFilter.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVersion.h"
#include "mesh/TriangleMesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

namespace vtkMEAMConversion
{
namespace
{
constexpr double ExactRotation = 1e-9; // of a file with few decimals it is not
constexpr double NearlyUnit = 1e-4; // a length this near to 1 is 1 but for rounding

using meam::Error;

std::string quoted(const char* name) { return std::string("'") + name + "'"; }

template <typename Scalar>
using Vectors = std::vector<Eigen::Matrix<Scalar, 3, 1>>;

/// Three components of each tuple; VTK's own accessors are too slow for a scan.
template <typename T, typename Scalar>
void copyTuples(const T* values, Vectors<Scalar>& points)
{
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i] = { static_cast<Scalar>(values[3 * i]), static_cast<Scalar>(values[3 * i + 1]),
      static_cast<Scalar>(values[3 * i + 2]) };
  }
}

template <typename Scalar>
Vectors<Scalar> toVectors(vtkDataArray* array)
{
  Vectors<Scalar> points(array->GetNumberOfTuples());
  if (auto* floats = vtkFloatArray::FastDownCast(array))
  {
    copyTuples(floats->GetPointer(0), points);
  }
  else if (auto* doubles = vtkDoubleArray::FastDownCast(array))
  {
    copyTuples(doubles->GetPointer(0), points);
  }
  else
  {
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      double tuple[3];
      array->GetTuple(static_cast<vtkIdType>(i), tuple);
      points[i] = Eigen::Vector3d(tuple[0], tuple[1], tuple[2]).cast<Scalar>();
    }
  }
  return points;
}

vtkSmartPointer<vtkFloatArray> fromVectors(const meam::Points& points, const char* name)
{
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(points.size()));
  float* values = array->GetPointer(0);
  for (const auto& point : points)
  {
    values = std::copy(point.data(), point.data() + 3, values);
  }
  return array;
}

vtkSmartPointer<vtkPoints> toVTKPoints(const meam::Points& points)
{
  auto result = vtkSmartPointer<vtkPoints>::New();
  result->SetData(fromVectors(points, "Points"));
  return result;
}

/// The point array of that name, or null; throws when its shape is another one.
vtkDataArray* pointArray(vtkDataSet* input, const char* name, int components)
{
  vtkDataArray* array = input->GetPointData()->GetArray(name);
  if (array &&
      (array->GetNumberOfComponents() != components || array->GetNumberOfTuples() != input->GetNumberOfPoints()))
  {
    throw Error("The point array " + quoted(name) + " must have " + std::to_string(components) +
                " components for each point: it was not made by the step before this one.");
  }
  return array;
}

/// Which points of a data set are blanked; null when none is.
vtkUnsignedCharArray* ghostsOf(vtkDataSet* input)
{
  return vtkUnsignedCharArray::SafeDownCast(input->GetPointData()->GetArray(vtkDataSetAttributes::GhostArrayName()));
}

bool isHidden(vtkUnsignedCharArray* ghosts, std::size_t i)
{
  const auto id = static_cast<vtkIdType>(i);
  return id < ghosts->GetNumberOfTuples() && (*ghosts->GetPointer(id) & vtkDataSetAttributes::HIDDENPOINT);
}

/// Throws Error for a grid that is not a single layer.
void requireLayer(vtkStructuredGrid* grid)
{
  int size[3];
  grid->GetDimensions(size);
  const vtkIdType count = grid->GetNumberOfPoints();
  if (count > 0 && (size[2] != 1 || static_cast<vtkIdType>(size[0]) * size[1] != count))
  {
    throw Error("The scene is a grid of " + std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " +
                std::to_string(size[2]) + " points: an organized cloud is width x height x 1.");
  }
}

/// The points that are finite and not hidden; `ghosts` may be null.
template <typename Scalar>
meam::FramedPoints seenPoints(const Scalar* xyz, std::size_t count, vtkUnsignedCharArray* ghosts, int threads)
{
  bool isAnyHidden = false; // of those that have coordinates
  for (std::size_t i = 0; ghosts && !isAnyHidden && i < count; ++i)
  {
    isAnyHidden = isHidden(ghosts, i) && std::isfinite(xyz[3 * i]);
  }
  if (!isAnyHidden)
  {
    return meam::inOwnFrame(xyz, count, threads);
  }
  std::vector<Scalar> seen(xyz, xyz + 3 * count);
  for (std::size_t i = 0; i < count; ++i)
  {
    seen[3 * i] = isHidden(ghosts, i) ? std::numeric_limits<Scalar>::quiet_NaN() : seen[3 * i];
  }
  return meam::inOwnFrame(seen.data(), count, threads);
}

void addVertices(vtkPolyData* output)
{
  const vtkIdType count = output->GetNumberOfPoints();
  const auto numbers = [](vtkIdType last)
  {
    auto ids = vtkSmartPointer<vtkIdTypeArray>::New();
    ids->SetNumberOfTuples(last);
    std::iota(ids->GetPointer(0), ids->GetPointer(0) + last, 0);
    return ids;
  };
  vtkNew<vtkCellArray> vertices;
  vertices->SetData(numbers(count + 1), numbers(count));
  output->SetVerts(vertices);
}

/// Appends the triangles of `cells`; false when there is a polygon of another kind.
bool appendTriangles(vtkCellArray* cells, vtkIdType numberOfPoints, std::vector<Eigen::Vector3i>& triangles)
{
  vtkIdType size = 0;
  const vtkIdType* ids = nullptr;
  bool onlyTriangles = true;
  triangles.reserve(triangles.size() + cells->GetNumberOfCells());
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
  {
    cells->GetCellAtId(cell, size, ids);
    for (vtkIdType k = 0; k < size; ++k)
    {
      if (ids[k] < 0 || ids[k] >= numberOfPoints)
      {
        throw Error("Face " + std::to_string(cell) + " of the mesh uses point " + std::to_string(ids[k]) +
                    ", which does not exist: the file is damaged.");
      }
    }
    if (size == 3)
    {
      triangles.emplace_back(static_cast<int>(ids[0]), static_cast<int>(ids[1]), static_cast<int>(ids[2]));
    }
    onlyTriangles = onlyTriangles && size == 3;
  }
  return onlyTriangles;
}

/// Values of an 8 bit image from an array of any type.
std::vector<std::uint8_t> toPixels(vtkDataArray* array, int channels)
{
  const vtkIdType count = array->GetNumberOfTuples();
  const int components = array->GetNumberOfComponents();
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(count) * channels);
  auto* bytes = vtkUnsignedCharArray::FastDownCast(array);
  // 16 bit images use their whole range.
  const double scale = array->GetDataType() == VTK_UNSIGNED_SHORT ? 1.0 / 257.0 : 1.0;
  std::size_t place = 0;
  for (vtkIdType i = 0; i < count; ++i)
  {
    for (int c = 0; c < channels; ++c)
    {
      if (bytes)
      {
        pixels[place++] = *bytes->GetPointer(i * components + c);
        continue;
      }
      const double value = std::round(scale * array->GetComponent(i, c));
      if (!(value >= 0.0 && value <= 255.0))
      {
        throw Error("The image has the value " + std::to_string(value) + ": grey values and colours go from 0 to 255.");
      }
      pixels[place++] = static_cast<std::uint8_t>(value);
    }
  }
  return pixels;
}

}

meam::TriangleMesh toMesh(vtkPolyData* input)
{
  meam::TriangleMesh mesh;
  const vtkIdType count = input->GetNumberOfPoints();
  if (count > 0)
  {
    mesh.vertices = toVectors<float>(input->GetPoints()->GetData());
  }
  if (input->GetNumberOfStrips() == 0 && appendTriangles(input->GetPolys(), count, mesh.triangles))
  {
    return mesh;
  }
  // What cannot be cut into triangles has to be told before.
  appendTriangles(input->GetStrips(), count, mesh.triangles);
  if (!std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [](const auto& p) { return p.allFinite(); }))
  {
    throw Error("The mesh has a vertex that is not a number: repair the CAD file.");
  }
  vtkNew<vtkPolyData> faces;
  faces->SetPoints(input->GetPoints());
  faces->SetPolys(input->GetPolys());
  faces->SetStrips(input->GetStrips());
  vtkNew<vtkTriangleFilter> triangulate;
  triangulate->SetInputData(faces);
  triangulate->Update();
  mesh.vertices = toVectors<float>(triangulate->GetOutput()->GetPoints()->GetData());
  mesh.triangles.clear();
  appendTriangles(triangulate->GetOutput()->GetPolys(), triangulate->GetOutput()->GetNumberOfPoints(), mesh.triangles);
  return mesh;
}

void fromMesh(const meam::TriangleMesh& mesh, vtkPolyData* output)
{
  output->SetPoints(toVTKPoints(mesh.vertices));
  vtkNew<vtkCellArray> polys;
  const auto count = static_cast<vtkIdType>(mesh.triangles.size());
  polys->AllocateExact(count, 3 * count);
  for (const auto& triangle : mesh.triangles)
  {
    const vtkIdType ids[3] = { triangle[0], triangle[1], triangle[2] };
    polys->InsertNextCell(3, ids);
  }
  output->SetPolys(polys);
}

meam::PointCloud toCloud(vtkPointSet* input)
{
  meam::PointCloud cloud;
  if (!input || input->GetNumberOfPoints() == 0)
  {
    return cloud;
  }
  cloud.points = toVectors<float>(input->GetPoints()->GetData());
  if (vtkDataArray* normals = pointArray(input, "Normals", 3))
  {
    cloud.normals = toVectors<float>(normals);
  }
  if (vtkDataArray* tangents = pointArray(input, "Tangent", 3))
  {
    cloud.tangents = toVectors<float>(tangents);
  }
  if (vtkDataArray* ids = pointArray(input, "PointId", 1))
  {
    cloud.pointIds.reserve(cloud.size());
    for (vtkIdType i = 0; i < ids->GetNumberOfTuples(); ++i)
    {
      const double id = ids->GetComponent(i, 0);
      cloud.pointIds.push_back(id >= 0.0 && id <= std::numeric_limits<int>::max() ? static_cast<int>(id) : -1);
    }
  }
  if (vtkDataArray* types = pointArray(input, "EdgeType", 1))
  {
    cloud.edgeTypes.reserve(cloud.size());
    for (vtkIdType i = 0; i < types->GetNumberOfTuples(); ++i)
    {
      const double type = types->GetComponent(i, 0);
      if (!(type >= 0.0 && type <= static_cast<double>(meam::EdgeType::HoleBorder)))
      {
        throw Error("The point array 'EdgeType' has the value " + std::to_string(type) +
                    ": 0 (contour), 1 (crease) and 2 (hole border) are known.");
      }
      cloud.edgeTypes.push_back(static_cast<meam::EdgeType>(static_cast<int>(type)));
    }
  }
  return cloud;
}

void fromCloud(const meam::PointCloud& cloud, vtkPolyData* output)
{
  output->SetPoints(toVTKPoints(cloud.points));
  addVertices(output);
  if (!cloud.normals.empty())
  {
    output->GetPointData()->SetNormals(fromVectors(cloud.normals, "Normals"));
  }
  if (!cloud.tangents.empty())
  {
    output->GetPointData()->SetVectors(fromVectors(cloud.tangents, "Tangent"));
  }
  if (!cloud.pointIds.empty())
  {
    vtkNew<vtkIntArray> ids;
    ids->SetName("PointId");
    ids->SetNumberOfTuples(static_cast<vtkIdType>(cloud.pointIds.size()));
    std::copy(cloud.pointIds.begin(), cloud.pointIds.end(), ids->GetPointer(0));
    output->GetPointData()->AddArray(ids);
  }
  if (!cloud.edgeTypes.empty())
  {
    vtkNew<vtkUnsignedCharArray> types;
    types->SetName("EdgeType");
    types->SetNumberOfTuples(static_cast<vtkIdType>(cloud.edgeTypes.size()));
    std::transform(cloud.edgeTypes.begin(), cloud.edgeTypes.end(), types->GetPointer(0),
      [](meam::EdgeType type) { return static_cast<unsigned char>(type); });
    output->GetPointData()->SetScalars(types); // what a view colours by
  }
  if (!cloud.weights.empty())
  {
    vtkNew<vtkFloatArray> weights;
    weights->SetName("Weight");
    weights->SetNumberOfTuples(static_cast<vtkIdType>(cloud.weights.size()));
    std::copy(cloud.weights.begin(), cloud.weights.end(), weights->GetPointer(0));
    output->GetPointData()->AddArray(weights);
  }
}

meam::PreciseCloud toPreciseCloud(vtkPointSet* input)
{
  meam::PreciseCloud cloud;
  if (input->GetNumberOfPoints() == 0)
  {
    return cloud;
  }
  cloud.points = toVectors<double>(input->GetPoints()->GetData());
  if (vtkDataArray* tangents = pointArray(input, "Tangent", 3))
  {
    cloud.tangents = toVectors<double>(tangents);
    for (Eigen::Vector3d& tangent : cloud.tangents)
    {
      // Of a cloud that comes from elsewhere; our own stay what they are to the last bit.
      const double length = tangent.norm();
      if (std::abs(length - 1.0) > NearlyUnit && length > 0.0)
      {
        tangent /= length;
      }
    }
  }
  if (vtkDataArray* weights = pointArray(input, "Weight", 1))
  {
    for (vtkIdType i = 0; i < weights->GetNumberOfTuples(); ++i)
    {
      cloud.weights.push_back(static_cast<float>(weights->GetComponent(i, 0)));
    }
  }
  return cloud;
}

void fromEdgeTangents(const meam::EdgeTangents& edges, vtkPointSet* input, vtkPolyData* output)
{
  meam::PointCloud cloud = toCloud(input).subset(edges.points);
  cloud.tangents.clear();
  cloud.weights = edges.weights;
  fromCloud(cloud, output);
  const auto count = static_cast<vtkIdType>(edges.points.size());
  vtkNew<vtkDoubleArray> tangents;
  tangents->SetName("Tangent");
  tangents->SetNumberOfComponents(3);
  tangents->SetNumberOfTuples(count);
  vtkDataArray* from = input->GetPoints()->GetData();
  const auto to = vtk::TakeSmartPointer(from->NewInstance());
  to->SetNumberOfComponents(3);
  to->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    tangents->SetTuple(i, edges.tangents[i].data());
    to->SetTuple(i, edges.points[i], from);
  }
  output->GetPointData()->SetVectors(tangents);
  vtkNew<vtkPoints> points;
  points->SetData(to);
  output->SetPoints(points);
  if (vtkDataArray* sources = edgeSourcesOf(input))
  {
    const auto kept = vtk::TakeSmartPointer(sources->NewInstance());
    kept->SetName(sources->GetName());
    for (const int i : edges.points)
    {
      kept->InsertNextTuple(i, sources);
    }
    output->GetPointData()->AddArray(kept);
  }
}

meam::OrganizedCloud toOrganizedCloud(vtkStructuredGrid* input)
{
  meam::OrganizedCloud cloud;
  requireLayer(input);
  int size[3];
  input->GetDimensions(size);
  const vtkIdType count = input->GetNumberOfPoints();
  if (count == 0 || !input->GetPoints() || input->GetPoints()->GetNumberOfPoints() != count)
  {
    return cloud;
  }
  cloud.width = size[0];
  cloud.height = size[1];
  cloud.points = toVectors<float>(input->GetPoints()->GetData());
  if (vtkUnsignedCharArray* ghosts = ghostsOf(input))
  {
    for (std::size_t i = 0; i < cloud.size(); ++i)
    {
      if (isHidden(ghosts, i))
      {
        cloud.points[i].setConstant(std::numeric_limits<float>::quiet_NaN());
      }
    }
  }
  return cloud;
}

void fromOrganizedCloud(const meam::OrganizedCloud& cloud, vtkStructuredGrid* output)
{
  output->SetDimensions(cloud.width, cloud.height, 1);
  output->SetPoints(toVTKPoints(cloud.points));
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfTuples(static_cast<vtkIdType>(cloud.size()));
  bool anyHidden = false;
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    const bool hidden = !cloud.points[i].allFinite();
    *ghosts->GetPointer(static_cast<vtkIdType>(i)) = hidden ? vtkDataSetAttributes::HIDDENPOINT : 0;
    anyHidden = anyHidden || hidden;
  }
  if (anyHidden)
  {
    output->GetPointData()->AddArray(ghosts);
  }
}

meam::Image imageOfCloud(vtkStructuredGrid* input)
{
  meam::Image image;
  int size[3];
  input->GetDimensions(size);
  image.width = size[0];
  image.height = size[1];
  vtkDataArray* pixels = pointArray(input, "Intensity", 1);
  if (!pixels)
  {
    pixels = pointArray(input, "RGB", 3);
    image.channels = 3;
  }
  if (!pixels)
  {
    throw Error(
      "The scene has no image: it needs the point array 'Intensity' or 'RGB', or connect the sensor's image.");
  }
  image.pixels = toPixels(pixels, image.channels);
  return image;
}

meam::Image toImage(vtkImageData* input)
{
  meam::Image image;
  int size[3];
  input->GetDimensions(size);
  vtkDataArray* scalars = input->GetPointData()->GetScalars();
  if (!scalars && input->GetPointData()->GetNumberOfArrays() == 1)
  {
    scalars = input->GetPointData()->GetArray(0);
  }
  if (!scalars || scalars->GetNumberOfTuples() == 0)
  {
    throw Error("The image has no pixels: check the file.");
  }
  if (size[2] != 1)
  {
    throw Error("The image has " + std::to_string(size[2]) + " layers: one is expected.");
  }
  const int components = scalars->GetNumberOfComponents();
  if (components != 1 && components != 3 && components != 4)
  {
    throw Error("The image has " + std::to_string(components) + " components: 1 (grey), 3 or 4 (colour) are expected.");
  }
  image.width = size[0];
  image.height = size[1];
  image.channels = components == 1 ? 1 : 3;
  const std::vector<std::uint8_t> upwards = toPixels(scalars, image.channels);
  const std::size_t row = static_cast<std::size_t>(image.width) * image.channels;
  image.pixels.reserve(upwards.size());
  for (int y = image.height - 1; y >= 0; --y)
  {
    image.pixels.insert(image.pixels.end(), upwards.begin() + y * row, upwards.begin() + (y + 1) * row);
  }
  return image;
}

void fromImage(const meam::Image& image, vtkImageData* output)
{
  output->SetDimensions(image.width, image.height, 1);
  vtkNew<vtkUnsignedCharArray> scalars;
  scalars->SetName(image.channels == 1 ? "Intensity" : "RGB");
  scalars->SetNumberOfComponents(image.channels);
  scalars->SetNumberOfTuples(static_cast<vtkIdType>(image.width) * image.height);
  const std::size_t row = static_cast<std::size_t>(image.width) * image.channels;
  for (int y = 0; y < image.height; ++y)
  {
    std::copy(image.pixels.begin() + y * row, image.pixels.begin() + (y + 1) * row,
      scalars->GetPointer(0) + (image.height - 1 - y) * row);
  }
  output->GetPointData()->SetScalars(scalars);
}

meam::Poses toPoses(vtkPolyData* input)
{
  meam::Poses poses;
  const vtkIdType count = input->GetNumberOfPoints();
  if (count == 0)
  {
    return poses;
  }
  vtkDataArray* transforms = pointArray(input, "Transform", 16);
  if (!transforms)
  {
    throw Error("The poses have no point array 'Transform' of 16 components: use the output of PoseDetection or of a "
                "pose file.");
  }
  vtkDataArray* scores = pointArray(input, "Score", 1);
  vtkDataArray* votes = pointArray(input, "Votes", 1);
  vtkDataArray* views = pointArray(input, "ViewId", 1);
  vtkDataArray* fractions = pointArray(input, "VisibleFraction", 1);
  vtkDataArray* certainties = pointArray(input, "Certainty", 1);
  vtkDataArray* probabilities = pointArray(input, "Probability", 1);
  vtkDataArray* residuals = pointArray(input, "Residual", 1);
  vtkDataArray* iterations = pointArray(input, "Iterations", 1);
  vtkDataArray* covariances = pointArray(input, "Covariance", 36);
  vtkDataArray* constrained = pointArray(input, "ConstrainedDegreesOfFreedom", 1);
  vtkDataArray* axes = pointArray(input, "ConstrainedAxes", 6);
  for (vtkIdType i = 0; i < count; ++i)
  {
    Eigen::Matrix<double, 4, 4, Eigen::RowMajor> matrix;
    transforms->GetTuple(i, matrix.data());
    const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
    if (!matrix.allFinite() || !matrix.row(3).isApprox(Eigen::RowVector4d(0, 0, 0, 1), 1e-6) ||
        !(rotation.transpose() * rotation).isIdentity(1e-3) || rotation.determinant() < 0.0)
    {
      throw Error("Pose " + std::to_string(i) +
                  " is not a rotation and a translation: 'Transform' has to be 4 x 4, "
                  "row by row, with the last row 0 0 0 1.");
    }
    meam::Pose pose;
    pose.T_scene_model.matrix() = matrix;
    if (!(rotation.transpose() * rotation).isIdentity(ExactRotation))
    {
      pose.T_scene_model.linear() = Eigen::Quaterniond(rotation).normalized().toRotationMatrix();
    }
    pose.score = scores ? scores->GetComponent(i, 0) : 0.0;
    pose.votes = votes ? static_cast<int>(votes->GetComponent(i, 0)) : 0;
    pose.viewId = views ? static_cast<int>(views->GetComponent(i, 0)) : -1;
    pose.visibleFraction = fractions ? fractions->GetComponent(i, 0) : 0.0;
    pose.certainty = certainties ? certainties->GetComponent(i, 0) : 1.0;
    pose.probability = probabilities ? probabilities->GetComponent(i, 0) : 0.0;
    if (residuals && iterations && covariances && constrained && axes)
    {
      pose.fit.residual = residuals->GetComponent(i, 0);
      pose.fit.iterations = static_cast<int>(iterations->GetComponent(i, 0));
      covariances->GetTuple(i, pose.fit.covariance.data());
      pose.fit.constrained = static_cast<int>(constrained->GetComponent(i, 0));
      axes->GetTuple(i, pose.fit.constrainedAxes.data());
    }
    poses.push_back(pose);
  }
  return poses;
}

void fromPoses(const meam::Poses& poses, vtkPolyData* output)
{
  const auto count = static_cast<vtkIdType>(poses.size());
  const auto doubles = [&](const char* name, int components)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(count);
    output->GetPointData()->AddArray(array);
    return array->GetPointer(0); // the point data keeps it
  };
  const auto integers = [&](const char* name)
  {
    vtkNew<vtkIntArray> array;
    array->SetName(name);
    array->SetNumberOfTuples(count);
    output->GetPointData()->AddArray(array);
    return array->GetPointer(0);
  };
  double* transform = doubles("Transform", 16);
  double* quaternion = doubles("Quaternion", 4);
  double* score = doubles("Score", 1);
  double* probability = doubles("Probability", 1);
  int* votes = integers("Votes");
  int* view = integers("ViewId");
  double* fraction = doubles("VisibleFraction", 1);
  double* certainty = doubles("Certainty", 1);
  int* rank = integers("Rank");
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    const meam::Pose& pose = poses[i];
    Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(transform + 16 * i) = pose.T_scene_model.matrix();
    Eigen::Quaterniond turn(pose.T_scene_model.linear());
    turn.normalize();
    if (turn.w() < 0.0)
    {
      turn.coeffs() *= -1.0;
    }
    Eigen::Map<Eigen::Vector4d>(quaternion + 4 * i) = turn.coeffs(); // x y z w
    score[i] = pose.score;
    votes[i] = pose.votes;
    view[i] = pose.viewId;
    fraction[i] = pose.visibleFraction;
    certainty[i] = pose.certainty;
    probability[i] = pose.probability;
    rank[i] = static_cast<int>(i) + 1;
    points->SetPoint(i, pose.T_scene_model.translation().data());
  }
  if (std::any_of(poses.begin(), poses.end(), [](const meam::Pose& pose) { return pose.fit.iterations > 0; }))
  {
    double* residual = doubles("Residual", 1);
    int* iterations = integers("Iterations");
    double* covariance = doubles("Covariance", 36);
    int* constrained = integers("ConstrainedDegreesOfFreedom");
    double* axes = doubles("ConstrainedAxes", 6);
    for (vtkIdType i = 0; i < count; ++i)
    {
      const meam::PoseFit& fit = poses[i].fit;
      residual[i] = fit.residual;
      iterations[i] = fit.iterations;
      Eigen::Map<Eigen::Matrix<double, 6, 6>>(covariance + 36 * i) = fit.covariance; // symmetric
      constrained[i] = fit.constrained;
      Eigen::Map<Eigen::Matrix<double, 6, 1>>(axes + 6 * i) = fit.constrainedAxes;
    }
  }
  output->SetPoints(points);
  addVertices(output);
  output->GetPointData()->SetActiveScalars("Score");
}

double diameterOf(vtkDataObject* input)
{
  vtkFieldData* fields = input ? input->GetFieldData() : nullptr;
  vtkDataArray* array = fields ? fields->GetArray("Diameter") : nullptr;
  const double value = array && array->GetNumberOfValues() == 1 ? array->GetComponent(0, 0) : 0.0;
  return value > 0.0 && std::isfinite(value) ? value : 0.0;
}

void setDiameter(vtkDataObject* output, double diameter) { setFieldValue(output, "Diameter", diameter); }

void setFieldValue(vtkDataObject* output, const char* name, double value)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  output->GetFieldData()->AddArray(array);
}

meam::Sensor sensorOf(
  int projection, const double viewDirection[3], const double sensorPosition[3], vtkDataSet* surface)
{
  int size[3] = { 0, 0, 0 };
  if (auto* grid = vtkStructuredGrid::SafeDownCast(surface))
  {
    grid->GetDimensions(size);
  }
  meam::Sensor sensor;
  if (projection == AutomaticProjection && size[0] > 1 && size[1] > 1 && size[2] == 1)
  {
    return sensor; // the data contract: an organized cloud is in its sensor's frame
  }
  const Eigen::Vector3d direction(viewDirection[0], viewDirection[1], viewDirection[2]);
  if (!direction.allFinite() || !(direction.norm() > 0.0))
  {
    throw Error("The view direction is zero: give the way the sensor looks, in the scene's coordinates.");
  }
  sensor.perspective = projection == PerspectiveProjection;
  sensor.direction = direction.normalized();
  sensor.position = Eigen::Vector3d(sensorPosition[0], sensorPosition[1], sensorPosition[2]);
  return sensor;
}

meam::PreciseCloud edgesOf(vtkPointSet* input)
{
  const meam::PreciseCloud all = toPreciseCloud(input);
  meam::PreciseCloud finite;
  for (std::size_t i = 0; i < all.points.size(); ++i)
  {
    const bool directed = all.tangents.empty() || (all.tangents[i].allFinite() && !all.tangents[i].isZero());
    if (!all.points[i].allFinite() || !directed)
    {
      continue;
    }
    finite.points.push_back(all.points[i]);
    if (!all.tangents.empty())
    {
      finite.tangents.push_back(all.tangents[i]);
    }
    if (!all.weights.empty())
    {
      finite.weights.push_back(all.weights[i]);
    }
  }
  meam::requirePoints(all.points.size(), finite.points.size(), "The scene's edge cloud");
  if (finite.tangents.empty())
  {
    throw Error("The scene's edge points have no point array 'Tangent': use TangentEstimation first.");
  }
  return finite;
}

meam::FramedPoints surfaceOf(vtkDataSet* input, const char* what, int threads)
{
  auto* measured = vtkPointSet::SafeDownCast(input);
  if (!measured)
  {
    return {};
  }
  auto* grid = vtkStructuredGrid::SafeDownCast(measured);
  if (grid)
  {
    requireLayer(grid);
  }
  vtkDataArray* array = measured->GetNumberOfPoints() > 0 ? measured->GetPoints()->GetData() : nullptr;
  const std::size_t count = array ? array->GetNumberOfTuples() : 0;
  vtkUnsignedCharArray* ghosts = grid ? ghostsOf(grid) : nullptr;
  meam::FramedPoints surface;
  if (auto* floats = vtkFloatArray::FastDownCast(array))
  {
    surface = seenPoints(floats->GetPointer(0), count, ghosts, threads);
  }
  else if (count > 0)
  {
    const meam::PrecisePoints points = toVectors<double>(array);
    surface = seenPoints(points.front().data(), count, ghosts, threads);
  }
  meam::requirePoints(count, surface.points.size(), what);
  return surface;
}

meam::Scene sceneOf(vtkPointSet* edges, vtkDataSet* surface, const meam::Sensor& sensor, int threads)
{
  return meam::sceneInOwnFrame(edgesOf(edges), surfaceOf(surface, "The scene's surface", threads), sensor);
}

meam::Progress progressOf(vtkAlgorithm* filter)
{
  return [filter](double share)
  {
    filter->UpdateProgress(share);
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20220614)
    return !filter->CheckAbort();
#else
    return filter->GetAbortExecute() == 0;
#endif
  };
}
}
