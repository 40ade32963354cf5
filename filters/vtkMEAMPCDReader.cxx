// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPCDReader.h"

#include "io/PCDFile.h"
#include "vtkMEAMConversion.h"

#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtksys/SystemTools.hxx"

#include <algorithm>
#include <cmath>

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

vtkSmartPointer<vtkUnsignedCharArray> newBytes(const char* name, int components, std::size_t tuples)
{
  auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(tuples));
  return array;
}

void addIntensity(const std::vector<float>& intensities, const std::vector<int>& kept, vtkDataSet* output)
{
  float largest = 0.0f;
  bool whole = true;
  for (const float value : intensities)
  {
    if (std::isfinite(value))
    {
      largest = std::max(largest, value);
      whole = whole && value >= 0.0f && value == std::floor(value);
    }
  }
  const float factor = (whole && largest <= 255.0f) || largest <= 0.0f ? 1.0f : 255.0f / largest;
  const auto array = newBytes("Intensity", 1, kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i)
  {
    const float value = std::round(factor * intensities[kept[i]]);
    *array->GetPointer(static_cast<vtkIdType>(i)) =
      value > 0.0f ? static_cast<unsigned char>(std::min(value, 255.0f)) : 0; // NaN is black
  }
  output->GetPointData()->SetScalars(array);
}

void addNormals(const meam::Points& normals, vtkStructuredGrid* output)
{
  if (normals.empty())
  {
    return;
  }
  vtkNew<vtkFloatArray> array;
  array->SetName("Normals");
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(normals.size()));
  for (std::size_t i = 0; i < normals.size(); ++i)
  {
    std::copy_n(normals[i].data(), 3, array->GetPointer(3 * static_cast<vtkIdType>(i)));
  }
  output->GetPointData()->SetNormals(array);
}

void addColors(const std::vector<std::uint8_t>& colors, const std::vector<int>& kept, vtkDataSet* output)
{
  const auto array = newBytes("RGB", 3, kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i)
  {
    std::copy_n(&colors[3 * static_cast<std::size_t>(kept[i])], 3, array->GetPointer(3 * static_cast<vtkIdType>(i)));
  }
  output->GetPointData()->SetScalars(array);
}
}

vtkMEAMPCDReader::vtkMEAMPCDReader()
{
  this->SetNumberOfInputPorts(0);
}

vtkMEAMPCDReader::~vtkMEAMPCDReader()
{
  this->SetFileName(nullptr);
}

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
        throw meam::Error("No file is given: set the name of a PCD file.");
      }
      meam::PCDData data = meam::readPCD(this->FileName, vtkMEAMConversion::progressOf(this));
      meam::requirePoints(data.cloud.points, std::string("The PCD file '") + this->FileName + "'");
      for (auto& point : data.cloud.points)
      {
        point *= static_cast<float>(this->Scale);
      }

      auto* grid = vtkStructuredGrid::SafeDownCast(output);
      std::vector<int> kept;
      for (std::size_t i = 0; i < data.cloud.size(); ++i)
      {
        if (grid || data.cloud.points[i].allFinite())
        {
          kept.push_back(static_cast<int>(i));
        }
      }
      if (grid)
      {
        vtkMEAMConversion::fromOrganizedCloud(data.cloud, grid);
        addNormals(data.normals, grid);
      }
      else
      {
        meam::PointCloud cloud;
        cloud.points = std::move(data.cloud.points);
        cloud.normals = std::move(data.normals);
        vtkMEAMConversion::fromCloud(cloud.subset(kept), vtkPolyData::SafeDownCast(output));
      }
      if (!data.intensities.empty())
      {
        addIntensity(data.intensities, kept, output);
      }
      if (!data.colors.empty())
      {
        addColors(data.colors, kept, output);
      }
    },
    output);
}

void vtkMEAMPCDReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Scale: " << this->Scale << "\n";
}
