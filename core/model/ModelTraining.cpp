// SPDX-License-Identifier: BSD-3-Clause
#include "model/ModelTraining.h"

#include "mesh/ConvexHull.h"
#include "mesh/preparation/MeshPreparation.h"
#include "mesh/symmetry/SymmetryDetection.h"
#include "model/AppearanceModel.h"

namespace meam
{
TrainingSettings trainingSettings(Preset preset)
{
  TrainingSettings settings;
  if (preset == Preset::Recommended)
  {
    return settings;
  }
  settings.tangents = paperTangentSettings();
  settings.hashing = paperHashingSettings();
  settings.findSymmetries = false;
  if (preset == Preset::WithoutMEAM || preset == Preset::B2B)
  {
    settings.visibility.viewpoints = 0;
  }
  if (preset == Preset::B2B)
  {
    settings.tangents.method = TangentMethod::LineSegments;
  }
  if (preset == Preset::OriginalPPF)
  {
    settings.hashing.features = Features::Surface;
  }
  return settings;
}

TrainingSettings trainingSettings(const TrainSettings& chosen)
{
  TrainingSettings settings = trainingSettings(chosen.preset);
  settings.sampling.seed = chosen.seed;
  if (takesFeatures(chosen.preset))
  {
    settings.hashing.features = chosen.features;
  }
  return settings;
}

TrainedModel trainModel(const TriangleMesh& mesh, const TrainingSettings& settings, const Progress& progress)
{
  const double partDiameter = diameter(mesh.vertices);
  const PointCloud surface = sampleSurface(mesh, settings.sampling, subProgress(progress, 0.0, 0.1));
  std::vector<AppearanceModel> models =
    extractVisibility(surface, settings.visibility, &mesh, subProgress(progress, 0.1, 0.3));
  models = extractBoundary(models, settings.boundary, &mesh, subProgress(progress, 0.3, 0.4));
  models = estimateTangents(std::move(models), partDiameter, settings.tangents);
  PartGeometry part{ surface, partDiameter, {} };
  if (settings.findSymmetries)
  {
    part.symmetries = detectSymmetries(surface, {}, subProgress(progress, 0.4, 0.7));
  }
  return hashModels(models, part, settings.hashing, subProgress(progress, 0.7, 1.0));
}

TrainedMesh trainMesh(const TriangleMesh& mesh, const TrainSettings& settings, const Progress& progress)
{
  MeshPreparationSettings preparation;
  preparation.scale = settings.scale;
  preparation.offset = settings.offset;
  PreparedMesh prepared = prepareMesh(mesh, preparation, subProgress(progress, 0.0, 0.2));
  TrainedModel model = trainModel(prepared.mesh, trainingSettings(settings), subProgress(progress, 0.2, 1.0));
  return { std::move(prepared.mesh), std::move(model) };
}
}
