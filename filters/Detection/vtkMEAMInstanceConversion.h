// SPDX-License-Identifier: BSD-3-Clause
/**
 * Copies of a part where its poses are, to look at. Not wrapped.
 */
#ifndef vtkMEAMInstanceConversion_h
#define vtkMEAMInstanceConversion_h

#include "base/Error.h"
#include "io/DetectionArrayFile.h"
#include "pose/Pose.h"
#include "pose/search/ConflictResolution.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

class vtkPolyData;

namespace vtkMEAMConversion
{
/// Which poses get a copy.
struct InstanceSettings
{
  std::size_t most = 0; ///< the best so many; 0: all
  double minimumProbability =
    0.5; ///< where a copy is less likely to be there there is none; those of unknown probability (0) do
};

/// A copy of the part at each pose, best first, with the arrays that vtkMEAMPoseInstances documents, for points and
/// for cells. `rankOf` tells the rank of the pose at an index.
void fromInstances(vtkPolyData* part, const meam::Poses& poses, const std::function<int(std::size_t)>& rankOf,
  const InstanceSettings& settings, const meam::Progress& progress, vtkPolyData* output);

/// The same of several types of part, one type after the other, with the array `PartId`.
void fromInstances(const std::vector<vtkPolyData*>& parts, std::vector<meam::PartPose> poses,
  const std::function<int(std::size_t)>& rankOf, InstanceSettings settings, const meam::Progress& progress,
  vtkPolyData* output);

/// For the same poses the ellipsoid of so many standard deviations about the part's middle, with the
/// same arrays.
void fromUncertainties(const meam::Poses& poses, const meam::PartExtent& part, double deviations,
  const std::function<int(std::size_t)>& rankOf, const InstanceSettings& settings, vtkPolyData* output);

/// The text `Label` for each pose: its rank and, where it is known, how likely it is there, as in "1: 98 %", and where
/// it is unsure its rotation, as in "1: 98 %, rotation 30 %"; nothing for a pose that is less likely, which gets no
/// copy. `names`, of the part at each pose, stand behind the rank, as in "1 (flap): 98 %"; empty: all are of one type.
void addLabels(
  const meam::Poses& poses, const std::vector<std::string>& names, double minimumProbability, vtkPolyData* output);

/// In a sentence how many poses get no copy for their probability, which `property` of a filter limits; empty: none.
std::string describeHidden(const meam::Poses& poses, double minimumProbability, const std::string& property);
}

#endif
