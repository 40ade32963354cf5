// SPDX-License-Identifier: BSD-3-Clause
// What meam.h declares, through the shared libraries; the core beside them makes the scenes.
#include "TestAPI.h"
#include "TestGrids.h"
#include "TestImages.h"
#include "TestSteps.h"
#include "picks.h"

#include <algorithm>

namespace
{
using namespace api;

/// Three brackets seen from above, with their edges.
meam::Scan scanOfThree()
{
  const scenes::Seen scene = scenes::seenFromAbove(scenes::threeCopies());
  meam::Scan scan;
  scan.points = scene.surface;
  scan.width = static_cast<int>(scan.points.size());
  scan.edges = scene.edges.points;
  return scan;
}

/// A step of 20 mm between two planes, 500 mm in front of the sensor.
meam::Scan step()
{
  return scanOf(grids::centered(60, 40, [](double x, double) { return x < 0.0 ? 500.0 : 520.0; }));
}

meam::Detections detect(const meam::Scan& scan, const meam::DetectSettings& settings = {})
{
  return meam::detect(bracketModel(), scan, settings);
}

/// So many poses.
meam::DetectSettings atMost(int poses)
{
  meam::DetectSettings settings;
  settings.maximumPoses = poses;
  return settings;
}
}

TEST(API, FindsWhatTheCoreFinds)
{
  const meam::Detections found = detect(scanOfThree(), atMost(3));
  const meam::Poses poses = scenes::estimatePoses(scenes::bracket(), scenes::seenFromAbove(scenes::threeCopies()),
    meam::detectionSettings(meam::Preset::Recommended, 3));
  ASSERT_EQ(found.poses.size(), 3u);
  ASSERT_EQ(poses.size(), 3u);
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_EQ(found.poses[i].T_scan_part.matrix(), poses[i].T_scene_model.matrix()) << i;
    EXPECT_EQ(found.poses[i].score, poses[i].score) << i;
    EXPECT_EQ(found.poses[i].placeProbability, poses[i].placeProbability) << i;
    EXPECT_EQ(found.poses[i].probability, poses[i].probability) << i;
    EXPECT_EQ(found.poses[i].certainty, poses[i].certainty) << i;
    EXPECT_EQ(found.poses[i].visibleFraction, poses[i].visibleFraction) << i;
    EXPECT_EQ(found.poses[i].residual, poses[i].fit.residual) << i;
    EXPECT_EQ(found.poses[i].votes, poses[i].votes) << i;
    EXPECT_EQ(found.poses[i].covariance, poses[i].fit.covariance) << i;
  }
  EXPECT_GT(found.seconds, 0.0);
  EXPECT_EQ(found.warning, "");
}

TEST(API, OfSeveralTypesOfPartOneClaimsASurface)
{
  // Each type by itself finds the brackets; together the one that is listed first has each place.
  const meam::Detections alone = detect(scanOfThree(), atMost(3));
  const meam::Detections twice = meam::detect({ bracketModel(), bracketModel() }, scanOfThree(), atMost(3));
  ASSERT_EQ(twice.poses.size(), 3u);
  for (const meam::DetectedPose& pose : twice.poses)
  {
    EXPECT_EQ(pose.part, 0);
    EXPECT_TRUE(std::any_of(alone.poses.begin(), alone.poses.end(),
      [&](const meam::DetectedPose& other)
      { return (other.T_scan_part.matrix() - pose.T_scan_part.matrix()).norm() < 0.5; }));
  }
  EXPECT_THROW(meam::detect(std::vector<meam::Model>{}, scanOfThree()), meam::Error);
  EXPECT_THROW(meam::detect({ bracketModel(), meam::Model() }, scanOfThree()), meam::Error);
}

TEST(API, ATimeLimitIsKept)
{
  meam::DetectSettings settings;
  settings.timeLimit = 1000.0;
  EXPECT_FALSE(detect(scanOfThree(), settings).isCutShort);
  settings.timeLimit = 1e-6;
  const meam::Detections nothing = detect(scanOfThree(), settings);
  EXPECT_TRUE(nothing.isCutShort);
  EXPECT_TRUE(nothing.poses.empty());
  EXPECT_TRUE(files::contains(nothing.warning, "time limit")) << nothing.warning;
}

TEST(API, OfARegionThePartsThatLieInIt)
{
  meam::Scan scan = scanOfThree();
  const auto sure = [&]
  {
    std::vector<Eigen::Vector3d> middles;
    for (const meam::DetectedPose& pose : detect(scan, atMost(0)).poses)
    {
      if (pose.placeProbability > 0.5)
      {
        middles.push_back(pose.T_scan_part * bracketModel().middle());
      }
    }
    return middles;
  };
  const std::vector<Eigen::Vector3d> all = sure();
  ASSERT_EQ(all.size(), 3u);
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(20.0);
  scan.region.box = { all[1] - half, all[1] + half };
  const std::vector<Eigen::Vector3d> one = sure();
  ASSERT_EQ(one.size(), 1u);
  EXPECT_LT((one[0] - all[1]).norm(), 0.5);
  // Its border cuts the copy: the middle lies outside, and no other pose takes the surface inside.
  scan.region.box.min().x() = all[1].x() + 1.0;
  EXPECT_TRUE(sure().empty());
  scan.region = { {}, { 1, 0 } };
  EXPECT_TRUE(files::contains(files::errorOf([&] { sure(); }), "2 pixels"));
}

TEST(API, SettingsReachTheSteps)
{
  EXPECT_EQ(detect(scanOfThree(), atMost(1)).poses.size(), 1u);
  meam::DetectSettings settings = atMost(0);
  settings.minimumProbability = 1.0;
  EXPECT_TRUE(detect(scanOfThree(), settings).poses.empty());
  settings = {};
  const meam::Detections usual = detect(scanOfThree());
  settings.threads = 1;
  const meam::Detections oneThread = detect(scanOfThree(), settings);
  ASSERT_EQ(usual.poses.size(), oneThread.poses.size());
  EXPECT_EQ(usual.poses[0].T_scan_part.matrix(), oneThread.poses[0].T_scan_part.matrix());
  // To a sensor that looks from below the same points are other faces.
  meam::Scan below = scanOfThree();
  below.sensor = meam::Sensor{ false, { 0, 0, 0 }, { 0, 0, 2 } };
  const meam::Detections wrong = detect(below);
  EXPECT_TRUE(std::none_of(wrong.poses.begin(), wrong.poses.end(),
    [&](const meam::DetectedPose& pose)
    { return pose.probability > 0.5 && pose.T_scan_part.isApprox(usual.poses[0].T_scan_part, 1e-2); }));
  // From a place alone it looks at the middle of the points.
  const meam::Scan three = scanOfThree();
  const auto fromAbove = [&](double height, const Eigen::Vector3d& direction)
  {
    meam::Scan scan = three;
    scan.sensor = meam::Sensor{ true, { 0, 0, height }, direction };
    return detect(scan).poses;
  };
  const Eigen::Vector3d sum = std::accumulate(three.points.begin(), three.points.end(), Eigen::Vector3d(0, 0, 0),
    [](const Eigen::Vector3d& part, const Eigen::Vector3f& point) { return part + point.cast<double>(); });
  const Eigen::Vector3d middle = sum / static_cast<double>(three.points.size());
  const auto given = fromAbove(900.0, middle - Eigen::Vector3d(0, 0, 900)), found = fromAbove(900.0, { 0, 0, 0 });
  ASSERT_EQ(given.size(), found.size());
  ASSERT_FALSE(given.empty());
  EXPECT_TRUE(given[0].T_scan_part.isApprox(found[0].T_scan_part, 1e-9));
  meam::Scan centimetres = scanOfThree();
  for (auto* points : { &centimetres.points, &centimetres.edges })
  {
    for (auto& point : *points)
    {
      point /= 10.0f;
    }
  }
  EXPECT_TRUE(files::contains(detect(centimetres).warning, "factor is 10 (centimetres)"));
}

TEST(API, TrainsSavesAndLoads)
{
  const files::Folder folder;
  const meam::Model model = meam::train(bracketMesh());
  EXPECT_NEAR(model.diameter(), scenes::bracket().diameter, 1e-3);
  EXPECT_TRUE(model.bounds().contains(model.middle()));
  EXPECT_LE(model.bounds().sizes().maxCoeff(), model.diameter());
  model.save(folder.path("bracket.meam"));
  const meam::Model loaded = meam::loadModel(folder.path("bracket.meam"));
  const meam::Detections a = meam::detect(model, scanOfThree()), b = meam::detect(loaded, scanOfThree());
  ASSERT_EQ(a.poses.size(), b.poses.size());
  ASSERT_GE(a.poses.size(), 3u);
  EXPECT_EQ(a.poses[0].T_scan_part.matrix(), b.poses[0].T_scan_part.matrix());
  EXPECT_GT(a.poses[0].probability, 0.5);

  meam::TrainSettings settings;
  settings.scale = 1000.0;
  EXPECT_NEAR(meam::train(bracketMesh(0.001f), settings).diameter(), model.diameter(), 1e-3);
}

TEST(API, CanBeStopped)
{
  steps::expectProgress([](const meam::Progress& progress) { meam::train(bracketMesh(), {}, progress); }, { 0.0 });
  steps::expectStops([](const meam::Progress& progress) { meam::detect(bracketModel(), scanOfThree(), {}, progress); });
}

TEST(API, WhatIsWrongWithAScan)
{
  EXPECT_TRUE(files::contains(files::errorOf([] { meam::detect(meam::Model(), scanOfThree()); }), "model is empty"));
  const auto take = [](const meam::Scan& scan) { detect(scan); };
  steps::expectRefused<meam::Scan>(take,
    { { [](auto& s) { s = {}; }, "0 points" }, { [](auto& s) { s.width -= 1; }, "a point for each" },
      { [](auto& s) {
         s.sensor = meam::Sensor{ false, { 0, 0, 0 }, { 0, 0, 0 } };
       },
        "direction is zero" },
      { [](auto& s) {
         s.sensor = meam::Sensor{ true, { 0, NAN, 0 }, { 0, 0, 1 } };
       },
        "Scan::sensor" },
      { [](auto& s) {
         s.sensor = meam::Sensor{ false, { 0, 0, 0 }, { INFINITY, 0, 0 } };
       },
        "Scan::sensor" } },
    scanOfThree());
  steps::expectRefused<meam::Scan>(take,
    { { [](auto& s) {
         s.image = { 3, 2, 1, std::vector<std::uint8_t>(6) };
       },
        "3 x 2" },
      { [](auto& s) { s.points.assign(s.points.size(), Eigen::Vector3f::Constant(NAN)); } } },
    step());
  meam::DetectSettings paper;
  paper.preset = meam::Preset::Paper;
  EXPECT_TRUE(files::contains(files::errorOf([&] { detect(step(), paper); }), "no image"));
}

TEST(API, SettingsOutOfRangeAreNamed)
{
  steps::expectRefused<meam::DetectSettings>([](const auto& settings) { detect(scanOfThree(), settings); },
    { { [](auto& s) { s.maximumPoses = -1; }, "maximumPoses" },
      { [](auto& s) { s.minimumProbability = 1.5; }, "minimumProbability" },
      { [](auto& s) { s.referenceShare = NAN; }, "referenceShare" },
      { [](auto& s) { s.timeLimit = -1.0; }, "timeLimit" } });
}

TEST(API, PartWithoutAModel)
{
  EXPECT_EQ(meam::prepareMesh(bracketMesh(), 1000.0, { 1, 2, 3 }).triangles.size(), bracketMesh().triangles.size());
  EXPECT_FALSE(meam::proposeGrasps({}, bracketMesh(), {}).empty());
}

TEST(API, EdgesOfTheCloudAlone)
{
  meam::DetectSettings settings;
  settings.imageEdges = false;
  settings.depthEdges = true;
  EXPECT_NO_THROW(detect(step(), settings)); // no image is asked for
}

TEST(API, FindsPartsInPointsAlone)
{
  meam::Scan scan = scanOfThree();
  const meam::Detections known = detect(scan);
  scan.edges.clear();
  const meam::Detections found = detect(scan);
  EXPECT_TRUE(files::contains(found.report, "not organized") && files::contains(found.report, "along -z"))
    << found.report;
  ASSERT_GE(found.poses.size(), 3u);
  int same = 0; // the points lie at random, which leaves pixels of 2 mm
  for (int k = 0; k < 3; ++k)
  {
    const Eigen::Isometry3d& pose = found.poses[k].T_scan_part;
    same += std::any_of(known.poses.begin(), known.poses.begin() + 3,
      [&](const meam::DetectedPose& other)
      {
        return (other.T_scan_part * bracketModel().middle() - pose * bracketModel().middle()).norm() < 3.0 &&
               Eigen::AngleAxisd(other.T_scan_part.linear().transpose() * pose.linear()).angle() < 0.1;
      });
  }
  EXPECT_GE(same, 2);
}

TEST(API, AScanWithNothingInItHasNothing)
{
  const meam::Detections found =
    detect(scanOf(grids::centered(200, 150, [](double x, double) { return 500.0 + 0.1 * x; })));
  EXPECT_TRUE(found.poses.empty());
  EXPECT_TRUE(files::contains(found.warning, "No part was found")) << found.warning;
  EXPECT_TRUE(files::contains(found.report, "no image")) << found.report;
}

TEST(API, ReadsScans)
{
  const files::Folder folder;
  const std::string pcd =
    folder.write("a.pcd", "FIELDS x y z intensity\nSIZE 4 4 4 4\nTYPE F F F F\nWIDTH 2\nHEIGHT 2\n"
                          "DATA ascii\n1 2 3 0\n4 5 6 100\n7 8 9 200\n10 11 12 255\n");
  meam::Scan scan = meam::loadScan(pcd, {}, 1000.0);
  EXPECT_EQ(scan.width, 2);
  EXPECT_EQ(scan.height, 2);
  EXPECT_EQ(scan.points[3], Eigen::Vector3f(10000, 11000, 12000));
  EXPECT_EQ(scan.image.channels, 1);
  EXPECT_EQ(scan.image.pixels, (std::vector<std::uint8_t>{ 0, 100, 200, 255 }));

  const std::string ply =
    folder.write("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
                          "z\nproperty uchar red\n"
                          "property uchar green\nproperty uchar blue\nend_header\n10 0 100 1 2 3\n");
  EXPECT_EQ(meam::loadScan(ply).height, 1);
  const std::string camera = folder.write(
    "camera.json", R"({"fx": 10, "fy": 10, "cx": 1, "cy": 1, "width": 4, "height": 3, "depth_scale": 0.5})");
  EXPECT_EQ(meam::loadCamera(camera).width, 4);
  scan = meam::loadScan(ply, camera);
  EXPECT_EQ(scan.width, 4);
  EXPECT_EQ(scan.height, 3);
  EXPECT_EQ(scan.points[4 * 1 + 2], Eigen::Vector3f(10, 0, 100));
  EXPECT_EQ(scan.image.channels, 3);

  const cv::Mat depth(3, 4, CV_16UC1, cv::Scalar(200));
  const std::string png = folder.write("depth.png", images::encoded(".png", depth));
  scan = meam::loadDepthImage(png, camera);
  EXPECT_EQ(scan.width, 4);
  EXPECT_EQ(scan.points[4 * 1 + 1], Eigen::Vector3f(0, 0, 100));
  EXPECT_EQ(meam::loadDepthScale(camera), 0.5);

  std::vector<float> depths(12, 200.0f);
  depths[0] = 0.0f;
  depths[1] = -1.0f;
  depths[2] = NAN;
  const meam::Scan same = meam::scanOfDepths(depths, 4, 3, meam::loadCamera(camera), 0.5);
  EXPECT_EQ(std::vector<Eigen::Vector3f>(same.points.begin() + 3, same.points.end()),
    std::vector<Eigen::Vector3f>(scan.points.begin() + 3, scan.points.end()));
  EXPECT_TRUE(std::isnan(same.points[0].x()) && std::isnan(same.points[1].x()) && std::isnan(same.points[2].x()));
  const auto errorOf = [&](int width, int height, double scale)
  { return files::errorOf([&] { meam::scanOfDepths(depths, width, height, meam::loadCamera(camera), scale); }); };
  EXPECT_TRUE(files::contains(errorOf(4, 4, 1.0), "has 12 values for 4 x 4 pixels"));
  EXPECT_TRUE(files::contains(errorOf(3, 4, 1.0), "has 3 x 4 pixels, but its camera has 4 x 3"));
  EXPECT_TRUE(files::contains(errorOf(4, 3, 0.0), "depth scale"));
  EXPECT_TRUE(files::contains(errorOf(4, 3, 1e6), "nothing nearer than 2e+05 m"));
  EXPECT_EQ(
    meam::loadImage(folder.write("grey.png", images::encoded(".png", cv::Mat(3, 4, CV_8UC1, cv::Scalar(7))))).pixels,
    std::vector<std::uint8_t>(12, 7));

  const std::string off = folder.write("a.off",
    "OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n9 0 0\n9 1 0\n9 0 1\n3 0 1 2\n3 3 4 5\n"); // two triangles, far apart
  EXPECT_TRUE(files::contains(meam::loadMesh(off).report, "far off the rest"));
  EXPECT_EQ(meam::loadCAD(off).report, meam::loadMesh(off).report);
  EXPECT_TRUE(files::contains(files::errorOf([&] { meam::loadCAD(off, { 2 }); }), "is a mesh"));

  EXPECT_TRUE(files::contains(files::errorOf([&] { meam::loadScan(png, camera); }), "loadDepthImage"));
  EXPECT_TRUE(files::contains(files::errorOf([&] { meam::loadScan(ply, {}, -1.0); }), "positive"));
  EXPECT_THROW(meam::loadScan("missing.pcd"), meam::Error);
  EXPECT_THROW(meam::loadModel("missing.meam"), meam::Error);
  EXPECT_THROW(meam::loadMesh("missing.stl"), meam::Error);
  EXPECT_THROW(meam::loadCAD("missing.step"), meam::Error);
  EXPECT_TRUE(files::contains(files::errorOf([] { meam::loadCAD("part.dxf"); }), "give a .step, .iges, .stl"));
  EXPECT_THROW(meam::loadImage("missing.png"), meam::Error);
}
