// SPDX-License-Identifier: BSD-3-Clause
#include "base/Error.h"
#include "TestGrids.h"
#include "TestSteps.h"
#include "scene/Camera.h"

#include <limits>
#include <string>

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

meam::Camera pinhole()
{
  meam::Camera camera = grids::camera(0, 0, 100.0, 31.5, 23.5);
  camera.fy = 200.0;
  return camera;
}

/// A second camera with a strong lens, beside the sensor.
meam::Camera colorCamera()
{
  meam::Camera camera = grids::camera(1280, 1024, 1200.0, 640.25, 511.5);
  camera.fy = 1190.0;
  camera.distortion = { -0.21, 0.13, 0.0011, -0.0007, -0.035 };
  camera.T_camera_scene.linear() << 0.93575480327791882, -0.30293271340263711, -0.18054007669439776,
    0.28316496056507373, 0.95058061790609139, -0.12733457491763028, 0.21019170595074288, 0.06803131640494002,
    0.97529030895304569;
  camera.T_camera_scene.translation() << 12.0, -30.0, 40.0;
  return camera;
}

}

TEST(Camera, pinholeByHand)
{
  const meam::Camera camera = pinhole();
  EXPECT_EQ(meam::project(camera, { 0, 0, 500 }), Eigen::Vector2d(31.5, 23.5));
  EXPECT_EQ(meam::project(camera, { 50, -25, 500 }), Eigen::Vector2d(41.5, 13.5));
  EXPECT_EQ(meam::unproject(camera, { 41.5, 13.5 }, 500), Eigen::Vector3d(50, -25, 500));
}

TEST(Camera, aCameraBesideTheSensor)
{
  meam::Camera camera = pinhole();
  // 100 mm to the right of the sensor, it looks along the sensor's x axis; up stays up.
  camera.T_camera_scene.linear() << 0, 0, -1, 0, 1, 0, 1, 0, 0;
  camera.T_camera_scene.translation() << 400, 0, -100;
  EXPECT_EQ(meam::project(camera, { 300, 50, 390 }), Eigen::Vector2d(31.5 + 5.0, 23.5 + 50.0));
  EXPECT_TRUE(meam::unproject(camera, { 36.5, 73.5 }, 200).isApprox(Eigen::Vector3d(300, 50, 390)));
}

TEST(Camera, distortionByHand)
{
  meam::Camera camera = pinhole();
  camera.fy = 100.0;
  camera.cx = camera.cy = 0.0;
  // x = 0.5, y = 0.2: r2 = 0.29.
  const Eigen::Vector3d point(250, 100, 500);
  camera.distortion = { 0.1, 0, 0, 0, 0 };
  EXPECT_TRUE(meam::project(camera, point).isApprox(Eigen::Vector2d(50, 20) * 1.029));
  camera.distortion = { 0, 0.1, 0, 0, 0.2 };
  EXPECT_TRUE(meam::project(camera, point).isApprox(Eigen::Vector2d(50, 20) * (1 + 0.00841 + 0.0048778)));
  camera.distortion = { 0.1, 0, 0, 0, 0, 0.2, 0, 0 }; // (1 + 0.1 r2) / (1 + 0.2 r2)
  EXPECT_TRUE(
    meam::project(camera, { 1, 0, 1 }).isApprox(Eigen::Vector2d(camera.cx + camera.fx * 1.1 / 1.2, camera.cy)));
  camera.distortion = { 0, 0, 0.01, 0, 0 }; // p1: 2 x y, r2 + 2 y2
  EXPECT_TRUE(meam::project(camera, point).isApprox(Eigen::Vector2d(50 + 0.2, 20 + 0.37)));
  camera.distortion = { 0, 0, 0, 0.01, 0 }; // p2: r2 + 2 x2, 2 x y
  EXPECT_TRUE(meam::project(camera, point).isApprox(Eigen::Vector2d(50 + 0.79, 20 + 0.2)));
}

TEST(Camera, agreesWithOpenCV)
{
  // From cv::projectPoints of OpenCV 4.6, rotation vector (0.1, -0.2, 0.3).
  const std::pair<Eigen::Vector3d, Eigen::Vector2d> pairs[] = {
    { { 0, 0, 500 }, { 464.1667437245, 302.6571425442 } },
    { { 150, -120, 600 }, { 786.1290388465, 191.1491252380 } },
    { { -200, 90, 450 }, { -76.1845728647, 365.9079928063 } },
    { { 310, 260, 700 }, { 782.1722812470, 825.0618066968 } },
  };
  const meam::Camera camera = colorCamera();
  for (const auto& [point, pixel] : pairs)
  {
    EXPECT_LT((meam::project(camera, point) - pixel).norm(), 1e-9);
    const double depth = (camera.T_camera_scene * point).z();
    EXPECT_LT((meam::unproject(camera, pixel, depth) - point).norm(), 1e-6);
  }
}

TEST(Camera, everyPixelHasItsRay)
{
  const meam::Camera camera = colorCamera();
  for (int row = 0; row < camera.height; row += 93)
  {
    for (int column = 0; column < camera.width; column += 71)
    {
      const Eigen::Vector2d pixel(column, row);
      EXPECT_LT((meam::project(camera, meam::unproject(camera, pixel, 800.0)) - pixel).norm(), 1e-8);
    }
  }
}

TEST(Camera, whatIsNotInFrontHasNoPixel)
{
  EXPECT_TRUE(meam::project(pinhole(), { 1, 2, 0 }).array().isNaN().all());
  EXPECT_TRUE(meam::project(pinhole(), { 1, 2, -5 }).array().isNaN().all());
  EXPECT_TRUE(meam::project(pinhole(), { NaN, 2, 5 }).array().isNaN().any());
  EXPECT_TRUE(meam::project(pinhole(), { 1, 2, NaN }).array().isNaN().all());
}

TEST(Camera, aPixelBeyondTheLensHasNoRay)
{
  meam::Camera camera = pinhole();
  camera.distortion = { -0.5, 0, 0, 0, 0 }; // no ray is seen farther out than 0.544 focal lengths
  EXPECT_TRUE(meam::unproject(camera, { camera.cx + 54, camera.cy }, 500).allFinite());
  EXPECT_TRUE(meam::unproject(camera, { camera.cx + 60, camera.cy }, 500).array().isNaN().any());
}

TEST(Camera, whatIsNoCamera)
{
  const auto require = [](const meam::Camera& camera) { meam::requireCamera(camera); };
  EXPECT_NO_THROW(require(pinhole()));
  steps::expectRefused<meam::Camera>(require,
    { { [](auto& c) { c = {}; }, "focal lengths" }, { [](auto& c) { c.fy = 0.0; }, "focal lengths" },
      { [](auto& c) { c.fy = -3.0; }, "focal lengths" }, { [](auto& c) { c.fy = NaN; }, "focal lengths" },
      { [](auto& c) { c.fy = INFINITY; }, "focal lengths" }, { [](auto& c) { c.cx = NaN; }, "not a number" },
      { [](auto& c) { c.distortion[4] = NaN; }, "not a number" },
      { [](auto& c) { c.T_camera_scene.translation().x() = NaN; }, "not a number" },
      { [](auto& c) { c.width = -1; }, "negative" } },
    pinhole());
}
