// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Preset.h"

#include <Eigen/Core>

namespace meam
{
/// What a user chooses of training; the preset has everything else.
struct TrainSettings
{
  Preset preset = Preset::Recommended;
  Features features = Features::Both; ///< that the model holds; with the preset Paper edges alone
  double scale = 1.0;                 ///< factor on the mesh's coordinates, to bring them to mm: 1000 for metres
  Eigen::Vector3d offset = Eigen::Vector3d::Zero(); ///< mm, added after the scale
  unsigned seed = 1;                                ///< of all random choices
};
}
