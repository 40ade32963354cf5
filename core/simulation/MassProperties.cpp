// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/MassProperties.h"

#include "base/Bounds.h"
#include "mesh/TriangleMesh.h"

#include <Eigen/Eigenvalues>

namespace meam
{
MassProperties massProperties(const TriangleMesh& mesh, bool closed)
{
  // The integrals of 1, x and x x^T over the tetrahedra that the faces span with a point, or over the faces.
  const Eigen::Vector3d apex = bounds(mesh.vertices).center().cast<double>();
  double mass = 0.0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (const auto& triangle : mesh.triangles)
  {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k)
    {
      corners.col(k) = mesh.vertices[triangle[k]].cast<double>() - apex;
    }
    const double share = closed ? corners.determinant() / 6.0
                                : 0.5 * (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)).norm();
    const Eigen::Vector3d sum = corners.rowwise().sum();
    mass += share;
    first += share / (closed ? 4.0 : 3.0) * sum;
    second += share / (closed ? 20.0 : 12.0) * (corners * corners.transpose() + sum * sum.transpose());
  }
  const Eigen::Vector3d centre = first / mass;
  const Eigen::Matrix3d spread = second / mass - centre * centre.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(spread);

  MassProperties result;
  Eigen::Matrix3d axes = principal.eigenvectors();
  axes.col(2) *= axes.determinant() < 0.0 ? -1.0 : 1.0;
  result.T_model_body.linear() = axes;
  result.T_model_body.translation() = apex + centre;
  result.inertia = (spread.trace() - principal.eigenvalues().array()).matrix();
  return result;
}
}
