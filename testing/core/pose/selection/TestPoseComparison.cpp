// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/PoseComparison.h"

#include "TestScene.h"
#include "mesh/SymmetryDetection.h"
#include "model/AppearanceModel.h"
#include "mesh/TriangleMesh.h"

#include <gtest/gtest.h>

namespace
{
/// A square plate of 60 x 60 x 10 mm with one corner cut off: quarter turns and flips are near-symmetries.
meam::TriangleMesh cutPlate()
{
  return parts::prism({ { -30, -30 }, { 30, -30 }, { 30, 20 }, { 6, 30 }, { -30, 30 } }, 10);
}

const meam::TrainedModel& plate()
{
  static const meam::TrainedModel model =
    meam::trainModel(cutPlate(), meam::trainingSettings(meam::Preset::Recommended));
  return model;
}

/// The plate lying as it was drawn, its upper side seen; with `hidden` the quarter of the cut is not.
meam::Scene lyingPlate(bool hidden)
{
  meam::SurfaceSamplingSettings sampling;
  sampling.spacing = 0.7;
  sampling.seed = 9;
  const meam::PointCloud part = meam::sampleSurface(cutPlate(), sampling);
  meam::AppearanceModel view;
  view.cloud = part.subset(meam::visiblePoints(part.points, { 0, 0, 2000 }, 1000.0));
  meam::Scene scene;
  scene.edges.points = meam::extractBoundary({ view })[0].cloud.points;
  scene.surface = view.cloud.points;
  const auto isHidden = [&](const auto& p) { return hidden && p.x() > 5 && p.y() > 5; };
  const auto drop = [&](meam::Points& points)
  { points.erase(std::remove_if(points.begin(), points.end(), isHidden), points.end()); };
  drop(scene.surface);
  drop(scene.edges.points);
  scene.sensor.perspective = false;
  scene.sensor.direction = -Eigen::Vector3d::UnitZ();
  scene.edges = parts::withTangents(scene.edges, plate().diameter, scene.sensor.direction);
  return scene;
}

Eigen::Isometry3d quarter(int turns);

/// Of the true pose over a quarter turn.
double advantageIn(const meam::Scene& scene, const meam::EvidenceSettings& settings = {})
{
  const meam::SceneIndex index(plate(), scene);
  const meam::PoseComparison comparison(index, settings);
  return comparison.advantage(comparison.contender(quarter(0)), comparison.contender(quarter(1)));
}

Eigen::Isometry3d quarter(int turns)
{
  return meam::turnAbout(Eigen::Vector3d::UnitZ(), turns * M_PI / 2, Eigen::Vector3d::Zero());
}
}

TEST(PoseComparison, TheCutCornerDecidesBetweenTurns)
{
  const meam::Scene scene = lyingPlate(false);
  const meam::SceneIndex index(plate(), scene);
  const meam::PoseComparison comparison(index);
  const auto at = [&](int turns) { return comparison.contender(quarter(turns)); };
  for (int turns = 1; turns < 4; ++turns)
  {
    const double advantage = comparison.advantage(at(0), at(turns));
    EXPECT_GT(advantage, 20.0) << turns;
    EXPECT_NEAR(comparison.advantage(at(turns), at(0)), -advantage, 1e-9) << "antisymmetric";
  }
  EXPECT_EQ(comparison.advantage(at(0), at(0)), 0.0);
}

TEST(PoseComparison, WhatIsFarBehindIsNotLookedAtToTheEnd)
{
  const meam::Scene scene = lyingPlate(false);
  const meam::SceneIndex index(plate(), scene);
  const meam::PoseComparison comparison(index);
  const meam::PoseComparison::Contender right = comparison.contender(quarter(0));
  const double whole = comparison.advantage(comparison.contender(quarter(1)), right);
  EXPECT_EQ(comparison.advantage(quarter(1), right, -1e9), whole);
  const double most = comparison.advantage(quarter(1), right, 1e9);
  EXPECT_GE(most, whole);
  EXPECT_LT(most, 0.0);
}

TEST(PoseComparison, WhatIsNotSeenDecidesNothing)
{
  const meam::Scene scene = lyingPlate(true);
  const meam::SceneIndex index(plate(), scene);
  const meam::PoseComparison comparison(index);
  const auto at = [&](int turns) { return comparison.contender(quarter(turns)); };
  // Turned by 180 degrees the cut would lie where whole surface was seen.
  EXPECT_GT(comparison.advantage(at(0), at(2)), 5.0);
  const meam::Scene nothing = [&]
  {
    meam::Scene half = scene;
    const auto far = [](const auto& p) { return std::abs(p.x()) > 10 || std::abs(p.y()) > 10; };
    half.surface.erase(std::remove_if(half.surface.begin(), half.surface.end(), far), half.surface.end());
    half.edges = half.edges.subset({ 0 });
    half.edges.points[0].x() += 1000.0f; // none here
    return half;
  }();
  EXPECT_LT(std::abs(advantageIn(nothing)), 1.0);
}

TEST(PoseComparison, NearSymmetriesAreSettledInVerification)
{
  ASSERT_EQ(plate().symmetries.near.size(), 7u);
  ASSERT_FALSE(plate().symmetries.exact());
  meam::PoseVerificationSettings settings;
  settings.posesPerInstance = 1;
  for (int turns = 0; turns < 4; ++turns)
  {
    meam::Pose wrong;
    wrong.T_scene_model = quarter(turns);
    const meam::Poses found = meam::verifyPoses({ wrong }, plate(), lyingPlate(false), settings);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_LT(meam::rotationError(found[0].T_scene_model, quarter(0)), 1.0) << turns;
    EXPECT_GT(found[0].certainty, 0.99);
  }
}

TEST(PoseComparison, TurnsByNearSymmetriesDoNotTakeThePlaceOfOtherPoses)
{
  // All quarter turns, as they lie and upside down, and one that stands on its side: of two kept of the instance one is this.
  meam::Poses poses;
  const Eigen::Isometry3d flip = meam::turnAbout(Eigen::Vector3d::UnitX(), M_PI, Eigen::Vector3d(0, 0, 5));
  const Eigen::Isometry3d side = meam::turnAbout(Eigen::Vector3d::UnitX(), M_PI / 2, Eigen::Vector3d(0, 0, 5));
  for (int turns = 0; turns < 4; ++turns)
  {
    for (const Eigen::Isometry3d& T : { quarter(turns), quarter(turns) * flip })
    {
      poses.emplace_back();
      poses.back().T_scene_model = T;
    }
  }
  poses.emplace_back();
  poses.back().T_scene_model = side;
  const meam::Poses kept = meam::verifyPoses(poses, plate(), lyingPlate(false));
  ASSERT_EQ(kept.size(), 2u);
  EXPECT_NEAR(meam::rotationError(kept[1].T_scene_model, side), 0.0, 1e-4);
}

TEST(PoseComparison, FloorSeenWhereAPoseHasSurfaceSpeaksAgainstIt)
{
  const meam::Scene onTheFloor = [&]
  {
    meam::Scene scene = lyingPlate(false);
    for (float x = -29.5f; x < 30.0f; x += 0.7f)
    {
      for (float y = -29.5f; y < 30.0f; y += 0.7f)
      {
        const bool besideTheCut = (x - 6.0f) * 10.0f + (y - 30.0f) * 24.0f > 0.0f; // beyond the line of the corner
        if (besideTheCut)
        {
          scene.surface.push_back({ x, y, -40.0f });
        }
      }
    }
    return scene;
  }();
  EXPECT_GT(advantageIn(onTheFloor), advantageIn(lyingPlate(false)) + 5.0);
  meam::EvidenceSettings settings;
  settings.freeSpace = false;
  EXPECT_LE(advantageIn(onTheFloor, settings), advantageIn(lyingPlate(false), settings));
}

TEST(PoseComparison, WhatBothPredictDoesNotCountUnlessEachIsJudgedOnItsOwn)
{
  // Over a quarter that the true pose and a quarter turn both cover the sensor looked past the plate: against either, by as
  // many points as it happens to predict there.
  const auto advantage = [](bool torn, bool sameVisibility)
  {
    meam::Scene scene = lyingPlate(false);
    for (auto& point : scene.surface)
    {
      point.z() -= torn && point.x() < -2 && point.y() < -2 ? 40.0f : 0.0f;
    }
    meam::EvidenceSettings settings;
    settings.sameVisibility = sameVisibility;
    const meam::SceneIndex index(plate(), scene);
    const meam::PoseComparison comparison(index, settings);
    return comparison.advantage(comparison.contender(quarter(0)), comparison.contender(quarter(1)));
  };
  EXPECT_NEAR(advantage(true, true), advantage(false, true), 1e-9);
  EXPECT_GT(std::abs(advantage(true, false) - advantage(false, false)), 1.0);
}

TEST(PoseComparison, EdgesAloneDecide)
{
  meam::Scene scene = lyingPlate(false);
  scene.surface.clear();
  EXPECT_GT(advantageIn(scene), 5.0);
}
