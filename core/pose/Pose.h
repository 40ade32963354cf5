// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"
#include "mesh/Symmetries.h"
#include "pose/objective/LookalikeDecision.h"

#include <algorithm>
#include <string>
#include <vector>

namespace meam
{
/// How well the scene fixes a pose: what corresponds to the part there.
struct PoseFit
{
  int iterations = 0;    ///< 0: the pose has not been refined
  double residual = 0.0; ///< mm, root mean square over what corresponds, weighted
  /// Of a small motion about the middle of the part's surface, scene axes: rotation vector (radians), then translation
  /// (mm). Errors of the measured points are taken as independent; where the scan speaks for another place than least
  /// squares, what lies between the two adds. Where nothing corresponds to anything: half the part's diameter in every
  /// direction.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  int constrained = 0; ///< degrees of freedom, of six, that the scene's points fix
  /// Which: the share that they fix, [0, 1], of turns about the part's x, y and z axis through that middle and of
  /// shifts along them.
  Eigen::Matrix<double, 6, 1> constrainedAxes = Eigen::Matrix<double, 6, 1>::Zero();
};

/// Another rotation of a pose that hardly moves the part's surface.
struct RotationAlternative
{
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity(); ///< mm
  double share = 0.0; ///< [0, 1], how likely it is where a copy is there; with those of all others and the pose's own 1
};

/// A copy of the part in the scene: where it is and what speaks for it. Whether a copy is here, and how it is turned
/// about the near-symmetries of the part, are two questions.
struct Pose
{
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity(); ///< mm
  double score = 0.0; ///< [0, 1], share of what should be visible that is there; 0 until the pose is verified
  /// [0, 1], that a copy is here, however it is turned by the part's near-symmetries; 0 until the pose is verified.
  double placeProbability = 0.0;
  double probability = 0.0; ///< [0, 1], that it is turned like this, too: placeProbability times certainty
  /// What poses of one scene are ordered by: logarithm of the odds that a copy is here, by all that was measured of it,
  /// less the penalty of a search for it (PatternSearch), and less where its rotation is unsure: half that a copy is
  /// here and half that it is turned like this.
  double evidence = 0.0;
  double penalty = 0.0; ///< log odds that PatternSearch took off, for it moved the pose to where they are most
  /// [0, 1], where a copy is here, how sure it is that the part is not turned by one of its near-symmetries, or by one
  /// of its visible side: low when what breaks them is not in sight.
  double certainty = 1.0;
  std::vector<RotationAlternative> alternatives; ///< to the rotation, the likeliest first
  Contradictions contradictions;                 ///< what speaks for another part that looks alike
  int votes = 0;                                 ///< of the peak it came from
  int viewId = -1;                               ///< the appearance model that shows what the sensor sees of it
  double visibleFraction = 0.0; ///< [0, 1], share of the part's side towards the sensor that nothing hides
  PoseFit fit;
};

using Poses = std::vector<Pose>;

/// The pose after a motion of the scene.
Pose moved(const Pose& pose, const Eigen::Isometry3d& motion);

/// Poses in the local frame of a scene.
struct LocalPoses
{
  Eigen::Isometry3d T_local_scene = Eigen::Isometry3d::Identity();
  Poses poses;
};

/// Poses, in the scene's own coordinates, in its local frame: of those that are equal for a part with these symmetries
/// the one that is turned least there, whatever the scene's coordinates are. Throws Error for a pose that is not
/// finite.
Poses toLocalFrame(const Poses& poses, const Eigen::Isometry3d& T_local_scene, const Symmetries& symmetries);

/// Poses of the local frame in the scene's own coordinates; of those that the symmetries make equal the one that is
/// turned least there.
Poses toSceneFrame(const Poses& poses, const Eigen::Isometry3d& T_local_scene, const Symmetries& symmetries);

/// The probability, or the score where none is known, [0, 1]: what poses of different scenes are compared by.
inline double probabilityOrScore(const Pose& pose) { return pose.probability > 0.0 ? pose.probability : pose.score; }

/// How likely a copy is there, however it is turned; the probability, or else the score, where only they are known.
inline double placeOrScore(const Pose& pose)
{
  return pose.placeProbability > 0.0 ? pose.placeProbability : probabilityOrScore(pose);
}

/// Whether `a` comes before `b` among the poses of one scene: by the evidence, and of equal ones by the probability.
inline bool isBetter(const Pose& a, const Pose& b)
{
  return a.evidence != b.evidence ? a.evidence > b.evidence : a.probability > b.probability;
}

/// What a minimum probability is compared with: that a copy is there, or, where its rotation counts, the pose.
inline double claimOf(const Pose& pose, bool rotationCounts)
{
  return rotationCounts ? pose.probability : std::max(pose.placeProbability, pose.probability);
}

/// In one sentence whether parts were found, and how sure that is: what counts is there more likely than not.
std::string describe(const Poses& poses);
/// The same where nothing is likely, and nothing where something is.
std::string doubtsOf(const Poses& poses);

/// That a time limit (seconds) has struck, and what to do.
std::string cutShort(double timeLimit);

/// Where the part's middle (model frame, mm) may be: what maps the unit ball onto the ellipsoid of so many standard
/// deviations about it, by the translations in the pose's covariance, scene coordinates.
Eigen::Affine3d uncertaintyEllipsoid(const Pose& pose, const Eigen::Vector3d& middle, double deviations);

/// Rotation between two poses, degrees.
double rotationError(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b);
/// Distance between where two poses take a point of the part (model frame, mm), mm.
double translationError(
  const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, const Eigen::Vector3d& point = Eigen::Vector3d::Zero());
}
