// SPDX-License-Identifier: BSD-3-Clause
#include "pose/PoseUncertainty.h"

#include "base/Bounds.h"

#include <gtest/gtest.h>

TEST(PoseUncertainty, TheEllipsoidHasTheDeviationsOfTheTranslationAboutTheMiddle)
{
  meam::Pose pose;
  pose.T_scene_model.translate(Eigen::Vector3d(10, 20, 30));
  pose.T_scene_model.rotate(Eigen::AngleAxisd(M_PI / 2.0, Eigen::Vector3d::UnitZ()));
  pose.fit.covariance.diagonal() << 9.0, 9.0, 9.0, 0.01, 0.04, 0.25; // scene axes
  const meam::TriangleMesh ellipsoid = meam::uncertaintyEllipsoid(pose, Eigen::Vector3d(5, 0, 0), 10.0);
  const Eigen::AlignedBox3f box = meam::bounds(ellipsoid.vertices);
  EXPECT_TRUE(box.center().isApprox(Eigen::Vector3f(10, 25, 30), 1e-4f)) << box.center().transpose();
  EXPECT_TRUE(box.sizes().isApprox(Eigen::Vector3f(2, 4, 10), 0.02f)) << box.sizes().transpose();
  meam::requireMesh(ellipsoid);
}

TEST(PoseUncertainty, ItIsTurnedAsTheErrorsAre)
{
  meam::Pose pose;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(M_PI / 4.0, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  pose.fit.covariance.bottomRightCorner<3, 3>() = turn * Eigen::Vector3d(1.0, 0.0, 0.0).asDiagonal() * turn.transpose();
  const Eigen::Vector3f along = turn.col(0).cast<float>();
  for (const Eigen::Vector3f& vertex : meam::uncertaintyEllipsoid(pose, Eigen::Vector3d::Zero(), 2.0).vertices)
  {
    EXPECT_LT((vertex - along * along.dot(vertex)).norm(), 1e-4f); // errors along one axis alone
    EXPECT_LE(vertex.norm(), 2.0f + 1e-4f);
  }
}
