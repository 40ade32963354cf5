// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPoseWriter.h"

#include "calibration/RobotFrameFile.h"
#include "io/DetectionArrayFile.h"
#include "io/PoseFile.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMPoseConversion.h"
#include "vtkMEAMRun.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtksys/SystemTools.hxx"

#include <cmath>
#include <string_view>

vtkStandardNewMacro(vtkMEAMPoseWriter);

namespace
{
int formatOf(const std::string& fileName)
{
  constexpr std::string_view detections = ".detections.json";
  const std::string name = vtksys::SystemTools::LowerCase(fileName);
  if (name.size() >= detections.size() && name.substr(name.size() - detections.size()) == detections)
  {
    return vtkMEAMPoseWriter::DETECTIONS;
  }
  const std::string extension = vtksys::SystemTools::LowerCase(vtksys::SystemTools::GetFilenameLastExtension(fileName));
  if (extension == ".csv" || extension == ".bop")
  {
    return vtkMEAMPoseWriter::BOP_CSV;
  }
  if (extension == ".json")
  {
    return vtkMEAMPoseWriter::JSON;
  }
  if (extension == ".txt" || extension == ".poses")
  {
    return vtkMEAMPoseWriter::MATRICES;
  }
  throw meam::Error("The file '" + fileName +
                    "' was not written: poses go to .csv or .bop (BOP results), .json, .detections.json (ROS 2), .txt "
                    "or .poses (4x4 matrices); choose one of these extensions, or set Format.");
}
}

vtkMEAMPoseWriter::vtkMEAMPoseWriter() { this->SetFrameId("camera"); }

vtkMEAMPoseWriter::~vtkMEAMPoseWriter()
{
  this->SetFileName(nullptr);
  this->SetFrameId(nullptr);
  this->SetRobotFrameFile(nullptr);
}

namespace
{
/// A number that a pose has, or all poses have; 0 where it is not known.
int numberOf(vtkPolyData* poses, const char* name, vtkIdType pose)
{
  vtkDataArray* ofEach = poses->GetPointData()->GetArray(name);
  vtkDataArray* ofAll = poses->GetFieldData()->GetArray(name);
  return ofEach                                     ? vtkMEAMConversion::wholeIn(ofEach, pose)
         : ofAll && ofAll->GetNumberOfValues() == 1 ? vtkMEAMConversion::wholeIn(ofAll, 0)
                                                    : 0;
}
}

int vtkMEAMPoseWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

vtkTypeBool vtkMEAMPoseWriter::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkMEAMConversion::requestPiece(request, inputVector, this->Piece, this->NumberOfPieces);
  return this->Superclass::ProcessRequest(request, inputVector, outputVector);
}

void vtkMEAMPoseWriter::WriteData()
{
  if (this->Piece > 0)
  {
    return;
  }
  auto* input = vtkPolyData::SafeDownCast(this->GetInput());
  const int done = vtkMEAMRun(this,
    [&]
    {
      vtkMEAMConversion::requireFileName(this->FileName, "the name of the file to write");
      const int format = this->Format == BY_EXTENSION ? formatOf(this->FileName) : this->Format;
      vtkDataArray* seconds = input->GetFieldData()->GetArray("SecondsTotal");
      const double measured = seconds && seconds->GetNumberOfValues() == 1 ? seconds->GetComponent(0, 0) : -1.0;
      vtkDataArray* parts = input->GetPointData()->GetArray("PartId");
      vtkDataArray* ranks = input->GetPointData()->GetArray("Rank");
      std::vector<meam::PoseRow> rows;
      const auto known = [&](const char* name)
      {
        vtkDataArray* values = input->GetPointData()->GetArray(name);
        return values && std::isfinite(values->GetComponent(rows.size(), 0));
      };
      meam::Poses poses = vtkMEAMConversion::toPoses(input);
      if (this->MaximumNumberOfPoses > 0 && poses.size() > static_cast<std::size_t>(this->MaximumNumberOfPoses))
      {
        poses.resize(this->MaximumNumberOfPoses);
      }
      if (this->RobotFrameFile && *this->RobotFrameFile)
      {
        const Eigen::Isometry3d T_robot_camera = meam::readRobotFrame(this->RobotFrameFile);
        for (meam::Pose& pose : poses)
        {
          pose = meam::moved(pose, T_robot_camera);
        }
      }
      for (const meam::Pose& pose : poses)
      {
        meam::PoseRow row;
        row.sceneId = this->SceneId >= 0 ? this->SceneId : numberOf(input, "SceneId", rows.size());
        row.imageId = this->ImageId >= 0 ? this->ImageId : numberOf(input, "ImageId", rows.size());
        row.objectId = this->ObjectId + (parts ? vtkMEAMConversion::wholeIn(parts, rows.size()) : 0);
        row.T_scene_model = pose.T_scene_model;
        row.score = meam::probabilityOrScore(pose);
        row.time = this->Time >= 0.0 ? this->Time : measured;
        row.rank = ranks ? vtkMEAMConversion::wholeIn(ranks, rows.size()) : static_cast<int>(rows.size()) + 1;
        row.viewId = pose.viewId;
        if (known("Votes"))
        {
          row.votes = pose.votes;
        }
        if (known("VisibleFraction"))
        {
          row.visibleFraction = pose.visibleFraction;
        }
        if (pose.placeProbability > 0.0)
        {
          row.placeProbability = pose.placeProbability;
        }
        if (pose.probability > 0.0)
        {
          row.probability = pose.probability;
        }
        if (known("Certainty"))
        {
          row.certainty = pose.certainty;
        }
        if (pose.fit.iterations > 0)
        {
          row.covariance = pose.fit.covariance;
        }
        rows.push_back(row);
      }
      switch (format)
      {
        case BOP_CSV:
          meam::writeBOP(this->FileName, rows);
          break;
        case JSON:
          meam::writeJSON(this->FileName, rows);
          break;
        case DETECTIONS:
        {
          meam::DetectionArrayHeader header;
          header.frame = this->FrameId ? this->FrameId : "";
          header.stamp = this->Stamp;
          meam::writeDetections(this->FileName, rows, vtkMEAMConversion::partExtentOf(input), header);
          break;
        }
        default:
          meam::writeMatrices(this->FileName, rows);
          break;
      }
    });
  this->SetErrorCode(done ? vtkErrorCode::NoError : vtkErrorCode::CannotOpenFileError);
}

void vtkMEAMPoseWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfPieces: " << this->NumberOfPieces << "\n";
  os << indent << "Piece: " << this->Piece << "\n";
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Format: " << this->Format << "\n";
  os << indent << "MaximumNumberOfPoses: " << this->MaximumNumberOfPoses << "\n";
  os << indent << "SceneId: " << this->SceneId << "\n";
  os << indent << "ImageId: " << this->ImageId << "\n";
  os << indent << "ObjectId: " << this->ObjectId << "\n";
  os << indent << "Time: " << this->Time << " s\n";
  os << indent << "RobotFrameFile: " << (this->RobotFrameFile ? this->RobotFrameFile : "(none)") << "\n";
  os << indent << "FrameId: " << (this->FrameId ? this->FrameId : "(none)") << "\n";
  os << indent << "Stamp: " << this->Stamp << " s\n";
}
