// SPDX-License-Identifier: BSD-3-Clause
#include "scene/edges/SceneEdgeExtraction.h"

#include "base/Parallel.h"
#include "scene/edges/CloudEdges.h"
#include "scene/edges/GridSurface.h"
#include "scene/edges/PixelMap.h"

#include <Eigen/LU>

#include <cmath>

namespace meam
{
namespace
{
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
  const bool angleFits = settings.creaseAngle > 0.0 && settings.creaseAngle < 180.0;
  if (!(settings.depthJump >= 0.0) || !std::isfinite(settings.depthJump) || settings.searchRadius < 0 ||
      settings.searchRadius > 50 || !angleFits)
  {
    throw Error("Settings of the scene edges are out of range: the search radius is 0 to 50 points, the depth jump 0 or "
                "more, and the angle of creases above 0 and below 180 degrees.");
  }
}

/// Edge points as they are found: the first source, and the sum of the directions, which have no sign, as
/// cosines and sines of twice their angles.
class FoundEdges
{
public:
  explicit FoundEdges(std::size_t gridPoints)
    : Places(gridPoints, -1)
  {
  }

  void add(int point, EdgeSource source, const Eigen::Vector2f& direction)
  {
    int& place = this->Places[point];
    if (place < 0)
    {
      place = static_cast<int>(this->Sources.size());
      this->Sources.push_back(source);
      this->Doubled.emplace_back(0.0f, 0.0f);
    }
    if (this->Sources[place] == source)
    {
      const float x = direction.x();
      const float y = direction.y();
      this->Doubled[place] += Eigen::Vector2f(x * x - y * y, 2.0f * x * y);
    }
  }

  void add(const std::vector<GridEdge>& edges, EdgeSource source)
  {
    for (const GridEdge& edge : edges)
    {
      this->add(edge.point, source, edge.direction);
    }
  }

  /// Calls visit(grid point, source, direction) in the order of the grid.
  template <typename Visitor>
  void forEach(const Visitor& visit) const
  {
    for (std::size_t i = 0; i < this->Places.size(); ++i)
    {
      if (this->Places[i] >= 0)
      {
        const Eigen::Vector2f& doubled = this->Doubled[this->Places[i]];
        const float angle = 0.5f * std::atan2(doubled.y(), doubled.x());
        visit(static_cast<int>(i), this->Sources[this->Places[i]], Eigen::Vector2f(std::cos(angle), std::sin(angle)));
      }
    }
  }

private:
  std::vector<int> Places; ///< of a grid point in the others, -1: none
  std::vector<EdgeSource> Sources;
  std::vector<Eigen::Vector2f> Doubled;
};

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
void addImageEdges(const OrganizedCloud& cloud, const Image& image, const SceneEdgeExtractionSettings& settings,
  double jump, FoundEdges& found, const Progress& progress)
{
  const std::vector<EdgePixel> pixels = findImageEdges(image, settings.image);
  report(progress, 0.5);
  PixelMap map;
  if (settings.camera)
  {
    Camera camera = *settings.camera;
    camera.width = image.width;
    camera.height = image.height;
    map = projectedPixels(cloud, camera, jump, settings.threads, subProgress(progress, 0.5, 0.9));
  }
  else
  {
    map = registeredPixels(cloud);
  }
  const int radius = static_cast<int>(std::ceil(settings.searchRadius * map.pixelsPerPoint));
  for (const EdgePixel& pixel : pixels)
  {
    const int point = pointOfPixel(map, pixel.row, pixel.column, radius, jump);
    if (point >= 0)
    {
      found.add(point, EdgeSource::Image, pixel.direction);
    }
  }
}

/// Lifts each point's direction to the surface there; points whose surface cannot be told are left out.
SceneEdges withTangents(const SceneEdges& edges, const std::vector<Eigen::Vector2f>& directions,
  const OrganizedCloud& cloud, const SceneEdgeExtractionSettings& settings, double jump, int radius,
  const Progress& progress)
{
  Points tangents(edges.cloud.size(), Eigen::Vector3f::Zero());
  parallelFor(static_cast<int>(tangents.size()), settings.threads, progress,
    [&](int begin, int end, int)
    {
      for (int i = begin; i < end; ++i)
      {
        const int point = edges.cloud.pointIds[i];
        const GridWindow window{ 2 * radius, radius, directions[i] }; // long: the slope along the edge is what counts
        const GridPlane plane = fitPlane(cloud, point / cloud.width, point % cloud.width, window, jump);
        if (plane.valid())
        {
          const bool inImage = settings.camera && edges.sources[i] == EdgeSource::Image;
          tangents[i] = plane.lifted(inImage ? onGrid(*settings.camera, plane, directions[i]) : directions[i]);
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

SceneEdges extractSceneEdges(const OrganizedCloud& cloud, const Image& image,
  const SceneEdgeExtractionSettings& settings, const Progress& progress)
{
  check(cloud, image, settings);
  report(progress, 0.0);
  const GridScale scale = gridScale(cloud);
  const double jump = settings.depthJump > 0.0 ? settings.depthJump : scale.depthJump();
  FoundEdges found(cloud.size());
  if (settings.imageEdges)
  {
    addImageEdges(cloud, image, settings, jump, found, subProgress(progress, 0.0, 0.5));
  }
  if (settings.depthEdges)
  {
    found.add(findDepthEdges(cloud, jump, settings.threads, subProgress(progress, 0.5, 0.6)), EdgeSource::DepthJump);
  }
  if (settings.creases)
  {
    found.add(
      findCreases(cloud, scale, settings.creaseAngle, settings.threads, subProgress(progress, 0.6, 0.8)),
      EdgeSource::Crease);
  }

  SceneEdges result;
  std::vector<Eigen::Vector2f> directions;
  found.forEach(
    [&](int point, EdgeSource source, const Eigen::Vector2f& direction)
    {
      result.cloud.points.push_back(cloud.points[point]);
      result.cloud.pointIds.push_back(point);
      result.sources.push_back(source);
      directions.push_back(direction);
    });
  if (settings.tangents)
  {
    result = withTangents(
      result, directions, cloud, settings, jump, scale.windowRadius(), subProgress(progress, 0.8, 1.0));
  }
  report(progress, 1.0);
  return result;
}
}
