// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/RotationSearch.h"

#include "TestScene.h"

#include <gtest/gtest.h>

namespace
{
using scenes::gearAt;
using scenes::gearScene;

const meam::TrainedModel& gearModel() { return scenes::trained<parts::gear>(); }

/// In the scene's coordinates.
std::vector<Eigen::Isometry3d> better(const Eigen::Isometry3d& T)
{
  std::vector<Eigen::Isometry3d> found =
    meam::RotationSearch(gearScene(), gearModel()).better(gearScene().T_local_scene() * T);
  for (Eigen::Isometry3d& rotated : found)
  {
    rotated = gearScene().T_local_scene().inverse() * rotated;
  }
  return found;
}

Eigen::Isometry3d likeliest(const Eigen::Isometry3d& T)
{
  const Eigen::Isometry3d& local = gearScene().T_local_scene();
  return local.inverse() * meam::RotationSearch(gearScene(), gearModel()).likeliest(local * T);
}
}

TEST(RotationSearch, FindsTheTurnThatEdgesExplain)
{
  ASSERT_FALSE(gearModel().symmetries.near.empty());
  for (const double degrees : { 11.0, 36.0, 90.0, 144.0, 200.0 })
  {
    const std::vector<Eigen::Isometry3d> found = better(gearAt(degrees));
    ASSERT_FALSE(found.empty()) << degrees;
    EXPECT_LT(meam::rotationError(found[0], gearAt(0)), 2.0) << degrees; // the step of the search
    EXPECT_LT(meam::translationError(found[0], gearAt(0)), 0.5) << degrees;
  }
}

TEST(RotationSearch, TheTrueTurnIsLeftAlone) { EXPECT_TRUE(better(gearAt(0)).empty()); }

TEST(RotationSearch, APartThatIsNotRoundHasNoAxis)
{
  const meam::RotationSearch search(scenes::copiesScene(), scenes::bracket());
  Eigen::Isometry3d T = scenes::threeCopies()[0];
  T.rotate(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()));
  EXPECT_TRUE(search.better(scenes::copiesScene().T_local_scene() * T).empty());
}

TEST(RotationSearch, TheLikeliestNearSymmetryIsTheTrueTurn)
{
  for (const double degrees : { 0.0, 36.0, 108.0, 252.0 })
  {
    EXPECT_LT(meam::rotationError(likeliest(gearAt(degrees)), gearAt(0)), 2.0) << degrees;
  }
  const meam::RotationSearch without(scenes::copiesScene(), scenes::bracket());
  const Eigen::Isometry3d T = scenes::copiesScene().T_local_scene() * scenes::threeCopies()[0];
  EXPECT_TRUE(without.likeliest(T).isApprox(T)) << "nothing to choose from";
}
