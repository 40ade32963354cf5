// SPDX-License-Identifier: BSD-3-Clause
#include "TestParts.h"
#include "mesh/MeshEdges.h"
#include "mesh/TriangleMesh.h"
#include "mesh/preparation/MeshRemeshing.h"

namespace
{
/// Total length of the edges where faces meet at more than 30 degrees.
double sharpLength(const meam::TriangleMesh& mesh)
{
  const std::vector<meam::MeshEdge> edges = meam::edgesOf(mesh);
  const meam::Points normals = meam::faceNormals(mesh, edges);
  double sum = 0.0;
  for (const auto& edge : edges)
  {
    EXPECT_EQ(edge.faceCount, 2);
    if (normals[edge.faces[0]].dot(normals[edge.faces[1]]) < 0.86f)
    {
      sum += (mesh.vertices[edge.vertices[0]] - mesh.vertices[edge.vertices[1]]).norm();
    }
  }
  return sum;
}
}

TEST(MeshRemeshing, cubeKeepsItsEdges)
{
  const meam::TriangleMesh cube = meam::remesh(parts::box({ 0, 0, 0 }, { 20, 20, 20 }), 2.0);
  EXPECT_NEAR(sharpLength(cube), 12 * 20.0, 1e-3);
  double sum = 0.0;
  const std::vector<meam::MeshEdge> edges = meam::edgesOf(cube);
  for (const auto& edge : edges)
  {
    const double length = (cube.vertices[edge.vertices[0]] - cube.vertices[edge.vertices[1]]).norm();
    EXPECT_LT(length, 4.0);
    EXPECT_GT(length, 0.5);
    sum += length;
  }
  EXPECT_NEAR(sum / static_cast<double>(edges.size()), 2.0, 0.4);
  for (const auto& vertex : cube.vertices)
  {
    const Eigen::Array3f fromFaces = (vertex.array() - 10.0f).abs() - 10.0f;
    EXPECT_NEAR(fromFaces.maxCoeff(), 0.0f, 1e-4f);
  }
}

TEST(MeshRemeshing, borderStays)
{
  const meam::TriangleMesh result = meam::remesh(parts::rectangle(30, 20), 2.0);
  double border = 0.0;
  for (const auto& edge : meam::edgesOf(result))
  {
    border +=
      edge.faceCount == 1 ? (result.vertices[edge.vertices[0]] - result.vertices[edge.vertices[1]]).norm() : 0.0f;
  }
  EXPECT_NEAR(border, 100.0, 1e-3);
}

TEST(MeshRemeshing, badInput)
{
  const meam::TriangleMesh box = parts::box({ 0, 0, 0 }, { 1, 1, 1 });
  for (const double length : { 0.0, -1.0, std::nan(""), 1e-6 })
  {
    EXPECT_THROW(meam::remesh(box, length), meam::Error);
  }
  EXPECT_THROW(meam::remesh({}, 1.0), meam::Error);
  EXPECT_THROW(meam::remesh(box, 0.2, [](double) { return false; }), meam::Aborted);
}
