// SPDX-License-Identifier: BSD-3-Clause
#include "TestParts.h"
#include "mesh/SurfaceSampling.h"
#include "mesh/TriangleMesh.h"

#include <cmath>
#include <limits>

TEST(SurfaceSampling, keepsTheSpacingAndCoversTheSurface)
{
  const meam::PointCloud samples = meam::sampleSurface(parts::rectangle(20, 10), { 0.5, 1 });
  // Random packings of discs cover 0.547 of the plane: 0.70 discs for each square of one spacing.
  EXPECT_NEAR(samples.size(), 0.68 * 200 / 0.25, 40);
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    EXPECT_EQ(samples.pointIds[i], static_cast<int>(i));
    EXPECT_EQ(samples.normals[i], Eigen::Vector3f(0, 0, 1));
    for (std::size_t j = 0; j < i; ++j)
    {
      ASSERT_GE((samples.points[i] - samples.points[j]).norm(), 0.4999f);
    }
  }
  for (float x = 0.0f; x <= 20.0f; x += 0.25f)
  {
    for (float y = 0.0f; y <= 10.0f; y += 0.25f)
    {
      float nearest = std::numeric_limits<float>::max();
      for (const auto& point : samples.points)
      {
        nearest = std::min(nearest, (point - Eigen::Vector3f(x, y, 0)).norm());
      }
      ASSERT_LT(nearest, 1.4f * 0.5f) << x << " " << y;
    }
  }
}

TEST(SurfaceSampling, sizeOfTrianglesDoesNotMatter)
{
  meam::TriangleMesh mesh = parts::rectangle(10, 10);
  // The same square, with one triangle a thousand times smaller than the others.
  mesh.vertices.emplace_back(9.99f, 5.0f, 0.0f);
  mesh.triangles = { { 0, 1, 4 }, { 1, 2, 4 }, { 2, 3, 4 }, { 3, 0, 4 } };
  const meam::PointCloud samples = meam::sampleSurface(mesh, { 0.5, 1 });
  EXPECT_NEAR(samples.size(), 0.68 * 100 / 0.25, 30);
}

TEST(SurfaceSampling, bothSidesOfAThinPlateAndItsRimAreSampled)
{
  const meam::PointCloud samples = meam::sampleSurface(parts::box({ 0, 0, 0 }, { 20, 20, 0.2f }), { 1.0, 1 });
  int top = 0, bottom = 0, rim = 0;
  for (const auto& normal : samples.normals)
  {
    top += normal.z() > 0.5f;
    bottom += normal.z() < -0.5f;
    rim += std::abs(normal.z()) < 0.5f;
  }
  EXPECT_NEAR(top, 0.69 * 400, 25);
  EXPECT_NEAR(bottom, 0.69 * 400, 25);
  // 80 mm of rim; random packing on a line covers 0.75 of it.
  EXPECT_NEAR(rim, 0.75 * 80, 10);
}

TEST(SurfaceSampling, normalsPointOutOfABox)
{
  const meam::PointCloud samples = meam::sampleSurface(parts::box({ 0, 0, 0 }, { 4, 5, 6 }));
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    const Eigen::Vector3f fromMiddle =
      (samples.points[i] - Eigen::Vector3f(2, 2.5f, 3)).array() / Eigen::Array3f(2, 2.5f, 3);
    ASSERT_NEAR(samples.normals[i].dot(fromMiddle), 1.0f, 1e-5f);
  }
}

TEST(SurfaceSampling, automaticSpacingIsOnePercentOfTheDiameter)
{
  // Diagonal 5: spacing 0.05.
  EXPECT_EQ(meam::sampleSurface(parts::rectangle(4, 3)).points,
    meam::sampleSurface(parts::rectangle(4, 3), { 0.05, 1 }).points);
}

TEST(SurfaceSampling, theSeedDecides)
{
  const meam::PointCloud one = meam::sampleSurface(parts::rectangle(10, 10), { 1.0, 1 });
  EXPECT_EQ(one.points, meam::sampleSurface(parts::rectangle(10, 10), { 1.0, 1 }).points);
  EXPECT_NE(one.points, meam::sampleSurface(parts::rectangle(10, 10), { 1.0, 2 }).points);
}

TEST(SurfaceSampling, badInput)
{
  for (const meam::TriangleMesh& mesh : { meam::TriangleMesh(), parts::rectangle(0, 10), parts::rectangle(NAN, 10),
         meam::TriangleMesh{ parts::rectangle(10, 10).vertices, { { 0, 1, 4 } } } })
  {
    EXPECT_THROW(meam::sampleSurface(mesh), meam::Error);
  }
  for (const double spacing : { -1.0, std::nan(""), 1e-6 })
  {
    EXPECT_THROW(parts::sampled(parts::rectangle(10, 10), spacing), meam::Error) << spacing;
  }
  EXPECT_THROW(meam::sampleSurface(parts::rectangle(10, 10), { 0.1, 1 }, [](double) { return false; }), meam::Aborted);
}
