// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMSymmetryDetection.h"

#include "mesh/ConvexHull.h"
#include "mesh/SymmetryDetection.h"
#include "vtkMEAMConversion.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>

vtkStandardNewMacro(vtkMEAMSymmetryDetection);

namespace
{
constexpr double ReachShare = 0.1; // of the diameter: larger deviations are shown as this

vtkSmartPointer<vtkDoubleArray> newField(vtkDataObject* output, const char* name, int components)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  output->GetFieldData()->AddArray(array);
  return array;
}

void insertTransform(vtkDoubleArray* array, const Eigen::Isometry3d& T)
{
  const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> rows = T.matrix();
  array->InsertNextTuple(rows.data());
}
}

vtkMEAMSymmetryDetection::vtkMEAMSymmetryDetection()
{
  const meam::SymmetryDetectionSettings settings;
  this->Tolerance = settings.tolerance;
  this->LeastOverlap = settings.leastOverlap;
}

int vtkMEAMSymmetryDetection::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  const auto work = [&]
  {
    meam::SymmetryDetectionSettings settings;
    settings.tolerance = this->Tolerance;
    settings.leastOverlap = this->LeastOverlap;
    const meam::PointCloud surface = toCloud(input);
    const meam::Symmetries found = meam::detectSymmetries(surface, settings, progressOf(this));

    output->ShallowCopy(input);
    const auto discrete = newField(output, "SymmetriesDiscrete", 16);
    for (const auto& T : found.discrete)
    {
      insertTransform(discrete, T);
    }
    const auto continuous = newField(output, "SymmetriesContinuous", 6);
    for (const auto& symmetry : found.continuous)
    {
      Eigen::Matrix<double, 6, 1> line;
      line << symmetry.axis, symmetry.point;
      continuous->InsertNextTuple(line.data());
    }
    const auto near = newField(output, "NearSymmetries", 16);
    const auto overlap = newField(output, "NearSymmetryOverlap", 1);
    const auto largest = newField(output, "NearSymmetryDeviation", 1);
    for (const auto& symmetry : found.near)
    {
      insertTransform(near, symmetry.T);
      overlap->InsertNextValue(symmetry.overlap);
      largest->InsertNextValue(symmetry.deviation);
    }
    std::vector<float> deviation(surface.size(), 0.0f);
    if (this->ShownNearSymmetry < static_cast<int>(found.near.size()))
    {
      deviation = meam::surfaceDeviation(
        surface, found.near[this->ShownNearSymmetry].T, ReachShare * meam::diameter(surface.points));
    }
    vtkNew<vtkFloatArray> shown;
    shown->SetName("Deviation");
    shown->SetNumberOfTuples(static_cast<vtkIdType>(deviation.size()));
    std::copy(deviation.begin(), deviation.end(), shown->GetPointer(0));
    output->GetPointData()->SetScalars(shown);
  };
  return vtkMEAMRun(this, work, output);
}

void vtkMEAMSymmetryDetection::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "LeastOverlap: " << this->LeastOverlap << "\n";
  os << indent << "ShownNearSymmetry: " << this->ShownNearSymmetry << "\n";
}
