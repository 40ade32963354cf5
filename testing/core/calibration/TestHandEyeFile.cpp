// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/HandEyeFile.h"
#include "TestFiles.h"

namespace
{
const std::string Identity = "[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]";
const std::string Turned = "[0,-1,0,1.5, 1,0,0,2, 0,0,1,3, 0,0,0,1]";

const files::Reader readHandEye{ meam::readHandEye, "pairs" };

std::string pair(const std::string& gripper, const std::string& target)
{
  return R"({"T_base_gripper": )" + gripper + R"(, "T_camera_target": )" + target + "}";
}
}

TEST(HandEyeFile, json)
{
  const meam::HandEyeFile file =
    readHandEye("{\"pairs\": [" + pair(Identity, Turned) + "," + pair(Turned, Identity) + "]}");
  ASSERT_EQ(file.pairs.size(), 2u);
  EXPECT_FALSE(file.mount);
  EXPECT_TRUE(file.pairs[0].T_base_gripper.matrix().isIdentity());
  EXPECT_EQ(file.pairs[0].T_camera_target * Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(1.5, 3, 3));
  const meam::HandEyeFile metres =
    readHandEye(R"({"units": "m", "mount": "hand", "pairs": [)" + pair(Identity, Turned) + "]}");
  EXPECT_EQ(metres.pairs[0].T_camera_target.translation(), Eigen::Vector3d(1500, 2000, 3000));
  EXPECT_EQ(metres.mount, meam::CameraMount::Hand);
}

TEST(HandEyeFile, table)
{
  const std::string row = "1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1,0,-1,0,1.5,1,0,0,2,0,0,1,3,0,0,0,1\n";
  for (const char* header : { "", "b00,b01 and so on\n", "# robot, camera\n", "\xEF\xBB\xBF",
         "\xEF\xBB\xBF"
         "b00\n" })
  {
    const meam::HandEyeFile file = readHandEye(header + row + row);
    ASSERT_EQ(file.pairs.size(), 2u);
    EXPECT_EQ(file.pairs[1].T_camera_target.translation(), Eigen::Vector3d(1.5, 2, 3));
  }
}

TEST(HandEyeFile, jsonWithAByteOrderMarkAndPairsAlone)
{
  const std::string pairs = "[" + pair(Identity, Turned) + "," + pair(Turned, Identity) + "]";
  EXPECT_EQ(readHandEye("\xEF\xBB\xBF{\"pairs\": " + pairs + "}").pairs.size(), 2u);
  EXPECT_EQ(readHandEye(pairs).pairs.size(), 2u);
}

TEST(HandEyeFile, errorsNameThePair)
{
  readHandEye.fails("{}", "'pairs'");
  readHandEye.fails("{\"pairs\": [{}]}", "'T_base_gripper' in pair 1");
  readHandEye.fails("{\"pairs\": [" + pair(Identity, Identity) + "," + pair(Identity, "[1, 2]") + "]}", "pair 2");
  readHandEye.fails("{\"pairs\": [" + pair(Identity, "[2,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]") + "]}", "T_camera_target");
  readHandEye.fails(R"({"units": "inch", "pairs": []})", "'units'");
  readHandEye.fails(R"({"mount": "wall", "pairs": []})", "'mount'");
  readHandEye.fails("1,2,3\n", "32 numbers, T_base_gripper and T_camera_target as matrices of 4x4, but 3 words");
  readHandEye.fails("1,2,x3\n", "32 numbers");
  EXPECT_THROW(meam::readHandEye("/no/such/file"), meam::Error);
}
