// SPDX-License-Identifier: BSD-3-Clause
/**
 * What a vtkMEAMEstimationAlgorithm makes of its inputs and properties. Not wrapped.
 */
#ifndef vtkMEAMEstimationWork_h
#define vtkMEAMEstimationWork_h

#include "pose/DetectionSteps.h"
#include "vtkMEAMEstimationAlgorithm.h"
#include "vtkMEAMSharedData.h"

#include <memory>
#include <string>
#include <vector>

struct vtkMEAMEstimationAlgorithm::Work
{
  static constexpr double Prepared = 0.5; ///< of the work, for the progress: the share that is done

  std::vector<std::shared_ptr<const vtkMEAMConversion::TrainedPart>> parts; ///< one of each connection to port 0
  std::vector<std::string> names; ///< of these: their files, or "part 1" and so on
  meam::ScanScene scan;
  meam::DetectionSettings settings;
  double secondsEdges = 0.0;
  double secondsLoading = 0.0; ///< of the points measured
  double secondsTraining = 0.0;
};

#endif
