// SPDX-License-Identifier: BSD-3-Clause
#include "io/ModelsInfo.h"

#include <nlohmann/json.hpp>

namespace meam
{
std::string modelsInfo(const Symmetries& symmetries, double diameter, const Eigen::AlignedBox3f& bounds)
{
  const auto list = [](const auto& values) { return std::vector<double>(values.data(), values.data() + values.size()); };
  nlohmann::ordered_json entry;
  entry["diameter"] = diameter;
  for (int axis = 0; axis < 3; ++axis)
  {
    entry[std::string("min_") + "xyz"[axis]] = bounds.min()[axis];
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    entry[std::string("size_") + "xyz"[axis]] = bounds.sizes()[axis];
  }
  for (const Eigen::Isometry3d& S : symmetries.discrete)
  {
    const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> rows = S.matrix();
    entry["symmetries_discrete"].push_back(list(rows));
  }
  for (const ContinuousSymmetry& symmetry : symmetries.continuous)
  {
    entry["symmetries_continuous"].push_back({ { "axis", list(symmetry.axis) }, { "offset", list(symmetry.point) } });
  }
  return entry.dump(2);
}
}
