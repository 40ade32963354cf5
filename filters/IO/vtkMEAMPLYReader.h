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
 * - `Intensity` (unsigned char) from intensity, gray or scalar_intensity. Whole numbers from 0 to 255 are kept,
 *   other values are spread so that the largest becomes 255;
 * - `RGB` (3, unsigned char) from red, green, blue.
 */
#ifndef vtkMEAMPLYReader_h
#define vtkMEAMPLYReader_h

#include "ppfmeamIOModule.h"
#include "vtkMEAMCameraReader.h"

class PPFMEAMIO_EXPORT vtkMEAMPLYReader : public vtkMEAMCameraReader
{
public:
  static vtkMEAMPLYReader* New();
  vtkTypeMacro(vtkMEAMPLYReader, vtkMEAMCameraReader);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Factor on the coordinates, to bring them to mm: 1000 for a file in metres. Default: 1. */
  vtkSetClampMacro(Scale, double, 1e-9, 1e9);
  vtkGetMacro(Scale, double);
  ///@}

  ///@{
  /** Pixels of the camera, width and height; 0: those of the CameraFile. Default: 0, 0. */
  vtkSetVector2Macro(ImageSize, int);
  vtkGetVector2Macro(ImageSize, int);
  ///@}

  /** 1 when the file is a PLY file with points and no faces. */
  int CanReadFile(const char* fileName);

protected:
  vtkMEAMPLYReader() = default;
  ~vtkMEAMPLYReader() override = default;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkMEAMPLYReader(const vtkMEAMPLYReader&) = delete;
  void operator=(const vtkMEAMPLYReader&) = delete;

  /** A camera is given. */
  bool IsOrganized() const;

  double Scale = 1.0;
  int ImageSize[2] = { 0, 0 };
};

#endif
