// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/TrainedModel.h"
#include "pose/verification/PoseEvidence.h"

#include <vector>

namespace meam
{
struct EvidenceAscentSettings
{
  bool ifPast = true;        ///< poses move that the sensor saw past,
  bool ifClose = true;       ///< and those that a surface close before them hides
  bool bothOrders = true;    ///< shifts first and turns first; else shifts first alone
  double leastPast = 1.0;    ///< patches that the sensor saw past,
  double leastClose = 0.2;   ///< or that a surface hides which is close before them; fewer, and a pose stays
  double covered = 0.9;      ///< probability from which on what is close before a pose is another object
  double worthTrying = 1e-3; ///< probability; less, and a pose stays,
  double sure = 0.99;        ///< and so it does if it has more
  double firstStep = 0.02;   ///< of the diameter: a shift along an axis; a turn moves so much half a diameter away
  double lastStep = 0.0025;  ///< steps are halved down to this one
  double farthest = 0.1;     ///< of the diameter, from where the pose was,
  double mostTurned = 15.0;  ///< and degrees
  int rounds = 16;           ///< over all axes, at most; 0: poses stay
  int pointStride = 2;       ///< of the predicted points one of so many is looked at on the way
  double price = 1.0;        ///< off the log odds of a moved pose: the best of so many has as much by chance
};

/// Moves a pose to where the scan speaks for it the most, by compass searches along and about the axes of the part (the
/// exploratory moves of Hooke and Jeeves, "Direct search" solution of numerical and statistical problems, J. ACM 1961):
/// one shifts it before it turns it, one turns it first, for each may end at a lower summit.
///
/// Least squares know only of what corresponds: of a part that is not quite as in its CAD file, or that a sensor has
/// smoothed, they fit one end and leave the other in the air, or below the surface, where nothing speaks against it. A
/// pose that nothing contradicts stays, for least squares are more exact; so do all in scenes without a surface. Calls
/// may run in parallel.
class EvidenceAscent
{
public:
  /// Keeps references to the collector and the model. Throws Error for a stride below 1.
  EvidenceAscent(const EvidenceCollector& collector, const EvidenceRates& rates, const TrainedModel& model,
    const EvidenceAscentSettings& settings = {});

  struct Result
  {
    Eigen::Isometry3d T_scene_model;
    PoseEvidence evidence; ///< at it
    double logOdds;        ///< less the price, where it was moved
    double logOddsBefore;  ///< of the pose as it was
    bool isMoved;
  };
  /// What the scan says of a pose, in the local frame.
  Result at(const Eigen::Isometry3d& T_scene_model) const;
  /// The same, or of one near by that is worth its price.
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
  /// A summit near a pose, by motions that are tried in this order.
  Eigen::Isometry3d climb(const Eigen::Isometry3d& T_scene_model, const std::vector<Motion>& motions) const;

  const EvidenceCollector& Collector;
  EvidenceRates Rates;
  const TrainedModel& Model;
  EvidenceAscentSettings Settings;
  /// Shifts and then turns, but about the axis of a round part, and of a nearly round one (RotationDecision); and the
  /// same in the other order.
  std::vector<std::vector<Motion>> Orders;
};
}
