// SPDX-License-Identifier: BSD-3-Clause
/**
 * What types of part are called. Not wrapped.
 */
#ifndef vtkMEAMPartNames_h
#define vtkMEAMPartNames_h

#include "ppfmeamDetectionModule.h" // For export macro

#include <string>

class vtkAlgorithm;

namespace vtkMEAMConversion
{
/// The name of the file that an algorithm reads; empty: it reads none.
using FileOf = std::string (*)(vtkAlgorithm* algorithm);

/// For readers that VTK does not know.
PPFMEAMDETECTION_EXPORT void setFileOf(FileOf fileOf);

/// The part that comes to the first port of a filter by this connection: by its field data `Name`, or by the file that
/// it was read from, or by its place among several.
std::string partNameOf(vtkAlgorithm* filter, int connection);
}

#endif
