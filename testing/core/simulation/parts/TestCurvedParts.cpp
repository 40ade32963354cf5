// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/parts/CurvedParts.h"

#include "mesh/preparation/MeshPreparation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace
{
class CurvedParts : public testing::TestWithParam<meam::TriangleMesh (*)()>
{
};

/// Across an edge that two faces share how far the middle of a face lies from an arc through both (mm): that of a chord
/// as long as the narrower face is high, on a circle that turns by the angle between them. Sharp edges: 0.
double sagitta(
  const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& left, const Eigen::Vector3d& right)
{
  const Eigen::Vector3d along = (b - a).normalized();
  const Eigen::Vector3d first = along.cross(left - a);
  const Eigen::Vector3d second = (right - a).cross(along);
  const double angle = std::atan2(first.cross(second).norm(), first.dot(second));
  return angle > M_PI / 6.0 ? 0.0 : 0.5 * std::min(first.norm(), second.norm()) * std::tan(0.25 * angle);
}
}

TEST_P(CurvedParts, areFinerThanATenthOfAMillimeter)
{
  const meam::TriangleMesh part = GetParam()();
  EXPECT_LT(part.triangles.size(), 4000u);
  std::map<std::pair<int, int>, int> third; // of the face on the left of an edge
  for (const auto& t : part.triangles)
  {
    for (int i = 0; i < 3; ++i)
    {
      third[{ t[i], t[(i + 1) % 3] }] = t[(i + 2) % 3];
    }
  }
  double most = 0.0;
  for (const auto& [edge, left] : third)
  {
    const auto place = [&](int vertex) -> Eigen::Vector3d { return part.vertices[vertex].cast<double>(); };
    const int right = third.at({ edge.second, edge.first });
    most = std::max(most, sagitta(place(edge.first), place(edge.second), place(left), place(right)));
  }
  EXPECT_LE(most, 0.1);
  EXPECT_GT(most, 0.02); // no finer than needed
}

TEST_P(CurvedParts, haveAMirrorPlane)
{
  const meam::TriangleMesh part = GetParam()();
  // The plane is z = 0 of what is bent along a path, y = 0 of what is turned about an axis.
  const auto mirrored = [&](int axis)
  {
    return std::all_of(part.vertices.begin(), part.vertices.end(),
      [&](Eigen::Vector3f v)
      {
        v[axis] = -v[axis];
        return std::any_of(part.vertices.begin(), part.vertices.end(),
          [&](const Eigen::Vector3f& other) { return (other - v).norm() < 1e-3f; });
      });
  };
  EXPECT_TRUE(mirrored(1) || mirrored(2));
  EXPECT_FALSE(mirrored(0));
}

INSTANTIATE_TEST_SUITE_P(All, CurvedParts, testing::Values(&meam::pipeElbow, &meam::cap, &meam::knob, &meam::handle));

TEST(PipeElbow, hasTheVolumeOfItsPipes)
{
  // By the middle line (Pappus): pipe, sockets, cones of 2 mm between them, bores and seats of 14 mm; no chamfers.
  const double bend = 0.5 * M_PI * 30.0;
  const double outside = 14 * 14 * (8 + bend + 8) + 18 * 18 * (18 + 24 - 4) + 4 * (18 * 18 + 18 * 14 + 14 * 14) / 3.0;
  const double inside = 11 * 11 * (8 + bend + 8 + 18 + 24 - 28) + 15 * 15 * 28;
  const double volume = M_PI * (outside - inside);
  EXPECT_NEAR(meam::prepareMesh(meam::pipeElbow()).report.volume, volume, 0.01 * volume);
}
