// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMGripperAlgorithm.h"

#include "pick/Gripper.h"

vtkMEAMGripperAlgorithm::vtkMEAMGripperAlgorithm()
  : Lengths(std::make_unique<meam::Gripper>())
{
}

vtkMEAMGripperAlgorithm::~vtkMEAMGripperAlgorithm() = default;

// As they are: the core says which lengths make no gripper.
#define vtkMEAMLengthMacro(name, field)                                                                                \
  void vtkMEAMGripperAlgorithm::Set##name(double length)                                                               \
  {                                                                                                                    \
    if (this->Lengths->field != length)                                                                                \
    {                                                                                                                  \
      this->Lengths->field = length;                                                                                   \
      this->Modified();                                                                                                \
    }                                                                                                                  \
  }                                                                                                                    \
  double vtkMEAMGripperAlgorithm::Get##name() { return this->Lengths->field; }
vtkMEAMLengthMacro(Opening, opening);
vtkMEAMLengthMacro(JawClearance, jawClearance);
vtkMEAMLengthMacro(FingerWidth, fingerWidth);
vtkMEAMLengthMacro(FingerThickness, fingerThickness);
vtkMEAMLengthMacro(FingerLength, fingerLength);
vtkMEAMLengthMacro(TipLength, tipLength);
vtkMEAMLengthMacro(BodyLength, bodyLength);
vtkMEAMLengthMacro(BodyWidth, bodyWidth);
vtkMEAMLengthMacro(CupDiameter, cupDiameter);
vtkMEAMLengthMacro(CupLength, cupLength);

void vtkMEAMGripperAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Opening: " << this->Lengths->opening << " mm\n";
  os << indent << "JawClearance: " << this->Lengths->jawClearance << " mm\n";
  os << indent << "FingerWidth: " << this->Lengths->fingerWidth << " mm\n";
  os << indent << "FingerThickness: " << this->Lengths->fingerThickness << " mm\n";
  os << indent << "FingerLength: " << this->Lengths->fingerLength << " mm\n";
  os << indent << "TipLength: " << this->Lengths->tipLength << " mm\n";
  os << indent << "BodyLength: " << this->Lengths->bodyLength << " mm\n";
  os << indent << "BodyWidth: " << this->Lengths->bodyWidth << " mm\n";
  os << indent << "CupDiameter: " << this->Lengths->cupDiameter << " mm\n";
  os << indent << "CupLength: " << this->Lengths->cupLength << " mm\n";
}
