// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"
#include "base/PointGrid.h"

#include <functional>

/// What programs that others would use share: scenes in, 4x4 poses out, and on request what these programs do not have.
namespace rivals
{
using Transforms = std::vector<Eigen::Isometry3d>;

/// A part as a rival sees it: samples of its surface with normals (mm).
struct Part
{
  meam::PointCloud samples;
  double diameter = 0.0; ///< mm
};

/// Finds poses of the part in a scene with normals, best first, mm.
using Finder = std::function<Transforms(const Part& part, const meam::PointCloud& scene)>;

/// PROGRAM [--refined] CAD X Y Z SCENE.pcd OUT.txt [SCENE.pcd OUT.txt ...]: X, Y, Z are added to the CAD's coordinates
/// (mm), the scene is seen from above, along -z. `train` gets the part first. With --refined the candidates go through
/// refined(). The poses, at most five, become rows of 16 numbers. Seconds of processor time of each scene go to stdout.
int run(int argc, char** argv, const std::function<Finder(const Part& part, bool refined)>& train);

/// Glue that any user would write: each candidate is aligned by ICP with the samples that face the sensor, ranked by
/// the share of them that has a scene point within 2 % of the diameter, and dropped where a better one is nearer than
/// 10 % of it.
Transforms refined(
  const Transforms& candidates, const Part& part, const meam::PointGrid& scene, const meam::Points& points);
}
