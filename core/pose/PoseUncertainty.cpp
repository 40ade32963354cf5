// SPDX-License-Identifier: BSD-3-Clause
#include "pose/PoseUncertainty.h"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace meam
{
namespace
{
/// Rings of vertices from pole to pole.
TriangleMesh unitSphere(int rings)
{
  const int sectors = 2 * rings;
  TriangleMesh sphere;
  for (int ring = 0; ring <= rings; ++ring)
  {
    const double polar = M_PI * ring / rings;
    for (int sector = 0; sector < sectors; ++sector)
    {
      const double around = 2.0 * M_PI * sector / sectors;
      sphere.vertices.emplace_back(
        std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), std::cos(polar));
    }
  }
  for (int ring = 0; ring < rings; ++ring)
  {
    for (int sector = 0; sector < sectors; ++sector)
    {
      const int next = (sector + 1) % sectors, above = ring * sectors, below = above + sectors;
      if (ring > 0)
      {
        sphere.triangles.emplace_back(above + sector, below + sector, above + next);
      }
      if (ring + 1 < rings)
      {
        sphere.triangles.emplace_back(above + next, below + sector, below + next);
      }
    }
  }
  return sphere;
}
}

TriangleMesh uncertaintyEllipsoid(const Pose& pose, const Eigen::Vector3d& middle, double deviations, int rings)
{
  const Eigen::Matrix3d covariance = pose.fit.covariance.bottomRightCorner<3, 3>();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(covariance);
  const Eigen::Matrix3d toAxes =
    deviations * axes.eigenvectors() * axes.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  TriangleMesh mesh = unitSphere(rings);
  for (Eigen::Vector3f& vertex : mesh.vertices)
  {
    vertex = (pose.T_scene_model * middle + toAxes * vertex.cast<double>()).cast<float>();
  }
  return mesh;
}
}
