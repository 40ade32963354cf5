// SPDX-License-Identifier: BSD-3-Clause
#include "api/Conversion.h"
#include "mesh/preparation/MeshPreparation.h"
#include "pick/GraspProposal.h"
#include "picks.h"

namespace meam
{
namespace
{
constexpr double AfterPreparation = 0.1; // share of the work, for the progress
}

Grasps proposeGrasps(const Model& model, const Mesh& part, const GripperModel& gripper, const ProposeSettings& settings,
  const Progress& progress)
{
  const PreparedMesh prepared = prepareMesh(partOf(model, part), {}, subProgress(progress, 0.0, AfterPreparation));
  return proposeGrasps(
    prepared.mesh, symmetriesOf(model), gripperOf(gripper), settings, subProgress(progress, AfterPreparation, 1.0));
}
}
