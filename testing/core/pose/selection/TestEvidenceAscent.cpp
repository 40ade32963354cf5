// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/EvidenceAscent.h"

#include "TestScene.h"
#include "pose/refinement/FinalAlignment.h"

#include <gtest/gtest.h>

namespace
{
/// 20 mm wide and 12 mm high on its face z = 0.
template <int Length>
meam::TriangleMesh bar()
{
  return parts::box({ -0.5f * Length, -10.0f, 0.0f }, { 0.5f * Length, 10.0f, 12.0f });
}

constexpr int CADLength = 66;

meam::Scene onATable(const meam::TriangleMesh& bar, const meam::TrainedModel& model)
{
  const Eigen::Isometry3d inPlace = Eigen::Isometry3d::Identity();
  const meam::TriangleMesh table = parts::box({ -100.0f, -100.0f, -10.0f }, { 100.0f, 100.0f, 0.0f });
  const scenes::Seen seen = scenes::seenFromAbove({ { bar, inPlace }, { table, inPlace } });
  return scenes::prepared(scenes::withTangents(seen, model.diameter), model.diameter);
}

/// A bar on a table, taken to be as long as its CAD file says, where one lies that may be shorter.
struct Trial
{
  const meam::TrainedModel& model = scenes::trained<bar<CADLength>>();
  meam::Scene scene;
  meam::EvidenceCollector collector;

  explicit Trial(const meam::TriangleMesh& scanned)
    : scene(onATable(scanned, model))
    , collector(scene, model)
  {
  }

  /// So far along and turned from where the bar's middle lies, in the local frame.
  meam::Pose displaced(double millimetres, double degrees = 0.0) const
  {
    meam::Pose pose = scenes::displaced(Eigen::Isometry3d::Identity(), millimetres, degrees);
    pose.T_scene_model = this->scene.T_local_scene() * pose.T_scene_model;
    pose.probability = 0.5;
    return pose;
  }

  meam::EvidenceAscent::Place best(const meam::Pose& pose, const meam::EvidenceAscentSettings& settings = {}) const
  {
    return meam::EvidenceAscent(this->collector, meam::EvidenceRates(), this->model, settings).best(pose);
  }

  /// Of the bar at a pose from where it lies, mm and degrees.
  double offset(const Eigen::Isometry3d& T) const
  {
    return meam::translationError(T, this->scene.T_local_scene(), this->model.visibility->middle().cast<double>());
  }
  double turn(const Eigen::Isometry3d& T) const { return meam::rotationError(T, this->scene.T_local_scene()); }
};

double past(const meam::PoseEvidence& evidence) { return evidence.counts.past + evidence.counts.farPast; }
}

TEST(EvidenceAscent, APartThatIsShorterThanItsCADFileGivesWayWhereItHangsInTheAir)
{
  const Trial trial(bar<54>());
  // One end fits, where least squares leave it; the other hangs 12 mm over the table.
  meam::Pose pose = meam::alignRobustly(trial.displaced(6.0), trial.scene, trial.model);
  EXPECT_NEAR(trial.offset(pose.T_scene_model), 6.0, 0.5);
  pose.probability = 0.5;
  const double before = past(trial.collector.collect(pose.T_scene_model));
  EXPECT_GT(before, 1.0);
  const meam::EvidenceAscent::Place place = trial.best(pose);
  EXPECT_TRUE(place.isMoved);
  EXPECT_LT(trial.offset(place.T_scene_model), 5.0);
  EXPECT_LT(past(place.evidence), 0.8 * before);
}

TEST(EvidenceAscent, AMotionOfAFewPercentIsUndone)
{
  const Trial trial(bar<CADLength>());
  const meam::EvidenceAscent::Place place = trial.best(trial.displaced(8.0, 5.0));
  EXPECT_TRUE(place.isMoved);
  EXPECT_LT(trial.offset(place.T_scene_model), 0.03 * trial.model.diameter) << "the tolerance";
  EXPECT_LT(trial.turn(place.T_scene_model), 2.5);
  EXPECT_EQ(past(place.evidence), 0.0);
}

TEST(EvidenceAscent, APoseThatNothingContradictsOrThatIsUnlikelyStays)
{
  const Trial trial(bar<CADLength>());
  const auto stays = [&](const meam::Pose& pose)
  {
    const meam::EvidenceAscent::Place place = trial.best(pose);
    return !place.isMoved && place.T_scene_model.matrix() == pose.T_scene_model.matrix();
  };
  EXPECT_TRUE(stays(trial.displaced(0.3)));
  meam::Pose pose = trial.displaced(8.0);
  EXPECT_FALSE(stays(pose));
  pose.probability = 1e-4;
  EXPECT_TRUE(stays(pose));
}

TEST(EvidenceAscent, ThePriceIsPaidForAMotionAndADearerOneIsNotMade)
{
  const Trial trial(bar<CADLength>());
  const meam::Pose pose = trial.displaced(8.0);
  meam::EvidenceAscentSettings settings;
  settings.price = 0.0;
  const meam::EvidenceAscent::Place free = trial.best(pose, settings);
  settings.price = 1.5;
  const meam::EvidenceAscent::Place paid = trial.best(pose, settings);
  EXPECT_TRUE(paid.T_scene_model.matrix() == free.T_scene_model.matrix());
  EXPECT_DOUBLE_EQ(paid.logOdds, free.logOdds - 1.5);
  EXPECT_DOUBLE_EQ(free.logOdds, trial.collector.logOdds(free.evidence.counts, meam::EvidenceRates()));
  settings.price = 1e6;
  EXPECT_FALSE(trial.best(pose, settings).isMoved);
}
