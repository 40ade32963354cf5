// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMBOPEvaluation
 * @brief Recall of poses in an image as the BOP benchmark measures it: ADD, ADI, MSSD, MSPD and VSD.
 *
 * Copies of which at least a tenth is visible have to be found (all, where no `VisibleFraction` is known), by as many
 * poses as there are of them. The camera is taken from the scan; surface up to 15 mm behind the measured one is
 * visible (the benchmark takes 5 mm for ITODD alone).
 *
 * Input port 0: estimated poses in the image, best first, a vtkPolyData with the point array `Transform` (16, row-major
 * T_scene_model).
 * Input port 1: true poses of this part, likewise, with `VisibleFraction` where it is known (vtkMEAMBOPReader).
 * Input port 2: the part's mesh in the frame of the poses, mm.
 * Input port 3: the scan, a vtkStructuredGrid W x H x 1 in the frame of the camera that took it, mm.
 * Input port 4 (optional): the part's samples from vtkMEAMSymmetryDetection, or its trained model: symmetries for MSSD
 * and MSPD, and the diameter. Without it the part has none, and the diameter is the largest distance of two vertices.
 *
 * Output port 0: a vtkTable with a row for each of ten thresholds: `Threshold` (0.05 to 0.5), and how many copies are
 * found at it by `ADD`, `ADI` and `MSSD` (less than that share of the diameter), `MSPD` (less than 100 times as many
 * pixels of an image 640 wide) and `VSD` (cost less than the threshold; mean over tolerances of 5 to 50 % of the
 * diameter). Field data: `Targets` (copies that have to be found) and, in % of them, `ADDRecall` and `ADIRecall` at a
 * tenth of the diameter, `MSSDRecall`, `MSPDRecall` and `VSDRecall` as means over the thresholds, and the mean of these
 * three, `AverageRecall`; NaN without targets.
 */
#ifndef vtkMEAMBOPEvaluation_h
#define vtkMEAMBOPEvaluation_h

#include "ppfmeamTrainingModule.h"
#include "vtkTableAlgorithm.h"

class PPFMEAMTRAINING_EXPORT vtkMEAMBOPEvaluation : public vtkTableAlgorithm
{
public:
  static vtkMEAMBOPEvaluation* New();
  vtkTypeMacro(vtkMEAMBOPEvaluation, vtkTableAlgorithm);

  ///@{
  /** What each port takes. */
  void SetTrueConnection(vtkAlgorithmOutput* truth) { this->SetInputConnection(1, truth); }
  void SetMeshConnection(vtkAlgorithmOutput* mesh) { this->SetInputConnection(2, mesh); }
  void SetScanConnection(vtkAlgorithmOutput* scan) { this->SetInputConnection(3, scan); }
  void SetPartConnection(vtkAlgorithmOutput* part) { this->SetInputConnection(4, part); }
  ///@}

protected:
  vtkMEAMBOPEvaluation();
  ~vtkMEAMBOPEvaluation() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
};

#endif
