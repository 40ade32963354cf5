// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMCloudReader.h"

#include "io/CameraFile.h"
#include "scene/preparation/CloudOrganization.h"
#include "scene/preparation/ScanPreparation.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMScanConversion.h"
#include "vtkMEAMSceneConversion.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStructuredGrid.h"
#include "vtksys/SystemTools.hxx"

#include <algorithm>
#include <fstream>

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

std::optional<std::string> vtkMEAMCloudReader::StartOf(
  const char* fileName, std::initializer_list<const char*> extensions)
{
  const std::string name = fileName ? fileName : "";
  const std::string extension = vtksys::SystemTools::LowerCase(vtksys::SystemTools::GetFilenameLastExtension(name));
  std::ifstream file(name, std::ios::binary);
  if (!file || vtksys::SystemTools::FileIsDirectory(name) ||
      std::find(extensions.begin(), extensions.end(), extension) == extensions.end())
  {
    return std::nullopt;
  }
  std::string start(4, ' ');
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(file.gcount()));
  return start;
}

bool vtkMEAMCloudReader::HasCamera() const
{
  return (this->CameraFile && *this->CameraFile) || this->FocalLength[0] > 0.0;
}

int vtkMEAMCloudReader::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPointSet");
  return 1;
}

int vtkMEAMCloudReader::RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  const bool organized = this->HasCamera() || this->GridSize()[1] > 1;
  vtkInformation* info = outputVector->GetInformationObject(0);
  vtkDataObject* present = info->Get(vtkDataObject::DATA_OBJECT());
  if (!present || !present->IsA(organized ? "vtkStructuredGrid" : "vtkPolyData"))
  {
    vtkSmartPointer<vtkPointSet> output;
    if (organized)
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

int vtkMEAMCloudReader::RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  std::array<int, 2> size = this->GridSize();
  if (this->HasCamera())
  {
    // Of a camera that cannot be read something is promised, so that RequestData is asked and says what is wrong.
    size = { 1, 1 };
    try
    {
      const meam::Camera camera =
        cameraWithSize(this->CameraFile, this->FocalLength, this->PrincipalPoint, this->ImageSize);
      size = { std::max(camera.width, 1), std::max(camera.height, 1) };
    }
    catch (const meam::Error&)
    {
    }
  }
  if (this->HasCamera() || size[1] > 1)
  {
    const int extent[6] = { 0, size[0] - 1, 0, size[1] - 1, 0, 0 };
    outputVector->GetInformationObject(0)->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  }
  return 1;
}

int vtkMEAMCloudReader::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  auto* output = vtkPointSet::GetData(outputVector);
  const auto work = [&]
  {
    vtkMEAMConversion::requireFileName(this->FileName, "the name of a cloud's file");
    const meam::Progress progress = vtkMEAMConversion::progressOf(this);
    meam::MeasuredCloud measured = this->Read(meam::subProgress(progress, 0.0, this->HasCamera() ? 0.5 : 1.0));
    meam::requirePoints(measured.cloud.points, std::string("The file '") + this->FileName + "'");
    for (auto& point : measured.cloud.points)
    {
      point *= static_cast<float>(this->Scale);
    }
    if (measured.T_cloud_sensor)
    {
      measured.T_cloud_sensor->translation() *= this->Scale;
    }
    if (this->HasCamera())
    {
      const meam::Camera camera =
        cameraWithSize(this->CameraFile, this->FocalLength, this->PrincipalPoint, this->ImageSize);
      measured = meam::organizeCloud(measured, camera, meam::subProgress(progress, 0.5, 1.0));
    }
    vtkMEAMConversion::fromMeasuredCloud(measured, output);
    vtkMEAMConversion::fromSensor(meam::sensorOfFile(measured), output);
  };
  return vtkMEAMRun(this, work, output);
}

void vtkMEAMCloudReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Scale: " << this->Scale << "\n";
  os << indent << "ImageSize: " << this->ImageSize[0] << ", " << this->ImageSize[1] << " pixels\n";
}
