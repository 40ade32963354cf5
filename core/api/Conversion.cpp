// SPDX-License-Identifier: BSD-3-Clause
#include "api/Conversion.h"

#include "base/Bounds.h"
#include "model/TrainedModel.h"

#include <iomanip>
#include <sstream>

namespace meam
{
namespace
{
constexpr double Rounding = 0.01; // of the diameter, by which repairing a mesh may change it

std::string lengthText(double mm)
{
  std::ostringstream text;
  text << std::setprecision(3) << mm << " mm";
  return text.str();
}
}

void requireGrid(const Scan& scan)
{
  if (scan.width < 1 || scan.height < 1 ||
      scan.points.size() != static_cast<std::size_t>(scan.width) * static_cast<std::size_t>(scan.height))
  {
    throw Error("The scan has " + std::to_string(scan.points.size()) + " points and a grid of " +
                std::to_string(scan.width) + " x " + std::to_string(scan.height) +
                ": give a point for each of its places.");
  }
  if (!scan.region.mask.empty() && scan.region.mask.size() != scan.points.size())
  {
    throw Error("The mask of the region has " + std::to_string(scan.region.mask.size()) + " pixels and the scan " +
                std::to_string(scan.points.size()) + " points: give one of the scan's size.");
  }
}

TriangleMesh partOf(const Model& model, const Mesh& part)
{
  TriangleMesh mesh{ part.vertices, part.triangles };
  requireMesh(mesh);
  if (!model)
  {
    return mesh;
  }
  const Eigen::Vector3d sides = bounds(mesh.vertices).cast<double>().sizes();
  const double longest = sides.maxCoeff(), diagonal = sides.norm(), diameter = model.diameter();
  if (longest > (1.0 + Rounding) * diameter || diagonal < (1.0 - Rounding) * diameter)
  {
    throw Error("The mesh is up to " + lengthText(diagonal) + " large and the model's part " + lengthText(diameter) +
                ": give the mesh that the model was trained with, in mm.");
  }
  return mesh;
}

Symmetries symmetriesOf(const Model& model) { return model ? model.trained().symmetries : Symmetries(); }

Gripper gripperOf(const GripperModel& gripper)
{
  Gripper result;
  static_cast<GripperLengths&>(result) = gripper;
  result.mesh = { gripper.mesh.vertices, gripper.mesh.triangles };
  return result;
}
}
