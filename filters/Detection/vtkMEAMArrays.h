// SPDX-License-Identifier: BSD-3-Clause
/**
 * Arrays and field data of VTK data objects, for the conversions between these and the core. Not wrapped.
 */
#ifndef vtkMEAMArrays_h
#define vtkMEAMArrays_h

#include "base/PointCloud.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <array>
#include <functional>
#include <iterator>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

class vtkDataObject;
class vtkDataSet;
class vtkFloatArray;
class vtkPoints;
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

/// A number of an array of one component. Throws Error for one that is not whole.
int wholeIn(vtkDataArray* array, vtkIdType place);

/// The flags of a data set's points, of which vtkDataSetAttributes::HIDDENPOINT is that of a blanked one; null when it
/// has none. A raw pointer, because VTK's accessors are too slow for a scan.
const unsigned char* ghostsOf(vtkDataSet* input);

/// An array with valueOf(row) of each row: a number or a text. `valueOf` may be a member, too.
template <typename Array, typename Rows, typename ValueOf>
vtkSmartPointer<Array> columnOf(const char* name, const Rows& rows, ValueOf&& valueOf, int components = 1)
{
  using Value = std::decay_t<decltype(std::declval<Array&>().GetValue(0))>;
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(std::size(rows)) / components);
  vtkIdType place = 0;
  for (const auto& row : rows)
  {
    array->SetValue(place++, static_cast<Value>(std::invoke(valueOf, row)));
  }
  return array;
}

/// An array of values that stand one after the other.
template <typename Array, typename Values>
vtkSmartPointer<Array> arrayOf(const char* name, const Values& values, int components = 1)
{
  return columnOf<Array>(
    name, values, [](const auto& value) { return value; }, components);
}

/// An array with the 16 numbers of each frame, row by row.
template <typename Rows, typename FrameOf>
vtkSmartPointer<vtkDoubleArray> framesOf(const char* name, const Rows& rows, const FrameOf& frameOf)
{
  std::vector<double> values;
  for (const auto& row : rows)
  {
    const auto& frame = std::invoke(frameOf, row);
    for (int k = 0; k < 16; ++k)
    {
      values.push_back(frame(k / 4, k % 4));
    }
  }
  return arrayOf<vtkDoubleArray>(name, values, 16);
}
template <typename Frame>
vtkSmartPointer<vtkDoubleArray> frameOf(const char* name, const Frame& frame)
{
  return framesOf(name, std::array{ frame }, [](const Frame& T) { return T; });
}

/// A vertex cell for each point.
void addVertices(vtkPolyData* output);
/// These points in double precision, with a vertex cell for each.
void setVertices(const meam::PrecisePoints& points, vtkPolyData* output);

/// A vertex at the origin of each row's frame, and the array `Transform`.
template <typename Rows, typename FrameOf>
void setFrames(const Rows& rows, const FrameOf& frameOf, vtkPolyData* output)
{
  meam::PrecisePoints origins;
  for (const auto& row : rows)
  {
    origins.push_back(std::invoke(frameOf, row).translation());
  }
  setVertices(origins, output);
  output->GetPointData()->AddArray(framesOf("Transform", rows, frameOf));
}

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
