// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/preparation/MeshPreparation.h"
#include "TestParts.h"
#include "TestSteps.h"
#include "mesh/MeshEdges.h"
#include "base/Bounds.h"
#include "mesh/TriangleMesh.h"

#include <cmath>

namespace
{
/// A box from `low` to `high` as an STL reader gives it; `turned` triangles face inwards.
meam::TriangleMesh boxSoup(
  const Eigen::Vector3f& low, const Eigen::Vector3f& high, const std::vector<std::size_t>& turned = {})
{
  meam::TriangleMesh soup = parts::soup(parts::box(low, high));
  for (const std::size_t t : turned)
  {
    std::swap(soup.triangles[t][1], soup.triangles[t][2]);
  }
  return soup;
}

const std::vector<std::size_t> All{ 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11 };

meam::TriangleMesh unitBox(const std::vector<std::size_t>& turned = {})
{
  return boxSoup({ 0, 0, 0 }, { 1, 1, 1 }, turned);
}

/// Of 3 x 3 x 3 mm, and another body.
meam::TriangleMesh largeBoxAnd(const meam::TriangleMesh& other)
{
  return parts::joined(boxSoup({ 0, 0, 0 }, { 3, 3, 3 }), other);
}
}

TEST(MeshPreparation, boxOfLooseTriangles)
{
  const auto [mesh, report] = meam::prepareMesh(boxSoup({ 0, 0, 0 }, { 1, 2, 2 }));
  EXPECT_EQ(report.inputVertices, 36);
  EXPECT_EQ(report.inputTriangles, 12);
  EXPECT_EQ(report.vertices, 8);
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_EQ(
    meam::describe(report), "28 vertices merged with others at their place; closed; 1 component of 12 triangles");
  EXPECT_EQ(report.borderEdges, 0);
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

TEST(MeshPreparation, whatFacesInwardsIsTurned)
{
  const struct
  {
    const char* name;
    meam::TriangleMesh soup;
    int components, turned;
    double volume;
  } cases[] = { { "mixed winding", unitBox({ 0, 1, 2, 3, 4, 5, 6, 9 }), 1, 1, 1.0 },
    { "inside out", unitBox(All), 1, 1, 1.0 },
    { "a cavity stays one", largeBoxAnd(boxSoup({ 1, 1, 1 }, { 2, 2, 2 })), 2, 1, 26.0 },
    { "overlapping bodies", largeBoxAnd(boxSoup({ 1, 1, 1 }, { 2, 2, 4 }, All)), 2, 1, 30.0 } };
  for (const auto& [name, soup, components, turned, volume] : cases)
  {
    SCOPED_TRACE(name);
    const auto [mesh, report] = meam::prepareMesh(soup);
    EXPECT_EQ(report.components, components);
    EXPECT_EQ(report.flippedComponents, turned);
    EXPECT_NEAR(parts::volume(mesh), volume, 1e-6);
    EXPECT_DOUBLE_EQ(report.volume, volume);
  }
}

TEST(MeshPreparation, openBoxFacesOutwardToo)
{
  meam::TriangleMesh soup = unitBox(All);
  soup.triangles.pop_back();
  const meam::MeshReport report = meam::prepareMesh(soup).report;
  EXPECT_FALSE(report.closed);
  EXPECT_EQ(report.borderEdges, 3);
  EXPECT_EQ(report.volume, 0.0);
  EXPECT_EQ(report.flippedComponents, 1);
}

TEST(MeshPreparation, loosePatchesOfOneBodyKeepTheirSides)
{
  // A tube, square inside and outside, without its ends: the inner wall faces the axis, or the outer one inwards.
  for (const bool turned : { false, true })
  {
    const std::vector<std::size_t> none;
    meam::TriangleMesh tube = boxSoup({ -2, -2, 0 }, { 2, 2, 9 }, turned ? All : none);
    meam::TriangleMesh inner = boxSoup({ -1, -1, 0 }, { 1, 1, 9 }, turned ? none : All);
    for (meam::TriangleMesh* wall : { &tube, &inner })
    {
      wall->triangles.erase(wall->triangles.begin(), wall->triangles.begin() + 4);
    }
    const auto [mesh, report] = meam::prepareMesh(parts::joined(tube, inner));
    EXPECT_EQ(report.components, 2);
    EXPECT_EQ(report.flippedComponents, turned ? 2 : 0);
    EXPECT_NEAR(parts::volume(mesh), (16 - 4) * 9 * 2 / 3.0, 1e-4);
  }
}

TEST(MeshPreparation, flatSheetKeepsItsWinding)
{
  meam::TriangleMesh sheet = parts::rectangle(1, 1);
  sheet.triangles = { { 0, 2, 1 }, { 0, 3, 2 } };
  const auto [mesh, report] = meam::prepareMesh(sheet);
  EXPECT_EQ(report.flippedComponents, 0);
  EXPECT_EQ(report.borderEdges, 4);
  EXPECT_EQ(meam::faceNormals(mesh, meam::edgesOf(mesh)), meam::Points(2, -Eigen::Vector3f::UnitZ()));
}

TEST(MeshPreparation, duplicateAndDegenerateTrianglesAndLooseVerticesGo)
{
  meam::TriangleMesh soup = unitBox();
  soup.triangles.emplace_back(soup.triangles[3]);
  soup.triangles.emplace_back(soup.triangles[4].reverse()); // the same one, wound the other way
  soup.triangles.emplace_back(0, 0, 1);
  soup.vertices.emplace_back(9, 9, 9);
  const meam::MeshReport report = meam::prepareMesh(soup).report;
  EXPECT_EQ(report.duplicateTriangles, 2);
  EXPECT_EQ(report.degenerateTriangles, 1);
  EXPECT_EQ(report.isolatedVertices, 1);
  EXPECT_EQ(report.vertices, 8);
  EXPECT_EQ(report.triangles, 12);
  EXPECT_TRUE(report.closed);
}

TEST(MeshPreparation, trianglesOnALineAreRemovedWithoutAHole)
{
  const struct
  {
    const char* name;
    meam::TriangleMesh mesh;
    int degenerate, triangles, vertices;
    double volume;
  } cases[] = { { "a tetrahedron with a vertex in the middle of an edge on one side only, closed by a flat triangle",
                  { { { 0, 0, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, { 0, 0, 2 }, { 1, 0, 0 } },
                    { { 0, 2, 1 }, { 0, 3, 2 }, { 1, 2, 3 }, { 0, 4, 3 }, { 4, 1, 3 }, { 0, 1, 4 } } },
                  1, 6, 5, 8.0 / 6.0 },
    { "at a border it is dropped",
      { { { 0, 0, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, { 1, 0, 0 }, { 7, 7, 7 }, { 8, 8, 8 }, { 9, 9, 9 } },
        { { 0, 3, 1 }, { 0, 1, 2 }, { 4, 5, 6 } } },
      2, 1, 3, 0.0 },
    { "a needle stays",
      { { { 0, 0, 0 }, { 100, 0, 0 }, { 0, 50, 0 }, { 50, -0.01f, 0 } }, { { 0, 1, 2 }, { 0, 3, 1 } } }, 0, 2, 4, 0.0 },
    { "three faces at an edge stay",
      { { { 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, { -1, -1, 0 } },
        { { 0, 1, 2 }, { 0, 1, 3 }, { 0, 1, 4 } } },
      0, 3, 9, 0.0 } };
  for (const auto& [name, given, degenerate, triangles, vertices, volume] : cases)
  {
    SCOPED_TRACE(name);
    const meam::MeshReport report = meam::prepareMesh(given).report;
    EXPECT_EQ(report.degenerateTriangles, degenerate);
    EXPECT_EQ(report.triangles, triangles);
    EXPECT_EQ(report.vertices, vertices);
    EXPECT_EQ(report.closed, volume > 0.0);
    EXPECT_NEAR(report.volume, volume, 1e-12);
  }
}

TEST(MeshPreparation, aSeamIsSewnAndAGapThatCanBeSeenStaysOpen)
{
  // The two halves of a box were modelled apart: a gap far below anything that can be made.
  for (const float gap : { 1e-6f, 1e-3f })
  {
    meam::TriangleMesh soup = boxSoup({ 0, 0, 0 }, { 1, 2, 2 });
    for (std::size_t v = 0; v < 18; ++v)
    {
      soup.vertices[v].x() += gap;
    }
    const meam::MeshReport report = meam::prepareMesh(soup).report;
    ASSERT_EQ(report.closed, gap < 1e-5f);
    if (report.closed)
    {
      EXPECT_EQ(report.vertices, 8);
      EXPECT_GT(report.nearVertices, 0);
      EXPECT_EQ(report.mergedVertices + report.nearVertices, 28);
      EXPECT_NEAR(report.volume, 4.0, 1e-5);
    }
  }
}

TEST(MeshPreparation, holesUpToTheLimitAreClosed)
{
  // A box of 1 x 2 x 2 without a square of 2 x 2 (border 8 mm) and without a triangle (2 + 2 + sqrt(8)).
  meam::TriangleMesh soup = boxSoup({ 0, 0, 0 }, { 1, 2, 2 });
  soup.triangles.erase(soup.triangles.begin() + 10, soup.triangles.end());
  soup.triangles.erase(soup.triangles.begin() + 8);
  const struct
  {
    double limit;
    int closed, border;
  } cases[] = { { 0.0, 0, 7 }, { 6.8, 0, 7 }, { 6.9, 1, 4 }, { 7.9, 1, 4 }, { 8.1, 2, 0 } };
  for (const auto& [limit, closed, border] : cases)
  {
    meam::MeshPreparationSettings settings;
    settings.holeSize = limit;
    const meam::MeshReport report = meam::prepareMesh(soup, settings).report;
    EXPECT_EQ(report.closedHoles, closed) << limit;
    EXPECT_EQ(report.borderEdges, border) << limit;
    EXPECT_EQ(report.closed, border == 0) << limit;
    EXPECT_DOUBLE_EQ(report.volume, border == 0 ? 4.0 : 0.0) << limit;
  }
}

TEST(MeshPreparation, borderOfASheetIsNoHole)
{
  meam::MeshPreparationSettings settings;
  settings.holeSize = 100.0;
  const meam::MeshReport report = meam::prepareMesh(parts::frame(1.5f, 0.5f), settings).report;
  EXPECT_EQ(report.closedHoles, 1);
  EXPECT_EQ(report.borderEdges, 4);
  EXPECT_DOUBLE_EQ(report.area, 9.0);
}

TEST(MeshPreparation, largestComponentByArea)
{
  // The smaller bodies have more triangles.
  const meam::TriangleMesh soup =
    parts::joined(boxSoup({ 9, 0, 0 }, { 10, 1, 1 }), largeBoxAnd(boxSoup({ 12, 0, 0 }, { 13, 1, 1 })));
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
  EXPECT_EQ(meam::prepareMesh(unitBox()).report.intersections, 0);
  // 150 x 150 triangles that all cross each other: counting ends.
  meam::TriangleMesh grid;
  for (int i = 0; i < 150; ++i)
  {
    const float at = 0.1f * static_cast<float>(i);
    grid = parts::joined(grid, { { { at, -1, -20 }, { at, 20, 0 }, { at, -1, 20 } }, { { 0, 1, 2 } } });
    grid = parts::joined(grid, { { { -20, at, -1 }, { 20, at, -1 }, { 0, at, 40 } }, { { 0, 1, 2 } } });
  }
  EXPECT_EQ(meam::prepareMesh(grid).report.intersections, meam::MostIntersections);
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
  meam::TriangleMesh soup = unitBox();
  soup.triangles.emplace_back(soup.triangles[3]);
  soup.triangles.emplace_back(soup.triangles[4]);
  EXPECT_EQ(meam::describe(meam::prepareMesh(soup).report),
    "28 vertices merged with others at their place; 2 duplicate triangles removed; closed; "
    "1 component of 12 triangles");
  meam::MeshReport report;
  report.nearVertices = report.degenerateTriangles = report.droppedComponents = report.flippedComponents = 1;
  report.closedHoles = 2;
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

TEST(MeshPreparation, canBeStoppedAnywhere)
{
  meam::MeshPreparationSettings settings;
  settings.holeSize = 1.0;
  settings.maximumError = 0.01;
  settings.edgeLength = 0.2;
  steps::expectProgress([&](const meam::Progress& progress) { meam::prepareMesh(unitBox(), settings, progress); },
    { 0.0, 0.2, 0.4, 0.6, 0.7, 0.8, 0.9, 1.0 });
}

TEST(MeshPreparation, badInput)
{
  steps::expectRefused<meam::MeshPreparationSettings>([](const auto& settings)
    { meam::prepareMesh(unitBox(), settings); },
    { { [](auto& s) { s.scale = 0.0; } }, { [](auto& s) { s.scale = -1.0; } }, { [](auto& s) { s.scale = NAN; } },
      { [](auto& s) { s.holeSize = -1.0; } }, { [](auto& s) { s.holeSize = NAN; } },
      { [](auto& s) { s.maximumError = -1.0; } }, { [](auto& s) { s.maximumError = NAN; } },
      { [](auto& s) { s.edgeLength = -1.0; } }, { [](auto& s) { s.edgeLength = NAN; } } });
  steps::expectRefused<meam::TriangleMesh>([](const auto& mesh) { meam::prepareMesh(mesh); },
    { { [](auto& mesh) { mesh = {}; } }, { [](auto& mesh) { mesh.triangles.emplace_back(0, 1, 36); } },
      { [](auto& mesh) { mesh.triangles.emplace_back(0, 1, -1); } }, { [](auto& mesh) {
        mesh.triangles = { { 0, 0, 0 }, { 0, 1, 0 } };
      } },
      { [](auto& mesh) { mesh.vertices[5].y() = NAN; } } },
    unitBox());
}
