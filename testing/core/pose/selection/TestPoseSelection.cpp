// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/PoseSelection.h"

#include "TestScene.h"
#include "base/sequences/Sequences.h"

#include <gtest/gtest.h>

namespace
{
using scenes::displaced;
using scenes::gearAt;

/// Verified, then selected.
meam::Poses selected(const meam::Poses& poses, const meam::PoseSelectionSettings& settings = {},
  const meam::Scene& in = scenes::copiesScene(), const meam::TrainedModel& model = scenes::bracket())
{
  return scenes::select(scenes::verify(poses, in, model), in, model, settings);
}

/// Of an instance some.
meam::PoseSelectionSettings alternatives()
{
  meam::PoseSelectionSettings settings;
  settings.method = meam::SelectionMethod::Alternatives;
  return settings;
}

/// A pose that is so likely.
meam::Pose ranked(double value, const Eigen::Isometry3d& T)
{
  meam::Pose pose = displaced(T);
  pose.score = 1.0;
  pose.probability = value;
  pose.evidence = std::log(value / (1.0 - value));
  pose.visibleFraction = 1.0;
  return pose;
}

/// Far from each other, and from all else.
Eigen::Isometry3d place(int k) { return Eigen::Isometry3d(Eigen::Translation3d(200.0 * k, 0, 0)); }

const meam::TrainedModel& cutPlateModel() { return scenes::trained<parts::cutPlate>(); }

Eigen::Isometry3d quarter(int turns)
{
  return meam::turnAbout(Eigen::Vector3d::UnitZ(), turns * M_PI / 2, Eigen::Vector3d::Zero());
}

/// It lies as quarter(0).
const meam::Scene& plateScene()
{
  static const meam::Scene scene = scenes::alone(parts::cutPlate(), cutPlateModel(), quarter(0));
  return scene;
}
}

TEST(PoseSelection, OneInstanceIsReturnedOnce)
{
  meam::Poses candidates;
  for (const auto& T : scenes::threeCopies())
  {
    for (const double off : { 2.0, 0.0, 1.0 })
    {
      candidates.push_back(displaced(T, off, off));
    }
  }
  meam::PoseSelectionSettings settings;
  const meam::Poses best = selected(candidates, settings);
  ASSERT_EQ(best.size(), 3u);
  for (std::size_t i = 1; i < best.size(); ++i)
  {
    EXPECT_GE(best[i - 1].probability * std::sqrt(best[i - 1].visibleFraction),
      best[i].probability * std::sqrt(best[i].visibleFraction));
  }
  for (const int threads : { 1, 3 })
  {
    settings.threads = threads;
    EXPECT_TRUE(scenes::areSame(selected(candidates, settings), best));
  }
  settings.maximumPoses = 2;
  EXPECT_EQ(selected(candidates, settings).size(), 2u);
}

TEST(PoseSelection, OfVeryManyPosesAnInstanceIsReturnedOnce)
{
  // Turns in steps that are not the same pose yet; the right ones among them. More than are all compared.
  meam::Poses candidates;
  for (const auto& T : scenes::threeCopies())
  {
    for (int k = 0; k < 250; ++k)
    {
      candidates.push_back(displaced(T, 3.5 * (k % 16), 13.0 * (k / 16)));
    }
  }
  meam::PoseSelectionSettings settings;
  settings.minimumProbability = 0.5;
  const meam::Poses best = selected(candidates, settings);
  ASSERT_EQ(best.size(), 3u);
  for (const meam::Pose& pose : best)
  {
    const auto& truth = scenes::threeCopies();
    EXPECT_TRUE(std::any_of(truth.begin(), truth.end(),
      [&](const Eigen::Isometry3d& T) { return meam::translationError(pose.T_scene_model, T) < 0.15; }));
  }
}

TEST(PoseSelection, PosesWithLessThanTheMinimumProbabilityGo)
{
  meam::PoseSelectionSettings settings;
  settings.minimumProbability = 0.5;
  EXPECT_EQ(
    selected({ displaced(scenes::threeCopies()[0]), displaced(scenes::threeCopies()[1], 9.0, 20.0) }, settings).size(),
    1u);
}

TEST(PoseSelection, PosesThatMatchTheSameSurfaceAreOfOneInstance)
{
  // Farther apart than the cluster distance (10 % of 73.6 mm), but mostly on the same face.
  const Eigen::Isometry3d T = scenes::threeCopies()[0];
  const meam::Poses row = { displaced(T), displaced(T, 8.5) };
  EXPECT_EQ(selected(row, alternatives()).size(), 2u);
  meam::PoseSelectionSettings settings;
  settings.method = meam::SelectionMethod::Clusters;
  EXPECT_EQ(selected(row, settings).size(), 2u);
  const meam::Poses best = selected(row);
  ASSERT_EQ(best.size(), 1u);
  const meam::Pose aligned = scenes::align(displaced(T), scenes::copiesScene(), scenes::bracket());
  EXPECT_LT(
    meam::translationError(best[0].T_scene_model, aligned.T_scene_model), 1e-4); // not where the other came from
  EXPECT_LT(meam::translationError(best[0].T_scene_model, T), 0.15);
}

TEST(PoseSelection, AsManyComeOutAsAreAskedForHoweverUnlikely)
{
  meam::Poses poses;
  for (const auto& T : scenes::threeCopies())
  {
    poses.push_back(poses.empty() ? displaced(T) : displaced(T, 9.0, 20.0));
  }
  meam::PoseSelectionSettings settings;
  settings.maximumPoses = 2;
  EXPECT_EQ(selected(poses, settings).size(), 2u);
}

TEST(PoseSelection, PosesThatAreAlignedToOnePlaceAreOne)
{
  // Nearer than the scene tells apart, farther than the cluster distance.
  const Eigen::Isometry3d T = scenes::threeCopies()[0];
  meam::PoseSelectionSettings settings;
  settings.clusterDistance = 0.5;
  const meam::Poses best = selected({ displaced(T), displaced(T, 0.8, 0.5), displaced(T, -0.8, 0.5) }, settings);
  ASSERT_EQ(best.size(), 1u);
  EXPECT_LT(meam::translationError(best[0].T_scene_model, T), 0.15);
}

TEST(PoseSelection, TheOneThatIsLeftOfAnInstanceIsFarFromAllOthers)
{
  // Rows of poses, each within the cluster distance of its neighbours only.
  meam::Poses row;
  for (const auto& T : scenes::threeCopies())
  {
    for (int i = -4; i <= 4; ++i)
    {
      row.push_back(displaced(T, 4.0 * i, 40.0 * (i % 2)));
    }
  }
  meam::PoseSelectionSettings settings;
  settings.clusterDistance = 5.0;
  const meam::Poses best = selected(row, settings);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const auto& point : scenes::bracket().surface.points)
  {
    middle += point.cast<double>() / scenes::bracket().surface.size();
  }
  ASSERT_GE(best.size(), 3u);
  for (std::size_t a = 0; a < best.size(); ++a)
  {
    for (std::size_t b = 0; b < a; ++b)
    {
      EXPECT_GE((best[a].T_scene_model * middle - best[b].T_scene_model * middle).norm(), 5.0);
    }
  }
}

TEST(PoseSelection, AnInstanceIsTurnedWhereNoNearSymmetryLeads)
{
  const meam::Pose wrong = displaced(gearAt(18)); // teeth on gaps
  const meam::Poses found = selected({ wrong }, {}, scenes::gearScene(), scenes::trained<parts::gear>());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_LT(meam::rotationError(found[0].T_scene_model, gearAt(0)), 0.3);
  EXPECT_LT(meam::translationError(found[0].T_scene_model, gearAt(0)), 0.2);
  EXPECT_GT(found[0].fit.iterations, 0);
}

TEST(PoseSelection, OfNearSymmetriesTheSceneDecides)
{
  ASSERT_EQ(cutPlateModel().symmetries.near.size(), 7u);
  ASSERT_FALSE(cutPlateModel().symmetries.exact());
  for (int turns = 0; turns < 4; ++turns)
  {
    const meam::Poses found = selected({ displaced(quarter(turns)) }, {}, plateScene(), cutPlateModel());
    ASSERT_EQ(found.size(), 1u);
    EXPECT_LT(meam::rotationError(found[0].T_scene_model, quarter(0)), 1.0) << turns;
    EXPECT_GT(found[0].certainty, 0.99);
  }
}

TEST(PoseSelection, TurnsByNearSymmetriesAreOneAlternative)
{
  // All quarter turns, as they lie and upside down, and a tilted one: of two kept of the instance one is this.
  meam::Poses poses;
  const Eigen::Isometry3d flip = meam::turnAbout(Eigen::Vector3d::UnitX(), M_PI, Eigen::Vector3d(0, 0, 5));
  const Eigen::Isometry3d tilted = meam::turnAbout(Eigen::Vector3d::UnitX(), M_PI / 6, Eigen::Vector3d(0, 0, 5));
  for (int turns = 0; turns < 4; ++turns)
  {
    poses.push_back(displaced(quarter(turns)));
    poses.push_back(displaced(quarter(turns) * flip));
  }
  poses.push_back(displaced(tilted));
  const meam::Poses kept = selected(poses, alternatives(), plateScene(), cutPlateModel());
  ASSERT_EQ(kept.size(), 2u);
  EXPECT_NEAR(meam::rotationError(kept[1].T_scene_model, tilted), 0.0, 1e-4);
  meam::PoseSelectionSettings clusters;
  clusters.method = meam::SelectionMethod::Clusters;
  EXPECT_EQ(selected(poses, clusters, plateScene(), cutPlateModel()).size(), 1u) << "of each cluster one";
}

TEST(PoseSelection, TurnsOfANearlyRoundPartAreOneAlternative)
{
  meam::Poses candidates;
  for (const double degrees : { 0.0, 18.0, 36.0, 100.0 })
  {
    candidates.push_back(displaced(gearAt(degrees)));
  }
  candidates.push_back(displaced(gearAt(0) * Eigen::AngleAxisd(M_PI / 6.0, Eigen::Vector3d::UnitX()))); // tilted
  const meam::Poses kept = selected(candidates, alternatives(), scenes::gearScene(), scenes::trained<parts::gear>());
  ASSERT_EQ(kept.size(), 2u);
  const auto tilt = [&](int k) { return std::acos(std::abs(kept[k].T_scene_model.linear()(2, 2))) * 180.0 / M_PI; };
  EXPECT_NEAR(tilt(0), 0.0, 0.1);
  EXPECT_NEAR(tilt(1), 30.0, 0.1) << "the other place is the tilted one's";
}

TEST(PoseSelection, AlternativesThatAreNotWorthRefiningGo)
{
  const auto kept = [](int likely, meam::SelectionMethod method)
  {
    const auto poses =
      meam::ofIndices<meam::Pose>(70, [&](int k) { return ranked(k < likely ? 1e-6 : 1e-8, place(k)); });
    meam::PoseSelectionSettings settings;
    settings.method = method;
    return scenes::select(poses, scenes::copiesScene(), scenes::bracket(), settings);
  };
  const meam::Poses best = kept(65, meam::SelectionMethod::Alternatives);
  ASSERT_EQ(best.size(), 65u) << "all that are likely";
  EXPECT_TRUE(best.back().T_scene_model.isApprox(place(64), 1e-9)) << "as it came";
  EXPECT_EQ(kept(5, meam::SelectionMethod::Alternatives).size(), 60u) << "so many at least";
  EXPECT_EQ(kept(5, meam::SelectionMethod::Clusters).size(), 70u) << "asked of alternatives alone";
}

TEST(PoseSelection, WhereNothingWasMeasuredThereIsNothingToRefine)
{
  meam::Poses poses;
  for (const Eigen::Isometry3d& T : scenes::threeCopies())
  {
    poses.push_back(displaced(T));
    poses.push_back(displaced(T, 500.0));
  }
  EXPECT_EQ(selected(poses, alternatives()).size(), 3u);
}

TEST(PoseSelection, TheFirstOfEachClusterStaysAsItCame)
{
  meam::PoseSelectionSettings settings;
  settings.method = meam::SelectionMethod::Clusters;
  const meam::Poses poses{ ranked(0.8, place(0)),
    ranked(0.7, place(0) * Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitZ())), ranked(0.5, place(1)),
    ranked(0.2, place(2)) };
  const meam::Poses kept = scenes::select(poses, scenes::copiesScene(), scenes::bracket(), settings);
  ASSERT_EQ(kept.size(), 3u);
  EXPECT_EQ(kept[0].probability, 0.8);
  EXPECT_TRUE(kept[0].T_scene_model.isApprox(place(0), 1e-9));
  EXPECT_EQ(kept[1].probability, 0.5);
  settings.minimumProbability = 0.5;
  EXPECT_EQ(scenes::select(poses, scenes::copiesScene(), scenes::bracket(), settings).size(), 2u);
  settings.maximumPoses = 1;
  EXPECT_EQ(scenes::select(poses, scenes::copiesScene(), scenes::bracket(), settings).size(), 1u);
}

TEST(PoseSelection, NothingAndAbort)
{
  for (const auto method :
    { meam::SelectionMethod::Clusters, meam::SelectionMethod::Alternatives, meam::SelectionMethod::Instances })
  {
    meam::PoseSelectionSettings settings;
    settings.method = method;
    EXPECT_TRUE(scenes::select({}, scenes::copiesScene(), scenes::bracket(), settings).empty());
    EXPECT_THROW(scenes::select({ displaced(scenes::threeCopies()[0]) }, scenes::copiesScene(), scenes::bracket(),
                   settings, [](double) { return false; }),
      meam::Aborted);
  }
}
