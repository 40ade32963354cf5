// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMDepthImageReader.h"

#include "io/CameraFile.h"
#include "io/DepthImage.h"
#include "io/ImageFile.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMScanConversion.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStructuredGrid.h"

vtkStandardNewMacro(vtkMEAMDepthImageReader);

vtkMEAMDepthImageReader::~vtkMEAMDepthImageReader() { this->SetImageFileName(nullptr); }

int vtkMEAMDepthImageReader::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkStructuredGrid");
  return 1;
}

int vtkMEAMDepthImageReader::RequestDataObject(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  if (!vtkStructuredGrid::GetData(outputVector))
  {
    vtkNew<vtkStructuredGrid> output;
    outputVector->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), output);
  }
  return 1;
}

int vtkMEAMDepthImageReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  // Of a file that cannot be read something is promised, so that RequestData is asked and says what is wrong.
  std::array<int, 2> size = { 1, 1 };
  try
  {
    size = meam::readImageSize(this->FileName ? this->FileName : "");
  }
  catch (const meam::Error&)
  {
  }
  const int extent[6] = { 0, size[0] - 1, 0, size[1] - 1, 0, 0 };
  outputVector->GetInformationObject(0)->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  return 1;
}

int vtkMEAMDepthImageReader::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  auto* output = vtkStructuredGrid::GetData(outputVector);
  const auto work = [&]
  {
    vtkMEAMConversion::requireFileName(this->FileName, "the name of a depth image");
    const meam::CameraFile calibration =
      vtkMEAMConversion::calibrationOf(this->CameraFile, this->FocalLength, this->PrincipalPoint);
    const double scale = this->DepthScale != 0.0 ? this->DepthScale : calibration.depthScale;
    const meam::OrganizedCloud cloud =
      meam::readDepthImage(this->FileName, calibration.camera, scale, vtkMEAMConversion::progressOf(this));
    meam::requirePoints(cloud.points, std::string("The depth image '") + this->FileName + "'");
    vtkMEAMConversion::fromOrganizedCloud(cloud, output);
    if (this->ImageFileName && *this->ImageFileName)
    {
      const meam::Image image = meam::readImage(this->ImageFileName);
      meam::requireRegistered(image, cloud, this->ImageFileName);
      vtkMEAMConversion::addRegisteredImage(image, output);
    }
  };
  return vtkMEAMRun(this, work, output);
}

void vtkMEAMDepthImageReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ImageFileName: " << (this->ImageFileName ? this->ImageFileName : "(none)") << "\n";
  os << indent << "DepthScale: " << this->DepthScale << "\n";
}
