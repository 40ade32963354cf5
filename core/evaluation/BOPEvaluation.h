// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "base/Error.h"
#include "evaluation/PoseEvaluation.h"
#include "mesh/Symmetries.h"
#include "mesh/TriangleMesh.h"
#include "pose/Pose.h"
#include "scene/Camera.h"
#include "scene/OrganizedCloud.h"

#include <array>
#include <memory>

namespace meam
{
/// Thresholds of the benchmark: 5 to 50 %, of the diameter for distances, of the cost for VSD; for MSPD 5 to 50 pixels
/// of an image that is 640 wide.
constexpr int BOPThresholds = 10;
inline double bopThreshold(int k) { return 0.05 * (k + 1); }

/// Thresholds of MSSD (mm) for industrial parts (BOP Challenge 2025): 2 to 20.
inline double bopMillimeters(int k) { return 2.0 * (k + 1); }

/// The pose errors of the BOP benchmark (Hodan et al., BOP Challenge 2020, Section 2.2; ADD and ADI: Hinterstoisser et
/// al. 2012) between an estimated pose and a true one.
struct BOPErrors
{
  double add = 0.0;  ///< mm, mean distance of the vertices
  double adi = 0.0;  ///< mm, mean distance of a vertex at the true pose to the nearest one at the estimated pose
  double mssd = 0.0; ///< mm, largest distance of a vertex, least over the part's symmetries
  double mspd = 0.0; ///< pixels, the same on the image; infinite for a vertex behind the camera
  /// Share of the visible surface whose distance is wrong by bopThreshold(k) of the diameter or more, [0, 1]. Visible
  /// is what lies no more than 15 mm behind the measured surface.
  std::array<double, BOPThresholds> vsd{};
};

/// Of an object in an image: how many copies that are visible enough are found, threshold by threshold.
struct BOPRecall
{
  int targets = 0; ///< copies of which at least a tenth is visible
  using Counts = std::array<double, BOPThresholds>;
  Counts add{}, adi{}, mssd{}, mspd{};
  Counts vsd{}; ///< mean over the tolerances of the distance
};

/// Of an object over images: how its poses rank at MSSD less than bopMillimeters(k). Poses of copies of which less than
/// a tenth is visible are left out.
struct BOPRanking
{
  int targets = 0; ///< copies of which at least a tenth is visible
  std::array<Ranking, BOPThresholds> poses;

  void add(const BOPRanking& image);
  double averagePrecision() const; ///< %, mean over the thresholds; NaN without targets
};

/// Evaluates poses of one part. Calls may run in parallel.
class BOPEvaluation
{
public:
  /// `diameter` in mm, 0: the largest distance of two vertices. Throws Error for a mesh without triangles or
  /// extent. Vertices of no triangle do not count.
  BOPEvaluation(const TriangleMesh& mesh, const Symmetries& symmetries, double diameter = 0.0);
  ~BOPEvaluation();

  /// `scan` is what the sensor measured, in the frame of the poses; its camera is taken from it.
  BOPErrors errors(const Eigen::Isometry3d& estimate, const Eigen::Isometry3d& truth, const OrganizedCloud& scan) const;

  /// Estimates, best first: no more than there are targets count. Each takes, of the targets that no better one
  /// has taken, the nearest by the error in question.
  BOPRecall recall(
    const Poses& estimates, const Poses& truths, const OrganizedCloud& scan, const Progress& progress = {}) const;

  /// All estimates of an image, best first, without looking at a scan. Each takes, of the copies that no better one has
  /// taken, the nearest.
  BOPRanking ranking(const Poses& estimates, const Poses& truths) const;

private:
  struct Impl;
  std::unique_ptr<Impl> Data;
};

/// The pinhole camera in whose frame an organized cloud is. Throws Error when its points are not on the rays of one.
Camera cameraOfCloud(const OrganizedCloud& cloud);
}
