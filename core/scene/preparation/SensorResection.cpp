// SPDX-License-Identifier: BSD-3-Clause
#include "scene/preparation/SensorResection.h"

#include "base/sequences/Sequences.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <opencv2/core.hpp>

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
constexpr double AsWell = 2.0;                 // times as far off: less perspective than so is none,
constexpr double Rounding = 1e-3;              // or than so many pixels, which rounded coordinates are off
constexpr double Singular = 1e-12;             // of the cube of a matrix's norm, its determinant: rounding
constexpr double LeastDepth = 1e-3;            // of the cloud's size, which a third direction of the points spans

struct PixelOfPoint
{
  Eigen::Vector4d point; ///< in units of the cloud about its middle, and 1
  Eigen::Vector2d pixel; ///< in widths about the middle
};

Eigen::Matrix3d axesLooking(const Eigen::Vector3d& columns, const Eigen::Vector3d& forward)
{
  const Eigen::Vector3d right = (columns - columns.dot(forward) * forward).normalized(), down = forward.cross(right);
  Eigen::Matrix3d axes;
  axes << right.transpose(), down.transpose(), forward.transpose();
  return axes;
}

/// Its translation is where the sensor is, in units from the middle.
std::optional<ResectedSensor> resectPinhole(const std::vector<PixelOfPoint>& pixels)
{
  cv::Matx<double, 12, 12> sum; // by OpenCV: Eigen's decompositions of this size take half a minute to compile
  for (const PixelOfPoint& each : pixels)
  {
    for (int k = 0; k < 2; ++k)
    {
      cv::Matx<double, 12, 1> row;
      for (int i = 0; i < 4; ++i)
      {
        row(4 * k + i) = each.point[i];
        row(8 + i) = -each.pixel[k] * each.point[i];
      }
      sum += row * row.t();
    }
  }
  cv::Mat1d solution;
  cv::SVD::solveZ(sum, solution);
  Eigen::Matrix<double, 3, 4> P;
  for (int i = 0; i < 12; ++i)
  {
    P(i / 4, i % 4) = solution(i);
  }
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
  ResectedSensor result;
  Eigen::Matrix3d inverse;
  bool isInvertible = false;
  M.computeInverseWithCheck(inverse, isInvertible, Singular * std::pow(M.norm(), 3));
  if (!isInvertible)
  {
    return std::nullopt;
  }
  result.T_sensor_scan.translation() = -inverse * P.col(3);
  result.T_sensor_scan.linear() = axesLooking(M.row(0).transpose(), M.row(2).transpose().normalized());
  result.isMirrored = M.row(1).dot(result.T_sensor_scan.linear().row(1)) < 0.0;
  result.off = std::sqrt(off);
  return result;
}

ResectedSensor resectOrthographic(const std::vector<PixelOfPoint>& pixels)
{
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  Eigen::Matrix<double, 4, 2> ofPixels = Eigen::Matrix<double, 4, 2>::Zero();
  for (const PixelOfPoint& each : pixels)
  {
    sum += each.point * each.point.transpose();
    ofPixels += each.point * each.pixel.transpose();
  }
  const Eigen::Matrix<double, 4, 2> fit = sum.inverse() * ofPixels;
  ResectedSensor result;
  result.perspective = false;
  for (const PixelOfPoint& each : pixels)
  {
    result.off += (fit.transpose() * each.point - each.pixel).squaredNorm() / static_cast<double>(pixels.size());
  }
  result.off = std::sqrt(result.off);
  const Eigen::Vector3d columns = fit.col(0).head<3>(), rows = fit.col(1).head<3>();
  result.T_sensor_scan.linear() = axesLooking(columns, columns.cross(rows).normalized());
  return result;
}
}

std::vector<GridSample> samplesOf(const OrganizedCloud& cloud)
{
  std::vector<GridSample> samples;
  const std::size_t stride = std::max<std::size_t>(1, cloud.size() / ResectionSamples);
  const Eigen::Vector2d center(0.5 * cloud.width, 0.5 * cloud.height);
  const auto width = static_cast<std::size_t>(cloud.width);
  for (std::size_t i = 0; i < cloud.size(); i += stride)
  {
    if (cloud.points[i].allFinite())
    {
      const Eigen::Vector2d pixel(static_cast<double>(i % width), static_cast<double>(i / width));
      samples.push_back({ cloud.points[i].cast<double>(), (pixel - center) / cloud.width });
    }
  }
  const auto isBefore = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b)
  { return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3); };
  auto sorted = mapped<Eigen::Vector3d>(samples, [&](const GridSample& sample) { return sample.point; });
  std::sort(sorted.begin(), sorted.end(), isBefore);
  const auto isShared = [&](const GridSample& sample)
  {
    const auto [first, last] = std::equal_range(sorted.begin(), sorted.end(), sample.point, isBefore);
    return last - first > 1;
  };
  eraseIf(samples, isShared);
  return samples;
}

std::optional<ResectedSensor> resectSensor(const std::vector<GridSample>& samples, int width)
{
  if (samples.size() < FewestOfResection)
  {
    return std::nullopt;
  }
  std::vector<PixelOfPoint> pixels;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const GridSample& sample : samples)
  {
    pixels.push_back({ sample.point.homogeneous(), sample.pixel });
    middle += sample.point;
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
  for (PixelOfPoint& each : pixels)
  {
    each.point.head<3>() /= unit;
  }
  std::optional<ResectedSensor> sensor = resectPinhole(pixels);
  const ResectedSensor orthographic = resectOrthographic(pixels);
  if (!sensor || orthographic.off <= AsWell * sensor->off + Rounding / width)
  {
    sensor = orthographic;
  }
  if (!(sensor->off * width < MostPixelsOff))
  {
    return std::nullopt;
  }
  if (sensor->perspective) // from the middle, in units, to the cloud's own coordinates
  {
    const Eigen::Vector3d place = middle + unit * sensor->T_sensor_scan.translation();
    sensor->T_sensor_scan.translation().setZero();
    sensor->T_sensor_scan = sensor->T_sensor_scan * Eigen::Translation3d(-place);
  }
  return sensor;
}
}
