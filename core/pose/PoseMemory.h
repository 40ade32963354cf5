// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/Pose.h"

#include "base/sequences/Sequences.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <map>
#include <vector>

namespace meam
{
/// What a stage has found out of poses, for those that come again: of the same transform, to the last bit.
template <class Result>
class PoseMemory
{
public:
  /// The results of poses, in their order. `compute` returns those of the poses that are new, in their order.
  template <class Compute>
  std::vector<Result> of(const Poses& poses, const Compute& compute)
  {
    Poses unknown;
    std::copy_if(poses.begin(), poses.end(), std::back_inserter(unknown),
      [&](const Pose& pose) { return this->Known.count(keyOf(pose)) == 0; });
    const std::vector<Result> computed = compute(unknown);
    for (std::size_t k = 0; k < unknown.size(); ++k)
    {
      this->Known.emplace(keyOf(unknown[k]), computed[k]);
    }
    return mapped<Result>(poses, [&](const Pose& pose) { return this->Known.at(keyOf(pose)); });
  }

  /// Of how many poses it knows the results.
  std::size_t size() const { return this->Known.size(); }

private:
  using Key = std::array<double, 16>;

  static Key keyOf(const Pose& pose)
  {
    Key key;
    Eigen::Map<Eigen::Matrix4d>(key.data()) = pose.T_scene_model.matrix();
    return key;
  }

  std::map<Key, Result> Known;
};
}
