// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMModelTrainer
 * @brief Reads a part's CAD file, prepares its mesh and trains its model (paper, Section 4). Made by the object
 * factory; not wrapped.
 */
#ifndef vtkMEAMModelTrainer_h
#define vtkMEAMModelTrainer_h

#include "ppfmeamTrainingModule.h"
#include "vtkMEAMPartTrainer.h"

class vtkMEAMModelTrainer : public vtkMEAMPartTrainer
{
public:
  static vtkMEAMModelTrainer* New();
  vtkTypeMacro(vtkMEAMModelTrainer, vtkMEAMPartTrainer);

  std::shared_ptr<const vtkMEAMConversion::TrainedPart> Train(
    vtkPolyData* mesh, const meam::TrainSettings& settings, const meam::Progress& progress) override;
  void ReadCAD(const std::string& path, const meam::CADSettings& settings, vtkPolyData* mesh,
    const meam::Progress& progress) override;

protected:
  vtkMEAMModelTrainer() = default;
  ~vtkMEAMModelTrainer() override = default;
};

#endif
