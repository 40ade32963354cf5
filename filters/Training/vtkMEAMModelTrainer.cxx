// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMModelTrainer.h"

#include "io/cad/CADFile.h"
#include "model/ModelTraining.h"
#include "vtkMEAMArrays.h"
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

void vtkMEAMModelTrainer::ReadCAD(
  const std::string& path, const meam::CADSettings& settings, vtkPolyData* mesh, const meam::Progress& progress)
{
  const meam::CADPart part = meam::readCAD(path, settings, progress);
  vtkMEAMConversion::fromMesh(part.mesh, mesh);
  if (!part.report.empty())
  {
    vtkMEAMConversion::setFieldText(mesh, "CADReport", part.report);
  }
}
