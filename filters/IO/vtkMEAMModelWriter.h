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

  ///@{
  /** Of a server of several processes, each of which writes, how many they are and which this one is; the first has all
   * data and writes the file. Default: 1, and 0, the first. */
  vtkSetClampMacro(NumberOfPieces, int, 1, VTK_INT_MAX);
  vtkGetMacro(NumberOfPieces, int);
  vtkSetClampMacro(Piece, int, 0, VTK_INT_MAX);
  vtkGetMacro(Piece, int);
  ///@}

  vtkTypeBool ProcessRequest(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

protected:
  vtkMEAMModelWriter() = default;
  ~vtkMEAMModelWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

private:
  int NumberOfPieces = 1;
  int Piece = 0;
  char* FileName = nullptr;
};

#endif
