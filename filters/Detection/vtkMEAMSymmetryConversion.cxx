// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMSymmetryConversion.h"

#include "base/Error.h"
#include "base/Frames.h"
#include "vtkMEAMArrays.h"

#include "vtkDataObject.h"
#include "vtkFieldData.h"

#include <string>

namespace vtkMEAMConversion
{
namespace
{
/// The values of a field data array, whose shape a file may have changed; none when it is not there.
std::vector<double> fieldValues(vtkDataObject* input, const char* name, std::size_t perTuple)
{
  std::vector<double> values;
  if (vtkDataArray* array = input->GetFieldData()->GetArray(name))
  {
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    {
      for (int c = 0; c < array->GetNumberOfComponents(); ++c)
      {
        values.push_back(array->GetComponent(i, c));
      }
    }
  }
  if (values.size() % perTuple != 0)
  {
    throw meam::Error("The field data '" + std::string(name) + "' does not have " + std::to_string(perTuple) +
                      " values for each symmetry: use the output of SymmetryDetection.");
  }
  return values;
}

std::vector<Eigen::Isometry3d> fieldTransforms(vtkDataObject* input, const char* name)
{
  const std::vector<double> values = fieldValues(input, name, 16);
  std::vector<Eigen::Isometry3d> transforms;
  for (std::size_t i = 0; i < values.size(); i += 16)
  {
    const Eigen::Isometry3d T = meam::transformOf(values.data() + i);
    if (!meam::isRigid(T.matrix()))
    {
      throw meam::Error("The field data '" + std::string(name) +
                        "' has a matrix that is not a rigid motion: use the "
                        "output of SymmetryDetection.");
    }
    transforms.push_back(T);
  }
  return transforms;
}
}

meam::Symmetries symmetriesOf(vtkDataObject* input)
{
  meam::Symmetries symmetries;
  if (!input)
  {
    return symmetries;
  }
  symmetries.discrete = fieldTransforms(input, "SymmetriesDiscrete");
  const std::vector<double> axes = fieldValues(input, "SymmetriesContinuous", 6);
  for (std::size_t i = 0; i < axes.size(); i += 6)
  {
    const Eigen::Vector3d axis(axes[i], axes[i + 1], axes[i + 2]);
    const Eigen::Vector3d point(axes[i + 3], axes[i + 4], axes[i + 5]);
    if (!(std::abs(axis.norm() - 1.0) < 1e-3 && point.allFinite()))
    {
      throw meam::Error(
        "The field data 'SymmetriesContinuous' has an axis that is not a unit vector: use the output of "
        "SymmetryDetection.");
    }
    symmetries.continuous.push_back({ axis, point });
  }
  const std::vector<Eigen::Isometry3d> near = fieldTransforms(input, "NearSymmetries");
  const std::vector<double> overlap = fieldValues(input, "NearSymmetryOverlap", 1);
  const std::vector<double> deviation = fieldValues(input, "NearSymmetryDeviation", 1);
  for (std::size_t i = 0; i < near.size(); ++i)
  {
    symmetries.near.push_back(
      { near[i], i < overlap.size() ? overlap[i] : 0.0, i < deviation.size() ? deviation[i] : 0.0 });
  }
  return symmetries;
}

void setSymmetries(vtkDataObject* output, const meam::Symmetries& symmetries)
{
  std::vector<double> axes;
  for (const meam::ContinuousSymmetry& symmetry : symmetries.continuous)
  {
    axes.insert(axes.end(), symmetry.axis.data(), symmetry.axis.data() + 3);
    axes.insert(axes.end(), symmetry.point.data(), symmetry.point.data() + 3);
  }
  vtkFieldData* fields = output->GetFieldData();
  fields->AddArray(framesOf("SymmetriesDiscrete", symmetries.discrete, [](const Eigen::Isometry3d& T) { return T; }));
  fields->AddArray(arrayOf<vtkDoubleArray>("SymmetriesContinuous", axes, 6));
  fields->AddArray(framesOf("NearSymmetries", symmetries.near, &meam::NearSymmetry::T));
  fields->AddArray(columnOf<vtkDoubleArray>("NearSymmetryOverlap", symmetries.near, &meam::NearSymmetry::overlap));
  fields->AddArray(columnOf<vtkDoubleArray>("NearSymmetryDeviation", symmetries.near, &meam::NearSymmetry::deviation));
}
}
