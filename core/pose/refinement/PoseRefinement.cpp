// SPDX-License-Identifier: BSD-3-Clause
#include "pose/refinement/PoseRefinement.h"

#include "base/Parallel.h"
#include "baselines/PointToPointICP.h"
#include "pose/refinement/PoseFitter.h"
#include "pose/verification/PoseVerification.h"

#include <cmath>

namespace meam
{
namespace
{
constexpr double StartDistance = 0.1;  // of the diameter, between corresponding points,
constexpr double PointDistance = 0.04; // and the same of point-to-point ICP
constexpr double LastDistance = 0.12;  // of that distance at the end: correspondences get nearer step by step
constexpr int CoarseStride = 4;        // of the points in the steps before the last one of so many

/// ICP of edges and surface: correspondences get nearer step by step, all points count in the last one.
void refineByEdgesAndSurface(
  Pose& pose, const PoseFitter& fitter, double distance, const PoseRefinementSettings& settings)
{
  VisiblePart part;
  NormalEquations::Result fit;
  const int iterations = settings.iterations;
  for (int iteration = 0; iteration < iterations; ++iteration)
  {
    const double progress = iterations > 1 ? static_cast<double>(iteration) / (iterations - 1) : 1.0;
    const double limit = distance * std::pow(LastDistance, progress);
    const bool isFull = settings.fullLastStep && iteration + 1 == iterations;
    if (iteration == 0 || isFull) // nearly there, what is in sight can be told better
    {
      part = {};
      fitter.update(part, pose, isFull ? 1 : CoarseStride);
    }
    fit = fitter.correspondences(pose.T_scene_model, part, limit);
    pose.T_scene_model = fit.motion * pose.T_scene_model;
  }
  pose.fit = fitter.poseFit(pose, fit, fit.remaining, iterations);
}

}

Poses refinePoses(const Poses& poses, const Scene& scene, const TrainedModel& model,
  const PoseRefinementSettings& settings, const Progress& progress)
{
  if (settings.iterations < 1)
  {
    throw Error("Refinement takes at least one step.");
  }
  const bool isPointToPoint = settings.method == RefinementMethod::PointToPoint;
  const double share = isPointToPoint ? PointDistance : StartDistance;
  const double distance = settings.maximumDistance > 0.0 ? settings.maximumDistance : share * model.diameter;
  Poses refined = poses;
  for (Pose& pose : refined)
  {
    pose.viewId = viewOf(pose, scene, model);
  }
  if (isPointToPoint)
  {
    refinePointToPoint(refined, scene, model, distance, settings.iterations, settings.threads, progress);
  }
  const PoseFitter fitter(scene, model);
  parallelForEach(static_cast<int>(refined.size()), settings.threads, isPointToPoint ? Progress() : progress,
    [&](int i)
    {
      if (isPointToPoint)
      {
        refined[i].fit = fitter.fitAt(refined[i], distance * LastDistance);
      }
      else
      {
        refineByEdgesAndSurface(refined[i], fitter, distance, settings);
      }
    });
  report(progress, 1.0);
  return refined;
}
}
