// SPDX-License-Identifier: BSD-3-Clause
#include "TestParts.h"
#include "base/Frames.h"
#include "base/PointCloud.h"
#include "base/sequences/Sequences.h"

#include <cmath>
#include <tuple>

TEST(Frames, FrameIsRightHandedWithTheAxisFirst)
{
  for (const Eigen::Vector3f& axis :
    { Eigen::Vector3f(1, 0, 0), Eigen::Vector3f(0, 0, -1), Eigen::Vector3f(1, 2, -3).normalized().eval() })
  {
    const Eigen::Matrix3f frame = meam::frameAround(axis);
    EXPECT_TRUE(frame.col(0).isApprox(axis));
    EXPECT_TRUE(frame.isUnitary(1e-6f));
    EXPECT_NEAR(frame.determinant(), 1.0f, 1e-6f);
  }
}

TEST(Frames, RigidMatricesAreRotationsAndTranslations)
{
  const double numbers[] = { 0, -1, 0, 10, 1, 0, 0, 20, 0, 0, 1.0004, 30, 0, 0, 0, 1 };
  Eigen::Matrix4d matrix = meam::transformOf(numbers).matrix();
  EXPECT_EQ(matrix(1, 3), 20.0);
  EXPECT_TRUE(meam::isRigid(matrix));
  for (const auto& [row, column, value] : { std::tuple(2, 2, 1.01), { 2, 2, -1.0 }, { 0, 3, NAN }, { 3, 0, 1e-6 } })
  {
    Eigen::Matrix4d other = matrix;
    other(row, column) = value;
    EXPECT_FALSE(meam::isRigid(other)) << other;
  }
}

TEST(Frames, RotationsOfThreeDecimalsAreTakenAndMadeExact)
{
  std::mt19937 random(7);
  for (int k = 0; k < 500; ++k)
  {
    const Eigen::Isometry3d T = parts::motion(random, 500.0);
    const auto printed = [&T](double steps)
    {
      Eigen::Matrix4d matrix = T.matrix();
      matrix.topLeftCorner<3, 3>() = (steps * matrix.topLeftCorner<3, 3>()).array().round() / steps;
      return matrix;
    };
    const auto exact = meam::rigidOf(printed(1e3));
    ASSERT_TRUE(exact);
    EXPECT_TRUE(exact->linear().isUnitary(1e-12));
    EXPECT_LT((exact->linear() - T.linear()).cwiseAbs().maxCoeff(), 1.5e-3);
    EXPECT_EQ(meam::rigidOf(T.matrix())->matrix(), T.matrix()) << "what is exact stays to the last bit";
    Eigen::Matrix4d scaled = printed(1e3);
    scaled.topLeftCorner<3, 3>() *= 1.002;
    EXPECT_FALSE(meam::rigidOf(scaled)) << scaled;
  }
}

TEST(Frames, ThePrincipalFrameMovesWithThePoints)
{
  std::mt19937 random(4);
  std::gamma_distribution<float> skewed(2.0f, 1.0f);
  const auto points = meam::ofIndices<Eigen::Vector3f>(300,
    [&](int) {
      return Eigen::Vector3f{ 9.0f * skewed(random), 4.0f * skewed(random), skewed(random) };
    });
  const Eigen::Isometry3d frame = meam::principalFrame(parts::precise(points));
  EXPECT_NEAR(frame.linear().determinant(), 1.0, 1e-9);
  EXPECT_GT(std::abs(frame.linear()(0, 0)), 0.9) << "most extent along x";
  const meam::Points inFrame = meam::moved(points, frame);
  const Eigen::Isometry3d T = parts::motion(random, 100.0);
  meam::Points elsewhere = meam::moved(points, T);
  elsewhere.push_back(Eigen::Vector3f::Constant(NAN));
  const meam::Points again = meam::moved(elsewhere, meam::principalFrame(parts::precise(elsewhere)));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    EXPECT_LT((inFrame[i] - again[i]).norm(), 1e-3f);
  }
  EXPECT_TRUE(meam::principalFrame({}).isApprox(Eigen::Isometry3d::Identity()));
}
