// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/TrainedModel.h"
#include "pose/Pose.h"
#include "pose/verification/PoseEvidence.h"

namespace meam
{
struct EvidenceAscentSettings
{
  double leastPast = 0.3;    ///< patches that the sensor saw past; fewer, and a pose stays
  double worthTrying = 1e-3; ///< probability before; less, and a pose stays
  double firstStep = 0.02;   ///< of the diameter: along each axis, and what a turn moves half a diameter away,
  double lastStep = 0.0025;  ///< halved down to this one
  int rounds = 16;           ///< over all axes, at most
  int pointStride = 2;       ///< of the predicted points one of so many is looked at on the way
  double price = 1.0;        ///< log odds that the best of so many poses has by chance
};

/// Moves a pose to where the scan speaks for it the most, by a pattern search along and about the axes of the part
/// (Hooke and Jeeves, "Direct search" solution of numerical and statistical problems, J. ACM 1961). Least squares know
/// only of what corresponds: of a part that is not quite as in its CAD file, or that a sensor has smoothed, they fit
/// one end and leave the other in the air. A pose that nothing contradicts stays, for least squares are more exact.
/// Calls may run in parallel.
class EvidenceAscent
{
public:
  /// Keeps references to the collector and the model.
  EvidenceAscent(const EvidenceCollector& collector, const EvidenceRates& rates, const TrainedModel& model,
    const EvidenceAscentSettings& settings = {});

  /// A pose and what the scan says of it; the price of the search is taken off its log odds.
  struct Place
  {
    Eigen::Isometry3d T_scene_model;
    PoseEvidence evidence;
    double logOdds;
    bool isMoved;
  };
  /// Where the pose is, or a place near by that is worth its price.
  Place best(const Pose& pose) const;

private:
  Place at(const Eigen::Isometry3d& T_scene_model) const;
  Eigen::Isometry3d search(const Eigen::Isometry3d& T_scene_model) const;

  const EvidenceCollector& Collector;
  EvidenceRates Rates;
  const TrainedModel& Model;
  EvidenceAscentSettings Settings;
};
}
