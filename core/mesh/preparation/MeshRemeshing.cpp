// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/preparation/MeshRemeshing.h"

#include "mesh/FeatureEdges.h"
#include "mesh/TriangleMesh.h"
#include "mesh/preparation/SurfaceMesh.h"

#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>

#include <cmath>

namespace meam
{
namespace
{
constexpr double SharpAngle = FeatureEdgesSettings().angle; // degrees: edges where faces meet at more than this stay
constexpr int Rounds = 3;                                   // of splitting, collapsing, flipping and smoothing

namespace PMP = CGAL::Polygon_mesh_processing;
constexpr double MaximumTriangles = 5e6; // a limit of memory and time
}

TriangleMesh remesh(const TriangleMesh& input, double edgeLength, const Progress& progress)
{
  requireMesh(input);
  if (!(edgeLength > 0.0) || !std::isfinite(edgeLength))
  {
    throw Error("The edge length of the new mesh must be a positive length in mm.");
  }
  SurfaceMesh mesh = toSurfaceMesh(input);
  const double wanted = PMP::area(mesh) / (0.25 * std::sqrt(3.0) * edgeLength * edgeLength);
  if (!(wanted <= MaximumTriangles))
  {
    throw Error("The edge length of the new mesh is too small for the part (it asks for more than " +
                std::to_string(static_cast<int>(MaximumTriangles)) +
                " triangles): enlarge it, or check the unit of the CAD file.");
  }

  auto sharp = mesh.add_property_map<SurfaceMesh::Edge_index, bool>("e:sharp", false).first;
  PMP::detect_sharp_edges(mesh, SharpAngle, sharp);
  std::vector<SurfaceMesh::Edge_index> fixed;
  for (const auto edge : mesh.edges())
  {
    if (sharp[edge] || mesh.is_border(edge))
    {
      sharp[edge] = true;
      fixed.push_back(edge);
    }
  }
  report(progress, 0.1);
  PMP::split_long_edges(fixed, edgeLength, mesh, CGAL::parameters::edge_is_constrained_map(sharp));
  report(progress, 0.2);
  PMP::isotropic_remeshing(mesh.faces(), edgeLength, mesh,
    CGAL::parameters::edge_is_constrained_map(sharp).protect_constraints(true).number_of_iterations(
      static_cast<unsigned>(Rounds)));
  report(progress, 1.0);
  return toTriangleMesh(mesh);
}
}
