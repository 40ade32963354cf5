// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/TrainedModel.h"
#include "pose/verification/PoseEvidence.h"

#include <vector>

namespace meam
{
struct PatternSearchSettings
{
  bool ifPast = true;       ///< poses move that the sensor saw past,
  bool ifClose = true;      ///< and those that a surface close before them hides
  bool bothOrders = true;   ///< shifts first and turns first; else shifts first alone
  bool leavesLikely = true; ///< what is close before a likely pose is another object
  bool penalizes = true;    ///< a moved pose, for the best of so many has some evidence by chance
};

/// Local maximization of the log odds of a pose: pattern searches along and about the axes of the part (the exploratory
/// moves of Hooke and Jeeves, "Direct search" solution of numerical and statistical problems, J. ACM 1961). One shifts
/// before it turns, one turns first: they may reach different local maxima.
///
/// Least squares know only of what corresponds: of a part that is not quite as in its CAD file, or that a sensor has
/// smoothed, they fit one end and leave the other in the air, or below the surface, where nothing speaks against it. A
/// pose that nothing contradicts stays, for least squares are more exact; so do all in scenes without a surface. Calls
/// may run in parallel.
class PatternSearch
{
public:
  /// Keeps references to the collector and the model.
  PatternSearch(const EvidenceCollector& collector, const EvidenceRates& rates, const TrainedModel& model,
    const PatternSearchSettings& settings = {});

  struct Result
  {
    Eigen::Isometry3d T_scene_model;
    PoseEvidence evidence; ///< at it
    double logOdds;        ///< less the penalty, where it was moved
    bool isMoved;
    double penalty = 0.0;
  };
  /// What the scan says of a pose, in the local frame.
  Result at(const Eigen::Isometry3d& T_scene_model) const;
  /// The same, or of one near by that is worth its penalty.
  Result best(const Eigen::Isometry3d& T_scene_model) const;

private:
  struct Motion
  {
    Eigen::Vector3d axis; ///< of the part, unit
    bool isTurn;
  };

  bool isContradicted(const Result& pose) const;
  Eigen::Isometry3d moved(const Eigen::Isometry3d& T_scene_model, const Motion& motion, double step) const;
  bool isNear(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const;
  /// A local maximum near a pose, by motions that are tried in this order.
  Eigen::Isometry3d maximum(const Eigen::Isometry3d& T_scene_model, const std::vector<Motion>& motions) const;

  const EvidenceCollector& Collector;
  EvidenceRates Rates;
  const TrainedModel& Model;
  PatternSearchSettings Settings;
  /// Shifts and then turns, but about the axis of a round part, and of a nearly round one (RotationDecision); and the
  /// same in the other order.
  std::vector<std::vector<Motion>> Orders;
};
}
