// SPDX-License-Identifier: BSD-3-Clause
#include "model/SideSymmetries.h"

#include "model/TrainedModel.h"
#include "scene/Sensor.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace meam
{
namespace
{
constexpr float SameSide = 0.985f;      // cosine: normals and directions that differ by less than 10 degrees are one
constexpr double FlatShare = 0.04;      // of the samples, on faces with one normal: the part is looked at along it
constexpr double LeastCosine = 0.25;    // of surface towards the sensor: flatter is measured badly
constexpr std::size_t MostPoints = 600; // of a side that are turned
constexpr double Near = 0.01;           // of the diameter: a turned point this near to the surface lies on it
constexpr double Alike = 0.9;           // share of a side that lies on the surface after a turn: from here on the scan
                                        // has to tell the two apart
constexpr double Round = 0.98;          // the same after every turn: it looks the same however it is turned
constexpr int Steps = 72;               // of a full turn,
constexpr int FirstStep = 3;            // from which on, to both sides, a turn is one
constexpr int StepOfRound = 2;          // between the turns of a round side: 10 degrees
constexpr double FirstShift = 0.01;     // of the diameter, and a fifth of a step: what a turn is fitted by first,
constexpr int Halvings = 4;             // and then by halves
constexpr double SameTurn = 15.0;       // degrees from one of the part's symmetries or near-symmetries,
constexpr double SameOfSide = 5.0;      // and from another turn of the side

constexpr double Step = 2.0 * M_PI / Steps; // radians

/// Those along the coordinates' axes, and the normals of what is flat and large.
Points directionsOf(const PointCloud& surface)
{
  std::vector<std::pair<Eigen::Vector3f, int>> flat; // sum of normals, their number
  for (const Eigen::Vector3f& normal : surface.normals)
  {
    const auto known = std::find_if(
      flat.begin(), flat.end(), [&](const auto& one) { return one.first.normalized().dot(normal) > SameSide; });
    if (known == flat.end())
    {
      flat.emplace_back(normal, 1);
    }
    else
    {
      known->first += normal;
      ++known->second;
    }
  }
  Points directions;
  const auto add = [&](const Eigen::Vector3f& direction)
  {
    if (std::none_of(directions.begin(), directions.end(),
          [&](const Eigen::Vector3f& known) { return known.dot(direction) > SameSide; }))
    {
      directions.push_back(direction);
    }
  };
  for (const auto& [sum, count] : flat)
  {
    if (count > FlatShare * static_cast<double>(surface.size()))
    {
      add(sum.normalized());
    }
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    add(Eigen::Vector3f::Unit(axis));
    add(-Eigen::Vector3f::Unit(axis));
  }
  return directions;
}

/// What shows of a part from a direction, turned about it.
class Side
{
public:
  Side(const TrainedModel& model, const Eigen::Vector3f& towards)
    : Model(model)
    , Axis(towards.cast<double>())
  {
    const Sensor sensor{ false, Eigen::Vector3d::Zero(), -this->Axis };
    const std::vector<int> inSight =
      model.visibility->samplesInSight(Eigen::Isometry3d::Identity(), sensor, LeastCosine);
    for (std::size_t k = 0; k < inSight.size(); k += 1 + inSight.size() / MostPoints)
    {
      this->Seen.add(model.surface.points[inSight[k]]);
      this->Middle += model.surface.points[inSight[k]].cast<double>();
    }
    this->Middle /= std::max<double>(this->Seen.size(), 1.0); // which a turn onto itself leaves where it is
    this->Edges = model.visibility->visible(Eigen::Isometry3d::Identity(), sensor)->edges.points;
  }

  std::vector<Eigen::Isometry3d> turns() const
  {
    std::vector<double> overlaps;
    for (int step = 0; step < Steps; ++step)
    {
      overlaps.push_back(this->overlapAfter(this->turn(step * Step)));
    }
    const bool isRound = *std::min_element(overlaps.begin(), overlaps.end()) >= Round;
    const Eigen::Vector3d onAxis =
      isRound ? (this->Middle + 0.5 * (this->fitted(M_PI) * this->Middle - this->Middle)).eval() : this->Middle;
    Symmetries exact = this->Model.symmetries;
    exact.near.clear();
    std::vector<Eigen::Isometry3d> found;
    for (int step = FirstStep; step <= Steps - FirstStep; ++step)
    {
      const bool isPeak = overlaps[step] >= Alike && overlaps[step] >= overlaps[step - 1] &&
                          overlaps[step] > overlaps[(step + 1) % Steps] &&
                          overlaps[step] > overlaps[step - FirstStep] &&
                          overlaps[step] > overlaps[(step + FirstStep) % Steps];
      if (isRound ? step % StepOfRound == 0 : isPeak)
      {
        const Eigen::Isometry3d T = isRound ? turnAbout(this->Axis, step * Step, onAxis) : this->fitted(step * Step);
        // Turns that differ by an exact symmetry are one.
        const auto isSame = [&](const Eigen::Isometry3d& known) { return turnBetween(T, known, exact) < SameOfSide; };
        if (turnBetween(T, Eigen::Isometry3d::Identity(), asIfRound(this->Model.symmetries)) > SameTurn &&
            std::none_of(found.begin(), found.end(), isSame))
        {
          found.push_back(T);
        }
      }
    }
    return found;
  }

private:
  Eigen::Isometry3d turn(double angle, const Eigen::Vector3d& shift = Eigen::Vector3d::Zero()) const
  {
    return Eigen::Translation3d(shift) * turnAbout(this->Axis, angle, this->Middle);
  }

  static std::vector<float> distancesAfter(
    const Eigen::Isometry3d& T, const SoAPoints& points, const DistanceField& field)
  {
    std::vector<float> distances(points.size());
    field.at(T.cast<float>(), points, 0, static_cast<int>(points.size()), distances.data());
    return distances;
  }

  double overlapAfter(const Eigen::Isometry3d& T) const
  {
    const std::vector<float> distances = distancesAfter(T, this->Seen, this->Model.surfaceDistance);
    const auto near = static_cast<float>(Near * this->Model.diameter);
    const auto count =
      std::count_if(distances.begin(), distances.end(), [&](float distance) { return distance < near; });
    return static_cast<double>(count) / std::max<double>(this->Seen.size(), 1.0);
  }

  /// Where its edges lie on edges best: what is flat does not tell.
  Eigen::Isometry3d fitted(double angle) const
  {
    const Eigen::Vector3d x = this->Axis.unitOrthogonal(), y = this->Axis.cross(x);
    Eigen::Vector3d best(0.0, 0.0, angle);
    const auto motion = [&](const Eigen::Vector3d& at) { return this->turn(at.z(), at.x() * x + at.y() * y); };
    const auto misfit = [&](const Eigen::Vector3d& at)
    {
      const std::vector<float> distances = distancesAfter(motion(at), this->Edges, this->Model.edgeDistance);
      return std::accumulate(distances.begin(), distances.end(), 0.0);
    };
    double least = misfit(best);
    double share = 1.0;
    for (int halving = 0; halving <= Halvings; ++halving, share *= 0.5)
    {
      const Eigen::Vector3d reach =
        share * Eigen::Vector3d(FirstShift * this->Model.diameter, FirstShift * this->Model.diameter, 0.2 * Step);
      for (bool isMoved = true; isMoved;)
      {
        isMoved = false;
        for (int k = 0; k < 6; ++k)
        {
          const Eigen::Vector3d to = best + (k % 2 == 0 ? 1.0 : -1.0) * reach[k / 2] * Eigen::Vector3d::Unit(k / 2);
          const double there = misfit(to);
          if (there < least)
          {
            least = there;
            best = to;
            isMoved = true;
          }
        }
      }
    }
    return motion(best);
  }

  const TrainedModel& Model;
  Eigen::Vector3d Axis;
  SoAPoints Seen;
  Eigen::Vector3d Middle = Eigen::Vector3d::Zero();
  SoAPoints Edges;
};
}

SideSymmetries::SideSymmetries(std::vector<SideSymmetry> known)
  : Found(std::move(known))
{
  std::call_once(this->AreFound, [] {});
}

const std::vector<SideSymmetry>& SideSymmetries::of(const TrainedModel& model) const
{
  std::call_once(this->AreFound,
    [&]
    {
      for (const Eigen::Vector3f& towards : model.surface.empty() ? Points() : directionsOf(model.surface))
      {
        std::vector<Eigen::Isometry3d> turns = Side(model, towards).turns();
        if (!turns.empty())
        {
          this->Found.push_back({ towards, std::move(turns) });
        }
      }
    });
  return this->Found;
}
}
