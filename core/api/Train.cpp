// SPDX-License-Identifier: BSD-3-Clause
#include "meam.h"
#include "mesh/preparation/MeshPreparation.h"
#include "model/ModelTraining.h"

namespace meam
{
Mesh prepareMesh(const Mesh& mesh, double scale, const Eigen::Vector3d& offset)
{
  MeshPreparationSettings settings;
  settings.scale = scale;
  settings.offset = offset;
  PreparedMesh prepared = prepareMesh(TriangleMesh{ mesh.vertices, mesh.triangles }, settings);
  return { std::move(prepared.mesh.vertices), std::move(prepared.mesh.triangles), mesh.report };
}

Model train(const Mesh& mesh, const TrainSettings& settings, const Progress& progress)
{
  return Model(
    std::make_shared<const TrainedModel>(trainMesh({ mesh.vertices, mesh.triangles }, settings, progress).model));
}
}
