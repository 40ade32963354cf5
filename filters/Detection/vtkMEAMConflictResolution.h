// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMConflictResolution
 * @brief Several types of part in one scene: of poses that claim the same surface the best supported stays.
 *
 * Each type is looked for by itself; this filter brings the poses together. Two poses, of different parts or of one,
 * are in conflict when more than MaximumShared of the measured points that either explains are explained by the other,
 * too. The pose stays that has the larger odds of its place times the measured points that it explains, less
 * those that it predicts and the sensor saw past or did not measure. A small part that fits on a face of a larger one
 * loses against it; one that lies on top of it stays.
 *
 * Input port 0, repeatable: vtkPolyData, the verified poses of each part (vtkMEAMPoseVerification or
 * vtkMEAMPoseEstimation): `Transform`, `PlaceProbability`, `Probability`, `Score`, `VisibleFraction`.
 * Input port 1, repeatable: vtkPartitionedDataSetCollection, the trained model of each part (vtkMEAMHashing), in the
 * same order.
 * Input port 2: vtkPolyData, edge points of the scene in mm with `Tangent` (vtkMEAMTangentEstimation).
 * Input port 3, optional: vtkPointSet, all points the sensor measured, in mm. Without it edges are compared.
 *
 * Output port 0: vtkPolyData, the poses of all parts that stay, best first, with the arrays of
 * vtkMEAMPoseVerification, `Rank` over all of them, and `PartId` (int, index of the connection). Field data:
 * `Diameter` (mm), a value for each part.
 */
#ifndef vtkMEAMConflictResolution_h
#define vtkMEAMConflictResolution_h

#include "vtkMEAMSensorAlgorithm.h"

#include <memory>

namespace meam
{
struct ConflictResolutionSettings;
}

class PPFMEAMDETECTION_EXPORT vtkMEAMConflictResolution : public vtkMEAMSensorAlgorithm
{
public:
  static vtkMEAMConflictResolution* New();
  vtkTypeMacro(vtkMEAMConflictResolution, vtkMEAMSensorAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Takes the models of all parts away; one is added by AddInputConnection(1, ...). */
  void RemoveAllModelConnections() { this->RemoveAllInputConnections(1); }

  /** Poses that share more of what they explain, in [0, 1], are in conflict; 1: none are. Default: 0.5. */
  vtkMEAMDeclareSettingMacro(MaximumShared, double);

  /** Poses that come out, the best ones of all parts; 0: all that stay. Default: 0. */
  vtkMEAMDeclareSettingMacro(MaximumNumberOfPoses, int);

protected:
  vtkMEAMConflictResolution();
  ~vtkMEAMConflictResolution() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  std::unique_ptr<meam::ConflictResolutionSettings> Settings;
};

#endif
