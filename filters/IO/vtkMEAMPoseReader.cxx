// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPoseReader.h"

#include "io/PoseFile.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMPoseConversion.h"
#include "vtkMEAMRun.h"

#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <utility>

vtkStandardNewMacro(vtkMEAMPoseReader);

namespace
{
/// What each pose is of, and its rank in the file.
void addIds(const std::vector<meam::PoseRow>& rows, vtkPolyData* output)
{
  const auto array = [&](const char* name, int meam::PoseRow::*number)
  { output->GetPointData()->AddArray(vtkMEAMConversion::columnOf<vtkIntArray>(name, rows, number)); };
  array("SceneId", &meam::PoseRow::sceneId);
  array("ImageId", &meam::PoseRow::imageId);
  array("ObjectId", &meam::PoseRow::objectId);
  if (std::all_of(rows.begin(), rows.end(), [](const meam::PoseRow& row) { return row.rank > 0; }))
  {
    array("Rank", &meam::PoseRow::rank);
  }
  output->GetPointData()->SetActiveScalars("Rank");
}

/// What no row knows; what some know is NaN of the others.
void removeUnknown(const std::vector<meam::PoseRow>& rows, vtkPolyData* output)
{
  const auto remove = [&](const char* name, const auto& isKnown)
  {
    if (!rows.empty() && std::none_of(rows.begin(), rows.end(), isKnown))
    {
      output->GetPointData()->RemoveArray(name);
    }
  };
  const std::pair<const char*, double meam::PoseRow::*> values[] = {
    { "VisibleFraction", &meam::PoseRow::visibleFraction }, { "PlaceProbability", &meam::PoseRow::placeProbability },
    { "Probability", &meam::PoseRow::probability }, { "Certainty", &meam::PoseRow::certainty }
  };
  for (const auto& [name, value] : values)
  {
    remove(name, [value = value](const meam::PoseRow& row) { return std::isfinite(row.*value); });
  }
  remove("Votes", [](const meam::PoseRow& row) { return row.votes >= 0; });
  remove("Evidence", [](const meam::PoseRow&) { return false; });
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
      vtkMEAMConversion::requireFileName(this->FileName, "the name of a pose file");
      const std::vector<meam::PoseRow> rows = meam::readPoses(this->FileName);
      meam::Poses poses;
      for (const meam::PoseRow& row : rows)
      {
        meam::Pose& pose = poses.emplace_back();
        pose.T_scene_model = row.T_scene_model;
        pose.score = row.score;
        pose.votes = std::max(0, row.votes);
        pose.viewId = row.viewId;
        pose.visibleFraction = row.visibleFraction;
        pose.placeProbability = row.placeProbability;
        pose.probability = row.probability;
        pose.certainty = row.certainty;
      }
      vtkMEAMConversion::fromPoses(poses, output);
      addIds(rows, output);
      removeUnknown(rows, output);
    },
    output);
}

void vtkMEAMPoseReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
}
