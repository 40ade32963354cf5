// SPDX-License-Identifier: BSD-3-Clause
#include "model/TrainedModel.h"

#include "base/PointGrid.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
// Shares of the diameter.
constexpr double CellShare = 0.0075;
constexpr double SurfaceSpacing = 0.018; // a little over that of the surface points
constexpr double EdgeSpacing = 0.03;
constexpr double VotingLeafShare = 0.04;
constexpr double VerificationLeafShare = 0.03;

void deriveVotes(const PointCloud& edges, PairTable& pairs)
{
  pairs.votes.assign(pairs.size() + VoteBlock, 0);
  pairs.mostOfOne = 1;
  for (std::size_t bucket = 0; bucket + 1 < pairs.offsets.size(); ++bucket)
  {
    std::uint32_t last = UINT32_MAX;
    int ofOne = 0;
    for (std::uint32_t k = pairs.offsets[bucket]; k < pairs.offsets[bucket + 1]; ++k)
    {
      const std::uint32_t reference = pairs.references[k];
      const Eigen::Vector3f d = edges.points[pairs.referreds[k]] - edges.points[reference];
      const auto turn = static_cast<PairTurn>(std::lround(pairs.angles[k] * (1 << TurnBits) / (2.0 * M_PI)));
      pairs.votes[k] = voteEntry(reference, edges.tangents[reference].dot(d) < 0.0f, turn);
      ofOne = reference == last ? ofOne + 1 : 1; // entries are sorted by reference
      last = reference;
      pairs.mostOfOne = std::max(pairs.mostOfOne, ofOne);
    }
  }
}
}

double TrainedModel::votingLeaf() const
{
  if (this->settings.merging != ViewMerging::Points)
  {
    return 0.0;
  }
  return this->settings.leafSize > 0.0 ? this->settings.leafSize : VotingLeafShare * this->diameter;
}

double TrainedModel::verificationArea() const
{
  // A plane of any direction meets 1.5 cubes for each square of their side, on average.
  constexpr double cubesOfSquare = 1.5;
  const double leaf = VerificationLeafShare * this->diameter;
  return leaf * leaf / cubesOfSquare;
}

PointCloud TrainedModel::edgesOfView(int view) const
{
  std::vector<int> members;
  for (std::size_t i = 0; i < this->edges.size(); ++i)
  {
    if (this->edgeViews[i] >> view & 1u)
    {
      members.push_back(static_cast<int>(i));
    }
  }
  return this->edges.subset(members);
}

PairFeatureQuantizer TrainedModel::quantizer() const
{
  return PairFeatureQuantizer(this->settings.feature, this->settings.distanceStep * this->diameter,
    this->settings.angleStep * M_PI / 180.0, this->diameter);
}

void TrainedModel::deriveFields()
{
  this->votingEdges = 0;
  for (const auto* indices : { &this->table.references, &this->table.referreds })
  {
    const auto last = std::max_element(indices->begin(), indices->end());
    this->votingEdges = std::max(this->votingEdges, last == indices->end() ? 0 : static_cast<int>(*last) + 1);
  }
  deriveVotes(this->edges, this->table);
  this->verificationPoints = thinPoints(this->surface.points, VerificationLeafShare * this->diameter);
  const double reach = TruncationDistance * this->diameter;
  const double cell = CellShare * this->diameter;
  this->surfaceDistance = DistanceField::ofSurface(this->surface, SurfaceSpacing * this->diameter, reach, cell);
  this->edgeDistance = DistanceField::ofEdges(this->edges, EdgeSpacing * this->diameter, reach, cell);
  this->visibility = std::make_shared<const PredictedVisibility>(*this);
}
}
