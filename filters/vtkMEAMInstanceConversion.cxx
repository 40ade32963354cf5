// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMInstanceConversion.h"

#include "pose/PoseUncertainty.h"
#include "vtkMEAMCloudConversion.h"

#include "vtkAppendPolyData.h"
#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSphereSource.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace vtkMEAMConversion
{
namespace
{
constexpr unsigned char RankColors[6][3] = {
  { 220, 30, 30 },   // 1 red
  { 40, 170, 50 },   // 2 green
  { 40, 90, 220 },   // 3 blue
  { 245, 205, 30 },  // 4 yellow
  { 240, 120, 190 }, // 5 pink
  { 150, 150, 150 }, // the others
};

bool isDrawn(const meam::Pose& pose, double minimumProbability)
{
  return !(pose.probability > 0.0) || pose.probability >= minimumProbability;
}

/// The same values for all points or cells of an instance.
void describe(vtkDataSetAttributes* attributes, vtkIdType count, int rank, const meam::Pose& pose)
{
  vtkNew<vtkIntArray> ranks;
  ranks->SetName("Rank");
  ranks->SetNumberOfTuples(count);
  ranks->FillValue(rank);
  attributes->SetScalars(ranks);

  const std::pair<const char*, double> values[] = { { "Score", pose.score }, { "Probability", pose.probability },
    { "Certainty", pose.certainty }, { "VisibleFraction", pose.visibleFraction } };
  for (const auto& [name, value] : values)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    array->SetNumberOfTuples(count);
    array->FillValue(value);
    attributes->AddArray(array);
  }

  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("RankColor");
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(count);
  const unsigned char* color = RankColors[std::min(rank, 6) - 1];
  for (vtkIdType i = 0; i < count; ++i)
  {
    std::copy_n(color, 3, colors->GetPointer(3 * i));
  }
  attributes->AddArray(colors);
}

/// A mesh with its points, mapped, as those of `instance`.
void fromCopy(vtkPolyData* mesh, const meam::Points& points, const Eigen::Affine3f& map, vtkPolyData* instance)
{
  vtkNew<vtkPoints> moved;
  moved->SetNumberOfPoints(static_cast<vtkIdType>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Eigen::Vector3f point = map * points[i];
    moved->SetPoint(static_cast<vtkIdType>(i), point.data());
  }
  instance->CopyStructure(mesh);
  instance->SetPoints(moved);
}

/// A piece for each pose that is drawn, with the values of the pose.
template <typename Piece>
void appendDrawn(const meam::Poses& poses, const std::function<int(std::size_t)>& rankOf,
  const InstanceSettings& settings, const meam::Progress& progress, Piece&& pieceAt, vtkPolyData* output)
{
  const std::size_t copies = settings.most > 0 ? std::min(poses.size(), settings.most) : poses.size();
  vtkNew<vtkAppendPolyData> append;
  for (std::size_t k = 0; k < copies; ++k)
  {
    meam::report(progress, static_cast<double>(k) / copies);
    if (isDrawn(poses[k], settings.minimumProbability))
    {
      vtkNew<vtkPolyData> piece;
      pieceAt(poses[k], piece);
      const int rank = rankOf(k);
      describe(piece->GetPointData(), piece->GetNumberOfPoints(), rank, poses[k]);
      describe(piece->GetCellData(), piece->GetNumberOfCells(), rank, poses[k]);
      append->AddInputDataObject(piece);
    }
  }
  if (append->GetNumberOfInputConnections(0) > 0)
  {
    append->Update();
    output->CopyStructure(append->GetOutput());
    output->GetPointData()->ShallowCopy(append->GetOutput()->GetPointData());
    output->GetCellData()->ShallowCopy(append->GetOutput()->GetCellData());
  }
}
}

void fromInstances(vtkPolyData* part, const meam::Poses& poses, const std::function<int(std::size_t)>& rankOf,
  const InstanceSettings& settings, const meam::Progress& progress, vtkPolyData* output)
{
  const meam::Points points = toCloud(part).points;
  meam::requirePoints(points, "The CAD mesh");
  const auto copyAt = [&](const meam::Pose& pose, vtkPolyData* instance)
  { fromCopy(part, points, Eigen::Affine3f(pose.T_scene_model.cast<float>()), instance); };
  appendDrawn(poses, rankOf, settings, progress, copyAt, output);
}

void fromUncertainties(const meam::Poses& poses, const meam::PartExtent& part, double deviations,
  const std::function<int(std::size_t)>& rankOf, const InstanceSettings& settings, vtkPolyData* output)
{
  constexpr int resolution = 24; // round enough for the eye, and with points on all axes
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(1.0);
  ball->SetPhiResolution(resolution + 1);
  ball->SetThetaResolution(resolution);
  ball->Update();
  const meam::Points points = toCloud(ball->GetOutput()).points;
  const auto ellipsoidAt = [&](const meam::Pose& pose, vtkPolyData* ellipsoid)
  {
    const Eigen::Affine3d map = meam::uncertaintyEllipsoid(pose, part.middle, deviations);
    fromCopy(ball->GetOutput(), points, map.cast<float>(), ellipsoid);
  };
  appendDrawn(poses, rankOf, settings, {}, ellipsoidAt, output);
}

void addLabels(const meam::Poses& poses, double minimumProbability, vtkPolyData* output)
{
  vtkNew<vtkStringArray> labels;
  labels->SetName("Label");
  for (std::size_t k = 0; k < poses.size(); ++k)
  {
    std::string label = isDrawn(poses[k], minimumProbability) ? std::to_string(k + 1) : "";
    if (!label.empty() && poses[k].probability > 0.0)
    {
      label += ": " + std::to_string(std::lround(100.0 * poses[k].probability)) + " %";
    }
    labels->InsertNextValue(label);
  }
  output->GetPointData()->AddArray(labels);
}
}
