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
// Of a pose that settles, shares of the diameter.
constexpr double WindowShare = 0.02;      // from a point of the part to edge points that count
constexpr double AcrossShare = 0.006;     // the same across its tangent, and along the normal of its surface
constexpr double MarginShare = 0.003;     // that a point moves by before its edge points are looked up again
constexpr double WidestFirst = 1.5;       // times that in the first step
constexpr double LeastMotionShare = 3e-6; // less is none
constexpr int MostSteps = 15;
constexpr int StepsOfSight = 8;           // in the first ones what is in sight is told anew
constexpr double MostTimes = 5.0;         // a step is taken farther
constexpr double FarthestShare = 0.02;    // a pose that settles farther from where it was has gone astray,
constexpr double MostTurned = 3.0;        // or turned by more degrees
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
  explicit Refiner(const SceneIndex& index)
    : Index(index)
  {
  }

  /// `distance` (mm) between corresponding points at the start.
  void refine(Pose& pose, double distance, int iterations) const
  {
    PartView::Visible visible;
    this->see(pose, visible);
    RigidFit::Result fit;
    for (int iteration = 0; iteration < iterations; ++iteration)
    {
      const double share = iterations > 1 ? static_cast<double>(iteration) / (iterations - 1) : 1.0;
      const double limit = distance * std::pow(LastDistanceShare, share);
      if (iteration > 0 && iteration + FullSteps == iterations)
      {
        this->see(pose, visible); // nearly there: what is in sight can be told better now
      }
      const int stride = iteration + FullSteps < iterations ? CoarseStride : 1;
      fit = this->correspondences(pose.T_scene_model, visible, stride, limit);
      pose.T_scene_model = fit.motion * pose.T_scene_model;
    }
    pose.fit = this->poseFit(fit, fit.remaining, iterations);
  }

  /// Steps with all points until the pose stays.
  void settle(Pose& pose) const
  {
    const double diameter = this->Index.model.diameter;
    PartView::Visible visible;
    EdgeLines::Neighbours neighbours; // of the visible edges
    double travelled = std::numeric_limits<double>::infinity(); // since they were looked up, at most
    RigidFit::Result fit;
    Twist wanted, taken;      // in the step before
    bool isFollowing = false; // a step of the same kind
    double wide = WidestFirst;
    double moved = 0.0;
    int steps = 0;
    for (; steps < MostSteps && !(isFollowing && moved <= LeastMotionShare * diameter); ++steps)
    {
      if (steps < StepsOfSight)
      {
        const Eigen::Vector3f from = visible.from;
        this->see(pose, visible);
        if (visible.from != from)
        {
          isFollowing = false;
          travelled = std::numeric_limits<double>::infinity();
        }
      }
      const double limit = wide * AcrossShare * diameter;
      if (travelled > MarginShare * diameter)
      {
        neighbours = this->neighbours(pose.T_scene_model, visible, limit);
        travelled = 0.0;
      }
      fit = this->means(pose.T_scene_model, visible, neighbours, limit);
      Twist step = this->twistOf(pose, fit.motion);
      for (const ContinuousSymmetry& symmetry : this->Index.model.symmetries.continuous)
      {
        const Eigen::Vector3d axis = pose.T_scene_model.linear() * symmetry.axis; // turns about it are all the same
        step.head<3>() -= axis.dot(step.head<3>()) * axis;
      }
      Twist farther = step;
      if (isFollowing)
      {
        // Steps shrink by a nearly constant share, for the weights follow the pose: the secant foresees all that are left.
        const Twist change = step - wanted;
        const double share = change.dot(step) / change.squaredNorm();
        const Twist foreseen = step - share * (taken + change);
        const double times = foreseen.norm() / step.norm();
        if (times > 0.0)
        {
          farther = foreseen * (std::min(times, MostTimes) / times);
        }
      }
      moved = farther.head<3>().norm() + farther.tail<3>().norm();
      travelled += 2.0 * farther.head<3>().norm() + farther.tail<3>().norm(); // a diameter from the middle
      wanted = step;
      taken = farther;
      isFollowing = wide == 1.0;
      wide = 1.0;
      pose.T_scene_model = this->motionOf(pose, farther) * pose.T_scene_model;
    }
    pose.fit = this->poseFit(fit, fit.remaining, pose.fit.iterations + steps);
  }

  /// How well the scene fixes a pose that came from elsewhere.
  PoseFit fitAt(const Pose& pose, double distance) const
  {
    PartView::Visible visible;
    this->see(pose, visible);
    const RigidFit::Result fit =
      this->correspondences(pose.T_scene_model, visible, 1, distance * LastDistanceShare);
    return this->poseFit(fit, fit.squares, pose.fit.iterations);
  }

private:
  /// `squares` are those of the fit's residuals at the pose.
  PoseFit poseFit(const RigidFit::Result& fit, double squares, int iterations) const
  {
    PoseFit result;
    result.iterations = iterations;
    if (fit.weights < FewestCorrespondences)
    {
      return result;
    }
    result.residual = std::sqrt(squares / fit.weights);
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

  void see(const Pose& pose, PartView::Visible& visible) const
  {
    this->Index.view.update(visible, pose.T_scene_model, this->Index.scene.sensor);
  }

  /// A small motion of a pose about its middle: the rotation vector, as what it moves half a diameter from there, and the
  /// translation, both in mm.
  using Twist = Eigen::Matrix<double, 6, 1>;
  Twist twistOf(const Pose& pose, const Eigen::Isometry3d& motion) const
  {
    const Eigen::Vector3d middle = this->middle(pose);
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(motion.linear()));
    Twist twist;
    twist << 0.5 * this->Index.model.diameter * turn.angle() * turn.axis(), motion * middle - middle;
    return twist;
  }
  Eigen::Isometry3d motionOf(const Pose& pose, const Twist& twist) const
  {
    const Eigen::Vector3d middle = this->middle(pose);
    const Eigen::Vector3d rotation = twist.head<3>() / (0.5 * this->Index.model.diameter);
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    if (rotation.norm() > 0.0)
    {
      motion.linear() = Eigen::AngleAxisd(rotation.norm(), rotation.normalized()).toRotationMatrix();
    }
    motion.translation() = middle + twist.tail<3>() - motion.linear() * middle;
    return motion;
  }
  Eigen::Vector3d middle(const Pose& pose) const
  {
    return pose.T_scene_model * this->Index.view.middle().cast<double>();
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

  /// What `means` looks at until a point has moved by a margin.
  EdgeLines::Neighbours neighbours(const Eigen::Isometry3d& T, const PartView::Visible& visible, double limit) const
  {
    const TrainedModel& model = this->Index.model;
    const Eigen::Isometry3f Tf = T.cast<float>();
    PointCloud edges;
    for (const int i : visible.edges)
    {
      edges.points.push_back(Tf * model.edges.points[i]);
      edges.tangents.push_back(Tf.linear() * model.edges.tangents[i]);
    }
    return this->Index.lines.neighbours(edges, WindowShare * model.diameter, limit, MarginShare * model.diameter);
  }

  /// Residuals of all visible points that change steadily with the pose, so that it comes to stay in one place: against
  /// the mean of the edge points about each, up to `limit` (mm), and against the surface, weighing the less the nearer to
  /// where its mean changes.
  RigidFit::Result means(const Eigen::Isometry3d& T, const PartView::Visible& visible,
    const EdgeLines::Neighbours& neighbours, double limit) const
  {
    const TrainedModel& model = this->Index.model;
    const Eigen::Isometry3f Tf = T.cast<float>();
    const double window = WindowShare * model.diameter;
    RigidFit fit(T * this->Index.view.middle().cast<double>());
    for (std::size_t k = 0; k < visible.edges.size(); ++k)
    {
      const int i = visible.edges[k];
      const Eigen::Vector3f point = Tf * model.edges.points[i];
      const Eigen::Vector3f tangent = Tf.linear() * model.edges.tangents[i];
      const EdgeLines::Mean mean = EdgeLines::meanAround(neighbours, k, point, tangent, window, limit);
      if (mean.weight > 0.0f)
      {
        const Eigen::Matrix3f frame = frameAround(tangent);
        for (int axis = 1; axis < 3; ++axis)
        {
          const Eigen::Vector3f across = frame.col(axis);
          fit.add(point.cast<double>(), across.cast<double>(), across.dot(mean.offset), std::min(mean.weight, 1.0f));
        }
      }
    }
    for (const int i : visible.surface)
    {
      const Eigen::Vector3f point = Tf * model.surface.points[i];
      const Eigen::Vector3f normal = Tf.linear() * model.surface.normals[i];
      float inside;
      if (const Eigen::Vector3f* seen = this->Index.depth.meanAt(point, inside))
      {
        const double residual = normal.dot(point - *seen);
        fit.add(point.cast<double>(), normal.cast<double>(), residual, inside * tukey(residual * residual, limit));
      }
    }
    return fit.result();
  }

  const SceneIndex& Index;
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
  Pose settled = pose;
  Refiner(index).settle(settled);
  const Symmetries& symmetries = index.model.symmetries;
  const std::size_t axes = symmetries.continuous.size(); // turns about them are free, and equal
  const bool isFixed = settled.fit.constrained >= 6 - static_cast<int>(axes);
  const bool isNear = rotationError(settled.T_scene_model, pose.T_scene_model) < MostTurned &&
    translationError(settled.T_scene_model, pose.T_scene_model, index.view.middle().cast<double>()) <
      FarthestShare * index.model.diameter;
  return isFixed && isNear ? settled : pose;
}

Poses refinePoses(
  const Poses& poses, const SceneIndex& index, const PoseRefinementSettings& settings, const Progress& progress)
{
  if (settings.iterations < 1)
  {
    throw Error("Refinement takes at least one step.");
  }
  const TrainedModel& model = index.model;
  const double share = settings.method == RefinementMethod::PointToPoint ? PointDistanceShare : DistanceShare;
  const double distance = settings.maximumDistance > 0.0 ? settings.maximumDistance : share * model.diameter;
  Poses refined = poses;
  const int count = static_cast<int>(refined.size());
  const Refiner refiner(index);
  if (settings.method == RefinementMethod::EdgesAndSurface)
  {
    parallelFor(count, settings.threads, progress,
      [&](int begin, int end, int)
      {
        for (int i = begin; i < end; ++i)
        {
          refiner.refine(refined[i], distance, settings.iterations);
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
        refined[i].fit = refiner.fitAt(refined[i], distance);
      }
    });
  report(progress, 1.0);
  return refined;
}
}
