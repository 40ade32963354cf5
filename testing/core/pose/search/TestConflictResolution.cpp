// SPDX-License-Identifier: BSD-3-Clause
#include "pose/search/ConflictResolution.h"

#include "TestScale.h"
#include "TestScene.h"
#include "TestSteps.h"
#include "base/sequences/Sequences.h"
#include "mesh/TriangleMesh.h"
#include "pose/PartsEstimation.h"

#include <algorithm>

namespace
{
meam::TriangleMesh plate() { return parts::box({ 0, 0, 0 }, { 60, 40, 10 }); }
meam::TriangleMesh smallBlock() { return parts::box({ 0, 0, 0 }, { 20, 12, 10 }); }

using scenes::trained;

meam::Pose at(const Eigen::Isometry3d& T, double probability)
{
  meam::Pose pose;
  pose.T_scene_model = T;
  pose.score = 0.8;
  pose.probability = probability;
  pose.visibleFraction = 1.0;
  return pose;
}

Eigen::Isometry3d place(double x, double y, double z) { return Eigen::Isometry3d(Eigen::Translation3d(x, y, z)); }

scenes::Seen seen(const std::vector<scenes::Copy>& copies)
{
  return scenes::withTangents(scenes::seenFromAbove(copies), trained<plate>().diameter);
}

/// Poses of a type of part, in the scene's coordinates.
struct Found
{
  const meam::TrainedModel& model;
  meam::Poses poses;
};

/// What stays of two types, in the scene's coordinates.
std::vector<meam::PartPose> resolved(const scenes::Seen& seen, const Found& a, const Found& b,
  const meam::ConflictResolutionSettings& settings = {}, const meam::Progress& progress = {})
{
  const meam::Scene sceneA = scenes::prepared(seen, a.model.diameter),
                    sceneB = scenes::prepared(seen, b.model.diameter);
  const Eigen::Isometry3d& T = sceneA.T_local_scene();
  const meam::Poses posesA = meam::toLocalFrame(a.poses, T, a.model.symmetries);
  const meam::Poses posesB = meam::toLocalFrame(b.poses, T, b.model.symmetries);
  std::vector<meam::PartPose> stay =
    meam::resolveConflicts({ { sceneA, a.model, posesA }, { sceneB, b.model, posesB } }, settings, progress);
  for (meam::PartPose& pose : stay)
  {
    pose.pose = meam::toSceneFrame({ pose.pose }, T, (pose.part == 0 ? a : b).model.symmetries)[0];
  }
  return stay;
}

/// The types of the parts that stay of one pose of each of two types.
std::vector<int> typesLeft(const scenes::Seen& seen, const meam::TrainedModel& a, const meam::Pose& poseA,
  const meam::TrainedModel& b, const meam::Pose& poseB, const meam::ConflictResolutionSettings& settings = {})
{
  std::vector<int> types;
  for (const meam::PartPose& stays : resolved(seen, { a, { poseA } }, { b, { poseB } }, settings))
  {
    types.push_back(stays.part);
  }
  std::sort(types.begin(), types.end());
  return types;
}

using Types = std::vector<int>;
}

TEST(ConflictResolution, PartsSideBySideAreFoundOnceEach)
{
  if (SmallData)
  {
    GTEST_SKIP() << "all of what detects parts has its own tests";
  }
  // Two brackets and two plates; each type is looked for in the whole scene.
  const std::vector<scenes::Copy> copies = { { parts::lBracket(), scenes::lying(0, 0, 20) },
    { parts::lBracket(), scenes::lying(90, 10, 131, false) }, { parts::windowPlate(), scenes::lying(10, 75, 35) },
    { parts::windowPlate(), scenes::lying(100, 65, -70) } };
  const scenes::Seen raw = scenes::seenFromAbove(copies);
  const scenes::Seen scene = scenes::withTangents(raw, trained<plate>().diameter);
  const meam::DetectionSettings all = meam::detectionSettings(meam::Preset::Recommended, 0);
  const meam::TrainedModel& bracket = scenes::bracket();
  const meam::TrainedModel& window = trained<parts::windowPlate>();
  const Found brackets{ bracket, scenes::estimatePoses(bracket, raw, all) };
  const Found windows{ window, scenes::estimatePoses(window, raw, all) };
  const auto found = resolved(scene, brackets, windows);
  ASSERT_GE(found.size(), copies.size());
  const auto isAt = [](const meam::Pose& pose, const Eigen::Isometry3d& T)
  { return scenes::areNear(pose.T_scene_model, T, 0.5, 1.0); };
  // The four best are the four true ones, each of its own type.
  for (int i = 0; i < 4; ++i)
  {
    EXPECT_EQ(std::count_if(found.begin(), found.begin() + 4,
                [&](const auto& pose) { return pose.part == i / 2 && isAt(pose.pose, copies[i].T_scene_model); }),
      1)
      << "copy " << i;
  }
  for (std::size_t i = 4; i < found.size(); ++i)
  {
    EXPECT_LT(found[i].pose.probability, 0.5);
  }
  // The order of the parts makes no difference but for their numbers.
  const auto swapped = resolved(scene, windows, brackets);
  ASSERT_EQ(swapped.size(), found.size());
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    EXPECT_EQ(swapped[i].part, 1 - found[i].part);
    EXPECT_TRUE(swapped[i].pose.T_scene_model.matrix() == found[i].pose.T_scene_model.matrix());
  }
}

TEST(ConflictResolution, ThePlateWithItsWindowAndWithout)
{
  const Eigen::Isometry3d T = scenes::lying(5, -8, 25);
  const meam::TrainedModel& window = trained<parts::windowPlate>();
  const meam::TrainedModel& whole = trained<plate>();
  // At the same pose and equally likely: what is measured tells.
  const scenes::Seen open = seen({ { parts::windowPlate(), T } });
  EXPECT_EQ(typesLeft(open, window, at(T, 0.9), whole, at(T, 0.9)), Types{ 0 });
  EXPECT_EQ(typesLeft(open, whole, at(T, 0.9), window, at(T, 0.9)), Types{ 1 });
  const scenes::Seen closed = seen({ { plate(), T } });
  EXPECT_EQ(typesLeft(closed, window, at(T, 0.9), whole, at(T, 0.9)), Types{ 1 });
  // The whole chain comes to the same.
  for (const auto* scene : { &open, &closed })
  {
    const meam::DetectionSettings one = meam::detectionSettings(meam::Preset::Recommended, 1);
    const meam::Pose asWindow = scenes::estimatePoses(window, *scene, one).at(0);
    const meam::Pose asWhole = scenes::estimatePoses(whole, *scene, one).at(0);
    EXPECT_EQ(typesLeft(*scene, window, asWindow, whole, asWhole), Types{ scene == &open ? 0 : 1 });
  }
}

TEST(ConflictResolution, ASmallPartThatFitsInsideALargeOneLoses)
{
  const scenes::Seen scene = seen({ { plate(), place(0, 0, 0) } });
  const meam::TrainedModel& large = trained<plate>();
  const meam::TrainedModel& small = trained<smallBlock>();
  // Its upper face is the plate's; that it is the likelier one does not help it...
  EXPECT_EQ(typesLeft(scene, small, at(place(0, 0, 0), 0.95), large, at(place(0, 0, 0), 0.8)), Types{ 1 });
  EXPECT_EQ(typesLeft(scene, small, at(place(20, 14, 0), 0.95), large, at(place(0, 0, 0), 0.8)), Types{ 1 });
  // ...unless the large one hardly can be there: it is not where it should be.
  const scenes::Seen alone = seen({ { smallBlock(), place(0, 0, 0) } });
  EXPECT_EQ(typesLeft(alone, small, at(place(0, 0, 0), 0.95), large, at(place(0, 0, 0), 0.8)), Types{ 0 });
  EXPECT_EQ(typesLeft(scene, small, at(place(20, 14, 0), 0.99), large, at(place(0, 0, 0), 0.02)), Types{ 0 });
}

TEST(ConflictResolution, APoseIsOnAnotherTypesCopyWhereThatHasMuchMoreSupport)
{
  const meam::TrainedModel& large = trained<plate>();
  const meam::TrainedModel& small = trained<smallBlock>();
  const auto onOthers = [&](const Found& a, const Found& b)
  {
    const scenes::Seen raw = seen({ { plate(), place(0, 0, 0) } });
    const meam::Scene sceneA = scenes::prepared(raw, a.model.diameter),
                      sceneB = scenes::prepared(raw, b.model.diameter);
    const Eigen::Isometry3d& T = sceneA.T_local_scene();
    const meam::Poses posesA = meam::toLocalFrame(a.poses, T, a.model.symmetries);
    const meam::Poses posesB = meam::toLocalFrame(b.poses, T, b.model.symmetries);
    return meam::onOtherParts({ { sceneA, a.model, posesA }, { sceneB, b.model, posesB } });
  };
  using OnOthers = std::vector<std::vector<bool>>;
  const Found block{ small, { at(place(0, 0, 0), 0.6), at(place(500, 0, 0), 0.6) } };
  EXPECT_EQ(onOthers(block, { large, { at(place(0, 0, 0), 0.9) } }), (OnOthers{ { true, false }, { false } }));
  EXPECT_EQ(onOthers(block, { large, {} }), (OnOthers{ { false, false }, {} }));
  // Of its own type it is another pose; what is as well supported may be either type.
  const meam::Pose likely = at(place(0, 0, 0), 0.9), less = at(place(2, 0, 0), 0.2);
  EXPECT_EQ(onOthers({ large, { likely, less } }, { small, {} }), (OnOthers{ { false, false }, {} }));
  EXPECT_EQ(onOthers({ large, { likely } }, { large, { likely } }), (OnOthers{ { false }, { false } }));
}

TEST(ConflictResolution, ASmallPartOnTopOfALargeOneStays)
{
  const scenes::Seen scene = seen({ { plate(), place(0, 0, 0) }, { smallBlock(), place(20, 14, 10) } });
  const meam::TrainedModel& large = trained<plate>();
  const meam::TrainedModel& small = trained<smallBlock>();
  EXPECT_EQ(typesLeft(scene, small, at(place(20, 14, 10), 0.6), large, at(place(0, 0, 0), 0.99)), (Types{ 0, 1 }));
}

TEST(ConflictResolution, WithoutASurfaceEdgesDecide)
{
  const Eigen::Isometry3d T = scenes::lying(5, -8, 25);
  const scenes::Seen open = seen({ { parts::windowPlate(), T } });
  const meam::TrainedModel& window = trained<parts::windowPlate>();
  const meam::TrainedModel& whole = trained<plate>();
  scenes::Seen edgesOnly = open;
  edgesOnly.surface.clear();
  EXPECT_EQ(typesLeft(edgesOnly, whole, at(T, 0.9), window, at(T, 0.9)), Types{ 1 });
  const meam::Scene with = scenes::prepared(open, window.diameter);
  const meam::Scene without = scenes::prepared(edgesOnly, whole.diameter);
  const meam::Poses poses{ at(with.T_local_scene() * T, 0.9) };
  EXPECT_THROW(meam::resolveConflicts({ { with, window, poses }, { without, whole, poses } }), meam::Error);
}

TEST(ConflictResolution, ModelsWithoutASurfaceClaimWhatIsNearTheirEdges)
{
  const scenes::Seen scene = seen({ { plate(), place(0, 0, 0) } });
  meam::TrainedModel bare = trained<plate>();
  bare.surface = {};
  bare.deriveFields();
  EXPECT_EQ(typesLeft(scene, bare, at(place(0, 0, 0), 0.9), bare, at(place(0, 0, 0), 0.9)), Types{ 0 });
  EXPECT_EQ(typesLeft(scene, bare, at(place(0, 0, 0), 0.9), bare, at(place(500, 0, 0), 0.9)), (Types{ 0, 1 }));
}

TEST(ConflictResolution, EqualSupportIsDecidedInTurn)
{
  // The same model twice at the same pose: the claims are equal.
  const scenes::Seen scene = seen({ { plate(), place(0, 0, 0) } });
  const meam::TrainedModel& model = trained<plate>();
  meam::Pose pose = at(place(0, 0, 0), 0.995);
  EXPECT_EQ(typesLeft(scene, model, pose, model, pose), Types{ 0 }); // the order
  meam::Pose likelier = pose, better = pose;
  const meam::Pose freer = pose;
  likelier.probability = 0.999; // beyond what counts in the support
  better.score = 0.9;
  pose.visibleFraction = 0.9;
  EXPECT_EQ(typesLeft(scene, model, better, model, likelier), Types{ 1 });
  EXPECT_EQ(typesLeft(scene, model, freer, model, better), Types{ 1 });
  EXPECT_EQ(typesLeft(scene, model, pose, model, freer), Types{ 1 });
}

TEST(ConflictResolution, HowMuchMayBeShared)
{
  // Two plates that overlap by two thirds.
  const scenes::Seen scene = seen({ { plate(), place(0, 0, 0) } });
  const meam::TrainedModel& model = trained<plate>();
  meam::ConflictResolutionSettings settings;
  const meam::Pose shifted = at(place(20, 0, 0), 0.9);
  EXPECT_EQ(typesLeft(scene, model, at(place(0, 0, 0), 0.9), model, shifted, settings), Types{ 0 });
  settings.shared = 1.0;
  settings.maximumPoses = 1;
  EXPECT_EQ(typesLeft(scene, model, shifted, model, at(place(0, 0, 0), 0.9), settings), Types{ 1 });
  settings.maximumPoses = 0;
  EXPECT_EQ(typesLeft(scene, model, at(place(0, 0, 0), 0.9), model, shifted, settings), (Types{ 0, 1 }));
  EXPECT_EQ(typesLeft(scene, model, at(place(0, 0, 0), 0.9), model, at(place(500, 0, 0), 0.9)), (Types{ 0, 1 }));
}

TEST(ConflictResolution, ThreadsDoNotMatterAndAbortStops)
{
  const meam::TrainedModel& model = trained<plate>();
  const meam::Scene scene = scenes::prepared(seen({ { plate(), place(0, 0, 0) } }), model.diameter);
  auto poses = meam::ofIndices<meam::Pose>(
    40, [&](int i) { return at(place(3.0 * (i % 7), 2.0 * (i % 5), 0.5 * (i % 3)), 0.02 * i); });
  poses = meam::toLocalFrame(poses, scene.T_local_scene(), model.symmetries);
  meam::ConflictResolutionSettings one, three;
  one.threads = 1;
  three.threads = 3;
  const auto a = meam::resolveConflicts({ { scene, model, poses } }, one);
  const auto b = meam::resolveConflicts({ { scene, model, poses } }, three);
  EXPECT_TRUE(scenes::areSame(meam::posesOfPart(a, 0).poses, meam::posesOfPart(b, 0).poses));
  steps::expectStops(
    [&](const meam::Progress& progress) {
      meam::resolveConflicts({ { scene, model, poses } }, {}, progress);
    });
}

TEST(ConflictResolution, NothingAndBadSettings)
{
  EXPECT_TRUE(meam::resolveConflicts({}).empty());
  const meam::TrainedModel& model = trained<plate>();
  const meam::Scene scene = scenes::prepared(seen({ { plate(), place(0, 0, 0) } }), model.diameter);
  const meam::Poses none;
  EXPECT_TRUE(meam::resolveConflicts({ { scene, model, none } }).empty());
  meam::ConflictResolutionSettings settings;
  settings.shared = 1.5;
  EXPECT_THROW(meam::resolveConflicts({ { scene, model, none } }, settings), meam::Error);
}
