// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/Symmetries.h"

#include "TestParts.h"
#include "base/sequences/Sequences.h"
#include "io/ModelsInfo.h"
#include "pose/Pose.h"

#include <nlohmann/json.hpp>

namespace
{
const Eigen::Vector3d Centre(5, -3, 2);

Eigen::Isometry3d turn(const Eigen::Vector3d& axis, double degrees)
{
  return meam::turnAbout(axis, degrees * M_PI / 180.0, Centre);
}

/// Six turns about z, and with `flip` six half turns across it.
meam::Symmetries hexagon(bool flip)
{
  meam::Symmetries result;
  for (int k = 0; k < 12; ++k)
  {
    Eigen::Isometry3d S = turn(Eigen::Vector3d::UnitZ(), 60.0 * (k % 6));
    if (k >= 6)
    {
      S = S * turn(Eigen::Vector3d::UnitX(), 180.0);
    }
    if (k > 0 && (flip || k < 6))
    {
      result.discrete.push_back(S);
    }
  }
  return result;
}

meam::Symmetries cylinder(bool flip)
{
  meam::Symmetries result;
  result.continuous.push_back({ Eigen::Vector3d::UnitZ(), Centre });
  if (flip)
  {
    result.discrete.push_back(turn(Eigen::Vector3d::UnitX(), 180.0));
  }
  return result;
}

meam::Symmetries ball()
{
  meam::Symmetries result;
  for (int axis = 0; axis < 3; ++axis)
  {
    result.continuous.push_back({ Eigen::Vector3d::Unit(axis), Centre });
  }
  return result;
}

void expectEqual(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b)
{
  EXPECT_LT(meam::rotationError(a, b), 1e-4);
  EXPECT_LT(meam::translationError(a, b), 1e-6);
}
}

TEST(Symmetries, ATurnLeavesItsCentre)
{
  const Eigen::Isometry3d T = meam::turnAbout(Eigen::Vector3d::UnitZ(), M_PI / 2, Centre);
  EXPECT_TRUE((T * Centre).isApprox(Centre));
  EXPECT_TRUE((T * (Centre + Eigen::Vector3d::UnitX())).isApprox(Centre + Eigen::Vector3d::UnitY()));
}

TEST(Symmetries, WithoutAnyAPoseIsEqualToItselfOnly)
{
  const Eigen::Isometry3d T = turn({ 0, 1, 0 }, 33.0);
  expectEqual(meam::nearestEqual(T, Eigen::Isometry3d::Identity(), {}), T);
}

TEST(Symmetries, OfEqualPosesTheNearestIsFound)
{
  std::mt19937 random(3);
  for (int trial = 0; trial < 50; ++trial)
  {
    const Eigen::Isometry3d T = parts::motion(random, 100.0);
    for (const bool flip : { false, true })
    {
      const meam::Symmetries finite = hexagon(flip);
      for (const Eigen::Isometry3d& S : finite.discrete)
      {
        expectEqual(meam::nearestEqual(T * S, T, finite), T);
      }
      const Eigen::Isometry3d any = turn(Eigen::Vector3d::UnitZ(), 360.0 * trial / 50.0);
      expectEqual(meam::nearestEqual(T * any, T, cylinder(flip)), T);
      if (flip)
      {
        expectEqual(meam::nearestEqual(T * any * turn({ 1, 0, 0 }, 180.0), T, cylinder(flip)), T);
      }
    }
    Eigen::Isometry3d anywhere = parts::motion(random, 0.0);
    anywhere = Eigen::Translation3d(Centre) * anywhere * Eigen::Translation3d(-Centre);
    expectEqual(meam::nearestEqual(T * anywhere, T, ball()), T);
  }
}

TEST(Symmetries, EqualPosesHaveOneRepresentative)
{
  std::mt19937 random(4);
  const meam::Symmetries nut = hexagon(true);
  for (int trial = 0; trial < 50; ++trial)
  {
    const Eigen::Isometry3d T = parts::motion(random, 100.0);
    const Eigen::Isometry3d representative = meam::nearestEqual(T, Eigen::Isometry3d::Identity(), nut);
    for (const Eigen::Isometry3d& S : nut.discrete)
    {
      expectEqual(meam::nearestEqual(T * S, Eigen::Isometry3d::Identity(), nut), representative);
    }
  }
}

TEST(Symmetries, EveryPointHasAnImageAmongTheRepresentatives)
{
  std::mt19937 random(5);
  const auto points = meam::ofIndices<Eigen::Vector3f>(400,
    [&](int) -> Eigen::Vector3f { return (Centre + 20.0 * parts::motion(random, 1.0).translation()).cast<float>(); });
  const auto countOf = [&](const meam::Symmetries& symmetries, double margin)
  {
    const std::vector<bool> stands = meam::representatives(points, symmetries, margin);
    return std::count(stands.begin(), stands.end(), true);
  };
  EXPECT_EQ(countOf({}, 0.0), 400);
  // A twelfth of the points, and no more than chance allows.
  EXPECT_NEAR(countOf(hexagon(true), 0.0), 400 / 12.0, 18);
  EXPECT_GT(countOf(hexagon(true), 5.0), countOf(hexagon(true), 0.0));
  for (const auto& point : points)
  {
    // One of the images of each point stands for all of them.
    meam::Points images{ point };
    for (const Eigen::Isometry3d& S : hexagon(true).discrete)
    {
      images.push_back(S.cast<float>() * point);
    }
    const std::vector<bool> stands = meam::representatives(images, hexagon(true), 1e-3);
    EXPECT_GE(std::count(stands.begin(), stands.end(), true), 1);
    const auto circle = meam::ofIndices<Eigen::Vector3f>(
      360, [&](int k) -> Eigen::Vector3f { return turn(Eigen::Vector3d::UnitZ(), k).cast<float>() * point; });
    const std::vector<bool> onCircle = meam::representatives(circle, cylinder(false), 0.1);
    EXPECT_GE(std::count(onCircle.begin(), onCircle.end(), true), 1);
    EXPECT_LT(std::count(onCircle.begin(), onCircle.end(), true), 180);
  }
}

TEST(Symmetries, TheModelsInfoOfABOPDataset)
{
  meam::Symmetries symmetries = cylinder(true);
  const Eigen::AlignedBox3f box(Eigen::Vector3f(-1, -2, -3), Eigen::Vector3f(1, 2, 7));
  const auto entry = nlohmann::json::parse(meam::modelsInfo(symmetries, 12.5, box));
  EXPECT_EQ(entry["diameter"], 12.5);
  EXPECT_EQ(entry["min_z"], -3.0);
  EXPECT_EQ(entry["size_z"], 10.0);
  ASSERT_EQ(entry["symmetries_continuous"].size(), 1u);
  EXPECT_EQ(entry["symmetries_continuous"][0]["axis"], (std::vector<double>{ 0, 0, 1 }));
  EXPECT_EQ(entry["symmetries_continuous"][0]["offset"], (std::vector<double>{ 5, -3, 2 }));
  ASSERT_EQ(entry["symmetries_discrete"].size(), 1u);
  const std::vector<double> rows = entry["symmetries_discrete"][0];
  ASSERT_EQ(rows.size(), 16u);
  EXPECT_NEAR(rows[7], -6.0, 1e-9); // y goes to -6 - y: row-major
  EXPECT_FALSE(nlohmann::json::parse(meam::modelsInfo({}, 1.0, box)).contains("symmetries_discrete"));
}

TEST(Symmetries, whatIsKnownReplacesTheExactOnes)
{
  meam::Symmetries found = hexagon(true);
  const Eigen::Isometry3d flip = turn(Eigen::Vector3d::UnitX(), 180.0);
  found.near = { { turn(Eigen::Vector3d::UnitZ(), 61.0), 0.9, 1.0 }, { flip, 0.85, 2.0 } };
  const meam::Symmetries known = hexagon(false);
  const meam::Symmetries both = meam::withKnownExact(found, known);
  EXPECT_EQ(both.discrete.size(), 5u);
  ASSERT_EQ(both.near.size(), 1u) << "a near turn that is known as an exact one is none";
  EXPECT_TRUE(both.near[0].T.isApprox(flip));
  EXPECT_EQ(meam::withKnownExact(found, {}).near.size(), 2u);
  EXPECT_FALSE(meam::withKnownExact(found, {}).exact());
}

TEST(Symmetries, NearTurnsMakeAPartNearlyRoundHalfTurnsDoNot)
{
  const auto near = [](const Eigen::Vector3d& axis, double degrees) {
    return meam::NearSymmetry{ turn(axis, degrees), 0.9, 1.0 };
  };
  meam::Symmetries symmetries;
  symmetries.near = { near(Eigen::Vector3d::UnitX(), 180.0) };
  EXPECT_TRUE(meam::nearlyRoundAxes(symmetries).empty());
  EXPECT_TRUE(meam::asIfRound(symmetries).continuous.empty());
  symmetries.near.push_back(near(Eigen::Vector3d::UnitZ(), 90.0));
  symmetries.near.push_back(near(-Eigen::Vector3d::UnitZ(), 90.0)); // the same axis
  const std::vector<meam::ContinuousSymmetry> axes = meam::nearlyRoundAxes(symmetries);
  ASSERT_EQ(axes.size(), 1u);
  EXPECT_NEAR(std::abs(axes[0].axis.z()), 1.0, 1e-9);
  EXPECT_LT((axes[0].point - Eigen::Vector3d(Centre.x(), Centre.y(), 0)).norm(), 1e-6)
    << "on the axis, nearest to the origin";
  const meam::Symmetries round = meam::asIfRound(symmetries);
  ASSERT_EQ(round.continuous.size(), 1u);
  EXPECT_EQ(round.near.size(), 3u);
  const Eigen::Isometry3d turned = turn(Eigen::Vector3d::UnitZ(), 37.0);
  EXPECT_TRUE(
    meam::nearestEqual(turned, Eigen::Isometry3d::Identity(), round).isApprox(Eigen::Isometry3d::Identity(), 1e-6));
  EXPECT_EQ(meam::asIfRound(cylinder(true)).continuous.size(), 1u) << "what is round stays so";
}
