// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/preparation/MeshPreparation.h"
#include "base/Bounds.h"
#include "mesh/TriangleMesh.h"

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

TEST(MeshPreparation, seamIsSewn)
{
  // The two halves of a box were modelled apart: a gap far below anything that can be made.
  meam::TriangleMesh soup = boxSoup({ 0, 0, 0 }, { 1, 2, 2 });
  for (std::size_t v = 0; v < 18; ++v)
  {
    soup.vertices[v].x() += 1e-6f;
  }
  const auto [mesh, report] = meam::prepareMesh(soup);
  EXPECT_TRUE(report.closed);
  EXPECT_EQ(report.vertices, 8);
  EXPECT_GT(report.nearVertices, 0);
  EXPECT_EQ(report.mergedVertices + report.nearVertices, 28);
  EXPECT_NEAR(report.volume, 4.0, 1e-5);
}

TEST(MeshPreparation, gapsThatCanBeSeenStayOpen)
{
  meam::TriangleMesh soup = boxSoup({ 0, 0, 0 }, { 1, 2, 2 });
  for (std::size_t v = 0; v < 18; ++v)
  {
    soup.vertices[v].x() += 1e-3f;
  }
  EXPECT_FALSE(meam::prepareMesh(soup).report.closed);
}

TEST(MeshPreparation, needleStays)
{
  meam::TriangleMesh sheet;
  sheet.vertices = { { 0, 0, 0 }, { 100, 0, 0 }, { 0, 50, 0 }, { 50, -0.01f, 0 } };
  sheet.triangles = { { 0, 1, 2 }, { 0, 3, 1 } };
  const auto [mesh, report] = meam::prepareMesh(sheet);
  EXPECT_EQ(report.degenerateTriangles, 0);
  EXPECT_EQ(report.triangles, 2);
}

TEST(MeshPreparation, holesUpToTheLimitAreClosed)
{
  // A box of 1 x 2 x 2 without a square of 2 x 2 (border 8 mm) and without a triangle (2 + 2 + sqrt(8)).
  meam::TriangleMesh soup = boxSoup({ 0, 0, 0 }, { 1, 2, 2 });
  soup.triangles.erase(soup.triangles.begin() + 10, soup.triangles.end());
  soup.triangles.erase(soup.triangles.begin() + 8);
  meam::MeshPreparationSettings settings;
  const auto prepared = [&](double holeSize)
  {
    settings.holeSize = holeSize;
    return meam::prepareMesh(soup, settings).report;
  };
  EXPECT_EQ(prepared(0.0).closedHoles, 0);
  EXPECT_EQ(prepared(0.0).borderEdges, 7);
  EXPECT_EQ(prepared(6.8).closedHoles, 0);
  EXPECT_EQ(prepared(6.9).closedHoles, 1);
  EXPECT_EQ(prepared(6.9).borderEdges, 4);
  EXPECT_EQ(prepared(7.9).closedHoles, 1);
  const meam::MeshReport report = prepared(8.1);
  EXPECT_EQ(report.closedHoles, 2);
  EXPECT_TRUE(report.closed);
  EXPECT_DOUBLE_EQ(report.volume, 4.0);
}

TEST(MeshPreparation, borderOfASheetIsNoHole)
{
  // A frame: a square of 3 x 3 with a hole of 1 x 1 in its middle.
  meam::TriangleMesh frame;
  for (const float half : { 1.5f, 0.5f })
  {
    frame.vertices.insert(
      frame.vertices.end(), { { -half, -half, 0 }, { half, -half, 0 }, { half, half, 0 }, { -half, half, 0 } });
  }
  for (int i = 0; i < 4; ++i)
  {
    const int next = (i + 1) % 4;
    frame.triangles.emplace_back(i, next, 4 + next);
    frame.triangles.emplace_back(i, 4 + next, 4 + i);
  }
  meam::MeshPreparationSettings settings;
  settings.holeSize = 100.0;
  const auto [mesh, report] = meam::prepareMesh(frame, settings);
  EXPECT_EQ(report.closedHoles, 1);
  EXPECT_EQ(report.borderEdges, 4);
  EXPECT_DOUBLE_EQ(report.area, 9.0);
}

TEST(MeshPreparation, largestComponentByArea)
{
  // The smaller body has more triangles.
  meam::TriangleMesh soup = boxSoup({ 9, 0, 0 }, { 10, 1, 1 });
  append(soup, boxSoup({ 12, 0, 0 }, { 13, 1, 1 }));
  append(soup, boxSoup({ 0, 0, 0 }, { 3, 3, 3 }));
  meam::MeshPreparationSettings settings;
  EXPECT_EQ(meam::prepareMesh(soup, settings).report.components, 3);
  settings.keptComponents = meam::KeptComponents::Largest;
  const auto [mesh, report] = meam::prepareMesh(soup, settings);
  EXPECT_EQ(report.components, 1);
  EXPECT_EQ(report.droppedComponents, 2);
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_DOUBLE_EQ(report.volume, 27.0);
}

TEST(MeshPreparation, intersectingPairsAreCounted)
{
  // The second triangle goes through the first, the third touches none.
  meam::TriangleMesh mesh;
  mesh.vertices = { { 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, { 1, 1, -1 }, { 1, 1, 1 }, { 2, 0.5f, 1 }, { 9, 9, 9 },
    { 9, 8, 9 }, { 8, 9, 9 } };
  mesh.triangles = { { 0, 1, 2 }, { 3, 4, 5 }, { 6, 7, 8 } };
  EXPECT_EQ(meam::prepareMesh(mesh).report.intersections, 1);
  EXPECT_EQ(meam::prepareMesh(boxSoup({ 0, 0, 0 }, { 1, 1, 1 })).report.intersections, 0);
}

TEST(MeshPreparation, countingIntersectionsEnds)
{
  // 150 x 150 triangles that all cross each other.
  meam::TriangleMesh mesh;
  for (int i = 0; i < 150; ++i)
  {
    const float at = 0.1f * static_cast<float>(i);
    append(mesh, { { { at, -1, -20 }, { at, 20, 0 }, { at, -1, 20 } }, { { 0, 1, 2 } } });
    append(mesh, { { { -20, at, -1 }, { 20, at, -1 }, { 0, at, 40 } }, { { 0, 1, 2 } } });
  }
  EXPECT_EQ(meam::prepareMesh(mesh).report.intersections, meam::MostIntersections);
}

TEST(MeshPreparation, simplifiedAndRemade)
{
  meam::MeshPreparationSettings settings;
  settings.edgeLength = 0.5;
  const auto [fine, made] = meam::prepareMesh(boxSoup({ 0, 0, 0 }, { 2, 2, 2 }), settings);
  EXPECT_GT(made.triangles, 150);
  EXPECT_TRUE(made.closed);
  EXPECT_NEAR(made.volume, 8.0, 1e-5);
  settings.edgeLength = 0.0;
  settings.maximumError = 0.001;
  const auto [coarse, simplified] = meam::prepareMesh(fine, settings);
  EXPECT_EQ(simplified.triangles, 12);
  EXPECT_NEAR(simplified.volume, 8.0, 1e-5);
}

TEST(MeshPreparation, description)
{
  meam::TriangleMesh soup = boxSoup({ 0, 0, 0 }, { 1, 1, 1 });
  soup.triangles.emplace_back(soup.triangles[3]);
  soup.triangles.emplace_back(soup.triangles[4]);
  EXPECT_EQ(meam::describe(meam::prepareMesh(soup).report),
    "28 vertices merged with others at their place; 2 duplicate triangles removed; closed; "
    "1 component of 12 triangles");
  meam::MeshReport report;
  report.nearVertices = 1;
  report.degenerateTriangles = 1;
  report.droppedComponents = 1;
  report.closedHoles = 2;
  report.flippedComponents = 1;
  report.intersections = 4;
  report.borderEdges = 36;
  report.components = 2;
  report.triangles = 1;
  EXPECT_EQ(meam::describe(report),
    "1 vertex merged with one next to it; 1 triangle without area removed; 1 smaller component dropped; "
    "2 holes closed; 1 component faced inwards and was turned; 4 pairs of triangles intersect; "
    "open: 36 border edges; 2 components of 1 triangle");
  report.intersections = meam::MostIntersections;
  EXPECT_NE(meam::describe(report).find("at least 10000 pairs of triangles intersect"), std::string::npos);
}

TEST(MeshPreparation, inputStaysAsItIs)
{
  meam::TriangleMesh soup = boxSoup({ 0, 0, 0 }, { 1, 1, 1 });
  flip(soup, 3);
  const meam::TriangleMesh before = soup;
  meam::MeshPreparationSettings settings;
  settings.scale = 10.0;
  settings.maximumError = 0.1;
  settings.edgeLength = 5.0;
  meam::prepareMesh(soup, settings);
  EXPECT_EQ(soup.vertices, before.vertices);
  EXPECT_EQ(soup.triangles, before.triangles);
}

TEST(MeshPreparation, canBeStoppedAnywhere)
{
  const meam::TriangleMesh soup = boxSoup({ 0, 0, 0 }, { 1, 1, 1 });
  meam::MeshPreparationSettings settings;
  settings.holeSize = 1.0;
  settings.maximumError = 0.01;
  settings.edgeLength = 0.2;
  double last = 0.0;
  meam::prepareMesh(soup, settings,
    [&](double share)
    {
      EXPECT_GE(share, last);
      last = share;
      return true;
    });
  EXPECT_EQ(last, 1.0);
  for (const double stop : { 0.0, 0.2, 0.4, 0.6, 0.7, 0.8, 0.9, 1.0 })
  {
    EXPECT_THROW(meam::prepareMesh(soup, settings, [&](double share) { return share < stop; }), meam::Aborted);
  }
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
  for (double meam::MeshPreparationSettings::*length : { &meam::MeshPreparationSettings::holeSize,
         &meam::MeshPreparationSettings::maximumError, &meam::MeshPreparationSettings::edgeLength })
  {
    for (const double value : { -1.0, std::nan("") })
    {
      settings = {};
      settings.*length = value;
      EXPECT_THROW(meam::prepareMesh(mesh, settings), meam::Error);
    }
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
