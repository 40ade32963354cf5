// SPDX-License-Identifier: BSD-3-Clause
#include "model/TrainedModel.h"

#include "base/PointGrid.h"

#include <algorithm>
#include <cmath>

namespace meam
{
double TrainedModel::votingLeaf() const
{
  if (this->settings.merging != ViewMerging::Points)
  {
    return 0.0;
  }
  return this->settings.leafSize > 0.0 ? this->settings.leafSize
                                       : this->settings.derivation.votingLeaf * this->diameter;
}

double TrainedModel::verificationArea() const
{
  constexpr double cubesOfSquare = 1.5; // not tuned: that a plane of any direction meets, on average
  const double leaf = this->settings.derivation.verificationLeaf * this->diameter;
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
  const ModelDerivationSettings& shares = this->settings.derivation;
  this->verificationPoints = thinPoints(this->surface.points, shares.verificationLeaf * this->diameter);
  const double reach = shares.reach * this->diameter;
  const double cell = shares.cell * this->diameter;
  this->surfaceDistance = DistanceField::ofSurface(this->surface, shares.surfaceSpacing * this->diameter, reach, cell);
  this->edgeDistance = DistanceField::ofEdges(this->edges, shares.edgeSpacing * this->diameter, reach, cell);
  this->visibility = std::make_shared<const PredictedVisibility>(*this);
}
}
