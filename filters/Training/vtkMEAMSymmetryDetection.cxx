// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMSymmetryDetection.h"

#include "base/Bounds.h"
#include "io/ModelsInfo.h"
#include "mesh/ConvexHull.h"
#include "mesh/symmetry/SymmetryDetection.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMCloudConversion.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMSettings.h"
#include "vtkMEAMSymmetryConversion.h"

#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkMEAMSymmetryDetection);

namespace
{
constexpr double ReachShare = 0.1; // of the diameter: larger deviations are shown as this
}

vtkMEAMSymmetryDetection::vtkMEAMSymmetryDetection()
  : Settings(new meam::SymmetryDetectionSettings)
{
}

vtkMEAMSymmetryDetection::~vtkMEAMSymmetryDetection() { this->SetModelsInfoFile(nullptr); }

vtkMEAMClampedSettingMacro(vtkMEAMSymmetryDetection, Tolerance, double, tolerance, 0.0, VTK_DOUBLE_MAX)
vtkMEAMClampedSettingMacro(vtkMEAMSymmetryDetection, LeastOverlap, double, leastOverlap, 0.0, 1.0)

int vtkMEAMSymmetryDetection::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  const auto work = [&]
  {
    const meam::PointCloud surface = toCloud(input);
    const bool known = this->ModelsInfoFile && *this->ModelsInfoFile;
    const meam::Symmetries exact =
      known ? meam::readModelsInfo(this->ModelsInfoFile, this->ObjectId) : meam::Symmetries();
    meam::Symmetries found = meam::detectSymmetries(surface, *this->Settings, progressOf(this));
    found = known ? meam::withKnownExact(found, exact) : found;

    output->ShallowCopy(input);
    setSymmetries(output, found);
    const double partDiameter = diameterOf(input) > 0.0 ? diameterOf(input) : meam::diameter(surface.points);
    setFieldText(output, "ModelsInfo", meam::modelsInfo(found, partDiameter, meam::bounds(surface.points)));
    std::vector<float> deviation(surface.size(), 0.0f);
    if (this->ShownNearSymmetry < static_cast<int>(found.near.size()))
    {
      deviation = meam::surfaceDeviation(
        surface, found.near[this->ShownNearSymmetry].T, ReachShare * meam::diameter(surface.points));
    }
    output->GetPointData()->SetScalars(arrayOf<vtkFloatArray>("Deviation", deviation));
  };
  return vtkMEAMRun(this, work, output);
}

void vtkMEAMSymmetryDetection::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Tolerance: " << this->GetTolerance() << "\n";
  os << indent << "LeastOverlap: " << this->GetLeastOverlap() << "\n";
  os << indent << "ShownNearSymmetry: " << this->ShownNearSymmetry << "\n";
  os << indent << "ModelsInfoFile: " << (this->ModelsInfoFile ? this->ModelsInfoFile : "(none)") << "\n";
  os << indent << "ObjectId: " << this->ObjectId << "\n";
}
