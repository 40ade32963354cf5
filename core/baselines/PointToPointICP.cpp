// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/PointToPointICP.h"

#include "base/Parallel.h"
#include "base/sequences/Sequences.h"
#include "features/PCLConversion.h"
#include "pose/refinement/PoseFitter.h"

#include <pcl/registration/icp.h>

#include <algorithm>

namespace meam
{
namespace
{
using SearchTree = pcl::search::KdTree<pcl::PointXYZ>;

struct CountedICP : pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ, double>
{
  int iterations() const { return this->nr_iterations_; }
};

void alignPointToPoint(Pose& pose, const PCLCloud::ConstPtr& view, const PCLCloud::ConstPtr& scene,
  const SearchTree::Ptr& tree, double distance, int iterations)
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
  icp.setMaximumIterations(iterations);
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

void refinePointToPoint(Poses& poses, const Scene& scene, const TrainedModel& model, double distance, int iterations,
  int threads, const Progress& progress)
{
  const PCLCloud::Ptr target = toPCL(scene.edgePoints().points);
  const SearchTree::Ptr tree = pcl::make_shared<SearchTree>();
  tree->setInputCloud(target);
  const auto views =
    ofIndices<PCLCloud::Ptr>(model.viewDirections.size(), [&](int v) { return toPCL(model.edgesOfView(v).points); });
  parallelForEach(static_cast<int>(poses.size()), threads, progress,
    [&](int i) { alignPointToPoint(poses[i], views[poses[i].viewId], target, tree, distance, iterations); });
}
}
