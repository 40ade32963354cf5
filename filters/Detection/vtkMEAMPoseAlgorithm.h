// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMPoseAlgorithm
 * @brief Base of the filters that take poses of a part in a scene, and give poses.
 *
 * The filters of a pipeline share the trained model, the scene and the poses in its local frame, so that each is made
 * once and nothing is rounded between them.
 *
 * Input port 0: vtkPolyData of poses (vtkMEAMPoseDetection, another filter of this kind, or a pose file): `Transform`.
 * Input port 1: vtkPartitionedDataSetCollection, the trained model (vtkMEAMHashing).
 * Input port 2: vtkPolyData, edge points of the scene in mm with `Tangent` (vtkMEAMTangentEstimation).
 * Input port 3, optional: vtkPointSet, all points the sensor measured, in mm: an organized cloud
 * (vtkStructuredGrid, invalid points NaN or blanked) or any cloud. Without it only edges count.
 *
 * Output port 0: vtkPolyData of poses as vtkMEAMPoseDetection has them. Field data `Diameter` (mm, of the part)
 * and, from the first vtkMEAMPoseVerification on, `EvidenceRates`: share of the edge points of a part that find an
 * edge, and of those anywhere, and the same of outlines that end.
 */
#ifndef vtkMEAMPoseAlgorithm_h
#define vtkMEAMPoseAlgorithm_h

#include "vtkMEAMSensorAlgorithm.h"

#include <memory>

class PPFMEAMDETECTION_EXPORT vtkMEAMPoseAlgorithm : public vtkMEAMSensorAlgorithm
{
public:
  vtkTypeMacro(vtkMEAMPoseAlgorithm, vtkMEAMSensorAlgorithm);

protected:
  vtkMEAMPoseAlgorithm();
  ~vtkMEAMPoseAlgorithm() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  /// Poses in, poses out, by the core (vtkMEAMPoseWork.h).
  struct Work;
  virtual void Process(Work& work) = 0;

private:
  struct SharedData;
  std::unique_ptr<SharedData> Shared; ///< what other filters find as long as this one holds it
};

#endif
