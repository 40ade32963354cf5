// SPDX-License-Identifier: BSD-3-Clause
#include "scene/preparation/SearchRegion.h"

#include "TestFiles.h"
#include "TestGrids.h"

namespace
{
constexpr int FloorWidth = 120, FloorHeight = 90;

/// A floor with a point for each mm, seen from above at its middle; values of the image count the pixels.
meam::PreparedScan floorOfMillimetres()
{
  meam::Image image{ FloorWidth, FloorHeight, 1, {} };
  for (int i = 0; i < FloorWidth * FloorHeight; ++i)
  {
    image.pixels.push_back(static_cast<std::uint8_t>(i % 251));
  }
  return meam::prepareScan(
    grids::centered(FloorWidth, FloorHeight, [](double, double) { return 300.0; }), std::move(image), meam::Sensor{});
}

meam::Region boxOf(double x0, double x1, double y0, double y1)
{
  meam::Region region;
  region.box = { Eigen::Vector3d(x0, y0, 0.0), Eigen::Vector3d(x1, y1, 1000.0) };
  return region;
}

/// The columns from 20 to 39 and the rows from 10 to 29.
meam::Region maskOfPixels()
{
  meam::Region region;
  for (int i = 0; i < FloorWidth * FloorHeight; ++i)
  {
    const int column = i % FloorWidth, row = i / FloorWidth;
    region.mask.push_back(column >= 20 && column < 40 && row >= 10 && row < 30 ? 1 : 0);
  }
  return region;
}

int measuredIn(const meam::PreparedScan& scan) { return static_cast<int>(scan.measured().size()); }
}

TEST(SearchRegion, OfABoxWhatLiesInIt)
{
  const meam::SearchRegion region(boxOf(-10, 10, 0, 20), floorOfMillimetres());
  EXPECT_TRUE(region.contains({ 9, 1, 5 }));
  EXPECT_FALSE(region.contains({ 11, 1, 5 }));
  EXPECT_FALSE(region.contains({ 9, 1, 1001 }));
  EXPECT_TRUE(region.isNear({ 11, 1, 5 }, 2.0));
  EXPECT_FALSE(region.isNear({ 11, 21, 5 }, 1.4)) << "from the corner, which is sqrt(2) away";
}

TEST(SearchRegion, AScanIsCroppedToItAndItsMargin)
{
  meam::PreparedScan scan = floorOfMillimetres();
  const meam::PreparedScan whole = scan;
  meam::SearchRegion(boxOf(-10, 10, 0, 20), scan).crop(scan, 5.0);
  EXPECT_EQ(scan.cloud.width, 30); // from -15 to 15
  EXPECT_EQ(scan.cloud.height, 30);
  EXPECT_EQ(measuredIn(scan), 900);
  EXPECT_FALSE(scan.isAsGiven);
  for (std::size_t i = 0; i < scan.cloud.size(); ++i)
  {
    const std::size_t id = static_cast<std::size_t>(scan.pointIds[i]);
    EXPECT_EQ(scan.cloud.points[i], whole.cloud.points[id]);
    EXPECT_EQ(scan.image.pixels[i], whole.image.pixels[id]);
  }
}

TEST(SearchRegion, OfAMaskWhatTheSensorSeesInIt)
{
  meam::PreparedScan scan = floorOfMillimetres();
  const meam::SearchRegion region(maskOfPixels(), scan);
  const Eigen::Vector3d seen(29.5 - 59.5, 19.5 - 44.5, 300.0); // its middle
  EXPECT_TRUE(region.contains(seen));
  EXPECT_TRUE(region.contains(1.1 * seen)) << "behind the surface";
  EXPECT_FALSE(region.contains(seen + Eigen::Vector3d(13, 0, 0)));
  EXPECT_TRUE(region.isNear(seen + Eigen::Vector3d(13, 0, 0), 5.0));
  EXPECT_FALSE(region.isNear(seen + Eigen::Vector3d(17, 0, 0), 5.0));
  EXPECT_FALSE(region.contains({ 500, 500, 300 })) << "out of sight";
  region.crop(scan, 4.0);
  EXPECT_EQ(scan.cloud.width, 28);
  EXPECT_EQ(scan.cloud.height, 28);
  EXPECT_LT(measuredIn(scan), 28 * 28) << "its corners are round";
  EXPECT_GT(measuredIn(scan), 28 * 28 - 4 * 16);
}

TEST(SearchRegion, EdgePointsAreCroppedInTheirOwnFrame)
{
  meam::PointCloud points;
  points.points = { { 0, 0, 0 }, { 30, 1, 0 }, { 60, -1, 0 } };
  meam::LocalCloud edges = meam::toLocalCloud(points);
  meam::Points measured = edges.cloud.points;
  meam::Region region;
  region.box = { Eigen::Vector3d(-1, -5, -5), Eigen::Vector3d(20, 5, 5) };
  meam::SearchRegion(region).crop(edges, measured, 12.0);
  EXPECT_EQ(edges.cloud.size(), 2u);
  EXPECT_EQ(measured.size(), 2u);
  EXPECT_THROW(meam::SearchRegion{ maskOfPixels() }, meam::Error);
}

TEST(SearchRegion, BadInput)
{
  meam::PreparedScan scan = floorOfMillimetres();
  EXPECT_TRUE(files::contains(files::errorOf(
                                [&] {
                                  meam::SearchRegion{ boxOf(10, -10, 0, 20), scan };
                                }),
    "from before to"));
  const meam::SearchRegion elsewhere(boxOf(500, 600, 0, 20), scan);
  EXPECT_TRUE(files::contains(files::errorOf([&] { elsewhere.crop(scan, 5.0); }), "Nothing of the scan"));
  meam::Region none = maskOfPixels();
  none.mask.assign(none.mask.size(), 0);
  const meam::SearchRegion nowhere(none, scan);
  EXPECT_THROW(nowhere.crop(scan, 5.0), meam::Error);
}
