// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMPartTrainer
 * @brief Trains the model of a part from its CAD mesh for vtkMEAMEstimationAlgorithm.
 *
 * Training links code under the GPL, which this module must not: PPFMEAM::Training implements it. Not wrapped.
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
struct TrainSettings;
}

class PPFMEAMDETECTION_EXPORT vtkMEAMPartTrainer : public vtkObject
{
public:
  vtkAbstractTypeMacro(vtkMEAMPartTrainer, vtkObject);

  /// That of the object factories; throws Error when no module that trains is loaded.
  static vtkSmartPointer<vtkMEAMPartTrainer> Create();

  /// Throws Error for a mesh that cannot be trained.
  virtual std::shared_ptr<const vtkMEAMConversion::TrainedPart> Train(
    vtkPolyData* mesh, const meam::TrainSettings& settings, const meam::Progress& progress) = 0;

protected:
  vtkMEAMPartTrainer() = default;
  ~vtkMEAMPartTrainer() override = default;

private:
  vtkMEAMPartTrainer(const vtkMEAMPartTrainer&) = delete;
  void operator=(const vtkMEAMPartTrainer&) = delete;
};

#endif
