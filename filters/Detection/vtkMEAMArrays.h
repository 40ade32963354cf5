// SPDX-License-Identifier: BSD-3-Clause
/**
 * Arrays and field data of VTK data objects, for the conversions between these and the core. Not wrapped.
 */
#ifndef vtkMEAMArrays_h
#define vtkMEAMArrays_h

#include "base/PointCloud.h"

#include "vtkDataArray.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <string>
#include <type_traits>
#include <vector>

class vtkDataObject;
class vtkDataSet;
class vtkFloatArray;
class vtkPoints;
class vtkPolyData;
class vtkTable;

namespace vtkMEAMConversion
{
std::string quoted(const char* name);

template <typename Scalar>
using VectorsOf = std::conditional_t<std::is_same_v<Scalar, double>, meam::PrecisePoints, meam::Points>;

/// Three components of each tuple, of an array of any type.
template <typename Scalar>
VectorsOf<Scalar> toVectors(vtkDataArray* array);
vtkSmartPointer<vtkFloatArray> fromVectors(const meam::Points& points, const char* name);
vtkSmartPointer<vtkPoints> toVTKPoints(const meam::Points& points);

/// The point array of that name, or null; throws when its shape is another one.
vtkDataArray* pointArray(vtkDataSet* input, const char* name, int components);

/// The flags of a data set's points, of which vtkDataSetAttributes::HIDDENPOINT is that of a blanked one; null when it
/// has none. A raw pointer, because VTK's accessors are too slow for a scan.
const unsigned char* ghostsOf(vtkDataSet* input);

/// A vertex cell for each point.
void addVertices(vtkPolyData* output);

/// d_max in mm travels with the part from step to step as the field data `Diameter`; 0 when it is not there.
double diameterOf(vtkDataObject* input);
void setDiameter(vtkDataObject* output, double diameter);
/// A number as field data; replaces an array of that name.
void setFieldValue(vtkDataObject* output, const char* name, double value);
/// The same of a text.
void setFieldText(vtkDataObject* output, const char* name, const std::string& text);

/// A part is called by its file, NAME.stl, as the field data `Name`.
void setNameOf(const std::string& file, vtkDataObject* output);

/// An answer, what to do about it and more as a table with one row, `Text`: in lines, to show in a view.
void fromAnswer(const std::vector<std::string>& paragraphs, vtkTable* output);
}

#endif
