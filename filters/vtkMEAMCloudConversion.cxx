// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMCloudConversion.h"

#include "base/Error.h"
#include "features/TangentEstimation.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMSceneEdgeConversion.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace vtkMEAMConversion
{
namespace
{
constexpr double NearlyUnit = 1e-4; // a length this near to 1 is 1 but for rounding

using meam::Error;
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
}
