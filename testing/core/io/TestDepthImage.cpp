// SPDX-License-Identifier: BSD-3-Clause
#include "TestFiles.h"
#include "TestGrids.h"
#include "TestImages.h"
#include "io/DepthImage.h"
#include "io/ImageFile.h"

#include <cmath>

namespace
{
const cv::Mat depths = (cv::Mat_<std::uint16_t>(2, 3) << 0, 5000, 65534, 1, 2, 3);

meam::Camera camera()
{
  meam::Camera result = grids::camera(0, 0, 100.0, 1.0, 0.5);
  result.fy = 200.0;
  return result;
}
}

TEST(DepthImage, aPointForEachPixel)
{
  const files::Folder folder;
  meam::Camera beside = camera();
  beside.T_camera_scene.translation() << 7, 8, 9; // does not matter for its own depth
  for (const char* form : { ".png", ".tiff" })
  {
    const std::string path = folder.write("depth", images::encoded(form, depths));
    const meam::OrganizedCloud cloud = meam::readDepthImage(path, beside, 0.1);
    EXPECT_EQ(cloud.width, 3);
    EXPECT_EQ(cloud.height, 2);
    ASSERT_EQ(cloud.size(), 6u);
    EXPECT_TRUE(std::isnan(cloud.points[0].z()));
    EXPECT_TRUE(cloud.points[1].isApprox(Eigen::Vector3f(0, -0.5f / 200 * 500, 500)));
    EXPECT_TRUE(cloud.points[2].isApprox(Eigen::Vector3f(65.534f, -0.5f / 200 * 6553.4f, 6553.4f)));
    EXPECT_TRUE(cloud.points[5].isApprox(Eigen::Vector3f(0.003f, 0.5f / 200 * 0.3f, 0.3f)));
  }
}

TEST(DepthImage, realNumbers)
{
  const files::Folder folder;
  const cv::Mat metres = (cv::Mat_<float>(2, 3) << 0, 0.5f, NAN, -1, INFINITY, 0.25f);
  cv::Mat precise;
  metres.convertTo(precise, CV_64F);
  for (const cv::Mat& pixels : { metres, precise })
  {
    const meam::OrganizedCloud cloud =
      meam::readDepthImage(folder.write("depth.tiff", images::encoded(".tiff", pixels)), camera(), 1000.0);
    EXPECT_EQ(cloud.points[1].z(), 500.0f);
    EXPECT_EQ(cloud.points[5].z(), 250.0f);
    for (const int none : { 0, 2, 3, 4 })
    {
      EXPECT_TRUE(std::isnan(cloud.points[none].z())) << none;
    }
  }
  const cv::Mat saturated = (cv::Mat_<std::uint16_t>(1, 2) << 65535, 500);
  EXPECT_TRUE(std::isnan(
    meam::readDepthImage(folder.write("depth.png", images::encoded(".png", saturated)), camera()).points[0].z()));
}

TEST(DepthImage, wholeNumbersOfOtherKinds)
{
  const files::Folder folder;
  const auto depthsOf = [&](const std::string& bytes)
  {
    std::vector<float> result;
    for (const Eigen::Vector3f& point : meam::readDepthImage(folder.write("depth.tiff", bytes), camera()).points)
    {
      result.push_back(std::isnan(point.z()) ? 0.0f : point.z());
    }
    return result;
  };
  const std::string ofShort = images::encoded(".tiff", (cv::Mat_<std::int16_t>(1, 4) << 0, -1, 700, 32767));
  EXPECT_EQ(depthsOf(ofShort), (std::vector<float>{ 0, 0, 700, 0 }));
  std::string ofInt = images::encoded(".tiff", (cv::Mat_<std::int32_t>(1, 4) << 0, -1, 700, 70000));
  EXPECT_EQ(depthsOf(ofInt), (std::vector<float>{ 0, 0, 700, 70000 }));
  const std::string tag("\x53\x01\x03\0\x01\0\0\0", 8); // SampleFormat, of one number of 16 bits
  ASSERT_NE(ofInt.find(tag), std::string::npos);
  ofInt[ofInt.find(tag) + tag.size()] = 1; // without a sign
  EXPECT_EQ(depthsOf(ofInt), (std::vector<float>{ 0, 0, 700, 70000 }));
  std::string half = ofShort;
  half[half.find(tag) + tag.size()] = 3;
  EXPECT_TRUE(
    files::contains(files::errorOf([&] { depthsOf(half); }), "has real numbers of 16 bits, which are not read"));
  EXPECT_TRUE(files::contains(files::errorOf([&] { depthsOf("P6 1 1 255\n012"); }), "depth as PNG, TIFF, PGM or PFM"));
  EXPECT_TRUE(
    files::contains(files::errorOf([&] { depthsOf("\x76\x2f\x31\x01"); }), "OpenEXR image, which is not read"));
}

TEST(DepthImage, bytesInTheWrongOrderAreNamed)
{
  const files::Folder folder;
  const auto errorOf = [&](const char* name, const cv::Mat& pixels) {
    return files::errorOf([&] { meam::readDepthImage(folder.write(name, images::encoded(name, pixels)), camera()); });
  };
  cv::Mat depth(20, 30, CV_16UC1), wrong(20, 30, CV_16UC1);
  for (int i = 0; i < 600; ++i)
  {
    const auto value = static_cast<std::uint16_t>(i % 7 == 0 ? 0 : 500 + 10 * (i % 30));
    depth.at<std::uint16_t>(i / 30, i % 30) = value;
    wrong.at<std::uint16_t>(i / 30, i % 30) = static_cast<std::uint16_t>(value << 8 | value >> 8);
  }
  for (const char* name : { "depth.png", "depth.tiff", "depth.pgm" })
  {
    EXPECT_EQ(errorOf(name, depth), "");
    EXPECT_TRUE(files::contains(errorOf(name, wrong), "bytes of its values in the wrong order")) << name;
  }
  cv::Mat real;
  depth.convertTo(real, CV_32F, 0.001);
  EXPECT_EQ(errorOf("depth.pfm", real), "");
}

TEST(DepthImage, depthsBeyondAnySensor)
{
  const files::Folder folder;
  const cv::Mat tenths = (cv::Mat_<std::uint16_t>(1, 3) << 0, 5000, 7000);
  const std::string path = folder.write("depth.png", images::encoded(".png", tenths));
  EXPECT_EQ(meam::readDepthImage(path, camera(), 10.0).points[1].z(), 50000.0f);
  EXPECT_TRUE(files::contains(files::errorOf([&] { meam::readDepthImage(path, camera(), 1000.0); }),
    "has nothing nearer than 5000 m, with a depth scale of 1000 mm for a value of 1: correct depth_scale in its "
    "calibration, or the depth scale that was given (--depth-scale)."));
}

TEST(DepthImage, theLensIsUndone)
{
  const files::Folder folder;
  meam::Camera lens = camera();
  lens.distortion = { 0.2, 0, 0.01, 0, 0 };
  const meam::OrganizedCloud cloud =
    meam::readDepthImage(folder.write("depth.png", images::encoded(".png", depths)), lens);
  EXPECT_LT((meam::project(lens, cloud.points[2].cast<double>()) - Eigen::Vector2d(2, 0)).norm(), 1e-4);
}

TEST(DepthImage, badInput)
{
  const files::Folder folder;
  const std::string path = folder.write("depth.png", images::encoded(".png", depths));
  const auto errorOf = [&](const std::string& file, const meam::Camera& of, double scale)
  { return files::errorOf([&] { meam::readDepthImage(file, of, scale); }); };
  for (const double scale : { 0.0, -1.0, std::nan("") })
  {
    EXPECT_TRUE(files::contains(errorOf(path, camera(), scale), "depth scale"));
  }
  meam::Camera bad = camera();
  bad.fx = 0;
  EXPECT_TRUE(files::contains(errorOf(path, bad, 1), "focal lengths"));
  bad = camera();
  bad.width = 640;
  EXPECT_TRUE(files::contains(errorOf(path, bad, 1), "3 x 2"));
  const std::string grey = folder.write("grey.png", images::encoded(".png", cv::Mat::zeros(2, 3, CV_8UC1)));
  EXPECT_TRUE(files::contains(errorOf(grey, camera(), 1), "1 channels of 8 bits"));
  const std::string colour = folder.write("colour.png", images::encoded(".png", cv::Mat::zeros(2, 3, CV_16UC3)));
  EXPECT_TRUE(files::contains(errorOf(colour, camera(), 1), "3 channels of 16 bits"));
  EXPECT_TRUE(files::contains(errorOf("/no/such/depth.png", camera(), 1), "/no/such/depth.png"));
}
