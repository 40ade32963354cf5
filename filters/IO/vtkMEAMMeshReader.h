// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMMeshReader
 * @brief Reads the mesh of a part: STEP, IGES, STL, OBJ, PLY or OFF, by the file's extension.
 *
 * What is damaged or cut off is an error. Polygons are cut into triangles; all but the shape is skipped. The triangles
 * of an STL file share the vertices that lie at exactly the same place. OFF is ascii, also COFF, NOFF, STOFF and their
 * combinations. STEP and IGES files (.step, .stp, .iges, .igs) need the module PPFMEAM::Training; the faces of all
 * their solids and shells, or of one solid, are triangulated.
 *
 * Output port 0: vtkPolyData, the triangles, of STEP and IGES files in mm, of others in the file's unit;
 * vtkMEAMMeshPreparation brings them to mm. Field data: CADReport, if there is anything to tell: that a file holds
 * several solids, or components that are hardly of the part.
 */
#ifndef vtkMEAMMeshReader_h
#define vtkMEAMMeshReader_h

#include "ppfmeamIOModule.h"
#include "vtkMEAMPropertyMacros.h"
#include "vtkPolyDataAlgorithm.h"

class PPFMEAMIO_EXPORT vtkMEAMMeshReader : public vtkPolyDataAlgorithm
{
public:
  static vtkMEAMMeshReader* New();
  vtkTypeMacro(vtkMEAMMeshReader, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The file to read. Default: none. */
  vtkMEAMFileMemberMacro(FileName);

  /** Of a STEP or IGES file with several solids the one that is the part, from 1; 0: all together. Default: 0. */
  vtkMEAMMemberMacro(Solid, int);

protected:
  vtkMEAMMeshReader();
  ~vtkMEAMMeshReader() override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  char* FileName = nullptr;
  int Solid = 0;
};

#endif
