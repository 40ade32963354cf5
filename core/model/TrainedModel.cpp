// SPDX-License-Identifier: BSD-3-Clause
#include "model/TrainedModel.h"

#include <cmath>

namespace meam
{
namespace
{
// Shares of the diameter.
constexpr double CellShare = 0.0075;
constexpr double SurfaceSpacing = 0.018; // a little over that of the surface points
constexpr double EdgeSpacing = 0.03;
}

PairFeatureQuantizer TrainedModel::quantizer() const
{
  return PairFeatureQuantizer(this->settings.feature, this->settings.distanceStep * this->diameter,
    this->settings.angleStep * M_PI / 180.0, this->diameter);
}

void TrainedModel::deriveFields()
{
  PairTable& pairs = this->table;
  pairs.votes.resize(pairs.size());
  for (std::size_t k = 0; k < pairs.size(); ++k)
  {
    const std::uint32_t reference = pairs.references[k];
    const Eigen::Vector3f d = this->edges.points[pairs.referreds[k]] - this->edges.points[reference];
    const PairTurn against = this->edges.tangents[reference].dot(d) < 0.0f ? 1u << TurnBits : 0u;
    const auto turn = static_cast<PairTurn>(std::lround(pairs.angles[k] * (1 << TurnBits) / (2.0 * M_PI))) & TurnMask;
    pairs.votes[k] = (reference << (TurnBits + 1)) | against | turn;
  }
  const double reach = DistanceReach * this->diameter;
  const double cell = CellShare * this->diameter;
  this->surfaceDistance = DistanceField::ofSurface(this->surface, SurfaceSpacing * this->diameter, reach, cell);
  this->edgeDistance = DistanceField::ofEdges(this->edges, EdgeSpacing * this->diameter, reach, cell);
}
}
