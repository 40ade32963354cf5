// SPDX-License-Identifier: BSD-3-Clause
#include "base/sequences/Sequences.h"
#include "pose/PoseMemory.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace
{
meam::Pose poseAt(double x)
{
  meam::Pose pose;
  pose.T_scene_model = Eigen::Translation3d(x, 2.0, 3.0) * Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitZ());
  return pose;
}

std::vector<double> places(const meam::Poses& poses)
{
  return meam::mapped<double>(poses, [&](const meam::Pose& pose) { return pose.T_scene_model.translation().x(); });
}
}

TEST(PoseMemory, AsksForNewPosesAloneAndKeepsTheOrder)
{
  meam::PoseMemory<double> memory;
  std::vector<std::vector<double>> asked;
  const auto compute = [&](const meam::Poses& unknown)
  {
    asked.push_back(places(unknown));
    return asked.back();
  };
  EXPECT_EQ(memory.of({ poseAt(2.0), poseAt(1.0) }, compute), std::vector<double>({ 2.0, 1.0 }));
  EXPECT_EQ(memory.of({ poseAt(1.0), poseAt(3.0), poseAt(2.0) }, compute), std::vector<double>({ 1.0, 3.0, 2.0 }));
  EXPECT_EQ(asked, std::vector<std::vector<double>>({ { 2.0, 1.0 }, { 3.0 } }));
  EXPECT_EQ(memory.size(), 3u);
}

TEST(PoseMemory, AnInterruptedComputationLeavesNothing)
{
  meam::PoseMemory<double> memory;
  EXPECT_THROW(
    memory.of({ poseAt(1.0) }, [](const meam::Poses&) -> std::vector<double> { throw std::runtime_error("stopped"); }),
    std::runtime_error);
  EXPECT_EQ(memory.of({ poseAt(1.0) }, places), std::vector<double>({ 1.0 }));
}
