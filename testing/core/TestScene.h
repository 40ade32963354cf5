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
const meam::TrainedModel& bracket(meam::Preset preset = meam::Preset::Recommended);

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

/// Brackets at the given poses.
std::vector<Copy> brackets(const std::vector<Eigen::Isometry3d>& poses);

/// What a sensor far above sees of copies of any parts: surface and edge points, no tangents.
Seen seenFromAbove(const std::vector<Copy>& copies);

/// The same of brackets.
Seen seenFromAbove(const std::vector<Eigen::Isometry3d>& poses);

/// Its edges thinned as for a part of this diameter, with tangents.
Seen withTangents(Seen seen, double partDiameter = bracket().diameter);

/// A scene whose edges have tangents, for parts of this diameter.
meam::Scene prepared(const Seen& seen, double partDiameter = bracket().diameter);

/// What is given of it to the whole online phase.
meam::SceneInput inputOf(const Seen& seen);

/// The scene of one part at T, seen from above.
meam::Scene alone(const meam::TriangleMesh& part, const meam::TrainedModel& model, const Eigen::Isometry3d& T);

/// Whether poses, votes, scores and evidence are equal to the last bit, in the same order.
bool areSame(const meam::Poses& a, const meam::Poses& b);

/// Within so many mm and degrees.
testing::AssertionResult areNear(
  const Eigen::Isometry3d& T, const Eigen::Isometry3d& other, double millimetres, double degrees);
bool isNearOne(
  const meam::Pose& pose, const std::vector<Eigen::Isometry3d>& places, double millimetres, double degrees);

/// How many of the copies have a pose near them.
int copiesFound(
  const meam::Poses& poses, const std::vector<Eigen::Isometry3d>& copies, double millimetres, double degrees);

/// Calls step(poses) with poses in the scene's local frame, and takes those that come back from there.
template <typename Step>
meam::Poses inLocalFrame(
  const meam::Poses& poses, const meam::Scene& scene, const meam::TrainedModel& model, Step&& step)
{
  const Eigen::Isometry3d& T = scene.T_local_scene();
  return meam::toSceneFrame(step(meam::toLocalFrame(poses, T, model.symmetries)), T, model.symmetries);
}

meam::PoseDetectionSettings withShare(double referenceShare);

meam::Poses detect(const meam::PointCloud& edges, const meam::TrainedModel& model,
  const meam::PoseDetectionSettings& settings = {}, const meam::Progress& progress = {});

meam::Poses screen(const meam::Poses& poses, const meam::Scene& scene, const meam::TrainedModel& model,
  const meam::PoseScreeningSettings& settings = {}, const meam::Progress& progress = {});

meam::Poses verify(const meam::Poses& poses, const meam::Scene& scene, const meam::TrainedModel& model,
  const meam::PoseVerificationSettings& settings = {}, const meam::Progress& progress = {});

/// Of poses that are verified, best first.
meam::Poses select(const meam::Poses& poses, const meam::Scene& scene, const meam::TrainedModel& model,
  const meam::PoseSelectionSettings& settings = {}, const meam::Progress& progress = {});

meam::Poses refine(const meam::Poses& poses, const meam::Scene& scene, const meam::TrainedModel& model,
  const meam::PoseRefinementSettings& settings = {}, const meam::Progress& progress = {});

meam::Pose align(const meam::Pose& pose, const meam::Scene& scene, const meam::TrainedModel& model);

/// The whole online phase.
meam::Poses estimatePoses(const meam::TrainedModel& model, const Seen& seen, const meam::DetectionSettings& settings,
  meam::DetectionReport* report = nullptr, const meam::Progress& progress = {});

/// Flat on the table, turned by `degrees` about z; `up` false lies on its other face.
Eigen::Isometry3d lying(double x, double y, double degrees, bool up = true);

const std::vector<Eigen::Isometry3d>& threeCopies();
/// What is seen of them, with tangents, and the scene that is prepared of it.
const Seen& seenCopies();
const meam::Scene& copiesScene();
/// Of what is seen of them the upper faces alone, on which a part may turn about z and slide along x and y, and the
/// edge points of these indices.
meam::Scene upperFaces(const std::vector<int>& edges);
/// A gear turned by so many degrees, and the scene in which it lies as gearAt(0).
Eigen::Isometry3d gearAt(double degrees);
const meam::Scene& gearScene();
/// Poses near them, as they come to refinement.
meam::Poses disturbedCopies(double millimetres, double degrees);

/// So many brackets that lie about, longer by `factors` along their axes, and the scene of them.
std::vector<Copy> stretchedBrackets(int count, const Eigen::Vector3f& factors);
meam::Scene sceneOf(const std::vector<Copy>& copies);

/// A pose, `millimetres` along its x axis and turned by `degrees` about its z axis.
meam::Pose displaced(const Eigen::Isometry3d& T, double millimetres = 0.0, double degrees = 0.0);
}
