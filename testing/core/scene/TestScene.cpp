// SPDX-License-Identifier: BSD-3-Clause
#include "scene/Scene.h"

#include "TestFiles.h"
#include "TestParts.h"
#include "base/Error.h"
#include "base/Frames.h"

namespace
{
constexpr double Diameter = 100.0;

using parts::skewed;

/// What a sensor above has of edges along one direction and of a surface, all of it moved by T.
meam::Scene moved(const Eigen::Isometry3d& T, bool withSurface = true)
{
  const meam::PrecisePoints edges = parts::moved(skewed(500), T);
  const meam::PrecisePoints tangents(500, T.linear() * Eigen::Vector3d(1, 2, -2) / 3.0);
  const meam::PrecisePoints surface = parts::moved(skewed(3000), T);
  const Eigen::Isometry3d T_local_scene = meam::principalFrame(edges);
  return meam::Scene(meam::toLocalCloud(edges, tangents, {}, T_local_scene),
    withSurface ? meam::toLocalPoints(meam::ScanPoints<double>{ surface.front().data(), surface.size() }, T_local_scene)
                : meam::Points{},
    { true, T * Eigen::Vector3d(10, 20, 900), T.linear() * Eigen::Vector3d(0, 0, -1) }, Diameter);
}

/// Edge points on a square, in the scene's coordinates.
meam::LocalCloud squareEdges()
{
  meam::LocalCloud edges;
  edges.cloud.points = { { 0, 0, 5 }, { 80, 0, 5 }, { 80, 60, 5 }, { 0, 60, 5 } };
  edges.cloud.tangents = { { 1, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
  edges.cloud.weights = { 1.0f, 0.5f, 0.0f, 1.0f };
  return edges;
}

const meam::Points Table{ { 10, 10, 0 }, { 70, 10, 0 }, { 10, 50, 0 }, { 70, 50, 0 } };
const meam::Sensor FromAbove{ false, { 0, 0, 0 }, { 0, 0, -1 } };

std::string sceneError(
  meam::LocalCloud edges, const meam::Points& measured = Table, const meam::Sensor& sensor = FromAbove)
{
  return files::errorOf([&] { meam::Scene(std::move(edges), measured, sensor, Diameter); });
}
}

TEST(Scene, IsTheSameWhereverItLies)
{
  std::mt19937 random(9);
  const meam::Scene here = moved(Eigen::Isometry3d::Identity());
  const Eigen::Isometry3d T = parts::motion(random, 800.0);
  const meam::Scene there = moved(T);
  ASSERT_EQ(here.edgePoints().size(), 500u);
  ASSERT_EQ(there.edgePoints().size(), 500u);
  for (std::size_t i = 0; i < 500; ++i)
  {
    EXPECT_LT((here.edgePoints().points[i] - there.edgePoints().points[i]).norm(), 1e-4f);
    EXPECT_LT((here.edgePoints().tangents[i] - there.edgePoints().tangents[i]).norm(), 1e-6f);
  }
  EXPECT_LT((here.sensor.position - there.sensor.position).norm(), 1e-9);
  EXPECT_LT((here.sensor.direction - there.sensor.direction).norm(), 1e-12);
  EXPECT_TRUE((there.T_local_scene() * T).isApprox(here.T_local_scene(), 1e-9));
  EXPECT_TRUE(here.hasSurface());
  EXPECT_TRUE(moved(T, false).T_local_scene().isApprox(there.T_local_scene())) << "the frame is that of the edges";
  EXPECT_FALSE(moved(T, false).hasSurface());
}

TEST(Scene, ItsGridsAreThoseOfItsPoints)
{
  meam::LocalCloud edges = squareEdges();
  edges.T_local_scene = Eigen::Translation3d(0, 0, -5); // the points as they are given are in it
  const meam::Scene scene(
    edges, meam::moved(Table, edges.T_local_scene), { true, { 40, 30, 500 }, { 0, 0, -1 } }, Diameter);
  EXPECT_TRUE(scene.sensor.position.isApprox(Eigen::Vector3d(40, 30, 495)));
  EXPECT_EQ(scene.edgeGrid().nearest({ 79, 1, 5 }, 3.0), 1);
  EXPECT_EQ(scene.edgePoints().points, edges.cloud.points);
  EXPECT_EQ(scene.edgePoints().weights, edges.cloud.weights);
  EXPECT_EQ(scene.depth.means().size(), 4u);
  EXPECT_NEAR(scene.depth.cellSize(), 0.02 * Diameter, 1e-9);
  EXPECT_GE(scene.surface.nearest({ 71, 10, -5 }, 1.5), 0);
  EXPECT_LT(scene.surface.nearest({ 40, 30, -5 }, 1.5), 0);
}

TEST(Scene, EdgePointsThatAreNotFiniteAreLeftOut)
{
  meam::LocalCloud edges = squareEdges();
  edges.cloud.points[1].x() = NAN;
  edges.cloud.tangents[2].y() = NAN;
  const meam::Scene scene(edges, Table, FromAbove, Diameter);
  EXPECT_EQ(scene.edgePoints().points, (meam::Points{ { 0, 0, 5 }, { 0, 60, 5 } }));
  EXPECT_EQ(scene.edgePoints().weights, (std::vector<float>{ 1.0f, 1.0f }));
}

TEST(Scene, EdgesThatCannotBeLookedUpAreAnError)
{
  EXPECT_EQ(sceneError(squareEdges()), "");
  EXPECT_NE(sceneError({}), "");
  meam::LocalCloud edges = squareEdges();
  edges.cloud.tangents.clear();
  EXPECT_NE(sceneError(edges).find("tangents"), std::string::npos);
  edges = squareEdges();
  edges.cloud.weights.clear();
  EXPECT_EQ(sceneError(edges), "") << "all count 1";
  edges.cloud.weights.assign(3, 1.0f);
  EXPECT_NE(sceneError(edges).find("3 weights"), std::string::npos) << "one is missing";
  for (const float weight : { -0.1f, 1.5f, NAN })
  {
    edges = squareEdges();
    edges.cloud.weights.back() = weight;
    EXPECT_NE(sceneError(edges).find("from 0 to 1"), std::string::npos) << weight;
  }
}

TEST(Scene, ASensorThatLooksAwayIsAnError)
{
  meam::Sensor sensor{ true, { 0, 0, 1000 }, { 0, 0, -1 } };
  EXPECT_EQ(sceneError(squareEdges(), Table, sensor), "");
  sensor.direction = Eigen::Vector3d::UnitZ();
  EXPECT_NE(sceneError(squareEdges(), Table, sensor).find("looks away"), std::string::npos)
    << "it sees nothing of the scene";
  EXPECT_EQ(sceneError(squareEdges(), {}, sensor), "") << "nothing was measured";
}
