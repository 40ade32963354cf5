// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMPickTrial
 * @brief Plays planned picks among copies whose true poses are known: which would have worked.
 *
 * A pick was planned with estimated poses and with what the sensor saw. Here the gripper goes the same way among the
 * true copies: it must not touch the bin or any copy before it holds one, and must hold one in the end.
 *
 * Input port 0: picks, a vtkPolyData as vtkMEAMPickPlanning has them, with their field data.
 * Input port 1: the CAD mesh, a vtkPolyData in mm.
 * Input port 2: true poses, a vtkPolyData with `Transform`; its field data `Bin`, where it is there
 * (vtkMEAMBinSceneSource), counts in place of that of the picks. Input port 3, optional: the gripper's mesh, when the
 * picks were planned with one.
 *
 * Output port 0: the picks with the point arrays `Outcome` (int, see Outcomes; of picks that are not possible
 * NotTried), `OutcomeName` (text) and `TrueInstance` (from 1: the true pose that is held; 0: none).
 */
#ifndef vtkMEAMPickTrial_h
#define vtkMEAMPickTrial_h

#include "ppfmeamPickingModule.h"
#include "vtkMEAMPropertyMacros.h"
#include "vtkPolyDataAlgorithm.h"

#include <memory>

namespace meam
{
struct PickTrialSettings;
}

class PPFMEAMPICKING_EXPORT vtkMEAMPickTrial : public vtkPolyDataAlgorithm
{
public:
  static vtkMEAMPickTrial* New();
  vtkTypeMacro(vtkMEAMPickTrial, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Values of `Outcome`. */
  enum Outcomes
  {
    Success,
    HitsBin,
    HitsOther,
    HitsPart,
    HoldsNothing,
    NotTried
  };

  /** mm of the gripper's way in that are looked at. Default: 80. */
  vtkMEAMDeclareSettingMacro(WayIn, double);

  /** mm that a cup gives way, and that it may be off the surface. Default: 2. */
  vtkMEAMDeclareSettingMacro(CupSlack, double);

protected:
  vtkMEAMPickTrial();
  ~vtkMEAMPickTrial() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  std::unique_ptr<meam::PickTrialSettings> Settings;
};

#endif
