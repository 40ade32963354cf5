// SPDX-License-Identifier: BSD-3-Clause
/**
 * Poses between VTK's data objects and the core. Not wrapped.
 */
#ifndef vtkMEAMPoseConversion_h
#define vtkMEAMPoseConversion_h

#include "io/DetectionArrayFile.h"
#include "model/TrainedModel.h"
#include "pose/Pose.h"
#include "pose/search/ConflictResolution.h"
#include "pose/verification/EvidenceCounts.h"

#include <optional>
#include <vector>

class vtkDataObject;
class vtkPolyData;

namespace vtkMEAMConversion
{
/// One vertex for each pose, best first: `Transform` (16, row-major T_scene_model), `Quaternion` (x y z w),
/// `Score`, `PlaceProbability`, `Probability`, `Evidence`, `Votes`, `ViewId`, `VisibleFraction`, `Certainty`, `Rank`
/// (from 1); of refined poses `Residual`, `Iterations`, `Covariance` (36), `ConstrainedDegreesOfFreedom` and
/// `ConstrainedAxes` (6).
meam::Poses toPoses(vtkPolyData* input);
void fromPoses(const meam::Poses& poses, vtkPolyData* output);

/// Of several types of part in a scene: the array `PartId`, and the field data `Diameter` with a value for each type.
void setParts(
  const std::vector<meam::PartPose>& poses, const std::vector<const meam::TrainedModel*>& models, vtkPolyData* output);

/// Of each pose the index of its type of part, by `PartId`; 0 where it is not there, and where one is connected and
/// all are of one type. Throws Error where there are fewer than types.
std::vector<int> typesOf(vtkPolyData* poses, int connected);

/// The pose at a position with the turns of a vtkProp3D: degrees about x, y and z, first about y, then x, then z.
meam::Pose placedAt(const double position[3], const double rotation[3]);

/// How large the part is travels with its poses as the field data `PartBounds` (6: from and to along x, y and z, mm, of
/// the model's surface points) and `PartMiddle` (3: mm, of its surface, which covariances are about).
std::optional<meam::PartExtent> partExtentOf(vtkDataObject* input);
void setPartExtent(vtkDataObject* output, const meam::TrainedModel& model);

/// The scan's rates travel with its poses as the field data `EvidenceRates` (4: edges found where a part is and
/// anywhere, outlines that end where a part is and anywhere; each between 0 and 1). None: not measured yet, or no
/// rates.
std::optional<meam::EvidenceRates> evidenceRatesOf(vtkDataObject* input);
void setEvidenceRates(vtkDataObject* output, const std::optional<meam::EvidenceRates>& rates);
}

#endif
