// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Frames.h"
#include "base/PointCloud.h"

#include <cmath>

namespace meam
{
/// How a pair of points with directions is described: edge points with tangent lines, or surface points with normals.
enum class PairFeatureKind
{
  Paper,    ///< of tangents, Equation (1): the distance and three acute angles
  Oriented, ///< of tangents, both turned along d: the third angle is full, and mirror images differ
  Surface   ///< of normals (Drost et al. 2010, the paper's [12]): the distance and three full angles
};

/// Whether the directions are lines: a tangent has no sign, a normal has.
constexpr bool isOfLines(PairFeatureKind kind) { return kind != PairFeatureKind::Surface; }

/// Of edge points B2B-TL, the boundary-to-boundary feature using tangent lines (paper, Section 3), the same for both
/// signs of each tangent; of surface points the pair feature of [12]. The same under any rigid motion. Lengths in mm,
/// angles in radians.
struct PairFeature
{
  float distance;       ///< f1 = |d|, d from the reference to the referred point
  float referenceAngle; ///< f2, direction at the reference point against d: [0, pi/2], of normals [0, pi]
  float referredAngle;  ///< f3, direction at the referred point against d: the same
  float betweenAngle;   ///< f4, between the directions: [0, pi/2] (Paper) or [0, pi]
  bool rightHanded;     ///< sign of det[t_r, t_i, d] with both tangents along d (Oriented)
};

/// The angle of a cosine in [0, 1] in radians, within 3e-7 (Abramowitz and Stegun, 4.4.46): without branches or calls,
/// so that loops over it run on several values at a time.
inline float acuteAngle(float cosine)
{
  float sum = -0.0012624911f;
  for (const float coefficient :
    { 0.0066700901f, -0.0170881256f, 0.0308918810f, -0.0501743046f, 0.0889789874f, -0.2145988016f, 1.5707963050f })
  {
    sum = sum * cosine + coefficient;
  }
  return std::sqrt(1.0f - cosine) * sum;
}

/// The same for a cosine in [-1, 1], up to pi.
inline float fullAngle(float cosine)
{
  const float acute = acuteAngle(std::abs(cosine));
  return cosine < 0.0f ? static_cast<float>(M_PI) - acute : acute;
}

/// The feature of reference point `pr` with unit direction `tr` and referred point `pi` with `ti`.
inline PairFeature pairFeature(PairFeatureKind kind, const Eigen::Vector3f& pr, const Eigen::Vector3f& tr,
  const Eigen::Vector3f& pi, const Eigen::Vector3f& ti)
{
  const Eigen::Vector3f d = pi - pr;
  const float length = d.norm();
  const float alongReference = tr.dot(d);
  const float alongReferred = ti.dot(d);
  const float between = tr.dot(ti);
  PairFeature feature;
  feature.distance = length;
  if (!isOfLines(kind))
  {
    const auto angle = [](float cosine) { return fullAngle(std::min(std::max(cosine, -1.0f), 1.0f)); };
    feature.referenceAngle = length > 0.0f ? angle(alongReference / length) : 0.0f;
    feature.referredAngle = length > 0.0f ? angle(alongReferred / length) : 0.0f;
    feature.betweenAngle = angle(between);
    feature.rightHanded = false;
    return feature;
  }
  feature.referenceAngle = length > 0.0f ? acuteAngle(std::min(std::abs(alongReference) / length, 1.0f)) : 0.0f;
  feature.referredAngle = length > 0.0f ? acuteAngle(std::min(std::abs(alongReferred) / length, 1.0f)) : 0.0f;
  if (kind == PairFeatureKind::Paper)
  {
    feature.betweenAngle = acuteAngle(std::min(std::abs(between), 1.0f));
    feature.rightHanded = false;
  }
  else
  {
    const float sign = (alongReference < 0.0f) != (alongReferred < 0.0f) ? -1.0f : 1.0f;
    feature.betweenAngle = fullAngle(std::min(std::max(sign * between, -1.0f), 1.0f));
    feature.rightHanded = sign * tr.cross(ti).dot(d) > 0.0f;
  }
  return feature;
}

/// Cuts features into the keys of a dense table (paper, Section 3: steps d_dist and d_angle).
class PairFeatureQuantizer
{
public:
  PairFeatureQuantizer() = default;
  /// Steps in mm and radians; `maximumDistance` (mm) is d_max.
  PairFeatureQuantizer(PairFeatureKind kind, double distanceStep, double angleStep, double maximumDistance)
    : Kind(kind)
    , InverseDistance(static_cast<float>(1.0 / distanceStep))
    , InverseAngle(static_cast<float>(1.0 / angleStep))
    , Longest(static_cast<float>(maximumDistance * (1.0 + Rounding)))
    , Distances(static_cast<int>(std::min(1e9, std::floor(maximumDistance / distanceStep))) + 1)
    , Along(static_cast<int>(std::ceil((isOfLines(kind) ? M_PI_2 : M_PI) / angleStep - 1e-6)))
    , Between(kind == PairFeatureKind::Paper ? this->Along : static_cast<int>(std::ceil(M_PI / angleStep - 1e-6)))
  {
  }

  PairFeatureKind kind() const { return this->Kind; }
  std::int64_t numberOfKeys() const
  {
    return static_cast<std::int64_t>(this->Distances) * this->Along * this->Along * this->Between *
           (this->Kind == PairFeatureKind::Oriented ? 2 : 1);
  }
  /// The key in [0, numberOfKeys()), or -1 for a pair longer than d_max. Keys are int: tables of more are
  /// refused (TrainedModel::MostKeys).
  int key(const PairFeature& feature) const
  {
    // Written without branches: it runs in loops over many pairs.
    const auto bin = [this](float angle, int bins)
    { return std::min(static_cast<int>(angle * this->InverseAngle), bins - 1); };
    const int distance =
      static_cast<int>(std::min(feature.distance * this->InverseDistance, static_cast<float>(this->Distances - 1)));
    // The sums do not wait for each other.
    const int along = bin(feature.referenceAngle, this->Along) * this->Along + bin(feature.referredAngle, this->Along);
    int key = (distance * this->Along * this->Along + along) * this->Between + bin(feature.betweenAngle, this->Between);
    const int oriented = 2 * key + (feature.rightHanded ? 1 : 0);
    key = this->Kind == PairFeatureKind::Oriented ? oriented : key;
    return feature.distance <= this->Longest ? key : -1;
  }

private:
  static constexpr double Rounding = 1e-5; // by which the part's longest pair may be longer than d_max

  PairFeatureKind Kind = PairFeatureKind::Oriented;
  float InverseDistance = 1.0f;
  float InverseAngle = 1.0f;
  float Longest = 0.0f;
  int Distances = 1;
  int Along = 1;
  int Between = 1;
};

/// The local frame of a point with a direction, an edge point's tangent (paper, Figure 7) or a surface point's normal:
/// T_{m->g} takes the point to the origin and its direction to the x axis. The rotation about x is fixed by the
/// direction alone.
struct PairFrame
{
  PairFrame(const Eigen::Vector3f& point, const Eigen::Vector3f& direction)
    : Origin(point)
    , Axes(frameAround(direction))
  {
  }
  /// The angle of a point about the direction, in (-pi, pi].
  float angleOf(const Eigen::Vector3f& point) const
  {
    const Eigen::Vector3f d = point - this->Origin;
    return std::atan2(this->Axes.col(2).dot(d), this->Axes.col(1).dot(d));
  }
  /// True when d points against the stored direction.
  bool against(const Eigen::Vector3f& point) const { return this->Axes.col(0).dot(point - this->Origin) < 0.0f; }

  Eigen::Vector3f Origin;
  Eigen::Matrix3f Axes;
};

/// T_scene_model that lays the model's frame on the scene's after a turn by `alpha` (radians) about
/// their direction (Equation (3)); `flip` turns the model's tangent the other way round first.
Eigen::Isometry3d alignFrames(const PairFrame& model, const PairFrame& scene, bool flip, double alpha);
}
