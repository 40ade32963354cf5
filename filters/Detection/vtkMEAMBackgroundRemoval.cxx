// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMBackgroundRemoval.h"

#include "scene/preparation/BackgroundRemoval.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMScanConversion.h"
#include "vtkMEAMSceneRequests.h"
#include "vtkMEAMSettings.h"

#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"

#include <limits>

vtkStandardNewMacro(vtkMEAMBackgroundRemoval);

namespace
{
Eigen::AlignedBox3f boxOf(const double region[6])
{
  constexpr float endless = std::numeric_limits<float>::infinity();
  Eigen::AlignedBox3f box(Eigen::Vector3f::Constant(-endless), Eigen::Vector3f::Constant(endless));
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = region[2 * axis];
    const double high = region[2 * axis + 1];
    if (!(low <= high))
    {
      throw meam::Error(
        "The region's least value along an axis is above its greatest one: set Region to xmin, xmax, ymin, ymax, "
        "zmin, zmax.");
    }
    if (low < high)
    {
      box.min()[axis] = static_cast<float>(low);
      box.max()[axis] = static_cast<float>(high);
    }
  }
  return box;
}
}

vtkMEAMBackgroundRemoval::vtkMEAMBackgroundRemoval()
  : Settings(new meam::BackgroundRemovalSettings)
{
  this->SetNumberOfInputPorts(2);
}

vtkMEAMBackgroundRemoval::~vtkMEAMBackgroundRemoval() = default;

vtkMEAMClampedSettingMacro(vtkMEAMBackgroundRemoval, NumberOfPlanes, int, planes, 0, 20)
vtkMEAMClampedSettingMacro(vtkMEAMBackgroundRemoval, Tolerance, double, tolerance, 0.0, VTK_DOUBLE_MAX)
vtkMEAMClampedSettingMacro(vtkMEAMBackgroundRemoval, LeastShare, double, leastShare, 0.0, 100.0)

int vtkMEAMBackgroundRemoval::FillInputPortInformation(int port, vtkInformation* info)
{
  using namespace vtkMEAMConversion;
  return port == 0 ? fillInputPort(info, { "vtkStructuredGrid" }, Connections::One)
                   : fillInputPort(info, { "vtkImageData" }, Connections::OneOrNone);
}

int vtkMEAMBackgroundRemoval::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  vtkMEAMSceneRequests::askForWhole(inputVector, 2);
  return 1;
}

int vtkMEAMBackgroundRemoval::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  auto* scene = vtkStructuredGrid::GetData(inputVector[0]);
  auto* maskInput = vtkImageData::GetData(inputVector[1]);
  auto* output = vtkStructuredGrid::GetData(outputVector, 0);
  return vtkMEAMRun(
    this,
    [&]
    {
      meam::BackgroundRemovalSettings settings = *this->Settings;
      settings.region = boxOf(this->Region);
      const meam::OrganizedCloud cloud = vtkMEAMConversion::toOrganizedCloud(scene);
      meam::Image mask;
      if (maskInput)
      {
        mask = vtkMEAMConversion::toImage(maskInput);
      }
      const meam::BackgroundRemoval found =
        meam::removeBackground(cloud, maskInput ? &mask : nullptr, settings, vtkMEAMConversion::progressOf(this));

      output->GetPointData()->ShallowCopy(scene->GetPointData());
      output->GetPointData()->RemoveArray(vtkDataSetAttributes::GhostArrayName());
      output->GetFieldData()->ShallowCopy(scene->GetFieldData());
      vtkMEAMConversion::fromOrganizedCloud(found.cloud, output);
      output->GetPointData()->AddArray(vtkMEAMConversion::arrayOf<vtkUnsignedCharArray>("Background", found.reasons));
      std::vector<double> planes;
      for (const auto& plane : found.planes)
      {
        planes.insert(planes.end(), plane.coeffs().data(), plane.coeffs().data() + 4);
      }
      output->GetFieldData()->AddArray(vtkMEAMConversion::arrayOf<vtkDoubleArray>("Planes", planes, 4));
    },
    output);
}

void vtkMEAMBackgroundRemoval::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Region:";
  for (const double value : this->Region)
  {
    os << " " << value;
  }
  os << " mm\n";
  os << indent << "NumberOfPlanes: " << this->GetNumberOfPlanes() << "\n";
  os << indent << "Tolerance: " << this->GetTolerance() << " mm\n";
  os << indent << "LeastShare: " << this->GetLeastShare() << " %\n";
}
