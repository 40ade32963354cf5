// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/RobotFrameFile.h"
#include "TestFiles.h"

#include <cmath>

namespace
{
const files::Reader readRobotFrame{ meam::readRobotFrame, "robot" };

/// A quarter turn about z and 100, 200, 300 mm.
Eigen::Isometry3d quarterTurn()
{
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  T.translation() << 100, 200, 300;
  return T;
}

const std::string Rows = "0, -1, 0, 100, 1, 0, 0, 200, 0, 0, 1, 300, 0, 0, 0, 1";
const std::string Fields = "translation:\n  x: 0.1\n  y: 0.2\n  z: 0.3\nrotation:\n  x: 0.0\n  y: 0.0\n"
                           "  z: 0.70710678\n  w: 0.70710678\n";
}

TEST(RobotFrameFile, everyForm)
{
  const std::string transform =
    R"({"translation": {"x": 0.1, "y": 0.2, "z": 0.3}, "rotation": {"x": 0, "y": 0, "z": 0.70710678, "w": 0.70710678}})";
  for (const std::string& text :
    { "{\"T_robot_camera\": [" + Rows + "]}", "{\"T_robot_camera\": {\"rows\": 4, \"data\": [" + Rows + "]}}",
      std::string("{\"units\": \"m\", \"T_robot_camera\": [[0,-1,0,0.1],[1,0,0,0.2],[0,0,1,0.3],[0,0,0,1]]}"),
      "%YAML:1.0\n---\nT_robot_camera: !!opencv-matrix\n   rows: 4\n   cols: 4\n   dt: d\n   data: [ " + Rows + " ]\n",
      std::string("<?xml version=\"1.0\"?>\n<opencv_storage>\n<T_robot_camera type_id=\"opencv-matrix\"><rows>4</rows>"
                  "<data>0 -1 0 100 1 0 0 200 0 0 1 300 0 0 0 1</data></T_robot_camera>\n</opencv_storage>\n"),
      transform, "{\"header\": {\"frame_id\": \"base\"}, \"transform\": " + transform + "}", Fields,
      std::string("transforms:\n- header:\n    stamp:\n      sec: 0\n      nanosec: 0\n    frame_id: base\n"
                  "  child_frame_id: camera\n  transform:\n    translation:\n      x: 0.1\n      y: 0.2\n      z: 0.3\n"
                  "    rotation:\n      x: 0.0\n      y: 0.0\n      z: 0.70710678\n      w: 0.70710678\n---\n"),
      std::string("parameters:\n  eye_on_hand: false\ntransformation: # of easy_handeye\n  x: 0.1\n  y: 0.2\n  z: 0.3\n"
                  "  qx: 0.0\n  qy: 0.0\n  qz: 0.70710678\n  qw: 0.70710678\n"),
      std::string("pose:\n  position: {x: 0.1, y: 0.2, z: 0.3}\n  orientation: {x: 0, y: 0, z: 0.70710678, w: "
                  "0.70710678}\n"),
      Rows, std::string("[[0 -1 0 100]\n [1 0 0 200]\n [0 0 1 300]\n [0 0 0 1]]") })
  {
    EXPECT_TRUE(readRobotFrame(text).isApprox(quarterTurn(), 1e-7)) << text << "\n" << readRobotFrame(text).matrix();
  }
}

TEST(RobotFrameFile, whatIsWrittenIsReadAgain)
{
  const files::Folder folder;
  const std::string json = folder.path("robot.json"), yaml = folder.path("robot.yaml");
  Eigen::Isometry3d T = quarterTurn();
  T.rotate(Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()));
  meam::writeRobotFrame(json, T);
  EXPECT_TRUE(meam::readRobotFrame(json).isApprox(T, 1e-14));
  meam::writeRobotFrame(yaml, T, "robot: base", "camera");
  EXPECT_TRUE(meam::readRobotFrame(yaml).isApprox(T, 1e-14));
  T.translation().x() = std::nan("");
  EXPECT_THROW(meam::writeRobotFrame(json, T), meam::Error);
}

TEST(RobotFrameFile, bad)
{
  readRobotFrame.fails("{}", "no T_robot_camera");
  readRobotFrame.fails("a: b\n", "no T_robot_camera");
  readRobotFrame.fails("", "no T_robot_camera");
  readRobotFrame.fails(Rows + " " + Rows, "no T_robot_camera");
  readRobotFrame.fails("{\"T_robot_camera\": [1, 2]}", "2 numbers");
  readRobotFrame.fails("{\"T_robot_camera\": [2,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}", "not a rotation");
  readRobotFrame.fails("{\"units\": \"inch\", \"T_robot_camera\": [" + Rows + "]}", "'units'");
  std::string longer = Fields;
  longer.replace(longer.find("w: 0.7"), 6, "w: 0.9");
  readRobotFrame.fails(longer, "quaternion");
  const auto item = [](const std::string& name)
  { return name + ":\n  x: 1\n  y: 2\n  z: 3\n  qx: 0\n  qy: 0\n  qz: 0\n  qw: 1\n"; };
  readRobotFrame.fails(item("left") + item("right"), "several");
  EXPECT_THROW(meam::readRobotFrame("/no/such/file"), meam::Error);
  // Metres among mm, and mm among metres.
  readRobotFrame.fails("1 0 0 0.4  0 1 0 0.2  0 0 1 0.9  0 0 0 1", "likely in metres, where they are taken as mm");
  readRobotFrame.fails(
    "x: 400\ny: 200\nz: 900\nqx: 0\nqy: 0\nqz: 0\nqw: 1\n", "likely in mm, where they are taken as metres");
}
