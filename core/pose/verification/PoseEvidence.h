// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/SceneIndex.h"

namespace meam
{
/// What the sensor saw of one point that a pose predicts to be visible.
enum class PointState : unsigned char
{
  Matched, ///< it is there
  Hidden,  ///< something lies in front of it: says nothing about the pose
  Unknown, ///< surface where nothing was measured: says nothing about the pose by itself
  Violated ///< the sensor looked past it: speaks against the pose
};

/// What counts when poses are judged.
struct EvidenceSettings
{
  /// What each kind of evidence counts in the score, 0 or more, not all 0: edges, surface, and that scene edges on the part
  /// are explained. Without a surface edges alone count.
  double edgeWeight = 0.4;
  double surfaceWeight = 0.4;
  double explainedWeight = 0.2;
  bool freeSpace = true; ///< surface that the sensor looked past speaks against a pose; else it says nothing
  /// Poses that compete are judged on what one of them alone predicts; else each on all that it predicts.
  bool sameVisibility = true;
};

/// Throws Error when the weights make no score.
void requireWeights(const EvidenceSettings& settings);

/// Of the points a pose predicts to be visible those that are judged, scene frame (mm), and what became of each.
struct PoseEvidence
{
  Points edges;
  std::vector<PointState> edgeStates;
  Points surface;
  std::vector<PointState> surfaceStates;
  int explained = 0;   ///< scene edge points on the part's visible surface that are edges of the part
  int unexplained = 0; ///< those that are not

  /// Share of what should be visible that is there: edges, surface and explained scene edges, [0, 1]. The surface counts
  /// in proportion to how much of what nothing hides was measured.
  double support(const EvidenceSettings& settings = {}) const;
  /// Share of the predicted points that nothing hides, [0, 1].
  double visibleFraction() const;
};

/// Judges poses of a part against a scene. Keeps a reference to the index; calls may run in parallel.
class EvidenceCollector
{
public:
  EvidenceCollector(const SceneIndex& index, double tolerance, const EvidenceSettings& settings = {});
  /// Of every `stride`-th of the surface points that the pose predicts, and of half as many of the edge points. What is
  /// collected with a stride is no use to `shared`.
  PoseEvidence collect(const Eigen::Isometry3d& T_scene_model, std::size_t stride = 1) const;
  /// A first impression, at a fraction of the cost: of the surface points that face the sensor and that nothing hides the
  /// share that is there, [0, 1]; of those where nothing was measured half.
  double glance(const Eigen::Isometry3d& T_scene_model) const;
  /// Share of what `a` matched that `b` matched, too, [0, 1]: poses of one instance share most of it.
  double shared(const PoseEvidence& a, const PoseEvidence& b) const;
  /// Whether a scene edge point lies within the tolerance of a point: the paper's test of fit.
  bool nearEdge(const Eigen::Vector3f& point) const { return this->Index.edges.nearest(point, this->Tolerance) >= 0; }

private:
  const SceneIndex& Index;
  double Tolerance;
  bool FreeSpace;
  SoAOrientedPoints Glanced; ///< surface points for a first impression
};
}
