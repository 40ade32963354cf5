// SPDX-License-Identifier: BSD-3-Clause
#include "scene/preparation/PointRaster.h"
#include "scene/preparation/ScanPreparation.h"

#include "TestFiles.h"
#include "TestGrids.h"
#include "base/Random.h"

#include <algorithm>
#include <cmath>

namespace
{
constexpr int GridWidth = 120, GridHeight = 90;

/// A box of 60 x 40 mm, 30 mm high, on a floor 600 mm from the sensor.
meam::OrganizedCloud boxOnFloor()
{
  static const meam::Camera sensor = grids::camera(GridWidth, GridHeight, 300.0, 61.3, 44.2);
  return grids::measured(sensor,
    [](int column, int row)
    {
      const Eigen::Vector3d top = meam::unproject(sensor, Eigen::Vector2d(column, row), 570.0);
      return std::abs(top.x()) < 30.0 && std::abs(top.y()) < 20.0 ? 570.0 : 600.0 + 0.02 * column;
    });
}

/// The cloud with each point changed, or every so manyth.
template <typename Change>
meam::OrganizedCloud with(meam::OrganizedCloud cloud, Change&& change, std::size_t step = 1)
{
  for (std::size_t i = 0; i < cloud.size(); i += step)
  {
    change(cloud.points[i]);
  }
  return cloud;
}

auto turnedBy(const Eigen::Matrix3f& R)
{
  return [R](Eigen::Vector3f& point) { point = R * point; };
}

/// x goes right, y up and z backwards; or the sensor looks along x, with z up.
const Eigen::Matrix3f OpenGL = Eigen::Vector3f(1, -1, -1).asDiagonal();
const Eigen::Matrix3f AlongX = (Eigen::Matrix3f() << 0, 0, 1, -1, 0, 0, 0, -1, 0).finished();

/// Of a sensor that looks down, where z goes up.
Eigen::Isometry3d above(const Eigen::Vector3d& position)
{
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = OpenGL.cast<double>();
  T.translation() = position;
  return T;
}

/// The same points without their grid, in another order.
meam::OrganizedCloud shuffled(meam::OrganizedCloud cloud)
{
  meam::Random random(5);
  meam::Points points = meam::everyNth(cloud, 1);
  for (std::size_t i = points.size(); i > 1; --i)
  {
    std::swap(points[i - 1], points[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
  }
  return { static_cast<int>(points.size()), 1, points };
}

meam::PreparedScan prepared(const meam::OrganizedCloud& cloud) { return meam::prepareScan(cloud, {}, std::nullopt); }

bool says(const meam::PreparedScan& scan, const std::string& words) { return files::contains(scan.report, words); }

std::size_t measuredCount(const meam::OrganizedCloud& cloud) { return meam::everyNth(cloud, 1).size(); }

meam::SceneEdges edgesOf(const meam::PreparedScan& scan)
{
  meam::SceneEdgeExtractionSettings settings;
  settings.imageEdges = false;
  settings.depthEdges = true;
  return meam::extractSceneEdges(scan, settings);
}

/// mm, how far the edge points are from those of the box, at most.
double offOutline(const meam::Points& edges, const Eigen::Isometry3d& T_sensor_scan)
{
  double worst = 0.0;
  for (const Eigen::Vector3f& edge : edges)
  {
    const Eigen::Vector3d point = T_sensor_scan * edge.cast<double>();
    const double x = 30.0 - std::abs(point.x()), y = 20.0 - std::abs(point.y());
    worst = std::max({ worst, std::abs(point.z() - 570.0), std::min(std::abs(x), std::abs(y)) });
  }
  return worst;
}
}

TEST(ScanPreparation, aGridWhoseSidesAreSwappedIsRefused)
{
  const meam::OrganizedCloud cloud = boxOnFloor();
  const auto refusal = [](int width, int height, const meam::Points& points) {
    return files::errorOf([&] { prepared({ width, height, points }); });
  };
  EXPECT_TRUE(files::contains(refusal(GridHeight, GridWidth, cloud.points),
    "swapped: it is given as 90 wide and 120 high, where neighbours in columns are"));
  EXPECT_EQ(refusal(GridWidth, GridHeight, cloud.points), "");
  // Grids of which every second row is missing, or whose rows are far apart, as a laser's lines, are whole.
  meam::Points everyOther = cloud.points, apart;
  for (std::size_t i = 0; i < everyOther.size(); ++i)
  {
    everyOther[i] = i / GridWidth % 2 == 0 ? everyOther[i] : Eigen::Vector3f::Constant(NAN);
    if (i / GridWidth % 5 == 0)
    {
      apart.push_back(cloud.points[i]);
    }
  }
  EXPECT_EQ(refusal(GridWidth, GridHeight, everyOther), "");
  EXPECT_EQ(refusal(GridWidth, GridHeight / 5, apart), "");
}

TEST(ScanPreparation, aUsualScanStaysAsItIs)
{
  const meam::PreparedScan scan = prepared(boxOnFloor());
  EXPECT_TRUE(scan.isAsGiven);
  EXPECT_EQ(scan.report, "");
  EXPECT_EQ(scan.cloud.points, boxOnFloor().points);
  EXPECT_TRUE(scan.pointIds.empty());
}

TEST(ScanPreparation, whatWasNotMeasuredIsLeftOutAndSaid)
{
  const auto all = [](const Eigen::Vector3f& value) { return [value](Eigen::Vector3f& point) { point = value; }; };
  const auto endOfRange = [](Eigen::Vector3f& point)
  {
    point *= 800.0f / point.z();
    point.z() = 800.0f;
  };
  const std::pair<std::function<void(Eigen::Vector3f&)>, const char*> values[] = { { all({ 0, 0, 0 }), "(0, 0, 0)" },
    { all({ 12, 4, 65535 }), "the depth 65535" }, { all({ 1, 1, -10000 }), "the depth -10000" },
    { all({ 0, 0, 5 }), "the depth 5" }, { endOfRange, "12 % of the points have the depth 800" } };
  for (const auto& [value, words] : values)
  {
    const meam::OrganizedCloud cloud = with(boxOnFloor(), value, 8);
    const meam::PreparedScan scan = prepared(cloud);
    EXPECT_FALSE(scan.isAsGiven);
    EXPECT_TRUE(says(scan, words) && says(scan, "12 % of the points") && says(scan, "not measured")) << scan.report;
    EXPECT_EQ(scan.measured().size(), cloud.size() - cloud.size() / 8);
    EXPECT_EQ(measuredCount(scan.cloud), scan.measured().size());
  }
}

TEST(ScanPreparation, aFloorOfOneDepthIsMeasured)
{
  meam::OrganizedCloud cloud = with(boxOnFloor(), [](Eigen::Vector3f& point) { point.z() = 600.0f; });
  EXPECT_TRUE(prepared(cloud).isAsGiven);
  cloud.points[3 * GridWidth + 7].z() = 580.0f;
  EXPECT_TRUE(prepared(cloud).isAsGiven);
  const meam::OrganizedCloud tall = with(cloud,
    [](Eigen::Vector3f& point)
    {
      point = std::abs(point.x()) < 40.0f && std::abs(point.y()) < 30.0f ? Eigen::Vector3f(point * 400.0f / point.z())
                                                                         : point;
    });
  EXPECT_TRUE(prepared(tall).isAsGiven) << prepared(tall).report;
}

TEST(ScanPreparation, axesAreTurnedAndEdgesComeBackInTheScansOwn)
{
  const std::pair<Eigen::Matrix3f, const char*> axes[] = { { OpenGL, "OpenGL" },
    { AlongX, "lies along +x of its axes, with +z up" } };
  for (const auto& [R, words] : axes)
  {
    const meam::OrganizedCloud cloud = with(boxOnFloor(), turnedBy(R));
    const meam::PreparedScan scan = prepared(cloud);
    EXPECT_TRUE(says(scan, words)) << scan.report;
    EXPECT_TRUE(scan.T_sensor_scan.linear().isApprox(R.transpose().cast<double>(), 1e-12))
      << scan.T_sensor_scan.matrix();
    EXPECT_EQ(scan.sensor.direction, R.col(2).cast<double>());
    EXPECT_EQ(scan.measured(), cloud.points);
    const meam::SceneEdges edges = edgesOf(scan);
    EXPECT_GT(edges.cloud.size(), 60u);
    EXPECT_LT(offOutline(edges.cloud.points, scan.T_sensor_scan), 2.5);
  }
}

TEST(ScanPreparation, theSensorOfAGridInARobotsFrameIsFound)
{
  Eigen::Isometry3d T_robot_sensor = Eigen::Isometry3d::Identity();
  T_robot_sensor.translation() << 700, -150, 620;
  T_robot_sensor.rotate(Eigen::AngleAxisd(0.9 * M_PI, Eigen::Vector3d(1, 0.2, 0.1).normalized()));
  meam::OrganizedCloud cloud = boxOnFloor();
  cloud.points = meam::moved(cloud.points, T_robot_sensor);
  const meam::PreparedScan scan = prepared(cloud);
  EXPECT_TRUE(says(scan, "sensor is at (700, -150, 620)")) << scan.report;
  EXPECT_TRUE(scan.T_sensor_scan.isApprox(T_robot_sensor.inverse(), 1e-3)) << scan.T_sensor_scan.matrix();
  EXPECT_LT(offOutline(edgesOf(scan).cloud.points, T_robot_sensor.inverse()), 2.5);
}

TEST(ScanPreparation, theSensorAboveAFloorIsFoundFromAnyOriginBelowIt)
{
  // z goes up: seen from the origin, below the floor, the grid is mirrored.
  for (const double height : { 600.0, 700.0, 1000.0, 3000.0 })
  {
    const Eigen::Isometry3d T_floor_sensor = above({ 0, 0, height });
    meam::OrganizedCloud cloud = boxOnFloor();
    cloud.points = meam::moved(cloud.points, T_floor_sensor);
    const meam::PreparedScan scan = prepared(cloud);
    EXPECT_FALSE(says(scan, "negate y")) << scan.report;
    EXPECT_TRUE(scan.T_sensor_scan.isApprox(T_floor_sensor.inverse(), 1e-3)) << scan.T_sensor_scan.matrix();
    EXPECT_EQ(scan.measured().size(), cloud.size());
    EXPECT_LT(offOutline(edgesOf(scan).cloud.points, T_floor_sensor.inverse()), 2.5);
  }
}

TEST(ScanPreparation, whatIsBehindTheSensorIsAskedInItsFrame)
{
  meam::OrganizedCloud cloud = with(boxOnFloor(), turnedBy(AlongX)); // z goes up
  cloud.height = 60;                                                 // two thirds of it above the sensor
  cloud.points.resize(static_cast<std::size_t>(GridWidth) * 60);
  EXPECT_EQ(prepared(cloud).measured(), cloud.points);
  float depth = -1.0f;
  const meam::PreparedScan scan = prepared(with(
    cloud, [&](Eigen::Vector3f& point) { point.x() = depth -= 0.08f; }, 8));
  EXPECT_TRUE(says(scan, "along +x") && says(scan, "12 % of the points have a depth of 0 or less")) << scan.report;
}

TEST(ScanPreparation, aHeightMapIsSeenFromAbove)
{
  for (const double alongRows : { 0.9, -0.9 })
  {
    for (const double corner : { -45.0, 0.0, 400.0 })
    {
      const meam::OrganizedCloud cloud = grids::grid(GridWidth, GridHeight,
        [&](int column, int row)
        {
          const double x = 0.7 * column, y = alongRows * row;
          const double height = std::hypot(x - 40.0, std::abs(y) - 35.0) < 20.0 ? 25.0 : 0.01 * x;
          return Eigen::Vector3d(corner + x, corner + y, height - 5.0);
        });
      const meam::PreparedScan scan = prepared(cloud);
      EXPECT_TRUE(says(scan, "orthographic") && !says(scan, "not measured")) << scan.report;
      EXPECT_FALSE(scan.sensor.perspective);
      EXPECT_TRUE(scan.sensor.direction.isApprox(-Eigen::Vector3d::UnitZ(), 1e-5)) << scan.sensor.direction;
      EXPECT_EQ(scan.measured().size(), cloud.size());
      EXPECT_GT(edgesOf(scan).cloud.size(), 60u);
    }
  }
}

TEST(ScanPreparation, leftHandedAxesAreNamed)
{
  const meam::PreparedScan scan = prepared(with(boxOnFloor(), [](Eigen::Vector3f& point) { point.y() = -point.y(); }));
  EXPECT_TRUE(scan.isAsGiven);
  EXPECT_TRUE(says(scan, "left-handed")) << scan.report;
}

TEST(ScanPreparation, thePixelsOfPointsAloneAreFoundAgain)
{
  const meam::OrganizedCloud points = shuffled(boxOnFloor());
  const meam::PreparedScan scan = prepared(points);
  EXPECT_TRUE(says(scan, "the grid of a pinhole camera (300.0 pixels")) << scan.report;
  EXPECT_EQ(measuredCount(scan.cloud), static_cast<std::size_t>(GridWidth) * GridHeight);
  EXPECT_TRUE(scan.sensor.perspective);
  const meam::SceneEdges edges = edgesOf(scan), same = edgesOf(prepared(boxOnFloor()));
  EXPECT_EQ(edges.cloud.points, same.cloud.points);
  for (std::size_t i = 0; i < edges.cloud.size(); ++i)
  {
    EXPECT_EQ(points.points[edges.cloud.pointIds[i]], edges.cloud.points[i]);
  }
}

TEST(ScanPreparation, howFarPointsReachIsToldWhicheverWereNotMeasured)
{
  constexpr int side = 300;
  meam::Points points;
  for (int k = 0; k < side * side; ++k) // every third, or fourth, is looked at; these may be those that are missing
  {
    points.emplace_back(static_cast<float>(k % side), static_cast<float>(k / side), 500.0f);
  }
  for (const int gap : { 3, 4 })
  {
    meam::Points measured = points;
    for (std::size_t k = 0; k < measured.size(); k += gap)
    {
      measured[k].setConstant(std::numeric_limits<float>::quiet_NaN());
    }
    const Eigen::AlignedBox2d reach = meam::reachOf(measured, { false });
    EXPECT_LT(reach.min().norm(), 5.0) << gap;
    EXPECT_GT(reach.max().minCoeff(), side - 6.0) << gap;
  }
}

TEST(ScanPreparation, thePixelsOfPointsAloneAreFoundAgainAlongAnyAxis)
{
  for (const Eigen::Matrix3f& R_scan_sensor :
    { OpenGL, AlongX, (Eigen::Matrix3f() << 1, 0, 0, 0, 0, 1, 0, -1, 0).finished(),
      (Eigen::Matrix3f() << 1, 0, 0, 0, 0, -1, 0, 1, 0).finished() })
  {
    const meam::PreparedScan scan = prepared(with(shuffled(boxOnFloor()), turnedBy(R_scan_sensor)));
    EXPECT_TRUE(says(scan, "the grid of a pinhole camera (300.0 pixels")) << scan.report;
    EXPECT_EQ(scan.sensor.direction, R_scan_sensor.col(2).cast<double>());
    EXPECT_FALSE(scan.isViewpointGuessed);
  }
}

TEST(ScanPreparation, anOrthographicGridIsSeenFromAbove)
{
  for (const double floor : { 0.0, 300.0 })
  { // which lies ahead of the origin, too
    meam::OrganizedCloud cloud = grids::grid(GridWidth, GridHeight,
      [&](int column, int row)
      {
        const double x = 0.7 * column - 40.0, y = 0.9 * row - 35.0;
        return Eigen::Vector3d(x, y, floor + (std::hypot(x, y) < 20.0 ? 25.0 : 0.01 * x));
      });
    cloud = { static_cast<int>(cloud.size()), 1, cloud.points };
    const meam::PreparedScan scan = prepared(cloud);
    EXPECT_TRUE(says(scan, "orthographic camera") && says(scan, "along -z")) << scan.report;
    EXPECT_FALSE(scan.sensor.perspective);
    EXPECT_EQ(scan.sensor.direction, -Eigen::Vector3d::UnitZ());
    EXPECT_EQ(measuredCount(scan.cloud), cloud.size());
    EXPECT_GT(edgesOf(scan).cloud.size(), 60u);
  }
}

TEST(ScanPreparation, pointsOnNoGridAreLookedAtWithPixelsThatTheyFill)
{
  meam::Random random(7);
  const meam::OrganizedCloud points = with(shuffled(boxOnFloor()), // a pixel is 2 mm
    [&](Eigen::Vector3f& point) { point += Eigen::Vector3f(random.normal(), random.normal(), 0.0f) * 0.8f; });
  const meam::PreparedScan scan = prepared(points);
  EXPECT_TRUE(says(scan, "virtual camera") && says(scan, "from the origin along +z")) << scan.report;
  EXPECT_TRUE(says(scan, "give its viewpoint") && scan.isViewpointGuessed) << scan.report;
  EXPECT_TRUE(says(scan, "If their axes are left-handed")) << scan.report;
  EXPECT_GT(measuredCount(scan.cloud), points.size() / 3);
  const meam::SceneEdges edges = edgesOf(scan);
  EXPECT_GT(edges.cloud.size(), 40u);
  EXPECT_LT(offOutline(edges.cloud.points, scan.T_sensor_scan), 7.0);
}

TEST(ScanPreparation, thePlaceFromWhereTheFewestPointsHideOthersIsFound)
{
  meam::OrganizedCloud points = shuffled(boxOnFloor());
  meam::Random random(7);
  for (Eigen::Vector3f& point : points.points)
  {
    point += Eigen::Vector3f(random.normal(), random.normal(), 0.0f) * 0.4f; // on no lattice
  }
  for (const double degrees : { 125.0, 145.0 }) // of the sensor about x, in a robot's frame with z up
  {
    Eigen::Isometry3d T_scan_sensor = Eigen::Isometry3d::Identity();
    T_scan_sensor.rotate(Eigen::AngleAxisd(degrees / 180.0 * M_PI, Eigen::Vector3d::UnitX()));
    T_scan_sensor.pretranslate(Eigen::Vector3d(900, -300, 400));
    meam::OrganizedCloud turned = points;
    turned.points = meam::moved(points.points, T_scan_sensor);
    const meam::PreparedScan scan = prepared(turned);
    EXPECT_TRUE(says(scan, "from where the fewest points hide others") && scan.isViewpointGuessed) << scan.report;
    const Eigen::Vector3d middle = T_scan_sensor * Eigen::Vector3d(0, 0, 600);
    const Eigen::Vector3d found = (scan.sensor.position - middle).normalized();
    EXPECT_GT(found.dot((T_scan_sensor.translation() - middle).normalized()), std::cos(10.0 / 180.0 * M_PI)) << degrees;
    EXPECT_EQ(prepared(turned).sensor.position, scan.sensor.position);
    meam::Sensor sensor;
    sensor.position = T_scan_sensor.translation();
    sensor.direction = (middle - sensor.position).normalized();
    EXPECT_FALSE(files::contains(meam::prepareScan(turned, {}, sensor).report, "check the unit of the viewpoint"));
    sensor.position = T_scan_sensor * Eigen::Vector3d(560, 0, 400); // 70 degrees beside it
    sensor.direction = (middle - sensor.position).normalized();
    EXPECT_TRUE(files::contains(meam::prepareScan(turned, {}, sensor).report, "check the unit of the viewpoint"));
  }
}

TEST(ScanPreparation, aGivenViewpointIsTaken)
{
  // The sensor stands at (100, 0, 900) and looks down; z goes up.
  meam::Sensor sensor;
  sensor.position = { 100, 0, 900 };
  sensor.direction = -Eigen::Vector3d::UnitZ();
  const Eigen::Isometry3d T_scan_sensor = above(sensor.position);
  meam::OrganizedCloud points = shuffled(boxOnFloor());
  points.points = meam::moved(points.points, T_scan_sensor);
  const meam::PreparedScan scan = meam::prepareScan(points, {}, sensor);
  EXPECT_TRUE(says(scan, "300.0 pixels of focal length), at the given viewpoint")) << scan.report;
  EXPECT_EQ(scan.sensor.position, sensor.position);
  EXPECT_LT(offOutline(edgesOf(scan).cloud.points, T_scan_sensor.inverse()), 2.5);
}

TEST(ScanPreparation, theViewpointOfAFileIsTakenWherePointsAreNotInItsFrame)
{
  const auto sensorOf = [](const Eigen::Isometry3d& T_cloud_points, const Eigen::Isometry3d& T_cloud_sensor)
  {
    meam::MeasuredCloud measured;
    measured.cloud = shuffled(boxOnFloor());
    measured.cloud.points = meam::moved(measured.cloud.points, T_cloud_points);
    measured.T_cloud_sensor = T_cloud_sensor;
    return meam::sensorOfFile(measured);
  };
  const Eigen::Isometry3d T_robot_sensor = above({ 450, -120, 600 });
  const auto above = sensorOf(T_robot_sensor, T_robot_sensor);
  ASSERT_TRUE(above);
  EXPECT_EQ(above->position, T_robot_sensor.translation());
  EXPECT_EQ(above->direction, -Eigen::Vector3d::UnitZ()) << "from where they are on a grid";
  const Eigen::Isometry3d T_place(Eigen::Translation3d(T_robot_sensor.translation()));
  Eigen::Isometry3d T_tilted = T_robot_sensor;
  T_tilted.rotate(Eigen::AngleAxisd(0.6, Eigen::Vector3d(1, 0.3, 0.2).normalized()));
  const auto tilted = sensorOf(T_tilted, T_place);
  ASSERT_TRUE(tilted) << "only the place is told";
  EXPECT_EQ(tilted->direction, Eigen::Vector3d::Zero()) << "at the middle of the points";
  EXPECT_FALSE(sensorOf(Eigen::Isometry3d::Identity(), T_robot_sensor)) << "points in the sensor's frame";
  const Eigen::Isometry3d T_among(Eigen::Translation3d(T_robot_sensor * Eigen::Vector3d(0, 0, 600)));
  EXPECT_FALSE(sensorOf(T_robot_sensor, T_among)) << "points on all sides of it";
}

TEST(ScanPreparation, aGridWithFewPointsBecomesCoarser)
{
  meam::OrganizedCloud cloud = boxOnFloor();
  meam::Image image{ GridWidth, GridHeight, 1, {} };
  for (int i = 0; i < GridWidth * GridHeight; ++i)
  {
    if (i % GridWidth % 3 || i / GridWidth % 3)
    {
      cloud.points[i].setConstant(NAN);
    }
    image.pixels.push_back(static_cast<std::uint8_t>(i % 251));
  }
  const meam::PreparedScan scan = meam::prepareScan(cloud, image, std::nullopt);
  EXPECT_TRUE(says(scan, "11 % of the grid") && says(scan, "3 times as coarse")) << scan.report;
  EXPECT_EQ(scan.cloud.width, GridWidth / 3);
  EXPECT_EQ(scan.cloud.height, GridHeight / 3);
  EXPECT_EQ(measuredCount(scan.cloud), scan.cloud.size());
  EXPECT_EQ(scan.image.pixels[GridWidth / 3 + 1], image.pixels[3 * GridWidth + 3]);
  EXPECT_EQ(scan.pointIds[GridWidth / 3 + 1], 3 * GridWidth + 3);
}

TEST(ScanPreparation, withoutPointsItIsAnError)
{
  EXPECT_THROW(prepared({}), meam::Error);
  EXPECT_THROW(prepared({ 2, 1, { { NAN, 0, 0 }, { 0, 0, NAN } } }), meam::Error);
  EXPECT_THROW(prepared({ 3, 1, meam::Points(3, Eigen::Vector3f::Zero()) }), meam::Error);
}

TEST(ScanPreparation, tooFewPointsAndThoseOnALineAreNamed)
{
  const auto errorOf = [](const meam::Points& points) {
    return files::errorOf([&] { prepared({ static_cast<int>(points.size()), 1, points }); });
  };
  const meam::Points some{ { 3, 8, 500 }, { -20, 5, 510 }, { 9, -30, 490 }, { 40, 31, 505 } };
  for (std::size_t count = 1; count <= some.size(); ++count)
  {
    const std::string error = errorOf({ some.begin(), some.begin() + static_cast<std::ptrdiff_t>(count) });
    EXPECT_TRUE(files::contains(error, "only " + std::to_string(count) + " point")) << error;
  }
  meam::Points line, diagonal, profile;
  for (int i = 0; i < 300; ++i)
  {
    const auto at = static_cast<float>(i - 150);
    line.emplace_back(at, 0.0f, 500.0f);
    diagonal.emplace_back(at, 0.7f * at, 500.0f);
    profile.push_back(Eigen::Vector3f(0.002f * at, 0.1f, 1.0f) * (500.0f + 20.0f * std::sin(0.1f * at)));
  }
  for (const meam::Points& points : { line, diagonal, profile, meam::Points(300, Eigen::Vector3f(1, 2, 500)) })
  {
    EXPECT_TRUE(files::contains(errorOf(points), "lie on a line")) << errorOf(points);
  }
}

TEST(ScanPreparation, strayPointsDoNotSpoilTheGrid)
{
  meam::OrganizedCloud points = shuffled(boxOnFloor());
  for (int k = 1; k < 8; ++k)
  {
    points.points[100 * k] = Eigen::Vector3f(1e3f * k, -1e4f, 1e2f * k);
  }
  const meam::PreparedScan scan = prepared(points);
  EXPECT_TRUE(says(scan, "the grid of a pinhole camera (300.0 pixels")) << scan.report;
  EXPECT_LT(scan.cloud.size(), 1.3 * GridWidth * GridHeight);
}

TEST(ScanPreparation, pointsOfNoSurfaceEndInAGridOrAnError)
{
  meam::Random random(11);
  for (const float size : { 1e-6f, 1.0f, 1e4f, 1e30f })
  {
    for (const int count : { 1, 2, 30, 3000 })
    {
      meam::OrganizedCloud cloud{ count, 1, {} };
      for (int k = 0; k < count; ++k)
      {
        cloud.points.emplace_back(size * random.normal(), size * random.normal(), size * random.normal());
      }
      try
      {
        EXPECT_LT(prepared(cloud).cloud.size(), 1000000u);
      }
      catch (const meam::Error&)
      {
      }
    }
  }
}

TEST(ScanPreparation, ACameraMatrixOfAnotherImageSizeIsNamed)
{
  const auto reportOf = [](double cx, double cy)
  {
    const meam::Camera sensor = grids::camera(GridWidth, GridHeight, 300.0, cx, cy);
    return meam::prepareScan(grids::measured(sensor, [](int, int) { return 600.0; }), {}, std::nullopt).report;
  };
  EXPECT_EQ(reportOf(61.3, 44.2), "");
  EXPECT_EQ(reportOf(90.0, 44.2), "") << "aside in a row alone";
  const std::string twice = reportOf(119.5, 89.5);
  EXPECT_TRUE(files::contains(twice, "50 % of the width right of the middle and 37 % below it")) << twice;
  EXPECT_TRUE(files::contains(twice, "another image size")) << twice;
}

TEST(ScanPreparation, AViewpointThatContradictsAnOrganizedScanIsNamed)
{
  const auto reportOf = [](const Eigen::Vector3d& position) {
    return meam::prepareScan(boxOnFloor(), {}, meam::Sensor{ true, position, {} }).report;
  };
  EXPECT_EQ(reportOf({ 0, 0, 0 }), "");
  const std::string aside = reportOf({ 500, 0, 500 });
  EXPECT_TRUE(files::contains(aside, "From the given viewpoint many points hide others")) << aside;
}
