// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMModelTrainer.h"

#include "mesh/preparation/MeshPreparation.h"
#include "model/ModelTraining.h"
#include "vtkMEAMMeshConversion.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkMEAMModelTrainer);

std::shared_ptr<const vtkMEAMConversion::TrainedPart> vtkMEAMModelTrainer::Train(
  vtkPolyData* mesh, const Choices& choices, const meam::Progress& progress)
{
  meam::MeshPreparationSettings preparation;
  preparation.scale = choices.scale;
  preparation.offset = Eigen::Vector3d(choices.offset.data());
  const meam::PreparedMesh prepared =
    meam::prepareMesh(vtkMEAMConversion::toMesh(mesh), preparation, meam::subProgress(progress, 0.0, 0.2));
  auto part = std::make_shared<vtkMEAMConversion::TrainedPart>();
  vtkMEAMConversion::fromMesh(prepared.mesh, part->shape);
  const meam::TrainingSettings training = meam::trainingSettings(choices.preset, choices.features, choices.seed);
  part->model = std::make_shared<const meam::TrainedModel>(
    meam::trainModel(prepared.mesh, training, meam::subProgress(progress, 0.2, 1.0)));
  return part;
}
