// SPDX-License-Identifier: BSD-3-Clause
#include "model/MirrorImage.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace meam
{
namespace
{
constexpr int PlanesOfAxis = 36;      // through each principal axis: of a nearly round part it may be any of them
constexpr int FinerSteps = 10;        // from the best of them to its neighbors
constexpr double NearMirrored = 0.01; // of the diameter: surface that comes to lie so near to the part's is shared
constexpr double ItsOwn = 0.98;       // of the surface, shared: the part is its own mirror image
constexpr double LeastShared = 0.35;  // of less no pose of one fits the other
constexpr double LeastOfBest = 0.4;   // times the most that is shared: another way in which the mirrored part may lie
constexpr std::size_t MostTurns = 8;  // of these
constexpr float SamePlane = 0.94f;    // cosine between the normals of planes that are tried as one: 20 degrees,
constexpr double SameOffset = 0.03;   // and of the diameter, between them

/// At a plane through `at` with this normal.
struct Reflection
{
  Eigen::Vector3f at, normal;
  double overlap = 0.0; ///< share of the part's surface that it takes to its surface

  Eigen::Vector3f direction(const Eigen::Vector3f& v) const { return v - 2.0f * this->normal.dot(v) * this->normal; }
  Eigen::Vector3f point(const Eigen::Vector3f& p) const { return this->at + this->direction(p - this->at); }
  Eigen::Affine3d transform() const
  {
    const Eigen::Vector3d n = this->normal.cast<double>().normalized(), on = this->at.cast<double>();
    return Eigen::Translation3d(2.0 * n.dot(on) * n) *
           Eigen::Affine3d(Eigen::Matrix3d::Identity() - 2.0 * n * n.transpose());
  }
};

double overlapOf(const Reflection& reflection, const TrainedModel& model)
{
  const auto near = static_cast<float>(NearMirrored * model.diameter);
  const std::vector<int>& points = model.verificationPoints;
  const auto shared = std::count_if(points.begin(), points.end(),
    [&](int k) { return model.surfaceDistance.at(reflection.point(model.surface.points[k])) < near; });
  return static_cast<double>(shared) / static_cast<double>(points.size());
}

/// At the planes with this normal through the middle of the surface, and through the middle of its extent.
std::array<Reflection, 2> reflectionsAt(const Eigen::Vector3f& normal, const TrainedModel& model)
{
  const Eigen::Vector3f middle = model.visibility->middle();
  float least = 0.0f, most = 0.0f;
  for (const int k : model.verificationPoints)
  {
    const float height = normal.dot(model.surface.points[k] - middle);
    least = std::min(least, height);
    most = std::max(most, height);
  }
  std::array<Reflection, 2> both{ Reflection{ middle, normal },
    Reflection{ middle + 0.5f * (least + most) * normal, normal } };
  for (Reflection& one : both)
  {
    one.overlap = overlapOf(one, model);
  }
  return both;
}

/// At planes along the principal axes, the most overlap first.
std::vector<Reflection> reflectionsOf(const TrainedModel& model)
{
  const Eigen::Vector3f middle = model.visibility->middle();
  Eigen::Matrix3f scatter = Eigen::Matrix3f::Zero();
  for (const Eigen::Vector3f& point : model.surface.points)
  {
    scatter += (point - middle) * (point - middle).transpose();
  }
  const Eigen::Matrix3f axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f>(scatter).eigenvectors();
  const auto hasMore = [](const Reflection& a, const Reflection& b) { return a.overlap > b.overlap; };
  constexpr double step = M_PI / PlanesOfAxis;
  std::vector<Reflection> reflections;
  for (int axis = 0; axis < 3; ++axis)
  {
    std::vector<Reflection> about;
    const auto add = [&](double angle)
    {
      const Eigen::Vector3f normal = static_cast<float>(std::cos(angle)) * axes.col((axis + 1) % 3) +
                                     static_cast<float>(std::sin(angle)) * axes.col((axis + 2) % 3);
      const std::array<Reflection, 2> both = reflectionsAt(normal.normalized(), model);
      about.insert(about.end(), both.begin(), both.end());
    };
    for (int k = 0; k < PlanesOfAxis; ++k)
    {
      add(k * step);
    }
    const auto best = std::max_element(
      about.begin(), about.end(), [&](const Reflection& a, const Reflection& b) { return hasMore(b, a); });
    const double angleOfBest = step * static_cast<double>((best - about.begin()) / 2); // of two at each angle
    for (int k = 1; k < FinerSteps; ++k)
    {
      add(angleOfBest + step * k / FinerSteps);
      add(angleOfBest - step * k / FinerSteps);
    }
    reflections.insert(reflections.end(), about.begin(), about.end());
  }
  std::stable_sort(reflections.begin(), reflections.end(), hasMore);
  return reflections;
}

void reflect(PointCloud& cloud, const Reflection& reflection)
{
  for (Eigen::Vector3f& point : cloud.points)
  {
    point = reflection.point(point);
  }
  for (Points* directions : { &cloud.normals, &cloud.tangents })
  {
    for (Eigen::Vector3f& direction : *directions)
    {
      direction = reflection.direction(direction);
    }
  }
}

TrainedModel mirroredModel(const TrainedModel& model, const Reflection& reflection)
{
  TrainedModel mirrored;
  mirrored.diameter = model.diameter;
  mirrored.settings = model.settings;
  mirrored.viewDirections = model.viewDirections;
  for (Eigen::Vector3f& direction : mirrored.viewDirections)
  {
    direction = reflection.direction(direction);
  }
  mirrored.edges = model.edges;
  reflect(mirrored.edges, reflection);
  mirrored.edgeViews = model.edgeViews;
  mirrored.edgeVisible = model.edgeVisible;
  mirrored.surface = model.surface;
  reflect(mirrored.surface, reflection);
  mirrored.thickness = model.thickness;
  mirrored.width = model.width;
  mirrored.verificationPoints = model.verificationPoints; // others would tell the two apart
  mirrored.visibility = std::make_shared<const PredictedVisibility>(mirrored);
  return mirrored;
}

Mirroring findMirroring(const TrainedModel& model)
{
  if (model.surface.empty())
  {
    return {};
  }
  const std::vector<Reflection> reflections = reflectionsOf(model);
  const Reflection& best = reflections.front();
  if (best.overlap < LeastShared || best.overlap >= ItsOwn)
  {
    return {};
  }
  std::vector<Reflection> tried;
  std::vector<Eigen::Isometry3d> turns;
  for (const Reflection& one : reflections)
  {
    const auto isSame = [&](const Reflection& other)
    {
      return std::abs(other.normal.dot(one.normal)) > SamePlane &&
             std::abs(one.normal.dot(other.at - one.at)) < SameOffset * model.diameter;
    };
    if (one.overlap >= LeastOfBest * best.overlap && turns.size() < MostTurns &&
        std::none_of(tried.begin(), tried.end(), isSame))
    {
      tried.push_back(one);
      turns.emplace_back((one.transform() * best.transform()).matrix());
    }
  }
  return { best.at, best.normal, turns };
}
}

MirrorImage::MirrorImage(Mirroring known)
  : Found(std::move(known))
{
  std::call_once(this->IsFound, [] {});
}

const Mirroring& MirrorImage::mirroring(const TrainedModel& model) const
{
  std::call_once(this->IsFound, [&] { this->Found = findMirroring(model); });
  return this->Found;
}

const MirroredPart* MirrorImage::of(const TrainedModel& model) const
{
  const Mirroring& found = this->mirroring(model);
  std::call_once(this->IsMade,
    [&]
    {
      if (!found.turns.empty())
      {
        this->Mirrored = MirroredPart{ mirroredModel(model, { found.at, found.normal }), found.turns };
      }
    });
  return this->Mirrored ? &*this->Mirrored : nullptr;
}
}
