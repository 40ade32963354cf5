// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPartTrainer.h"

#include "vtkObjectFactory.h"

vtkSmartPointer<vtkMEAMPartTrainer> vtkMEAMPartTrainer::Create(const std::string& task, const std::string& instead)
{
  const auto made = vtk::TakeSmartPointer(vtkObjectFactory::CreateInstance("vtkMEAMPartTrainer"));
  auto* trainer = vtkMEAMPartTrainer::SafeDownCast(made);
  if (!trainer)
  {
    throw meam::Error(task + ", the module PPFMEAM::Training is needed, which is not loaded: " + instead +
                      ", or load the module (in Python: import ppfmeam.filters).");
  }
  return trainer;
}
