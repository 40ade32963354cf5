// SPDX-License-Identifier: BSD-3-Clause
#include "pose/diagnosis/PoseDiagnosis.h"

#include "TestScene.h"
#include "TestSteps.h"
#include "base/Bounds.h"
#include "base/sequences/Sequences.h"
#include "pose/verification/PoseVerification.h"

using meam::LossCause;
using meam::PoseStage;

namespace
{
const Eigen::Isometry3d Here = scenes::lying(90, 10, 131, false); // the second of the three copies

/// A large plate at a height above the second copy, from `y` on.
scenes::Seen covered(double y)
{
  std::vector<scenes::Copy> copies = scenes::brackets(scenes::threeCopies());
  copies.push_back({ parts::box({ 40, static_cast<float>(y), 60 }, { 140, 70, 64 }), Eigen::Isometry3d::Identity() });
  return scenes::withTangents(scenes::seenFromAbove(copies));
}

meam::Diagnosis diagnose(const scenes::Seen& seen, const Eigen::Isometry3d& T_scene_model,
  const meam::DetectionSettings& detection = meam::detectionSettings(meam::Preset::Recommended, 0, 0, 0.5),
  bool fit = true)
{
  const meam::Scene scene = scenes::prepared(seen);
  meam::PoseDiagnosis diagnosis(scene, scenes::bracket(), detection, fit);
  return diagnosis.atPose(T_scene_model);
}

template <typename Predicate>
void removeEdges(scenes::Seen& seen, Predicate&& isRemoved)
{
  const std::vector<int> kept =
    meam::indicesWhere(seen.edges.size(), [&](int k) { return !isRemoved(seen.edges.points[k]); });
  seen.edges = seen.edges.subset(kept);
}

/// Of how many of the three copies the cause is this one, lost in this stage.
int lostBy(const meam::DetectionSettings& detection, LossCause cause, PoseStage stage)
{
  meam::PoseDiagnosis diagnosis(scenes::copiesScene(), scenes::bracket(), detection);
  return static_cast<int>(std::count_if(scenes::threeCopies().begin(), scenes::threeCopies().end(),
    [&](const Eigen::Isometry3d& T)
    {
      const meam::Diagnosis of = diagnosis.atPose(T);
      return of.cause == cause && of.lostIn == stage;
    }));
}

meam::DetectionSettings recommended(int poses = 0) { return meam::detectionSettings(meam::Preset::Recommended, poses); }

/// Whether a point is near the second copy.
bool isHere(const Eigen::Vector3f& point)
{
  const Eigen::Vector3d middle = Here * scenes::bracket().visibility->middle().cast<double>();
  return (point.cast<double>() - middle).head<2>().norm() < 0.6 * scenes::bracket().diameter;
}
}

TEST(PoseDiagnosis, WhatIsFoundIsFound)
{
  const meam::Diagnosis diagnosis = diagnose(scenes::seenCopies(), Here);
  EXPECT_EQ(diagnosis.cause, LossCause::None);
  EXPECT_FALSE(diagnosis.lostIn);
  EXPECT_GE(diagnosis.rank, 1);
  EXPECT_LE(diagnosis.rank, 3);
  EXPECT_LT(diagnosis.offset.distance, 0.5);
  EXPECT_LT(diagnosis.offset.angle, 0.5);
  ASSERT_TRUE(diagnosis.place);
  EXPECT_LT(meam::translationError(diagnosis.place->T_scene_model, Here), 0.5);
  EXPECT_GT(diagnosis.place->probability, 0.9);
  EXPECT_GT(diagnosis.surfaceShare, 0.9);
  ASSERT_EQ(diagnosis.stages.size(), 7u);
  for (const meam::StageCount& stage : diagnosis.stages)
  {
    EXPECT_GT(stage.here, 0);
    EXPECT_GE(stage.bestRank, 1);
    EXPECT_LE(stage.bestRank, stage.poses);
  }
  ASSERT_TRUE(diagnosis.found);
  EXPECT_EQ(diagnosis.found->placeProbability, diagnosis.probability);
  EXPECT_STREQ(diagnosis.odds.terms.front().what, "visible surface");
  // The points are where the part is.
  for (const Eigen::Vector3d& point : diagnosis.surfacePoints)
  {
    EXPECT_TRUE(isHere(point.cast<float>()));
  }
}

TEST(PoseDiagnosis, APoseLaidByHandIsFittedFirst)
{
  const Eigen::Isometry3d byHand = scenes::displaced(Here, 3.0, 6.0).T_scene_model;
  const meam::Diagnosis fitted = diagnose(scenes::seenCopies(), byHand);
  EXPECT_EQ(fitted.cause, LossCause::None);
  EXPECT_LT(fitted.offset.distance, 0.5);
  const meam::Diagnosis unfitted =
    diagnose(scenes::seenCopies(), byHand, meam::detectionSettings(meam::Preset::Recommended), false);
  EXPECT_NEAR(unfitted.offset.angle, 6.0, 0.5);
  EXPECT_EQ(unfitted.cause, LossCause::Inaccurate);
}

TEST(PoseDiagnosis, APartWithoutEdgesIsLostAtItsEdges)
{
  scenes::Seen seen = scenes::seenCopies();
  removeEdges(seen, isHere);
  meam::DetectionSettings detection = meam::detectionSettings(meam::Preset::Recommended);
  detection.detection.features = meam::Features::Edges;
  const meam::Diagnosis diagnosis = diagnose(seen, Here, detection);
  EXPECT_EQ(diagnosis.cause, LossCause::FewEdges);
  EXPECT_EQ(diagnosis.lostIn, PoseStage::Voting);
  EXPECT_EQ(diagnosis.evidence.edgesMatched, 0);
  EXPECT_GT(diagnosis.evidence.edges, 50);
  EXPECT_GT(diagnosis.evidence.surfaceShare(meam::PointState::Matched), 0.9);
  EXPECT_TRUE(diagnosis.votes.empty());
  EXPECT_FALSE(diagnosis.isFoundByAllPoints);
  EXPECT_EQ(diagnosis.stages.front().here, 0);
}

TEST(PoseDiagnosis, APartUnderAnotherIsHidden)
{
  const meam::Diagnosis diagnosis = diagnose(covered(-50.0), Here);
  EXPECT_EQ(diagnosis.cause, LossCause::Hidden);
  EXPECT_TRUE(diagnosis.lostIn);
  EXPECT_LT(diagnosis.place->visibleFraction, 0.05);
}

TEST(PoseDiagnosis, NoPartLiesInTheFloor)
{
  scenes::Seen seen = scenes::seenCopies();
  parts::add(seen.surface, parts::lattice({ -160, -160 }, { 260, 260 }, 1.0f, -1.0f));
  // Beside the copies, with its upper side in the floor.
  Eigen::Isometry3d in = scenes::lying(50, 200, 0);
  const Eigen::AlignedBox3f part = meam::bounds(meam::moved(scenes::bracket().surface.points, in));
  in.pretranslate(Eigen::Vector3d(0, 0, -1.0 - part.max().z()));
  const meam::Diagnosis diagnosis = diagnose(seen, in, meam::detectionSettings(meam::Preset::Recommended), false);
  EXPECT_EQ(diagnosis.cause, LossCause::Enclosed);
  EXPECT_GT(diagnosis.evidence.behind, 0.5);
  EXPECT_GT(diagnosis.evidence.points.counts.enclosed, 3.0);
  EXPECT_LT(diagnosis.place->probability, 0.01);
  EXPECT_EQ(diagnose(seen, Here).cause, LossCause::None) << "what lies on the floor is not in it";
}

TEST(PoseDiagnosis, WhereNothingIsTheSensorSawPastThePart)
{
  // On the floor of a scene there is one; a pose above it.
  scenes::Seen seen = scenes::seenCopies();
  parts::add(seen.surface, parts::lattice({ -60, 110 }, { 160, 260 }, 1.0f, 0.0f));
  Eigen::Isometry3d above = scenes::lying(50, 180, 0);
  above.pretranslate(Eigen::Vector3d(0, 0, 40));
  EXPECT_EQ(diagnose(seen, above).cause, LossCause::NotThere);
}

TEST(PoseDiagnosis, WhatWasNotMeasuredIsNotMeasured)
{
  scenes::Seen seen = scenes::seenCopies();
  removeEdges(seen, isHere);
  meam::eraseIf(seen.surface, isHere);
  const meam::Diagnosis diagnosis = diagnose(seen, Here);
  EXPECT_EQ(diagnosis.cause, LossCause::NotMeasured);
  EXPECT_EQ(diagnosis.lostIn, PoseStage::Voting);
}

TEST(PoseDiagnosis, LimitsAreNamed)
{
  const scenes::Seen seen = scenes::seenCopies();
  const meam::Scene scene = scenes::prepared(seen);
  meam::PoseDiagnosis all(scene, scenes::bracket(), recommended());
  meam::PoseDiagnosis one(scene, scenes::bracket(), recommended(1));
  for (const Eigen::Isometry3d& T : scenes::threeCopies())
  {
    const int rank = all.atPose(T).rank;
    const meam::Diagnosis diagnosis = one.atPose(T);
    EXPECT_EQ(diagnosis.cause, rank == 1 ? LossCause::None : LossCause::NotWanted);
    EXPECT_EQ(diagnosis.rankWithoutLimits, rank);
  }
  meam::DetectionSettings sure = meam::detectionSettings(meam::Preset::Recommended, 0, 0, 1.0);
  EXPECT_EQ(diagnose(seen, Here, sure).cause, LossCause::NotWanted);
}

TEST(PoseDiagnosis, WithoutReferencePointsOnThePartItIsTheirShare)
{
  // A hundred reference points among many edges elsewhere: most copies have none.
  scenes::Seen seen = scenes::seenCopies();
  parts::add(seen.edges.points, parts::lattice({ 400, 0 }, { 1900, 1500 }, 5.0f, 0.0f));
  seen.edges.tangents.resize(seen.edges.size(), Eigen::Vector3f::UnitZ());
  seen.edges.weights.resize(seen.edges.size(), 1.0f);
  const meam::Scene scene = scenes::prepared(seen);
  meam::DetectionSettings detection = recommended();
  detection.detection.features = meam::Features::Edges;
  detection.detection.referenceShare = 1e-6;
  meam::PoseDiagnosis diagnosis(scene, scenes::bracket(), detection);
  int lost = 0;
  for (const Eigen::Isometry3d& T : scenes::threeCopies())
  {
    const meam::Diagnosis of = diagnosis.atPose(T);
    lost += of.cause == LossCause::NoReference ? 1 : 0;
    EXPECT_EQ(of.cause == LossCause::NoReference, of.isFoundByAllPoints);
  }
  EXPECT_GE(lost, 2);
}

TEST(PoseDiagnosis, ScreeningOfTooLittleSurface)
{
  meam::DetectionSettings detection = recommended();
  detection.screening->enough = 0;
  detection.screening->leastSurface = 1.01; // none has so much
  const meam::Diagnosis diagnosis = diagnose(scenes::seenCopies(), Here, detection);
  EXPECT_EQ(diagnosis.cause, LossCause::SurfaceMissing);
  EXPECT_EQ(diagnosis.lostIn, PoseStage::Screening);
  EXPECT_GT(diagnosis.candidateShare, 0.7);
  EXPECT_LE(diagnosis.candidateShare, 1.0);
}

TEST(PoseDiagnosis, ScoresThatAreTooLow)
{
  meam::DetectionSettings detection = recommended();
  detection.candidateVerification.posesPerView = 1; // of two copies that are seen from the same side one
  EXPECT_EQ(lostBy(detection, LossCause::LowScore, PoseStage::CandidateVerification), 1);
}

TEST(PoseDiagnosis, CandidatesThatAreNotRefined)
{
  meam::DetectionSettings detection = recommended();
  detection.candidateSelection.maximumPoses = 1;
  EXPECT_EQ(lostBy(detection, LossCause::NotRefined, PoseStage::CandidateSelection), 2);
}

TEST(PoseDiagnosis, APoseInThePlaceOfAnother)
{
  // The same part turned about its own middle so that it shares most of the surface: one instance.
  const Eigen::Vector3d middle = scenes::bracket().visibility->middle().cast<double>();
  const Eigen::Isometry3d other = Here * meam::turnAbout(Eigen::Vector3d::UnitZ(), M_PI_2, middle);
  const meam::Diagnosis diagnosis = diagnose(scenes::seenCopies(), other, recommended(), false);
  EXPECT_NE(diagnosis.cause, LossCause::None);
  EXPECT_GE(diagnosis.takenBy, 1);
  EXPECT_GT(diagnosis.takenShare, 0.5);
  EXPECT_GT(diagnosis.takenEvidence, diagnosis.place->evidence);
}

TEST(PoseDiagnosis, APickedPointIsThatOfThePoseOnIt)
{
  meam::PoseDiagnosis diagnosis(scenes::copiesScene(), scenes::bracket(), recommended());
  const auto topOf = [](const Eigen::Isometry3d& T) // some point of its surface towards the sensor
  {
    const meam::PointCloud& surface = scenes::bracket().surface;
    Eigen::Vector3d best(0, 0, -1e9);
    for (const Eigen::Vector3f& point : surface.points)
    {
      const Eigen::Vector3d moved = T * point.cast<double>();
      best = moved.z() > best.z() ? moved : best;
    }
    return best;
  };
  const meam::Diagnosis found = diagnosis.atPoint(topOf(Here));
  EXPECT_EQ(found.cause, LossCause::None);
  EXPECT_LT(meam::translationError(found.place->T_scene_model, Here), 0.5);
  const meam::Diagnosis nothing = diagnosis.atPoint({ 500, 500, 0 });
  EXPECT_EQ(nothing.cause, LossCause::NoPose);
  EXPECT_FALSE(nothing.place);

  // A part that did not come out is found where the point is.
  meam::PoseDiagnosis one(scenes::copiesScene(), scenes::bracket(), recommended(1));
  int lost = 0;
  for (const Eigen::Isometry3d& T : scenes::threeCopies())
  {
    const meam::Diagnosis of = one.atPoint(topOf(T));
    ASSERT_TRUE(of.place);
    EXPECT_LT(meam::translationError(of.place->T_scene_model, T), 0.5);
    lost += of.cause == LossCause::NotWanted ? 1 : 0;
  }
  EXPECT_EQ(lost, 2);
}

TEST(PoseDiagnosis, APointAtThePartsOriginIsOnIt)
{
  const meam::TrainedModel& model = scenes::bracket();
  const Eigen::Isometry3d T = Here * Eigen::Translation3d(3, -2, 1);
  const auto distance = [&](double x, double y, double z)
  { return meam::distanceFrom(model, T, T * Eigen::Vector3d(x, y, z)); };
  EXPECT_EQ(distance(0.3, 0, 0), 0.0);
  EXPECT_GT(distance(0, 0, 500), 1.0); // as far as distances are known
}

TEST(PoseDiagnosis, OfAPoseThatCameOutItIsToldWhyThatDid)
{
  // Wrong, beside a copy, with its surface in the air: what another search would make of it does not count.
  meam::PoseDiagnosis diagnosis(scenes::copiesScene(), scenes::bracket(), recommended());
  meam::Pose wrong;
  wrong.T_scene_model = Eigen::Translation3d(7, 4, 9) * Here;
  wrong.placeProbability = 0.95;
  const auto check = [&](const meam::Diagnosis& of)
  {
    EXPECT_EQ(of.cause, LossCause::None);
    EXPECT_FALSE(of.lostIn);
    EXPECT_EQ(of.rank, 4);
    EXPECT_EQ(of.probability, 0.95);
    ASSERT_TRUE(of.place && of.found);
    EXPECT_LT(meam::translationError(of.place->T_scene_model, wrong.T_scene_model), 1e-3);
    EXPECT_FALSE(of.odds.terms.empty());
  };
  check(diagnosis.ofFound(wrong, 4));
  const Eigen::Vector3d on = wrong.T_scene_model * scenes::bracket().surface.points.front().cast<double>();
  meam::Pose right = wrong;
  right.T_scene_model = Here;
  check(diagnosis.atPoint(on, {}, { right, wrong }, { 1, 4 }));
  // Where the pose is unlikely, and another one of this search is there, it is that one.
  wrong.placeProbability = 0.1;
  const Eigen::Vector3d shared = Here * scenes::bracket().surface.points.front().cast<double>();
  wrong.T_scene_model = Eigen::Translation3d(0.1, 0, 0) * Here;
  EXPECT_GT(diagnosis.atPoint(shared, {}, { wrong }, { 4 }).probability, 0.5);
}

TEST(PoseDiagnosis, WhatIsToldAddsUpToTheEvidence)
{
  // Bars that are shorter than their CAD file's, so that poses are moved (PatternSearch), with few edges, so that it
  // counts.
  const auto bar = [](float length) {
    return parts::box({ -0.5f * length, -10.0f, 0.0f }, { 0.5f * length, 10.0f, 12.0f });
  };
  const meam::TrainedModel model = meam::trainModel(bar(66), meam::trainingSettings(meam::Preset::Recommended));
  const Eigen::Isometry3d table = Eigen::Isometry3d::Identity();
  std::vector<scenes::Copy> copies{ { parts::box({ -150.0f, -150.0f, -10.0f }, { 150.0f, 150.0f, 0.0f }), table } };
  for (const double place : { -60.0, 0.0, 60.0 })
  {
    const Eigen::AngleAxisd turn(place / 60.0, Eigen::Vector3d::UnitZ());
    copies.push_back({ bar(50), Eigen::Translation3d(place / 3.0, place, 0.0) * Eigen::Isometry3d(turn) });
  }
  scenes::Seen seen = scenes::withTangents(scenes::seenFromAbove(copies), model.diameter);
  int next = 0;
  removeEdges(seen, [&](const Eigen::Vector3f&) { return ++next % 3 != 0; });
  meam::DetectionSettings detection = recommended();
  meam::PoseSelectionSettings& selection = detection.selection; // nothing of what lies beside a pose counts
  selection.excludesOverlaps = selection.weighsLookalikes = selection.weighsDifferences = false;
  selection.weighsSize = selection.weighsMirrorImage = false;
  const meam::Scene scene = scenes::prepared(seen, model.diameter);
  meam::PoseDiagnosis diagnosis(scene, model, detection);
  const meam::Poses found = meam::toSceneFrame(diagnosis.trace().unlimited(), scene.T_local_scene(), model.symmetries);
  int moved = 0;
  for (std::size_t k = 0; k < found.size() && found[k].placeProbability >= 1e-3; ++k) // others are not finished
  {
    const meam::Diagnosis of = diagnosis.ofFound(found[k], static_cast<int>(k) + 1);
    meam::Pose told = found[k];
    meam::setEvidence(told, of.odds.sum());
    EXPECT_NEAR(told.evidence, found[k].evidence, 0.01) << k; // at the pose that a symmetry makes equal
    EXPECT_NEAR(of.lessByOthers, 0.0, 0.01);
    moved += of.penalty > 0.0 ? 1 : 0;
  }
  EXPECT_EQ(moved, 3);
}

TEST(PoseDiagnosis, ThePaperPresetIsToldOfToo)
{
  const meam::TrainedModel& model = scenes::bracket(meam::Preset::Paper);
  meam::PoseDiagnosis diagnosis(scenes::copiesScene(), model, meam::detectionSettings(meam::Preset::Paper, 0));
  for (const Eigen::Isometry3d& T : scenes::threeCopies())
  {
    const meam::Diagnosis of = diagnosis.atPose(T);
    EXPECT_EQ(of.stages.size(), 6u);
    EXPECT_EQ(of.cause == LossCause::None, !of.lostIn);
  }
}

TEST(PoseDiagnosis, ProgressRisesAndAbortStops)
{
  meam::PoseDiagnosis diagnosis(
    scenes::copiesScene(), scenes::bracket(), meam::detectionSettings(meam::Preset::Recommended));
  steps::expectProgress([&](const meam::Progress& progress) { diagnosis.atPose(Here, progress); }, { 0.2 });
  Eigen::Isometry3d broken = Here;
  broken.translation().x() = NAN;
  EXPECT_THROW(diagnosis.atPose(broken), meam::Error);
}
