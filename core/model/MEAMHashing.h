// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Error.h"
#include "model/TrainedModel.h"

namespace meam
{
/// Trains the model of a part (paper, Section 4): every pair of edge points that can be seen together
/// is stored once, under its quantised B2B-TL feature.
///
/// `edgeModels`: edge appearance models with tangents; where they carry point ids, these index
/// `surface`. `surface`: samples of the whole part with normals (mm), kept for verification and for
/// deciding which points are seen together. `partDiameter`: d_max of the mesh in mm; 0: of the surface.
/// Throws Error without edges, without tangents, or with more than 32 views.
TrainedModel hashModels(const std::vector<AppearanceModel>& edgeModels, const PointCloud& surface, double partDiameter,
  const MEAMHashingSettings& settings = {}, const Progress& progress = {});
}
