// SPDX-License-Identifier: BSD-3-Clause
#include "model/body/BodyInterior.h"

#include "TestScene.h"

namespace
{
meam::TriangleMesh block() { return parts::box({ 0, 0, 0 }, { 60, 40, 20 }); }

bool isDeep(float x, float y, float z)
{
  const meam::TrainedModel& model = scenes::trained<block>();
  const meam::BodyInterior interior(model.surface, model.diameter, 3.0);
  return interior.isDeep({ x, y, z });
}
}

TEST(BodyInterior, PointsAreDeepFromTheGivenDepthOn)
{
  EXPECT_TRUE(isDeep(30, 20, 4));
  EXPECT_FALSE(isDeep(30, 20, 2)) << "2 mm";
  EXPECT_TRUE(isDeep(4, 20, 10));
  EXPECT_FALSE(isDeep(2, 20, 10));
}

TEST(BodyInterior, NothingOutsideIsDeep)
{
  EXPECT_FALSE(isDeep(30, 20, -5));
  EXPECT_FALSE(isDeep(-10, 20, 10));
  EXPECT_FALSE(isDeep(200, 200, 200));
}

TEST(BodyInterior, OfAPartOfEdgesAloneThereIsNone)
{
  const meam::BodyInterior interior({}, 100.0, 3.0);
  EXPECT_FALSE(interior.isDeep({ 0, 0, 0 }));
}

TEST(BodyInterior, TheCellsOfAnotherAreTakenWhereTheyFit)
{
  const meam::TrainedModel& model = scenes::trained<block>();
  const meam::BodyInterior made(model.surface, model.diameter, 3.0);
  std::vector<std::uint8_t> cells = made.cells();
  ASSERT_GT(cells.size(), 1000u);
  const Eigen::Vector3f middle(30, 20, 4);
  ASSERT_TRUE(made.isDeep(middle));
  std::fill(cells.begin(), cells.end(), std::uint8_t(1)); // no point of any cell is deep
  EXPECT_FALSE(meam::BodyInterior(model.surface, model.diameter, 3.0, cells).isDeep(middle));
  cells.pop_back();
  EXPECT_EQ(meam::BodyInterior(model.surface, model.diameter, 3.0, cells).cells(), made.cells());
}

TEST(BodyInterior, ACellTellsWhatThePointsInItTell)
{
  const meam::TrainedModel& model = scenes::trained<block>();
  const meam::BodyInterior made(model.surface, model.diameter, 3.0);
  std::vector<std::uint8_t> none(made.cells().size(), 2); // each point is looked up
  const meam::BodyInterior looked(model.surface, model.diameter, 3.0, none);
  for (float z = 0.3f; z < 6.5f; z += 0.9f) // nearer than a tenth of the diameter
  {
    for (float x = 0.3f; x < 60.0f; x += 0.9f)
    {
      const Eigen::Vector3f point(x, 17.0f, z);
      EXPECT_EQ(made.isDeep(point), looked.isDeep(point)) << point.transpose();
    }
  }
}
