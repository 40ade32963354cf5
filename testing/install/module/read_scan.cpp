// SPDX-License-Identifier: BSD-3-Clause
// The VTK module in a program outside of the tree.
#include <vtkMEAMPCDReader.h>
#include <vtkNew.h>
#include <vtkPointSet.h>

int main(int, char** argv)
{
  vtkNew<vtkMEAMPCDReader> reader;
  reader->SetFileName(argv[1]);
  reader->Update();
  return vtkPointSet::SafeDownCast(reader->GetOutputDataObject(0))->GetNumberOfPoints() == 640 * 480 ? 0 : 1;
}
