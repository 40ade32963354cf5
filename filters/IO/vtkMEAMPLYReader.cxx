// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPLYReader.h"

#include "io/CameraFile.h"
#include "io/PLYFile.h"
#include "scene/preparation/CloudOrganization.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMScanConversion.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStructuredGrid.h"

#include <algorithm>

vtkStandardNewMacro(vtkMEAMPLYReader);

namespace
{
/// The camera with the size that is set, if one is.
meam::Camera cameraWithSize(
  const char* file, const double focalLength[2], const double principalPoint[2], const int imageSize[2])
{
  meam::Camera camera = vtkMEAMConversion::calibrationOf(file, focalLength, principalPoint).camera;
  camera.width = imageSize[0] > 0 ? imageSize[0] : camera.width;
  camera.height = imageSize[1] > 0 ? imageSize[1] : camera.height;
  return camera;
}
}

bool vtkMEAMPLYReader::IsOrganized() const
{
  return (this->CameraFile && *this->CameraFile) || this->FocalLength[0] > 0.0;
}

int vtkMEAMPLYReader::CanReadFile(const char* fileName) { return fileName && meam::isPLYCloud(fileName) ? 1 : 0; }

int vtkMEAMPLYReader::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPointSet");
  return 1;
}

int vtkMEAMPLYReader::RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkInformation* info = outputVector->GetInformationObject(0);
  vtkDataObject* present = info->Get(vtkDataObject::DATA_OBJECT());
  if (!present || !present->IsA(this->IsOrganized() ? "vtkStructuredGrid" : "vtkPolyData"))
  {
    vtkSmartPointer<vtkPointSet> output;
    if (this->IsOrganized())
    {
      output = vtkSmartPointer<vtkStructuredGrid>::New();
    }
    else
    {
      output = vtkSmartPointer<vtkPolyData>::New();
    }
    info->Set(vtkDataObject::DATA_OBJECT(), output);
  }
  return 1;
}

int vtkMEAMPLYReader::RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  if (this->IsOrganized())
  {
    // Of a camera that cannot be read something is promised, so that RequestData is asked and says what is wrong.
    int extent[6] = { 0, 0, 0, 0, 0, 0 };
    try
    {
      const meam::Camera camera =
        cameraWithSize(this->CameraFile, this->FocalLength, this->PrincipalPoint, this->ImageSize);
      extent[1] = std::max(camera.width - 1, 0);
      extent[3] = std::max(camera.height - 1, 0);
    }
    catch (const meam::Error&)
    {
    }
    outputVector->GetInformationObject(0)->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  }
  return 1;
}

int vtkMEAMPLYReader::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  auto* output = vtkPointSet::GetData(outputVector);
  const auto work = [&]
  {
    if (!this->FileName || !*this->FileName)
    {
      throw meam::Error("No file is given: set FileName to the name of a PLY file.");
    }
    const meam::Progress progress = vtkMEAMConversion::progressOf(this);
    const bool organized = this->IsOrganized();
    meam::MeasuredCloud measured =
      meam::readPLYCloud(this->FileName, meam::subProgress(progress, 0.0, organized ? 0.5 : 1.0));
    meam::requirePoints(measured.cloud.points, std::string("The PLY file '") + this->FileName + "'");
    for (auto& point : measured.cloud.points)
    {
      point *= static_cast<float>(this->Scale);
    }
    if (organized)
    {
      const meam::Camera camera =
        cameraWithSize(this->CameraFile, this->FocalLength, this->PrincipalPoint, this->ImageSize);
      measured = meam::organizeCloud(measured, camera, meam::subProgress(progress, 0.5, 1.0));
    }
    vtkMEAMConversion::fromMeasuredCloud(measured, output);
  };
  return vtkMEAMRun(this, work, output);
}

void vtkMEAMPLYReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Scale: " << this->Scale << "\n";
  os << indent << "ImageSize: " << this->ImageSize[0] << ", " << this->ImageSize[1] << " pixels\n";
}
