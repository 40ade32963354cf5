// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMOFFReader
 * @brief Reads the mesh in an OFF file (Object File Format, ascii).
 *
 * Also COFF, NOFF, STOFF and their combinations: normals, colours and texture coordinates are skipped.
 * Comments are skipped, polygons are cut into triangles.
 *
 * Output port 0: vtkPolyData, the triangles, in the file's unit; vtkMEAMMeshPreparation brings them to mm.
 */
#ifndef vtkMEAMOFFReader_h
#define vtkMEAMOFFReader_h

#include "ppfmeamFiltersModule.h"
#include "vtkPolyDataAlgorithm.h"

class PPFMEAMFILTERS_EXPORT vtkMEAMOFFReader : public vtkPolyDataAlgorithm
{
public:
  static vtkMEAMOFFReader* New();
  vtkTypeMacro(vtkMEAMOFFReader, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** The file to read. Default: none. */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  /** 1 when the file starts like an OFF file. */
  int CanReadFile(const char* fileName);

protected:
  vtkMEAMOFFReader();
  ~vtkMEAMOFFReader() override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkMEAMOFFReader(const vtkMEAMOFFReader&) = delete;
  void operator=(const vtkMEAMOFFReader&) = delete;

  char* FileName = nullptr;
};

#endif
