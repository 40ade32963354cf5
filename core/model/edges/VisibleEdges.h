// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "base/Error.h"
#include "base/PointCloud.h"
#include "mesh/LineOfSight.h"
#include "mesh/MeshEdges.h"
#include "mesh/TriangleMesh.h"
#include "model/edges/Silhouette.h"

#include <optional>

namespace meam
{
/// The edges that a viewpoint sees of a prepared mesh: sharp edges, borders of an open mesh, and the
/// occluding contours of round surfaces. The mesh has to outlive this.
class VisibleEdges
{
public:
  /// Faces that meet at more than `sharpAngle` degrees make a sharp edge; less, and they stand for one
  /// round surface. `spacing` (mm) is that of the edge points. Faces seen at less than the cosine `edgeOn` count as
  /// lines.
  VisibleEdges(const TriangleMesh& mesh, double sharpAngle, double spacing, double edgeOn);

  /// Edge points with normals (towards the viewpoint), tangents and types. Points of sharp edges and
  /// borders are the same for every viewpoint that sees them.
  PointCloud seenFrom(
    const Eigen::Vector3d& viewpoint, const Silhouette& silhouette, const Progress& progress = {}) const;

private:
  /// Occluding contours as line segments, each on one face.
  struct Contours
  {
    Points vertices;
    std::vector<std::array<int, 2>> segments;
    std::vector<int> faces;
  };
  /// What a viewpoint sees of an edge point.
  struct SeenPoint
  {
    Eigen::Vector3f normal;
    EdgeType type;
  };

  void findCornerNormals();
  Contours contours(const Eigen::Vector3d& viewpoint) const;
  std::optional<SeenPoint> seeFeature(
    const EdgeSample& sample, const Eigen::Vector3d& viewpoint, const Silhouette& silhouette) const;
  std::optional<SeenPoint> seeContour(
    const EdgeSample& sample, int face, const Eigen::Vector3d& viewpoint, const Silhouette& silhouette) const;
  EdgeType typeOfEnd(const Eigen::Vector3d& point, const Eigen::Vector3d& tangent, const Eigen::Vector3d& outward,
    const Eigen::Vector3d& viewpoint, const Silhouette& silhouette) const;

  const TriangleMesh& Mesh;
  LineOfSight Sight;
  double Spacing;
  double EdgeOn;
  std::vector<MeshEdge> Edges;
  Points FaceNormals;
  std::vector<char> IsFeature;                               ///< of each edge: sharp or a border
  std::vector<std::array<int, 3>> EdgesOfFace;               ///< from each corner to the next
  std::vector<std::array<Eigen::Vector3d, 3>> CornerNormals; ///< of the round surface that the face belongs to
  std::vector<EdgeSample> Features;                          ///< points of sharp edges and borders
};
}
