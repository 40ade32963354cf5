// SPDX-License-Identifier: BSD-3-Clause
#include "model/BoundaryExtraction.h"

#include "TestParts.h"
#include "base/sequences/Sequences.h"
#include "mesh/SurfaceSampling.h"
#include "mesh/TriangleMesh.h"
#include "model/AppearanceModel.h"
#include "model/VisibilityExtraction.h"

#include <algorithm>
#include <map>

namespace
{
/// A flat grid of 11 x 11 points, 1 mm apart, with a hole of 3 x 3 in the middle.
meam::AppearanceModel plate()
{
  meam::Points points = parts::lattice({ 0, 0 }, { 10, 10 }, 1.0f, 0.0f);
  meam::eraseIf(points, [](const auto& p) { return std::abs(p.x() - 5) <= 1 && std::abs(p.y() - 5) <= 1; });
  meam::AppearanceModel model;
  model.cloud = parts::facing(points, Eigen::Vector3f::UnitZ());
  return model;
}

/// A square sheet of 40 mm with a square opening of 12 mm, in the plane z = 0.
meam::TriangleMesh openSheet() { return parts::frame(20, 6); }

/// The same, 4 mm thick: a plate with a through hole.
meam::TriangleMesh plateWithHole()
{
  const auto square = [](float half)
  { return Eigen::AlignedBox2f(Eigen::Vector2f(-half, -half), Eigen::Vector2f(half, half)); };
  return parts::holedPlate(square(20), square(6), 4);
}

/// The views of a part, sampled at 1 mm, against its mesh.
std::vector<meam::AppearanceModel> viewsOf(const meam::TriangleMesh& mesh, int viewpoints)
{
  meam::VisibilityExtractionSettings settings;
  settings.method = meam::VisibilityMethod::MeshVisibility;
  settings.viewpoints = viewpoints;
  return meam::extractVisibility(parts::sampled(mesh, 1.0), settings, &mesh);
}

std::vector<meam::AppearanceModel> meshEdges(
  const meam::TriangleMesh& mesh, const std::vector<meam::AppearanceModel>& views)
{
  meam::BoundaryExtractionSettings settings;
  settings.method = meam::BoundaryMethod::MeshEdges;
  return meam::extractBoundary(views, settings, &mesh);
}

/// The view from a direction.
meam::PointCloud edgesFrom(const std::vector<meam::AppearanceModel>& models, const Eigen::Vector3f& direction)
{
  const auto model = std::find_if(models.begin(), models.end(),
    [&](const meam::AppearanceModel& candidate) { return candidate.direction.dot(direction.normalized()) > 0.999f; });
  return model == models.end() ? meam::PointCloud() : model->cloud;
}
}

TEST(BoundaryExtraction, OfAPlateTheRimAndTheHole)
{
  meam::BoundaryExtractionSettings settings;
  settings.radius = 1.5;
  const auto edges = meam::extractBoundary({ plate() }, settings);
  ASSERT_EQ(edges.size(), 1u);
  int rim = 0;
  int hole = 0;
  const meam::PointCloud& cloud = edges[0].cloud;
  ASSERT_EQ(cloud.edgeTypes.size(), cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    const Eigen::Vector3f& point = cloud.points[i];
    const float fromRim = std::min({ point.x(), point.y(), 10 - point.x(), 10 - point.y() });
    const float fromHole = std::max(std::abs(point.x() - 5), std::abs(point.y() - 5)) - 2;
    EXPECT_TRUE(fromRim == 0 || fromHole == 0) << point.transpose();
    rim += fromRim == 0 ? 1 : 0;
    hole += fromHole == 0 ? 1 : 0;
    EXPECT_EQ(cloud.edgeTypes[i], fromRim == 0 ? meam::EdgeType::Contour : meam::EdgeType::HoleBorder);
  }
  EXPECT_EQ(rim, 40);
  EXPECT_GE(hole, 12); // the middles of its sides; a corner's gap is only a right angle
  EXPECT_EQ(edges[0].cloud.normals.size(), edges[0].cloud.size());
}

TEST(BoundaryExtraction, OfPointsTheRidgeOfARoofIsACreaseAndItsEavesAreContours)
{
  // Two faces that fall off by 50 degrees: in the plane of one the other folds back.
  const float c = std::cos(50.0 * M_PI / 180.0);
  const float s = std::sin(50.0 * M_PI / 180.0);
  meam::AppearanceModel roof;
  for (int i = -8; i <= 8; ++i)
  {
    for (int y = 0; y < 15; ++y)
    {
      roof.cloud.points.emplace_back(i * c, y, -std::abs(i) * s);
      roof.cloud.normals.emplace_back(i <= 0 ? -s : s, 0, c);
    }
  }
  const meam::PointCloud edges = meam::extractBoundary({ roof })[0].cloud;
  int ridge = 0;
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    if (edges.points[i].y() > 2 && edges.points[i].y() < 12)
    {
      const bool onRidge = edges.points[i].z() > -0.1f;
      ridge += onRidge ? 1 : 0;
      EXPECT_EQ(edges.edgeTypes[i], onRidge ? meam::EdgeType::Crease : meam::EdgeType::Contour)
        << edges.points[i].transpose();
    }
  }
  EXPECT_EQ(ridge, 9);
}

TEST(BoundaryExtraction, MeshEdgesOfABoxFromAboveAreTheRimOfItsTop)
{
  const meam::TriangleMesh mesh = parts::box({ 0, 0, 0 }, { 20, 20, 10 });
  const auto views = viewsOf(mesh, 1);
  const meam::PointCloud edges = meshEdges(mesh, views)[0].cloud;
  const int perSide = static_cast<int>(std::round(20.0 / meam::pointSpacing(views[0].cloud.points)));
  ASSERT_EQ(edges.size(), 4u * perSide);
  ASSERT_EQ(edges.pointIds.size(), edges.size());
  std::map<std::pair<float, float>, int> onLine; // x or y, and which
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    const Eigen::Vector3f& point = edges.points[i];
    EXPECT_EQ(point.z(), 10.0f);
    const bool alongX = point.y() == 0.0f || point.y() == 20.0f;
    EXPECT_TRUE(alongX || point.x() == 0.0f || point.x() == 20.0f) << point.transpose();
    EXPECT_EQ(edges.tangents[i].cwiseAbs(), Eigen::Vector3f::Unit(alongX ? 0 : 1).eval());
    EXPECT_EQ(edges.normals[i], Eigen::Vector3f::UnitZ().eval());
    EXPECT_EQ(edges.edgeTypes[i], meam::EdgeType::Contour);
    // Half a step from the corner, then whole steps.
    const double steps = (alongX ? point.x() : point.y()) * perSide / 20.0 - 0.5;
    EXPECT_NEAR(steps, std::round(steps), 1e-4);
    const auto& seen = views[0].cloud;
    const auto sample = std::find(seen.pointIds.begin(), seen.pointIds.end(), edges.pointIds[i]);
    ASSERT_NE(sample, seen.pointIds.end());
    for (const auto& other : seen.points)
    {
      EXPECT_GE((other - point).norm(), (seen.points[sample - seen.pointIds.begin()] - point).norm() - 1e-5f);
    }
  }
}

TEST(BoundaryExtraction, MeshEdgesOfABoxFromACornerAreThreeCreasesAndSixContours)
{
  const meam::TriangleMesh mesh = parts::box({ 0, 0, 0 }, { 20, 20, 10 });
  const meam::PointCloud edges = edgesFrom(meshEdges(mesh, viewsOf(mesh, 14)), { 1, 1, 1 });
  ASSERT_FALSE(edges.empty());
  int creases = 0;
  int contours = 0;
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    const Eigen::Vector3f& point = edges.points[i];
    const int far = (point.x() == 0.0f) + (point.y() == 0.0f) + (point.z() == 0.0f);
    const int near = (point.x() == 20.0f) + (point.y() == 20.0f) + (point.z() == 10.0f);
    EXPECT_EQ(far + near, 2);
    EXPECT_LT(far, 2) << "hidden: " << point.transpose();
    EXPECT_EQ(edges.edgeTypes[i], far == 0 ? meam::EdgeType::Crease : meam::EdgeType::Contour) << point.transpose();
    EXPECT_EQ(edges.tangents[i].cwiseAbs().maxCoeff(), 1.0f);
    (far == 0 ? creases : contours) += 1;
  }
  EXPECT_EQ(contours, 2 * creases); // 100 mm and 50 mm
}

TEST(BoundaryExtraction, ACylinderFromTheSideHasTwoStraightContours)
{
  const auto views = viewsOf(parts::regularPrism(48, 10, 30), 6);
  const auto all = meshEdges(parts::regularPrism(48, 10, 30), views);
  const meam::PointCloud& edges = all[2].cloud;
  ASSERT_EQ(all[2].direction, Eigen::Vector3f::UnitX());
  std::map<bool, int> lines;
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    const Eigen::Vector3f& point = edges.points[i];
    EXPECT_EQ(edges.edgeTypes[i], meam::EdgeType::Contour) << point.transpose();
    if (point.z() > 0.0f && point.z() < 30.0f)
    {
      EXPECT_NEAR(std::abs(point.y()), 9.99f, 0.015f) << point.transpose(); // the chord of a facet is 0.02 off
      EXPECT_NEAR(std::abs(edges.tangents[i].z()), 1.0f, 1e-5f);
      EXPECT_NEAR(std::abs(edges.normals[i].y()), 1.0f, 1e-2f);
      lines[point.y() > 0.0f] += 1;
    }
    else
    {
      EXPECT_GE(point.x(), -0.1f) << "the far half of a rim is hidden";
    }
  }
  const int steps = static_cast<int>(std::round(30.0 / meam::pointSpacing(views[2].cloud.points)));
  EXPECT_NEAR(lines[false], steps, 2);
  EXPECT_NEAR(lines[true], steps, 2);
}

TEST(BoundaryExtraction, AHollowHidesItsContours)
{
  // A bore: where its wall turns away from the viewpoint it is hollow.
  const meam::TriangleMesh mesh = parts::revolved({ { 8, 0 }, { 20, 0 }, { 20, 20 }, { 8, 20 } }, 48);
  auto views = viewsOf(mesh, 1);
  views[0].viewpoint += Eigen::Vector3f(150, 0, 0); // a slanted view into it
  const meam::PointCloud edges = meshEdges(mesh, views)[0].cloud;
  int ofTheBore = 0;
  for (const auto& point : edges.points)
  {
    if (point.head<2>().norm() < 8.1f)
    {
      EXPECT_TRUE(point.z() == 0.0f || point.z() == 20.0f) << point.transpose();
      ++ofTheBore;
    }
  }
  EXPECT_GT(ofTheBore, 40);
}

TEST(BoundaryExtraction, ACreaseBehindALegIsHidden)
{
  const auto inner = [](const meam::PointCloud& edges)
  {
    int count = 0;
    for (std::size_t i = 0; i < edges.size(); ++i)
    {
      const Eigen::Vector3f& point = edges.points[i];
      if (point.x() == 18.0f && point.y() == 12.0f && point.z() < 14.0f)
      {
        EXPECT_EQ(edges.edgeTypes[i], meam::EdgeType::Crease);
        ++count;
      }
    }
    return count;
  };
  const auto edges = meshEdges(parts::lBracket(), viewsOf(parts::lBracket(), 14));
  ASSERT_EQ(edges.size(), 14u);
  EXPECT_GE(inner(edgesFrom(edges, { 1, 1, 1 })), 12);
  EXPECT_EQ(inner(edgesFrom(edges, { 1, -1, 1 })), 0);
  EXPECT_EQ(inner(edgesFrom(edges, { -1, 1, 1 })), 0);
  EXPECT_EQ(inner(edgesFrom(edges, { -1, -1, -1 })), 0);
}

TEST(BoundaryExtraction, AThroughHoleShowsTheBackgroundItEncloses)
{
  for (const meam::TriangleMesh& mesh : { plateWithHole(), openSheet() })
  {
    const auto views = viewsOf(mesh, 2);
    for (const auto& edges : { meshEdges(mesh, views), meam::extractBoundary(views) })
    {
      ASSERT_EQ(edges.size(), 2u);
      for (const auto& model : edges)
      {
        int holeBorders = 0;
        for (std::size_t i = 0; i < model.cloud.size(); ++i)
        {
          const Eigen::Vector2f place = model.cloud.points[i].head<2>().cwiseAbs();
          const bool ofHole = place.maxCoeff() < 13.0f;
          if (ofHole && place.minCoeff() > 4.5f)
          {
            continue; // the corners between the walls are creases
          }
          EXPECT_EQ(model.cloud.edgeTypes[i], ofHole ? meam::EdgeType::HoleBorder : meam::EdgeType::Contour)
            << model.name << ": " << model.cloud.points[i].transpose();
          holeBorders += ofHole ? 1 : 0;
        }
        EXPECT_GT(holeBorders, 24);
      }
    }
  }
}

TEST(BoundaryExtraction, AHoleWithABottomIsNotAHoleBorder)
{
  meam::TriangleMesh mesh = plateWithHole();
  mesh.triangles.emplace_back(4, 6, 5);
  mesh.triangles.emplace_back(4, 7, 6);
  const meam::PointCloud edges = meshEdges(mesh, viewsOf(mesh, 1))[0].cloud;
  EXPECT_GT(edges.size(), 100u);
  EXPECT_EQ(std::count(edges.edgeTypes.begin(), edges.edgeTypes.end(), meam::EdgeType::HoleBorder), 0);
}

TEST(BoundaryExtraction, OfTheWholePartAllEdgesAreCreases)
{
  const meam::TriangleMesh mesh = parts::box({ 0, 0, 0 }, { 10, 20, 30 });
  meam::VisibilityExtractionSettings whole;
  whole.viewpoints = 0;
  const auto models = meam::extractVisibility(parts::sampled(mesh, 1.0), whole);
  const auto onEdge = [](const Eigen::Vector3f& p, float tolerance)
  {
    const Eigen::Array3f fromSide = p.array().min(Eigen::Array3f(10, 20, 30) - p.array());
    return (fromSide < tolerance).count() >= 2;
  };
  for (const bool ofMesh : { false, true })
  {
    meam::BoundaryExtractionSettings settings;
    settings.method = ofMesh ? meam::BoundaryMethod::MeshEdges : meam::BoundaryMethod::PointBoundary;
    const auto edges = meam::extractBoundary(models, settings, &mesh);
    ASSERT_EQ(edges.size(), 1u);
    EXPECT_TRUE(edges[0].wholePart);
    const meam::PointCloud& cloud = edges[0].cloud;
    EXPECT_EQ(cloud.edgeTypes, std::vector<meam::EdgeType>(cloud.size(), meam::EdgeType::Crease));
    ASSERT_EQ(cloud.pointIds.size(), cloud.size());
    Eigen::AlignedBox3f box;
    for (const auto& point : cloud.points)
    {
      EXPECT_TRUE(onEdge(point, ofMesh ? 1e-4f : 1.5f)) << point.transpose();
      box.extend(point);
    }
    EXPECT_GT(cloud.size(), 150u); // 240 mm of edges
    EXPECT_GT(box.sizes().minCoeff(), 9.0f) << "an edge of the far side is missing";
  }
}

TEST(BoundaryExtraction, MovingEverythingChangesNothing)
{
  const meam::TriangleMesh mesh = parts::lBracket();
  const auto views = viewsOf(mesh, 14);
  const auto expected = meshEdges(mesh, views);
  std::mt19937 random(6);
  const Eigen::Isometry3d T = parts::motion(random, 200.0);
  auto moved = views;
  for (auto& view : moved)
  {
    view.cloud = parts::moved(view.cloud, T);
    view.direction = (T.linear() * view.direction.cast<double>()).cast<float>();
    view.viewpoint = (T * view.viewpoint.cast<double>()).cast<float>();
  }
  const auto found = meshEdges({ meam::moved(mesh.vertices, T), mesh.triangles }, moved);
  for (std::size_t v = 0; v < found.size(); ++v)
  {
    const meam::PointCloud turned = parts::moved(expected[v].cloud, T);
    ASSERT_EQ(found[v].cloud.size(), turned.size());
    EXPECT_EQ(found[v].cloud.edgeTypes, turned.edgeTypes);
    for (std::size_t i = 0; i < turned.size(); ++i)
    {
      EXPECT_LT((found[v].cloud.points[i] - turned.points[i]).norm(), 1e-3f);
      EXPECT_GT(std::abs(found[v].cloud.tangents[i].dot(turned.tangents[i])), 0.9999f);
    }
  }
}

TEST(BoundaryExtraction, SpacingIsTheMedianNearestDistance)
{
  EXPECT_NEAR(meam::pointSpacing(plate().cloud.points), 1.0, 1e-6);
  EXPECT_EQ(meam::pointSpacing({ Eigen::Vector3f::Zero() }), 0.0);
}

TEST(BoundaryExtraction, BadInput)
{
  meam::AppearanceModel empty;
  EXPECT_THROW(meam::extractBoundary({ empty }), meam::Error);
  meam::AppearanceModel twice = plate(); // every point doubled is fine, one place is not
  twice.cloud.points.insert(twice.cloud.points.end(), twice.cloud.points.begin(), twice.cloud.points.end());
  twice.cloud.normals.insert(twice.cloud.normals.end(), twice.cloud.normals.begin(), twice.cloud.normals.end());
  EXPECT_FALSE(meam::extractBoundary({ twice })[0].cloud.empty());
  twice.cloud = twice.cloud.subset({ 0, 0, 0 });
  EXPECT_THROW(meam::extractBoundary({ twice }), meam::Error);
  meam::AppearanceModel bare = plate();
  bare.cloud.normals.clear();
  EXPECT_THROW(meam::extractBoundary({ bare }), meam::Error);

  const meam::TriangleMesh mesh = openSheet();
  const auto views = viewsOf(mesh, 1);
  meam::BoundaryExtractionSettings settings;
  settings.method = meam::BoundaryMethod::MeshEdges;
  EXPECT_THROW(meam::extractBoundary(views, settings), meam::Error);
  EXPECT_THROW(meam::extractBoundary(views, settings, &mesh, [](double) { return false; }), meam::Aborted);
  const meam::TriangleMesh none;
  EXPECT_THROW(meam::extractBoundary(views, settings, &none), meam::Error);
  const meam::TriangleMesh other = parts::lBracket();
  EXPECT_THROW(meam::extractBoundary(views, settings, &other), meam::Error);
  settings.sharpAngle = 0.0;
  EXPECT_THROW(meam::extractBoundary(views, settings, &mesh), meam::Error);
}
