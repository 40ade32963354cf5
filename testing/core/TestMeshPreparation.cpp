// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/MeshPreparation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
/// A box from `low` to `high` as an STL reader gives it: no shared vertices. Outward.
meam::TriangleMesh boxSoup(const Eigen::Vector3f& low, const Eigen::Vector3f& high)
{
  const int corners[12][3] = { { 0, 2, 1 }, { 1, 2, 3 }, { 4, 5, 6 }, { 5, 7, 6 }, { 0, 1, 4 }, { 1, 5, 4 },
    { 2, 6, 3 }, { 3, 6, 7 }, { 0, 4, 2 }, { 2, 4, 6 }, { 1, 3, 5 }, { 3, 7, 5 } };
  meam::TriangleMesh mesh;
  for (const auto& triangle : corners)
  {
    for (const int i : triangle)
    {
      mesh.vertices.emplace_back(
        (i & 1) ? high.x() : low.x(), (i & 2) ? high.y() : low.y(), (i & 4) ? high.z() : low.z());
    }
    const int last = static_cast<int>(mesh.vertices.size());
    mesh.triangles.emplace_back(last - 3, last - 2, last - 1);
  }
  return mesh;
}

void flip(meam::TriangleMesh& mesh, std::size_t triangle)
{
  std::swap(mesh.triangles[triangle][1], mesh.triangles[triangle][2]);
}

void append(meam::TriangleMesh& mesh, const meam::TriangleMesh& other)
{
  const int first = static_cast<int>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& triangle : other.triangles)
  {
    mesh.triangles.push_back(triangle.array() + first);
  }
}

double volume(const meam::TriangleMesh& mesh)
{
  double sum = 0.0;
  for (const auto& t : mesh.triangles)
  {
    sum += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]])) / 6.0;
  }
  return sum;
}
}

TEST(MeshPreparation, boxOfLooseTriangles)
{
  const meam::TriangleMesh soup = boxSoup({ 0, 0, 0 }, { 1, 2, 2 });
  const auto [mesh, report] = meam::prepareMesh(soup);
  EXPECT_EQ(soup.vertices.size(), 36u);
  EXPECT_EQ(report.inputVertices, 36);
  EXPECT_EQ(report.inputTriangles, 12);
  EXPECT_EQ(report.vertices, 8);
  EXPECT_EQ(report.triangles, 12);
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_EQ(report.mergedVertices, 28);
  EXPECT_EQ(report.degenerateTriangles, 0);
  EXPECT_EQ(report.duplicateTriangles, 0);
  EXPECT_EQ(report.flippedComponents, 0);
  EXPECT_EQ(report.components, 1);
  EXPECT_EQ(report.borderEdges, 0);
  EXPECT_TRUE(report.closed);
  EXPECT_DOUBLE_EQ(report.volume, 4.0);
  EXPECT_DOUBLE_EQ(report.area, 16.0);
  EXPECT_DOUBLE_EQ(report.diameter, 3.0);
}

TEST(MeshPreparation, scaleThenOffset)
{
  meam::MeshPreparationSettings settings;
  settings.scale = 1000.0;
  settings.offset = { 1.0, -2.0, 3.0 };
  const auto [mesh, report] = meam::prepareMesh(boxSoup({ 0, 0, 0 }, { 1, 2, 2 }), settings);
  const Eigen::AlignedBox3f box = meam::bounds(mesh.vertices);
  EXPECT_EQ(box.min(), Eigen::Vector3f(1, -2, 3));
  EXPECT_EQ(box.max(), Eigen::Vector3f(1001, 1998, 2003));
  EXPECT_DOUBLE_EQ(report.diameter, 3000.0);
}

TEST(MeshPreparation, mixedWindingIsMadeOutward)
{
  meam::TriangleMesh soup = boxSoup({ 0, 0, 0 }, { 1, 1, 1 });
  for (std::size_t t : { 0, 1, 2, 3, 4, 5, 6, 9 })
  {
    flip(soup, t);
  }
  EXPECT_NEAR(volume(meam::prepareMesh(soup).mesh), 1.0, 1e-6);
}

TEST(MeshPreparation, insideOutIsTurned)
{
  meam::TriangleMesh soup = boxSoup({ 0, 0, 0 }, { 1, 1, 1 });
  for (std::size_t t = 0; t < 12; ++t)
  {
    flip(soup, t);
  }
  const auto [mesh, report] = meam::prepareMesh(soup);
  EXPECT_NEAR(volume(mesh), 1.0, 1e-6);
  EXPECT_EQ(report.flippedComponents, 1);
}

TEST(MeshPreparation, cavityStaysACavity)
{
  meam::TriangleMesh soup = boxSoup({ 0, 0, 0 }, { 3, 3, 3 });
  append(soup, boxSoup({ 1, 1, 1 }, { 2, 2, 2 }));
  const auto [mesh, report] = meam::prepareMesh(soup);
  EXPECT_EQ(report.components, 2);
  EXPECT_EQ(report.flippedComponents, 1);
  EXPECT_DOUBLE_EQ(report.volume, 26.0);
}

TEST(MeshPreparation, overlappingBodiesBothFaceOutward)
{
  meam::TriangleMesh soup = boxSoup({ 0, 0, 0 }, { 3, 3, 3 });
  append(soup, boxSoup({ 1, 1, 1 }, { 2, 2, 4 }));
  for (std::size_t t = 12; t < 24; ++t)
  {
    flip(soup, t);
  }
  const auto [mesh, report] = meam::prepareMesh(soup);
  EXPECT_EQ(report.flippedComponents, 1);
  EXPECT_NEAR(volume(mesh), 30.0, 1e-5);
}

TEST(MeshPreparation, openBoxFacesOutwardToo)
{
  meam::TriangleMesh soup = boxSoup({ 0, 0, 0 }, { 1, 1, 1 });
  for (std::size_t t = 0; t < 12; ++t)
  {
    flip(soup, t);
  }
  soup.triangles.pop_back();
  const auto [mesh, report] = meam::prepareMesh(soup);
  EXPECT_FALSE(report.closed);
  EXPECT_EQ(report.borderEdges, 3);
  EXPECT_EQ(report.volume, 0.0);
  EXPECT_EQ(report.flippedComponents, 1);
}

TEST(MeshPreparation, loosePatchesOfOneBodyKeepTheirSides)
{
  // A tube, square inside and outside, without its ends: the inner wall faces the axis.
  meam::TriangleMesh tube = boxSoup({ -2, -2, 0 }, { 2, 2, 9 });
  tube.triangles.erase(tube.triangles.begin(), tube.triangles.begin() + 4);
  meam::TriangleMesh inner = boxSoup({ -1, -1, 0 }, { 1, 1, 9 });
  inner.triangles.erase(inner.triangles.begin(), inner.triangles.begin() + 4);
  for (std::size_t t = 0; t < 8; ++t)
  {
    flip(inner, t);
  }
  append(tube, inner);
  for (const int turned : { 0, 2 })
  {
    const auto [mesh, report] = meam::prepareMesh(tube);
    EXPECT_EQ(report.components, 2);
    EXPECT_EQ(report.flippedComponents, turned);
    EXPECT_NEAR(volume(mesh), (16 - 4) * 9 * 2 / 3.0, 1e-4);
    for (std::size_t t = 0; t < 16; ++t)
    {
      flip(tube, t);
    }
  }
}

TEST(MeshPreparation, flatSheetKeepsItsWinding)
{
  meam::TriangleMesh sheet;
  sheet.vertices = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
  sheet.triangles = { { 0, 2, 1 }, { 0, 3, 2 } };
  const auto [mesh, report] = meam::prepareMesh(sheet);
  EXPECT_EQ(report.flippedComponents, 0);
  EXPECT_EQ(report.borderEdges, 4);
  for (const auto& t : mesh.triangles)
  {
    EXPECT_LT((mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]).z(), 0.0f);
  }
}

TEST(MeshPreparation, duplicateAndDegenerateTrianglesAndLooseVerticesGo)
{
  meam::TriangleMesh soup = boxSoup({ 0, 0, 0 }, { 1, 1, 1 });
  soup.triangles.emplace_back(soup.triangles[3]);
  soup.triangles.emplace_back(soup.triangles[4].reverse()); // the same one, wound the other way
  soup.triangles.emplace_back(0, 0, 1);
  soup.vertices.emplace_back(9, 9, 9);
  const auto [mesh, report] = meam::prepareMesh(soup);
  EXPECT_EQ(report.duplicateTriangles, 2);
  EXPECT_EQ(report.degenerateTriangles, 1);
  EXPECT_EQ(report.isolatedVertices, 1);
  EXPECT_EQ(report.vertices, 8);
  EXPECT_EQ(report.triangles, 12);
  EXPECT_TRUE(report.closed);
}

TEST(MeshPreparation, triangleOnALineIsRemovedWithoutAHole)
{
  // A tetrahedron; edge 0-1 has a vertex 4 in its middle on one side only, closed by the flat
  // 0-4-1.
  meam::TriangleMesh soup;
  soup.vertices = { { 0, 0, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, { 0, 0, 2 }, { 1, 0, 0 } };
  soup.triangles = { { 0, 2, 1 }, { 0, 3, 2 }, { 1, 2, 3 }, { 0, 4, 3 }, { 4, 1, 3 }, { 0, 1, 4 } };
  const auto [mesh, report] = meam::prepareMesh(soup);
  EXPECT_EQ(report.degenerateTriangles, 1);
  EXPECT_TRUE(report.closed);
  EXPECT_NEAR(report.volume, 8.0 / 6.0, 1e-12);
}

TEST(MeshPreparation, triangleOnALineAtTheBorderIsDropped)
{
  meam::TriangleMesh sheet;
  sheet.vertices = { { 0, 0, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, { 1, 0, 0 }, { 7, 7, 7 }, { 8, 8, 8 }, { 9, 9, 9 } };
  sheet.triangles = { { 0, 3, 1 }, { 0, 1, 2 }, { 4, 5, 6 } };
  const auto [mesh, report] = meam::prepareMesh(sheet);
  EXPECT_EQ(report.degenerateTriangles, 2);
  EXPECT_EQ(report.triangles, 1);
  EXPECT_EQ(report.vertices, 3);
}

TEST(MeshPreparation, threeFacesAtAnEdgeAreAccepted)
{
  meam::TriangleMesh fan;
  fan.vertices = { { 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, { -1, -1, 0 } };
  fan.triangles = { { 0, 1, 2 }, { 0, 1, 3 }, { 0, 1, 4 } };
  EXPECT_EQ(meam::prepareMesh(fan).report.triangles, 3);
}

TEST(MeshPreparation, badInput)
{
  EXPECT_THROW(meam::prepareMesh({}), meam::Error);
  meam::TriangleMesh mesh = boxSoup({ 0, 0, 0 }, { 1, 1, 1 });
  meam::MeshPreparationSettings settings;
  for (const double scale : { 0.0, -1.0, std::nan("") })
  {
    settings.scale = scale;
    EXPECT_THROW(meam::prepareMesh(mesh, settings), meam::Error);
  }
  mesh.triangles.emplace_back(0, 1, 36);
  EXPECT_THROW(meam::prepareMesh(mesh), meam::Error);
  mesh.triangles.back()[2] = -1;
  EXPECT_THROW(meam::prepareMesh(mesh), meam::Error);
  mesh.triangles = { { 0, 0, 0 }, { 0, 1, 0 } };
  EXPECT_THROW(meam::prepareMesh(mesh), meam::Error);
  mesh = boxSoup({ 0, 0, 0 }, { 1, 1, 1 });
  mesh.vertices[5].y() = std::nanf("");
  EXPECT_THROW(meam::prepareMesh(mesh), meam::Error);
  EXPECT_THROW(meam::prepareMesh(boxSoup({ 0, 0, 0 }, { 1, 1, 1 }), {}, [](double) { return false; }), meam::Aborted);
}
