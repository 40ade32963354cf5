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
constexpr double EdgeSpacing = 0.03;
constexpr double VotingLeafShare = 0.04;
constexpr double VerificationLeafShare = 0.03;
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

PairFeatureQuantizer TrainedModel::surfaceQuantizer() const
{
  return PairFeatureQuantizer(PairFeatureKind::Surface, this->settings.surface.distanceStep * this->diameter,
    this->settings.surface.angleStep * M_PI / 180.0, this->diameter);
}

void TrainedModel::deriveFields()
{
  this->table.deriveVotes(this->edges.points, this->edges.tangents, this->settings.feature);
  this->surfaceTable.deriveVotes(
    this->surfacePairPoints.points, this->surfacePairPoints.normals, PairFeatureKind::Surface);
  this->verificationPoints = thinPoints(this->surface.points, VerificationLeafShare * this->diameter);
  const double reach = TruncationDistance * this->diameter;
  const double cell = CellShare * this->diameter;
  this->surfaceDistance = DistanceField::ofSurface(this->surface, SurfaceSpacing * this->diameter, reach, cell);
  this->edgeDistance = DistanceField::ofEdges(this->edges, EdgeSpacing * this->diameter, reach, cell);
  this->visibility = std::make_shared<const PredictedVisibility>(*this);
}
}
