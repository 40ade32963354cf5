// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPCDReader.h"

#include "io/PCDFile.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMScanConversion.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStructuredGrid.h"
#include "vtksys/SystemTools.hxx"

vtkStandardNewMacro(vtkMEAMPCDReader);

namespace
{
/// Width and height, or zeros for a file that cannot be read: RequestData says what is wrong with it.
std::array<int, 2> sizeOf(const char* fileName)
{
  try
  {
    return meam::readPCDSize(fileName ? fileName : "");
  }
  catch (const std::exception&)
  {
    return { 0, 0 };
  }
}
}

vtkMEAMPCDReader::vtkMEAMPCDReader() { this->SetNumberOfInputPorts(0); }

vtkMEAMPCDReader::~vtkMEAMPCDReader() { this->SetFileName(nullptr); }

int vtkMEAMPCDReader::CanReadFile(const char* fileName)
{
  const std::string name = fileName ? fileName : "";
  const std::string extension = vtksys::SystemTools::LowerCase(vtksys::SystemTools::GetFilenameLastExtension(name));
  return extension == ".pcd" && sizeOf(fileName)[0] > 0 ? 1 : 0;
}

int vtkMEAMPCDReader::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPointSet");
  return 1;
}

int vtkMEAMPCDReader::RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  const bool organized = sizeOf(this->FileName)[1] > 1;
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

int vtkMEAMPCDReader::RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  const std::array<int, 2> size = sizeOf(this->FileName);
  if (size[1] > 1)
  {
    const int extent[6] = { 0, size[0] - 1, 0, size[1] - 1, 0, 0 };
    outputVector->GetInformationObject(0)->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  }
  return 1;
}

int vtkMEAMPCDReader::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  auto* output = vtkPointSet::GetData(outputVector);
  return vtkMEAMRun(
    this,
    [&]
    {
      if (!this->FileName || !*this->FileName)
      {
        throw meam::Error("No file is given: set FileName to the name of a PCD file.");
      }
      meam::MeasuredCloud data = meam::readPCD(this->FileName, vtkMEAMConversion::progressOf(this));
      meam::requirePoints(data.cloud.points, std::string("The PCD file '") + this->FileName + "'");
      for (auto& point : data.cloud.points)
      {
        point *= static_cast<float>(this->Scale);
      }
      vtkMEAMConversion::fromMeasuredCloud(data, output);
    },
    output);
}

void vtkMEAMPCDReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Scale: " << this->Scale << "\n";
}
