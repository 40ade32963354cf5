// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPartTrainer.h"

#include "vtkObjectFactory.h"

vtkSmartPointer<vtkMEAMPartTrainer> vtkMEAMPartTrainer::Create()
{
  const auto made = vtk::TakeSmartPointer(vtkObjectFactory::CreateInstance("vtkMEAMPartTrainer"));
  auto* trainer = vtkMEAMPartTrainer::SafeDownCast(made);
  if (!trainer)
  {
    throw meam::Error(
      "The part is a CAD mesh, and the module PPFMEAM::Training, which trains its model, is not loaded: "
      "give a trained model to Part, or load the module (in Python: import ppfmeam.filters).");
  }
  return trainer;
}
