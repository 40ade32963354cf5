// SPDX-License-Identifier: BSD-3-Clause
/**
 * Appearance models and trained models between VTK's collections and the core. Not wrapped.
 */
#ifndef vtkMEAMModelConversion_h
#define vtkMEAMModelConversion_h

#include "model/AppearanceModel.h"
#include "model/TrainedModel.h"

#include <array>
#include <vector>

class vtkDataObject;
class vtkPartitionedDataSetCollection;

namespace vtkMEAMConversion
{
/// One partition for each viewpoint, named, with the field data `ViewDirection` (3) and, where it is known,
/// `Viewpoint` (3, mm); `WholePart` (1) stands where there is no viewpoint at all.
std::vector<meam::AppearanceModel> toAppearanceModels(vtkPartitionedDataSetCollection* input);
void fromAppearanceModels(const std::vector<meam::AppearanceModel>& models, vtkPartitionedDataSetCollection* output);

/// Throws Error for another version, for missing parts and for arrays whose lengths do not fit.
meam::TrainedModel toTrainedModel(vtkPartitionedDataSetCollection* input);
void fromTrainedModel(const meam::TrainedModel& model, vtkPartitionedDataSetCollection* output);

/// What a model was calibrated to, as the field data `Calibration`; none where there is none.
meam::ModelCalibration calibrationOf(vtkDataObject* input);
void setCalibration(vtkDataObject* output, const meam::ModelCalibration& calibration);

/// Middle of the box around a part's samples or the surface of its trained model, mm; the origin for null and for what
/// has no points.
std::array<double, 3> middleOf(vtkDataObject* input);
}

#endif
