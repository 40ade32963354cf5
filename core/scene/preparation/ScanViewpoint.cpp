// SPDX-License-Identifier: BSD-3-Clause
#include "scene/preparation/ScanViewpoint.h"

#include "base/Error.h"
#include "scene/preparation/SensorResection.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace meam
{
namespace
{
const double Oblique = std::cos(M_PI / 4.0);    // of the mean direction: nearer to another axis than to this
const double MostAside = std::cos(M_PI / 6.0);  // of a sensor's frame, how far its scan's middle is beside its axis,
const double WidestView = std::cos(M_PI / 3.0); // and how far it sees beside it
constexpr double MostOff = 0.02;          // of the width, root mean square, that pixels are off a pinhole camera's
constexpr double Worse = 3.0;             // times as far off as from another place: that is the sensor's,
constexpr double Exact = 0.05;            // pixels, or no farther off than rounded coordinates are
constexpr double AsideOfMiddle = 0.12;    // of the width, right or left and up or down: no camera's axis goes there
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

/// Whether a cloud is likely in the frame of a sensor that looks along an axis.
bool liesInFront(const std::vector<Eigen::Vector3d>& directions, const Eigen::Vector3d& axis)
{
  return meanDirection(directions).normalized().dot(axis) >= MostAside && liesAhead(directions, axis, WidestView);
}

/// How well the pixels of a grid follow rays from the origin, seen along an axis.
struct OriginView
{
  Eigen::Vector3d forward;
  Eigen::Vector3d right = Eigen::Vector3d::Zero();      ///< the axis that columns go along most
  Eigen::Vector2d axis = Eigen::Vector2d::Zero();       ///< where it meets the grid, in widths from the middle
  double off = std::numeric_limits<double>::infinity(); ///< widths of the grid, root mean square
  bool isMirrored = false;                              ///< rows run backwards
  bool isAllAhead = false;                              ///< but for strays
};

OriginView viewFromOrigin(const std::vector<GridSample>& samples, const Eigen::Vector3d& forward)
{
  OriginView view{ forward };
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> ofPixels = Eigen::Matrix<double, 3, 2>::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  std::size_t ahead = 0;
  for (const auto& [point, pixel] : samples)
  {
    if (point.dot(forward) > 0.0)
    {
      const Eigen::Vector3d ray = point / point.dot(forward); // 1 along the axis: what is ahead has a pixel, too
      sum += ray * ray.transpose();
      ofPixels += ray * pixel.transpose();
      squares += pixel * pixel.transpose();
      ++ahead;
    }
  }
  if (2 * ahead <= samples.size()) // behind is what was not measured, and that is not most
  {
    return view;
  }
  const Eigen::Matrix<double, 3, 2> fit = sum.ldlt().solve(ofPixels);
  const double off = (squares - fit.transpose() * ofPixels).trace() / static_cast<double>(ahead);
  view.off = std::sqrt(std::max(off, 0.0));
  view.axis = fit.transpose() * forward;
  const Eigen::Vector3d column = fit.col(0) - fit.col(0).dot(forward) * forward;
  Eigen::Index number = 0;
  column.cwiseAbs().maxCoeff(&number);
  view.right = axisOf(static_cast<int>(number), column[number]);
  view.isAllAhead =
    static_cast<double>(samples.size() - ahead) <= StrayDirections * static_cast<double>(samples.size());
  view.isMirrored = fit.col(0).cross(fit.col(1)).dot(forward) < 0.0;
  return view;
}

/// Along the first axis, +z before the others, from which pixels follow the rays but for what lenses make of them.
std::optional<OriginView> viewFromOrigin(const std::vector<GridSample>& samples)
{
  for (int number = 2; number >= 0; --number)
  {
    for (const double sign : { 1.0, -1.0 })
    {
      const OriginView view = viewFromOrigin(samples, axisOf(number, sign));
      if (view.off < MostOff)
      {
        return view;
      }
    }
  }
  return std::nullopt;
}

std::string placeText(const Eigen::Vector3d& place, const char* form)
{
  char text[100];
  std::snprintf(text, sizeof text, form, place.x(), place.y(), place.z());
  return text;
}

void tellOfAxis(std::string& report, const Eigen::Vector2d& axis)
{
  if ((axis.array().abs() > AsideOfMiddle).all())
  {
    const auto percent = [](double share) { return std::to_string(std::lround(100.0 * std::abs(share))) + " %"; };
    appendSentence(report,
      "The sensor's axis goes through its image " + percent(axis.x()) + " of the width " +
        (axis.x() < 0.0 ? "left" : "right") + " of the middle and " + percent(axis.y()) + " " +
        (axis.y() < 0.0 ? "above" : "below") +
        " it: unless the scan was cropped or is a height map, its camera matrix is that of another image size.");
  }
}

void tellOfMirror(std::string& report)
{
  appendSentence(report,
    "The scan's rows or columns run backwards: either they are stored from the other side, which does not matter, or "
    "its axes are left-handed, and parts come out mirrored: negate y then.");
}

/// Of a sensor elsewhere, which all points are in front of.
bool isBetter(const ResectedSensor& sensor, const OriginView& origin, int width)
{
  const double rounding = Exact / width;
  return origin.isAllAhead ? origin.off > Worse * sensor.off + rounding : sensor.off <= origin.off + rounding;
}

ScanViewpoint viewpointAtOrigin(const OriginView& view)
{
  ScanViewpoint result;
  if (view.forward != Eigen::Vector3d::UnitZ())
  {
    result.T_sensor_scan = frameLooking(view.right, view.forward);
    result.report = "The scan lies along " + nameOfAxis(view.forward) + " of its axes, with " +
                    nameOfAxis(-view.forward.cross(view.right)) + " up" +
                    (view.forward == -Eigen::Vector3d::UnitZ() ? ", as OpenGL has it" : "") +
                    ": it was turned to be seen along +z; poses are in the scan's own axes.";
  }
  tellOfAxis(result.report, view.axis);
  if (view.isMirrored)
  {
    tellOfMirror(result.report);
  }
  return result;
}

ScanViewpoint viewpointInWorld(const ResectedSensor& sensor)
{
  ScanViewpoint result;
  result.T_sensor_scan = sensor.T_sensor_scan;
  const Eigen::Isometry3d T_scan_sensor = sensor.T_sensor_scan.inverse();
  result.report = "The scan is not in its sensor's frame: by where the points lie on the grid the sensor is at " +
                  placeText(T_scan_sensor.translation(), "(%.0f, %.0f, %.0f)") + " and looks along " +
                  placeText(T_scan_sensor.linear().col(2), "(%.2f, %.2f, %.2f)") + ".";
  if (sensor.isMirrored)
  {
    tellOfMirror(result.report);
  }
  return result;
}

/// The grid does not tell which way an orthographic sensor looks, for the rows of a height map may run up or down: it
/// is seen from above, unless it is a depth map, which lies ahead of the origin, with rows that run down.
ScanViewpoint orthographicViewpoint(const ResectedSensor& sensor, const Points& points)
{
  ScanViewpoint result;
  result.perspective = false;
  Eigen::Vector3d forward = sensor.T_sensor_scan.linear().row(2);
  if (forward.z() > Oblique && !liesInFront(directionsOf(points), Eigen::Vector3d::UnitZ()))
  {
    forward = -forward;
  }
  result.T_sensor_scan = frameLooking(sensor.T_sensor_scan.linear().row(0), forward);
  result.report = "The points lie on the grid of an orthographic sensor: it is taken to look along " +
                  placeText(forward, "(%.2f, %.2f, %.2f)") + "; where it looks the other way, give its viewpoint.";
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

bool seesAll(const Sensor& sensor, const Points& points)
{
  const Points seen = moved(points, Eigen::Isometry3d(Eigen::Translation3d(-sensor.position)));
  return liesAhead(directionsOf(seen), lookingDirection(sensor, points), WidestView);
}

ScanViewpoint viewpointOfGrid(const OrganizedCloud& cloud)
{
  const std::vector<GridSample> samples = samplesOf(cloud);
  const std::optional<OriginView> origin = viewFromOrigin(samples);
  if (origin && origin->isAllAhead && !origin->isMirrored)
  {
    return viewpointAtOrigin(*origin);
  }
  // A floor that is seen from above lies on about the same grid from below, mirrored: the parts on it tell.
  const std::optional<ResectedSensor> sensor = resectSensor(samples, cloud.width);
  if (origin && !(sensor && isBetter(*sensor, *origin, cloud.width)))
  {
    return viewpointAtOrigin(*origin);
  }
  return !sensor               ? ScanViewpoint()
         : sensor->perspective ? viewpointInWorld(*sensor)
                               : orthographicViewpoint(*sensor, cloud.points);
}

std::vector<ScanViewpoint> likelyViewpoints(const Points& points)
{
  const std::vector<Eigen::Vector3d> directions = directionsOf(points);
  std::vector<ScanViewpoint> fromOrigin;
  bool isInFront = false;
  for (int number = 2; number >= 0; --number)
  {
    for (const double sign : { 1.0, -1.0 })
    {
      const Eigen::Vector3d axis = axisOf(number, sign);
      if (liesAhead(directions, axis, WidestView))
      {
        isInFront = isInFront || (number == 2 && liesInFront(directions, axis));
        fromOrigin.push_back(viewpointOf({ true, Eigen::Vector3d::Zero(), axis }));
        fromOrigin.back().report = "seen from the origin along " + nameOfAxis(axis);
      }
    }
  }
  ScanViewpoint above = viewpointOf({ false, Eigen::Vector3d::Zero(), -Eigen::Vector3d::UnitZ() });
  above.report = "seen from far above, along -z";
  std::vector<ScanViewpoint> result = std::move(fromOrigin);
  result.insert(result.begin() + (isInFront ? 1 : 0), std::move(above));
  return result;
}
}
