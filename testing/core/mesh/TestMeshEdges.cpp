// SPDX-License-Identifier: BSD-3-Clause
#include "TestParts.h"
#include "base/Error.h"
#include "mesh/MeshEdges.h"
#include "mesh/TriangleMesh.h"

TEST(MeshEdges, edgesAndTheirFaces)
{
  // Three triangles at the edge 0-1, one of which has a neighbour.
  meam::TriangleMesh mesh;
  mesh.vertices = { { 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, { -1, -1, 0 } };
  mesh.triangles = { { 0, 1, 2 }, { 1, 0, 3 }, { 0, 1, 4 }, { 0, 2, 3 } };
  const std::vector<meam::MeshEdge> edges = meam::edgesOf(mesh);
  ASSERT_EQ(edges.size(), 8u);
  EXPECT_EQ(edges[0].vertices, (std::array<int, 2>{ 0, 1 }));
  EXPECT_EQ(edges[0].faceCount, 3);
  EXPECT_EQ(edges[0].faces, (std::array<int, 2>{ 0, 1 }));
  EXPECT_EQ(edges[1].vertices, (std::array<int, 2>{ 0, 2 }));
  EXPECT_EQ(edges[1].faces, (std::array<int, 2>{ 0, 3 }));
  EXPECT_EQ(edges[3].vertices, (std::array<int, 2>{ 0, 4 }));
  EXPECT_EQ(edges[3].faceCount, 1);
  EXPECT_EQ(edges[3].faces, (std::array<int, 2>{ 2, -1 }));
}

TEST(MeshEdges, normals)
{
  meam::TriangleMesh mesh;
  mesh.vertices = { { 0, 0, 0 }, { 3, 0, 0 }, { 0, 2, 0 }, { 6, 0, 0 } };
  mesh.triangles = { { 0, 1, 2 }, { 0, 2, 1 }, { 0, 1, 3 } };
  EXPECT_EQ(meam::faceNormals(mesh, meam::edgesOf(mesh)), (meam::Points{ { 0, 0, 1 }, { 0, 0, -1 }, { 0, 0, 0 } }));
}

TEST(MeshEdges, needlesTakeTheNormalBesideTheirLongestEdge)
{
  // A square of 100 mm whose diagonal has two needles one upon the other: rounding has turned them by any angle.
  meam::TriangleMesh mesh;
  mesh.vertices = { { 0, 0, 0 }, { 100, 0, 0 }, { 100, 100, 0 }, { 0, 100, 0 }, { 40, 40, 3e-5f }, { 60, 60, -2e-5f } };
  mesh.triangles = { { 0, 1, 2 }, { 0, 4, 3 }, { 0, 2, 5 }, { 0, 5, 4 }, { 4, 5, 3 }, { 5, 2, 3 } };
  const meam::Points normals = meam::faceNormals(mesh, meam::edgesOf(mesh));
  for (const auto& normal : normals)
  {
    EXPECT_TRUE(normal.isApprox(Eigen::Vector3f::UnitZ(), 1e-5f)) << normal.transpose();
  }
}

TEST(MeshEdges, spacingIsMeasuredAlongTheChain)
{
  // A line of 10 mm in edges of 0.25 mm, in any order and direction.
  meam::Points vertices;
  std::vector<std::array<int, 2>> edges;
  for (int i = 0; i <= 40; ++i)
  {
    vertices.emplace_back(0.25f * static_cast<float>(i), 0, 0);
  }
  for (int i = 0; i < 40; ++i)
  {
    const int k = (i * 7) % 40;
    edges.push_back(i % 2 ? std::array<int, 2>{ k, k + 1 } : std::array<int, 2>{ k + 1, k });
  }
  const std::vector<meam::EdgeSample> samples = meam::sampleEdges(vertices, edges, 1.0);
  ASSERT_EQ(samples.size(), 10u);
  for (int i = 0; i < 10; ++i)
  {
    EXPECT_TRUE(samples[i].point.isApprox(Eigen::Vector3f(0.5f + i, 0, 0), 1e-5f)) << samples[i].point.transpose();
    EXPECT_TRUE(samples[i].tangent.isApprox(Eigen::Vector3f::UnitX()));
    const auto& edge = edges[samples[i].edge];
    EXPECT_LE(vertices[std::min(edge[0], edge[1])].x(), samples[i].point.x() + 1e-4f);
    EXPECT_GE(vertices[std::max(edge[0], edge[1])].x(), samples[i].point.x() - 1e-4f);
  }
}

TEST(MeshEdges, chainsEndWhereTheyBranch)
{
  // A star of three arms of 2 mm: each has its own two points, none is in the middle.
  const meam::Points vertices = { { 0, 0, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, { 0, 0, 2 } };
  const std::vector<meam::EdgeSample> samples = meam::sampleEdges(vertices, { { 0, 1 }, { 2, 0 }, { 0, 3 } }, 1.0);
  ASSERT_EQ(samples.size(), 6u);
  for (const auto& sample : samples)
  {
    EXPECT_NEAR(std::abs(sample.point.norm() - 1.0f), 0.5f, 1e-6f);
  }
}

TEST(MeshEdges, ringsAreClosed)
{
  // A square of 3 mm: twelve points, three for each side.
  const meam::Points vertices = { { 0, 0, 0 }, { 3, 0, 0 }, { 3, 3, 0 }, { 0, 3, 0 } };
  const std::vector<meam::EdgeSample> samples =
    meam::sampleEdges(vertices, { { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 0 } }, 1.0);
  ASSERT_EQ(samples.size(), 12u);
  for (int side = 0; side < 4; ++side)
  {
    EXPECT_EQ(std::count_if(samples.begin(), samples.end(), [&](const auto& s) { return s.edge == side; }), 3);
  }
}

TEST(MeshEdges, shortChainsAndEdgesWithoutLength)
{
  const meam::Points vertices = { { 0, 0, 0 }, { 0.4f, 0, 0 }, { 5, 0, 0 }, { 5, 0, 0 }, { 6, 0, 0 } };
  EXPECT_TRUE(meam::sampleEdges(vertices, { { 0, 1 } }, 1.0).empty());
  EXPECT_EQ(meam::sampleEdges(vertices, { { 0, 1 } }, 0.5).size(), 1u);
  const std::vector<meam::EdgeSample> samples = meam::sampleEdges(vertices, { { 2, 3 }, { 3, 4 } }, 1.0);
  ASSERT_EQ(samples.size(), 1u);
  EXPECT_EQ(samples[0].point, Eigen::Vector3f(5.5f, 0, 0));
  EXPECT_TRUE(meam::sampleEdges(vertices, {}, 1.0).empty());
  EXPECT_TRUE(meam::sampleEdges(vertices, { { 2, 3 } }, 1.0).empty());
}

TEST(MeshEdges, badSpacing)
{
  const meam::Points vertices = { { 0, 0, 0 }, { 1, 0, 0 } };
  for (const double spacing : { 0.0, -1.0, std::nan(""), 1e-9 })
  {
    EXPECT_THROW(meam::sampleEdges(vertices, { { 0, 1 } }, spacing), meam::Error);
  }
}
