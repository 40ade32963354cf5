// SPDX-License-Identifier: BSD-3-Clause
#include "pick/proposal/GraspFitting.h"
#include "TestFiles.h"
#include "TestParts.h"

namespace
{
meam::Grasp at(const Eigen::Vector3d& position)
{
  meam::Grasp grasp;
  grasp.name = "hand";
  grasp.T_model_grasp = meam::graspFrame(position, { 0, 0, -1 }, { 1, 0, 0 });
  return grasp;
}
}

TEST(GraspFitting, jawsCloseUntilTheyTouch)
{
  const meam::MeshRays rays(parts::box({ 0, 0, 0 }, { 20, 40, 60 }));
  const meam::Grasp fitted = meam::fitGrasp(rays, at({ 3, 5, 50 }), meam::Gripper(), 100);
  EXPECT_EQ(fitted.width, 20.0);
  EXPECT_EQ(fitted.T_model_grasp.translation(), Eigen::Vector3d(10, 5, 50));
  EXPECT_EQ(fitted.T_model_grasp.linear(), at({}).T_model_grasp.linear());
  EXPECT_EQ(fitted.name, "hand");
}

TEST(GraspFitting, aCupGoesDownToTheSurface)
{
  const meam::MeshRays rays(parts::box({ 0, 0, 0 }, { 20, 40, 60 }));
  meam::Grasp cup = at({ 3, 5, 70 });
  cup.kind = meam::GraspKind::Suction;
  EXPECT_EQ(meam::fitGrasp(rays, cup, meam::Gripper(), 100).T_model_grasp.translation(), Eigen::Vector3d(3, 5, 60));
  cup.T_model_grasp.translation().z() = 40; // within the part
  EXPECT_EQ(meam::fitGrasp(rays, cup, meam::Gripper(), 100).T_model_grasp.translation(), Eigen::Vector3d(3, 5, 60));
}

TEST(GraspFitting, nothingToTouch)
{
  const meam::MeshRays rays(parts::box({ 0, 0, 0 }, { 20, 40, 60 }));
  const auto error = [&](const meam::Grasp& grasp)
  { return files::errorOf([&] { meam::fitGrasp(rays, grasp, meam::Gripper(), 100); }); };
  EXPECT_TRUE(files::contains(error(at({ 3, 5, 70 })), "'hand' closes on nothing"));
  EXPECT_TRUE(
    files::contains(error(at({ 45, 5, 50 })), "closes on nothing")); // the opening of 60 mm ends within the part
  meam::Grasp cup = at({ 30, 5, 70 });
  cup.kind = meam::GraspKind::Suction;
  EXPECT_TRUE(files::contains(error(cup), "'hand' meets nothing"));
}
