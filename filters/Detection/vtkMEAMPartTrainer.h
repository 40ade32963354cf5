// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMPartTrainer
 * @brief Trains the model of a part from its CAD mesh for vtkMEAMEstimationAlgorithm, and reads its CAD file for
 * vtkMEAMMeshReader.
 *
 * Training links code under the GPL, and Open CASCADE, which this module must not: PPFMEAM::Training implements it. Not
 * wrapped.
 */
#ifndef vtkMEAMPartTrainer_h
#define vtkMEAMPartTrainer_h

#include "base/Error.h"
#include "ppfmeamDetectionModule.h"
#include "vtkMEAMSharedData.h"

#include "vtkObject.h"
#include "vtkSmartPointer.h"

namespace meam
{
struct CADSettings;
struct TrainSettings;
}

class PPFMEAMDETECTION_EXPORT vtkMEAMPartTrainer : public vtkObject
{
public:
  vtkAbstractTypeMacro(vtkMEAMPartTrainer, vtkObject);

  /// That of the object factories; throws Error when no module that trains is loaded: what for, and what else to do.
  static vtkSmartPointer<vtkMEAMPartTrainer> Create(const std::string& task, const std::string& instead);

  /// Throws Error for a mesh that cannot be trained.
  virtual std::shared_ptr<const vtkMEAMConversion::TrainedPart> Train(
    vtkPolyData* mesh, const meam::TrainSettings& settings, const meam::Progress& progress) = 0;

  /// The triangles of a STEP or IGES file, or of one solid of it, in mm, with what was assumed of it as the field data
  /// CADReport. Throws Error for a file that cannot be read.
  virtual void ReadCAD(
    const std::string& path, const meam::CADSettings& settings, vtkPolyData* mesh, const meam::Progress& progress) = 0;

protected:
  vtkMEAMPartTrainer() = default;
  ~vtkMEAMPartTrainer() override = default;
};

#endif
