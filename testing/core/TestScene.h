// SPDX-License-Identifier: BSD-3-Clause
// A trained L-bracket, scenes of copies of it seen from above, and the steps of the online phase with poses in the
// scenes' own coordinates.
#pragma once

#include "TestParts.h"
#include "mesh/TriangleMesh.h"
#include "model/AppearanceModel.h"
#include "model/BoundaryExtraction.h"
#include "model/ModelTraining.h"
#include "model/VisibilityExtraction.h"
#include "pose/MEAMPoseEstimation.h"

namespace scenes
{
/// Trained once for all tests of the executable, when the first one asks for it.
inline const meam::TrainedModel& bracket(meam::Preset preset = meam::Preset::Recommended)
{
  if (preset == meam::Preset::Paper)
  {
    static const meam::TrainedModel paper =
      meam::trainModel(parts::lBracket(), meam::trainingSettings(meam::Preset::Paper));
    return paper;
  }
  static const meam::TrainedModel recommended =
    meam::trainModel(parts::lBracket(), meam::trainingSettings(meam::Preset::Recommended));
  return recommended;
}

/// Another part, trained once as well.
template <meam::TriangleMesh (*Part)()>
const meam::TrainedModel& trained()
{
  static const meam::TrainedModel model = meam::trainModel(Part(), meam::trainingSettings(meam::Preset::Recommended));
  return model;
}

/// What a sensor sees, in the scene's own coordinates.
struct Seen
{
  meam::PointCloud edges;
  meam::Points surface; ///< may be empty
  meam::Sensor sensor;
};

/// A part and where a copy of it is.
struct Copy
{
  meam::TriangleMesh part;
  Eigen::Isometry3d T_scene_model;
};

/// What a sensor far above sees of copies of any parts: surface and edge points, no tangents.
inline Seen seenFromAbove(const std::vector<Copy>& copies)
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
  Seen seen;
  seen.surface = view.cloud.points;
  seen.edges.points = meam::extractBoundary({ view })[0].cloud.points;
  seen.sensor.perspective = false;
  seen.sensor.direction = -Eigen::Vector3d::UnitZ();
  return seen;
}

/// The same of brackets at the given poses.
inline Seen seenFromAbove(const std::vector<Eigen::Isometry3d>& poses)
{
  std::vector<Copy> copies;
  for (const auto& T : poses)
  {
    copies.push_back({ parts::lBracket(), T });
  }
  return seenFromAbove(copies);
}

/// Its edges thinned as for a part of this diameter, with tangents.
inline Seen withTangents(Seen seen, double partDiameter = bracket().diameter)
{
  seen.edges = parts::withTangents(seen.edges, partDiameter, seen.sensor.direction);
  return seen;
}

/// A scene whose edges have tangents, for parts of this diameter.
inline meam::Scene prepared(const Seen& seen, double partDiameter = bracket().diameter)
{
  meam::LocalCloud edges = meam::toLocalCloud(seen.edges);
  const meam::Points measured = meam::toLocalPoints(seen.surface, edges.T_local_scene);
  return meam::Scene(std::move(edges), measured, seen.sensor, partDiameter);
}

/// Calls step(poses) with poses in the scene's local frame, and takes those that come back from there.
template <typename Step>
meam::Poses inLocalFrame(
  const meam::Poses& poses, const meam::Scene& scene, const meam::TrainedModel& model, Step&& step)
{
  const Eigen::Isometry3d& T = scene.T_local_scene();
  return meam::toSceneFrame(step(meam::toLocalFrame(poses, T, model.symmetries)), T, model.symmetries);
}

inline meam::Poses detect(const meam::PointCloud& edges, const meam::TrainedModel& model,
  const meam::PoseDetectionSettings& settings = {}, const meam::Progress& progress = {})
{
  const meam::LocalCloud local = meam::toLocalCloud(edges);
  return meam::toSceneFrame(meam::detectPoses(local, model, settings, progress), local.T_local_scene, model.symmetries);
}

inline meam::Poses screen(const meam::Poses& poses, const meam::Scene& scene, const meam::TrainedModel& model,
  const meam::PoseScreeningSettings& settings = {}, const meam::Progress& progress = {})
{
  return inLocalFrame(poses, scene, model,
    [&](const meam::Poses& local) { return meam::screenPoses(local, scene, model, settings, progress); });
}

inline meam::Poses verify(const meam::Poses& poses, const meam::Scene& scene, const meam::TrainedModel& model,
  const meam::PoseVerificationSettings& settings = {}, const meam::Progress& progress = {})
{
  return inLocalFrame(poses, scene, model,
    [&](const meam::Poses& local) { return meam::verifyPoses(local, scene, model, settings, progress); });
}

/// Of poses that are verified, best first.
inline meam::Poses select(const meam::Poses& poses, const meam::Scene& scene, const meam::TrainedModel& model,
  const meam::PoseSelectionSettings& settings = {}, const meam::Progress& progress = {})
{
  return inLocalFrame(poses, scene, model,
    [&](const meam::Poses& local) { return meam::selectPoses(local, scene, model, settings, progress); });
}

inline meam::Poses refine(const meam::Poses& poses, const meam::Scene& scene, const meam::TrainedModel& model,
  const meam::PoseRefinementSettings& settings = {}, const meam::Progress& progress = {})
{
  return inLocalFrame(poses, scene, model,
    [&](const meam::Poses& local) { return meam::refinePoses(local, scene, model, settings, progress); });
}

inline meam::Pose align(const meam::Pose& pose, const meam::Scene& scene, const meam::TrainedModel& model)
{
  return inLocalFrame({ pose }, scene, model,
    [&](const meam::Poses& local) { return meam::Poses{ meam::alignRobustly(local[0], scene, model) }; })[0];
}

/// The whole online phase.
inline meam::Poses estimatePoses(const meam::TrainedModel& model, const Seen& seen,
  const meam::DetectionSettings& settings, meam::DetectionReport* report = nullptr, const meam::Progress& progress = {})
{
  const int threads = settings.tangents.threads;
  meam::SceneInput input{ meam::toLocalCloud(seen.edges, threads), {}, seen.sensor };
  input.measured = meam::toLocalPoints(seen.surface, input.edges.T_local_scene, threads);
  return meam::estimatePoses(model, input, settings, report, progress);
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
  static const std::vector<Eigen::Isometry3d> poses = { lying(0, 0, 20), lying(90, 10, 131, false),
    lying(20, 90, -77) };
  return poses;
}
/// Poses near them, as they come to refinement.
inline meam::Poses disturbedCopies(double millimetres, double degrees)
{
  std::mt19937 random(11);
  meam::Poses poses;
  for (const auto& T : threeCopies())
  {
    const Eigen::Vector3d axis = parts::motion(random, 1.0).linear().col(0);
    const Eigen::Vector3d shift = parts::motion(random, 1.0).linear().col(1);
    meam::Pose pose;
    pose.T_scene_model = T;
    pose.T_scene_model.translate(millimetres * shift);
    pose.T_scene_model.rotate(Eigen::AngleAxisd(degrees * M_PI / 180.0, axis));
    pose.viewId = T.linear()(2, 2) > 0 ? 0 : 1; // seen from its +z or its -z
    pose.score = 0.5;
    pose.votes = 12;
    poses.push_back(pose);
  }
  return poses;
}

/// A pose, `millimetres` along its x axis and turned by `degrees` about its z axis.
inline meam::Pose displaced(const Eigen::Isometry3d& T, double millimetres = 0.0, double degrees = 0.0)
{
  meam::Pose pose;
  pose.T_scene_model = T;
  pose.T_scene_model.translate(Eigen::Vector3d(millimetres, 0, 0));
  pose.T_scene_model.rotate(Eigen::AngleAxisd(degrees * M_PI / 180.0, Eigen::Vector3d::UnitZ()));
  pose.viewId = 0;
  return pose;
}
}
