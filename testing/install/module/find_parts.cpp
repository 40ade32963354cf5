// SPDX-License-Identifier: BSD-3-Clause
// The VTK modules in a program outside of the tree: a part, as a mesh or as a trained model (.meam), is found in a
// scan.
#include <vtkMEAMMeshReader.h>
#include <vtkMEAMModelReader.h>
#include <vtkMEAMPCDReader.h>
#include <vtkMEAMPoseEstimation.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <string>

int main(int, char** argv)
{
  vtkNew<vtkMEAMMeshReader> mesh;
  mesh->SetFileName(argv[1]);
  vtkNew<vtkMEAMModelReader> model;
  model->SetFileName(argv[1]);
  vtkNew<vtkMEAMPCDReader> scan;
  scan->SetFileName(argv[2]);
  vtkNew<vtkMEAMPoseEstimation> estimation;
  const bool trained = std::string(argv[1]).find(".meam") != std::string::npos;
  estimation->SetInputConnection(trained ? model->GetOutputPort() : mesh->GetOutputPort());
  estimation->SetSceneConnection(scan->GetOutputPort());
  estimation->Update();
  return estimation->GetOutput()->GetNumberOfPoints() > 0 ? 0 : 1;
}
