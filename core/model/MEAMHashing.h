// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "base/Error.h"
#include "model/AppearanceModel.h"
#include "model/TrainedModel.h"

namespace meam
{
/// What is known of a part beside its edges.
struct PartGeometry
{
  PointCloud samples;    ///< of the whole part with normals, mm: for verification, and for what is seen together
  double diameter = 0.0; ///< d_max of the mesh, mm; 0: of the samples
  Symmetries symmetries;
};

/// Trains the model of a part (paper, Section 4): every pair of edge points that can be seen together
/// is stored once, under its quantised B2B-TL feature.
///
/// `edgeModels`: edge appearance models with tangents; where they carry point ids, these index the part's
/// surface. Of points that the part's exact symmetries map onto each other one is a reference, the others are
/// referred points only. Throws Error without edges, without tangents, or with more than 32 views.
TrainedModel hashModels(const std::vector<AppearanceModel>& edgeModels, const PartGeometry& part,
  const MEAMHashingSettings& settings = {}, const Progress& progress = {});
}
