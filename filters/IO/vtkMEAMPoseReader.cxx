// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPoseReader.h"

#include "io/PoseFile.h"
#include "vtkMEAMPoseConversion.h"
#include "vtkMEAMRun.h"

#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkMEAMPoseReader);

namespace
{
/// What each pose is of, and its rank in the file.
void addIds(const std::vector<meam::PoseRow>& rows, vtkPolyData* output)
{
  const auto array = [&](const char* name, int meam::PoseRow::*number)
  {
    vtkNew<vtkIntArray> values;
    values->SetName(name);
    for (const meam::PoseRow& row : rows)
    {
      values->InsertNextValue(row.*number);
    }
    output->GetPointData()->AddArray(values);
  };
  array("SceneId", &meam::PoseRow::sceneId);
  array("ImageId", &meam::PoseRow::imageId);
  array("ObjectId", &meam::PoseRow::objectId);
  if (std::all_of(rows.begin(), rows.end(), [](const meam::PoseRow& row) { return row.rank > 0; }))
  {
    array("Rank", &meam::PoseRow::rank);
  }
  output->GetPointData()->SetActiveScalars("Rank");
}
}

vtkMEAMPoseReader::vtkMEAMPoseReader() { this->SetNumberOfInputPorts(0); }

vtkMEAMPoseReader::~vtkMEAMPoseReader() { this->SetFileName(nullptr); }

int vtkMEAMPoseReader::CanReadFile(const char* fileName)
{
  try
  {
    meam::readPoses(fileName ? fileName : "");
    return 1;
  }
  catch (const meam::Error&)
  {
    return 0;
  }
}

int vtkMEAMPoseReader::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  auto* output = vtkPolyData::GetData(outputVector);
  return vtkMEAMRun(
    this,
    [&]
    {
      if (!this->FileName || !*this->FileName)
      {
        throw meam::Error("No file is given: set FileName to the name of a pose file.");
      }
      const std::vector<meam::PoseRow> rows = meam::readPoses(this->FileName);
      meam::Poses poses;
      for (const meam::PoseRow& row : rows)
      {
        meam::Pose& pose = poses.emplace_back();
        pose.T_scene_model = row.T_scene_model;
        pose.score = row.score;
        pose.votes = std::max(0, row.votes);
        pose.viewId = row.viewId;
        pose.visibleFraction = std::isfinite(row.visibleFraction) ? row.visibleFraction : pose.visibleFraction;
        pose.placeProbability = std::isfinite(row.placeProbability) ? row.placeProbability : pose.placeProbability;
        pose.probability = std::isfinite(row.probability) ? row.probability : pose.probability;
        pose.certainty = std::isfinite(row.certainty) ? row.certainty : pose.certainty;
      }
      vtkMEAMConversion::fromPoses(poses, output);
      addIds(rows, output);
    },
    output);
}

void vtkMEAMPoseReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
}
