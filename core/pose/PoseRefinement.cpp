// SPDX-License-Identifier: BSD-3-Clause
#include "pose/PoseRefinement.h"

#include "PCLConversion.h"
#include "Parallel.h"
#include "PointGrid.h"
#include "RigidFit.h"
#include "pose/PartView.h"

#include <pcl/registration/icp.h>

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
constexpr double DistanceShare = 0.05;      // of the diameter: farthest correspondence at the start
constexpr double PointDistanceShare = 0.04; // the same of point-to-point ICP
constexpr double LastDistanceShare = 0.24;  // of that at the end
constexpr double SurfaceLeafShare = 0.015;  // of the diameter: scene surface points used
constexpr float ParallelTangents = 0.85f;
constexpr int FewestCorrespondences = 4;   // of point-to-point ICP

/// Tukey's weight: 1 at 0, 0 from the limit on.
double tukey(double squared, double limit)
{
  const double u = squared / (limit * limit);
  return u < 1.0 ? (1.0 - u) * (1.0 - u) : 0.0;
}

class Refiner
{
public:
  Refiner(const TrainedModel& model, const Scene& scene, double distance, int iterations)
    : Model(model)
    , View(model)
    , InScene(scene)
    , Distance(distance)
    , Iterations(iterations)
    , Surface(PointCloud{ scene.surface, {}, {}, {} }.subset(thinPoints(scene.surface, SurfaceLeafShare * model.diameter)).points)
    , EdgeGrid(scene.edges.points, distance)
    , SurfaceGrid(this->Surface, distance)
  {
  }

  void refine(Pose& pose) const
  {
    const PartView::Visible visible = this->View.visible(pose.T_scene_model, this->InScene.sensor);
    for (int iteration = 0; iteration < this->Iterations; ++iteration)
    {
      const double share = this->Iterations > 1 ? static_cast<double>(iteration) / (this->Iterations - 1) : 1.0;
      const double limit = this->Distance * std::pow(LastDistanceShare, share);
      if (this->step(pose.T_scene_model, visible, limit) < 1e-7 * this->Model.diameter && share == 1.0)
      {
        break;
      }
    }
  }

private:
  /// One Gauss-Newton step; returns how far it moved, mm.
  double step(Eigen::Isometry3d& T, const PartView::Visible& visible, double limit) const
  {
    const Eigen::Isometry3f Tf = T.cast<float>();
    const Eigen::Vector3d centre = T * this->View.middle().cast<double>();
    RigidFit fit(centre);
    for (const int i : visible.edges)
    {
      const Eigen::Vector3f point = Tf * this->Model.edges.points[i];
      const Eigen::Vector3f tangent = Tf.linear() * this->Model.edges.tangents[i];
      int nearest = -1;
      float best = static_cast<float>(limit * limit);
      this->EdgeGrid.forEachWithin(point, limit,
        [&](int k, float)
        {
          // Distance to the scene's tangent line, which counts, not to the point on it.
          const float distance =
            this->InScene.edges.tangents[k].cross(point - this->InScene.edges.points[k]).squaredNorm();
          if (distance < best && std::abs(this->InScene.edges.tangents[k].dot(tangent)) > ParallelTangents)
          {
            best = distance;
            nearest = k;
          }
        });
      if (nearest < 0)
      {
        continue;
      }
      const Eigen::Vector3d line = this->InScene.edges.tangents[nearest].cast<double>();
      const Eigen::Vector3d offset = (point - this->InScene.edges.points[nearest]).cast<double>();
      const Eigen::Matrix3f frame = frameAround(line.cast<float>());
      const double weight = tukey(best, limit);
      for (int axis = 1; axis < 3; ++axis)
      {
        const Eigen::Vector3d across = frame.col(axis).cast<double>();
        fit.add(point.cast<double>(), across, across.dot(offset), weight);
      }
    }
    for (const int i : visible.surface)
    {
      const Eigen::Vector3f point = Tf * this->Model.surface.points[i];
      const Eigen::Vector3f normal = Tf.linear() * this->Model.surface.normals[i];
      const int nearest = this->SurfaceGrid.nearest(point, limit);
      if (nearest < 0)
      {
        continue;
      }
      const double residual = normal.dot(point - this->Surface[nearest]);
      fit.add(point.cast<double>(), normal.cast<double>(), residual, tukey(residual * residual, limit));
    }
    const Eigen::Isometry3d move = fit.motion();
    T = move * T;
    return (move * centre - centre).norm() +
      Eigen::AngleAxisd(move.linear()).angle() * 0.5 * this->Model.diameter;
  }

  const TrainedModel& Model;
  PartView View;
  const Scene& InScene;
  double Distance;
  int Iterations;
  Points Surface;
  PointGrid EdgeGrid;
  PointGrid SurfaceGrid;
};

/// Section 5.3: the edge appearance model of the pose's view against the scene's edges.
void refinePointToPoint(Pose& pose, const PCLCloud::ConstPtr& view, const PCLCloud::ConstPtr& scene,
  const pcl::search::KdTree<pcl::PointXYZ>::Ptr& tree, double distance, int iterations)
{
  // Far from the scene the pose stays as it was; PCL would say so on the console.
  const Eigen::Isometry3f T = pose.T_scene_model.cast<float>();
  const auto near = std::count_if(view->begin(), view->end(),
    [&](const pcl::PointXYZ& point)
    {
      const Eigen::Vector3f moved = T * point.getVector3fMap();
      pcl::Indices nearest(1);
      std::vector<float> squared(1);
      tree->nearestKSearch(pcl::PointXYZ(moved.x(), moved.y(), moved.z()), 1, nearest, squared);
      return squared[0] <= distance * distance;
    });
  if (near < FewestCorrespondences)
  {
    return;
  }
  pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ, double> icp;
  icp.setInputSource(view);
  icp.setInputTarget(scene);
  icp.setSearchMethodTarget(tree, true);
  icp.setMaxCorrespondenceDistance(distance);
  icp.setMaximumIterations(iterations);
  icp.setTransformationEpsilon(1e-12);
  PCLCloud aligned;
  icp.align(aligned, pose.T_scene_model.matrix());
  const Eigen::Matrix4d result = icp.getFinalTransformation();
  if (icp.hasConverged() && result.allFinite())
  {
    pose.T_scene_model.linear() = Eigen::Quaterniond(Eigen::Matrix3d(result.topLeftCorner<3, 3>())).normalized().toRotationMatrix();
    pose.T_scene_model.translation() = result.topRightCorner<3, 1>();
  }
}
}

PoseRefinementSettings paperRefinementSettings()
{
  PoseRefinementSettings settings;
  settings.method = RefinementMethod::PointToPoint;
  settings.iterations = 50;
  return settings;
}

Poses refinePoses(const Poses& poses, const TrainedModel& model, const Scene& scene,
  const PoseRefinementSettings& settings, const Progress& progress)
{
  requirePoints(scene.edges.points, "The scene's edge cloud");
  const double share = settings.method == RefinementMethod::PointToPoint ? PointDistanceShare : DistanceShare;
  const double distance = settings.maximumDistance > 0.0 ? settings.maximumDistance : share * model.diameter;
  Poses refined = poses;
  const int count = static_cast<int>(refined.size());
  if (settings.method == RefinementMethod::EdgesAndSurface)
  {
    const Refiner refiner(model, scene, distance, settings.iterations);
    parallelFor(count, settings.threads, progress,
      [&](int begin, int end, int)
      {
        for (int i = begin; i < end; ++i)
        {
          refiner.refine(refined[i]);
        }
      });
    report(progress, 1.0);
    return refined;
  }
  const PCLCloud::Ptr target = toPCL(scene.edges.points);
  const auto tree = pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>();
  tree->setInputCloud(target);
  const PartView view(model);
  std::vector<PCLCloud::Ptr> views;
  for (std::size_t v = 0; v < model.viewDirections.size(); ++v)
  {
    views.push_back(toPCL(view.viewEdges(static_cast<int>(v)).points));
  }
  parallelFor(count, settings.threads, progress,
    [&](int begin, int end, int)
    {
      for (int i = begin; i < end; ++i)
      {
        refinePointToPoint(refined[i], views.at(refined[i].viewId), target, tree, distance, settings.iterations);
      }
    });
  report(progress, 1.0);
  return refined;
}
}
