// SPDX-License-Identifier: BSD-3-Clause
#include "pose/PoseRefinement.h"

#include "PCLConversion.h"
#include "Parallel.h"
#include "RigidFit.h"

#include <Eigen/Eigenvalues>

#include <pcl/registration/icp.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meam
{
namespace
{
constexpr double DistanceShare = 0.1;      // of the diameter: farthest correspondence at the start
constexpr double PointDistanceShare = 0.04; // the same of point-to-point ICP
constexpr double LastDistanceShare = 0.12;  // of that at the end
constexpr int FullSteps = 1;                // the last ones, with all points
constexpr int CoarseStride = 4;             // of the points in the steps before
constexpr int FewestCorrespondences = 4;
// Of a pose that settles.
constexpr double LatticeShare = 0.02;        // of the diameter: where it starts from
constexpr double LatticeTurn = 0.04;         // step of each coefficient of the quaternion: 4.6 degrees about an axis
constexpr double SettleDistanceShare = 0.06; // of the diameter
constexpr int SettleIterations = 4;
constexpr double SettledShare = 0.015;       // of the diameter: it stays within this
constexpr double SettledTurn = 2.0;          // and this many degrees of where it was
constexpr int MostSteps = 6;
constexpr int StepsOfSight = 2;              // in the first ones what is in sight is told anew
constexpr double LeastMotionShare = 1e-5;    // of the diameter
// Shares of what corresponds that have to speak for a motion.
constexpr double ConstrainedShare = 0.01; // so that it counts as fixed
constexpr double LeastShare = 1e-6;       // taken for the variance of one that nothing fixes

/// Tukey's weight: 1 at 0, 0 from the limit on.
double tukey(double squared, double limit)
{
  const double u = squared / (limit * limit);
  return u < 1.0 ? (1.0 - u) * (1.0 - u) : 0.0;
}

class Refiner
{
public:
  Refiner(const SceneIndex& index, double distance, int iterations)
    : Index(index)
    , Distance(distance)
    , Iterations(iterations)
  {
  }

  void refine(Pose& pose) const
  {
    PartView::Visible visible = this->visible(pose);
    for (int iteration = 0; iteration < this->Iterations; ++iteration)
    {
      const double share = this->Iterations > 1 ? static_cast<double>(iteration) / (this->Iterations - 1) : 1.0;
      const double limit = this->Distance * std::pow(LastDistanceShare, share);
      if (iteration > 0 && iteration + FullSteps == this->Iterations)
      {
        visible = this->visible(pose); // nearly there: what is in sight can be told better now
      }
      const int stride = iteration + FullSteps < this->Iterations ? CoarseStride : 1;
      this->step(pose, visible, stride, limit);
    }
    pose.fit = this->fitAt(pose, visible);
    pose.fit.iterations = this->Iterations;
  }

  /// Steps with all points until the pose stays.
  void settle(Pose& pose) const
  {
    const double least = LeastMotionShare * this->Index.model.diameter;
    PartView::Visible visible;
    double moved = std::numeric_limits<double>::infinity();
    int steps = 0;
    for (; steps < MostSteps && moved > least; ++steps)
    {
      if (steps < StepsOfSight)
      {
        visible = this->visible(pose);
      }
      moved = this->step(pose, visible, 1, this->Distance * LastDistanceShare);
    }
    const int before = pose.fit.iterations;
    pose.fit = this->fitAt(pose, visible);
    pose.fit.iterations = before + steps;
  }

  /// How well the scene fixes the pose; the iterations are left to the caller.
  PoseFit fitAt(const Pose& pose, const PartView::Visible& visible) const
  {
    const RigidFit::Result fit =
      this->correspondences(pose.T_scene_model, visible, 1, this->Distance * LastDistanceShare);
    PoseFit result;
    if (fit.weights < FewestCorrespondences)
    {
      return result;
    }
    result.residual = std::sqrt(fit.squares / fit.weights);
    // Rotations count as what they move half a diameter from the middle, so all six are lengths.
    Eigen::Matrix<double, 6, 1> scale = Eigen::Matrix<double, 6, 1>::Ones();
    scale.head<3>().setConstant(2.0 / this->Index.model.diameter);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(
      scale.asDiagonal() * fit.information * scale.asDiagonal() / fit.weights);
    const auto& values = solver.eigenvalues();
    result.constrained = static_cast<int>((values.array() > ConstrainedShare).count());
    const Eigen::Matrix<double, 6, 1> variances = result.residual * result.residual / fit.weights *
      values.array().max(LeastShare).inverse();
    result.covariance = scale.asDiagonal() * solver.eigenvectors() * variances.asDiagonal() *
      solver.eigenvectors().transpose() * scale.asDiagonal();
    return result;
  }

  PartView::Visible visible(const Pose& pose) const
  {
    return this->Index.view.visible(pose.T_scene_model, this->Index.scene.sensor);
  }

private:
  /// Returns how far (mm) the pose moved: its middle, or a point half a diameter from it.
  double step(Pose& pose, const PartView::Visible& visible, int stride, double limit) const
  {
    const Eigen::Isometry3d motion = this->correspondences(pose.T_scene_model, visible, stride, limit).motion;
    const Eigen::Vector3d middle = pose.T_scene_model * this->Index.view.middle().cast<double>();
    pose.T_scene_model = motion * pose.T_scene_model;
    const double turn = Eigen::AngleAxisd(Eigen::Matrix3d(motion.linear())).angle();
    return (motion * middle - middle).norm() + turn * 0.5 * this->Index.model.diameter;
  }

  /// Residuals of every `stride`-th visible point that something in the scene within `limit` (mm) corresponds to.
  RigidFit::Result correspondences(
    const Eigen::Isometry3d& T, const PartView::Visible& visible, int stride, double limit) const
  {
    const TrainedModel& model = this->Index.model;
    const PointCloud& scene = this->Index.scene.edges;
    const Eigen::Isometry3f Tf = T.cast<float>();
    RigidFit fit(T * this->Index.view.middle().cast<double>());
    const double gap = this->Index.depth.cellSize();
    for (std::size_t k = 0; k < visible.edges.size(); k += stride)
    {
      const int i = visible.edges[k];
      const Eigen::Vector3f point = Tf * model.edges.points[i];
      const Eigen::Vector3f tangent = Tf.linear() * model.edges.tangents[i];
      // Distance to the scene's tangent line, which counts, not to the point on it.
      const EdgeLines::Match match = this->Index.lines.nearest(point, tangent, limit);
      if (match.edge < 0)
      {
        continue;
      }
      const Eigen::Vector3d line = scene.tangents[match.edge].cast<double>();
      const Eigen::Vector3d offset = (point - scene.points[match.edge]).cast<double>();
      const Eigen::Matrix3f frame = frameAround(line.cast<float>());
      const double weight = tukey(match.squaredDistance, limit);
      for (int axis = 1; axis < 3; ++axis)
      {
        const Eigen::Vector3d across = frame.col(axis).cast<double>();
        fit.add(point.cast<double>(), across, across.dot(offset), weight);
      }
    }
    for (std::size_t k = 0; k < visible.surface.size(); k += stride)
    {
      const int i = visible.surface[k];
      const Eigen::Vector3f point = Tf * model.surface.points[i];
      const Eigen::Vector3f normal = Tf.linear() * model.surface.normals[i];
      const Eigen::Vector3f* seen = this->Index.depth.meanAt(point);
      if (!seen || (point - *seen).squaredNorm() > limit * limit + gap * gap)
      {
        continue;
      }
      const double residual = normal.dot(point - *seen);
      fit.add(point.cast<double>(), normal.cast<double>(), residual, tukey(residual * residual, limit));
    }
    return fit.result();
  }

  const SceneIndex& Index;
  double Distance;
  int Iterations;
};

struct CountedICP : pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ, double>
{
  int iterations() const { return this->nr_iterations_; }
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
    pose.T_scene_model.linear() = Eigen::Quaterniond(Eigen::Matrix3d(result.topLeftCorner<3, 3>())).normalized().toRotationMatrix();
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

Pose settlePose(const Pose& pose, const SceneIndex& index)
{
  const TrainedModel& model = index.model;
  const Eigen::Vector3d middle = index.view.middle().cast<double>();
  const Eigen::Isometry3d inFrame =
    nearestEqual(index.frame * pose.T_scene_model, Eigen::Isometry3d::Identity(), model.symmetries);
  const double step = LatticeShare * model.diameter;
  const Eigen::Vector3d place = ((inFrame * middle) / step).array().round() * step;
  const Eigen::Quaterniond turn(Eigen::Matrix3d(inFrame.linear()));
  const Eigen::Vector4d rounded = (turn.coeffs() / LatticeTurn).array().round() * LatticeTurn;
  Eigen::Isometry3d start = Eigen::Isometry3d::Identity();
  start.linear() = Eigen::Quaterniond(rounded).normalized().toRotationMatrix();
  start.translation() = place - start.linear() * middle;
  Pose settled = pose;
  settled.T_scene_model = index.frame.inverse() * start;
  const Refiner refiner(index, SettleDistanceShare * model.diameter, SettleIterations);
  refiner.refine(settled);
  refiner.settle(settled);
  const Eigen::Isometry3d equal = nearestEqual(settled.T_scene_model, pose.T_scene_model, model.symmetries);
  if (translationError(equal, pose.T_scene_model, middle) > SettledShare * model.diameter ||
    rotationError(equal, pose.T_scene_model) > SettledTurn)
  {
    // The way from the lattice leads elsewhere, as to the next tooth of a fine gear.
    settled = pose;
    refiner.settle(settled);
  }
  const std::size_t axes = model.symmetries.continuous.size(); // turns about them are free, and equal
  return settled.fit.constrained >= 6 - static_cast<int>(axes) ? settled : pose;
}

Poses refinePoses(
  const Poses& poses, const SceneIndex& index, const PoseRefinementSettings& settings, const Progress& progress)
{
  const TrainedModel& model = index.model;
  const double share = settings.method == RefinementMethod::PointToPoint ? PointDistanceShare : DistanceShare;
  const double distance = settings.maximumDistance > 0.0 ? settings.maximumDistance : share * model.diameter;
  Poses refined = poses;
  const int count = static_cast<int>(refined.size());
  const Refiner refiner(index, distance, settings.iterations);
  if (settings.method == RefinementMethod::EdgesAndSurface)
  {
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
  const PCLCloud::Ptr target = toPCL(index.scene.edges.points);
  const auto tree = pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>();
  tree->setInputCloud(target);
  std::vector<PCLCloud::Ptr> views;
  for (std::size_t v = 0; v < model.viewDirections.size(); ++v)
  {
    views.push_back(toPCL(index.view.viewEdges(static_cast<int>(v)).points));
  }
  parallelFor(count, settings.threads, progress,
    [&](int begin, int end, int)
    {
      for (int i = begin; i < end; ++i)
      {
        refinePointToPoint(refined[i], views.at(refined[i].viewId), target, tree, distance, settings.iterations);
        const int iterations = refined[i].fit.iterations;
        refined[i].fit = refiner.fitAt(refined[i], refiner.visible(refined[i]));
        refined[i].fit.iterations = iterations;
      }
    });
  report(progress, 1.0);
  return refined;
}
}
