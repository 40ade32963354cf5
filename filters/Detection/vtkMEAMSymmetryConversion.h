// SPDX-License-Identifier: BSD-3-Clause
/**
 * A part's symmetries as field data. Not wrapped.
 */
#ifndef vtkMEAMSymmetryConversion_h
#define vtkMEAMSymmetryConversion_h

#include "mesh/Symmetries.h"

class vtkDataObject;

namespace vtkMEAMConversion
{
/// A part's symmetries travel with its samples and its trained model as the field data `SymmetriesDiscrete` (16
/// components, row-major), `SymmetriesContinuous` (6: unit axis and a point on it), `NearSymmetries` (16),
/// `NearSymmetryOverlap` and `NearSymmetryDeviation` (mm). None when they are not there, or for null. Throws Error for
/// values that are no rotations.
meam::Symmetries symmetriesOf(vtkDataObject* input);
void setSymmetries(vtkDataObject* output, const meam::Symmetries& symmetries);
}

#endif
