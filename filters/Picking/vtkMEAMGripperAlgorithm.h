// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMGripperAlgorithm
 * @brief Base of the filters that know a gripper by its lengths: jaws, or a cup. A mesh may take their place.
 */
#ifndef vtkMEAMGripperAlgorithm_h
#define vtkMEAMGripperAlgorithm_h

#include "ppfmeamPickingModule.h"
#include "vtkMEAMPropertyMacros.h"
#include "vtkPolyDataAlgorithm.h"

#include <memory>

namespace meam
{
struct Gripper;
}

class PPFMEAMPICKING_EXPORT vtkMEAMGripperAlgorithm : public vtkPolyDataAlgorithm
{
public:
  vtkTypeMacro(vtkMEAMGripperAlgorithm, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** mm between the jaws, at most. Default: 60. */
  vtkMEAMDeclareSettingMacro(Opening, double);

  /** mm on either side between the part and a jaw on its way in. Default: 3. */
  vtkMEAMDeclareSettingMacro(JawClearance, double);

  /** mm, a finger across the direction of closing. Default: 12. */
  vtkMEAMDeclareSettingMacro(FingerWidth, double);

  /** mm, a finger along the direction of closing. Default: 8. */
  vtkMEAMDeclareSettingMacro(FingerThickness, double);

  /** mm from the gripper's body to the tips of its fingers. Default: 50. */
  vtkMEAMDeclareSettingMacro(FingerLength, double);

  /** mm that the tips reach farther than the grasp's origin. Default: 6. */
  vtkMEAMDeclareSettingMacro(TipLength, double);

  /** mm, the body behind the fingers or the cup. Default: 100. */
  vtkMEAMDeclareSettingMacro(BodyLength, double);

  /** mm, the body across the direction of closing; behind a cup its diameter. Default: 60. */
  vtkMEAMDeclareSettingMacro(BodyWidth, double);

  /** mm, the suction cup. Default: 20. */
  vtkMEAMDeclareSettingMacro(CupDiameter, double);

  /** mm from the gripper's body to the cup's rim. Default: 30. */
  vtkMEAMDeclareSettingMacro(CupLength, double);

protected:
  vtkMEAMGripperAlgorithm();
  ~vtkMEAMGripperAlgorithm() override;

  const std::unique_ptr<meam::Gripper> Lengths;
};

#endif
