// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"

namespace meam
{
/// What is seen of a part from one viewpoint (paper, Section 4), or the whole part: all visible points
/// or, after boundary extraction, the edge points alone.
struct AppearanceModel
{
  std::string name;
  Eigen::Vector3f direction = Eigen::Vector3f::UnitZ(); ///< unit, from the part to the viewpoint
  PointCloud cloud;
  Eigen::Vector3f viewpoint = Eigen::Vector3f::Constant(NAN); ///< mm; NaN when it is not known: far away
  bool wholePart = false; ///< no viewpoint: nothing of the part is hidden, and the direction is a mere name
};
}
