// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "base/Error.h"
#include "base/PointCloud.h"
#include "base/Random.h"
#include "mesh/TriangleMesh.h"

namespace meam
{
/// Copies of a part as they came to rest in a bin.
struct FilledBin
{
  std::vector<Eigen::Isometry3d> poses; ///< T_bin_model of each, in mm, in the order in which they fell or were given
  double speed = 0.0; ///< mm/s, of the fastest point of a copy at the end; below 10 unless time ran out
};

/// Drops copies of a part (mm) into a bin, one after the other, from above what lies there, at a random
/// place and turned at random, each turn as likely as any other; rigid bodies with friction (Bullet) until they
/// rest. The bin's frame has its origin on the floor in the middle and z up; its walls are so high that nothing
/// gets over them; `binSize` has its inner sides along x and y, mm. Parts of any shape hook into each other and nest.
/// The same random numbers give the same bin.
///
/// Copies stop at 0.4 % of the diameter from each other, at 1 % when the mesh is not closed. Throws Error for a
/// mesh without faces, an invalid vertex or index, or a part that does not fit into the bin.
FilledBin fillBin(
  const TriangleMesh& part, const Eigen::Vector2d& binSize, int copies, Random& random, const Progress& progress = {});

/// What becomes of copies that are let go at poses T_bin_model, such as those that stay when one was taken away: until
/// they rest again. Copies that overlap are pushed apart. Throws Error as fillBin() does, and for a pose that is not
/// finite.
FilledBin settleBin(const TriangleMesh& part, const Eigen::Vector2d& binSize,
  const std::vector<Eigen::Isometry3d>& poses, const Progress& progress = {});
}
