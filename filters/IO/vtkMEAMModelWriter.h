// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMModelWriter
 * @brief Writes a trained model as one file, NAME.meam, which C++ reads without VTK, too.
 *
 * What comes back is the same bit by bit. The file appears whole or not at all; Write() returns 0 when it did not.
 *
 * Input port 0: the trained model that vtkMEAMHashing returns, a vtkPartitionedDataSetCollection.
 */
#ifndef vtkMEAMModelWriter_h
#define vtkMEAMModelWriter_h

#include "ppfmeamIOModule.h"
#include "vtkMEAMPropertyMacros.h"
#include "vtkWriter.h"

class PPFMEAMIO_EXPORT vtkMEAMModelWriter : public vtkWriter
{
public:
  static vtkMEAMModelWriter* New();
  vtkTypeMacro(vtkMEAMModelWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The file to write. Default: none. */
  vtkMEAMFileMemberMacro(FileName);

protected:
  vtkMEAMModelWriter() = default;
  ~vtkMEAMModelWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

private:
  char* FileName = nullptr;
};

#endif
