// SPDX-License-Identifier: BSD-3-Clause
#include "pose/search/PatternSearch.h"

#include "TestScene.h"
#include "pose/refinement/FinalAlignment.h"
#include "pose/selection/PoseSelection.h"
#include "pose/verification/PoseVerification.h"

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
    return pose;
  }

  /// So far below where the bar lies, and turned about the axis that runs across its middle.
  meam::Pose sunken(double millimetres, double degrees) const
  {
    const Eigen::Vector3d middle = this->model.visibility->middle().cast<double>();
    meam::Pose pose;
    pose.T_scene_model = this->scene.T_local_scene() * Eigen::Translation3d(0.0, 0.0, -millimetres) *
                         meam::turnAbout(Eigen::Vector3d::UnitY(), degrees * M_PI / 180.0, middle);
    return pose;
  }

  meam::PatternSearch::Result best(const meam::Pose& pose, const meam::PatternSearchSettings& settings = {}) const
  {
    return meam::PatternSearch(this->collector, meam::EvidenceRates(), this->model, settings).best(pose.T_scene_model);
  }

  /// Of the bar at a pose from where it lies, mm and degrees.
  double offset(const Eigen::Isometry3d& T) const
  {
    return meam::translationError(T, this->scene.T_local_scene(), this->model.visibility->middle().cast<double>());
  }
  double turn(const Eigen::Isometry3d& T) const { return meam::rotationError(T, this->scene.T_local_scene()); }
};

template <int Length>
const Trial& trialOf()
{
  static const Trial trial(bar<Length>());
  return trial;
}

/// The bar of 54 mm, taken to be as long as its CAD file says.
struct SelectionTrial
{
  const Trial& trial = trialOf<54>();
  meam::Pose aligned = meam::alignRobustly(trial.displaced(6.0), trial.scene, trial.model);
  meam::PoseSelectionSettings settings;

  SelectionTrial()
  {
    this->settings.evidence.rates = meam::EvidenceRates();
    this->settings.search.halfTurns = this->settings.search.smallTurns = false;
  }
  meam::Pose selected(bool maximizes)
  {
    this->settings.search.maximizes = maximizes;
    const meam::Poses scored = meam::verifyPoses({ this->aligned }, this->trial.scene, this->trial.model);
    return meam::selectPoses(scored, this->trial.scene, this->trial.model, this->settings).at(0);
  }
};

double past(const meam::PoseEvidence& evidence) { return evidence.counts.past + evidence.counts.farPast; }
}

TEST(PatternSearch, APartThatIsShorterThanItsCADFileGivesWayWhereItHangsInTheAir)
{
  const Trial& trial = trialOf<54>();
  // One end fits, where least squares leave it; the other hangs 12 mm over the table.
  const meam::Pose pose = meam::alignRobustly(trial.displaced(6.0), trial.scene, trial.model);
  EXPECT_NEAR(trial.offset(pose.T_scene_model), 6.0, 0.5);
  const double before = past(trial.collector.collect(pose.T_scene_model));
  EXPECT_GT(before, 1.0);
  const meam::PatternSearch::Result best = trial.best(pose);
  EXPECT_TRUE(best.isMoved);
  EXPECT_LT(trial.offset(best.T_scene_model), 5.0);
  EXPECT_LT(past(best.evidence), 0.8 * before);
}

TEST(PatternSearch, APoseBelowASurfaceThatMayBeThePartsOwnIsRaised)
{
  const Trial& trial = trialOf<CADLength>();
  const meam::Pose pose = trial.sunken(3.0, -6.0);
  const meam::PatternSearch::Result best = trial.best(pose);
  EXPECT_TRUE(best.isMoved);
  EXPECT_LT(trial.offset(best.T_scene_model), 0.03 * trial.model.diameter) << "the tolerance";
  EXPECT_LT(trial.turn(best.T_scene_model), 2.0);
  EXPECT_LT(trial.collector.closelyHidden(best.T_scene_model), 0.1);
  meam::PatternSearchSettings settings;
  settings.ifClose = false;
  EXPECT_FALSE(trial.best(pose, settings).isMoved);
}

TEST(PatternSearch, TurnsBeforeShiftsEndHigherThanTheOtherWayRound)
{
  const Trial& trial = trialOf<CADLength>();
  const meam::PatternSearch::Result best = trial.best(trial.sunken(0.0, -8.0));
  EXPECT_LT(trial.turn(best.T_scene_model), 5.0);
  meam::PatternSearchSettings settings;
  settings.bothOrders = false;
  EXPECT_GT(best.logOdds, trial.best(trial.sunken(0.0, -8.0), settings).logOdds + 1.0);
}

TEST(PatternSearch, APoseStaysThatNothingContradictsOrThatIsUnlikely)
{
  const Trial& trial = trialOf<CADLength>();
  meam::PatternSearchSettings settings;
  const auto stays = [&](const meam::Pose& pose)
  {
    const meam::PatternSearch::Result best = trial.best(pose, settings);
    return !best.isMoved && best.T_scene_model.matrix() == pose.T_scene_model.matrix();
  };
  EXPECT_TRUE(stays(trial.displaced(0.3)));
  EXPECT_TRUE(stays(trial.displaced(40.0))) << "unlikely";
  EXPECT_FALSE(stays(trial.displaced(12.0)));
  settings.ifPast = settings.ifClose = false;
  EXPECT_TRUE(stays(trial.displaced(12.0)));
}

TEST(PatternSearch, APoseIsMovedNoFartherThanATenthOfTheDiameterAndPaysForIt)
{
  const Trial& trial = trialOf<CADLength>();
  const meam::PatternSearch::Result best = trial.best(trial.displaced(12.0, 5.0));
  EXPECT_TRUE(best.isMoved);
  EXPECT_LT(trial.offset(best.T_scene_model), 12.0 - 0.08 * trial.model.diameter);
  EXPECT_LT(trial.turn(best.T_scene_model), 2.5);
  EXPECT_GE(trial.offset(best.T_scene_model), 12.0 - 0.1 * trial.model.diameter - 1e-6);
  const meam::EvidenceCounts counts = trial.collector.collect(best.T_scene_model).counts;
  EXPECT_DOUBLE_EQ(best.logOdds, trial.collector.logOdds(counts, meam::EvidenceRates()) - 1.0);
}

TEST(PatternSearch, SelectionMovesAPoseAndItsCovarianceSaysByHowMuch)
{
  SelectionTrial trial;
  const meam::Pose before = trial.selected(false), after = trial.selected(true);
  const Eigen::Vector3d middle = trial.trial.model.visibility->middle().cast<double>();
  const double distance = meam::translationError(before.T_scene_model, after.T_scene_model, middle);
  EXPECT_GT(distance, 1.0);
  const Eigen::Matrix3d ofShifts = after.fit.covariance.bottomRightCorner<3, 3>();
  EXPECT_GE(ofShifts.trace(), 0.99 * distance * distance);
  EXPECT_GT(after.evidence, before.evidence);
}
