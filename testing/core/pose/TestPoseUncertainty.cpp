// SPDX-License-Identifier: BSD-3-Clause
#include "pose/PoseUncertainty.h"

#include <gtest/gtest.h>

TEST(PoseUncertainty, TheEllipsoidHasTheDeviationsOfTheTranslationAboutTheMiddle)
{
  meam::Pose pose;
  pose.T_scene_model.translate(Eigen::Vector3d(10, 20, 30));
  pose.T_scene_model.rotate(Eigen::AngleAxisd(M_PI / 2.0, Eigen::Vector3d::UnitZ()));
  pose.fit.covariance.diagonal() << 9.0, 9.0, 9.0, 0.01, 0.04, 0.25; // scene axes
  const Eigen::Affine3d ellipsoid = meam::uncertaintyEllipsoid(pose, Eigen::Vector3d(5, 0, 0), 10.0);
  EXPECT_TRUE(ellipsoid.translation().isApprox(Eigen::Vector3d(10, 25, 30))) << ellipsoid.translation().transpose();
  const Eigen::Matrix3d shape = ellipsoid.linear() * ellipsoid.linear().transpose(); // the covariance, scaled
  EXPECT_TRUE(shape.isApprox(Eigen::Vector3d(1, 4, 25).asDiagonal().toDenseMatrix())) << shape;
}

TEST(PoseUncertainty, ItIsTurnedAsTheErrorsAre)
{
  meam::Pose pose;
  const Eigen::Vector3d along = Eigen::Vector3d(1, 1, 0).normalized();
  pose.fit.covariance.bottomRightCorner<3, 3>() = along * along.transpose(); // errors along one axis alone
  const Eigen::Affine3d ellipsoid = meam::uncertaintyEllipsoid(pose, Eigen::Vector3d::Zero(), 2.0);
  const Eigen::Matrix3d shape = ellipsoid.linear() * ellipsoid.linear().transpose();
  EXPECT_TRUE(shape.isApprox(4.0 * along * along.transpose(), 1e-6)) << shape;
}
