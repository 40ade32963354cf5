// SPDX-License-Identifier: BSD-3-Clause
#include "pose/PoseDetection.h"

#include "Parallel.h"
#include "PointGrid.h"
#include "Random.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meam
{
namespace
{
// Angles about a tangent as whole numbers: a full turn is 2^15, so sums wrap by a mask.
constexpr int TurnBits = 15;
constexpr std::uint32_t TurnMask = (1u << TurnBits) - 1;

std::uint32_t quantizedTurn(float angle)
{
  return static_cast<std::uint32_t>(std::lround(angle * (1 << TurnBits) / (2.0 * M_PI))) & TurnMask;
}

/// The table as voting reads it: reference point, whether d runs against its tangent, and the angle
/// about it, in one word.
class VotingTable
{
public:
  explicit VotingTable(const TrainedModel& model)
    : Offsets(model.table.offsets)
  {
    const PointCloud& edges = model.edges;
    this->Entries.reserve(model.table.size());
    for (std::size_t k = 0; k < model.table.size(); ++k)
    {
      const std::uint32_t reference = model.table.references[k];
      const Eigen::Vector3f d = edges.points[model.table.referreds[k]] - edges.points[reference];
      const std::uint32_t against = edges.tangents[reference].dot(d) < 0.0f ? 1u : 0u;
      this->Entries.push_back((reference << (TurnBits + 1)) | (against << TurnBits) | quantizedTurn(model.table.angles[k]));
    }
  }

  const std::vector<std::uint32_t>& Offsets;
  std::vector<std::uint32_t> Entries;
};

/// `share` of the numbers below `count`, at least one, chosen by `seed`, ascending.
std::vector<int> chooseShare(int count, double share, unsigned seed)
{
  std::vector<int> indices(count);
  std::iota(indices.begin(), indices.end(), 0);
  const int wanted = std::min(count, std::max(1, static_cast<int>(std::ceil(share * count))));
  if (wanted < count)
  {
    Random random(seed);
    for (int i = 0; i < wanted; ++i)
    {
      std::swap(indices[i], indices[i + random.index(count - i)]);
    }
    indices.resize(wanted);
    std::sort(indices.begin(), indices.end());
  }
  return indices;
}

/// Votes of one reference point in the space (m_r, flip, alpha).
class Accumulator
{
public:
  Accumulator(int modelPoints, double angleStep)
    : Turns(std::max(1, static_cast<int>(std::lround(2.0 * M_PI / angleStep))))
    , ModelPoints(modelPoints)
    , Counts(static_cast<std::size_t>(modelPoints) * 2 * this->Turns, 0)
  {
  }

  void clear() { std::fill(this->Counts.begin(), this->Counts.end(), 0); }

  /// All entries of one bucket vote. A tangent has no sign; the sign of d along it decides whether the
  /// stored tangents agree (alpha = beta_s - beta_m) or not (alpha = beta_s + beta_m).
  void vote(const std::uint32_t* entry, const std::uint32_t* end, std::uint32_t sceneTurn, bool sceneAgainst)
  {
    const std::uint32_t against = sceneAgainst ? 1u : 0u;
    for (; entry != end; ++entry)
    {
      const std::uint32_t flip = ((*entry >> TurnBits) & 1u) ^ against;
      const std::uint32_t modelTurn = *entry & TurnMask;
      const std::uint32_t turn = (flip ? sceneTurn + modelTurn : sceneTurn - modelTurn) & TurnMask;
      const std::uint32_t bin = (turn * static_cast<std::uint32_t>(this->Turns)) >> TurnBits;
      ++this->Counts[((*entry >> (TurnBits + 1)) * 2 + flip) * this->Turns + bin];
    }
  }

  struct Peak
  {
    int votes = 0; ///< of the bin and its two neighbours
    int modelPoint = -1;
    bool flip = false;
    double alpha = 0.0; ///< radians
  };

  /// The best supported turn, summed over three neighbouring bins; of equals the first.
  Peak peak() const
  {
    Peak best;
    for (int sheet = 0; sheet < 2 * this->ModelPoints; ++sheet)
    {
      const std::uint32_t* counts = &this->Counts[static_cast<std::size_t>(sheet) * this->Turns];
      for (int bin = 0; bin < this->Turns; ++bin)
      {
        const int before = static_cast<int>(counts[bin == 0 ? this->Turns - 1 : bin - 1]);
        const int after = static_cast<int>(counts[bin + 1 == this->Turns ? 0 : bin + 1]);
        const int votes = before + static_cast<int>(counts[bin]) + after;
        if (votes > best.votes)
        {
          best.votes = votes;
          best.modelPoint = sheet / 2;
          best.flip = sheet % 2 == 1;
          best.alpha = (bin + 0.5 + static_cast<double>(after - before) / votes) * 2.0 * M_PI / this->Turns;
        }
      }
    }
    return best;
  }

private:
  int Turns;
  int ModelPoints;
  std::vector<std::uint32_t> Counts;
};
}

PoseDetectionSettings paperDetectionSettings()
{
  PoseDetectionSettings settings;
  settings.referenceShare = 0.05;
  settings.referredShare = 0.2;
  return settings;
}

Poses detectPoses(const PointCloud& edges, const TrainedModel& model, const PoseDetectionSettings& settings,
  const Progress& progress)
{
  requirePoints(edges.points, "The scene's edge cloud");
  if (edges.tangents.size() != edges.size())
  {
    throw Error("The scene's edge points have no tangents: estimate them before detection.");
  }
  requireSameUnits(edges.points, model.diameter);
  if (!(settings.referenceShare > 0.0 && settings.referenceShare <= 1.0) ||
    !(settings.referredShare > 0.0 && settings.referredShare <= 1.0))
  {
    throw Error("The shares of reference and referred points must be in (0, 1].");
  }
  const VotingTable table(model);
  const PairFeatureQuantizer quantizer = model.quantizer();
  const int modelPoints = static_cast<int>(model.edges.size());
  const double angleStep = model.settings.angleStep * M_PI / 180.0;

  const int count = static_cast<int>(edges.size());
  const std::vector<int> references = chooseShare(count, settings.referenceShare, settings.seed);
  const PointCloud referred = edges.subset(chooseShare(count, settings.referredShare, settings.seed + 1));
  const PointGrid grid(referred.points, 0.5 * model.diameter);

  const int threads = std::min(numberOfThreads(settings.threads), static_cast<int>(references.size()));
  std::vector<Accumulator> accumulators(threads, Accumulator(modelPoints, angleStep));
  std::vector<Accumulator::Peak> peaks(references.size());
  parallelFor(static_cast<int>(references.size()), threads, progress,
    [&](int begin, int end, int thread)
    {
      Accumulator& accumulator = accumulators[thread];
      for (int r = begin; r < end; ++r)
      {
        const Eigen::Vector3f& point = edges.points[references[r]];
        const Eigen::Vector3f& tangent = edges.tangents[references[r]];
        const TangentFrame frame(point, tangent);
        accumulator.clear();
        grid.forEachWithin(point, model.diameter,
          [&](int i, float squaredDistance)
          {
            if (squaredDistance == 0.0f)
            {
              return;
            }
            const int key = quantizer.key(
              pairFeature(quantizer.kind(), point, tangent, referred.points[i], referred.tangents[i]));
            if (key >= 0)
            {
              accumulator.vote(table.Entries.data() + table.Offsets[key], table.Entries.data() + table.Offsets[key + 1],
                quantizedTurn(frame.angleOf(referred.points[i])), frame.against(referred.points[i]));
            }
          });
        peaks[r] = accumulator.peak();
      }
    });

  Poses poses;
  for (std::size_t r = 0; r < peaks.size(); ++r)
  {
    const Accumulator::Peak& peak = peaks[r];
    if (peak.modelPoint < 0)
    {
      continue;
    }
    const int scenePoint = references[r];
    Pose pose;
    pose.T_scene_model = alignFrames(TangentFrame(model.edges.points[peak.modelPoint], model.edges.tangents[peak.modelPoint]),
      TangentFrame(edges.points[scenePoint], edges.tangents[scenePoint]), peak.flip, peak.alpha);
    pose.T_scene_model = nearestEqual(pose.T_scene_model, Eigen::Isometry3d::Identity(), model.symmetries);
    pose.votes = peak.votes;
    pose.viewId = __builtin_ctz(model.edgeViews[peak.modelPoint]);
    poses.push_back(pose);
  }
  report(progress, 1.0);
  return poses;
}
}
