// SPDX-License-Identifier: BSD-3-Clause
#include "scene/edges/SceneEdgeExtraction.h"

#include "base/Parallel.h"
#include "base/Range.h"
#include "base/sequences/Sequences.h"
#include "scene/edges/CoarseGrid.h"
#include "scene/edges/GridSurface.h"
#include "scene/edges/PixelMap.h"

#include <Eigen/LU>

#include <algorithm>
#include <bitset>
#include <cmath>
#include <cstdint>
#include <utility>

namespace meam
{
namespace
{
// Grid steps: so large a window tells no more than one of the halved grid without noise.
constexpr int HalvedFrom = 4;
constexpr int TangentLength = 2; // of that surface's window in its widths: the slope along the edge is what counts

std::string sizeOf(int width, int height) { return std::to_string(width) + " x " + std::to_string(height); }

void check(const OrganizedCloud& cloud, const Image& image, const SceneEdgeExtractionSettings& settings)
{
  requirePoints(cloud.points, "The scene");
  if (cloud.height <= 1 || cloud.width <= 1 || cloud.size() != static_cast<std::size_t>(cloud.width) * cloud.height)
  {
    throw Error("The scene is not organized (it is " + sizeOf(cloud.width, cloud.height) +
                " points): edges of an image need a cloud with one point for each pixel.");
  }
  if (settings.imageEdges && !settings.camera && (image.width != cloud.width || image.height != cloud.height))
  {
    throw Error("The image is " + sizeOf(image.width, image.height) + " pixels but the cloud is " +
                sizeOf(cloud.width, cloud.height) +
                " points: give the image that is registered with the cloud, or the camera that took it.");
  }
  if (settings.imageEdges && settings.camera && settings.camera->width > 0 &&
      (image.width != settings.camera->width || image.height != settings.camera->height))
  {
    throw Error("The image is " + sizeOf(image.width, image.height) + " pixels but its camera has " +
                sizeOf(settings.camera->width, settings.camera->height) + ": one is not that of the other.");
  }
  if (!settings.imageEdges && !settings.depthEdges && !settings.creases)
  {
    throw Error("No edges are asked for: switch on those of the image, of depth jumps or of creases.");
  }
  requireWithin("search radius of the image's edges", settings.searchRadius, 0, 50, " points");
  requireWithin("depth jump", settings.depthJump, 0.0, Unbounded, " mm");
  requirePositive("angle of creases", settings.creaseAngle, 180.0, " degrees");
}

/// A point of the grid that something tells to be on an edge.
struct Finding
{
  int point;
  EdgeSource source;
  Eigen::Vector2f direction; ///< unit, along the edge, in the image or in columns and rows of the grid
};

/// Places of the points that were found, in the order of the grid.
class FoundPoints
{
public:
  FoundPoints(std::size_t gridPoints, const std::vector<Finding>& found)
    : Words(gridPoints / 64 + 1)
    , Ranks(Words.size() + 1)
  {
    for (const Finding& one : found)
    {
      this->Words[one.point / 64] |= std::uint64_t(1) << one.point % 64;
    }
    for (std::size_t k = 0; k < this->Words.size(); ++k)
    {
      this->Ranks[k + 1] = this->Ranks[k] + countOf(this->Words[k]);
    }
  }

  int size() const { return this->Ranks.back(); }
  int placeOf(int point) const
  {
    const std::uint64_t before = (std::uint64_t(1) << point % 64) - 1;
    return this->Ranks[point / 64] + countOf(this->Words[point / 64] & before);
  }

private:
  static int countOf(std::uint64_t word) { return static_cast<int>(std::bitset<64>(word).count()); }

  std::vector<std::uint64_t> Words; ///< a bit for each point of the grid
  std::vector<int> Ranks;           ///< how many were found before each word
};

/// Edge points, each once, in the order of the grid: with the first source that found it, and the mean of its
/// directions from there.
struct EdgePoints
{
  SceneEdges edges;
  std::vector<Eigen::Vector2f> directions;
};

EdgePoints merged(const OrganizedCloud& cloud, const std::vector<Finding>& found, int threads)
{
  const FoundPoints places(cloud.size(), found);
  EdgePoints result;
  result.edges.sources.resize(places.size());
  result.edges.cloud.pointIds.assign(places.size(), -1);
  result.edges.cloud.points.resize(places.size());
  // Directions have no sign: sums of cosines and sines of twice their angles.
  result.directions.assign(places.size(), Eigen::Vector2f::Zero());
  for (const Finding& one : found)
  {
    const int place = places.placeOf(one.point);
    if (result.edges.cloud.pointIds[place] < 0)
    {
      result.edges.cloud.pointIds[place] = one.point;
      result.edges.sources[place] = one.source;
    }
    if (result.edges.sources[place] == one.source)
    {
      const float x = one.direction.x(), y = one.direction.y();
      result.directions[place] += Eigen::Vector2f(x * x - y * y, 2.0f * x * y);
    }
  }
  parallelForEach(places.size(), threads, {},
    [&](int i)
    {
      const float angle = 0.5f * std::atan2(result.directions[i].y(), result.directions[i].x());
      result.directions[i] = { std::cos(angle), std::sin(angle) };
      result.edges.cloud.points[i] = cloud.points[result.edges.cloud.pointIds[i]];
    });
  return result;
}

/// A direction in the image of a camera as one in columns and rows of the grid; zero when the camera looks
/// along the surface.
Eigen::Vector2f onGrid(const Camera& camera, const GridPlane& plane, const Eigen::Vector2f& direction)
{
  const Eigen::Vector3d middle = plane.middle.cast<double>();
  const Eigen::Vector2d pixel = project(camera, middle);
  Eigen::Matrix2d steps;
  steps.col(0) = project(camera, middle + plane.alongColumn.cast<double>()) - pixel;
  steps.col(1) = project(camera, middle + plane.alongRow.cast<double>()) - pixel;
  const Eigen::Vector2d inGrid = steps.inverse() * direction.cast<double>();
  return inGrid.allFinite() ? inGrid.normalized().cast<float>().eval() : Eigen::Vector2f::Zero().eval();
}

std::vector<Finding> findingsOf(const std::vector<GridEdge>& edges, EdgeSource source)
{
  return mapped<Finding>(edges, [&](const GridEdge& edge) { return Finding{ edge.point, source, edge.direction }; });
}

std::vector<Finding> findingsOfImage(const OrganizedCloud& cloud, const Image& image,
  const SceneEdgeExtractionSettings& settings, double jump, const Progress& progress)
{
  const std::vector<EdgePixel> pixels = findImageEdges(image, settings.image, settings.threads);
  report(progress, 0.5);
  std::vector<Finding> found(pixels.size());
  const auto lookUp = [&](const auto& map, double pixelsPerPoint, const Progress& rest)
  {
    const int radius = static_cast<int>(std::ceil(settings.searchRadius * pixelsPerPoint));
    parallelForEach(static_cast<int>(pixels.size()), settings.threads, rest,
      [&](int i)
      {
        const EdgePixel& pixel = pixels[i];
        found[i] = { pointOfPixel(map, pixel.row, pixel.column, radius, jump), EdgeSource::Image, pixel.direction };
      });
  };
  if (settings.camera)
  {
    Camera camera = *settings.camera;
    camera.width = image.width;
    camera.height = image.height;
    const PixelMap map = projectedPixels(cloud, camera, jump, settings.threads, subProgress(progress, 0.5, 0.9));
    lookUp(map, map.pixelsPerPoint, subProgress(progress, 0.9, 1.0));
  }
  else
  {
    lookUp(cloud, 1.0, subProgress(progress, 0.5, 1.0));
  }
  eraseIf(found, [](const Finding& one) { return one.point < 0; });
  return found;
}

/// What the slopes of surfaces are told on: the grid, or where noise takes large windows the halved grid, which tells
/// as much by fewer points.
class SlopeGrid
{
public:
  SlopeGrid(const OrganizedCloud& cloud, const GridScale& scale, const SceneEdgeExtractionSettings& settings)
    : Cloud(cloud)
    , IsHalved((settings.creases || settings.tangents) && scale.windowRadius() >= HalvedFrom)
    , Half(this->IsHalved ? halved(cloud, scale.depthJump(), settings.threads) : OrganizedCloud())
    , Scale(this->IsHalved ? gridScale(this->Half, settings.threads) : scale)
  {
  }

  std::vector<GridEdge> creases(double angle, int threads, const Progress& progress) const
  {
    const std::vector<GridEdge> found = findCreases(this->grid(), this->Scale, angle, threads, progress);
    return this->IsHalved ? onFullGrid(found, this->Half, this->Cloud) : found;
  }

  /// The planes through the surface around points of the full grid, in windows along these directions.
  void fit(const int* points, const Eigen::Vector2f* directions, int count, double jump, GridPlane* planes) const
  {
    const int radius = this->Scale.windowRadius();
    std::vector<int> places(points, points + count);
    std::vector<GridWindow> windows;
    for (int i = 0; i < count; ++i)
    {
      places[i] = this->IsHalved ? placeInHalf(points[i], this->Half, this->Cloud) : points[i];
      windows.push_back({ TangentLength * radius, radius, directions[i] });
    }
    fitPlanes(this->grid(), places.data(), windows.data(), count, jump, planes);
  }

private:
  const OrganizedCloud& grid() const { return this->IsHalved ? this->Half : this->Cloud; }

  const OrganizedCloud& Cloud;
  bool IsHalved;
  OrganizedCloud Half;
  GridScale Scale;
};

/// Lifts each point's direction to the surface there; points whose surface cannot be told are left out.
SceneEdges withTangents(const EdgePoints& found, const SlopeGrid& slopes, const SceneEdgeExtractionSettings& settings,
  double jump, const Progress& progress)
{
  const SceneEdges& edges = found.edges;
  Points tangents(edges.cloud.size(), Eigen::Vector3f::Zero());
  parallelFor(static_cast<int>(tangents.size()), settings.threads, progress,
    [&](int begin, int end, int)
    {
      std::vector<GridPlane> planes(end - begin);
      slopes.fit(&edges.cloud.pointIds[begin], &found.directions[begin], end - begin, jump, planes.data());
      for (int i = begin; i < end; ++i)
      {
        const GridPlane& plane = planes[i - begin];
        const Eigen::Vector2f& direction = found.directions[i];
        if (plane.valid())
        {
          const bool inImage = settings.camera && edges.sources[i] == EdgeSource::Image;
          tangents[i] = plane.lifted(inImage ? onGrid(*settings.camera, plane, direction) : direction);
        }
      }
    });
  std::vector<int> kept;
  SceneEdges result;
  for (std::size_t i = 0; i < tangents.size(); ++i)
  {
    if (tangents[i].norm() > 0.5f) // unit; not zero and a number
    {
      kept.push_back(static_cast<int>(i));
      result.sources.push_back(edges.sources[i]);
    }
  }
  result.cloud = edges.cloud;
  result.cloud.tangents = std::move(tangents);
  result.cloud = result.cloud.subset(kept);
  return result;
}
}

SceneEdgeExtractionSettings sceneEdgeSettings(Preset preset)
{
  SceneEdgeExtractionSettings settings;
  settings.depthEdges = settings.creases = settings.tangents = preset == Preset::Recommended;
  return settings;
}

SceneEdges extractSceneEdges(const OrganizedCloud& cloud, const Image& image,
  const SceneEdgeExtractionSettings& settings, const Progress& progress)
{
  check(cloud, image, settings);
  report(progress, 0.0);
  const GridScale scale = gridScale(cloud, settings.threads);
  const double jump = settings.depthJump > 0.0 ? settings.depthJump : scale.depthJump();
  const SlopeGrid slopes(cloud, scale, settings);
  std::vector<Finding> found;
  const auto add = [&](const std::vector<Finding>& some) { found.insert(found.end(), some.begin(), some.end()); };
  if (settings.imageEdges)
  {
    found = findingsOfImage(cloud, image, settings, jump, subProgress(progress, 0.0, 0.5));
  }
  if (settings.depthEdges)
  {
    add(findingsOf(
      findDepthEdges(cloud, jump, settings.threads, subProgress(progress, 0.5, 0.6)), EdgeSource::DepthJump));
  }
  if (settings.creases)
  {
    add(findingsOf(
      slopes.creases(settings.creaseAngle, settings.threads, subProgress(progress, 0.6, 0.8)), EdgeSource::Crease));
  }
  EdgePoints points = merged(cloud, found, settings.threads);
  SceneEdges result = settings.tangents ? withTangents(points, slopes, settings, jump, subProgress(progress, 0.8, 1.0))
                                        : std::move(points.edges);
  result.quality = measureQuality(cloud, settings.threads);
  report(progress, 1.0);
  return result;
}
}
