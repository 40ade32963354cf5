// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMArrays.h"

#include "base/Error.h"

#include "vtkCellArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <sstream>

namespace vtkMEAMConversion
{
namespace
{
using meam::Error;

constexpr std::size_t LineLength = 66; // letters of an answer, as a view has room for beside the page New Part

template <typename Scalar>
using Vectors = std::vector<Eigen::Matrix<Scalar, 3, 1>>;

/// Three components of each tuple; VTK's own accessors are too slow for a scan.
template <typename T, typename Scalar>
void copyTuples(const T* values, Vectors<Scalar>& points)
{
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i] = { static_cast<Scalar>(values[3 * i]), static_cast<Scalar>(values[3 * i + 1]),
      static_cast<Scalar>(values[3 * i + 2]) };
  }
}

/// The words in lines of no more than so many letters.
std::string inLines(const std::string& text, std::size_t most)
{
  std::istringstream words(text);
  std::string lines, word;
  std::size_t length = 0; // of the last line
  while (words >> word)
  {
    const bool isNext = length > 0 && length + 1 + word.size() > most;
    lines += (length == 0 ? "" : isNext ? "\n" : " ") + word;
    length = isNext || length == 0 ? word.size() : length + 1 + word.size();
  }
  return lines;
}
}

std::string quoted(const char* name) { return std::string("'") + name + "'"; }

template <typename Scalar>
VectorsOf<Scalar> toVectors(vtkDataArray* array)
{
  Vectors<Scalar> points(array->GetNumberOfTuples());
  if (auto* floats = vtkFloatArray::FastDownCast(array))
  {
    copyTuples(floats->GetPointer(0), points);
  }
  else if (auto* doubles = vtkDoubleArray::FastDownCast(array))
  {
    copyTuples(doubles->GetPointer(0), points);
  }
  else
  {
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      double tuple[3];
      array->GetTuple(static_cast<vtkIdType>(i), tuple);
      points[i] = Eigen::Vector3d(tuple[0], tuple[1], tuple[2]).cast<Scalar>();
    }
  }
  return points;
}

template meam::Points toVectors<float>(vtkDataArray*);
template meam::PrecisePoints toVectors<double>(vtkDataArray*);

vtkSmartPointer<vtkFloatArray> fromVectors(const meam::Points& points, const char* name)
{
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(points.size()));
  float* values = array->GetPointer(0);
  for (const auto& point : points)
  {
    values = std::copy(point.data(), point.data() + 3, values);
  }
  return array;
}

vtkSmartPointer<vtkPoints> toVTKPoints(const meam::Points& points)
{
  auto result = vtkSmartPointer<vtkPoints>::New();
  result->SetData(fromVectors(points, "Points"));
  return result;
}

/// The point array of that name, or null; throws when its shape is another one.
vtkDataArray* pointArray(vtkDataSet* input, const char* name, int components)
{
  vtkDataArray* array = input->GetPointData()->GetArray(name);
  if (array &&
      (array->GetNumberOfComponents() != components || array->GetNumberOfTuples() != input->GetNumberOfPoints()))
  {
    throw Error("The point array " + quoted(name) + " must have " + std::to_string(components) +
                " components for each point: it was not made by the step before this one.");
  }
  return array;
}

int wholeIn(vtkDataArray* array, vtkIdType place)
{
  const double value = array->GetComponent(place, 0);
  if (!(std::abs(value) <= VTK_INT_MAX) || value != std::floor(value))
  {
    std::ostringstream words;
    words << "Value " << place + 1 << " of the array " << quoted(array->GetName())
          << " has to be a whole number of up to " << VTK_INT_MAX << ", not " << value << ".";
    throw Error(words.str());
  }
  return static_cast<int>(value);
}

const unsigned char* ghostsOf(vtkDataSet* input)
{
  auto* ghosts =
    vtkUnsignedCharArray::SafeDownCast(input->GetPointData()->GetArray(vtkDataSetAttributes::GhostArrayName()));
  const vtkIdType count = input->GetNumberOfPoints();
  return ghosts && count > 0 && ghosts->GetNumberOfValues() == count ? ghosts->GetPointer(0) : nullptr;
}

void addVertices(vtkPolyData* output)
{
  const vtkIdType count = output->GetNumberOfPoints();
  const auto numbers = [](vtkIdType last)
  {
    auto ids = vtkSmartPointer<vtkIdTypeArray>::New();
    ids->SetNumberOfTuples(last);
    std::iota(ids->GetPointer(0), ids->GetPointer(0) + last, 0);
    return ids;
  };
  vtkNew<vtkCellArray> vertices;
  vertices->SetData(numbers(count + 1), numbers(count));
  output->SetVerts(vertices);
}

void setVertices(const meam::PrecisePoints& points, vtkPolyData* output)
{
  vtkNew<vtkPoints> places;
  places->SetDataTypeToDouble();
  for (const Eigen::Vector3d& point : points)
  {
    places->InsertNextPoint(point.data());
  }
  output->SetPoints(places);
  addVertices(output);
}

double diameterOf(vtkDataObject* input)
{
  vtkFieldData* fields = input ? input->GetFieldData() : nullptr;
  vtkDataArray* array = fields ? fields->GetArray("Diameter") : nullptr;
  const double value = array && array->GetNumberOfValues() == 1 ? array->GetComponent(0, 0) : 0.0;
  return value > 0.0 && std::isfinite(value) ? value : 0.0;
}

void setDiameter(vtkDataObject* output, double diameter) { setFieldValue(output, "Diameter", diameter); }

void setFieldValue(vtkDataObject* output, const char* name, double value)
{
  output->GetFieldData()->AddArray(arrayOf<vtkDoubleArray>(name, std::array{ value }));
}

void setFieldText(vtkDataObject* output, const char* name, const std::string& text)
{
  output->GetFieldData()->AddArray(arrayOf<vtkStringArray>(name, std::array{ text }));
}

void setNameOf(const std::string& file, vtkDataObject* output)
{
  setFieldText(output, "Name", std::filesystem::path(file).stem().string());
}

void fromAnswer(const std::vector<std::string>& paragraphs, vtkTable* output)
{
  std::string lines;
  for (const std::string& paragraph : paragraphs)
  {
    lines += (lines.empty() || paragraph.empty() ? "" : "\n") + inLines(paragraph, LineLength);
  }
  output->AddColumn(arrayOf<vtkStringArray>("Text", std::array{ lines }));
}
}
