// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMPoseWriter
 * @brief Writes poses as the results CSV of the BOP benchmark, as JSON, as ROS 2 detections or as 4x4 matrices.
 *
 * The file appears whole or not at all; an older one is replaced only when everything went well.
 * Write() returns 0 when it did not.
 *
 * Input port 0: poses, a vtkPolyData with the point array `Transform` (16) and, where it is there,
 * `Score`, `PlaceProbability`, `Probability`, `Certainty`, `Votes`, `ViewId`, `VisibleFraction` and `Rank`; a pose's
 * score in the file is its probability, by which poses of all scenes can be ordered, or, where that is not known,
 * `Score`. The field data `SecondsTotal` becomes the time. Where there is `PartId` (vtkMEAMConflictResolution), the
 * parts are numbered from ObjectId on. Detections have a bounding box and the covariance of refined poses where the
 * field data `PartBounds` and `PartMiddle` are there, which detection adds.
 */
#ifndef vtkMEAMPoseWriter_h
#define vtkMEAMPoseWriter_h

#include "ppfmeamIOModule.h"
#include "vtkMEAMPropertyMacros.h"
#include "vtkWriter.h"

class PPFMEAMIO_EXPORT vtkMEAMPoseWriter : public vtkWriter
{
public:
  static vtkMEAMPoseWriter* New();
  vtkTypeMacro(vtkMEAMPoseWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The file to write. Default: none. */
  vtkMEAMFileMemberMacro(FileName);

  enum FileFormat
  {
    BY_EXTENSION,
    BOP_CSV,
    JSON,
    MATRICES,
    DETECTIONS
  };
  ///@{
  /**
   * 0: by the file's name, csv or bop, detections.json, any other json, txt or poses; 1:
   * scene_id,im_id,obj_id,score,R,t,time; 2: JSON with all that is known of a pose; 3: row-major 4x4 blocks; 4: JSON in
   * the shape of ROS 2's vision_msgs/Detection3DArray, lengths in metres. Default: 0.
   */
  vtkMEAMClampedMemberMacro(Format, int, BY_EXTENSION, DETECTIONS);
  void SetFormatToByExtension() { this->SetFormat(BY_EXTENSION); }
  void SetFormatToBOPCSV() { this->SetFormat(BOP_CSV); }
  void SetFormatToJSON() { this->SetFormat(JSON); }
  void SetFormatToMatrices() { this->SetFormat(MATRICES); }
  void SetFormatToDetections() { this->SetFormat(DETECTIONS); }
  ///@}

  /** Poses written, the best ones; 0 for all. Default: 0. */
  vtkMEAMClampedMemberMacro(MaximumNumberOfPoses, int, 0, VTK_INT_MAX);

  /** Number of the scene in its dataset; -1: that of the poses, the array or the field data `SceneId`, or 0. Default:
   * -1. */
  vtkMEAMMemberMacro(SceneId, int);

  /** Number of the image in its scene; -1: that of the poses, the array or the field data `ImageId`, or 0. Default: -1.
   */
  vtkMEAMMemberMacro(ImageId, int);

  /** Number of the part in its dataset; of several parts that of the first. Default: 1. */
  vtkMEAMMemberMacro(ObjectId, int);

  /**
   * Seconds that the image took; -1: the field data `SecondsTotal` of the poses, or not known.
   * Default: -1.
   */
  vtkMEAMMemberMacro(Time, double);

  /**
   * Where the camera is for the robot, T_robot_camera, as vtkMEAMHandEyeCalibration writes it or ROS has it: the poses
   * in the file are the robot's then. Default: none, the scan's frame.
   */
  vtkMEAMFileMemberMacro(RobotFrameFile);

  ///@{
  /** Detections: the name of the frame that the poses are in, the scan's or the robot's, in the robot's software.
   * Default: camera. */
  vtkSetStringMacro(FrameId);
  vtkGetStringMacro(FrameId);
  ///@}

  /** Detections: when the scan was taken, seconds since 1970; 0: not known. Default: 0. */
  vtkMEAMMemberMacro(Stamp, double);

  ///@{
  /** Of a server of several processes, each of which writes, how many they are and which this one is; the first has all
   * data and writes the file. Default: 1, and 0, the first. */
  vtkSetClampMacro(NumberOfPieces, int, 1, VTK_INT_MAX);
  vtkGetMacro(NumberOfPieces, int);
  vtkSetClampMacro(Piece, int, 0, VTK_INT_MAX);
  vtkGetMacro(Piece, int);
  ///@}

  vtkTypeBool ProcessRequest(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

protected:
  vtkMEAMPoseWriter();
  ~vtkMEAMPoseWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

private:
  int NumberOfPieces = 1;
  int Piece = 0;
  char* FileName = nullptr;
  int Format = BY_EXTENSION;
  int MaximumNumberOfPoses = 0;
  int SceneId = -1;
  int ImageId = -1;
  int ObjectId = 1;
  double Time = -1.0;
  char* RobotFrameFile = nullptr;
  char* FrameId = nullptr;
  double Stamp = 0.0;
};

#endif
