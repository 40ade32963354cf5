// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the core's step of a vtkMEAMPoseAlgorithm gets and gives. Not wrapped.
 */
#ifndef vtkMEAMPoseWork_h
#define vtkMEAMPoseWork_h

#include "base/Error.h"
#include "model/TrainedModel.h"
#include "pose/Pose.h"
#include "pose/verification/EvidenceCounts.h"
#include "scene/Scene.h"
#include "vtkMEAMPoseAlgorithm.h"

#include <optional>

struct vtkMEAMPoseAlgorithm::Work
{
  const meam::Poses& poses; ///< in the scene's local frame
  const meam::Scene& scene;
  const meam::TrainedModel& model;
  const meam::Progress progress;
  std::optional<meam::EvidenceRates> rates; ///< of the scan, as the first verification found them; the result's, too
  meam::Poses result;                       ///< in the local frame
};

#endif
