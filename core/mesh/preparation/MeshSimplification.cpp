// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/preparation/MeshSimplification.h"

#include "mesh/TriangleMesh.h"
#include "mesh/preparation/MeshDistance.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModHausdorffT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>

namespace meam
{
namespace
{
// Nothing promises that the collapses keep the bound: the result is measured, and they are repeated with less
// tolerance when it does not hold.
constexpr double LeastCosine = 0.26; // of 75 degrees: a triangle turns by less when one of its corners moves
constexpr int Tries = 4;             // then the mesh stays as it is
constexpr double FirstShare = 0.9;   // of the largest error, in the first try; then it shrinks by what was too much
constexpr double LeastNext = 0.2;    // of the last tolerance, the next one at least,
constexpr double MostNext = 0.8;     // and at most

namespace OMD = OpenMesh::Decimater;

struct Traits : OpenMesh::DefaultTraits
{
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

// Twice the area of a triangle, as a share of its longest edge squared, below which it is a line.
constexpr double LeastArea = 1e-7; // rounding

/// Allows a collapse only if the vertex that stays is near to the planes of all faces of the original
/// mesh that have come together in it (Ronfard and Rossignac, "Full-range approximation of triangulated
/// polyhedra", 1996), and if no triangle turns over. Borders have a plane upright on their face.
template <class MeshT>
class ModPlanes : public OMD::ModBaseT<MeshT>
{
public:
  DECIMATING_MODULE(ModPlanes, MeshT, Planes);

  explicit ModPlanes(MeshT& mesh)
    : Base(mesh, true)
  {
    mesh.add_property(this->PlanesAt);
  }
  ~ModPlanes() override { Base::mesh().remove_property(this->PlanesAt); }

  void setTolerance(double tolerance) { this->Tolerance = tolerance; }

  void initialize() override
  {
    const MeshT& mesh = Base::mesh();
    this->Origin = mesh.point(typename MeshT::VertexHandle(0));
    for (const auto vertex : mesh.vertices())
    {
      Base::mesh().property(this->PlanesAt, vertex).clear();
    }
    for (const auto face : mesh.faces())
    {
      const auto normal = mesh.calc_face_normal(face);
      for (const auto halfedge : mesh.fh_range(face))
      {
        const auto from = mesh.from_vertex_handle(halfedge);
        const auto to = mesh.to_vertex_handle(halfedge);
        this->add(from, normal);
        if (mesh.is_boundary(mesh.opposite_halfedge_handle(halfedge)))
        {
          const auto upright = ((mesh.point(to) - mesh.point(from)) % normal).normalized();
          this->add(from, upright);
          this->add(to, upright);
        }
      }
    }
  }

  float collapse_priority(const CollapseInfo& collapse) override
  {
    const MeshT& mesh = Base::mesh();
    const auto target = collapse.p1 - this->Origin;
    for (const int plane : mesh.property(this->PlanesAt, collapse.v0))
    {
      const Plane& p = this->Planes[plane];
      if (std::abs((p.normal | target) - p.offset) > this->Tolerance)
      {
        return Base::ILLEGAL_COLLAPSE;
      }
    }
    for (const auto face : mesh.vf_range(collapse.v0))
    {
      if (face != collapse.fl && face != collapse.fr && !this->keepsItsSide(face, collapse))
      {
        return Base::ILLEGAL_COLLAPSE;
      }
    }
    return Base::LEGAL_COLLAPSE;
  }

  void postprocess_collapse(const CollapseInfo& collapse) override
  {
    auto& gone = Base::mesh().property(this->PlanesAt, collapse.v0);
    auto& stays = Base::mesh().property(this->PlanesAt, collapse.v1);
    std::vector<int> all;
    std::set_union(gone.begin(), gone.end(), stays.begin(), stays.end(), std::back_inserter(all));
    stays.swap(all);
    gone = {};
  }

private:
  using Vector = typename MeshT::Point;
  struct Plane
  {
    Vector normal;
    double offset;
  };

  /// Planes that are the same to within rounding are kept once: a flat face is one, however fine.
  void add(typename MeshT::VertexHandle vertex, const Vector& normal)
  {
    const Plane plane{ normal, normal | (Base::mesh().point(vertex) - this->Origin) };
    const std::array<long long, 4> key = { std::llround(1e6 * normal[0]), std::llround(1e6 * normal[1]),
      std::llround(1e6 * normal[2]), std::llround(1e3 * plane.offset / this->Tolerance) };
    const auto [place, added] = this->Numbers.emplace(key, static_cast<int>(this->Planes.size()));
    if (added)
    {
      this->Planes.push_back(plane);
    }
    auto& planes = Base::mesh().property(this->PlanesAt, vertex);
    const auto at = std::lower_bound(planes.begin(), planes.end(), place->second);
    if (at == planes.end() || *at != place->second)
    {
      planes.insert(at, place->second);
    }
  }

  bool keepsItsSide(typename MeshT::FaceHandle face, const CollapseInfo& collapse)
  {
    const MeshT& mesh = Base::mesh();
    std::array<Vector, 3> before;
    std::array<Vector, 3> after;
    int k = 0;
    for (const auto vertex : mesh.fv_range(face))
    {
      before[k] = mesh.point(vertex);
      after[k] = vertex == collapse.v0 ? collapse.p1 : before[k];
      ++k;
    }
    const Vector old = (before[1] - before[0]) % (before[2] - before[0]);
    const Vector now = (after[1] - after[0]) % (after[2] - after[0]);
    const double longest =
      std::max({ (after[1] - after[0]).sqrnorm(), (after[2] - after[1]).sqrnorm(), (after[0] - after[2]).sqrnorm() });
    return now.norm() > LeastArea * longest && (old | now) > LeastCosine * old.norm() * now.norm();
  }

  double Tolerance = 0.0;
  Vector Origin;
  std::vector<Plane> Planes;
  std::map<std::array<long long, 4>, int> Numbers;
  OpenMesh::VPropHandleT<std::vector<int>> PlanesAt; ///< numbers in Planes, ascending
};

/// Passes progress on; its wish to stop comes out of the decimater as an exception.
class ProgressObserver : public OMD::Observer
{
public:
  ProgressObserver(const Progress& progress, std::size_t vertices)
    : Observer(512)
    , Callback(progress)
    , Vertices(static_cast<double>(vertices))
  {
  }
  void notify(std::size_t step) override { report(this->Callback, static_cast<double>(step) / this->Vertices); }

private:
  const Progress& Callback;
  double Vertices;
};

Mesh toOpenMesh(const TriangleMesh& mesh)
{
  Mesh result;
  result.request_vertex_status();
  result.request_edge_status();
  result.request_face_status();
  for (const auto& vertex : mesh.vertices)
  {
    result.add_vertex(Mesh::Point(vertex.x(), vertex.y(), vertex.z()));
  }
  for (const auto& triangle : mesh.triangles)
  {
    result.add_face(
      result.vertex_handle(triangle[0]), result.vertex_handle(triangle[1]), result.vertex_handle(triangle[2]));
  }
  if (result.n_faces() != mesh.triangles.size())
  {
    throw Error("The mesh cannot be simplified: more than two of its faces meet at an edge. Prepare it first, or set "
                "the largest error of its simplification to 0.");
  }
  return result;
}

TriangleMesh fromOpenMesh(Mesh& mesh)
{
  mesh.delete_isolated_vertices();
  mesh.garbage_collection();
  TriangleMesh result;
  for (const auto vertex : mesh.vertices())
  {
    const auto& point = mesh.point(vertex);
    result.vertices.emplace_back(
      static_cast<float>(point[0]), static_cast<float>(point[1]), static_cast<float>(point[2]));
  }
  for (const auto face : mesh.faces())
  {
    Eigen::Vector3i triangle;
    int k = 0;
    for (const auto vertex : mesh.fv_range(face))
    {
      triangle[k++] = vertex.idx();
    }
    result.triangles.push_back(triangle);
  }
  return result;
}

TriangleMesh collapsed(const TriangleMesh& mesh, double tolerance, const Progress& progress)
{
  Mesh result = toOpenMesh(mesh);
  {
    OMD::DecimaterT<Mesh> decimater(result);
    ModPlanes<Mesh>::Handle planes;
    OMD::ModHausdorffT<Mesh>::Handle distance;
    OMD::ModQuadricT<Mesh>::Handle order; // the cheapest collapse comes first
    decimater.add(planes);
    decimater.add(distance);
    decimater.add(order);
    decimater.module(planes).setTolerance(tolerance);
    decimater.module(distance).set_tolerance(tolerance);
    decimater.initialize();
    ProgressObserver observer(progress, mesh.vertices.size());
    decimater.set_observer(&observer);
    decimater.decimate();
  }
  return fromOpenMesh(result);
}
}

TriangleMesh simplifyMesh(const TriangleMesh& mesh, double maximumError, const Progress& progress)
{
  requireMesh(mesh);
  if (!(maximumError > 0.0) || !std::isfinite(maximumError))
  {
    throw Error("The largest error of the simplified mesh must be a positive length in mm.");
  }
  const double ofTry = 1.0 / Tries; // of the progress
  double tolerance = FirstShare * maximumError;
  for (int i = 0; i < Tries; ++i)
  {
    const Progress share = subProgress(progress, ofTry * i, ofTry * (i + 1));
    TriangleMesh result = collapsed(mesh, tolerance, subProgress(share, 0.0, 0.8));
    const double distance = meshDistance(mesh, result, subProgress(share, 0.8, 1.0));
    if (distance <= maximumError)
    {
      return result;
    }
    tolerance *= std::clamp(FirstShare * maximumError / distance, LeastNext, MostNext);
  }
  return mesh;
}
}
