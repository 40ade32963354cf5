// SPDX-License-Identifier: BSD-3-Clause
#include "pose/MEAMPoseEstimation.h"

#include "TestScale.h"
#include "TestScene.h"
#include "TestSteps.h"
#include "base/Frames.h"
#include "base/Random.h"
#include "base/sequences/Sequences.h"

#include <algorithm>

namespace
{
/// The three best poses of the bracket.
meam::Poses found(const scenes::Seen& scene, int threads = 0)
{
  return scenes::estimatePoses(
    scenes::bracket(), scene, meam::detectionSettings(meam::Preset::Recommended, 3, threads));
}

void expectNear(const meam::Poses& poses, const meam::Poses& others)
{
  ASSERT_EQ(poses.size(), others.size());
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    EXPECT_TRUE(scenes::areNear(poses[i].T_scene_model, others[i].T_scene_model, 1e-3, 1e-3)) << i;
  }
}

int instancesFound(const meam::Poses& poses, double millimetres, double degrees)
{
  return scenes::copiesFound(poses, scenes::threeCopies(), millimetres, degrees);
}

/// Three brackets, their edges without tangents.
const scenes::Seen& threeSeen()
{
  static const scenes::Seen scene = scenes::seenFromAbove(scenes::threeCopies());
  return scene;
}

meam::DetectionSettings recommended(int poses) { return meam::detectionSettings(meam::Preset::Recommended, poses); }

/// The three best poses of another model of the bracket.
meam::Poses foundBy(const meam::TrainedModel& model, const scenes::Seen& scene = threeSeen())
{
  return scenes::estimatePoses(model, scene, recommended(3));
}
}

TEST(MEAMPoseEstimation, FindsEveryCopyOnce)
{
  meam::DetectionReport report;
  const meam::Poses poses = scenes::estimatePoses(scenes::bracket(), threeSeen(), recommended(3), &report);
  ASSERT_EQ(poses.size(), 3u);
  EXPECT_EQ(instancesFound(poses, 0.2, 0.3), 3);
  const meam::StageTimes& times = report.times;
  for (const double seconds : { times.tangents, times.scene, times.detection, times.screening, times.verification,
         times.refinement, times.selection })
  {
    EXPECT_GT(seconds, 0.0);
  }
}

/// What the paper compares itself with finds fewer: seen from above the bracket's lower edges look like its upper ones,
/// a plate's thickness away, and its back like its front.
TEST(MEAMPoseEstimation, EveryPresetFindsCopiesOfABracket)
{
  const std::pair<meam::Preset, int> least[] = { { meam::Preset::Paper, 3 }, { meam::Preset::Recommended, 3 },
    { meam::Preset::WithoutMEAM, 1 }, { meam::Preset::OriginalPPF, 1 }, { meam::Preset::B2B, 2 } };
  for (const auto& [preset, copies] : least)
  {
    const meam::Poses poses =
      scenes::estimatePoses(scenes::bracket(preset), threeSeen(), meam::detectionSettings(preset, 8));
    EXPECT_GE(instancesFound(poses, 0.5, 1.5), copies) << meam::nameOf(preset);
  }
}

TEST(MEAMPoseEstimation, TheOrderOfPointsDoesNotMatter)
{
  scenes::Seen shuffled = threeSeen();
  meam::Random random(3);
  random.shuffle(shuffled.edges.points);
  random.shuffle(shuffled.surface);
  expectNear(found(threeSeen()), found(shuffled));
}

TEST(MEAMPoseEstimation, AMotionInDoublePrecisionMovesThePosesAndNothingElse)
{
  const scenes::Seen& scene = threeSeen();
  const meam::Poses before = found(scene);
  const meam::PrecisePoints edges = parts::precise(scene.edges.points), measured = parts::precise(scene.surface);
  std::mt19937 random(8);
  for (const double distance : { 200.0, 1e6 })
  {
    const Eigen::Isometry3d T = parts::motion(random, distance);
    const meam::PrecisePoints movedEdges = parts::moved(edges, T), movedMeasured = parts::moved(measured, T);
    const Eigen::Isometry3d frame = meam::principalFrame(movedEdges);
    const meam::SceneInput input{ meam::toLocalCloud(movedEdges, {}, {}, frame),
      meam::toLocalPoints(meam::ScanPoints<double>{ movedMeasured.front().data(), movedMeasured.size() }, frame),
      { false, T * scene.sensor.position, T.linear() * scene.sensor.direction } };
    const meam::Poses after = meam::estimatePoses(scenes::bracket(), input, recommended(3));
    ASSERT_EQ(after.size(), before.size());
    for (std::size_t i = 0; i < before.size(); ++i)
    {
      EXPECT_TRUE(scenes::areNear(T * before[i].T_scene_model, after[i].T_scene_model, 1e-3, 1e-3)) << i;
      EXPECT_NEAR(after[i].probability, before[i].probability, 1e-4) << i;
      EXPECT_TRUE(meam::moved(before[i], T).fit.covariance.isApprox(after[i].fit.covariance, 1e-3)) << i;
    }
  }
}

TEST(MEAMPoseEstimation, PosesMoveWithTheScene)
{
  const scenes::Seen& scene = threeSeen();
  const meam::Poses before = found(scene);
  std::mt19937 random(8);
  for (int trial = 0; trial < 3; ++trial)
  {
    const Eigen::Isometry3d T = parts::motion(random, 200.0);
    scenes::Seen turned = scene;
    turned.edges.points = meam::moved(scene.edges.points, T);
    turned.surface = meam::moved(scene.surface, T);
    turned.sensor.direction = T.linear() * scene.sensor.direction;
    const meam::Poses after = found(turned);
    ASSERT_EQ(after.size(), before.size());
    // Rounding to single precision moves a point over the border of its cube now and then; nothing more may change.
    const auto expected =
      meam::mapped<Eigen::Isometry3d>(before, [&](const meam::Pose& pose) { return T * pose.T_scene_model; });
    EXPECT_EQ(scenes::copiesFound(after, expected, 0.02, 0.05), static_cast<int>(before.size())) << trial;
  }
}

TEST(MEAMPoseEstimation, AModelOfTheMeshesEdgesFindsThemToo)
{
  meam::TrainingSettings training = meam::trainingSettings(meam::Preset::Recommended);
  training.visibility.method = meam::VisibilityMethod::MeshVisibility;
  training.boundary.method = meam::BoundaryMethod::MeshEdges;
  EXPECT_EQ(instancesFound(foundBy(meam::trainModel(parts::lBracket(), training)), 1.0, 1.0), 3);
}

TEST(MEAMPoseEstimation, AModelOfTheWholePartWithoutVisibilityFindsThemToo)
{
  meam::TrainingSettings training = meam::trainingSettings(meam::Preset::Recommended);
  training.visibility.viewpoints = 0;
  const meam::TrainedModel model = meam::trainModel(parts::lBracket(), training);
  EXPECT_EQ(model.edgeViews, std::vector<std::uint32_t>(model.edges.size(), 1u));
  // Every pair that the table reaches is there: also of points that are never seen together.
  EXPECT_EQ(static_cast<int>(model.table.size()), model.table.votingPoints * (model.table.votingPoints - 1));
  EXPECT_EQ(instancesFound(foundBy(model), 1.0, 1.0), 3);
}

TEST(MEAMPoseEstimation, AnEdgeCloudAloneIsEnough)
{
  scenes::Seen scene = threeSeen();
  scene.surface.clear();
  EXPECT_EQ(instancesFound(found(scene), 2.0, 3.0), 3);
}

TEST(MEAMPoseEstimation, TheSignsOfTangentsDoNotMatter)
{
  scenes::Seen turned = scenes::seenCopies();
  std::mt19937 random(6);
  for (Eigen::Vector3f& tangent : turned.edges.tangents)
  {
    tangent *= random() % 2 == 0 ? 1.0f : -1.0f;
  }
  const meam::Poses one = found(scenes::seenCopies());
  EXPECT_EQ(instancesFound(one, 0.3, 0.4), 3);
  expectNear(one, found(turned));
}

TEST(MEAMPoseEstimation, TangentsThatAreNoneAreLeftOut)
{
  scenes::Seen broken = scenes::seenCopies();
  broken.edges.tangents[7].y() = NAN;
  broken.edges.tangents[20].x() = INFINITY;
  broken.edges.tangents[33].setZero();
  EXPECT_EQ(instancesFound(found(broken), 0.3, 0.4), 3);
  for (const meam::Pose& pose : scenes::detect(broken.edges, scenes::bracket()))
  {
    EXPECT_TRUE(pose.T_scene_model.matrix().allFinite());
  }
}

TEST(MEAMPoseEstimation, StrayPointsDoNotMatter)
{
  scenes::Seen one = threeSeen(), many = one;
  one.surface.push_back({ 1e12f, 0.0f, 0.0f });
  one.edges.points.push_back({ 0.0f, 1e9f, 0.0f });
  EXPECT_EQ(instancesFound(found(one), 0.3, 0.4), 3);
  // What some sensors write where they measured nothing.
  many.surface.insert(many.surface.end(), many.surface.size() / 9, { 1e10f, 1e10f, -1e10f });
  for (const bool perspective : { false, true })
  {
    many.sensor.perspective = perspective;
    many.sensor.position = { 40.0, 40.0, 2000.0 };
    // Seen in parallel the cells of the depth map are too large for any surface: edges alone tell, and not which is
    // best.
    const meam::Poses poses = scenes::estimatePoses(scenes::bracket(), many, recommended(perspective ? 3 : 5));
    EXPECT_EQ(instancesFound(poses, 0.5, 0.6), 3) << perspective;
  }
}

TEST(MEAMPoseEstimation, MoreThanAHundredCopiesComeOut)
{
  const int side = SmallData ? 3 : 11;
  const auto copies = meam::ofIndices<Eigen::Isometry3d>(side * side,
    [&](int k) -> Eigen::Isometry3d
    { return scenes::lying(160.0 * (k % side), 160.0 * (k / side), 37.0 * k, k % 3 != 0); });
  const scenes::Seen scene = scenes::seenFromAbove(copies);
  const meam::Poses poses =
    scenes::estimatePoses(scenes::bracket(), scene, meam::detectionSettings(meam::Preset::Recommended, 0, 0, 0.5));
  // Of the nine of the small data one has no reference point that elects it.
  EXPECT_GE(scenes::copiesFound(poses, copies, 1.0, 1.0), copies.size() - (SmallData ? 1 : 0));
  EXPECT_LE(poses.size(), copies.size());
}

TEST(MEAMPoseEstimation, ThreadsDoNotMatter)
{
  EXPECT_TRUE(scenes::areSame(found(threeSeen(), 1), found(threeSeen(), 3)));
}

TEST(MEAMPoseEstimation, ProgressRisesAndAbortStops)
{
  steps::expectProgress(
    [](const meam::Progress& progress)
    {
      scenes::estimatePoses(
        scenes::bracket(), threeSeen(), meam::detectionSettings(meam::Preset::Recommended), nullptr, progress);
    },
    { 0.4 });
  steps::expectStops(
    [](const meam::Progress& progress) { meam::trainModel(parts::lBracket(), {}, progress); }, { 0.3 });
}

TEST(MEAMPoseEstimation, BadInput)
{
  EXPECT_THROW(meam::trainModel({}, {}), meam::Error);
  EXPECT_THROW(scenes::estimatePoses(scenes::bracket(), {}, {}), meam::Error);
}

TEST(MEAMPoseEstimation, AnObserverSeesWhatEachStageReturns)
{
  const meam::Scene& scene = scenes::copiesScene();
  const meam::TrainedModel& model = scenes::bracket();
  const meam::DetectionSettings settings = recommended(0);
  std::vector<std::pair<meam::PoseStage, meam::Poses>> seenStages;
  const meam::Poses ranked = meam::findPoses(scene, model, settings, nullptr, {},
    [&](meam::PoseStage stage, const meam::Poses& poses) { seenStages.emplace_back(stage, poses); });
  ASSERT_EQ(seenStages.size(), 7u);
  for (int k = 0; k < 7; ++k)
  {
    EXPECT_EQ(static_cast<int>(seenStages[k].first), k);
  }
  EXPECT_TRUE(scenes::areSame(seenStages[0].second, meam::detectPoses(scene, model, settings.detection)));
  EXPECT_EQ(seenStages[4].second.size(), seenStages[3].second.size()); // refinement keeps all
  EXPECT_TRUE(scenes::areSame(seenStages[6].second, ranked));
  EXPECT_TRUE(scenes::areSame(ranked, meam::rankCandidates(seenStages[0].second, scene, model, settings)));
  EXPECT_TRUE(scenes::areSame(ranked, meam::findPoses(scene, model, settings)));
}

TEST(MEAMPoseEstimation, ASearchForAFewPosesEndsWithThoseThatAreSure)
{
  const meam::Scene& scene = scenes::copiesScene();
  const meam::TrainedModel& model = scenes::bracket();
  const auto votersFor = [&](int asked, meam::Poses& found)
  {
    std::size_t voters = 0;
    meam::DetectionSettings settings = recommended(asked);
    settings.detection.referenceShare = 1.0;
    found = meam::findPoses(scene, model, settings, nullptr, {},
      [&](meam::PoseStage stage, const meam::Poses& poses)
      { voters = stage == meam::PoseStage::Voting ? poses.size() : voters; });
    return voters;
  };
  meam::Poses all, first, three;
  const std::size_t voters = votersFor(0, all);
  ASSERT_GE(all.size(), 3u);
  EXPECT_LT(votersFor(1, first), voters / 3) << "three are sure";
  ASSERT_EQ(first.size(), 1u);
  EXPECT_TRUE(std::any_of(all.begin(), all.begin() + 3,
    [&](const meam::Pose& pose)
    { return meam::translationError(pose.T_scene_model, first[0].T_scene_model) < 0.01 * model.diameter; }));
  EXPECT_EQ(votersFor(3, three), voters) << "no more than three are there, so all vote";
  EXPECT_EQ(three.size(), 3u);
}

TEST(MEAMPoseEstimation, AtADeadlineWhatIsFoundComesOut)
{
  const meam::Scene& scene = scenes::copiesScene();
  const meam::TrainedModel& model = scenes::bracket();
  meam::DetectionSettings settings = recommended(3);
  meam::DetectionReport report;
  settings.deadline = meam::Deadline(1000.0);
  const meam::Poses unhurried = meam::findPoses(scene, model, settings, &report);
  EXPECT_FALSE(report.isCutShort);
  EXPECT_EQ(unhurried.size(), 3u);
  settings.deadline = meam::Deadline(0.0);
  EXPECT_TRUE(meam::findPoses(scene, model, settings, &report).empty());
  EXPECT_TRUE(report.isCutShort);
  // Somebody who asks to stop gets nothing, deadline or not.
  settings.deadline = meam::Deadline(1000.0);
  EXPECT_THROW(
    meam::findPoses(scene, model, settings, &report, [](double share) { return share < 0.5; }), meam::Aborted);
}

TEST(MEAMPoseEstimation, InstancesThatADeadlineLeavesUnfinishedComeOutAsTheyAre)
{
  const meam::Scene& scene = scenes::copiesScene();
  const meam::TrainedModel& model = scenes::bracket();
  meam::Poses verified;
  const meam::DetectionSettings settings = recommended(0);
  const meam::Poses finished = meam::findPoses(scene, model, settings, nullptr, {},
    [&](meam::PoseStage stage, const meam::Poses& poses)
    {
      if (stage == meam::PoseStage::Verification)
      {
        verified = poses;
      }
    });
  meam::PoseSelectionSettings hurried = settings.selection;
  hurried.deadline = meam::Deadline(0.0);
  const meam::Poses selected = meam::selectPoses(verified, scene, model, hurried);
  ASSERT_GE(selected.size(), 3u);
  for (int k = 0; k < 3; ++k)
  {
    EXPECT_TRUE(std::any_of(finished.begin(), finished.begin() + 3,
      [&](const meam::Pose& pose)
      { return meam::translationError(pose.T_scene_model, selected[k].T_scene_model) < 0.05 * model.diameter; }))
      << k;
  }
}
