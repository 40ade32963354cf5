// SPDX-License-Identifier: BSD-3-Clause
#include "meam.h"
#include "model/ModelTraining.h"

namespace meam
{
Model train(const Mesh& mesh, const TrainSettings& settings, const Progress& progress)
{
  return Model(std::make_shared<const TrainedModel>(
    trainMesh({ mesh.vertices, mesh.triangles }, settings, progress).model));
}
}
