// SPDX-License-Identifier: BSD-3-Clause
#include "pose/diagnosis/PartsDiagnosis.h"

#include "TestScene.h"

namespace
{
using Eigen::Vector3d;

meam::TriangleMesh thickBlock() { return parts::box({ 0, 0, 0 }, { 44, 30, 20 }); }

const Eigen::Isometry3d BracketAt = scenes::lying(90, 10, 131, false);
const Eigen::Isometry3d BlockAt = Eigen::Isometry3d(Eigen::Translation3d(0, 0, 0));

/// A bracket and a block, and the diagnosis of both types.
struct Both
{
  Both()
    : seen(scenes::withTangents(scenes::seenFromAbove({ { parts::lBracket(), BracketAt }, { thickBlock(), BlockAt } })))
    , input(scenes::inputOf(seen))
    , settings(meam::detectionSettings(meam::Preset::Recommended, 0, 0, 0.5))
  {
  }

  scenes::Seen seen;
  meam::SceneInput input;
  meam::DetectionSettings settings;
  std::vector<const meam::TrainedModel*> models{ &scenes::bracket(), &scenes::trained<thickBlock>() };
  meam::PartsDiagnosis diagnosis{ models, input, settings };
};

Both& both()
{
  static Both result;
  return result;
}

/// A measured point that lies on the part.
Vector3d pointOn(const Eigen::Isometry3d& T, const meam::TrainedModel& model)
{
  const Eigen::Isometry3f toModel = T.inverse().cast<float>();
  std::vector<Vector3d> on;
  for (const Eigen::Vector3f& point : both().seen.surface)
  {
    if (model.surfaceDistance.at(toModel * point) < 0.5f)
    {
      on.push_back(point.cast<double>());
    }
  }
  return on.at(on.size() / 2);
}

meam::FoundPose found(int part, int rank, const Eigen::Isometry3d& T, double probability)
{
  meam::Pose pose;
  pose.T_scene_model = T;
  pose.placeProbability = pose.probability = probability;
  return { part, rank, pose };
}
}

TEST(PartsDiagnosis, APointWithoutAPoseIsAskedOfTheTypeThatIsThere)
{
  const std::vector<Eigen::Isometry3d> places{ BracketAt, BlockAt };
  for (int part = 0; part < 2; ++part)
  {
    const meam::PartDiagnosis told = both().diagnosis.atPoint(pointOn(places[part], *both().models[part]));
    EXPECT_EQ(told.part, part);
    EXPECT_FALSE(told.isChosen);
    EXPECT_FALSE(told.other);
    EXPECT_GE(told.diagnosis.rank, 1);
  }
  EXPECT_FALSE(both().diagnosis.atPoint({ 300, 300, 0 }).diagnosis.place);
}

TEST(PartsDiagnosis, APointOnALikelyPoseIsOfItsType)
{
  const Vector3d point = pointOn(BlockAt, *both().models[1]);
  const std::vector<meam::FoundPose> poses{ found(0, 1, BracketAt, 0.9), found(1, 2, BlockAt, 0.8) };
  const meam::PartDiagnosis told = both().diagnosis.atPoint(point, poses);
  EXPECT_EQ(told.part, 1);
  EXPECT_TRUE(told.isChosen);
  EXPECT_EQ(told.diagnosis.rank, 2);
  EXPECT_TRUE(told.diagnosis.isOfFound);
  // An unlikely one is not drawn: all are asked.
  EXPECT_FALSE(both().diagnosis.atPoint(point, { found(1, 2, BlockAt, 0.2) }).isChosen);
}

TEST(PartsDiagnosis, AChosenTypeIsAskedAboutWhereAnotherOneCameOut)
{
  const Vector3d point = pointOn(BlockAt, *both().models[1]);
  const meam::PartDiagnosis told = both().diagnosis.atPoint(point, { found(1, 2, BlockAt, 0.8) }, 0);
  EXPECT_EQ(told.part, 0);
  ASSERT_TRUE(told.other);
  EXPECT_EQ(meam::aboutWords(told, { "bracket", "block" }),
    "About bracket (PartId 0); rank 2, block (PartId 1), came out there.");
  EXPECT_THROW(both().diagnosis.atPoint(point, {}, 2), meam::Error);
}

TEST(PartsDiagnosis, AScanThatShowsNothingIsTold)
{
  meam::SceneInput floor;
  floor.edges.fromScan = true;
  floor.measured = { { 0, 0, 0 }, { 300, 0, 0 }, { 0, 300, 0 } };
  const meam::DetectionSettings settings = meam::detectionSettings(meam::Preset::Recommended);
  meam::PartsDiagnosis diagnosis(both().models, floor, settings);
  for (const meam::PartDiagnosis& told :
    { diagnosis.atPoint({ 0, 0, 0 }), diagnosis.atPose(BlockAt, 1), diagnosis.atPoint({ 0, 0, 0 }, {}, 1) })
  {
    EXPECT_EQ(told.diagnosis.cause, meam::LossCause::NothingShown);
    EXPECT_TRUE(told.diagnosis.lostIn);
    EXPECT_FALSE(told.diagnosis.place);
  }
  // A few edges by chance are no scan in another unit.
  floor.edges.cloud.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
  EXPECT_EQ(diagnosis.atPoint({ 0, 0, 0 }).diagnosis.cause, meam::LossCause::NothingShown);
}

TEST(PartsDiagnosis, APoseIsOfTheTypeThatFits)
{
  EXPECT_EQ(both().diagnosis.atPose(BlockAt).part, 1);
  const meam::PartDiagnosis told = both().diagnosis.atPose(BracketAt);
  EXPECT_EQ(told.part, 0);
  EXPECT_EQ(meam::aboutWords(told, { "bracket", "block" }),
    "About bracket (PartId 0), which of 2 types has most evidence there.");
  EXPECT_EQ(meam::aboutWords(told, { "bracket" }), "");
  EXPECT_EQ(both().diagnosis.ofFound(found(1, 4, BlockAt, 0.7)).diagnosis.rank, 4);
}
