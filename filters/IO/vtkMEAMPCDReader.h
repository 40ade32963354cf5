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
 * - with a camera: the same of its pixels, in its frame, as vtkMEAMPLYReader has it; a file that is organized already
 * is an error then.
 * - otherwise: a vtkPolyData with a vertex for each point that has depth; the others are left out.
 *
 * Point arrays, where the file has the fields:
 * - `Normals` (3) from normal_x, normal_y, normal_z;
 * - `Intensity` (unsigned char) from intensity, gray or i. Whole numbers from 0 to 255 are kept, other values are
 *   spread so that the largest becomes 255;
 * - `RGB` (3, unsigned char) from rgb or rgba; or from red, green, blue or r, g, b.
 *
 * Field data `Sensor` (6): where points alone, in another frame than their sensor's, were seen from by VIEWPOINT:
 * position and direction, (0, 0, 0) for at their middle. MEAM Pose Estimation takes it where its properties tell none.
 */
#ifndef vtkMEAMPCDReader_h
#define vtkMEAMPCDReader_h

#include "ppfmeamIOModule.h"
#include "vtkMEAMCloudReader.h"

class PPFMEAMIO_EXPORT vtkMEAMPCDReader : public vtkMEAMCloudReader
{
public:
  static vtkMEAMPCDReader* New();
  vtkTypeMacro(vtkMEAMPCDReader, vtkMEAMCloudReader);
  /** 1 when the file has the extension pcd: no other reader takes those, and Update says what is wrong with it. */
  int CanReadFile(const char* fileName);

protected:
  vtkMEAMPCDReader() = default;
  ~vtkMEAMPCDReader() override = default;

  meam::MeasuredCloud Read(const std::function<bool(double)>& progress) override;
  std::array<int, 2> GridSize() override;
};

#endif
