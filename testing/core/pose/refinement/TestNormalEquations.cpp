// SPDX-License-Identifier: BSD-3-Clause
#include "pose/refinement/NormalEquations.h"

#include "TestParts.h"

namespace
{
struct Residual
{
  Eigen::Vector3d point, direction;
  double value, weight;
};

std::vector<Residual> residuals(int count, const Eigen::Isometry3d& motion)
{
  std::mt19937 random(3);
  std::vector<Residual> all;
  for (int k = 0; k < count; ++k)
  {
    const Eigen::Vector3d point = parts::motion(random, 30.0).translation();
    const Eigen::Vector3d direction = parts::motion(random, 1.0).linear().col(0);
    all.push_back({ point, direction, direction.dot(point - motion * point), 0.5 + 0.1 * (k % 5) });
  }
  return all;
}
}

TEST(NormalEquations, SumsAreThoseOfAllResiduals)
{
  // Fewer, as many and more than are summed at once.
  for (const int count : { 1, 7, 8, 9, 61 })
  {
    const Eigen::Vector3d centre(4, -2, 9);
    meam::NormalEquations fit(centre);
    Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
    double weights = 0.0, squares = 0.0;
    for (const Residual& r : residuals(count, Eigen::Isometry3d(Eigen::Translation3d(0.1, 0.2, 0.3))))
    {
      fit.add(r.point, r.direction, r.value, r.weight);
      Eigen::Matrix<double, 6, 1> row;
      row << (r.point - centre).cross(r.direction), r.direction;
      information += r.weight * row * row.transpose();
      weights += r.weight;
      squares += r.weight * r.value * r.value;
    }
    const meam::NormalEquations::Result result = fit.result();
    EXPECT_TRUE(result.information.isApprox(information, 1e-12)) << count;
    EXPECT_NEAR(result.weights, weights, 1e-12);
    EXPECT_NEAR(result.squares, squares, 1e-12);
  }
}

TEST(NormalEquations, RowsAreTheSameAsOneByOne)
{
  for (const int count : { 0, 1, 8, 61, meam::NormalEquations::Rows::Most })
  {
    const Eigen::Vector3d centre(4, -2, 9);
    meam::NormalEquations one(centre), rowwise(centre);
    for (const Residual& r : residuals(3, Eigen::Isometry3d::Identity())) // some that wait to be summed
    {
      one.add(r.point, r.direction, 0.5, r.weight);
      rowwise.add(r.point, r.direction, 0.5, r.weight);
    }
    meam::NormalEquations::Rows rows;
    rows.count = count;
    const std::vector<Residual> all = residuals(count, Eigen::Isometry3d(Eigen::Translation3d(0.1, 0.2, 0.3)));
    for (int k = 0; k < count; ++k)
    {
      const Residual& r = all[k];
      rows.x[k] = static_cast<float>(r.point.x());
      rows.y[k] = static_cast<float>(r.point.y());
      rows.z[k] = static_cast<float>(r.point.z());
      rows.directionX[k] = static_cast<float>(r.direction.x());
      rows.directionY[k] = static_cast<float>(r.direction.y());
      rows.directionZ[k] = static_cast<float>(r.direction.z());
      rows.residual[k] = static_cast<float>(r.value);
      rows.weight[k] = static_cast<float>(r.weight);
      one.add(Eigen::Vector3d(rows.x[k], rows.y[k], rows.z[k]),
        Eigen::Vector3d(rows.directionX[k], rows.directionY[k], rows.directionZ[k]), rows.residual[k], rows.weight[k]);
    }
    rowwise.add(rows);
    const meam::NormalEquations::Result expected = one.result(), result = rowwise.result();
    EXPECT_TRUE(result.information.isApprox(expected.information, 1e-12)) << count;
    EXPECT_NEAR(result.weights, expected.weights, 1e-12 * expected.weights);
    EXPECT_NEAR(result.squares, expected.squares, 1e-12 * expected.squares);
  }
}

TEST(NormalEquations, FindsASmallMotion)
{
  Eigen::Isometry3d motion(Eigen::Translation3d(0.02, -0.01, 0.03));
  motion.rotate(Eigen::AngleAxisd(1e-4, Eigen::Vector3d(1, 2, -2).normalized()));
  meam::NormalEquations fit(Eigen::Vector3d(1, 2, 3));
  for (const Residual& r : residuals(40, motion))
  {
    fit.add(r.point, r.direction, r.value, r.weight);
  }
  EXPECT_TRUE(fit.result().motion.isApprox(motion, 1e-4)); // damped
}

TEST(NormalEquations, TellsWhatRemainsAfterTheMotion)
{
  // A turn so small that residuals are linear in it, and noise that no motion takes away.
  Eigen::Isometry3d motion(Eigen::Translation3d(0.02, -0.01, 0.03));
  motion.rotate(Eigen::AngleAxisd(1e-5, Eigen::Vector3d(1, 2, -2).normalized()));
  meam::NormalEquations before(Eigen::Vector3d(1, 2, 3)), after(Eigen::Vector3d(1, 2, 3));
  std::vector<Residual> all = residuals(40, motion);
  for (std::size_t k = 0; k < all.size(); ++k)
  {
    all[k].value += k % 2 ? 0.005 : -0.005;
    before.add(all[k].point, all[k].direction, all[k].value, all[k].weight);
  }
  const meam::NormalEquations::Result result = before.result();
  for (const Residual& r : all)
  {
    const double moved = r.value + r.direction.dot(result.motion * r.point - r.point);
    after.add(r.point, r.direction, moved, r.weight);
  }
  EXPECT_LT(result.remaining, 0.5 * result.squares);
  EXPECT_NEAR(result.remaining, after.result().squares, 1e-4 * result.remaining);
}

TEST(NormalEquations, WithoutResidualsNothingMoves)
{
  EXPECT_TRUE(meam::NormalEquations(Eigen::Vector3d(5, 6, 7)).result().motion.isApprox(Eigen::Isometry3d::Identity()));
}
