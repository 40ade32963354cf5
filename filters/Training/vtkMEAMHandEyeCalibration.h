// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMHandEyeCalibration
 * @brief Where the camera is for the robot, from pairs of poses: hand-eye calibration (OpenCV).
 *
 * The file holds pairs of what the robot tells, T_base_gripper, and what the camera sees at the same moment,
 * T_camera_target: of a calibration target, or of a part that is found. Of OpenCV's methods the one comes out under
 * which the target moves least.
 *
 * Output port 0: a vtkPolyData, a vertex where the camera is, with the point array `Transform` (16, row-major
 * T_robot_camera, mm: to the robot's base of a camera beside it, to its gripper of one on it). Field data:
 * `ResidualShift` (mm) and `ResidualTurn` (degrees), root mean squares of the target's motion in the gripper, or in the
 * base of a camera on the gripper; `Method`; `CameraMount` ("beside" or "hand"); `Report`, in a sentence. Output port
 * 1: a vtkTable of `Pair` (from 1), `Shift` (mm) and `Turn` (degrees) of the target at each pair.
 */
#ifndef vtkMEAMHandEyeCalibration_h
#define vtkMEAMHandEyeCalibration_h

#include "ppfmeamTrainingModule.h"
#include "vtkMEAMPropertyMacros.h"
#include "vtkPolyDataAlgorithm.h"

class PPFMEAMTRAINING_EXPORT vtkMEAMHandEyeCalibration : public vtkPolyDataAlgorithm
{
public:
  static vtkMEAMHandEyeCalibration* New();
  vtkTypeMacro(vtkMEAMHandEyeCalibration, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The pairs of poses: JSON, or CSV with 32 numbers in a row. Default: none. */
  vtkMEAMFileMemberMacro(FileName);

  enum Mounts
  {
    AsInFile,
    Beside,
    Hand
  };

  ///@{
  /**
   * Where the camera is: as the file says, or else beside the robot (AsInFile, 0); beside the robot, which holds the
   * target (1); on its gripper (2). Default: 0.
   */
  vtkMEAMClampedMemberMacro(Mount, int, AsInFile, Hand);
  void SetMountToAsInFile() { this->SetMount(AsInFile); }
  void SetMountToBeside() { this->SetMount(Beside); }
  void SetMountToHand() { this->SetMount(Hand); }
  ///@}

  /**
   * Brings the output up to date and writes T_robot_camera: JSON in mm, or, when the name ends in .yaml or .yml, a
   * transform of ROS in metres. Returns 0 when that fails.
   */
  int WriteRobotFrame(const char* fileName);

protected:
  vtkMEAMHandEyeCalibration();
  ~vtkMEAMHandEyeCalibration() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  char* FileName = nullptr;
  int Mount = AsInFile;
};

#endif
