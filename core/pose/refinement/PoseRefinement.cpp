// SPDX-License-Identifier: BSD-3-Clause
#include "pose/refinement/PoseRefinement.h"

#include "base/PCLConversion.h"
#include "base/Parallel.h"
#include "pose/refinement/PoseResiduals.h"

#include <Eigen/Eigenvalues>

#include <pcl/registration/icp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

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
constexpr double FreeShare = 0.001;       // up to which it is a freedom, in which a pose would drift as it settles
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
    Sight sight;
    NormalEquations::Result fit;
    for (int iteration = 0; iteration < iterations; ++iteration)
    {
      const double share = iterations > 1 ? static_cast<double>(iteration) / (iterations - 1) : 1.0;
      const double limit = distance * std::pow(LastDistanceShare, share);
      const bool isFull = iteration + FullSteps >= iterations;
      if (iteration == 0 || isFull) // nearly there, what is in sight can be told better
      {
        sight = this->sight(pose, isFull ? 1 : CoarseStride);
      }
      fit = this->correspondences(pose.T_scene_model, sight, limit);
      pose.T_scene_model = fit.motion * pose.T_scene_model;
    }
    pose.fit = this->poseFit(pose, fit, fit.remaining, iterations);
  }

  /// Steps with all points until the pose stays. False where the scene leaves it a freedom that is none of the part's
  /// symmetries.
  bool settle(Pose& pose) const
  {
    const double diameter = this->Index.model.diameter;
    const double window = WindowShare * diameter;
    Sight sight;
    EdgeIndex::Neighbours neighbours; // of its edges
    double travelled = std::numeric_limits<double>::infinity(); // since they were looked up, at most
    NormalEquations::Result fit;
    Twist wanted, taken;      // in the step before
    bool isFollowing = false; // a step of the same kind
    double wide = WidestFirst;
    double stepLength = 0.0;
    int steps = 0;
    for (; steps < MostSteps && !(isFollowing && stepLength <= LeastMotionShare * diameter); ++steps)
    {
      if (steps < StepsOfSight && this->update(sight, pose, 1))
      {
        isFollowing = false;
        travelled = std::numeric_limits<double>::infinity();
      }
      const double limit = wide * AcrossShare * diameter;
      const Eigen::Isometry3d T = pose.T_scene_model;
      const Eigen::Isometry3f Tf = T.cast<float>();
      const SoAOrientedPoints edges = moved(sight.edges, Tf);
      if (travelled > MarginShare * diameter)
      {
        neighbours = this->Index.lines.neighbours(edges, window, limit, MarginShare * diameter);
        travelled = 0.0;
      }
      const EdgeIndex::Means means = EdgeIndex::meansAround(neighbours, edges, window, limit);
      fit = this->steadyFit(T, edges, means, moved(sight.surface, Tf), limit);
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
      stepLength = farther.head<3>().norm() + farther.tail<3>().norm();
      travelled += 2.0 * farther.head<3>().norm() + farther.tail<3>().norm(); // a diameter from the middle
      wanted = step;
      taken = farther;
      isFollowing = wide == 1.0;
      wide = 1.0;
      pose.T_scene_model = this->motionOf(pose, farther) * T;
    }
    pose.fit = this->poseFit(pose, fit, fit.remaining, pose.fit.iterations + steps);
    const std::ptrdiff_t axes = this->Index.model.symmetries.continuous.size(); // turns about them are free, and equal
    return fit.weights >= FewestCorrespondences &&
      (this->modes(fit).eigenvalues().array() > FreeShare).count() >= 6 - axes;
  }

  /// How well the scene fixes a pose that came from elsewhere.
  PoseFit fitAt(const Pose& pose, double distance) const
  {
    const NormalEquations::Result fit =
      this->correspondences(pose.T_scene_model, this->sight(pose, 1), distance * LastDistanceShare);
    return this->poseFit(pose, fit, fit.squares, pose.fit.iterations);
  }

private:
  /// Rotations count as what they move half a diameter from the middle, so all six are lengths.
  Eigen::Matrix<double, 6, 1> scale() const
  {
    Eigen::Matrix<double, 6, 1> scale = Eigen::Matrix<double, 6, 1>::Ones();
    scale.head<3>().setConstant(2.0 / this->Index.model.diameter);
    return scale;
  }
  /// Independent motions, and the share of what corresponds that speaks for each.
  using Modes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>>;
  Modes modes(const NormalEquations::Result& fit) const
  {
    const Eigen::Matrix<double, 6, 1> scale = this->scale();
    return Modes(scale.asDiagonal() * fit.information * scale.asDiagonal() / fit.weights);
  }

  /// `squares` are those of the fit's residuals at the pose, which the fit's step led to.
  PoseFit poseFit(const Pose& pose, const NormalEquations::Result& fit, double squares, int iterations) const
  {
    PoseFit result;
    result.iterations = iterations;
    const Eigen::Matrix<double, 6, 1> scale = this->scale();
    if (fit.weights < FewestCorrespondences)
    {
      result.covariance.diagonal() = (0.5 * this->Index.model.diameter * scale).array().square();
      return result;
    }
    result.residual = std::sqrt(squares / fit.weights);
    const Modes modes = this->modes(fit);
    const auto& values = modes.eigenvalues();
    const Eigen::Matrix3d axes = pose.T_scene_model.linear();
    for (int k = 0; k < 6; ++k)
    {
      if (values[k] > ConstrainedShare)
      {
        const Eigen::Matrix<double, 6, 1> mode = modes.eigenvectors().col(k);
        result.constrainedAxes.head<3>() += (axes.transpose() * mode.head<3>()).cwiseAbs2();
        result.constrainedAxes.tail<3>() += (axes.transpose() * mode.tail<3>()).cwiseAbs2();
        ++result.constrained;
      }
    }
    const Eigen::Matrix<double, 6, 1> variances = result.residual * result.residual / fit.weights *
      values.array().max(LeastShare).inverse();
    result.covariance = scale.asDiagonal() * modes.eigenvectors() * variances.asDiagonal() *
      modes.eigenvectors().transpose() * scale.asDiagonal();
    return result;
  }

  /// What of the part the sensor should see, in the part's frame.
  struct Sight
  {
    std::shared_ptr<const PredictedVisibility::Visible> visible;
    SoAOrientedPoints edges;
    SoAOrientedPoints surface;
  };
  /// Every `stride`-th point of each.
  Sight sight(const Pose& pose, int stride) const
  {
    Sight sight;
    this->update(sight, pose, stride);
    return sight;
  }
  /// Looks again from the pose; false when the direction is the same.
  bool update(Sight& sight, const Pose& pose, int stride) const
  {
    const auto visible = this->Index.view.visible(pose.T_scene_model, this->Index.scene.sensor);
    if (sight.visible && visible->from == sight.visible->from)
    {
      return false;
    }
    sight.visible = visible;
    const TrainedModel& model = this->Index.model;
    const auto take = [stride](const std::vector<int>& indices, const Points& points, const Points& directions)
    {
      SoAOrientedPoints columns;
      columns.resize((indices.size() + stride - 1) / stride);
      for (std::size_t k = 0; k < columns.size(); ++k)
      {
        columns.set(k, points[indices[k * stride]], directions[indices[k * stride]]);
      }
      return columns;
    };
    sight.edges = take(visible->edges, model.edges.points, model.edges.tangents);
    sight.surface = take(visible->surface, model.surface.points, model.surface.normals);
    return true;
  }

  /// A small motion of a pose about its middle: the rotation vector, as what it moves half a diameter from there, and the
  /// translation, both in mm.
  using Twist = Eigen::Matrix<double, 6, 1>;
  Twist twistOf(const Pose& pose, const Eigen::Isometry3d& motion) const
  {
    const Eigen::Vector3d middle = this->middle(pose.T_scene_model);
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(motion.linear()));
    Twist twist;
    twist << 0.5 * this->Index.model.diameter * turn.angle() * turn.axis(), motion * middle - middle;
    return twist;
  }
  Eigen::Isometry3d motionOf(const Pose& pose, const Twist& twist) const
  {
    const Eigen::Vector3d middle = this->middle(pose.T_scene_model);
    const Eigen::Vector3d rotation = twist.head<3>() / (0.5 * this->Index.model.diameter);
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    if (rotation.norm() > 0.0)
    {
      motion.linear() = Eigen::AngleAxisd(rotation.norm(), rotation.normalized()).toRotationMatrix();
    }
    motion.translation() = middle + twist.tail<3>() - motion.linear() * middle;
    return motion;
  }
  Eigen::Vector3d middle(const Eigen::Isometry3d& T_scene_model) const
  {
    return T_scene_model * this->Index.view.middle().cast<double>();
  }

  /// Residuals of all that something in the scene within `limit` (mm) corresponds to.
  NormalEquations::Result correspondences(const Eigen::Isometry3d& T, const Sight& sight, double limit) const
  {
    const PointCloud& scene = this->Index.scene.edges;
    const Eigen::Isometry3f Tf = T.cast<float>();
    const SoAOrientedPoints edges = moved(sight.edges, Tf);
    SoAOrientedPoints lines;
    SoAPoints offsets;
    std::vector<float> weights;
    lines.resize(edges.size());
    offsets.resize(edges.size());
    for (std::size_t k = 0; k < edges.size(); ++k)
    {
      // Distance to the scene's tangent line, which counts, not to the point on it.
      const Eigen::Vector3f point = edges.points[k];
      const EdgeIndex::Match match = this->Index.lines.nearest(point, edges.directions[k], limit);
      if (match.edge >= 0)
      {
        lines.set(weights.size(), point, scene.tangents[match.edge]);
        offsets.set(weights.size(), point - scene.points[match.edge]);
        weights.push_back(static_cast<float>(tukey(match.squaredDistance, limit)));
      }
    }
    lines.resize(weights.size());
    NormalEquations fit(this->middle(T));
    addLineResiduals(fit, lines, offsets, weights);
    const float farthest = static_cast<float>(std::hypot(limit, this->Index.depth.cellSize()));
    addSurfaceResiduals(
      fit, this->Index.depth, moved(sight.surface, Tf), { static_cast<float>(limit), farthest, false });
    return fit.result();
  }

  /// Residuals that change steadily with the pose, so that it comes to stay in one place: against the mean of the edge
  /// points about each edge, and against the surface up to `limit` (mm).
  NormalEquations::Result steadyFit(const Eigen::Isometry3d& T, const SoAOrientedPoints& edges, EdgeIndex::Means means,
    const SoAOrientedPoints& surface, double limit) const
  {
    for (float& weight : means.weights)
    {
      weight = std::min(weight, 1.0f);
    }
    NormalEquations fit(this->middle(T));
    addLineResiduals(fit, edges, means.offsets, means.weights);
    constexpr float anyDistance = std::numeric_limits<float>::infinity();
    addSurfaceResiduals(fit, this->Index.depth, surface, { static_cast<float>(limit), anyDistance, true });
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
  const bool isFixed = Refiner(index).settle(settled);
  const bool isNear = rotationError(settled.T_scene_model, pose.T_scene_model) < MostTurned &&
    translationError(settled.T_scene_model, pose.T_scene_model, index.view.middle().cast<double>()) <
      FarthestShare * index.model.diameter;
  if (isFixed && isNear)
  {
    return settled;
  }
  Pose same = pose;
  same.fit = Refiner(index).fitAt(pose, DistanceShare * index.model.diameter);
  return same;
}

Poses refineInFrame(
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
  for (Pose& pose : refined)
  {
    pose.viewId = index.viewOf(pose);
  }
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
        refinePointToPoint(refined[i], views[refined[i].viewId], target, tree, distance, settings.iterations);
        refined[i].fit = refiner.fitAt(refined[i], distance);
      }
    });
  report(progress, 1.0);
  return refined;
}

Poses refinePoses(
  const Poses& poses, const SceneIndex& index, const PoseRefinementSettings& settings, const Progress& progress)
{
  const Symmetries& symmetries = index.model.symmetries;
  Poses refined = refineInFrame(inFrameOf(index.scene, poses, symmetries), index, settings, progress);
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    refined[i] = moved(refined[i], index.scene.frame.inverse());
    Eigen::Isometry3d& T = refined[i].T_scene_model;
    T = nearestEqual(T, poses[i].T_scene_model, symmetries);
  }
  return refined;
}
}
