// SPDX-License-Identifier: BSD-3-Clause
#include "TestParts.h"
#include "simulation/MassProperties.h"
#include "mesh/TriangleMesh.h"

#include <algorithm>

namespace
{
/// A box of 6 x 4 x 2 whose corner of least coordinates is at (10, 20, 30), turned about the origin.
meam::TriangleMesh turnedBox(const Eigen::Matrix3f& turn)
{
  meam::TriangleMesh mesh = parts::box({ 10, 20, 30 }, { 16, 24, 32 });
  for (auto& vertex : mesh.vertices)
  {
    vertex = turn * vertex;
  }
  return mesh;
}
}

TEST(MassProperties, ofASolidBox)
{
  const Eigen::Matrix3f turn = Eigen::AngleAxisf(0.5f, Eigen::Vector3f(1, 2, 3).normalized()).matrix();
  const meam::MassProperties mass = meam::massProperties(turnedBox(turn), true);
  const Eigen::Vector3d centre = (turn * Eigen::Vector3f(13, 22, 31)).cast<double>();
  EXPECT_LT((mass.T_model_body.translation() - centre).norm(), 1e-4);
  EXPECT_NEAR(mass.T_model_body.linear().determinant(), 1.0, 1e-9);
  // m / 12 (a^2 + b^2); the longest axis has the least of it.
  Eigen::Vector3d inertia = mass.inertia;
  std::sort(inertia.data(), inertia.data() + 3);
  EXPECT_LT((inertia - Eigen::Vector3d(20, 40, 52) / 12.0).norm(), 1e-3);
  int longest = 0;
  mass.inertia.minCoeff(&longest);
  EXPECT_NEAR(std::abs(mass.T_model_body.linear().col(longest).dot(turn.col(0).cast<double>())), 1.0, 1e-4);
}

TEST(MassProperties, ofASheet)
{
  meam::TriangleMesh mesh;
  mesh.vertices = { { 0, 0, 5 }, { 6, 0, 5 }, { 6, 2, 5 }, { 0, 2, 5 } };
  mesh.triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  const meam::MassProperties mass = meam::massProperties(mesh, false);
  EXPECT_LT((mass.T_model_body.translation() - Eigen::Vector3d(3, 1, 5)).norm(), 1e-6);
  Eigen::Vector3d inertia = mass.inertia;
  std::sort(inertia.data(), inertia.data() + 3);
  EXPECT_LT((inertia - Eigen::Vector3d(4, 36, 40) / 12.0).norm(), 1e-6);
}
