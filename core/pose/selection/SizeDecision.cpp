// SPDX-License-Identifier: BSD-3-Clause
#include "pose/selection/SizeDecision.h"

#include "pose/objective/FloorContact.h"
#include "pose/refinement/PartSize.h"
#include "pose/verification/ProbabilityCalibration.h"

#include <cmath>

namespace meam
{
namespace
{
constexpr std::size_t MostMeasured = 6;       // poses whose size counts
constexpr std::size_t MostOnFloor = 20;       // poses that may lie on the floor
constexpr std::size_t FewestMeasured = 4;     // what one pose is off may be the scan's, or the pose's
constexpr double Made = 0.02;                 // standard deviation of the lengths that a part is made with
constexpr double DensityOfOthers = 1.0 / 0.6; // another part is 0.7 to 1.3 times as long, each alike
constexpr double PriorOfSize = 3.0; // log odds that it is the part: another lies there by mistake, one time in twenty

/// Log odds that parts of a measured size are the part, against one that is longer or shorter along one axis.
double logOddsOfSize(const PartSize& size)
{
  double others = 0.0;
  int axes = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!std::isnan(size.factors[axis]))
    {
      const double variance = Made * Made + size.deviations[axis] * size.deviations[axis];
      const double off = size.factors[axis] - 1.0;
      others += DensityOfOthers * std::sqrt(2.0 * M_PI * variance) * std::exp(0.5 * off * off / variance);
      ++axes;
    }
  }
  return axes > 0 ? PriorOfSize - std::log(others / axes) : PriorOfSize;
}
}

void allowForOtherSize(FinishedInstances& found, const Scene& scene, const TrainedModel& model, int threads)
{
  const Poses likely = likelyOf(found, MostMeasured);
  if (likely.size() < FewestMeasured)
  {
    return;
  }
  const PartSize size = measurePartSize(likely, scene, model, threads);
  const double thickness = thicknessByFloor(likelyOf(found, MostOnFloor), scene, model);
  const double logOdds = logOddsOfSize(size);
  for (FinishedInstance& finished : found)
  {
    finished.pose.contradictions.lengths = size.factors;
    finished.pose.contradictions.thickness = thickness;
    if (logOdds < PriorOfSize) // that it fits is what the pose's own evidence says
    {
      finished.pose.contradictions.resized = 1.0 - probabilityOf(logOdds);
      allowFor(finished, probabilityOf(logOdds));
    }
  }
}
}
