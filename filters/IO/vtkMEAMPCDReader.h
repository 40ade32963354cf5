// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMPCDReader
 * @brief Reads a PCD file of the Point Cloud Library, organized or not.
 *
 * Version 0.5 to 0.7, ascii, binary or binary_compressed. The file's header decides what comes out;
 * fields that are not named below are skipped.
 *
 * Output port 0:
 * - HEIGHT greater than 1: a vtkStructuredGrid of WIDTH x HEIGHT x 1 points, row by row from the top
 *   left; points without depth are NaN and blanked.
 * - otherwise: a vtkPolyData with a vertex for each point that has depth; the others are left out.
 *
 * Point arrays, where the file has the fields:
 * - `Normals` (3) from normal_x, normal_y, normal_z;
 * - `Intensity` (unsigned char) from intensity. Whole numbers from 0 to 255 are kept, other values are
 *   spread so that the largest becomes 255;
 * - `RGB` (3, unsigned char) from rgb or rgba.
 */
#ifndef vtkMEAMPCDReader_h
#define vtkMEAMPCDReader_h

#include "ppfmeamIOModule.h"
#include "vtkDataObjectAlgorithm.h"

class PPFMEAMIO_EXPORT vtkMEAMPCDReader : public vtkDataObjectAlgorithm
{
public:
  static vtkMEAMPCDReader* New();
  vtkTypeMacro(vtkMEAMPCDReader, vtkDataObjectAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** The file to read. Default: none. */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /** Factor on the coordinates, to bring them to mm: 1000 for a file in metres. Default: 1. */
  vtkSetClampMacro(Scale, double, 1e-9, 1e9);
  vtkGetMacro(Scale, double);
  ///@}

  /** 1 when the file has the extension pcd and a header that can be read. */
  int CanReadFile(const char* fileName);

protected:
  vtkMEAMPCDReader();
  ~vtkMEAMPCDReader() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkMEAMPCDReader(const vtkMEAMPCDReader&) = delete;
  void operator=(const vtkMEAMPCDReader&) = delete;

  char* FileName = nullptr;
  double Scale = 1.0;
};

#endif
