// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMInstanceConversion.h"

#include "pose/PartsEstimation.h"
#include "pose/Pose.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMCloudConversion.h"

#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
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
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace vtkMEAMConversion
{
namespace
{
constexpr unsigned char RankColors[][3] = {
  { 220, 30, 30 },   // 1 red
  { 40, 170, 50 },   // 2 green
  { 40, 90, 220 },   // 3 blue
  { 245, 205, 30 },  // 4 yellow
  { 240, 120, 190 }, // 5 pink
  { 125, 10, 20 },   // 6 to 10: the same, dark
  { 10, 90, 45 },    //
  { 15, 35, 110 },   //
  { 135, 105, 0 },   //
  { 130, 35, 105 },  //
  { 150, 150, 150 }, // the others
};
constexpr int LastColor = static_cast<int>(std::size(RankColors));

constexpr double Sure = 0.95; // of a rotation: it needs no word

bool isDrawn(const meam::Pose& pose, double minimumProbability)
{
  const double place = meam::claimOf(pose, false);
  return !(place > 0.0) || place >= minimumProbability;
}

/// A pose that is drawn.
struct Drawn
{
  const meam::Pose* pose;
  int rank;
};

/// Values of the pose for all points or cells of its copy. `kinds`: of each kind of cell how many a copy has; those of
/// one kind stand together.
void describe(vtkDataSetAttributes* attributes, const std::vector<Drawn>& drawn, const std::vector<vtkIdType>& kinds)
{
  std::vector<const Drawn*> ofEach;
  for (const vtkIdType count : kinds)
  {
    for (const Drawn& one : drawn)
    {
      ofEach.insert(ofEach.end(), count, &one);
    }
  }
  attributes->SetScalars(columnOf<vtkIntArray>("Rank", ofEach, &Drawn::rank));

  const std::pair<const char*, double meam::Pose::*> values[] = { { "Score", &meam::Pose::score },
    { "PlaceProbability", &meam::Pose::placeProbability }, { "Probability", &meam::Pose::probability },
    { "Certainty", &meam::Pose::certainty }, { "VisibleFraction", &meam::Pose::visibleFraction } };
  // Of poses from a file, or by votes, there is no more than the score.
  const bool isJudged =
    std::any_of(drawn.begin(), drawn.end(), [](const Drawn& one) { return meam::claimOf(*one.pose, false) > 0.0; });
  for (const auto& [name, value] : values)
  {
    if (value == &meam::Pose::score || isJudged)
    {
      attributes->AddArray(
        columnOf<vtkDoubleArray>(name, ofEach, [value = value](const Drawn* one) { return one->pose->*value; }));
    }
  }
  std::vector<unsigned char> colors;
  colors.reserve(3 * ofEach.size());
  for (const Drawn* one : ofEach)
  {
    const unsigned char* color = RankColors[std::min(one->rank, LastColor) - 1];
    colors.insert(colors.end(), color, color + 3);
  }
  attributes->AddArray(arrayOf<vtkUnsignedCharArray>("RankColor", colors, 3));
}

/// The cells so many times, each time of the next `points` points.
void repeat(vtkCellArray* cells, vtkIdType points, vtkIdType copies, vtkCellArray* repeated)
{
  repeated->AllocateExact(copies * cells->GetNumberOfCells(), copies * cells->GetNumberOfConnectivityIds());
  for (vtkIdType copy = 0; copy < copies; ++copy)
  {
    repeated->Append(cells, copy * points);
  }
}

/// A copy of the shape for each pose that is drawn, where mapOf(pose) takes it, with the values of the pose.
template <typename MapOf>
void fromCopies(vtkPolyData* shape, const meam::Points& points, const meam::Poses& poses,
  const std::function<int(std::size_t)>& rankOf, const InstanceSettings& settings, const meam::Progress& progress,
  const MapOf& mapOf, vtkPolyData* output)
{
  const std::size_t copies = settings.most > 0 ? std::min(poses.size(), settings.most) : poses.size();
  std::vector<Drawn> drawn;
  for (std::size_t k = 0; k < copies; ++k)
  {
    if (isDrawn(poses[k], settings.minimumProbability))
    {
      drawn.push_back({ &poses[k], rankOf(k) });
    }
  }
  if (drawn.empty())
  {
    return;
  }
  const vtkIdType size = static_cast<vtkIdType>(points.size());
  vtkNew<vtkFloatArray> places;
  places->SetNumberOfComponents(3);
  places->SetNumberOfTuples(size * static_cast<vtkIdType>(drawn.size()));
  float* place = places->GetPointer(0);
  for (std::size_t k = 0; k < drawn.size(); ++k)
  {
    meam::report(progress, static_cast<double>(k) / drawn.size());
    const Eigen::Affine3f map = mapOf(*drawn[k].pose);
    for (const Eigen::Vector3f& point : points)
    {
      Eigen::Map<Eigen::Vector3f>{ place } = map * point;
      place += 3;
    }
  }
  vtkNew<vtkPoints> moved;
  moved->SetData(places);
  output->SetPoints(moved);
  vtkCellArray* const cells[] = { shape->GetVerts(), shape->GetLines(), shape->GetPolys(), shape->GetStrips() };
  vtkNew<vtkCellArray> repeated[4];
  std::vector<vtkIdType> kinds;
  for (int kind = 0; kind < 4; ++kind)
  {
    repeat(cells[kind], size, static_cast<vtkIdType>(drawn.size()), repeated[kind]);
    kinds.push_back(cells[kind]->GetNumberOfCells());
  }
  output->SetVerts(repeated[0]);
  output->SetLines(repeated[1]);
  output->SetPolys(repeated[2]);
  output->SetStrips(repeated[3]);
  describe(output->GetPointData(), drawn, { size });
  describe(output->GetCellData(), drawn, kinds);
}
}

void fromInstances(vtkPolyData* part, const meam::Poses& poses, const std::function<int(std::size_t)>& rankOf,
  const InstanceSettings& settings, const meam::Progress& progress, vtkPolyData* output)
{
  const meam::Points points = toCloud(part).points;
  meam::requirePoints(points, "The CAD mesh");
  fromCopies(
    part, points, poses, rankOf, settings, progress,
    [](const meam::Pose& pose) { return Eigen::Affine3f(pose.T_scene_model.cast<float>()); }, output);
}

void fromInstances(const std::vector<vtkPolyData*>& parts, std::vector<meam::PartPose> poses,
  const std::function<int(std::size_t)>& rankOf, InstanceSettings settings, const meam::Progress& progress,
  vtkPolyData* output)
{
  poses.resize(settings.most > 0 ? std::min(poses.size(), settings.most) : poses.size());
  settings.most = 0; // the best of all, not of each
  vtkNew<vtkAppendPolyData> all;
  for (std::size_t part = 0; part < parts.size(); ++part)
  {
    const meam::RankedPoses ofPart = meam::posesOfPart(poses, static_cast<int>(part));
    vtkNew<vtkPolyData> copies;
    fromInstances(
      parts[part], ofPart.poses, [&](std::size_t k) { return rankOf(ofPart.ranks[k] - 1); }, settings, progress,
      copies);
    const auto addPart = [&](vtkDataSetAttributes* attributes, vtkIdType size)
    {
      vtkNew<vtkIntArray> ids;
      ids->SetName("PartId");
      ids->SetNumberOfTuples(size);
      ids->FillValue(static_cast<int>(part));
      attributes->AddArray(ids);
      attributes->SetActiveScalars("PartId"); // the types are told apart first
    };
    if (copies->GetNumberOfPoints() == 0)
    {
      continue;
    }
    addPart(copies->GetPointData(), copies->GetNumberOfPoints());
    addPart(copies->GetCellData(), copies->GetNumberOfCells());
    all->AddInputData(copies);
  }
  if (all->GetNumberOfInputConnections(0) > 0)
  {
    all->Update();
    output->ShallowCopy(all->GetOutput());
  }
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
  fromCopies(
    ball->GetOutput(), toCloud(ball->GetOutput()).points, poses, rankOf, settings, {},
    [&](const meam::Pose& pose)
    { return Eigen::Affine3f(meam::uncertaintyEllipsoid(pose, part.middle, deviations).cast<float>()); },
    output);
}

void addLabels(
  const meam::Poses& poses, const std::vector<std::string>& names, double minimumProbability, vtkPolyData* output)
{
  std::vector<std::string> labels;
  for (std::size_t k = 0; k < poses.size(); ++k)
  {
    std::string label = isDrawn(poses[k], minimumProbability) ? std::to_string(k + 1) : "";
    label += label.empty() || names.empty() ? "" : " (" + names[k] + ")";
    const auto percent = [](double share) { return std::to_string(std::lround(100.0 * share)) + " %"; };
    if (!label.empty() && meam::claimOf(poses[k], false) > 0.0)
    {
      label += ": " + percent(meam::claimOf(poses[k], false));
      label += poses[k].certainty < Sure ? ", rotation " + percent(poses[k].certainty) : "";
    }
    labels.push_back(label);
  }
  output->GetPointData()->AddArray(arrayOf<vtkStringArray>("Label", labels));
}

std::string describeHidden(const meam::Poses& poses, double minimumProbability, const std::string& property)
{
  const auto hidden = std::count_if(
    poses.begin(), poses.end(), [&](const meam::Pose& pose) { return !isDrawn(pose, minimumProbability); });
  if (hidden == 0)
  {
    return {};
  }
  return std::to_string(hidden) + " of " + std::to_string(poses.size()) + (poses.size() == 1 ? " pose" : " poses") +
         (hidden == 1 ? " is" : " are") + " not shown: a copy is there with less than " +
         std::to_string(std::lround(100.0 * minimumProbability)) + " % (" + property + ").";
}
}
