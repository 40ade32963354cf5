// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMPLYReader
 * @brief Reads the points of a PLY file, which is never organized; with the camera they come back onto its pixels.
 *
 * Ascii or binary; faces are skipped (vtkMEAMMeshReader reads meshes).
 *
 * Output port 0:
 * - without a camera: a vtkPolyData with a vertex for each point; points that are not finite are left out.
 * - with a camera: a vtkStructuredGrid of its W x H x 1 pixels, in the camera's frame (x right, y down, z the way
 *   it looks). Each pixel keeps the nearest point that it sees; pixels without a point are NaN and blanked, and their
 *   grey value or colour is that of the nearest pixel with one.
 *
 * Point arrays, where the file has the properties:
 * - `Normals` (3) from nx, ny, nz;
 * - `Intensity` (unsigned char) from intensity, gray, i or scalar_intensity. Whole numbers from 0 to 255 are kept,
 *   other values are spread so that the largest becomes 255;
 * - `RGB` (3, unsigned char) from red, green, blue or r, g, b, of 8 or 16 bits, or real numbers up to 1 or 255.
 */
#ifndef vtkMEAMPLYReader_h
#define vtkMEAMPLYReader_h

#include "ppfmeamIOModule.h"
#include "vtkMEAMCloudReader.h"

class PPFMEAMIO_EXPORT vtkMEAMPLYReader : public vtkMEAMCloudReader
{
public:
  static vtkMEAMPLYReader* New();
  vtkTypeMacro(vtkMEAMPLYReader, vtkMEAMCloudReader);
  /** 1 when the file is a PLY file with points and no faces, or is called so and is none, which Update says. */
  int CanReadFile(const char* fileName);

protected:
  vtkMEAMPLYReader() = default;
  ~vtkMEAMPLYReader() override = default;

  meam::MeasuredCloud Read(const std::function<bool(double)>& progress) override;
  std::array<int, 2> GridSize() override { return { 0, 0 }; }
};

#endif
