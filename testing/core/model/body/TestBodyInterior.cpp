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
  const bool first = interior.isDeep({ x, y, z });
  EXPECT_EQ(interior.isDeep({ x, y, z }), first) << "what is known of a place stays";
  return first;
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
