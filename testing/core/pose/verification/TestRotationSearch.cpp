// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/RotationSearch.h"

#include "TestScene.h"

#include <gtest/gtest.h>

namespace
{
const meam::TrainedModel& model() { return scenes::trained<parts::gear>(); }

Eigen::Isometry3d turned(double degrees)
{
  return Eigen::Translation3d(40, -20, 7) *
         meam::turnAbout(Eigen::Vector3d::UnitZ(), degrees * M_PI / 180.0, Eigen::Vector3d::Zero());
}

/// The gear at turned(0), seen from above.
const meam::Scene& scene()
{
  static const meam::Scene alone = scenes::prepared(
    scenes::withTangents(scenes::seenFromAbove({ scenes::Copy{ parts::gear(), turned(0) } }), model().diameter),
    model().diameter);
  return alone;
}

const meam::Scene& brackets()
{
  static const meam::Scene copies =
    scenes::prepared(scenes::withTangents(scenes::seenFromAbove(scenes::threeCopies())));
  return copies;
}

/// In the scene's coordinates.
std::vector<Eigen::Isometry3d> better(const Eigen::Isometry3d& T)
{
  std::vector<Eigen::Isometry3d> found = meam::RotationSearch(scene(), model()).better(scene().T_local_scene() * T);
  for (Eigen::Isometry3d& rotated : found)
  {
    rotated = scene().T_local_scene().inverse() * rotated;
  }
  return found;
}

Eigen::Isometry3d likeliest(const Eigen::Isometry3d& T)
{
  const Eigen::Isometry3d& local = scene().T_local_scene();
  return local.inverse() * meam::RotationSearch(scene(), model()).likeliest(local * T);
}
}

TEST(RotationSearch, FindsTheTurnThatEdgesExplain)
{
  ASSERT_FALSE(model().symmetries.near.empty());
  for (const double degrees : { 11.0, 36.0, 90.0, 144.0, 200.0 })
  {
    const std::vector<Eigen::Isometry3d> found = better(turned(degrees));
    ASSERT_FALSE(found.empty()) << degrees;
    EXPECT_LT(meam::rotationError(found[0], turned(0)), 2.0) << degrees; // the step of the search
    EXPECT_LT(meam::translationError(found[0], turned(0)), 0.5) << degrees;
  }
}

TEST(RotationSearch, TheTrueTurnIsLeftAlone) { EXPECT_TRUE(better(turned(0)).empty()); }

TEST(RotationSearch, APartThatIsNotRoundHasNoAxis)
{
  const meam::RotationSearch search(brackets(), scenes::bracket());
  Eigen::Isometry3d T = scenes::threeCopies()[0];
  T.rotate(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()));
  EXPECT_TRUE(search.better(brackets().T_local_scene() * T).empty());
}

TEST(RotationSearch, TheLikeliestNearSymmetryIsTheTrueTurn)
{
  for (const double degrees : { 0.0, 36.0, 108.0, 252.0 })
  {
    EXPECT_LT(meam::rotationError(likeliest(turned(degrees)), turned(0)), 2.0) << degrees;
  }
  const meam::RotationSearch without(brackets(), scenes::bracket());
  const Eigen::Isometry3d T = brackets().T_local_scene() * scenes::threeCopies()[0];
  EXPECT_TRUE(without.likeliest(T).isApprox(T)) << "nothing to choose from";
}
