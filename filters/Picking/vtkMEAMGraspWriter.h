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
  vtkMEAMGraspWriter() = default;
  ~vtkMEAMGraspWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

private:
  int NumberOfPieces = 1;
  int Piece = 0;
  char* FileName = nullptr;
};

#endif
