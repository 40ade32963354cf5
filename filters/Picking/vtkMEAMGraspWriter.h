// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMGraspWriter
 * @brief Writes the grasps of a part as JSON, whatever the file's extension is.
 *
 * The file appears whole or not at all; an older one is replaced only when everything went well. Write() returns 0 when
 * it did not. vtkMEAMGraspDefinition reads it; docs/picking.md has its entries.
 *
 * Input port 0: grasps, a vtkPolyData as vtkMEAMGraspDefinition has them.
 */
#ifndef vtkMEAMGraspWriter_h
#define vtkMEAMGraspWriter_h

#include "ppfmeamPickingModule.h"
#include "vtkMEAMPropertyMacros.h"
#include "vtkWriter.h"

class PPFMEAMPICKING_EXPORT vtkMEAMGraspWriter : public vtkWriter
{
public:
  static vtkMEAMGraspWriter* New();
  vtkTypeMacro(vtkMEAMGraspWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The file to write. Default: none. */
  vtkMEAMFileMemberMacro(FileName);

protected:
  vtkMEAMGraspWriter() = default;
  ~vtkMEAMGraspWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

private:
  char* FileName = nullptr;
};

#endif
