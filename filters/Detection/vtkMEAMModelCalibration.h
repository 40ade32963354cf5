// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMModelCalibration
 * @brief Fits the probabilities of a trained model's poses to scans in which it is known which are right.
 *
 * What detection says was fitted on simulated bins of many parts. Judged poses of a few dozen scans of one's own part,
 * sensor and bin say how it holds there; from then on places and rotations come out as they held (Platt 1999). Each is
 * changed only where that says more of scans that had no part in the fit.
 *
 * Input port 0: vtkPartitionedDataSetCollection, the trained model.
 * Input port 1: vtkPolyData, poses of all scans, best first in each, as the model found them, all of them or those that
 * were looked at: the point arrays `PlaceProbability`, `Certainty`, `Scene` (from 0), `CopyIsThere` (1: a copy is there
 * and no better pose has it) and `PoseOutcome` (0: it is also turned rightly). vtkMEAMPoseEvaluation's output 2 is
 * that.
 *
 * Output port 0: the same model, which says from now on what held.
 * Output port 1: vtkTable with a row for each class of claims: `Claim` ("place" or "pose", with its rotation), `Least`
 * and `Most` (of what was said), `Poses`, `Right` (share of them, 0 to 1), `Before` (mean of what was said) and `After`
 * (of what is said by a calibration on other scans than theirs). Field data: `LossBefore` and `LossAfter` (mean
 * logarithmic loss of a pose, nats), `Calibration` (constant and slope of the log odds of places, the same of
 * rotations, number of poses).
 */
#ifndef vtkMEAMModelCalibration_h
#define vtkMEAMModelCalibration_h

#include "ppfmeamDetectionModule.h"
#include "vtkPartitionedDataSetCollectionAlgorithm.h"

class PPFMEAMDETECTION_EXPORT vtkMEAMModelCalibration : public vtkPartitionedDataSetCollectionAlgorithm
{
public:
  static vtkMEAMModelCalibration* New();
  vtkTypeMacro(vtkMEAMModelCalibration, vtkPartitionedDataSetCollectionAlgorithm);

protected:
  vtkMEAMModelCalibration();
  ~vtkMEAMModelCalibration() override = default;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
};

#endif
