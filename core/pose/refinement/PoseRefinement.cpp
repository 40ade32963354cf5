// SPDX-License-Identifier: BSD-3-Clause
#include "pose/refinement/PoseRefinement.h"

#include "base/PCLConversion.h"
#include "base/Parallel.h"
#include "pose/verification/PoseVerification.h"

#include <pcl/registration/icp.h>

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
/// ICP of edges and surface: correspondences get nearer step by step, all points count in the last ones.
void refineByEdgesAndSurface(
  Pose& pose, const PoseFitter& fitter, double distance, const PoseRefinementSettings& settings)
{
  VisiblePart part;
  NormalEquations::Result fit;
  const int iterations = settings.iterations;
  for (int iteration = 0; iteration < iterations; ++iteration)
  {
    const double progress = iterations > 1 ? static_cast<double>(iteration) / (iterations - 1) : 1.0;
    const double limit = distance * std::pow(settings.lastDistanceShare, progress);
    const bool isFull = iteration + settings.fullSteps >= iterations;
    if (iteration == 0 || isFull) // nearly there, what is in sight can be told better
    {
      part = {};
      fitter.update(part, pose, isFull ? 1 : settings.coarseStride);
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
  if (near < settings.fitter.fewestCorrespondences)
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
  const double share = isPointToPoint ? settings.pointDistanceShare : settings.distanceShare;
  const double distance = settings.maximumDistance > 0.0 ? settings.maximumDistance : share * model.diameter;
  Poses refined = poses;
  for (Pose& pose : refined)
  {
    pose.viewId = viewOf(pose, scene, model);
  }
  const PoseFitter fitter(scene, model, settings.fitter);
  const int count = static_cast<int>(refined.size());
  if (!isPointToPoint)
  {
    parallelFor(count, settings.threads, progress,
      [&](int begin, int end, int)
      {
        for (int i = begin; i < end; ++i)
        {
          refineByEdgesAndSurface(refined[i], fitter, distance, settings);
        }
      });
    report(progress, 1.0);
    return refined;
  }
  const PCLCloud::Ptr target = toPCL(scene.edgePoints().points);
  const auto tree = pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>();
  tree->setInputCloud(target);
  std::vector<PCLCloud::Ptr> views;
  for (std::size_t v = 0; v < model.viewDirections.size(); ++v)
  {
    views.push_back(toPCL(model.edgesOfView(static_cast<int>(v)).points));
  }
  parallelFor(count, settings.threads, progress,
    [&](int begin, int end, int)
    {
      for (int i = begin; i < end; ++i)
      {
        refinePointToPoint(refined[i], views[refined[i].viewId], target, tree, distance, settings);
        refined[i].fit = fitter.fitAt(refined[i], distance * settings.lastDistanceShare);
      }
    });
  report(progress, 1.0);
  return refined;
}
}
