// SPDX-License-Identifier: BSD-3-Clause
#include "model/PredictedVisibility.h"

#include "base/AllVectors.h"
#include "base/Frames.h"
#include "model/TrainedModel.h"
#include "scene/Sensor.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meam
{
namespace
{
// Lengths are shares of the part's diameter.
constexpr double Cell = 0.025;     // of the depth buffer across the line of sight; a little over the samples' spacing
constexpr double Tolerance = 0.01; // depth that a point may lie behind the nearest of its cell: that of rounded faces
constexpr double EdgeSlope = 1.5;  // slope allowed for at an edge point, whose surface is not known
constexpr double GrazingCosine = 0.15; // surface seen at a flatter angle (81 degrees) is not predicted: sensors miss it
constexpr double Outward = 1.5;        // cells from a contour to where the buffer tells whether the part hides it
constexpr int DirectionSteps = 32;     // of each coordinate of the direction to the sensor from 0 to 1: 1.8 degrees
constexpr int WidestBorder = 4;        // cells
constexpr int Beside = 2;              // cells of the depth buffer that lie beyond that on each side of the part
constexpr double EdgeCell = 0.1;       // of the grid that finds visible edges
constexpr double Border = 2.5;         // point distances: so near to the outline sensors mix what is before and behind
constexpr double Drop = 0.025; // fall of the part from cell to cell beside which sensors may see just its lower side
constexpr double Inset = 0.5;  // point distances: where a smooth surface ends the last point is measured so far inside
constexpr double PitchStep = 0.0005; // to which point distances are rounded
constexpr int PitchSteps = 200;      // at most

Eigen::Vector3f meanOf(const Points& points)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& point : points)
  {
    sum += point.cast<double>();
  }
  return (sum / static_cast<double>(points.size())).cast<float>();
}

/// What the depth buffer has where there is nothing.
constexpr float Nothing = -std::numeric_limits<float>::infinity();

/// A depth buffer across the lines of sight.
struct View
{
  Eigen::Matrix3f frame; ///< columns: towards the sensor, right, down
  float half;            ///< mm from the middle to the border
  float inverseCell;
  int side; ///< cells
};

struct Projected
{
  std::vector<int> cells;
  std::vector<float> heights; ///< towards the sensor, mm
};

MEAM_ALL_VECTORS
void project(const View& view, const float* x, const float* y, const float* z, int count, int* cells, float* heights)
{
  const float hx = view.frame(0, 0), hy = view.frame(1, 0), hz = view.frame(2, 0);
  const float ux = view.frame(0, 1), uy = view.frame(1, 1), uz = view.frame(2, 1);
  const float vx = view.frame(0, 2), vy = view.frame(1, 2), vz = view.frame(2, 2);
  const float half = view.half, scale = view.inverseCell;
  const int side = view.side;
#pragma omp simd
  for (int k = 0; k < count; ++k)
  {
    const int u = static_cast<int>((ux * x[k] + uy * y[k] + uz * z[k] + half) * scale);
    const int v = static_cast<int>((vx * x[k] + vy * y[k] + vz * z[k] + half) * scale);
    cells[k] = std::min(std::max(v, 0), side - 1) * side + std::min(std::max(u, 0), side - 1);
    heights[k] = hx * x[k] + hy * y[k] + hz * z[k];
  }
}

/// Adds to heights what a surface of that slope may lie below its neighbours in a cell; surfaces seen too flatly sink
/// below all others.
MEAM_ALL_VECTORS
void allowForSlope(const Eigen::Vector3f& towards, const float* nx, const float* ny, const float* nz, int count,
  float cell, float grazingCosine, float* heights)
{
  const float hx = towards.x(), hy = towards.y(), hz = towards.z();
#pragma omp simd
  for (int k = 0; k < count; ++k)
  {
    const float cosine = nx[k] * hx + ny[k] * hy + nz[k] * hz;
    const float bounded = std::min(std::max(cosine, grazingCosine), 1.0f);
    const float slope = std::sqrt(1.0f - bounded * bounded) / bounded;
    heights[k] = cosine > grazingCosine ? heights[k] + slope * cell : -std::numeric_limits<float>::max();
  }
}

View viewAlong(const Eigen::Vector3f& towards, float halfCells, float cell)
{
  const float half = halfCells * cell;
  return { frameAround(towards), half, 1.0f / cell, static_cast<int>(std::ceil(2.0f * half / cell)) + 1 };
}

void project(const View& view, const SoAPoints& points, Projected& result)
{
  result.cells.resize(points.x.size());
  result.heights.resize(points.x.size());
  project(view, points.x.data(), points.y.data(), points.z.data(), static_cast<int>(points.x.size()),
    result.cells.data(), result.heights.data());
}

void allowForSlope(
  const Eigen::Vector3f& towards, const SoAPoints& normals, float cell, float grazingCosine, Projected& points)
{
  allowForSlope(towards, normals.x.data(), normals.y.data(), normals.z.data(), static_cast<int>(normals.size()), cell,
    grazingCosine, points.heights.data());
}

/// The lowest of the cells up to `border` off one, along the rows and columns.
float lowestBeside(const std::vector<float>& buffer, int side, int cell, int border)
{
  if (cell < border * side || cell + border * side >= static_cast<int>(buffer.size()))
  {
    return Nothing;
  }
  float lowest = buffer[cell];
  for (int off = 1; off <= border; ++off)
  {
    lowest = std::min(
      { lowest, buffer[cell - off], buffer[cell + off], buffer[cell - off * side], buffer[cell + off * side] });
  }
  return lowest;
}

/// The middles of the cells `border` + 1 off what is seen, at the depth of the farthest of its cells that far from
/// them.
Points outsideOf(const std::vector<float>& buffer, const View& view, int border)
{
  constexpr float unknown = std::numeric_limits<float>::infinity();
  const int side = view.side, off = border + 1;
  thread_local std::vector<float> room; // looked up once: each access to it is a call
  std::vector<float>& heights = room;   // of the cells outside
  heights.assign(buffer.size(), unknown);
  const auto look = [&](int cell, int step) // from a cell that is seen
  {
    bool isFree = true;
    for (int k = 1; isFree && k <= off; ++k)
    {
      isFree = buffer[cell + k * step] == Nothing;
    }
    if (isFree)
    {
      float& height = heights[cell + off * step];
      height = std::min(height, buffer[cell]);
    }
  };
  const auto isWithin = [&](int k) { return k >= off && k + off < side; };
  for (int v = 0; v < side; ++v)
  {
    for (int u = 0; u < side; ++u)
    {
      const int cell = v * side + u;
      if (buffer[cell] == Nothing)
      {
        continue;
      }
      for (const int sign : { -1, 1 })
      {
        if (isWithin(v) && isWithin(u + sign * off))
        {
          look(cell, sign);
        }
        if (isWithin(u) && isWithin(v + sign * off))
        {
          look(cell, sign * side);
        }
      }
    }
  }
  Points outside;
  for (int v = 0; v < side; ++v)
  {
    for (int u = 0; u < side; ++u)
    {
      const float height = heights[v * side + u];
      if (height < unknown)
      {
        const float right = (u + 0.5f) / view.inverseCell - view.half, down = (v + 0.5f) / view.inverseCell - view.half;
        outside.push_back(view.frame * Eigen::Vector3f(height, right, down));
      }
    }
  }
  return outside;
}

void raise(const Projected& points, std::vector<float>& buffer)
{
  for (std::size_t k = 0; k < points.cells.size(); ++k)
  {
    float& height = buffer[points.cells[k]];
    height = std::max(height, points.heights[k]);
  }
}

/// Whether the part hides a contour: seen right outside of it there is something before it. On the contour itself the
/// part falls off too steeply for cells to tell.
bool isHidden(const std::vector<float>& buffer, const View& view, const Eigen::Vector3f& point,
  const Eigen::Vector3f& outward, float tolerance)
{
  int cell;
  float height;
  const Eigen::Vector3f beside = point + outward;
  project(view, &beside.x(), &beside.y(), &beside.z(), 1, &cell, &height);
  return buffer[cell] > view.frame.col(0).dot(point) + tolerance;
}

/// Sets `inSight` to the places of the points not more than `tolerance` below the buffer.
void keepInSight(const Projected& points, const std::vector<float>& buffer, float tolerance, std::vector<int>& inSight)
{
  const std::size_t count = points.cells.size();
  inSight.resize(count);
  std::size_t found = 0;
  for (std::size_t k = 0; k < count; ++k)
  {
    // Without a branch: half of them would be predicted wrongly.
    inSight[found] = static_cast<int>(k);
    found += points.heights[k] + tolerance >= buffer[points.cells[k]] ? 1 : 0;
  }
  inSight.resize(found);
}
}

PredictedVisibility::PredictedVisibility(const TrainedModel& model, int cachedDirections)
  : CachedDirections(cachedDirections)
  , Diameter(model.diameter)
  , ViewDirections(model.viewDirections)
  , Middle(meanOf(model.surface.empty() ? model.edges.points : model.surface.points))
  , VerificationIndices(model.verificationPoints)
{
  this->Surface.reserve(model.surface.size());
  for (std::size_t k = 0; k < model.surface.size(); ++k)
  {
    this->Surface.add(model.surface.points[k] - this->Middle, model.surface.normals[k]);
    this->Radius = std::max(this->Radius, this->Surface.points[k].norm());
  }
  // Of edges alone a point is never a diameter from the middle.
  const double reach = model.surface.empty() ? this->Diameter : static_cast<double>(this->Radius);
  this->HalfCells = static_cast<float>(std::ceil(reach / this->cellSize()) + WidestBorder + Beside);
  std::vector<bool> areContours(model.edges.size());
  if (!model.surface.empty() && model.edgeViews.size() == model.edges.size())
  {
    this->Contours = OccludingContours(model.surface, SurfacePointSpacing * model.diameter);
    areContours = this->Contours.areContours(model.edges.points, model.edgeViews, model.viewDirections);
  }
  for (std::size_t i = 0; i < model.edges.size(); ++i)
  {
    if (!areContours[i])
    {
      this->SharpEdges.add(model.edges.points[i] - this->Middle, model.edges.tangents[i]);
    }
  }
  for (const int i : model.verificationPoints)
  {
    this->VerificationPoints.add(model.surface.points[i] - this->Middle, model.surface.normals[i]);
  }
}

const PointGrid& PredictedVisibility::Visible::edgeGrid() const
{
  std::shared_ptr<const PointGrid> known = std::atomic_load(&this->grid);
  if (!known)
  {
    Points points(this->edges.size());
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      points[k] = this->edges.points[k];
    }
    const auto made = std::make_shared<const PointGrid>(points, this->cellOfGrid);
    known = std::atomic_compare_exchange_strong(&this->grid, &known, made) ? made : known; // of two threads the first
  }
  return *known;
}

double PredictedVisibility::cellSize() const { return Cell * this->Diameter; }

Eigen::Vector3f PredictedVisibility::towards(const Eigen::Isometry3d& T_scene_model, const Sensor& sensor) const
{
  const Eigen::Vector3d towards = sensor.towards(T_scene_model * this->Middle.cast<double>());
  return (T_scene_model.linear().transpose() * towards).cast<float>();
}

int PredictedVisibility::view(const Eigen::Isometry3d& T_scene_model, const Sensor& sensor) const
{
  const Eigen::Vector3f towards = this->towards(T_scene_model, sensor);
  const Points& views = this->ViewDirections;
  const auto nearer = [&](const auto& a, const auto& b) { return a.dot(towards) < b.dot(towards); };
  return static_cast<int>(std::max_element(views.begin(), views.end(), nearer) - views.begin());
}

std::shared_ptr<const PredictedVisibility::Visible> PredictedVisibility::visible(
  const Eigen::Isometry3d& T_scene_model, const Sensor& sensor, double pitch) const
{
  // The part is small against its distance: lines of sight are taken as parallel. Poses that hardly differ are judged
  // on the same points.
  const Eigen::Vector3f direction = this->towards(T_scene_model, sensor);
  Eigen::Vector3i steps = Eigen::Vector3i::Zero(); // of poses beyond all measure, too
  if (direction.allFinite())
  {
    steps = (static_cast<float>(DirectionSteps) * direction).array().round().cast<int>();
  }
  const int range = 2 * DirectionSteps + 1;
  const double pitchStep = PitchStep * this->Diameter;
  const int pitchSteps = static_cast<int>(std::clamp(std::round(pitch / pitchStep), 0.0, 1.0 * PitchSteps));
  const int key = ((pitchSteps * range + steps.z()) * range + steps.y()) * range + steps.x();
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    const auto recent = this->Recent.find(key);
    if (recent != this->Recent.end())
    {
      return recent->second;
    }
    const auto older = this->Older.find(key);
    if (older != this->Older.end())
    {
      return this->keep(key, older->second);
    }
  }
  auto visible =
    std::make_shared<const Visible>(this->visibleFrom(steps.cast<float>().normalized(), pitchSteps * pitchStep));
  const std::lock_guard<std::mutex> lock(this->Mutex);
  return this->keep(key, std::move(visible));
}

std::shared_ptr<const PredictedVisibility::Visible> PredictedVisibility::keep(
  int key, std::shared_ptr<const Visible> visible) const
{
  if (2 * this->Recent.size() >= static_cast<std::size_t>(this->CachedDirections))
  {
    this->Older = std::move(this->Recent);
    this->Recent.clear();
  }
  return this->Recent.emplace(key, std::move(visible)).first->second;
}

PredictedVisibility::Visible PredictedVisibility::visibleFrom(const Eigen::Vector3f& towards, double pitch) const
{
  const int borderCells =
    static_cast<int>(std::clamp(std::round(Border * pitch / this->cellSize()), 1.0, 1.0 * WidestBorder));
  const double inset = Inset * pitch;
  Visible visible{ towards, {}, {}, {}, {}, {}, static_cast<float>(EdgeCell * this->Diameter), nullptr };
  const float cell = static_cast<float>(Cell * this->Diameter);
  const float tolerance = static_cast<float>(Tolerance * this->Diameter);
  const View across = viewAlong(towards, this->HalfCells, cell);
  struct Room // of the size of the part, and there are hundreds of poses
  {
    Projected surface, others;
    std::vector<float> nearest;
    std::vector<int> inSight;
  };
  thread_local Room room;
  auto& [surface, others, nearest, inSight] = room;
  nearest.assign(static_cast<std::size_t>(across.side) * across.side, Nothing);
  project(across, this->Surface.points, surface);
  raise(surface, nearest);
  visible.outside = outsideOf(nearest, across, borderCells);
  for (Eigen::Vector3f& point : visible.outside)
  {
    point += this->Middle;
  }
  project(across, this->SharpEdges.points, others);
  keepInSight(others, nearest, tolerance + static_cast<float>(EdgeSlope) * cell, inSight);
  const std::vector<OccludingContours::Point> contours = this->Contours.from(towards, inset);
  visible.edges.reserve(inSight.size() + contours.size());
  for (const int k : inSight)
  {
    visible.edges.add(this->SharpEdges.points[k] + this->Middle, this->SharpEdges.directions[k]);
  }
  const float outward = static_cast<float>(Outward * cell + inset);
  for (const OccludingContours::Point& contour : contours)
  {
    if (!isHidden(nearest, across, contour.point - this->Middle, outward * contour.normal, tolerance))
    {
      visible.edges.add(contour.point, contour.tangent);
    }
  }
  project(across, this->VerificationPoints.points, others);
  allowForSlope(towards, this->VerificationPoints.directions, cell, static_cast<float>(GrazingCosine), others);
  keepInSight(others, nearest, tolerance, inSight);
  visible.surface.reserve(inSight.size());
  visible.isInner.reserve(inSight.size());
  visible.falls.reserve(inSight.size());
  const float drop = static_cast<float>(Drop * this->Diameter);
  for (const int k : inSight)
  {
    visible.surface.push_back(this->VerificationIndices[k]);
    const int at = others.cells[k];
    const bool isInner = lowestBeside(nearest, across.side, at, borderCells) > Nothing;
    const float fall = isInner ? nearest[at] - lowestBeside(nearest, across.side, at, 1) : 0.0f;
    visible.isInner.push_back(isInner);
    visible.falls.push_back(fall > drop ? fall : 0.0f);
  }
  return visible;
}

std::vector<int> PredictedVisibility::samplesInSight(
  const Eigen::Isometry3d& T_scene_model, const Sensor& sensor, double leastCosine) const
{
  const Eigen::Vector3f towards = this->towards(T_scene_model, sensor);
  const float cell = static_cast<float>(Cell * this->Diameter);
  const View across = viewAlong(towards, this->HalfCells, cell);
  Projected surface;
  project(across, this->Surface.points, surface);
  std::vector<float> nearest(static_cast<std::size_t>(across.side) * across.side, Nothing);
  raise(surface, nearest);
  allowForSlope(towards, this->Surface.directions, cell, static_cast<float>(leastCosine), surface);
  std::vector<int> inSight;
  keepInSight(surface, nearest, static_cast<float>(Tolerance * this->Diameter), inSight);
  return inSight;
}
}
