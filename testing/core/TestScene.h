// SPDX-License-Identifier: BSD-3-Clause
// A trained L-bracket, and scenes of copies of it seen from above.
#pragma once

#include "TestParts.h"
#include "model/AppearanceModel.h"
#include "model/ModelTraining.h"
#include "pose/MEAMPoseEstimation.h"

namespace scenes
{
/// Trained once for all tests of the executable.
inline const meam::TrainedModel& bracket(meam::Preset preset = meam::Preset::Recommended)
{
  static const meam::TrainedModel recommended =
    meam::trainModel(parts::lBracket(), meam::trainingSettings(meam::Preset::Recommended));
  static const meam::TrainedModel paper =
    meam::trainModel(parts::lBracket(), meam::trainingSettings(meam::Preset::Paper));
  return preset == meam::Preset::Paper ? paper : recommended;
}

/// A part and where a copy of it is.
struct Copy
{
  meam::TriangleMesh part;
  Eigen::Isometry3d T_scene_model;
};

/// What a sensor far above sees of copies of any parts: surface and edge points, no tangents.
inline meam::Scene seenFromAbove(const std::vector<Copy>& copies)
{
  meam::SurfaceSamplingSettings sampling;
  sampling.spacing = 0.7;
  sampling.seed = 7; // other points than the model's
  meam::PointCloud all;
  for (const auto& [part, T] : copies)
  {
    const meam::PointCloud copy = parts::moved(meam::sampleSurface(part, sampling), T);
    all.points.insert(all.points.end(), copy.points.begin(), copy.points.end());
    all.normals.insert(all.normals.end(), copy.normals.begin(), copy.normals.end());
  }
  meam::AppearanceModel view;
  view.cloud = all.subset(meam::visiblePoints(all.points, { 0, 0, 2000 }, 1000.0));
  meam::Scene scene;
  scene.surface = view.cloud.points;
  scene.edges.points = meam::extractBoundary({ view })[0].cloud.points;
  scene.sensor.perspective = false;
  scene.sensor.direction = -Eigen::Vector3d::UnitZ();
  return scene;
}

/// The same of brackets at the given poses.
inline meam::Scene seenFromAbove(const std::vector<Eigen::Isometry3d>& poses)
{
  std::vector<Copy> copies;
  for (const auto& T : poses)
  {
    copies.push_back({ parts::lBracket(), T });
  }
  return seenFromAbove(copies);
}

inline meam::Scene withTangents(meam::Scene scene)
{
  scene.edges = parts::withTangents(scene.edges, bracket().diameter, scene.sensor.direction);
  return scene;
}

/// The whole online phase with a scene in its own coordinates.
inline meam::Poses estimatePoses(const meam::TrainedModel& model, const meam::Scene& scene,
  const meam::DetectionSettings& settings, meam::StageTimes* times = nullptr, const meam::Progress& progress = {})
{
  return meam::estimatePoses(
    model, scene.edges, meam::inOwnFrame(scene.surface), scene.sensor, settings, times, progress);
}

/// Flat on the table, turned by `degrees` about z; `up` false lies on its other face.
inline Eigen::Isometry3d lying(double x, double y, double degrees, bool up = true)
{
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translate(Eigen::Vector3d(x, y, up ? 0.0 : 15.0));
  T.rotate(Eigen::AngleAxisd(degrees * M_PI / 180.0, Eigen::Vector3d::UnitZ()));
  if (!up)
  {
    T.rotate(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
  }
  return T;
}

inline const std::vector<Eigen::Isometry3d>& threeCopies()
{
  static const std::vector<Eigen::Isometry3d> poses = { lying(0, 0, 20), lying(90, 10, 131, false), lying(20, 90, -77) };
  return poses;
}
}
