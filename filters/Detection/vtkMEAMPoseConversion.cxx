// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPoseConversion.h"

#include "base/Bounds.h"
#include "base/Error.h"
#include "base/Frames.h"
#include "vtkMEAMArrays.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <type_traits>
#include <vector>

namespace vtkMEAMConversion
{
namespace
{
using meam::Error;
using meam::Pose;
}

meam::Poses toPoses(vtkPolyData* input)
{
  meam::Poses poses;
  const vtkIdType count = input->GetNumberOfPoints();
  if (count == 0)
  {
    return poses;
  }
  vtkDataArray* transforms = pointArray(input, "Transform", 16);
  if (!transforms)
  {
    throw Error("The poses have no point array 'Transform' of 16 components: use the output of PoseDetection or of a "
                "pose file.");
  }
  if (pointArray(input, "FreeTurn", 1))
  {
    throw Error("The poses are grasps on a part: use the output of MEAMPoseEstimation or of a pose file.");
  }
  vtkDataArray* residuals = pointArray(input, "Residual", 1);
  vtkDataArray* iterations = pointArray(input, "Iterations", 1);
  vtkDataArray* covariances = pointArray(input, "Covariance", 36);
  vtkDataArray* constrained = pointArray(input, "ConstrainedDegreesOfFreedom", 1);
  vtkDataArray* axes = pointArray(input, "ConstrainedAxes", 6);
  for (vtkIdType i = 0; i < count; ++i)
  {
    Eigen::Matrix<double, 4, 4, Eigen::RowMajor> matrix;
    transforms->GetTuple(i, matrix.data());
    const std::optional<Eigen::Isometry3d> rigid = meam::rigidOf(matrix);
    if (!rigid)
    {
      throw Error("Pose " + std::to_string(i + 1) +
                  " is not a rotation and a translation: 'Transform' has to be 4 x 4, "
                  "row by row, with the last row 0 0 0 1.");
    }
    meam::Pose pose;
    pose.T_scene_model = *rigid;
    if (residuals && iterations && covariances && constrained && axes)
    {
      pose.fit.residual = residuals->GetComponent(i, 0);
      pose.fit.iterations = wholeIn(iterations, i);
      covariances->GetTuple(i, pose.fit.covariance.data());
      pose.fit.constrained = wholeIn(constrained, i);
      axes->GetTuple(i, pose.fit.constrainedAxes.data());
    }
    poses.push_back(pose);
  }
  const auto takeWhole = [&](const char* name, int Pose::*member)
  {
    vtkDataArray* array = pointArray(input, name, 1);
    for (vtkIdType i = 0; array && i < count; ++i)
    {
      poses[i].*member = wholeIn(array, i);
    }
  };
  const auto take = [&](const char* name, double Pose::*member, bool mayLack)
  {
    vtkDataArray* array = pointArray(input, name, 1);
    for (vtkIdType i = 0; array && i < count; ++i)
    {
      const double value = array->GetComponent(i, 0);
      if (!std::isnan(value))
      {
        poses[i].*member = value;
      }
      else if (!mayLack)
      {
        throw Error("Pose " + std::to_string(i + 1) + " has a " + quoted(name) +
                    " that is not a number: give it one, take the pose out, or that array of all poses.");
      }
    }
  };
  takeWhole("Votes", &Pose::votes);
  takeWhole("ViewId", &Pose::viewId);
  take("Score", &Pose::score, false);
  take("Evidence", &Pose::evidence, false);
  // Not a number of those poses of a file of which it is not known:
  take("PlaceProbability", &Pose::placeProbability, true);
  take("Probability", &Pose::probability, true);
  take("VisibleFraction", &Pose::visibleFraction, true);
  take("Certainty", &Pose::certainty, true);
  return poses;
}

void fromPoses(const meam::Poses& poses, vtkPolyData* output)
{
  setFrames(poses, &Pose::T_scene_model, output);
  const auto add = [&](const auto& array) { output->GetPointData()->AddArray(array); };
  /// A vector of each pose.
  const auto addVectors = [&](const char* name, int components, const auto& vectorOf)
  {
    std::vector<double> values;
    for (const Pose& pose : poses)
    {
      const auto vector = vectorOf(pose);
      values.insert(values.end(), vector.data(), vector.data() + components);
    }
    add(arrayOf<vtkDoubleArray>(name, values, components));
  };
  const auto quaternionOf = [](const Pose& pose) -> Eigen::Vector4d
  {
    const Eigen::Quaterniond turn = Eigen::Quaterniond(pose.T_scene_model.linear()).normalized();
    return turn.w() < 0.0 ? Eigen::Vector4d(-turn.coeffs()) : turn.coeffs(); // x y z w
  };
  addVectors("Quaternion", 4, quaternionOf);
  add(columnOf<vtkDoubleArray>("Score", poses, &Pose::score));
  add(columnOf<vtkDoubleArray>("PlaceProbability", poses, &Pose::placeProbability));
  add(columnOf<vtkDoubleArray>("Probability", poses, &Pose::probability));
  add(columnOf<vtkDoubleArray>("Evidence", poses, &Pose::evidence));
  add(columnOf<vtkIntArray>("Votes", poses, &Pose::votes));
  add(columnOf<vtkIntArray>("ViewId", poses, &Pose::viewId));
  add(columnOf<vtkDoubleArray>("VisibleFraction", poses, &Pose::visibleFraction));
  add(columnOf<vtkDoubleArray>("Certainty", poses, &Pose::certainty));
  std::vector<int> ranks(poses.size());
  std::iota(ranks.begin(), ranks.end(), 1);
  add(arrayOf<vtkIntArray>("Rank", ranks));
  if (std::any_of(poses.begin(), poses.end(), [](const Pose& pose) { return pose.fit.iterations > 0; }))
  {
    add(columnOf<vtkDoubleArray>("Residual", poses, [](const Pose& pose) { return pose.fit.residual; }));
    add(columnOf<vtkIntArray>("Iterations", poses, [](const Pose& pose) { return pose.fit.iterations; }));
    addVectors("Covariance", 36, [](const Pose& pose) { return pose.fit.covariance; }); // symmetric
    add(columnOf<vtkIntArray>(
      "ConstrainedDegreesOfFreedom", poses, [](const Pose& pose) { return pose.fit.constrained; }));
    addVectors("ConstrainedAxes", 6, [](const Pose& pose) { return pose.fit.constrainedAxes; });
  }
  output->GetPointData()->SetActiveScalars("Score");
}

std::optional<meam::PartExtent> partExtentOf(vtkDataObject* input)
{
  vtkDataArray* bounds = input->GetFieldData()->GetArray("PartBounds");
  vtkDataArray* middle = input->GetFieldData()->GetArray("PartMiddle");
  if (!bounds || bounds->GetNumberOfComponents() != 6 || bounds->GetNumberOfTuples() != 1 || !middle ||
      middle->GetNumberOfComponents() != 3 || middle->GetNumberOfTuples() != 1)
  {
    return {};
  }
  meam::PartExtent part;
  for (int axis = 0; axis < 3; ++axis)
  {
    part.box.min()[axis] = bounds->GetComponent(0, 2 * axis);
    part.box.max()[axis] = bounds->GetComponent(0, 2 * axis + 1);
    part.middle[axis] = middle->GetComponent(0, axis);
  }
  return part;
}

void setPartExtent(vtkDataObject* output, const meam::TrainedModel& model)
{
  const Eigen::AlignedBox3f box = meam::bounds(model.surface.points);
  const Eigen::Vector3f& middle = model.visibility->middle();
  const std::array ends{ box.min().x(), box.max().x(), box.min().y(), box.max().y(), box.min().z(), box.max().z() };
  const std::array place{ middle.x(), middle.y(), middle.z() };
  output->GetFieldData()->AddArray(arrayOf<vtkDoubleArray>("PartBounds", ends, 6));
  output->GetFieldData()->AddArray(arrayOf<vtkDoubleArray>("PartMiddle", place, 3));
}

std::optional<meam::EvidenceRates> evidenceRatesOf(vtkDataObject* input)
{
  vtkDataArray* array = input->GetFieldData()->GetArray("EvidenceRates");
  if (!array || array->GetNumberOfValues() != 4)
  {
    return {};
  }
  double rates[4];
  for (int k = 0; k < 4; ++k)
  {
    rates[k] = array->GetVariantValue(k).ToDouble();
    if (!(rates[k] > 0.0 && rates[k] < 1.0))
    {
      return {};
    }
  }
  return meam::EvidenceRates{ { rates[0], rates[1] }, { rates[2], rates[3] } };
}

void setEvidenceRates(vtkDataObject* output, const std::optional<meam::EvidenceRates>& rates)
{
  if (rates)
  {
    const double values[] = { rates->edges.found, rates->edges.chance, rates->outline.found, rates->outline.chance };
    output->GetFieldData()->AddArray(arrayOf<vtkDoubleArray>("EvidenceRates", values, 4));
  }
}

void setParts(
  const std::vector<meam::PartPose>& poses, const std::vector<const meam::TrainedModel*>& models, vtkPolyData* output)
{
  output->GetPointData()->AddArray(columnOf<vtkIntArray>("PartId", poses, &meam::PartPose::part));
  output->GetFieldData()->AddArray(columnOf<vtkDoubleArray>("Diameter", models, &meam::TrainedModel::diameter));
}

std::vector<int> typesOf(vtkPolyData* poses, int connected)
{
  std::vector<int> types(poses->GetNumberOfPoints(), 0);
  vtkDataArray* parts = pointArray(poses, "PartId", 1);
  if (parts && !types.empty() && (connected > 1 || parts->GetRange()[0] < parts->GetRange()[1]))
  {
    const int most = static_cast<int>(parts->GetRange()[1]);
    if (parts->GetRange()[0] < 0.0 || most >= connected)
    {
      throw meam::Error("The poses are of " + std::to_string(most + 1) + " types of part, but not " +
                        std::to_string(connected) + ": connect all to Part, in the order in which they were searched.");
    }
    for (std::size_t k = 0; k < types.size(); ++k)
    {
      types[k] = wholeIn(parts, static_cast<vtkIdType>(k));
    }
  }
  return types;
}

meam::Pose placedAt(const double position[3], const double rotation[3])
{
  const auto turn = [&](int axis)
  { return Eigen::AngleAxisd(rotation[axis] * M_PI / 180.0, Eigen::Vector3d::Unit(axis)); };
  meam::Pose pose;
  pose.T_scene_model.translate(Eigen::Vector3d(position[0], position[1], position[2]));
  pose.T_scene_model.rotate(turn(2) * turn(0) * turn(1));
  return pose;
}
}
