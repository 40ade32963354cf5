// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMModelTrainer.h"

#include "model/ModelTraining.h"
#include "vtkMEAMMeshConversion.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkMEAMModelTrainer);

std::shared_ptr<const vtkMEAMConversion::TrainedPart> vtkMEAMModelTrainer::Train(
  vtkPolyData* mesh, const meam::TrainSettings& settings, const meam::Progress& progress)
{
  meam::TrainedMesh trained = meam::trainMesh(vtkMEAMConversion::toMesh(mesh), settings, progress);
  auto part = std::make_shared<vtkMEAMConversion::TrainedPart>();
  vtkMEAMConversion::fromMesh(trained.mesh, part->shape);
  part->model = std::make_shared<const meam::TrainedModel>(std::move(trained.model));
  return part;
}
