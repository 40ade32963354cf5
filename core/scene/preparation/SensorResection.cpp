// SPDX-License-Identifier: BSD-3-Clause
#include "scene/preparation/SensorResection.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <vector>

namespace meam
{
namespace
{
constexpr std::size_t ResectionSamples = 5000; // points that are looked at, spread evenly
constexpr std::size_t FewestOfResection = 50;  // twelve numbers are looked for
constexpr double MostPixelsOff = 2.0;          // root mean square: what lenses without distortion's model leave
constexpr double LeastDepth = 1e-3;            // of the cloud's size, which a third direction of the points spans

struct PixelOfPoint
{
  Eigen::Vector4d point; ///< in units of the cloud about its middle, and 1
  Eigen::Vector2d pixel; ///< in widths about the middle
};
}

std::optional<ResectedSensor> resectSensor(const OrganizedCloud& cloud)
{
  std::vector<PixelOfPoint> pixels;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  const std::size_t stride = std::max<std::size_t>(1, cloud.size() / ResectionSamples);
  const Eigen::Vector2d center(0.5 * cloud.width, 0.5 * cloud.height);
  for (std::size_t i = 0; i < cloud.size(); i += stride)
  {
    const Eigen::Vector3d point = cloud.points[i].cast<double>();
    if (point.allFinite())
    {
      const auto width = static_cast<std::size_t>(cloud.width);
      const Eigen::Vector2d pixel(static_cast<double>(i % width), static_cast<double>(i / width));
      pixels.push_back({ point.homogeneous(), (pixel - center) / cloud.width });
      middle += point;
    }
  }
  if (pixels.size() < FewestOfResection)
  {
    return std::nullopt;
  }
  middle /= static_cast<double>(pixels.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (PixelOfPoint& each : pixels)
  {
    each.point.head<3>() -= middle;
    spread += each.point.head<3>() * each.point.head<3>().transpose() / static_cast<double>(pixels.size());
  }
  const Eigen::Vector3d spans =
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvalues().cwiseMax(0.0).cwiseSqrt();
  const double unit = spans[2];
  if (!(spans[0] > LeastDepth * unit))
  {
    return std::nullopt;
  }
  Eigen::Matrix<double, 12, 12> sum = Eigen::Matrix<double, 12, 12>::Zero();
  for (PixelOfPoint& each : pixels)
  {
    each.point.head<3>() /= unit;
    for (int k = 0; k < 2; ++k)
    {
      Eigen::Matrix<double, 12, 1> row = Eigen::Matrix<double, 12, 1>::Zero();
      row.segment<4>(4 * k) = each.point;
      row.tail<4>() = -each.pixel[k] * each.point;
      sum += row * row.transpose();
    }
  }
  const Eigen::Matrix<double, 12, 1> solution =
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 12, 12>>(sum).eigenvectors().col(0);
  Eigen::Matrix<double, 3, 4> P;
  P << solution.segment<4>(0).transpose(), solution.segment<4>(4).transpose(), solution.segment<4>(8).transpose();
  P *= P(2, 3) < 0.0 ? -1.0 : 1.0; // the middle is in front of the sensor
  double off = 0.0;
  for (const PixelOfPoint& each : pixels)
  {
    const Eigen::Vector3d seen = P * each.point;
    if (!(seen.z() > 0.0))
    {
      return std::nullopt;
    }
    off += (seen.hnormalized() - each.pixel).squaredNorm() / static_cast<double>(pixels.size());
  }
  const Eigen::Matrix3d M = P.leftCols<3>();
  const Eigen::Vector3d place = -M.fullPivLu().solve(P.col(3));
  if (!(std::sqrt(off) * cloud.width < MostPixelsOff) || !place.allFinite() || !M.fullPivLu().isInvertible())
  {
    return std::nullopt;
  }
  const Eigen::Vector3d forward = M.row(2).transpose().normalized(), columns = M.row(0).transpose(),
                        rows = M.row(1).transpose();
  const Eigen::Vector3d right = (columns - columns.dot(forward) * forward).normalized(), down = forward.cross(right);
  ResectedSensor result;
  result.T_sensor_scan.linear() << right.transpose(), down.transpose(), forward.transpose();
  result.T_sensor_scan = result.T_sensor_scan * Eigen::Translation3d(-(middle + unit * place));
  result.isMirrored = rows.dot(down) < 0.0;
  return result;
}
}
