// SPDX-License-Identifier: BSD-3-Clause
#include "meam.h"
#include "mesh/preparation/MeshPreparation.h"
#include "model/ModelTraining.h"

namespace meam
{
namespace
{
constexpr double AfterPreparation = 0.2; // share of the work, for the progress
}

Model train(const Mesh& mesh, const TrainSettings& settings, const Progress& progress)
{
  MeshPreparationSettings preparation;
  preparation.scale = settings.scale;
  preparation.offset = settings.offset;
  const PreparedMesh prepared =
    prepareMesh({ mesh.vertices, mesh.triangles }, preparation, subProgress(progress, 0.0, AfterPreparation));
  const TrainingSettings steps = trainingSettings(settings.preset, settings.features, settings.seed);
  return Model(std::make_shared<const TrainedModel>(
    trainModel(prepared.mesh, steps, subProgress(progress, AfterPreparation, 1.0))));
}
}
