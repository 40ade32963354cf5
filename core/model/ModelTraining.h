// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "features/Preset.h"
#include "features/TangentEstimation.h"
#include "mesh/SurfaceSampling.h"
#include "mesh/TriangleMesh.h"
#include "model/BoundaryExtraction.h"
#include "model/MEAMHashing.h"
#include "features/TrainSettings.h"
#include "model/VisibilityExtraction.h"

namespace meam
{
struct TrainingSettings
{
  SurfaceSamplingSettings sampling;
  VisibilityExtractionSettings visibility;
  BoundaryExtractionSettings boundary;
  TangentEstimationSettings tangents;
  bool findSymmetries = true;
  MEAMHashingSettings hashing;
};

TrainingSettings trainingSettings(Preset preset);
/// The same with what a user chooses; the features of a preset that leaves them to the user.
TrainingSettings trainingSettings(const TrainSettings& chosen);

/// The offline phase, from a prepared mesh (mm) to the trained model.
TrainedModel trainModel(const TriangleMesh& mesh, const TrainingSettings& settings, const Progress& progress = {});

struct TrainedMesh
{
  TriangleMesh mesh; ///< prepared
  TrainedModel model;
};

/// The same from a mesh as it came, which is prepared first.
TrainedMesh trainMesh(const TriangleMesh& mesh, const TrainSettings& settings, const Progress& progress = {});
}
