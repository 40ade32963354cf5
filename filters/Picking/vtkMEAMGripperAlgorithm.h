// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMGripperAlgorithm
 * @brief Base of the filters that know a gripper by its lengths: jaws, or a cup. A mesh may take their place.
 */
#ifndef vtkMEAMGripperAlgorithm_h
#define vtkMEAMGripperAlgorithm_h

#include "ppfmeamPickingModule.h"
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

  ///@{
  /** mm between the jaws, at most. Default: 60. */
  void SetOpening(double opening);
  double GetOpening();
  ///@}

  ///@{
  /** mm on either side between the part and a jaw on its way in. Default: 3. */
  void SetJawClearance(double clearance);
  double GetJawClearance();
  ///@}

  ///@{
  /** mm, a finger across the direction of closing. Default: 12. */
  void SetFingerWidth(double width);
  double GetFingerWidth();
  ///@}

  ///@{
  /** mm, a finger along the direction of closing. Default: 8. */
  void SetFingerThickness(double thickness);
  double GetFingerThickness();
  ///@}

  ///@{
  /** mm from the gripper's body to the tips of its fingers. Default: 50. */
  void SetFingerLength(double length);
  double GetFingerLength();
  ///@}

  ///@{
  /** mm that the tips reach farther than the grasp's origin. Default: 6. */
  void SetTipLength(double length);
  double GetTipLength();
  ///@}

  ///@{
  /** mm, the body behind the fingers or the cup. Default: 100. */
  void SetBodyLength(double length);
  double GetBodyLength();
  ///@}

  ///@{
  /** mm, the body across the direction of closing; behind a cup its diameter. Default: 60. */
  void SetBodyWidth(double width);
  double GetBodyWidth();
  ///@}

  ///@{
  /** mm, the suction cup. Default: 20. */
  void SetCupDiameter(double diameter);
  double GetCupDiameter();
  ///@}

  ///@{
  /** mm from the gripper's body to the cup's rim. Default: 30. */
  void SetCupLength(double length);
  double GetCupLength();
  ///@}

protected:
  vtkMEAMGripperAlgorithm();
  ~vtkMEAMGripperAlgorithm() override;

  const std::unique_ptr<meam::Gripper> Lengths;

private:
  vtkMEAMGripperAlgorithm(const vtkMEAMGripperAlgorithm&) = delete;
  void operator=(const vtkMEAMGripperAlgorithm&) = delete;
};

#endif
