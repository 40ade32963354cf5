// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/preparation/StrayComponents.h"

#include "TestFiles.h"
#include "TestParts.h"

namespace
{
/// A box whose faces share no vertices, only their places.
void addBox(meam::TriangleMesh& mesh, const Eigen::Vector3f& low, const Eigen::Vector3f& size)
{
  mesh = parts::joined(mesh, parts::soup(parts::box(low, low + size)));
}

/// A plane across the direction in which it has no size.
void addPlane(meam::TriangleMesh& mesh, const Eigen::Vector3f& low, const Eigen::Vector3f& u, const Eigen::Vector3f& v)
{
  mesh = parts::joined(mesh, { { low, low + u, low + u + v, low + v }, { { 0, 1, 2 }, { 0, 2, 3 } } });
}

meam::TriangleMesh strayPart() { return parts::soup(parts::box({ 0, 0, 0 }, { 50, 40, 20 })); }

std::vector<std::string> strayIn(const meam::TriangleMesh& mesh) { return meam::strayComponents(mesh, "mm"); }
}

TEST(StrayComponents, aTriangleFarOff)
{
  meam::TriangleMesh mesh = strayPart();
  const int first = static_cast<int>(mesh.vertices.size());
  mesh = parts::joined(mesh, { { { 1000, 0, 0 }, { 1002, 0, 0 }, { 1000, 1, 0 } }, { { 0, 1, 2 } } });
  const auto stray = strayIn(mesh);
  ASSERT_EQ(stray.size(), 1u);
  EXPECT_EQ(stray[0], "a component of 1 triangle, far off the rest, 2 x 1 x 0 large at (1001, 0.5, 0) in mm");
  EXPECT_EQ(meam::strayReport("a.stl", mesh, "mm"),
    "The CAD file 'a.stl' holds " + stray[0] + ": if it is not of the part, export the part without it.");
  mesh.vertices[first + 1] = mesh.vertices[first]; // without area
  EXPECT_TRUE(strayIn(mesh).empty());
  mesh.vertices[first].x() = NAN; // training refuses it
  EXPECT_EQ(meam::strayReport("a.stl", mesh, "mm"), "");
}

TEST(StrayComponents, planesOfConstruction)
{
  meam::TriangleMesh mesh = strayPart();
  addPlane(mesh, { -125, -130, 10 }, { 300, 0, 0 }, { 0, 300, 0 });
  auto stray = strayIn(mesh);
  ASSERT_EQ(stray.size(), 1u);
  EXPECT_EQ(stray[0],
    "a component of 2 triangles, a plane far larger than the rest, 300 x 300 x 0 large at (25, 20, 10) in mm");
  addPlane(mesh, { -125, 20, -140 }, { 300, 0, 0 }, { 0, 0, 300 }); // all three
  addPlane(mesh, { 25, -130, -140 }, { 0, 300, 0 }, { 0, 0, 300 });
  EXPECT_EQ(strayIn(mesh).size(), 3u);
}

TEST(StrayComponents, thoseBeyondThreeAreCounted)
{
  meam::TriangleMesh mesh = strayPart();
  for (const float x : { 200.0f, -200.0f, 400.0f, -400.0f, 1000.0f })
  {
    addBox(mesh, { x, 0, 0 }, { 1, 1, 1 });
  }
  const auto stray = strayIn(mesh);
  ASSERT_EQ(stray.size(), 4u);
  EXPECT_TRUE(files::contains(stray[0], "12 triangles, far off")) << stray[0];
  EXPECT_TRUE(files::contains(stray[3], "2 more")) << stray[3];
}

TEST(StrayComponents, whatIsNearIsOfThePart)
{
  meam::TriangleMesh mesh = strayPart();
  EXPECT_TRUE(strayIn(mesh).empty());
  addBox(mesh, { 70, 0, 0 }, { 5, 5, 5 });                       // beside it
  addBox(mesh, { 100, 0, 0 }, { 5, 5, 5 });                      // beside that
  addPlane(mesh, { -10, -10, 10 }, { 120, 0, 0 }, { 0, 30, 0 }); // not far larger
  EXPECT_TRUE(strayIn(mesh).empty());
  meam::TriangleMesh sheets;
  addPlane(sheets, { 0, 0, 0 }, { 300, 0, 0 }, { 0, 300, 0 });
  addPlane(sheets, { 0, 0, 1 }, { 10, 0, 0 }, { 0, 10, 0 }); // nothing but planes
  EXPECT_TRUE(strayIn(sheets).empty());
  EXPECT_TRUE(strayIn({}).empty());
}
