// SPDX-License-Identifier: BSD-3-Clause
#include "pose/refinement/PartSize.h"

#include "pose/PartsEstimation.h"

#include "TestScene.h"
#include "base/sequences/Sequences.h"

#include <cmath>

namespace
{
meam::TriangleMesh thinPlate() { return parts::box({ 0, 0, 0 }, { 60, 40, 1 }); }

/// Of four copies that lie about, each longer by `factors` than the part that is looked for.
meam::PartSize measured(const Eigen::Vector3f& factors, int threads = 1)
{
  const meam::TrainedModel& model = scenes::bracket();
  const std::vector<scenes::Copy> copies = scenes::stretchedBrackets(4, factors);
  const auto poses = meam::mapped<meam::Pose>(
    copies, [&](const scenes::Copy& copy) { return scenes::displaced(copy.T_scene_model, 0.2, 0.2); });
  const meam::Scene scene = scenes::sceneOf(copies);
  return meam::measurePartSize(
    meam::toLocalFrame(poses, scene.T_local_scene(), model.symmetries), scene, model, threads);
}
}

TEST(PartSize, ThePartIsAsLongAsInItsCADFile)
{
  const meam::PartSize size = measured(Eigen::Vector3f::Ones());
  EXPECT_NEAR(size.factors.x(), 1.0, 0.01);
  EXPECT_NEAR(size.factors.y(), 1.0, 0.01);
  EXPECT_LT(size.deviations.x(), 0.02);
}

TEST(PartSize, ALongerAndAShorterPartAreMeasured)
{
  const meam::PartSize size = measured({ 1.05f, 0.96f, 1.0f });
  EXPECT_NEAR(size.factors.x(), 1.05, 0.012);
  EXPECT_NEAR(size.factors.y(), 0.96, 0.012);
}

TEST(PartSize, ALengthOfFewPixelsIsNotMeasured)
{
  const meam::TrainedModel& model = scenes::trained<thinPlate>();
  const meam::Scene scene = scenes::alone(thinPlate(), model, Eigen::Isometry3d::Identity());
  const meam::Poses twice(2, scenes::displaced(scene.T_local_scene()));
  const meam::PartSize size = meam::measurePartSize(twice, scene, model, 1);
  EXPECT_NEAR(size.factors.x(), 1.0, 0.01);
  EXPECT_TRUE(std::isnan(size.factors.z()));
}

TEST(PartSize, AnyNumberOfThreadsMeasuresTheSame)
{
  const meam::PartSize one = measured({ 1.05f, 1.0f, 1.0f }), three = measured({ 1.05f, 1.0f, 1.0f }, 3);
  EXPECT_EQ(one.factors.x(), three.factors.x());
  EXPECT_EQ(one.factors.y(), three.factors.y());
}

TEST(PartSize, WordsNameTheLengthThatIsOffTheMost)
{
  EXPECT_EQ(meam::sizeWords({ 1.01, 0.893, parts::NaN }), "0.89 times as long along y as in the CAD file");
  EXPECT_EQ(meam::sizesWords({ 1.01, 0.893, parts::NaN }), "1.01 along x, 0.89 along y, not told along z");
  EXPECT_EQ(meam::sizesWords({ parts::NaN, parts::NaN, parts::NaN }), "");
  EXPECT_EQ(meam::untoldWords({ 1.01, parts::NaN, parts::NaN }),
    "How long the parts are along y and z cannot be checked in this scan: a longer or shorter part looks the same.");
  EXPECT_EQ(meam::untoldWords({ 1.01, 0.893, 1.0 }), "");
  EXPECT_EQ(meam::untoldWords({ parts::NaN, parts::NaN, parts::NaN }), "");
}

TEST(PartSize, LengthsThatAreNotToldAreNamedForEachTypeOfPart)
{
  std::vector<meam::PartPose> found(2);
  EXPECT_EQ(meam::untoldLengths({}), "");
  EXPECT_EQ(meam::untoldLengths(found), "") << "too few poses to measure";
  found[0].pose.contradictions.lengths = { 1.0, 1.0, parts::NaN };
  found[1].pose.contradictions.lengths = { parts::NaN, 1.0, 1.0 };
  EXPECT_EQ(meam::untoldLengths(found),
    "How long the parts are along z cannot be checked in this scan: a longer or shorter part looks the same.")
    << "of the first copy of each";
  found[1].part = 1;
  EXPECT_EQ(meam::untoldLengths(found),
    "How long the copies of part 1 are along z cannot be checked in this scan: a longer or shorter part looks the "
    "same. How long the copies of part 2 are along x cannot be checked in this scan: a longer or shorter part looks "
    "the same.");
  EXPECT_EQ(meam::untoldLengths(found, {}, { "plate", "flap" }).find("How long the copies of plate are"), 0u);
}
