// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/RotationSearch.h"

#include "TestScene.h"
#include "pose/verification/PoseVerification.h"
#include "mesh/TriangleMesh.h"

#include <gtest/gtest.h>

namespace
{
constexpr double Degree = M_PI / 180.0;

/// A gear of ten teeth, one of which is missing: turns by 36 degrees are near-symmetries.
meam::TriangleMesh gear()
{
  constexpr int Corners = 40;
  meam::TriangleMesh mesh;
  for (const float z : { 0.0f, 10.0f })
  {
    for (int k = 0; k < Corners; ++k)
    {
      const bool tooth = k % 4 < 2 && k >= 4;
      const double angle = 9 * k * Degree;
      mesh.vertices.emplace_back((tooth ? 34.0 : 28.0) * std::cos(angle), (tooth ? 34.0 : 28.0) * std::sin(angle), z);
    }
  }
  mesh.vertices.emplace_back(0, 0, 0);
  mesh.vertices.emplace_back(0, 0, 10);
  for (int k = 0; k < Corners; ++k)
  {
    const int next = (k + 1) % Corners;
    mesh.triangles.push_back({ next, k, 2 * Corners });
    mesh.triangles.push_back({ Corners + k, Corners + next, 2 * Corners + 1 });
    mesh.triangles.push_back({ k, next, Corners + next });
    mesh.triangles.push_back({ k, Corners + next, Corners + k });
  }
  return mesh;
}

const meam::TrainedModel& model()
{
  static const meam::TrainedModel trained =
    meam::trainModel(gear(), meam::trainingSettings(meam::Preset::Recommended));
  return trained;
}

Eigen::Isometry3d turned(double degrees)
{
  return Eigen::Translation3d(40, -20, 7) *
    meam::turnAbout(Eigen::Vector3d::UnitZ(), degrees * Degree, Eigen::Vector3d::Zero());
}

/// The gear at turned(0), seen from above.
const meam::Scene& scene()
{
  static const meam::Scene seen = []
  {
    meam::Scene scene = scenes::seenFromAbove({ scenes::Copy{ gear(), turned(0) } });
    scene.edges = parts::withTangents(scene.edges, model().diameter, scene.sensor.direction);
    return scene;
  }();
  return seen;
}
}

TEST(RotationSearch, FindsTheTurnThatEdgesExplain)
{
  ASSERT_FALSE(model().symmetries.near.empty());
  const meam::SceneIndex index(model(), scene());
  const meam::RotationSearch search(index);
  for (const double degrees : { 11.0, 36.0, 90.0, 144.0, 200.0 })
  {
    const std::vector<Eigen::Isometry3d> better = search.better(turned(degrees));
    ASSERT_FALSE(better.empty()) << degrees;
    EXPECT_LT(meam::rotationError(better[0], turned(0)), 2.0) << degrees; // the step of the search
    EXPECT_LT(meam::translationError(better[0], turned(0)), 0.5) << degrees;
  }
}

TEST(RotationSearch, TheTrueTurnIsLeftAlone)
{
  const meam::SceneIndex index(model(), scene());
  EXPECT_TRUE(meam::RotationSearch(index).better(turned(0)).empty());
}

TEST(RotationSearch, APartThatIsNotRoundHasNoAxis)
{
  const meam::Scene seen = scenes::withTangents(scenes::seenFromAbove(scenes::threeCopies()));
  const meam::SceneIndex index(scenes::bracket(), seen);
  Eigen::Isometry3d T = scenes::threeCopies()[0];
  T.rotate(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()));
  EXPECT_TRUE(meam::RotationSearch(index).better(T).empty());
}

TEST(RotationSearch, SelectionTurnsAPoseThatNoNearSymmetryLeadsFrom)
{
  meam::Pose wrong;
  wrong.T_scene_model = turned(18); // teeth on gaps
  meam::PoseVerificationSettings settings;
  settings.posesPerInstance = 1;
  const meam::Poses found = meam::verifyPoses({ wrong }, model(), scene(), settings);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_LT(meam::rotationError(found[0].T_scene_model, turned(0)), 0.3);
  EXPECT_LT(meam::translationError(found[0].T_scene_model, turned(0)), 0.2);
  EXPECT_GT(found[0].fit.iterations, 0);
}

TEST(RotationSearch, TheLikeliestNearSymmetryIsTheTrueTurn)
{
  const meam::SceneIndex index(model(), scene());
  const meam::RotationSearch search(index);
  for (const double degrees : { 0.0, 36.0, 108.0, 252.0 })
  {
    EXPECT_LT(meam::rotationError(search.likeliest(turned(degrees)), turned(0)), 2.0) << degrees;
  }
  const meam::Scene brackets = scenes::withTangents(scenes::seenFromAbove(scenes::threeCopies()));
  const meam::SceneIndex without(scenes::bracket(), brackets);
  const Eigen::Isometry3d T = scenes::threeCopies()[0];
  EXPECT_TRUE(meam::RotationSearch(without).likeliest(T).isApprox(T)) << "nothing to choose from";
}

TEST(RotationSearch, CandidatesThatATurnMakesTheSameTakeOnePlace)
{
  meam::Poses candidates;
  for (const double degrees : { 0.0, 18.0, 36.0, 100.0 })
  {
    candidates.emplace_back();
    candidates.back().T_scene_model = turned(degrees);
  }
  candidates.emplace_back(); // tilted
  candidates.back().T_scene_model = turned(0) * Eigen::AngleAxisd(30 * Degree, Eigen::Vector3d::UnitX());
  meam::PoseVerificationSettings settings; // two of an instance
  const meam::Poses kept = meam::verifyPoses(candidates, model(), scene(), settings);
  ASSERT_EQ(kept.size(), 2u);
  const auto tilt = [&](int k) { return std::acos(std::abs(kept[k].T_scene_model.linear()(2, 2))) / Degree; };
  EXPECT_NEAR(tilt(0), 0.0, 0.1);
  EXPECT_NEAR(tilt(1), 30.0, 0.1) << "the other place is the tilted one's";
}

TEST(RotationSearch, CandidatesOfWhichSomeMustGoTakeTheLikeliestTurn)
{
  meam::Poses candidates(2);
  candidates[0].T_scene_model = turned(108);
  candidates[1].T_scene_model = Eigen::Translation3d(0, 30, 0) * turned(0); // between nothing
  meam::PoseVerificationSettings settings;
  const meam::Poses judged = meam::verifyPoses({ candidates[0] }, model(), scene(), settings);
  ASSERT_EQ(judged.size(), 1u);
  EXPECT_TRUE(judged[0].T_scene_model.isApprox(turned(108), 1e-9)) << "a pose that is only judged stays";
  settings.maximumPoses = 1;
  const meam::Poses kept = meam::verifyPoses(candidates, model(), scene(), settings);
  ASSERT_EQ(kept.size(), 1u);
  EXPECT_LT(meam::rotationError(kept[0].T_scene_model, turned(0)), 1.0);
}
