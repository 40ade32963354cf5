// SPDX-License-Identifier: BSD-3-Clause
#include "pose/search/LocalSearch.h"

#include "TestScale.h"
#include "TestScene.h"

#include <algorithm>
#include <vector>

namespace
{
/// How many degrees a pose is off that was turned from the truth and is refined from its restarts.
double leftOf(const Eigen::AngleAxisd& turn, double probability = 0.5)
{
  const meam::TrainedModel& model = scenes::bracket();
  const meam::Scene& scene = scenes::copiesScene();
  const Eigen::Isometry3d truth = scene.T_local_scene() * scenes::threeCopies()[0];
  const Eigen::Vector3d middle = model.visibility->middle().cast<double>();
  meam::Pose pose;
  pose.T_scene_model = truth * meam::turnAbout(turn.axis(), turn.angle(), middle);
  pose.probability = probability;
  const meam::PoseComparison comparison(scene, model);
  const meam::EvidenceCollector collector(scene, model);
  meam::LocalSearchSettings settings;
  settings.aligns = settings.maximizes = false;
  return meam::rotationError(
    meam::LocalSearch(scene, model, comparison, collector, {}, settings).best(pose).pose.T_scene_model, truth);
}

const Eigen::Vector3d Up = Eigen::Vector3d::UnitZ();
}

TEST(LocalSearch, ATurnTooLargeForRefinementIsUndone)
{
  for (const double degrees : { -14.0, 14.0 })
  {
    EXPECT_LT(leftOf(Eigen::AngleAxisd(degrees * M_PI / 180.0, Up)), 1.0) << degrees;
  }
}

TEST(LocalSearch, ThePoseStaysWhereTheSceneSpeaksForNoOther) { EXPECT_LT(leftOf(Eigen::AngleAxisd(0.0, Up)), 0.3); }

TEST(LocalSearch, AnUnlikelyPoseIsNotWorthIt)
{
  EXPECT_NEAR(leftOf(Eigen::AngleAxisd(0.2, Up), 1e-4), 0.2 * 180.0 / M_PI, 1e-9);
}

namespace
{
/// Of 20 mm radius and 10 mm height; beyond x = `flat` it is cut off.
meam::TriangleMesh disc(float flat)
{
  std::vector<Eigen::Vector2f> outline;
  for (int k = 0; k < 72; ++k)
  {
    const double angle = 2.0 * M_PI * k / 72.0;
    outline.emplace_back(std::min(20.0f * static_cast<float>(std::cos(angle)), flat), 20.0 * std::sin(angle));
  }
  return parts::prism(outline, 10.0f);
}

meam::TriangleMesh cutDisc() { return disc(17.0f); }

const meam::TrainedModel& cutDiscModel() { return scenes::trained<cutDisc>(); }

Eigen::Isometry3d turned(double degrees)
{
  return meam::turnAbout(Eigen::Vector3d::UnitZ(), degrees * M_PI / 180.0, Eigen::Vector3d::Zero());
}

/// The pose after the decision in a scene in which a part lies as turned(0).
meam::Pose decided(const meam::TriangleMesh& part, double degrees, double probability = 0.9)
{
  const meam::Scene scene = scenes::alone(part, cutDiscModel(), Eigen::Isometry3d::Identity());
  const meam::PoseComparison comparison(scene, cutDiscModel());
  const meam::EvidenceCollector collector(scene, cutDiscModel());
  meam::Pose pose = scenes::displaced(scene.T_local_scene() * turned(degrees));
  pose.probability = probability;
  const meam::LocalSearchSettings settings{ false, false, false, true, false, false, false, {} };
  pose = meam::LocalSearch(scene, cutDiscModel(), comparison, collector, {}, settings).best(pose).pose;
  pose.T_scene_model = scene.T_local_scene().inverse() * pose.T_scene_model;
  return pose;
}
}

TEST(LocalSearch, ANearlyRoundPartIsTurnedToWhereItsFlatIs)
{
  for (const double degrees : SmallData ? std::vector{ 40.0 } : std::vector{ 0.0, 10.0, 40.0, 170.0 })
  {
    const meam::Pose found = decided(cutDisc(), degrees);
    EXPECT_LT(meam::rotationError(found.T_scene_model, turned(0)), 5.0) << degrees << ": half a step";
    EXPECT_GT(found.certainty, 0.5) << degrees << ": more than all others together";
  }
}

TEST(LocalSearch, WhereTheFlatIsNotSeenNoTurnIsSure)
{
  // The scene's disc has none: of 36 turns each is as likely as the others.
  const meam::Pose found = decided(disc(20.0f), 40.0);
  EXPECT_LT(found.certainty, 0.15);
  ASSERT_GT(found.alternatives.size(), 5u);
  double all = found.certainty;
  for (std::size_t k = 0; k < found.alternatives.size(); ++k)
  {
    all += found.alternatives[k].share;
    EXPECT_LE(found.alternatives[k].share, k == 0 ? found.certainty : found.alternatives[k - 1].share) << k;
    EXPECT_GT(meam::rotationError(found.alternatives[k].T_scene_model, found.T_scene_model), 4.0) << k;
  }
  EXPECT_LE(all, 1.0 + 1e-9);
  EXPECT_GT(all, 0.8) << "but for those below 1 %";
  EXPECT_GT(found.certainty, 0.01);
}

TEST(LocalSearch, OfAPlainBackNoRotationIsSure)
{
  const meam::TrainedModel& model = scenes::trained<parts::tower>();
  const Eigen::Isometry3d flipped(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
  for (const bool isBackUp : { true, false })
  {
    const Eigen::Isometry3d truth = isBackUp ? flipped : Eigen::Isometry3d::Identity();
    const meam::Scene scene = scenes::alone(parts::tower(), model, truth);
    const meam::PoseComparison comparison(scene, model);
    const meam::EvidenceCollector collector(scene, model);
    meam::Pose pose = scenes::displaced(scene.T_local_scene() * truth);
    pose.probability = 0.9;
    const meam::LocalSearchSettings settings{ false, false, false, true, false, false, false, {} };
    pose = meam::LocalSearch(scene, model, comparison, collector, {}, settings).best(pose).pose;
    ASSERT_EQ(pose.alternatives.size(), isBackUp ? 1u : 0u);
    if (isBackUp)
    {
      EXPECT_LT(pose.certainty, 0.75);
      const Eigen::Isometry3d half = meam::turnAbout(Eigen::Vector3d::UnitZ(), M_PI, Eigen::Vector3d(30.0, 20.0, 0.0));
      EXPECT_TRUE(scenes::areNear(pose.alternatives[0].T_scene_model, pose.T_scene_model * half, 1.0, 1.0));
    }
  }
}

TEST(LocalSearch, OfUnlikelyPosesNearSymmetriesAloneAreAskedAbout)
{
  EXPECT_GT(decided(disc(20.0f), 40.0, 0.001).certainty, decided(disc(20.0f), 40.0).certainty);
}
