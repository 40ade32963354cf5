// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMSamplePartSource
 * @brief Parts made without outside data, as in car air-conditioning.
 *
 * - Ribbed flange: the part of the examples, 80 mm across and 22 mm high with thin walls. Its axis is z; a lug,
 *   a gap in the rim and a missing rib fix the roll.
 * - Ridged disc: 92 mm across; ridges of 2 mm, two holes and a keyway alone tell its turn.
 * - Arc lever: 113 mm; a flat arc with an eye at each end and ridges on both sides.
 * - Flap: 154 mm; a thin plate on a shaft, with nearly the same ribs above and below.
 * - Hole plate: 85 mm; flat, near to half a turn's symmetry and to that of its two sides.
 *
 * Output port 0: a vtkPolyData of triangles in mm, closed and facing outwards; field data `Diameter`.
 */
#ifndef vtkMEAMSamplePartSource_h
#define vtkMEAMSamplePartSource_h

#include "ppfmeamFiltersModule.h"
#include "vtkPolyDataAlgorithm.h"

class PPFMEAMFILTERS_EXPORT vtkMEAMSamplePartSource : public vtkPolyDataAlgorithm
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
    HolePlate
  };

  ///@{
  /** Which part. Default: RibbedFlange. */
  vtkSetClampMacro(Part, int, RibbedFlange, HolePlate);
  vtkGetMacro(Part, int);
  void SetPartToRibbedFlange() { this->SetPart(RibbedFlange); }
  void SetPartToRidgedDisc() { this->SetPart(RidgedDisc); }
  void SetPartToArcLever() { this->SetPart(ArcLever); }
  void SetPartToFlap() { this->SetPart(Flap); }
  void SetPartToHolePlate() { this->SetPart(HolePlate); }
  ///@}

protected:
  vtkMEAMSamplePartSource();
  ~vtkMEAMSamplePartSource() override = default;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkMEAMSamplePartSource(const vtkMEAMSamplePartSource&) = delete;
  void operator=(const vtkMEAMSamplePartSource&) = delete;

  int Part = RibbedFlange;
};

#endif
