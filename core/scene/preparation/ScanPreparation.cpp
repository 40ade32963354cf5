// SPDX-License-Identifier: BSD-3-Clause
#include "scene/preparation/ScanPreparation.h"

#include "base/Error.h"
#include "base/sequences/Quantiles.h"
#include "scene/preparation/GridRecovery.h"
#include "scene/preparation/ScanViewpoint.h"
#include "scene/preparation/UnmeasuredPoints.h"
#include "scene/preparation/ViewpointSearch.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

namespace meam
{
namespace
{
constexpr double Sparse = 0.5;   // of the neighbours of a grid's points: fewer that are there leave no surface to see
constexpr double Filled = 0.6;   // and so many are enough of a coarser one
constexpr int MostSteps = 16;    // that a grid is made coarser by; more leave nothing of its parts
constexpr int FewestPoints = 20; // fewer are too few, however they lie
constexpr double Finer = 0.5;    // of the pixels that points would fill if they lay evenly: where the search begins
constexpr double PixelGrowth = 1.15;     // from one size of pixels to the next
constexpr int MostSizes = 40;            // 1.15^40 is 270 times as large
constexpr double HiddenFromGuess = 0.02; // share of points alone that may lie behind others, and the guess stays
constexpr double OnGrid = 0.05;          // pixels that points are off their sensor's grid, on average, and no more,
constexpr double GridRounding = 0.01;    // and so few by the rounding of their coordinates;
constexpr double Nearer = 3.0;           // off the grid from another place they are so many times as far

// Of a grid whose width and height are swapped: medians over pairs of neighbours.
constexpr int FewestLines = 16;               // rows and columns: a few lines of a laser may lie far apart
constexpr std::size_t MostPairs = 10000;      // they tell medians to a percent or two
constexpr std::size_t FewestNeighbours = 100; // pairs of measured points
constexpr double FarApart = 5.0;              // times as far as in the swapped grid neighbours in columns are,
constexpr double AsNear = 3.0;                // where they are at most so many times as far as those in rows

// What points alone do not tell, and parts that are their own mirror image would be found either way.
constexpr const char* LeftHanded = " If their axes are left-handed, as Unity's, negate y.";

std::string textOfNumber(const char* form, double value)
{
  char text[32];
  std::snprintf(text, sizeof text, form, value);
  return text;
}

Image imageOn(const std::vector<int>& points, int width, const Image& image)
{
  Image result{ width, static_cast<int>(points.size()) / width, image.channels, {} };
  result.pixels.reserve(points.size() * static_cast<std::size_t>(image.channels));
  for (const int point : nearestPoints(points, width))
  {
    const auto pixel = image.pixels.begin() + static_cast<std::ptrdiff_t>(point) * image.channels;
    result.pixels.insert(result.pixels.end(), pixel, pixel + image.channels);
  }
  return result;
}

/// Pixels of a size that the points fill, for a camera there.
RasterView viewThatPointsFill(const Points& points, bool perspective)
{
  RasterView view;
  view.perspective = perspective;
  const Eigen::Vector2d reach = reachOf(points, view).sizes();
  const double longest = std::max(reach.maxCoeff(), 1e-9);                  // all at one place
  const double area = longest * std::max(reach.minCoeff(), 1e-3 * longest); // all in a row
  double size = Finer * std::sqrt(area / static_cast<double>(points.size()));
  for (int k = 0; k < MostSizes; ++k, size *= PixelGrowth)
  {
    view.pixels.setConstant(1.0 / size);
    if (fillOf(rasterize(points, view)) >= Filled)
    {
      break;
    }
  }
  return view;
}

/// The view of the sensor that points which are not organized were seen by, with where it is.
struct FoundView
{
  ScanViewpoint viewpoint;
  RasterView view;
  bool isGuessed = false;
};

Sensor sensorOf(const ScanViewpoint& viewpoint)
{
  const Eigen::Isometry3d T_scan_sensor = viewpoint.T_sensor_scan.inverse();
  return { viewpoint.perspective,
    viewpoint.perspective ? T_scan_sensor.translation().eval() : Eigen::Vector3d::Zero().eval(),
    T_scan_sensor.linear().col(2) };
}

std::string placeOf(const Sensor& sensor)
{
  const auto number = [&](int k) { return textOfNumber("%.0f", sensor.position[k]); };
  return sensor.perspective ? " (" + number(0) + ", " + number(1) + ", " + number(2) + ")" : "";
}

/// Of a given viewpoint, by the place that hides far fewer of the points, if there is one (searchViewpoint).
std::string doubtOfViewpoint(const std::optional<Sensor>& better)
{
  return better ? "From the given viewpoint many points hide others, and few from" + placeOf(*better) +
                    ": check the unit of the viewpoint, and its frame."
                : "";
}

/// A lattice tells where the sensor is: that of the likeliest place, unless points are nearer to that of another. A
/// flat floor and the middles of voxels are about on those of others, too.
std::optional<FoundView> findGrid(const Points& scan, const std::vector<ScanViewpoint>& viewpoints)
{
  std::optional<FoundView> found;
  double least = 0.0;
  for (const ScanViewpoint& viewpoint : viewpoints)
  {
    const Points points = moved(scan, viewpoint.T_sensor_scan);
    const std::optional<RasterView> grid = recoverGrid(points, viewpoint.perspective);
    const double off = grid ? offGrid(points, *grid) : 1.0;
    const double most = found ? std::min(OnGrid, least / Nearer) : OnGrid;
    if (grid && (off < most || &viewpoint == &viewpoints.front()))
    {
      found = { viewpoint, *grid };
      least = off;
    }
    if (found && least < GridRounding)
    {
      break;
    }
  }
  return found;
}

FoundView findView(const Points& scan, const std::optional<Sensor>& sensor, std::string& report)
{
  const std::vector<ScanViewpoint> viewpoints =
    sensor ? std::vector<ScanViewpoint>{ viewpointOf(*sensor) } : likelyViewpoints(scan);
  const std::optional<FoundView> found = findGrid(scan, viewpoints);
  const std::string given = sensor ? "at the given viewpoint" + placeOf(*sensor) : "";
  if (found)
  {
    const bool isPinhole = found->viewpoint.perspective;
    appendSentence(report, "The points are not organized, but lie on the grid of " +
                             std::string(isPinhole ? "a pinhole camera (" : "an orthographic camera (") +
                             textOfNumber(isPinhole ? "%.1f" : "%.3g", found->view.pixels.x()) +
                             (isPinhole ? " pixels of focal length" : " pixels a mm") + "), " +
                             (sensor ? given : found->viewpoint.report) + ": it was found again." + LeftHanded);
    return *found;
  }
  ScanViewpoint likeliest = viewpoints.front();
  const std::optional<Sensor> better = searchViewpoint(scan, sensorOf(likeliest), HiddenFromGuess);
  if (better && !sensor)
  {
    likeliest = viewpointOf(*better);
    likeliest.report = "at" + placeOf(*better) + ", from where the fewest points hide others";
  }
  appendSentence(report, "The points are not organized, and lie on no grid: they are looked at by a virtual camera, " +
                           (sensor ? given : likeliest.report) + ", with pixels that they fill." +
                           (sensor ? "" : " Where the sensor stood elsewhere, give its viewpoint.") + LeftHanded);
  appendSentence(report, doubtOfViewpoint(sensor ? better : std::nullopt));
  return { likeliest, viewThatPointsFill(moved(scan, likeliest.T_sensor_scan), likeliest.perspective), !sensor };
}

/// A grid that is filled, and its step in those of the sparse one; the same grid when no coarser one is.
std::pair<PointRaster, int> filled(const PointRaster& raster, const Points& points)
{
  for (int step = 2; step <= MostSteps; ++step)
  {
    PointRaster other = coarser(raster, points, step);
    if (fillOf(other) >= Filled)
    {
      return { std::move(other), step };
    }
  }
  return { raster, 1 };
}

double shareOf(const PointRaster& raster)
{
  const auto isSeen = [](int point) { return point >= 0; };
  return static_cast<double>(std::count_if(raster.points.begin(), raster.points.end(), isSeen)) /
         static_cast<double>(raster.points.size());
}

void requireSurface(const PointRaster& raster, const Points& points)
{
  if (raster.width > 1 && raster.height > 1)
  {
    return;
  }
  const auto count =
    std::count_if(points.begin(), points.end(), [](const Eigen::Vector3f& point) { return point.allFinite(); });
  if (count < FewestPoints)
  {
    throw Error("The scan has only " + std::to_string(count) + (count == 1 ? " point" : " points") +
                ", and a part takes hundreds: check the file and the step before this one.");
  }
  throw Error("The scan's points lie on a line, or at one place, as its sensor sees them, and a part takes a surface: "
              "check the file, and the viewpoint where one is given.");
}

/// The median distance (mm) of points that are so many places apart in their list; none of too few that are measured.
std::optional<double> medianApart(const Points& points, std::size_t places)
{
  std::vector<float> distances;
  for (std::size_t i = 0; i + places < points.size(); i += 1 + points.size() / MostPairs)
  {
    const float distance = (points[i + places] - points[i]).norm();
    if (std::isfinite(distance))
    {
      distances.push_back(distance);
    }
  }
  if (distances.size() < FewestNeighbours)
  {
    return std::nullopt;
  }
  return medianOf(distances);
}

/// Points in rows of the grid's height are a grid whose columns hold neighbours, too: those of its width are none.
void requireShape(const OrganizedCloud& scan)
{
  if (scan.width == scan.height || std::min(scan.width, scan.height) < FewestLines)
  {
    return;
  }
  const auto rows = medianApart(scan.points, 1);
  const auto columns = medianApart(scan.points, static_cast<std::size_t>(scan.width));
  const auto swapped = medianApart(scan.points, static_cast<std::size_t>(scan.height));
  if (rows && columns && swapped && *columns > FarApart * *swapped && *swapped < AsNear * *rows)
  {
    const std::string is = std::to_string(scan.width), other = std::to_string(scan.height);
    throw Error("The width and the height of the scan's grid are swapped: it is given as " + is + " wide and " + other +
                " high, where neighbours in columns are " + textOfNumber("%.3g", *columns) + " mm apart, and " +
                textOfNumber("%.3g", *swapped) + " mm as " + other + " wide and " + is +
                " high. An array has its height first: " + is + " x " + other + " x 3.");
  }
}

/// The scan's own grid.
PointRaster rasterOf(const OrganizedCloud& scan)
{
  PointRaster raster{ scan.width, scan.height, std::vector<int>(scan.size(), -1) };
  for (std::size_t i = 0; i < scan.size(); ++i)
  {
    raster.points[i] = scan.points[i].allFinite() ? static_cast<int>(i) : -1;
  }
  return raster;
}
}

Points PreparedScan::measured() const
{
  const Eigen::Isometry3d T_scan_sensor = this->T_sensor_scan.inverse();
  Points points;
  for (const Eigen::Vector3f& point : this->cloud.points)
  {
    if (point.allFinite())
    {
      points.push_back((T_scan_sensor * point.cast<double>()).cast<float>());
    }
  }
  return points;
}

PreparedScan prepareScan(OrganizedCloud scan, Image image, const std::optional<Sensor>& sensor)
{
  requirePoints(scan.points, "The scan");
  const bool isOrganized = scan.width > 1 && scan.height > 1;
  PreparedScan result;
  result.report = removeMarkers(scan.points);
  requirePoints(scan.points, "The scan");
  const bool isRegistered = image.width == scan.width && image.height == scan.height && !image.pixels.empty();
  ScanViewpoint viewpoint;
  PointRaster raster;
  if (isOrganized)
  {
    requireShape(scan);
    viewpoint = sensor ? viewpointOf(*sensor) : viewpointOfGrid(scan);
    const std::string doubt = sensor ? doubtOfViewpoint(searchViewpoint(scan.points, *sensor, HiddenByNoise)) : "";
    if (!viewpoint.T_sensor_scan.matrix().isIdentity(0.0))
    {
      scan.points = moved(scan.points, viewpoint.T_sensor_scan);
    }
    if (!sensor && viewpoint.perspective)
    {
      appendSentence(result.report, removeByDepth(scan.points));
      requirePoints(scan.points, "The scan");
    }
    result.isAsGiven = result.report.empty() && viewpoint.T_sensor_scan.matrix().isIdentity(0.0);
    appendSentence(result.report, viewpoint.report);
    appendSentence(result.report, doubt);
    raster = rasterOf(scan);
  }
  else
  {
    result.isAsGiven = false;
    const auto isMeasured = [](const Eigen::Vector3f& point) { return point.allFinite(); };
    Points measured; // samples of all points may be just those that are not
    if (!std::all_of(scan.points.begin(), scan.points.end(), isMeasured))
    {
      measured.reserve(std::count_if(scan.points.begin(), scan.points.end(), isMeasured));
      std::copy_if(scan.points.begin(), scan.points.end(), std::back_inserter(measured), isMeasured);
    }
    const FoundView found = findView(measured.empty() ? scan.points : measured, sensor, result.report);
    viewpoint = found.viewpoint;
    result.isViewpointGuessed = found.isGuessed;
    scan.points = moved(scan.points, viewpoint.T_sensor_scan);
    raster = rasterize(scan.points, found.view);
    if (raster.points.empty())
    {
      throw Error("The scan's points lie on no surface that a sensor could see: they are strays, or the sensor's place "
                  "is another one.");
    }
  }
  result.T_sensor_scan = viewpoint.T_sensor_scan;
  int step = 1;
  if (fillOf(raster) < Sparse)
  {
    const double share = shareOf(raster);
    std::tie(raster, step) = filled(raster, scan.points);
    if (step > 1)
    {
      appendSentence(result.report, "The points fill only " + textOfNumber("%.0f", 100.0 * share) +
                                      " % of the grid: one that is " + std::to_string(step) +
                                      " times as coarse is used.");
    }
  }
  requireSurface(raster, scan.points);
  result.isAsGiven &= step == 1;
  result.sensor = sensorOf(viewpoint);
  if (isOrganized && step == 1)
  {
    result.cloud = std::move(scan);
    result.image = std::move(image);
    return result;
  }
  if (isRegistered)
  {
    result.image = imageOn(raster.points, raster.width, image);
  }
  else
  {
    result.image = std::move(image); // of another camera
  }
  result.cloud = cloudOf(raster, scan.points);
  result.pointIds = std::move(raster.points);
  return result;
}

std::optional<Sensor> sensorOfFile(const MeasuredCloud& measured)
{
  if (!measured.T_cloud_sensor || measured.cloud.height > 1)
  {
    return std::nullopt;
  }
  Points points = measured.cloud.points;
  removeMarkers(points);
  Sensor sensor;
  sensor.position = measured.T_cloud_sensor->translation();
  sensor.direction = measured.T_cloud_sensor->linear().col(2);
  std::vector<ScanViewpoint> viewpoints = likelyViewpoints(points);
  const bool isInFront = viewpoints.front().perspective;
  viewpoints.push_back(viewpointOf(sensor));
  if (const std::optional<FoundView> found = findGrid(points, viewpoints))
  {
    const bool isOfFile = found->viewpoint.T_sensor_scan.matrix() == viewpoints.back().T_sensor_scan.matrix();
    return isOfFile ? std::optional(sensor) : std::nullopt;
  }
  sensor.direction.setZero(); // at the middle of the points: files often tell the place alone
  return !isInFront && seesAll(sensor, points) ? std::optional(sensor) : std::nullopt;
}

SceneEdges extractSceneEdges(
  const PreparedScan& scan, const SceneEdgeExtractionSettings& chosen, const Progress& progress)
{
  SceneEdgeExtractionSettings settings = chosen;
  if (settings.camera)
  {
    settings.camera->T_camera_scene = settings.camera->T_camera_scene * scan.T_sensor_scan.inverse();
  }
  SceneEdges edges = extractSceneEdges(scan.cloud, scan.image, settings, progress);
  if (!scan.T_sensor_scan.matrix().isIdentity(0.0))
  {
    const Eigen::Isometry3d T_scan_sensor = scan.T_sensor_scan.inverse();
    edges.cloud.points = moved(edges.cloud.points, T_scan_sensor);
    for (Eigen::Vector3f& tangent : edges.cloud.tangents)
    {
      tangent = (T_scan_sensor.linear() * tangent.cast<double>()).cast<float>();
    }
  }
  if (!scan.pointIds.empty())
  {
    for (int& id : edges.cloud.pointIds)
    {
      id = scan.pointIds[static_cast<std::size_t>(id)];
    }
  }
  return edges;
}
}
