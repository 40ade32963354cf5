// SPDX-License-Identifier: BSD-3-Clause
#include "model/ModelTraining.h"

#include "mesh/ConvexHull.h"
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

TrainingSettings trainingSettings(Preset preset, Features features, unsigned seed)
{
  TrainingSettings settings = trainingSettings(preset);
  settings.sampling.seed = seed;
  if (takesFeatures(preset))
  {
    settings.hashing.features = features;
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
  PartSurface part{ surface, partDiameter, {} };
  if (settings.findSymmetries)
  {
    part.symmetries = detectSymmetries(surface, {}, subProgress(progress, 0.4, 0.7));
  }
  return hashModels(models, part, settings.hashing, subProgress(progress, 0.7, 1.0));
}
}
