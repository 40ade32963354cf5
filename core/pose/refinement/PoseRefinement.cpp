// SPDX-License-Identifier: BSD-3-Clause
#include "pose/refinement/PoseRefinement.h"

#include "features/PCLConversion.h"
#include "base/Parallel.h"
#include "pose/refinement/PoseFitter.h"
#include "pose/verification/PoseVerification.h"

#include <pcl/registration/icp.h>

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
constexpr double StartDistance = 0.1;  // of the diameter, between corresponding points,
constexpr double PointDistance = 0.04; // and the same of point-to-point ICP
constexpr double LastDistance = 0.12;  // of that distance at the end: correspondences get nearer step by step
constexpr int CoarseStride = 4;        // of the points in the steps before the last one of so many

/// ICP of edges and surface: correspondences get nearer step by step, all points count in the last one.
void refineByEdgesAndSurface(
  Pose& pose, const PoseFitter& fitter, double distance, const PoseRefinementSettings& settings)
{
  VisiblePart part;
  NormalEquations::Result fit;
  const int iterations = settings.iterations;
  for (int iteration = 0; iteration < iterations; ++iteration)
  {
    const double progress = iterations > 1 ? static_cast<double>(iteration) / (iterations - 1) : 1.0;
    const double limit = distance * std::pow(LastDistance, progress);
    const bool isFull = settings.fullLastStep && iteration + 1 == iterations;
    if (iteration == 0 || isFull) // nearly there, what is in sight can be told better
    {
      part = {};
      fitter.update(part, pose, isFull ? 1 : CoarseStride);
    }
    fit = fitter.correspondences(pose.T_scene_model, part, limit);
    pose.T_scene_model = fit.motion * pose.T_scene_model;
  }
  pose.fit = fitter.poseFit(pose, fit, fit.remaining, iterations);
}

struct CountedICP : pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ, double>
{
  int iterations() const { return this->nr_iterations_; }
};

/// Section 5.3: the edge appearance model of the pose's view against the scene's edges.
void refinePointToPoint(Pose& pose, const PCLCloud::ConstPtr& view, const PCLCloud::ConstPtr& scene,
  const pcl::search::KdTree<pcl::PointXYZ>::Ptr& tree, double distance, const PoseRefinementSettings& settings)
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
  if (near < PoseFitter::FewestCorrespondences)
  {
    return;
  }
  CountedICP icp;
  icp.setInputSource(view);
  icp.setInputTarget(scene);
  icp.setSearchMethodTarget(tree, true);
  icp.setMaxCorrespondenceDistance(distance);
  icp.setMaximumIterations(settings.iterations);
  icp.setTransformationEpsilon(1e-12);
  PCLCloud aligned;
  icp.align(aligned, pose.T_scene_model.matrix());
  const Eigen::Matrix4d result = icp.getFinalTransformation();
  if (icp.hasConverged() && result.allFinite())
  {
    pose.T_scene_model.linear() =
      Eigen::Quaterniond(Eigen::Matrix3d(result.topLeftCorner<3, 3>())).normalized().toRotationMatrix();
    pose.T_scene_model.translation() = result.topRightCorner<3, 1>();
    pose.fit.iterations = icp.iterations();
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

Poses refinePoses(const Poses& poses, const Scene& scene, const TrainedModel& model,
  const PoseRefinementSettings& settings, const Progress& progress)
{
  if (settings.iterations < 1)
  {
    throw Error("Refinement takes at least one step.");
  }
  const bool isPointToPoint = settings.method == RefinementMethod::PointToPoint;
  const double share = isPointToPoint ? PointDistance : StartDistance;
  const double distance = settings.maximumDistance > 0.0 ? settings.maximumDistance : share * model.diameter;
  Poses refined = poses;
  for (Pose& pose : refined)
  {
    pose.viewId = viewOf(pose, scene, model);
  }
  const PoseFitter fitter(scene, model);
  PCLCloud::Ptr target;
  pcl::search::KdTree<pcl::PointXYZ>::Ptr tree;
  std::vector<PCLCloud::Ptr> views;
  if (isPointToPoint)
  {
    target = toPCL(scene.edgePoints().points);
    tree = pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>();
    tree->setInputCloud(target);
    for (std::size_t v = 0; v < model.viewDirections.size(); ++v)
    {
      views.push_back(toPCL(model.edgesOfView(static_cast<int>(v)).points));
    }
  }
  parallelFor(static_cast<int>(refined.size()), settings.threads, progress,
    [&](int begin, int end, int)
    {
      for (int i = begin; i < end; ++i)
      {
        if (isPointToPoint)
        {
          refinePointToPoint(refined[i], views[refined[i].viewId], target, tree, distance, settings);
          refined[i].fit = fitter.fitAt(refined[i], distance * LastDistance);
        }
        else
        {
          refineByEdgesAndSurface(refined[i], fitter, distance, settings);
        }
      }
    });
  report(progress, 1.0);
  return refined;
}
}
