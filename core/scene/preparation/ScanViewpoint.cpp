// SPDX-License-Identifier: BSD-3-Clause
#include "scene/preparation/ScanViewpoint.h"

#include "scene/preparation/SensorResection.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace meam
{
namespace
{
const double Oblique = std::cos(M_PI / 4.0);    // of the mean direction: nearer to another axis than to this
const double MostAside = std::cos(M_PI / 6.0);  // of a sensor's frame, how far its scan's middle is beside its axis,
const double WidestView = std::cos(M_PI / 3.0); // and how far it sees beside it
constexpr double MostOff = 0.02;          // of the width, root mean square, that pixels are off a pinhole camera's
constexpr double StrayDirections = 0.001; // share of the points that may lie elsewhere
constexpr std::size_t DirectionSamples = 20000; // points that are looked at, spread evenly

/// Along the axis of that number, with the sign of the value.
Eigen::Vector3d axisOf(int number, double sign) { return (sign < 0.0 ? -1.0 : 1.0) * Eigen::Vector3d::Unit(number); }

Eigen::Isometry3d frameLooking(const Eigen::Vector3d& right, const Eigen::Vector3d& forward)
{
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear().row(0) = right.transpose();
  T.linear().row(1) = forward.cross(right).transpose();
  T.linear().row(2) = forward.transpose();
  return T;
}

std::string nameOfAxis(const Eigen::Vector3d& axis)
{
  Eigen::Index number = 0;
  axis.cwiseAbs().maxCoeff(&number);
  return std::string(axis[number] < 0.0 ? "-" : "+") + "xyz"[number];
}

/// The unit directions of some points from the origin.
std::vector<Eigen::Vector3d> directionsOf(const Points& points)
{
  std::vector<Eigen::Vector3d> directions;
  const std::size_t stride = std::max<std::size_t>(1, points.size() / DirectionSamples);
  for (std::size_t i = 0; i < points.size(); i += stride)
  {
    const Eigen::Vector3d point = points[i].cast<double>();
    if (point.allFinite() && point.norm() > 0.0)
    {
      directions.push_back(point.normalized());
    }
  }
  return directions;
}

Eigen::Vector3d meanDirection(const std::vector<Eigen::Vector3d>& directions)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& direction : directions)
  {
    sum += direction;
  }
  return directions.empty() ? sum : (sum / static_cast<double>(directions.size())).eval();
}

/// Whether all but strays lie within an angle about an axis.
bool liesAhead(const std::vector<Eigen::Vector3d>& directions, const Eigen::Vector3d& axis, double cosine)
{
  const auto isAside = [&](const Eigen::Vector3d& direction) { return direction.dot(axis) < cosine; };
  return static_cast<double>(std::count_if(directions.begin(), directions.end(), isAside)) <=
         StrayDirections * static_cast<double>(directions.size());
}

/// The sum of the steps of the points' rays, seen from the origin along an axis, from one place of the grid to the
/// next.
Eigen::Vector3d stepsOf(const OrganizedCloud& cloud, int places, const Eigen::Vector3d& axis)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const std::size_t step = static_cast<std::size_t>(places);
  const std::size_t stride = std::max<std::size_t>(1, cloud.size() / DirectionSamples);
  for (std::size_t i = 0; i + step < cloud.size(); i += stride)
  {
    const Eigen::Vector3d from = cloud.points[i].cast<double>(), to = cloud.points[i + step].cast<double>();
    const bool goesOn = places > 1 || (i + 1) % static_cast<std::size_t>(cloud.width) != 0;
    if (goesOn && from.dot(axis) > 0.0 && to.dot(axis) > 0.0)
    {
      sum += to / to.dot(axis) - from / from.dot(axis);
    }
  }
  return sum;
}

/// Whether pixels follow the rays from the origin, but for what lenses make of them.
bool isPinhole(const OrganizedCloud& cloud, const Eigen::Vector3d& axis)
{
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> ofPixels = Eigen::Matrix<double, 3, 2>::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  double count = 0.0;
  const std::size_t stride = std::max<std::size_t>(1, cloud.size() / DirectionSamples);
  for (std::size_t i = 0; i < cloud.size(); i += stride)
  {
    const Eigen::Vector3d point = cloud.points[i].cast<double>();
    if (point.dot(axis) > 0.0)
    {
      const auto width = static_cast<std::size_t>(cloud.width);
      const Eigen::Vector2d pixel(static_cast<double>(i % width), static_cast<double>(i / width));
      const Eigen::Vector3d ray = point / point.dot(axis); // 1 along the axis: what is ahead has a pixel, too
      sum += ray * ray.transpose();
      ofPixels += ray * pixel.transpose();
      squares += pixel * pixel.transpose();
      count += 1.0;
    }
  }
  const Eigen::Matrix<double, 3, 2> fit = sum.ldlt().solve(ofPixels);
  const double off = (squares - fit.transpose() * ofPixels).trace() / std::max(count, 1.0);
  return std::sqrt(std::max(off, 0.0)) < MostOff * cloud.width;
}

std::string placeText(const Eigen::Vector3d& place, const char* form)
{
  char text[100];
  std::snprintf(text, sizeof text, form, place.x(), place.y(), place.z());
  return text;
}

void tellOfMirror(std::string& report)
{
  report += std::string(report.empty() ? "" : " ") +
            "The scan's rows or columns run backwards: either they are stored from the other side, which does not "
            "matter, or its axes are left-handed, and parts come out mirrored: negate y then.";
}

/// Of a cloud that is not in its sensor's frame.
ScanViewpoint viewpointInWorld(const OrganizedCloud& cloud)
{
  ScanViewpoint result;
  if (const std::optional<ResectedSensor> sensor = resectSensor(cloud))
  {
    result.T_sensor_scan = sensor->T_sensor_scan;
    const Eigen::Isometry3d T_scan_sensor = sensor->T_sensor_scan.inverse();
    result.report = "The scan is not in its sensor's frame: by where the points lie on the grid the sensor is at " +
                    placeText(T_scan_sensor.translation(), "(%.0f, %.0f, %.0f)") + " and looks along " +
                    placeText(T_scan_sensor.linear().col(2), "(%.2f, %.2f, %.2f)") + ".";
    if (sensor->isMirrored)
    {
      tellOfMirror(result.report);
    }
  }
  return result;
}
}

Eigen::Vector3d lookingDirection(const Sensor& sensor, const Points& points)
{
  if (!sensor.perspective || !sensor.direction.isZero(0.0))
  {
    return sensor.direction.allFinite() ? sensor.direction.normalized() : Eigen::Vector3d::Zero().eval();
  }
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0.0;
  for (const Eigen::Vector3f& point : points)
  {
    if (point.allFinite())
    {
      sum += point.cast<double>();
      count += 1.0;
    }
  }
  const Eigen::Vector3d direction = sum / std::max(count, 1.0) - sensor.position;
  return direction.allFinite() ? direction.normalized() : Eigen::Vector3d::Zero().eval();
}

ScanViewpoint viewpointOf(const Sensor& sensor)
{
  ScanViewpoint result;
  result.perspective = sensor.perspective;
  const Eigen::Vector3d forward = sensor.direction.normalized();
  if (forward != Eigen::Vector3d::UnitZ())
  {
    // Columns go along x as far as they can.
    const Eigen::Vector3d side = std::abs(forward.x()) < Oblique ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
    result.T_sensor_scan = frameLooking((side - side.dot(forward) * forward).normalized(), forward);
  }
  if (sensor.perspective)
  {
    result.T_sensor_scan = result.T_sensor_scan * Eigen::Translation3d(-sensor.position);
  }
  return result;
}

ScanViewpoint viewpointOfGrid(const OrganizedCloud& cloud)
{
  ScanViewpoint result;
  const std::vector<Eigen::Vector3d> directions = directionsOf(cloud.points);
  const Eigen::Vector3d mean = meanDirection(directions);
  Eigen::Index number = 0;
  mean.cwiseAbs().maxCoeff(&number);
  const bool isAhead = mean.normalized().z() >= Oblique && liesAhead(directions, Eigen::Vector3d::UnitZ(), 0.0);
  const Eigen::Vector3d forward = isAhead ? Eigen::Vector3d::UnitZ() : axisOf(static_cast<int>(number), mean[number]);
  const Eigen::Vector3d column = stepsOf(cloud, 1, forward), row = stepsOf(cloud, cloud.width, forward);
  if (!isAhead)
  {
    if (!liesAhead(directions, forward, 0.0) || !isPinhole(cloud, forward))
    {
      return viewpointInWorld(cloud);
    }
    Eigen::Vector3d across = column - column.dot(forward) * forward;
    across.cwiseAbs().maxCoeff(&number);
    const Eigen::Vector3d right = axisOf(static_cast<int>(number), across[number]);
    result.T_sensor_scan = frameLooking(right, forward);
    result.report = "The scan lies along " + nameOfAxis(forward) + " of its axes, with " +
                    nameOfAxis(-forward.cross(right)) + " up" +
                    (forward == -Eigen::Vector3d::UnitZ() ? ", as OpenGL has it" : "") +
                    ": it was turned to be seen along +z; poses are in the scan's own axes.";
  }
  const Eigen::Matrix3d R = result.T_sensor_scan.linear();
  if ((R * column).cross(R * row).z() < 0.0)
  {
    tellOfMirror(result.report);
  }
  return result;
}

ScanViewpoint likelyViewpoint(const Points& points)
{
  ScanViewpoint result;
  const std::vector<Eigen::Vector3d> directions = directionsOf(points);
  const Eigen::Vector3d mean = meanDirection(directions).normalized();
  const Eigen::Vector3d axis = axisOf(2, mean.z());
  if (mean.dot(axis) >= MostAside && liesAhead(directions, axis, WidestView))
  {
    result.T_sensor_scan = axis.z() > 0.0 ? result.T_sensor_scan : frameLooking(Eigen::Vector3d::UnitX(), axis);
    result.report = "seen from the origin along " + nameOfAxis(axis);
    return result;
  }
  result.perspective = false;
  result.T_sensor_scan = frameLooking(Eigen::Vector3d::UnitX(), -Eigen::Vector3d::UnitZ());
  result.report = "seen from far above, along -z";
  return result;
}
}
