// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/preparation/MeshOrientation.h"

#include <CGAL/Polygon_mesh_processing/orientation.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace meam
{
namespace
{
namespace PMP = CGAL::Polygon_mesh_processing;

// Six times the volume behind an open mesh, of the area to the power of 1.5: with less it is nearly flat and has no
// outside, and its winding stays.
constexpr double LeastHollow = 6e-3;

/// Six times the volume between each component and its middle, with the sign of its winding.
std::vector<double> signedVolumes(const SurfaceMesh& mesh, const FaceNumbers& componentOf, std::size_t components)
{
  std::vector<Eigen::Vector3d> sums(components, Eigen::Vector3d::Zero());
  std::vector<double> counts(components, 0.0);
  std::vector<double> volumes(components, 0.0);
  for (const auto face : mesh.faces())
  {
    sums[componentOf[face]] += cornersOf(mesh, face).rowwise().mean();
    counts[componentOf[face]] += 1.0;
  }
  for (const auto face : mesh.faces())
  {
    const std::size_t component = componentOf[face];
    const Eigen::Matrix3d corners = cornersOf(mesh, face).colwise() - sums[component] / counts[component];
    volumes[component] += corners.determinant();
  }
  return volumes;
}
}

int orientOutward(SurfaceMesh& mesh, bool crossesItself)
{
  FaceNumbers componentOf;
  const std::vector<double> areas = componentAreas(mesh, componentOf);
  const std::size_t components = areas.size();
  if (!CGAL::is_closed(mesh))
  {
    // Each component may be a patch of one body, the wall of a hole for one: only all of them
    // together can tell. A sheet that is nearly flat has no outside: its winding is the user's.
    for (const auto face : mesh.faces())
    {
      componentOf[face] = 0;
    }
    const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
    if (signedVolumes(mesh, componentOf, 1)[0] >= -LeastHollow * std::pow(area, 1.5))
    {
      return 0;
    }
    PMP::reverse_face_orientations(mesh);
    return static_cast<int>(components);
  }

  const std::vector<double> before = signedVolumes(mesh, componentOf, components);
  int flipped = 0;
  if (components > 1 && !crossesItself)
  {
    // Cavities inside a body must stay turned inwards.
    PMP::orient_to_bound_a_volume(mesh);
    const std::vector<double> after = signedVolumes(mesh, componentOf, components);
    for (std::size_t c = 0; c < components; ++c)
    {
      flipped += (before[c] < 0.0) != (after[c] < 0.0);
    }
    return flipped;
  }
  for (std::size_t c = 0; c < components; ++c)
  {
    if (before[c] < 0.0)
    {
      std::vector<SurfaceMesh::Face_index> faces;
      std::copy_if(mesh.faces_begin(), mesh.faces_end(), std::back_inserter(faces),
        [&](SurfaceMesh::Face_index face) { return componentOf[face] == c; });
      PMP::reverse_face_orientations(faces, mesh);
      ++flipped;
    }
  }
  return flipped;
}
}
