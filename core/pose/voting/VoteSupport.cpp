// SPDX-License-Identifier: BSD-3-Clause
#include "pose/voting/VoteSupport.h"

#include "base/Parallel.h"
#include "base/PointGrid.h"
#include "base/sequences/Sequences.h"
#include "pose/PoseTolerances.h"
#include "pose/voting/PairVoting.h"
#include "pose/voting/VoteAccumulator.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

namespace meam
{
namespace
{
// Shares of the diameter
constexpr double OnPart = 0.02;    // a scene point this near to the part is on it
constexpr double CellReach = 0.06; // model points this near to a scene point may stand for it
constexpr double TurnStep = 7.2;   // degrees, between the equal poses of a round part: that of the votes
constexpr int Ranks = 10;          // peaks of a reference point that are looked at

/// Poses that the symmetries make equal to one, those of a round part in steps.
std::vector<Eigen::Isometry3d> equalPoses(const Eigen::Isometry3d& T_scene_model, const Symmetries& symmetries)
{
  std::vector<Eigen::Isometry3d> poses{ T_scene_model };
  for (const Eigen::Isometry3d& S : symmetries.discrete)
  {
    poses.push_back(T_scene_model * S);
  }
  if (!symmetries.continuous.empty())
  {
    const ContinuousSymmetry& symmetry = symmetries.continuous.front();
    const int steps = static_cast<int>(std::ceil(2.0 * M_PI / (TurnStep * M_PI / 180.0)));
    const std::size_t count = poses.size();
    for (int step = 1; step < steps; ++step)
    {
      const Eigen::Isometry3d turn = turnAbout(symmetry.axis, 2.0 * M_PI * step / steps, symmetry.point);
      for (std::size_t k = 0; k < count; ++k)
      {
        poses.push_back(poses[k] * turn);
      }
    }
  }
  return poses;
}

/// The turn of the accumulator (radians) whose pose is turned least against T_scene_model.
double turnOf(const Eigen::Isometry3d& T_scene_model, const PairFrame& model, const PairFrame& scene, bool flip)
{
  const Eigen::Matrix3d unturned = alignFrames(model, scene, flip, 0.0).linear();
  const Eigen::Matrix3d axes = scene.Axes.cast<double>();
  // alignFrames(alpha) = (axes Rx(alpha) axes^T) unturned.
  const Eigen::Matrix3d turn = axes.transpose() * T_scene_model.linear() * unturned.transpose() * axes;
  return std::atan2(turn(2, 1) - turn(1, 2), turn(1, 1) + turn(2, 2));
}

/// Finds the votes of one round's points for a pose.
class RoundSupport
{
public:
  RoundSupport(const VotingRound& round, const Eigen::Isometry3d& T_scene_model, const TrainedModel& model,
    const PoseDetectionSettings& detection)
    : Round(round)
    , T(T_scene_model)
    , Model(model)
    , Detection(detection)
    , Equal(equalPoses(T_scene_model, model.symmetries))
    , Reach(CellReach * model.diameter)
    , Voting(round, detection)
    , References(round.references.begin(), round.references.end())
    , ModelPoints(Points(round.part.points.begin(), round.part.points.begin() + round.part.table.votingPoints), Reach)
  {
  }

  /// The round's points that lie on the part.
  std::vector<int> onPart() const
  {
    const Eigen::Isometry3f toPart = this->T.inverse().cast<float>();
    const DistanceField& part = this->Round.byEdges ? this->Model.edgeDistance : this->Model.surfaceDistance;
    const double near = OnPart * this->Model.diameter;
    return indicesWhere(
      this->Round.points.points.size(), [&](int i) { return part.at(toPart * this->Round.points.points[i]) <= near; });
  }

  VoteAccumulator accumulator() const
  {
    return { this->Round.part.table.votingPoints, this->Round.part.angleStep, this->Detection.smoothPeaks };
  }

  PointVotes votesOf(int index, VoteAccumulator& accumulator) const
  {
    const DirectedPoints& points = this->Round.points;
    const PairFrame scene(points.points[index], points.directions[index]);
    accumulator.clear();
    this->Voting.vote(scene, accumulator);
    PointVotes result{ points.points[index], this->Round.byEdges, this->References.count(index) > 0,
      this->votesForPose(scene, accumulator), 0, 0 };
    const std::vector<VotePeak> peaks = accumulator.peaks(Ranks);
    result.most = peaks.empty() ? 0 : peaks.front().votes;
    const auto leads = [&](const VotePeak& peak)
    { return this->isNear(alignFrames(this->frameOf(peak.modelPoint), scene, peak.flip, peak.alpha)); };
    const auto first = std::find_if(peaks.begin(), peaks.end(), leads);
    if (first != peaks.end())
    {
      result.rank = static_cast<int>(first - peaks.begin()) + 1;
      result.votes = std::max(result.votes, first->votes);
    }
    return result;
  }

private:
  PairFrame frameOf(int modelPoint) const
  {
    return { this->Round.part.points[modelPoint], this->Round.part.directions[modelPoint] };
  }

  bool isNear(const Eigen::Isometry3d& pose) const
  {
    const Eigen::Vector3d middle = this->Model.visibility->middle().cast<double>();
    return translationError(pose, this->T, middle) < SamePoseDistance * this->Model.diameter &&
           rotationError(nearestEqual(pose, this->T, this->Model.symmetries), this->T) < SamePoseAngle;
  }

  int votesForPose(const PairFrame& scene, const VoteAccumulator& accumulator) const
  {
    int votes = 0;
    for (const Eigen::Isometry3d& equal : this->Equal)
    {
      const Eigen::Vector3f inPart = (equal.inverse() * scene.Origin.cast<double>()).cast<float>();
      this->ModelPoints.forEachWithin(inPart, this->Reach,
        [&](int modelPoint, float)
        {
          const PairFrame model = this->frameOf(modelPoint);
          for (const bool flip : { false, true })
          {
            const double alpha = turnOf(equal, model, scene, flip);
            if (this->isNear(alignFrames(model, scene, flip, alpha)))
            {
              votes = std::max(votes, accumulator.votesFor(modelPoint, flip, alpha));
            }
          }
        });
    }
    return votes;
  }

  const VotingRound& Round;
  const Eigen::Isometry3d& T;
  const TrainedModel& Model;
  const PoseDetectionSettings& Detection;
  std::vector<Eigen::Isometry3d> Equal;
  double Reach; ///< mm
  PairVoting Voting;
  std::unordered_set<int> References;
  PointGrid ModelPoints; ///< those that make pairs
};
}

std::vector<PointVotes> votesForPose(const Eigen::Isometry3d& T_scene_model, const Scene& scene,
  const TrainedModel& model, const PoseDetectionSettings& detection, const Progress& progress)
{
  std::vector<PointVotes> all;
  const std::vector<VotingRound> rounds = votingRounds(scene, model, detection);
  for (const VotingRound& round : rounds)
  {
    const double done = static_cast<double>(&round - rounds.data()) / rounds.size();
    if (round.part.table.votingPoints == 0)
    {
      continue;
    }
    const RoundSupport support(round, T_scene_model, model, detection);
    const std::vector<int> onPart = support.onPart();
    const int count = static_cast<int>(onPart.size());
    const int threads = std::max(1, std::min(numberOfThreads(detection.threads), count));
    std::vector<VoteAccumulator> accumulators(threads, support.accumulator());
    std::vector<PointVotes> found(count);
    parallelFor(count, threads, subProgress(progress, done, done + 1.0 / rounds.size()),
      [&](int begin, int end, int thread)
      {
        for (int k = begin; k < end; ++k)
        {
          found[k] = support.votesOf(onPart[k], accumulators[thread]);
        }
      });
    all.insert(all.end(), found.begin(), found.end());
  }
  return all;
}
}
