// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMSamplePartSource
 * @brief Parts made without outside data: five as in car air-conditioning, four that are round all over.
 *
 * - Ribbed flange: the part of the examples, 80 mm across and 22 mm high with thin walls. Its axis is z; a lug,
 *   a gap in the rim and a missing rib fix the roll.
 * - Ridged disc: 92 mm across; ridges of 2 mm, two holes and a keyway alone tell its turn.
 * - Arc lever: 113 mm; a flat arc with an eye at each end and ridges on both sides.
 * - Flap: 154 mm; a thin plate on a shaft, with nearly the same ribs above and below.
 * - Hole plate: 85 mm; flat, near to half a turn's symmetry and to that of its two sides.
 * - Pipe elbow: 108 mm; a hollow bend with a socket at each end, one of them 6 mm longer.
 * - Cap: 70 mm; shallow, with flutes; a tab at its rim alone tells its turn.
 * - Knob: 50 mm; waisted, with a round head; a flat on it alone tells its turn.
 * - Handle: 117 mm; a bowed tube on two round feet, one of them larger.
 *
 * Output port 0: a vtkPolyData of triangles in mm, closed and facing outwards; field data `Diameter`.
 */
#ifndef vtkMEAMSamplePartSource_h
#define vtkMEAMSamplePartSource_h

#include "ppfmeamTrainingModule.h"
#include "vtkMEAMPropertyMacros.h"
#include "vtkPolyDataAlgorithm.h"

class PPFMEAMTRAINING_EXPORT vtkMEAMSamplePartSource : public vtkPolyDataAlgorithm
{
public:
  static vtkMEAMSamplePartSource* New();
  vtkTypeMacro(vtkMEAMSamplePartSource, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Parts
  {
    RibbedFlange,
    RidgedDisc,
    ArcLever,
    Flap,
    HolePlate,
    PipeElbow,
    Cap,
    Knob,
    Handle
  };

  ///@{
  /** Which part. Default: RibbedFlange. */
  vtkMEAMClampedMemberMacro(Part, int, RibbedFlange, Handle);
  void SetPartToRibbedFlange() { this->SetPart(RibbedFlange); }
  void SetPartToRidgedDisc() { this->SetPart(RidgedDisc); }
  void SetPartToArcLever() { this->SetPart(ArcLever); }
  void SetPartToFlap() { this->SetPart(Flap); }
  void SetPartToHolePlate() { this->SetPart(HolePlate); }
  void SetPartToPipeElbow() { this->SetPart(PipeElbow); }
  void SetPartToCap() { this->SetPart(Cap); }
  void SetPartToKnob() { this->SetPart(Knob); }
  void SetPartToHandle() { this->SetPart(Handle); }
  ///@}

protected:
  vtkMEAMSamplePartSource();
  ~vtkMEAMSamplePartSource() override = default;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  int Part = RibbedFlange;
};

#endif
