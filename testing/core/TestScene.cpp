// SPDX-License-Identifier: BSD-3-Clause
#include "TestScene.h"

#include "base/sequences/Sequences.h"
#include "pose/refinement/FinalAlignment.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace scenes
{
const meam::TrainedModel& bracket(meam::Preset preset)
{
  static std::map<meam::Preset, meam::TrainedModel> models;
  const auto known = models.find(preset);
  return known != models.end()
           ? known->second
           : models.emplace(preset, meam::trainModel(parts::lBracket(), meam::trainingSettings(preset))).first->second;
}

Seen seenFromAbove(const std::vector<Copy>& copies)
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
  seen.sensor = parts::fromAbove();
  return seen;
}

std::vector<Copy> brackets(const std::vector<Eigen::Isometry3d>& poses)
{
  return meam::mapped<Copy>(poses, [&](const auto& T) { return Copy{ parts::lBracket(), T }; });
}

Seen seenFromAbove(const std::vector<Eigen::Isometry3d>& poses) { return seenFromAbove(brackets(poses)); }

Seen withTangents(Seen seen, double partDiameter)
{
  seen.edges = parts::withTangents(seen.edges, partDiameter, seen.sensor.direction);
  return seen;
}

meam::Scene prepared(const Seen& seen, double partDiameter)
{
  meam::LocalCloud edges = meam::toLocalCloud(seen.edges);
  const meam::Points measured = meam::toLocalPoints(seen.surface, edges.T_local_scene);
  return meam::Scene(std::move(edges), measured, seen.sensor, partDiameter);
}

meam::Scene alone(const meam::TriangleMesh& part, const meam::TrainedModel& model, const Eigen::Isometry3d& T)
{
  return prepared(withTangents(seenFromAbove({ Copy{ part, T } }), model.diameter), model.diameter);
}

bool areSame(const meam::Poses& a, const meam::Poses& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
    [](const meam::Pose& one, const meam::Pose& other)
    {
      return one.T_scene_model.matrix() == other.T_scene_model.matrix() && one.votes == other.votes &&
             one.score == other.score && one.evidence == other.evidence;
    });
}

testing::AssertionResult areNear(
  const Eigen::Isometry3d& T, const Eigen::Isometry3d& other, double millimetres, double degrees)
{
  const double apart = meam::translationError(T, other), turned = meam::rotationError(T, other);
  return (apart < millimetres && turned < degrees ? testing::AssertionSuccess() : testing::AssertionFailure())
         << apart << " mm and " << turned << " degrees apart";
}

bool isNearOne(const meam::Pose& pose, const std::vector<Eigen::Isometry3d>& places, double millimetres, double degrees)
{
  return std::any_of(
    places.begin(), places.end(), [&](const auto& T) { return areNear(pose.T_scene_model, T, millimetres, degrees); });
}

int copiesFound(
  const meam::Poses& poses, const std::vector<Eigen::Isometry3d>& copies, double millimetres, double degrees)
{
  return static_cast<int>(std::count_if(copies.begin(), copies.end(),
    [&](const auto& T)
    {
      return std::any_of(poses.begin(), poses.end(),
        [&](const auto& pose) { return areNear(pose.T_scene_model, T, millimetres, degrees); });
    }));
}

meam::SceneInput inputOf(const Seen& seen)
{
  meam::SceneInput input{ meam::toLocalCloud(seen.edges), {}, seen.sensor };
  input.measured = meam::toLocalPoints(seen.surface, input.edges.T_local_scene);
  return input;
}

meam::PoseDetectionSettings withShare(double referenceShare)
{
  meam::PoseDetectionSettings settings;
  settings.referenceShare = referenceShare;
  return settings;
}

meam::Poses detect(const meam::PointCloud& edges, const meam::TrainedModel& model,
  const meam::PoseDetectionSettings& settings, const meam::Progress& progress)
{
  const meam::LocalCloud local = meam::toLocalCloud(edges);
  return meam::toSceneFrame(meam::detectPoses(local, model, settings, progress), local.T_local_scene, model.symmetries);
}

meam::Poses screen(const meam::Poses& poses, const meam::Scene& scene, const meam::TrainedModel& model,
  const meam::PoseScreeningSettings& settings, const meam::Progress& progress)
{
  return inLocalFrame(poses, scene, model,
    [&](const meam::Poses& local) { return meam::screenPoses(local, scene, model, settings, progress); });
}

meam::Poses verify(const meam::Poses& poses, const meam::Scene& scene, const meam::TrainedModel& model,
  const meam::PoseVerificationSettings& settings, const meam::Progress& progress)
{
  return inLocalFrame(poses, scene, model,
    [&](const meam::Poses& local) { return meam::verifyPoses(local, scene, model, settings, progress); });
}

meam::Poses select(const meam::Poses& poses, const meam::Scene& scene, const meam::TrainedModel& model,
  const meam::PoseSelectionSettings& settings, const meam::Progress& progress)
{
  return inLocalFrame(poses, scene, model,
    [&](const meam::Poses& local) { return meam::selectPoses(local, scene, model, settings, progress); });
}

meam::Poses refine(const meam::Poses& poses, const meam::Scene& scene, const meam::TrainedModel& model,
  const meam::PoseRefinementSettings& settings, const meam::Progress& progress)
{
  return inLocalFrame(poses, scene, model,
    [&](const meam::Poses& local) { return meam::refinePoses(local, scene, model, settings, progress); });
}

meam::Pose align(const meam::Pose& pose, const meam::Scene& scene, const meam::TrainedModel& model)
{
  return inLocalFrame({ pose }, scene, model,
    [&](const meam::Poses& local) { return meam::Poses{ meam::alignRobustly(local[0], scene, model) }; })[0];
}

meam::Poses estimatePoses(const meam::TrainedModel& model, const Seen& seen, const meam::DetectionSettings& settings,
  meam::DetectionReport* report, const meam::Progress& progress)
{
  const int threads = settings.tangents.threads;
  meam::SceneInput input{ meam::toLocalCloud(seen.edges, threads), {}, seen.sensor };
  input.measured = meam::toLocalPoints(seen.surface, input.edges.T_local_scene, threads);
  return meam::estimatePoses(model, input, settings, report, progress);
}

Eigen::Isometry3d lying(double x, double y, double degrees, bool up)
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

std::vector<Copy> stretchedBrackets(int count, const Eigen::Vector3f& factors)
{
  const Eigen::Vector3f middle(30.0f, 20.0f, 7.5f); // stays
  meam::TriangleMesh part = parts::lBracket();
  for (Eigen::Vector3f& vertex : part.vertices)
  {
    vertex = middle + factors.cwiseProduct(vertex - middle);
  }
  return meam::ofIndices<Copy>(count,
    [&](int i) {
      return Copy{ part, lying(100.0 * (i % 2), 100.0 * (i / 2), 25.0 + 70.0 * i) };
    });
}

meam::Scene sceneOf(const std::vector<Copy>& copies) { return prepared(withTangents(seenFromAbove(copies))); }

const std::vector<Eigen::Isometry3d>& threeCopies()
{
  static const std::vector<Eigen::Isometry3d> poses = { lying(0, 0, 20), lying(90, 10, 131, false),
    lying(20, 90, -77) };
  return poses;
}

const Seen& seenCopies()
{
  static const Seen seen = withTangents(seenFromAbove(threeCopies()));
  return seen;
}

const meam::Scene& copiesScene()
{
  static const meam::Scene scene = prepared(seenCopies());
  return scene;
}

meam::Scene upperFaces(const std::vector<int>& edges)
{
  Seen faces = seenCopies();
  meam::eraseIf(faces.surface, [](const Eigen::Vector3f& point) { return point.z() <= 14.5f; });
  faces.edges = faces.edges.subset(edges);
  return prepared(faces);
}

Eigen::Isometry3d gearAt(double degrees)
{
  return Eigen::Translation3d(40, -20, 7) *
         meam::turnAbout(Eigen::Vector3d::UnitZ(), degrees * M_PI / 180.0, Eigen::Vector3d::Zero());
}

const meam::Scene& gearScene()
{
  static const meam::Scene scene = alone(parts::gear(), trained<parts::gear>(), gearAt(0));
  return scene;
}

meam::Poses disturbedCopies(double millimetres, double degrees)
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

meam::Pose displaced(const Eigen::Isometry3d& T, double millimetres, double degrees)
{
  meam::Pose pose;
  pose.T_scene_model = T;
  pose.T_scene_model.translate(Eigen::Vector3d(millimetres, 0, 0));
  pose.T_scene_model.rotate(Eigen::AngleAxisd(degrees * M_PI / 180.0, Eigen::Vector3d::UnitZ()));
  pose.viewId = 0;
  return pose;
}
}
