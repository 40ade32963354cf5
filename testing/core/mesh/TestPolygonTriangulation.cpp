// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/PolygonTriangulation.h"

#include "TestFiles.h"
#include "base/sequences/Sequences.h"

#include <cmath>

namespace
{
/// The triangles' areas along z, and whether all go the same way around.
struct Cut
{
  double area = 0.0;
  bool goesOneWay = true;
  std::size_t triangles = 0;
};

Cut cut(const meam::Points& outline, std::size_t first = 0)
{
  meam::TriangleMesh mesh;
  mesh.vertices = outline;
  const auto corners =
    meam::ofIndices<int>(outline.size(), [&](int k) { return static_cast<int>((first + k) % outline.size()); });
  meam::addPolygon(corners, mesh);
  Cut result;
  for (const Eigen::Vector3i& t : mesh.triangles)
  {
    const Eigen::Vector3f a = outline[t[0]], b = outline[t[1]], c = outline[t[2]];
    const double area = 0.5 * (b - a).cross(c - a).z();
    result.area += area;
    result.goesOneWay = result.goesOneWay && area >= 0.0;
  }
  result.triangles = mesh.triangles.size();
  return result;
}
}

TEST(PolygonTriangulation, aConcaveFaceIsCutInsideItWhereverItBegins)
{
  // A U of 3 x 3 with a slot of 1 x 2.
  const meam::Points u{ { 0, 0, 0 }, { 3, 0, 0 }, { 3, 3, 0 }, { 2, 3, 0 }, { 2, 1, 0 }, { 1, 1, 0 }, { 1, 3, 0 },
    { 0, 3, 0 } };
  for (std::size_t first = 0; first < u.size(); ++first)
  {
    const Cut found = cut(u, first);
    EXPECT_NEAR(found.area, 7.0, 1e-6) << first;
    EXPECT_TRUE(found.goesOneWay) << first;
    EXPECT_EQ(found.triangles, u.size() - 2) << first;
  }
}

TEST(PolygonTriangulation, aFaceWithAHoleThatASlitLeadsTo)
{
  const meam::Points frame{ { 0, 0, 0 }, { 4, 0, 0 }, { 4, 4, 0 }, { 0, 4, 0 }, { 0, 0, 0 }, { 1, 1, 0 }, { 1, 3, 0 },
    { 3, 3, 0 }, { 3, 1, 0 }, { 1, 1, 0 } };
  const Cut found = cut(frame);
  EXPECT_NEAR(found.area, 12.0, 1e-6);
  EXPECT_TRUE(found.goesOneWay);
}

TEST(PolygonTriangulation, aStarOfManyCornersInAnyPlane)
{
  constexpr int count = 400;
  meam::Points star;
  double area = 0.0;
  for (int k = 0; k < count; ++k)
  {
    const double radius = k % 2 ? 1.0 : 2.0, angle = 2.0 * M_PI * k / count;
    star.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.3 * radius * std::cos(angle));
  }
  for (int k = 0; k < count; ++k)
  {
    const Eigen::Vector3f &a = star[k], &b = star[(k + 1) % count];
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  const Cut found = cut(star);
  EXPECT_NEAR(found.area, area, 1e-5);
  EXPECT_TRUE(found.goesOneWay);
}

TEST(PolygonTriangulation, convexFacesAreCutAboutTheirFirstCorner)
{
  meam::TriangleMesh mesh;
  mesh.vertices = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
  meam::addPolygon({ 2, 3, 0, 1 }, mesh);
  meam::addPolygon({ 0, 1 }, mesh);
  EXPECT_EQ(mesh.triangles, (std::vector<Eigen::Vector3i>{ { 2, 3, 0 }, { 2, 0, 1 } }));
}

TEST(PolygonTriangulation, facesOfFourCornersInNoPlaneAreCutWhereTheyFoldTheLeast)
{
  meam::TriangleMesh mesh;
  mesh.vertices = { { 0, 0, 0 }, { 2, 0, 1 }, { 2, 3, 0 }, { 0, 2, 0.1f }, { 2, 0, 0.01f } };
  meam::addPolygon({ 0, 1, 2, 3 }, mesh);
  meam::addPolygon({ 1, 2, 3, 0 }, mesh);
  EXPECT_EQ(mesh.triangles, (std::vector<Eigen::Vector3i>{ { 0, 1, 3 }, { 1, 2, 3 }, { 1, 2, 3 }, { 1, 3, 0 } }));
  mesh.triangles.clear();
  meam::addPolygon({ 0, 4, 2, 3 }, mesh); // a plane whose corners are rounded
  EXPECT_EQ(mesh.triangles, (std::vector<Eigen::Vector3i>{ { 0, 4, 2 }, { 0, 2, 3 } }));
}

TEST(PolygonTriangulation, whatHasNoEarsIsStillCut)
{
  EXPECT_EQ(cut({ { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 }, { 3, 0, 0 }, { 4, 0, 0 } }).triangles, 3u); // on a line
  EXPECT_EQ(cut({ { 0, 0, 0 }, { 1, 1, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }).triangles, 2u);              // crosses itself
  meam::TriangleMesh mesh;
  mesh.vertices.resize(1, Eigen::Vector3f::Zero());
  EXPECT_TRUE(files::contains(
    files::errorOf([&] { meam::addPolygon(std::vector<int>(meam::MostCorners + 1, 0), mesh); }), "5001 corners"));
}
