// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/SignedDistanceGrid.h"

#include "TestParts.h"
#include "base/Random.h"
#include "mesh/TriangleMesh.h"

#include <algorithm>
#include <cmath>

namespace
{
/// A box from (-3, -2, -1) to (3, 2, 1), without its lid when it is open.
meam::TriangleMesh box(bool closed)
{
  meam::TriangleMesh mesh = parts::box({ -3, -2, -1 }, { 3, 2, 1 });
  if (!closed)
  {
    mesh.triangles.erase(mesh.triangles.begin() + 2, mesh.triangles.begin() + 4);
  }
  return mesh;
}

double distanceToBox(const Eigen::Vector3f& point)
{
  const Eigen::Array3f q = point.array().abs() - Eigen::Array3f(3, 2, 1);
  return q.max(0.0f).matrix().norm() + std::min(q.maxCoeff(), 0.0f);
}
}

TEST(SignedDistanceGrid, nearAClosedBox)
{
  const meam::SignedDistanceGrid grid(box(true), true, 0.1);
  meam::Random random(1);
  int near = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const Eigen::Vector3f point(random.uniform(-4, 4), random.uniform(-3, 3), random.uniform(-2, 2));
    const double truth = distanceToBox(point);
    EXPECT_LE(grid.bound(point), std::max(truth, 0.0) + 1e-4);
    Eigen::Vector3f direction;
    const float distance = grid.at(point, direction);
    if (std::abs(truth) < 0.1)
    {
      EXPECT_NEAR(distance, truth, 0.03); // at the box's edges three linear functions are off
      EXPECT_NEAR(direction.norm(), 1.0f, 1e-4f);
      ++near;
    }
    else
    {
      EXPECT_GT(distance * truth, 0.0) << point.transpose();
    }
  }
  EXPECT_GT(near, 500);
  Eigen::Vector3f direction;
  EXPECT_NEAR(grid.at({ 3.07f, 0.31f, 0.22f }, direction), 0.07f, 1e-4f);
  EXPECT_NEAR(direction.x(), 1.0f, 1e-4f);
  EXPECT_NEAR(grid.at({ 0.5f, -1.93f, 0.22f }, direction), -0.07f, 1e-4f);
  EXPECT_NEAR(direction.y(), -1.0f, 1e-4f);
}

TEST(SignedDistanceGrid, farAway)
{
  const meam::SignedDistanceGrid grid(box(true), true, 0.1);
  EXPECT_NEAR(grid.bound({ 53, 0, 0 }), 50.0f, 0.2f);
  EXPECT_LT(grid.bound({ 53, 0, 0 }), 50.0f);
  EXPECT_LT(grid.bound({ 0, 0, 0 }), -0.7f); // not 0: all that is near to the middle is inside
}

TEST(SignedDistanceGrid, anOpenBoxHasNoInside)
{
  const meam::SignedDistanceGrid grid(box(false), false, 0.1);
  Eigen::Vector3f direction;
  EXPECT_NEAR(grid.at({ 2.93f, 0.31f, 0.22f }, direction), 0.07f, 1e-4f);
  EXPECT_NEAR(direction.x(), -1.0f, 1e-4f);
  EXPECT_GT(grid.at({ 0, 0, 1 }, direction), 1.0f);
}
