// SPDX-License-Identifier: BSD-3-Clause
#include "TestParts.h"
#include "TestScale.h"
#include "base/Bounds.h"
#include "mesh/TriangleMesh.h"
#include "mesh/preparation/MeshDistance.h"
#include "mesh/preparation/MeshSimplification.h"

namespace
{
/// A sheet of n x n squares of 1 mm, without the squares for which `missing` holds.
template <typename Missing>
meam::TriangleMesh sheet(int n, Missing&& missing)
{
  meam::TriangleMesh mesh;
  for (int y = 0; y <= n; ++y)
  {
    for (int x = 0; x <= n; ++x)
    {
      mesh.vertices.emplace_back(x, y, 0);
    }
  }
  for (int y = 0; y < n; ++y)
  {
    for (int x = 0; x < n; ++x)
    {
      const int a = y * (n + 1) + x;
      if (!missing(x, y))
      {
        mesh.triangles.emplace_back(a, a + 1, a + n + 2);
        mesh.triangles.emplace_back(a, a + n + 2, a + n + 1);
      }
    }
  }
  return mesh;
}

}

TEST(MeshSimplification, fineBoxGoesToTwelveTriangles)
{
  const meam::TriangleMesh coarse = parts::box({ 0, 0, 0 }, { 16, 32, 64 });
  const meam::TriangleMesh fine = parts::divided(coarse, 4);
  ASSERT_EQ(fine.triangles.size(), 3072u);
  const meam::TriangleMesh result = meam::simplifyMesh(fine, 0.01);
  EXPECT_EQ(result.triangles.size(), 12u);
  EXPECT_EQ(result.vertices.size(), 8u);
  EXPECT_NEAR(parts::area(result), parts::area(coarse), 1e-3);
}

TEST(MeshSimplification, boundHoldsOnASphere)
{
  const meam::TriangleMesh fine = parts::sphere(50, SmallData ? 4 : 5);
  ASSERT_EQ(fine.triangles.size(), SmallData ? 2048u : 8192u);
  const double sagitta = SmallData ? 0.2 : 0.05; // of the fine mesh itself
  std::size_t before = fine.triangles.size();
  for (const double bound : { SmallData ? 0.5 : 0.2, 1.0, 5.0 })
  {
    const meam::TriangleMesh result = meam::simplifyMesh(fine, bound);
    EXPECT_LT(result.triangles.size(), before);
    before = result.triangles.size();
    EXPECT_LE(meam::meshDistance(fine, result), bound);
    // And told without that function: a triangle is nearest to the centre inside or at its middle.
    for (const auto& t : result.triangles)
    {
      const Eigen::Vector3f middle = (result.vertices[t[0]] + result.vertices[t[1]] + result.vertices[t[2]]) / 3.0f;
      EXPECT_GE(middle.norm(), 50.0 - bound - sagitta);
    }
  }
  EXPECT_LT(before, 300u);
}

TEST(MeshSimplification, smallBoundKeepsTheMesh)
{
  const meam::TriangleMesh fine = parts::sphere(50, SmallData ? 4 : 5);
  EXPECT_EQ(meam::simplifyMesh(fine, 1e-4).triangles.size(), fine.triangles.size());
}

TEST(MeshSimplification, edgesStaySharp)
{
  const meam::TriangleMesh result = meam::simplifyMesh(parts::divided(parts::lBracket(), 3), 0.5);
  EXPECT_EQ(result.vertices.size(), 12u);
  EXPECT_EQ(result.triangles.size(), 20u);
  EXPECT_NEAR(parts::area(result), parts::area(parts::lBracket()), 1e-2);
}

TEST(MeshSimplification, notchesAndHolesOfASheetStay)
{
  // A notch of 4 x 2 mm in the border and a hole of 3 x 3: filling either would move no point off the plane.
  const meam::TriangleMesh fine =
    sheet(12, [](int x, int y) { return (x >= 4 && x < 8 && y < 2) || (x >= 5 && x < 8 && y >= 6 && y < 9); });
  const meam::TriangleMesh result = meam::simplifyMesh(fine, 0.5);
  EXPECT_NEAR(parts::area(result), 144.0 - 8.0 - 9.0, 1e-4);
  EXPECT_LT(result.triangles.size(), 20u);
  EXPECT_LE(meam::meshDistance(fine, result), 1e-5);
}

TEST(MeshSimplification, thinSpikeStays)
{
  // 10 mm high and 0.2 mm wide, within the bound of all of its own planes.
  const meam::TriangleMesh spike = parts::divided(parts::prism({ { -5, 0 }, { 5, -0.1f }, { 5, 0.1f } }, 0.2f), 2);
  const meam::TriangleMesh result = meam::simplifyMesh(spike, 0.5);
  EXPECT_LE(meam::meshDistance(spike, result), 0.5);
  EXPECT_GT(meam::bounds(result.vertices).sizes().x(), 9.0f);
}

TEST(MeshSimplification, sameResultAgain)
{
  const meam::TriangleMesh fine = parts::sphere(50, SmallData ? 4 : 5);
  const meam::TriangleMesh first = meam::simplifyMesh(fine, 1.0);
  const meam::TriangleMesh second = meam::simplifyMesh(fine, 1.0);
  EXPECT_EQ(first.vertices, second.vertices);
  EXPECT_EQ(first.triangles, second.triangles);
}

TEST(MeshSimplification, badInput)
{
  const meam::TriangleMesh box = parts::box({ 0, 0, 0 }, { 1, 1, 1 });
  for (const double bound : { 0.0, -1.0, std::nan("") })
  {
    EXPECT_THROW(meam::simplifyMesh(box, bound), meam::Error);
  }
  EXPECT_THROW(meam::simplifyMesh({}, 1.0), meam::Error);
  EXPECT_THROW(meam::simplifyMesh(box, 1.0, [](double) { return false; }), meam::Aborted);
}

TEST(MeshDistance, exact)
{
  const meam::TriangleMesh box = parts::box({ 0, 0, 0 }, { 2, 2, 2 });
  EXPECT_EQ(meam::meshDistance(box, box), 0.0);
  EXPECT_NEAR(meam::meshDistance(box, parts::box({ 0, 0, 0 }, { 2, 2, 2.5f })), 0.5, 1e-6);
  EXPECT_NEAR(meam::meshDistance(parts::box({ -1, 0, 0 }, { 2, 2, 2 }), box), 1.0, 1e-6);
  // The middle of the square is 1 mm from the pyramid's sides and its corners are on both.
  const meam::TriangleMesh flat = sheet(1, [](int, int) { return false; });
  meam::TriangleMesh peak = flat;
  peak.vertices.emplace_back(0.5f, 0.5f, 3);
  peak.triangles = { { 0, 1, 4 }, { 1, 3, 4 }, { 3, 2, 4 }, { 2, 0, 4 } };
  EXPECT_NEAR(meam::meshDistance(flat, peak), 3.0, 1e-6);
  EXPECT_NEAR(meam::meshDistance(peak, flat), 3.0, 1e-6);
}
