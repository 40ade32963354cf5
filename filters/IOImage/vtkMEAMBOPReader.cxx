// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMBOPReader.h"

#include "io/BOPDataset.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMPoseConversion.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMScanConversion.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStructuredGrid.h"

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkMEAMBOPReader);

/// The images in the order of the time steps; none, with what is wrong, when they cannot be listed.
class vtkMEAMBOPReader::Images
{
public:
  std::vector<meam::BOPImage> all;
  std::array<int, 2> size = { 1, 1 }; ///< of the first one
  std::string problem;
};

namespace
{
void fromTruth(const std::vector<meam::BOPInstance>& instances, int objectId, vtkPolyData* output)
{
  meam::Poses poses;
  std::vector<int> objects;
  for (const meam::BOPInstance& instance : instances)
  {
    if (objectId == 0 || instance.objectId == objectId)
    {
      poses.push_back(instance.pose);
      objects.push_back(instance.objectId);
    }
  }
  vtkMEAMConversion::fromPoses(poses, output);
  output->GetPointData()->AddArray(vtkMEAMConversion::arrayOf<vtkIntArray>("ObjectId", objects));
}
}

vtkMEAMBOPReader::vtkMEAMBOPReader()
  : Listed(std::make_unique<Images>())
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(2);
  this->SetSplit("test");
}

vtkMEAMBOPReader::~vtkMEAMBOPReader()
{
  this->SetFileName(nullptr);
  this->SetSplit(nullptr);
}

int vtkMEAMBOPReader::CanReadFile(const char* fileName)
{
  try
  {
    meam::listBOPImages(fileName ? fileName : "", this->Split ? this->Split : "");
    return 1;
  }
  catch (const meam::Error&)
  {
    return 0;
  }
}

int vtkMEAMBOPReader::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkStructuredGrid" : "vtkPolyData");
  return 1;
}

int vtkMEAMBOPReader::RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  // Of a folder that cannot be read something is promised, so that RequestData is asked and says what is wrong.
  *this->Listed = {};
  try
  {
    vtkMEAMConversion::requireFileName(this->FileName, "the folder of a BOP dataset or of one of its scenes");
    this->Listed->all = meam::listBOPImages(this->FileName, this->Split ? this->Split : "");
    this->Listed->size = meam::readBOPSize(this->Listed->all.front());
  }
  catch (const std::exception& error)
  {
    this->Listed->problem = error.what();
  }
  const int extent[6] = { 0, this->Listed->size[0] - 1, 0, this->Listed->size[1] - 1, 0, 0 };
  outputVector->GetInformationObject(0)->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  std::vector<double> times(this->Listed->all.size());
  for (std::size_t i = 0; i < times.size(); ++i)
  {
    times[i] = static_cast<double>(i);
  }
  for (int port = 0; port < 2; ++port)
  {
    vtkInformation* info = outputVector->GetInformationObject(port);
    info->Remove(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
    info->Remove(vtkStreamingDemandDrivenPipeline::TIME_RANGE());
    if (!times.empty())
    {
      const double range[2] = { times.front(), times.back() };
      info->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), times.data(), static_cast<int>(times.size()));
      info->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
    }
  }
  return 1;
}

int vtkMEAMBOPReader::RequestData(vtkInformation* request, vtkInformationVector**, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  auto* scan = vtkStructuredGrid::GetData(outputVector, 0);
  auto* truth = vtkPolyData::GetData(outputVector, 1);
  const auto work = [&]
  {
    if (!this->Listed->problem.empty())
    {
      throw meam::Error(this->Listed->problem);
    }
    vtkInformation* info =
      outputVector->GetInformationObject(std::max(request->Get(vtkExecutive::FROM_OUTPUT_PORT()), 0));
    const double asked = info->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP())
                           ? info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP())
                           : 0.0;
    const double last = static_cast<double>(this->Listed->all.size() - 1);
    const double step = std::clamp(std::isfinite(asked) ? std::round(asked) : 0.0, 0.0, last);
    const meam::BOPImage& image = this->Listed->all[static_cast<std::size_t>(step)];

    const meam::OrganizedCloud cloud = meam::readBOPDepth(image, progressOf(this));
    if (cloud.width != this->Listed->size[0] || cloud.height != this->Listed->size[1])
    {
      throw meam::Error("The images in '" + image.folder +
                        "' have another size than the first one: read scenes of "
                        "different sizes one by one.");
    }
    fromOrganizedCloud(cloud, scan);
    if (const auto colors = meam::readBOPColors(image, cloud))
    {
      addRegisteredImage(*colors, scan);
    }
    fromTruth(meam::readBOPTruth(image), this->ObjectId, truth);
    for (vtkDataObject* output : { static_cast<vtkDataObject*>(scan), static_cast<vtkDataObject*>(truth) })
    {
      setFieldValue(output, "SceneId", image.sceneId);
      setFieldValue(output, "ImageId", image.imageId);
      output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), step);
    }
  };
  return vtkMEAMRun(this, work, scan, truth);
}

void vtkMEAMBOPReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Split: " << (this->Split ? this->Split : "(none)") << "\n";
  os << indent << "ObjectId: " << this->ObjectId << "\n";
}
