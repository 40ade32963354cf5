// SPDX-License-Identifier: BSD-3-Clause
#include "model/PredictedVisibility.h"

#include "TestScene.h"

#include <set>

namespace
{
/// The bracket turned by so many degrees from a pose in which a sensor above sees its upper side.
Eigen::Isometry3d turned(double degrees)
{
  return Eigen::Isometry3d(Eigen::AngleAxisd(degrees * M_PI / 180.0, Eigen::Vector3d(1, 2, 0).normalized()));
}

using parts::fromAbove;

constexpr int CubeSteps = 20; // points along an edge of the cube, less one

/// A cube of 20 mm about the origin, points 1 mm apart. Side 2a faces down along axis a, side 2a + 1 up; each has
/// CubeSteps * CubeSteps points. Of the edges 4a to 4a + 3 lie along axis a; the next axis is down on 4a and 4a + 2,
/// the one after it on 4a and 4a + 1.
meam::TrainedModel cube()
{
  constexpr float half = 0.5f * CubeSteps;
  meam::TrainedModel model;
  model.diameter = 2.0 * half * std::sqrt(3.0);
  for (int side = 0; side < 6; ++side)
  {
    const int axis = side / 2;
    const float sign = side % 2 ? 1.0f : -1.0f;
    for (int k = 0; k < CubeSteps * CubeSteps; ++k)
    {
      Eigen::Vector3f point;
      point[axis] = sign * half;
      point[(axis + 1) % 3] = 0.5f + static_cast<float>(k % CubeSteps) - half;
      point[(axis + 2) % 3] = 0.5f + static_cast<float>(k / CubeSteps) - half;
      model.verificationPoints.push_back(static_cast<int>(model.surface.size()));
      model.surface.points.push_back(point);
      model.surface.normals.push_back(sign * Eigen::Vector3f::Unit(axis));
    }
  }
  for (int edge = 0; edge < 12; ++edge)
  {
    for (int k = 0; k <= CubeSteps; ++k)
    {
      Eigen::Vector3f point;
      point[edge / 4] = static_cast<float>(k) - half;
      point[(edge / 4 + 1) % 3] = edge % 2 ? half : -half;
      point[(edge / 4 + 2) % 3] = edge % 4 / 2 ? half : -half;
      model.edges.points.push_back(point);
      model.edges.tangents.push_back(Eigen::Vector3f::Unit(edge / 4));
    }
  }
  return model;
}

/// The sides of the cube that are visible, and nothing of another: -1 stands for a side of which a part is.
std::set<int> sidesSeen(const meam::PredictedVisibility::Visible& visible)
{
  std::vector<int> points(6);
  for (const int i : visible.surface)
  {
    ++points[i / (CubeSteps * CubeSteps)];
  }
  std::set<int> sides;
  for (int side = 0; side < 6; ++side)
  {
    if (points[side] > 0)
    {
      sides.insert(points[side] == CubeSteps * CubeSteps ? side : -1);
    }
  }
  return sides;
}
}

TEST(PredictedVisibility, PosesThatHardlyDifferPredictTheSamePoints)
{
  const meam::PredictedVisibility view(scenes::bracket());
  const auto visible = view.visible(turned(10.0), fromAbove());
  EXPECT_EQ(view.visible(turned(10.001), fromAbove()), visible) << "seen from the same direction nothing is looked up";
  EXPECT_GT(visible->edges.size(), 0u);
  EXPECT_NE(view.visible(turned(60.0), fromAbove())->surface, visible->surface);
  // The direction is rounded to within a degree.
  const Eigen::Vector3f towards = turned(10.0).linear().transpose().cast<float>() * Eigen::Vector3f::UnitZ();
  EXPECT_GT(visible->from.dot(towards), std::cos(M_PI / 180.0));
}

TEST(PredictedVisibility, WhatIsVisibleIsTheSameInAnyOrderOfQuestions)
{
  const meam::PredictedVisibility one(scenes::bracket(), 100), other(scenes::bracket()); // fewer than are asked for
  const auto first = one.visible(turned(10.0), fromAbove());
  for (int k = 0; k < 1500; ++k)
  {
    const Eigen::Isometry3d T(
      Eigen::AngleAxisd(0.07 * k, Eigen::Vector3d::UnitX()) * Eigen::AngleAxisd(2.4 * k, Eigen::Vector3d::UnitZ()));
    const auto visible = one.visible(T, fromAbove());
    if (k % 100 == 0)
    {
      EXPECT_EQ(visible->edges.points.x, other.visible(T, fromAbove())->edges.points.x) << k;
      EXPECT_EQ(visible->surface, other.visible(T, fromAbove())->surface) << k;
    }
  }
  EXPECT_EQ(one.visible(turned(10.0), fromAbove())->edges.points.x, first->edges.points.x);
  EXPECT_EQ(one.visible(turned(10.0), fromAbove())->surface, first->surface);
}

TEST(PredictedVisibility, WhatWasAskedForLastIsKept)
{
  const meam::PredictedVisibility view(scenes::bracket(), 10);
  const auto askForOthers = [&](int begin, int end)
  {
    for (int k = begin; k < end; ++k)
    {
      view.visible(turned(20.0 + 3.0 * k), fromAbove());
    }
  };
  const auto first = view.visible(turned(10.0), fromAbove());
  askForOthers(0, 6);
  EXPECT_EQ(view.visible(turned(10.0), fromAbove()), first) << "of the older half";
  askForOthers(6, 12);
  EXPECT_EQ(view.visible(turned(10.0), fromAbove()), first) << "asked for again it was one of the recent half";
  askForOthers(12, 24);
  const auto again = view.visible(turned(10.0), fromAbove());
  EXPECT_NE(again, first);
  EXPECT_EQ(again->surface, first->surface);
  const meam::PredictedVisibility forgetful(scenes::bracket(), 0);
  EXPECT_EQ(forgetful.visible(turned(10.0), fromAbove())->surface, first->surface);
  EXPECT_EQ(forgetful.visible(turned(10.0), fromAbove())->surface, first->surface);
}

TEST(PredictedVisibility, OfACubeTheSidesThatFaceTheSensorAreVisible)
{
  const meam::TrainedModel model = cube();
  const meam::PredictedVisibility predicted(model);
  meam::Sensor sensor = fromAbove();
  EXPECT_EQ(sidesSeen(*predicted.visible(turned(0.0), sensor)), std::set<int>({ 5 }));
  sensor.direction = Eigen::Vector3d(1, 1, -1).normalized();
  const auto corner = predicted.visible(turned(0.0), sensor);
  EXPECT_EQ(sidesSeen(*corner), std::set<int>({ 0, 2, 5 }));
  std::vector<int> points(12);
  for (std::size_t k = 0; k < corner->edges.size(); ++k)
  {
    const auto& all = model.edges.points;
    const auto isThis = [&](std::size_t i)
    { return all[i] == corner->edges.points[k] && model.edges.tangents[i] == corner->edges.directions[k]; };
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      points[i / (CubeSteps + 1)] += isThis(i) ? 1 : 0;
    }
  }
  for (int edge = 0; edge < 12; ++edge)
  {
    // Three are hidden but for their ends on the outline: those that meet in the corner on the other side.
    const bool hidden = edge == 1 || edge == 6 || edge == 11;
    EXPECT_TRUE(hidden ? points[edge] <= 3 : points[edge] == CubeSteps + 1) << edge << ": " << points[edge];
  }
}

TEST(PredictedVisibility, TheOutlineOfACubeFromAboveIsASquare)
{
  meam::TrainedModel model = cube();
  model.diameter *= 2.4; // cells of 2.1 mm
  const meam::PredictedVisibility visibility(model);
  const auto visible = visibility.visible(Eigen::Isometry3d::Identity(), fromAbove());
  const double cell = visibility.cellSize();
  EXPECT_NEAR(cell, 0.06 * 20.0 * std::sqrt(3.0), 1e-9);
  // Four sides of 20 mm, of cells that begin anywhere.
  EXPECT_NEAR(visible->outside.size(), 4 * 20.0 / cell, 6.0);
  for (const Eigen::Vector3f& point : visible->outside)
  {
    const float off = point.head<2>().cwiseAbs().maxCoeff() - 10.0f; // from the square
    EXPECT_GT(off, 0.5 * cell);
    EXPECT_LT(off, 2.5 * cell);
    EXPECT_LT(point.head<2>().cwiseAbs().minCoeff(), 10.0 + cell);
    EXPECT_NEAR(point.z(), 10.0f, 0.6f) << "at the depth of the upper side";
  }
  ASSERT_EQ(visible->isInner.size(), visible->surface.size());
  for (std::size_t k = 0; k < visible->surface.size(); ++k)
  {
    const float inside = 10.0f - model.surface.points[visible->surface[k]].head<2>().cwiseAbs().maxCoeff();
    if (inside < 0.4)
    {
      EXPECT_FALSE(visible->isInner[k]) << inside;
    }
    EXPECT_EQ(visible->falls[k], 0.0f) << "flat up to the outline";
    if (inside > 2.0 * cell)
    {
      EXPECT_TRUE(visible->isInner[k]) << inside;
    }
  }
}

TEST(PredictedVisibility, TheRimOfACubeOnAPlateFallsOff)
{
  meam::TrainedModel model = cube();
  const std::size_t ofCube = model.surface.size();
  for (const Eigen::Vector3f& point : parts::lattice({ -19.5f, -19.5f }, { 19.5f, 19.5f }, 1.0f, -10.0f))
  {
    model.verificationPoints.push_back(static_cast<int>(model.surface.size()));
    model.surface.points.push_back(point);
    model.surface.normals.push_back(Eigen::Vector3f::UnitZ());
  }
  model.diameter = 60.0;
  const meam::PredictedVisibility visibility(model);
  const auto visible = visibility.visible(Eigen::Isometry3d::Identity(), fromAbove());
  ASSERT_EQ(visible->falls.size(), visible->surface.size());
  const double cell = visibility.cellSize();
  int atRim = 0;
  for (std::size_t k = 0; k < visible->surface.size(); ++k)
  {
    const Eigen::Vector3f& point = model.surface.points[visible->surface[k]];
    const double fromRim = 10.0 - point.head<2>().cwiseAbs().maxCoeff(); // of the cube
    const bool isOnCube = static_cast<std::size_t>(visible->surface[k]) < ofCube;
    if (!visible->isInner[k])
    {
      EXPECT_FALSE(isOnCube && fromRim > 0.0) << "the plate is behind the cube's rim";
      continue;
    }
    const bool falls = visible->falls[k] > 0.0f;
    EXPECT_TRUE(!falls || visible->falls[k] == 20.0f) << visible->falls[k];
    EXPECT_FALSE(falls && (!isOnCube || fromRim > 2.0 * cell)) << point.transpose();
    EXPECT_TRUE(falls || !isOnCube || fromRim > 0.4) << point.transpose();
    atRim += falls;
  }
  EXPECT_GT(atRim, 50);
}

TEST(PredictedVisibility, APoseFarAwayShowsTheSideThatFacesTheSensor)
{
  const meam::TrainedModel model = cube();
  const meam::PredictedVisibility predicted(model);
  const meam::Sensor sensor; // in the origin
  for (const double away : { 1e3, 1e39 })
  {
    const Eigen::Isometry3d T(Eigen::Translation3d(away, 0, 0));
    EXPECT_EQ(sidesSeen(*predicted.visible(T, sensor)), std::set<int>({ 0 })) << away;
  }
  const Eigen::Isometry3d beyondMeasure(Eigen::Translation3d(1e200, 0, 0)); // there is no direction to the sensor
  EXPECT_TRUE(predicted.visible(beyondMeasure, sensor)->surface.empty());
}

TEST(PredictedVisibility, SamplesInSightAreThoseOfTheUpperSide)
{
  const meam::TrainedModel model = cube();
  const meam::PredictedVisibility visibility(model);
  const std::vector<int> inSight = visibility.samplesInSight(Eigen::Isometry3d::Identity(), fromAbove(), 0.35);
  EXPECT_EQ(inSight.size(), static_cast<std::size_t>(CubeSteps * CubeSteps));
  for (const int i : inSight)
  {
    EXPECT_GT(model.surface.normals[i].z(), 0.5f) << model.surface.points[i].transpose();
  }
}
