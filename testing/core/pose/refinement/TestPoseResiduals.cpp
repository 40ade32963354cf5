// SPDX-License-Identifier: BSD-3-Clause
#include "pose/refinement/PoseResiduals.h"

#include "TestParts.h"

#include <limits>

namespace
{
constexpr float AnyDistance = std::numeric_limits<float>::infinity();

/// A plane z = 1, seen from above in cells of 2.
meam::DepthMap plane() { return { parts::lattice({ 0, 0 }, { 19.5f, 19.5f }, 0.5f, 1.0f), parts::fromAbove(), 2.0 }; }

meam::SoAOrientedPoints columns(const std::vector<std::pair<Eigen::Vector3f, Eigen::Vector3f>>& points)
{
  meam::SoAOrientedPoints result;
  result.resize(points.size());
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    result.set(k, points[k].first, points[k].second.normalized());
  }
  return result;
}
}

TEST(PoseResiduals, OfASurfaceAreAlongItsNormals)
{
  const Eigen::Vector3f up = Eigen::Vector3f::UnitZ();
  // On the plane, half the limit above it, beyond the limit, and beside what was seen.
  const meam::SoAOrientedPoints surface =
    columns({ { { 6, 5, 1 }, up }, { { 8, 5, 2 }, up }, { { 10, 5, 3.5f }, up }, { { 90, 5, 1 }, up } });
  meam::NormalEquations fit(Eigen::Vector3d::Zero());
  meam::addSurfaceResiduals(fit, plane(), surface, { 2.0f, AnyDistance, false });
  const double weight = 0.75 * 0.75; // Tukey's at half the limit
  meam::NormalEquations::Result result = fit.result();
  EXPECT_NEAR(result.weights, 1.0 + weight, 1e-6);
  EXPECT_NEAR(result.squares, weight, 1e-6);
  EXPECT_NEAR(result.information(5, 5), 1.0 + weight, 1e-6) << "the normals are along z";
  EXPECT_EQ(result.information(3, 3), 0.0);

  // More than are looked at together: all the same.
  meam::SoAOrientedPoints many;
  for (int k = 0; k < 700; ++k)
  {
    many.add({ 2.0f + 0.02f * k, 5.0f, 2.0f }, up);
  }
  meam::NormalEquations of700(Eigen::Vector3d::Zero());
  meam::addSurfaceResiduals(of700, plane(), many, { 2.0f, AnyDistance, false });
  EXPECT_NEAR(of700.result().weights, 700 * weight, 1e-3);
  EXPECT_NEAR(of700.result().squares, 700 * weight, 1e-3);

  // Of two points that are as far above the plane one is too far from the mean at its line of sight.
  meam::NormalEquations near(Eigen::Vector3d::Zero());
  meam::addSurfaceResiduals(near, plane(), surface, { 2.0f, 0.9f, false });
  EXPECT_NEAR(near.result().weights, 1.0, 1e-6);
}

TEST(PoseResiduals, OfASurfaceWeighLessNearTheBorderOfACell)
{
  const auto weightAt = [](float x)
  {
    meam::NormalEquations fit(Eigen::Vector3d::Zero());
    meam::addSurfaceResiduals(
      fit, plane(), columns({ { { x, 5.5f, 1 }, Eigen::Vector3f::UnitZ() } }), { 2.0f, AnyDistance, true });
    return fit.result().weights;
  };
  EXPECT_NEAR(weightAt(6.0f), 1.0, 1e-6) << "in the middle";
  EXPECT_NEAR(weightAt(6.5f), 0.75, 1e-6) << "half way";
  EXPECT_NEAR(weightAt(6.999f), 0.0, 1e-2) << "at the border";
}

TEST(PoseResiduals, OfLinesAreAcrossThem)
{
  std::mt19937 random(9);
  for (const Eigen::Vector3f& line : { Eigen::Vector3f(0, 0, 1), Eigen::Vector3f(0, 0, -1),
         Eigen::Vector3f(0.6f, 0, 0.8f), Eigen::Vector3f(2, -3, -1).normalized(), Eigen::Vector3f(1, 0, 0) })
  {
    meam::SoAOrientedPoints lines;
    meam::SoAPoints offsets;
    std::vector<float> weights;
    lines.resize(300); // more than are added together
    Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
    double squares = 0.0;
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - line.cast<double>() * line.cast<double>().transpose();
    for (int k = 0; k < 300; ++k)
    {
      const Eigen::Vector3d point = parts::motion(random, 30.0).translation();
      const Eigen::Vector3d offset = across * parts::motion(random, 1.0).translation();
      lines.set(k, point.cast<float>(), line);
      offsets.add(offset.cast<float>());
      weights.push_back(0.1f * (k % 7));
      Eigen::Matrix<double, 3, 6> motion; // of the point
      motion << 0, point.z(), -point.y(), 1, 0, 0, -point.z(), 0, point.x(), 0, 1, 0, point.y(), -point.x(), 0, 0, 0, 1;
      information += weights.back() * motion.transpose() * across * motion;
      squares += weights.back() * offset.squaredNorm();
    }
    meam::NormalEquations fit(Eigen::Vector3d::Zero());
    meam::addLineResiduals(fit, lines, offsets, weights);
    const meam::NormalEquations::Result result = fit.result();
    EXPECT_TRUE(result.information.isApprox(information, 1e-5)) << line.transpose();
    EXPECT_NEAR(result.squares, squares, 1e-5 * squares) << line.transpose();
  }
}
