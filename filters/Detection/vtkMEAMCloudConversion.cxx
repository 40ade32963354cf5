// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMCloudConversion.h"

#include "base/Error.h"
#include "base/Frames.h"
#include "features/TangentEstimation.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMSceneEdgeConversion.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace vtkMEAMConversion
{
namespace
{
constexpr double NearlyUnit = 1e-4; // a length this near to 1 is 1 but for rounding
constexpr double SamePlace = 1e-3;  // mm: a point that has been moved by no more lies where it was

using meam::Error;
/// The point array `Tangent`, made unit; none when it is not there. No direction becomes not finite.
meam::PrecisePoints unitTangents(vtkPointSet* input)
{
  meam::PrecisePoints tangents;
  if (vtkDataArray* array = pointArray(input, "Tangent", 3))
  {
    tangents = toVectors<double>(array);
    for (Eigen::Vector3d& tangent : tangents)
    {
      // Of a cloud that comes from elsewhere; our own stay what they are to the last bit.
      const double length = tangent.norm();
      if (std::abs(length - 1.0) > NearlyUnit)
      {
        tangent /= length;
      }
    }
  }
  return tangents;
}

/// The frame of the points that have a direction.
Eigen::Isometry3d principalFrameOf(meam::PrecisePoints points, const meam::PrecisePoints& tangents)
{
  for (std::size_t i = 0; i < tangents.size(); ++i)
  {
    if (!tangents[i].allFinite())
    {
      points[i] = tangents[i]; // not finite: has no part in it
    }
  }
  return meam::principalFrame(points);
}

/// The first point, the middle one and the last one.
std::array<std::size_t, 3> checkedPoints(std::size_t count) { return { 0, count / 2, count - 1 }; }

void setLocalFrame(vtkPolyData* output, const Eigen::Isometry3d& T_local_scene, const meam::Points& points)
{
  std::vector<float> check;
  for (const std::size_t i : checkedPoints(points.size()))
  {
    if (i < points.size())
    {
      check.insert(check.end(), points[i].data(), points[i].data() + 3);
    }
  }
  output->GetFieldData()->AddArray(frameOf("LocalFrame", T_local_scene));
  output->GetFieldData()->AddArray(arrayOf<vtkDoubleArray>("LocalFrameCheck", check, 3));
}

/// The frame that the points were thinned in; none when they have been moved or chosen from since.
std::optional<Eigen::Isometry3d> localFrameOf(vtkPointSet* input, const meam::PrecisePoints& points)
{
  vtkDataArray* frame = input->GetFieldData()->GetArray("LocalFrame");
  vtkDataArray* check = input->GetFieldData()->GetArray("LocalFrameCheck");
  if (!frame || !check || frame->GetNumberOfValues() != 16 || check->GetNumberOfValues() != 9)
  {
    return std::nullopt;
  }
  const auto value = [](vtkDataArray* array, int i)
  { return array->GetComponent(i / array->GetNumberOfComponents(), i % array->GetNumberOfComponents()); };
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  for (int i = 0; i < 12; ++i)
  {
    T.matrix()(i / 4, i % 4) = value(frame, i);
  }
  int row = 0;
  for (const std::size_t i : checkedPoints(points.size()))
  {
    const Eigen::Vector3d expected(value(check, 3 * row), value(check, 3 * row + 1), value(check, 3 * row + 2));
    if (!((T * points[i] - expected).norm() <= SamePlace))
    {
      return std::nullopt;
    }
    ++row;
  }
  return T;
}
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
    output->GetPointData()->AddArray(arrayOf<vtkIntArray>("PointId", cloud.pointIds));
  }
  if (!cloud.edgeTypes.empty())
  {
    output->GetPointData()->SetScalars( // what a view colours by
      arrayOf<vtkUnsignedCharArray>("EdgeType", cloud.edgeTypes));
  }
  if (!cloud.weights.empty())
  {
    output->GetPointData()->AddArray(arrayOf<vtkFloatArray>("Weight", cloud.weights));
  }
}

meam::LocalCloud toLocalCloud(vtkPointSet* input, int threads)
{
  if (input->GetNumberOfPoints() == 0)
  {
    return {};
  }
  const meam::PrecisePoints points = toVectors<double>(input->GetPoints()->GetData());
  const meam::PrecisePoints tangents = unitTangents(input);
  std::vector<float> weights;
  if (vtkDataArray* array = pointArray(input, "Weight", 1))
  {
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    {
      weights.push_back(static_cast<float>(array->GetComponent(i, 0)));
    }
  }
  const std::optional<Eigen::Isometry3d> frame = localFrameOf(input, points);
  meam::LocalCloud local = meam::toLocalCloud(
    points, tangents, std::move(weights), frame ? *frame : principalFrameOf(points, tangents), threads);
  local.fromScan = edgeSourcesOf(input) != nullptr;
  return local;
}

void fromThinnedEdges(const meam::ThinnedEdges& thinned, vtkPointSet* input, vtkPolyData* output)
{
  meam::PointCloud cloud = toCloud(input).subset(thinned.indices);
  cloud.tangents.clear();
  cloud.weights = thinned.edges.cloud.weights;
  fromCloud(cloud, output);
  const auto count = static_cast<vtkIdType>(thinned.indices.size());
  const Eigen::Isometry3d& T_local_scene = thinned.edges.T_local_scene;
  const Eigen::Matrix3d toScene = T_local_scene.linear().transpose();
  vtkNew<vtkDoubleArray> tangents;
  tangents->SetName("Tangent");
  tangents->SetNumberOfComponents(3);
  tangents->SetNumberOfTuples(count);
  vtkDataArray* from = input->GetPoints()->GetData();
  const auto to = vtk::TakeSmartPointer(from->NewInstance());
  to->SetNumberOfComponents(3);
  to->SetNumberOfTuples(count);
  const meam::PrecisePoints given = unitTangents(input); // stay as they came
  for (vtkIdType i = 0; i < count; ++i)
  {
    const int index = thinned.indices[i];
    const Eigen::Vector3d tangent =
      given.empty() ? (toScene * thinned.edges.cloud.tangents[i].cast<double>()).eval() : given[index];
    tangents->SetTuple(i, tangent.data());
    to->SetTuple(i, index, from);
  }
  output->GetPointData()->SetVectors(tangents);
  vtkNew<vtkPoints> points;
  points->SetData(to);
  output->SetPoints(points);
  setLocalFrame(output, T_local_scene, thinned.edges.cloud.points);
  if (vtkDataArray* sources = edgeSourcesOf(input))
  {
    const auto kept = vtk::TakeSmartPointer(sources->NewInstance());
    kept->SetName(sources->GetName());
    for (const int i : thinned.indices)
    {
      kept->InsertNextTuple(i, sources);
    }
    output->GetPointData()->AddArray(kept);
  }
}
}
