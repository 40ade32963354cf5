// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/symmetry/SymmetryDetection.h"

#include "base/Parallel.h"
#include "base/PointGrid.h"
#include "base/sequences/Quantiles.h"
#include "base/sequences/Sequences.h"
#include "mesh/ConvexHull.h"
#include "mesh/symmetry/SampleIndex.h"
#include "mesh/Viewpoints.h"
#include "pose/refinement/NormalEquations.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meam
{
namespace
{
constexpr double ToleranceShare = 0.01; // of the diameter
// Axes
constexpr int AxesTried = 1500;    // directions on a sphere that are tried: 3 degrees from any direction to the nearest
constexpr int Orders = 8;          // turns by 360 / k degrees up to this k find axes; the scan finds the others
constexpr double MostMisfit = 0.6; // mean distance of a turned surface, of the reach: more is no axis or angle
constexpr int MostAxes = 24;       // the best of them that are looked at,
constexpr double AxisSeparation = 12.0;  // degrees: nearer ones are the same; a fitted one that is farther is another
constexpr double CoarseLeafShare = 0.15; // of the diameter, cubes of which one point finds axes,
constexpr double ScanLeafShare = 0.06;   // and one finds angles and fits,
constexpr double SparseLeafShare = 0.03; // cubes of which one point is the surface that both are laid on
// Angles
constexpr int ScanSteps = 120;          // of a full turn about an axis,
constexpr int FirstStep = 3;            // from which on, to both sides, a turn is looked at,
constexpr double LeastTurn = 8.0;       // degrees: fitted, a smaller one is none,
constexpr double SameTurn = 4.0;        // and two that differ by less are one
constexpr int ContinuousTurns = 11;     // of a continuous symmetry, all of which have to be exact,
constexpr double ContinuousStep = 31.0; // degrees from one to the next, which no small order shares
// Distances from the surface, and the fit of a turn
constexpr double ReachShare = 0.08;     // of the diameter: larger distances are told as this
constexpr double NearSpacings = 2.0;    // spacings: most points that lie on the surface have a sample this near
constexpr double AlongSpacings = 1.5;   // along the surface from a sample to where the next one stands for it
constexpr double SameSideCosine = 0.7;  // cosine of 45 degrees between the normals of corresponding points
constexpr int FitSteps = 12;            // with correspondences within the reach in the first,
constexpr double LastReachShare = 0.25; // and within this share of it in the last
constexpr double ShownSpacing = 0.1;    // of the reach in surfaceDeviation(), taken for the spacing of the samples

constexpr double Degree = M_PI / 180.0; // radians

double turnBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b)
{
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle() / Degree;
}

/// Distances of moved points from the surface.
class SurfaceMatcher
{
public:
  SurfaceMatcher(const PointCloud& surface, double spacing, double reach)
    : Surface(surface)
    , Index(surface, NearSpacings * spacing, SameSideCosine)
    , Near(NearSpacings * static_cast<float>(spacing))
    , Along(static_cast<float>(AlongSpacings) * static_cast<float>(spacing))
    , Reach(static_cast<float>(reach))
  {
  }

  /// The nearest sample on the same side of the surface, or -1.
  int corresponding(const Eigen::Vector3f& point, const Eigen::Vector3f& normal, double reach) const
  {
    double within = std::min(reach, this->Near);
    int best = this->Index.nearest(point, normal, within);
    while (best < 0 && within < reach) // most have one near
    {
      within = std::min(reach, 2.0 * within);
      best = this->Index.nearest(point, normal, within);
    }
    return best;
  }

  /// From the sample's tangent plane, so that the spacing of the samples does not count.
  float distance(const Eigen::Vector3f& point, const Eigen::Vector3f& normal) const
  {
    return this->distance(point, normal, this->Reach);
  }

  /// The same; the reach where it is more than `most` for sure, without a look farther than that takes.
  float distance(const Eigen::Vector3f& point, const Eigen::Vector3f& normal, double most) const
  {
    constexpr double margin = 1.01; // for rounding
    const double enough = margin * (most + this->Along);
    const int k = this->corresponding(point, normal, std::min<double>(this->Reach, enough));
    if (k < 0)
    {
      return this->Reach;
    }
    const Eigen::Vector3f offset = point - this->Surface.points[k];
    const float across = std::abs(this->Surface.normals[k].dot(offset));
    const float along = std::max(0.0f, std::sqrt(std::max(0.0f, offset.squaredNorm() - across * across)) - this->Along);
    return std::min(this->Reach, std::hypot(across, along));
  }

  /// Whether a sample has no neighbour on its side of the surface: its face is a sliver with a normal of its own.
  bool isAlone(int sample) const
  {
    bool alone = true;
    this->Index.grid().forEachWithin(this->Surface.points[sample], this->Near,
      [&](int k, float)
      {
        alone = alone && (k == sample || this->Surface.normals[k].dot(this->Surface.normals[sample]) <=
                                           static_cast<float>(SameSideCosine));
      });
    return alone;
  }

  float distance(int sample, const Eigen::Isometry3f& T, double most) const
  {
    return this->distance(T * this->Surface.points[sample], T.linear() * this->Surface.normals[sample], most);
  }
  float distance(int sample, const Eigen::Isometry3f& T) const { return this->distance(sample, T, this->Reach); }

  /// Mean distance of some samples after a motion, as a share of the reach.
  double misfit(const PointCloud& samples, const Eigen::Isometry3d& T, double worst = 1.0) const
  {
    const Eigen::Isometry3f Tf = T.cast<float>();
    const double limit = worst * this->Reach * samples.size();
    double sum = 0.0;
    for (std::size_t i = 0; i < samples.size(); ++i)
    {
      sum += this->distance(Tf * samples.points[i], Tf.linear() * samples.normals[i]);
      if (sum > limit)
      {
        return 1.0;
      }
    }
    return sum / (this->Reach * samples.size());
  }

  /// Moves T to where the samples fit the surface best.
  Eigen::Isometry3d fitted(const PointCloud& samples, Eigen::Isometry3d T, const Eigen::Vector3d& middle) const
  {
    for (int step = 0; step < FitSteps; ++step)
    {
      const double share = static_cast<double>(step) / (FitSteps - 1);
      const double reach = this->Reach * std::pow(LastReachShare, share);
      const Eigen::Isometry3f Tf = T.cast<float>();
      NormalEquations fit(T * middle);
      for (std::size_t i = 0; i < samples.size(); ++i)
      {
        const Eigen::Vector3f point = Tf * samples.points[i];
        const int k = this->corresponding(point, Tf.linear() * samples.normals[i], reach);
        if (k >= 0)
        {
          const Eigen::Vector3f& normal = this->Surface.normals[k];
          fit.add(point.cast<double>(), normal.cast<double>(), normal.dot(point - this->Surface.points[k]));
        }
      }
      T = fit.result().motion * T;
    }
    return T;
  }

private:
  const PointCloud& Surface;
  SampleIndex Index;
  double Near; ///< mm
  float Along; ///< mm
  float Reach; ///< mm
};

struct Candidate
{
  Eigen::Vector3d axis;
  double misfit = 1.0;
};

/// What an axis turned out to be.
struct Axis
{
  bool isContinuous = false;
  ContinuousSymmetry continuous;
  std::vector<NearSymmetry> turns;
};

class Detector
{
public:
  Detector(const PointCloud& surface, const SymmetryDetectionSettings& settings)
    : Surface(surface)
    , Settings(settings)
    , Diameter(diameter(surface.points))
    , Tolerance(settings.tolerance > 0.0 ? settings.tolerance : ToleranceShare * this->Diameter)
    , Reach(ReachShare * this->Diameter)
    , Sparse(surface.subset(thinPoints(surface.points, SparseLeafShare * this->Diameter)))
    , Matcher(surface, this->spacing(), this->Reach)
    , SparseMatcher(this->Sparse, SparseLeafShare * this->Diameter, this->Reach)
    , Coarse(surface.subset(thinPoints(surface.points, CoarseLeafShare * this->Diameter)))
    , Scan(surface.subset(thinPoints(surface.points, ScanLeafShare * this->Diameter)))
  {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& point : surface.points)
    {
      sum += point.cast<double>();
    }
    this->Middle = sum / static_cast<double>(surface.size());
    for (int i = 0; i < static_cast<int>(surface.size()); ++i)
    {
      if (!this->Matcher.isAlone(i))
      {
        this->Measured.push_back(i);
      }
    }
    if (2 * this->Measured.size() < surface.size()) // no sampling with neighbours
    {
      this->Measured.resize(surface.size());
      std::iota(this->Measured.begin(), this->Measured.end(), 0);
    }
  }

  Symmetries detect(const Progress& progress)
  {
    Symmetries found;
    const std::vector<Candidate> axes = this->axes(subProgress(progress, 0.0, 0.5));
    std::vector<Axis> examined(axes.size());
    parallelForEach(static_cast<int>(axes.size()), 0, subProgress(progress, 0.5, 1.0),
      [&](int a)
      {
        examined[a].isContinuous = this->isContinuous(axes[a].axis, examined[a].continuous);
        if (!examined[a].isContinuous)
        {
          examined[a].turns = this->turnsAbout(axes[a].axis);
        }
      });
    std::vector<NearSymmetry> turns;
    for (const Axis& axis : examined)
    {
      if (axis.isContinuous)
      {
        found.continuous.push_back(axis.continuous);
      }
      if (found.continuous.size() == 2)
      {
        return this->sphere(); // two axes generate all rotations
      }
      for (const NearSymmetry& candidate : axis.turns)
      {
        this->keep(candidate, turns);
      }
    }
    this->sortOut(turns, found);
    report(progress, 1.0);
    return found;
  }

private:
  double spacing() const
  {
    // Of an even sampling: the mean area of a sample is close to the square of the spacing.
    constexpr double cell = 0.02;         // of the diameter, of the grid
    constexpr double farthest = 0.1;      // of the diameter, samples are denser
    constexpr std::size_t measured = 500; // samples, for a median
    std::vector<float> nearest;
    const PointGrid grid(this->Surface.points, cell * this->Diameter);
    for (std::size_t i = 0; i < this->Surface.size(); i += 1 + this->Surface.size() / measured)
    {
      float least = static_cast<float>(this->Diameter * this->Diameter);
      grid.forEachWithin(this->Surface.points[i], farthest * this->Diameter,
        [&](int k, float distance)
        {
          if (k != static_cast<int>(i))
          {
            least = std::min(least, distance);
          }
        });
      nearest.push_back(least);
    }
    return std::sqrt(medianOf(nearest));
  }

  /// Axes about which some turn maps the surface roughly onto itself, best first.
  std::vector<Candidate> axes(const Progress& progress) const
  {
    Points directions = viewDirections(AxesTried);
    for (const auto& axis : viewDirections(26))
    {
      directions.push_back(axis); // the axes of coordinates are likely ones: CAD parts are drawn along them
    }
    eraseIf(directions,
      [](const auto& d) { return d.z() < -1e-6f || (std::abs(d.z()) <= 1e-6f && d.x() + 1e-3f * d.y() < 0.0f); });
    std::vector<Candidate> candidates(directions.size());
    parallelForEach(static_cast<int>(directions.size()), 0, progress,
      [&](int i)
      {
        candidates[i].axis = directions[i].cast<double>().normalized();
        for (int order = 2; order <= Orders; ++order)
        {
          const double misfit = this->SparseMatcher.misfit(
            this->Coarse, turnAbout(candidates[i].axis, 2.0 * M_PI / order, this->Middle), candidates[i].misfit);
          candidates[i].misfit = std::min(candidates[i].misfit, misfit);
        }
      });
    std::stable_sort(
      candidates.begin(), candidates.end(), [](const auto& a, const auto& b) { return a.misfit < b.misfit; });
    const double same = std::cos(AxisSeparation * Degree);
    std::vector<Candidate> best;
    for (const Candidate& candidate : candidates)
    {
      const bool known = std::any_of(best.begin(), best.end(),
        [&](const Candidate& other) { return std::abs(other.axis.dot(candidate.axis)) > same; });
      if (!known && candidate.misfit < MostMisfit)
      {
        best.push_back(candidate);
        if (static_cast<int>(best.size()) == MostAxes)
        {
          break;
        }
      }
    }
    return best;
  }

  Symmetries sphere() const
  {
    Symmetries found;
    for (int axis = 0; axis < 3; ++axis)
    {
      found.continuous.push_back({ Eigen::Vector3d::Unit(axis), this->Middle });
    }
    return found;
  }

  /// How well a turn maps the surface onto itself. One of which less than `leastOverlap` can come to lie on it is not
  /// looked at any further: it deviates by the reach.
  NearSymmetry measured(const Eigen::Isometry3d& T, double leastOverlap) const
  {
    const float tolerance = static_cast<float>(this->Tolerance);
    const std::size_t count = 2 * this->Measured.size();
    const Eigen::Isometry3f ways[] = { T.cast<float>(), T.inverse().cast<float>() };
    NearSymmetry result;
    result.T = T;
    std::vector<std::pair<int, int>> beyond; // the tolerance: way, sample
    std::size_t within = 0;
    float largest = 0.0f;
    for (int way = 0; way < 2; ++way)
    {
      for (const int i : this->Measured)
      {
        const float distance = this->Matcher.distance(i, ways[way], this->Tolerance);
        if (distance <= tolerance)
        {
          ++within;
          largest = std::max(largest, distance);
          continue;
        }
        beyond.emplace_back(way, i);
        if (static_cast<double>(count - beyond.size()) / static_cast<double>(count) < leastOverlap)
        {
          result.overlap = 0.0;
          result.deviation = this->Reach;
          return result;
        }
      }
    }
    for (const auto& [way, i] : beyond)
    {
      largest = std::max(largest, this->Matcher.distance(i, ways[way]));
    }
    result.overlap = static_cast<double>(within) / static_cast<double>(count);
    result.deviation = largest;
    return result;
  }

  /// Whether a turn is exact, up to the tolerance.
  bool isExact(const Eigen::Isometry3d& T) const { return this->measured(T, 1.0).deviation <= this->Tolerance; }

  /// The turn fitted to the surface, or as it is where it is exact and fitting makes it worse: a flat sheet can slide
  /// along itself.
  NearSymmetry bestNear(const Eigen::Isometry3d& T) const
  {
    const NearSymmetry unfitted = this->measured(T, 1.0);
    const NearSymmetry fitted =
      this->measured(this->Matcher.fitted(this->Scan, T, this->Middle), this->Settings.leastOverlap);
    return unfitted.deviation < std::min(fitted.deviation, this->Tolerance) ? unfitted : fitted;
  }

  bool isContinuous(const Eigen::Vector3d& roughly, ContinuousSymmetry& result) const
  {
    // The axis of a fitted third of a turn is the exact one, if there is one.
    const Eigen::Isometry3d T =
      this->Matcher.fitted(this->Scan, turnAbout(roughly, 2.0 * M_PI / 3.0, this->Middle), this->Middle);
    const Eigen::AngleAxisd exact(T.linear());
    if (std::abs(exact.axis().dot(roughly)) < std::cos(AxisSeparation * Degree))
    {
      return false;
    }
    result.axis = exact.axis();
    result.point = this->fixedPoint(T, exact.axis());
    for (int i = 1; i <= ContinuousTurns; ++i)
    {
      // Angles that no small order shares.
      const Eigen::Isometry3d S = turnAbout(result.axis, i * ContinuousStep * Degree, result.point);
      if (this->Matcher.misfit(this->Scan, S) * ReachShare * this->Diameter > this->Tolerance || !this->isExact(S))
      {
        return false;
      }
    }
    return true;
  }

  /// The point of the axis of T that is nearest to the middle.
  Eigen::Vector3d fixedPoint(const Eigen::Isometry3d& T, const Eigen::Vector3d& axis) const
  {
    // (I - R) p = t across the axis.
    const Eigen::Matrix3d A = Eigen::Matrix3d::Identity() - T.linear() + axis * axis.transpose();
    const Eigen::Vector3d b = T.translation() - axis * axis.dot(T.translation()) + axis * axis.dot(this->Middle);
    return A.fullPivLu().solve(b);
  }

  /// Turns about an axis where the fit is best among their neighbours.
  std::vector<NearSymmetry> turnsAbout(const Eigen::Vector3d& axis) const
  {
    const int steps = ScanSteps, first = FirstStep;
    const auto misfits = ofIndices<double>(steps, [&](int step)
      { return this->SparseMatcher.misfit(this->Scan, turnAbout(axis, 2.0 * M_PI * step / steps, this->Middle)); });
    std::vector<NearSymmetry> turns;
    for (int step = first; step <= steps - first; ++step)
    {
      if (misfits[step] > misfits[step - 1] || misfits[step] > misfits[(step + 1) % steps] ||
          misfits[step] > MostMisfit)
      {
        continue;
      }
      const NearSymmetry turn = this->bestNear(turnAbout(axis, 2.0 * M_PI * step / steps, this->Middle));
      if (Eigen::AngleAxisd(turn.T.linear()).angle() > LeastTurn * Degree)
      {
        turns.push_back(turn);
      }
    }
    return turns;
  }

  void keep(const NearSymmetry& candidate, std::vector<NearSymmetry>& turns) const
  {
    if (candidate.overlap < this->Settings.leastOverlap)
    {
      return;
    }
    for (NearSymmetry& known : turns)
    {
      if (turnBetween(known.T, candidate.T) < SameTurn)
      {
        if (candidate.overlap > known.overlap ||
            (candidate.overlap == known.overlap && candidate.deviation < known.deviation))
        {
          known = candidate;
        }
        return;
      }
    }
    turns.push_back(candidate);
  }

  bool isTurnAbout(const Eigen::Isometry3d& T, const ContinuousSymmetry& symmetry) const
  {
    return (T.linear() * symmetry.axis).dot(symmetry.axis) > std::cos(SameTurn * Degree);
  }

  /// Exact turns, closed to a group, and near ones.
  void sortOut(const std::vector<NearSymmetry>& turns, Symmetries& found) const
  {
    std::vector<NearSymmetry> exact;
    for (const NearSymmetry& candidate : turns)
    {
      const bool continuous = std::any_of(found.continuous.begin(), found.continuous.end(),
        [&](const ContinuousSymmetry& symmetry) { return this->isTurnAbout(candidate.T, symmetry); });
      if (continuous)
      {
        continue;
      }
      if (candidate.deviation > this->Tolerance)
      {
        found.near.push_back(candidate);
      }
      else if (found.continuous.empty())
      {
        exact.push_back(candidate);
      }
      else if (found.continuous.size() == 1 && found.discrete.empty())
      {
        found.discrete.push_back(candidate.T); // the flip; all others are turns of it about the axis
      }
    }
    std::stable_sort(
      found.near.begin(), found.near.end(), [](const auto& a, const auto& b) { return a.overlap > b.overlap; });
    constexpr std::size_t most = 120; // turns, twice as many as an icosahedron has
    for (std::size_t i = 0; i < exact.size(); ++i)
    {
      for (std::size_t k = 0; k < exact.size() && exact.size() < most; ++k)
      {
        const Eigen::Isometry3d product = exact[i].T * exact[k].T;
        const bool known = Eigen::AngleAxisd(product.linear()).angle() < SameTurn * Degree ||
                           std::any_of(exact.begin(), exact.end(),
                             [&](const NearSymmetry& other) { return turnBetween(other.T, product) < SameTurn; });
        if (!known)
        {
          // The product of two symmetries is one; fitted again, so that errors do not add up.
          const NearSymmetry fitted = this->bestNear(product);
          if (fitted.deviation <= this->Tolerance)
          {
            exact.push_back(fitted);
          }
        }
      }
    }
    for (const NearSymmetry& symmetry : exact)
    {
      found.discrete.push_back(symmetry.T);
    }
  }

  const PointCloud& Surface;
  SymmetryDetectionSettings Settings;
  double Diameter;
  double Tolerance; ///< mm
  double Reach;     ///< mm
  PointCloud Sparse;
  SurfaceMatcher Matcher;
  SurfaceMatcher SparseMatcher;
  PointCloud Coarse;
  PointCloud Scan;
  std::vector<int> Measured; ///< the samples that are not alone
  Eigen::Vector3d Middle;
};
}

Symmetries detectSymmetries(
  const PointCloud& surface, const SymmetryDetectionSettings& settings, const Progress& progress)
{
  requirePoints(surface.points, "The part's surface");
  if (surface.normals.size() != surface.size())
  {
    throw Error("The surface has no normals: sample the surface of a mesh first.");
  }
  return Detector(surface, settings).detect(progress);
}

std::vector<float> surfaceDeviation(const PointCloud& surface, const Eigen::Isometry3d& T, double reach)
{
  const SurfaceMatcher matcher(surface, ShownSpacing * reach, reach);
  const Eigen::Isometry3f Tf = T.cast<float>();
  return ofIndices<float>(surface.size(), [&](int i) { return matcher.distance(i, Tf); });
}
}
