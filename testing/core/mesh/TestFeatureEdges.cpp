// SPDX-License-Identifier: BSD-3-Clause
#include "TestParts.h"
#include "mesh/FeatureEdges.h"
#include "mesh/TriangleMesh.h"

namespace
{
meam::PointCloud extract(const meam::TriangleMesh& mesh, double spacing, double angle = 30.0)
{
  meam::FeatureEdgesSettings settings;
  settings.spacing = spacing;
  settings.angle = angle;
  return meam::extractFeatureEdges(mesh, settings);
}

}

TEST(FeatureEdges, boxHasTwelve)
{
  const meam::PointCloud cloud = extract(parts::box({ 0, 0, 0 }, { 10, 20, 30 }), 1.0);
  ASSERT_EQ(cloud.size(), 4u * (10 + 20 + 30));
  ASSERT_EQ(cloud.tangents.size(), cloud.size());
  ASSERT_EQ(cloud.normals.size(), cloud.size());
  ASSERT_EQ(cloud.pointIds.size(), cloud.size());
  ASSERT_EQ(cloud.edgeTypes.size(), cloud.size());
  std::array<int, 3> along{};
  const Eigen::Vector3f size(10, 20, 30);
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    EXPECT_EQ(cloud.pointIds[i], static_cast<int>(i));
    EXPECT_EQ(cloud.edgeTypes[i], meam::EdgeType::Crease);
    int axis = 0;
    EXPECT_EQ(cloud.tangents[i].cwiseAbs().maxCoeff(&axis), 1.0f);
    ++along[axis];
    for (int k = 0; k < 3; ++k)
    {
      const float at = cloud.points[i][k];
      if (k == axis)
      {
        EXPECT_NEAR(at - std::floor(at), 0.5f, 1e-4f); // half a step from the corners
        EXPECT_EQ(cloud.normals[i][k], 0.0f);
      }
      else
      {
        EXPECT_TRUE(at == 0.0f || at == size[k]);
        EXPECT_NEAR(cloud.normals[i][k], (at > 0.0f ? 1.0f : -1.0f) * std::sqrt(0.5f), 1e-6f);
      }
    }
  }
  EXPECT_EQ(along, (std::array<int, 3>{ 40, 80, 120 }));
}

TEST(FeatureEdges, automaticSpacing)
{
  // d_max is 3 mm: a point every 0.03 mm.
  EXPECT_EQ(extract(parts::box({ 0, 0, 0 }, { 1, 2, 2 }), 0.0).size(), 4u * (33 + 67 + 67));
}

TEST(FeatureEdges, cylinderHasTwoCircles)
{
  constexpr int corners = 720;
  const meam::PointCloud cloud = extract(parts::regularPrism(corners, 10, 15), 1.0);
  EXPECT_EQ(cloud.size(), 2u * 63); // 2 pi 10 mm
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    const Eigen::Vector3f point = cloud.points[i];
    EXPECT_TRUE(point.z() == 0.0f || point.z() == 15.0f);
    EXPECT_NEAR(point.head<2>().norm(), 10.0f, 1e-3f);
    EXPECT_EQ(cloud.tangents[i].z(), 0.0f);
    EXPECT_NEAR(cloud.tangents[i].norm(), 1.0f, 1e-5f);
    // The side of the polygon is at most half a corner's turn off the circle.
    EXPECT_LE(std::abs(cloud.tangents[i].dot(point) / 10.0f), std::sin(M_PI / corners) + 1e-4);
  }
}

TEST(FeatureEdges, angleDecides)
{
  // Each corner of a hexagon turns by 60 degrees: beside two rings of 6 x 10 mm, six uprights of 15 mm.
  const meam::TriangleMesh prism = parts::regularPrism(6, 10, 15);
  EXPECT_EQ(extract(prism, 1.0, 59.0).size(), 120u + 90u);
  EXPECT_EQ(extract(prism, 1.0, 61.0).size(), 120u);
  EXPECT_EQ(extract(prism, 1.0, 91.0).size(), 0u);
}

TEST(FeatureEdges, bracketHasInnerAndOuterEdges)
{
  // Two outlines of 60 + 40 + 18 + 28 + 42 + 12 mm and six uprights of 15 mm; the flat faces have none.
  const meam::PointCloud cloud = extract(parts::lBracket(), 1.0);
  EXPECT_EQ(cloud.size(), 2u * 200 + 6u * 15);
  int inner = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    if (cloud.points[i].head<2>() == Eigen::Vector2f(18, 12))
    {
      ++inner;
      EXPECT_EQ(cloud.tangents[i].cwiseAbs(), Eigen::Vector3f::UnitZ());
    }
  }
  EXPECT_EQ(inner, 15);
}

TEST(FeatureEdges, borderOfASheet)
{
  const meam::PointCloud cloud = extract(parts::rectangle(10, 5), 1.0);
  ASSERT_EQ(cloud.size(), 30u);
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    EXPECT_EQ(cloud.edgeTypes[i], meam::EdgeType::HoleBorder);
    EXPECT_EQ(cloud.normals[i], Eigen::Vector3f::UnitZ());
    const bool longSide = cloud.points[i].y() == 0.0f || cloud.points[i].y() == 5.0f;
    EXPECT_EQ(std::abs(cloud.tangents[i].x()), longSide ? 1.0f : 0.0f);
  }
}

TEST(FeatureEdges, openBoxHasBoth)
{
  meam::TriangleMesh box = parts::box({ 0, 0, 0 }, { 10, 10, 10 });
  box.triangles.erase(box.triangles.begin() + 2, box.triangles.begin() + 4); // the lid
  const meam::PointCloud cloud = extract(box, 1.0);
  EXPECT_EQ(std::count(cloud.edgeTypes.begin(), cloud.edgeTypes.end(), meam::EdgeType::Crease), 80);
  EXPECT_EQ(std::count(cloud.edgeTypes.begin(), cloud.edgeTypes.end(), meam::EdgeType::HoleBorder), 40);
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    EXPECT_EQ(cloud.edgeTypes[i] == meam::EdgeType::HoleBorder, cloud.points[i].z() == 10.0f);
  }
}

TEST(FeatureEdges, edgeOfThreeFacesIsSharp)
{
  meam::TriangleMesh fan;
  fan.vertices = { { 0, 0, 0 }, { 0, 0, 4 }, { 4, 0, 0 }, { -4, 0.1f, 0 }, { 0, 4, 0 } };
  fan.triangles = { { 0, 1, 2 }, { 1, 0, 3 }, { 0, 1, 4 } };
  const meam::PointCloud cloud = extract(fan, 1.0);
  EXPECT_EQ(std::count(cloud.edgeTypes.begin(), cloud.edgeTypes.end(), meam::EdgeType::Crease), 4);
}

TEST(FeatureEdges, smoothMeshHasNone)
{
  // Which turns by less than 10 degrees at each edge.
  EXPECT_TRUE(extract(parts::sphere(10, 4), 1.0).empty());
}

TEST(FeatureEdges, aNeedleInAFlatFaceIsNone)
{
  // Corners are floats: the needle 0 1 4 stands on its edge.
  meam::TriangleMesh sheet;
  sheet.vertices = { { 0, 0, 0 }, { 100, 0, 0 }, { 100, 100, 0 }, { 0, 100, 0 }, { 50, 0, 1e-5f }, { 50, -50, 0 } };
  sheet.triangles = { { 0, 4, 3 }, { 4, 1, 2 }, { 4, 2, 3 }, { 0, 1, 4 }, { 0, 5, 1 } };
  const meam::PointCloud cloud = extract(sheet, 1.0);
  EXPECT_EQ(std::count(cloud.edgeTypes.begin(), cloud.edgeTypes.end(), meam::EdgeType::Crease), 0);
}

TEST(FeatureEdges, badInput)
{
  const meam::TriangleMesh box = parts::box({ 0, 0, 0 }, { 1, 1, 1 });
  for (const double angle : { 0.0, -5.0, 180.0, std::nan("") })
  {
    EXPECT_THROW(extract(box, 0.1, angle), meam::Error);
  }
  for (const double spacing : { -1.0, std::nan(""), 1e-9 })
  {
    EXPECT_THROW(extract(box, spacing), meam::Error);
  }
  EXPECT_THROW(meam::extractFeatureEdges({}), meam::Error);
  EXPECT_THROW(meam::extractFeatureEdges(box, {}, [](double) { return false; }), meam::Aborted);
}
