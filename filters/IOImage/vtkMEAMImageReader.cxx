// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMImageReader.h"

#include "io/ImageFile.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMScanConversion.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>

vtkStandardNewMacro(vtkMEAMImageReader);

namespace
{
/// Width and height, or zeros for a file that cannot be read: RequestData says what is wrong with it.
std::array<int, 2> sizeOf(const char* fileName)
{
  try
  {
    return meam::readImageSize(fileName ? fileName : "");
  }
  catch (const std::exception&)
  {
    return { 0, 0 };
  }
}
}

vtkMEAMImageReader::vtkMEAMImageReader() { this->SetNumberOfInputPorts(0); }

vtkMEAMImageReader::~vtkMEAMImageReader() { this->SetFileName(nullptr); }

int vtkMEAMImageReader::CanReadFile(const char* fileName) { return sizeOf(fileName)[0] > 0 ? 1 : 0; }

int vtkMEAMImageReader::RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  const std::array<int, 2> size = sizeOf(this->FileName);
  // Of a file that cannot be read a pixel is promised, so that RequestData is asked and says what is wrong.
  const int extent[6] = { 0, std::max(size[0], 1) - 1, 0, std::max(size[1], 1) - 1, 0, 0 };
  vtkInformation* info = outputVector->GetInformationObject(0);
  info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  if (size[0] > 0)
  {
    vtkDataObject::SetPointDataActiveScalarInfo(info, VTK_UNSIGNED_CHAR, -1); // how many tells only the whole file
  }
  return 1;
}

int vtkMEAMImageReader::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  auto* output = vtkImageData::GetData(outputVector);
  const auto work = [&]
  {
    vtkMEAMConversion::requireFileName(this->FileName, "the name of a PNG, JPEG, BMP or TIFF image");
    vtkMEAMConversion::fromImage(meam::readImage(this->FileName), output);
  };
  return vtkMEAMRun(this, work, output);
}

void vtkMEAMImageReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
}
