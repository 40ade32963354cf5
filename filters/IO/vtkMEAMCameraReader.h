// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMCameraReader
 * @brief Base of the readers that need to know the camera that took what they read.
 *
 * Holds the file's name and the camera: a calibration file, or a pinhole's focal length and principal point.
 */
#ifndef vtkMEAMCameraReader_h
#define vtkMEAMCameraReader_h

#include "ppfmeamIOModule.h"
#include "vtkMEAMPropertyMacros.h"
#include "vtkDataObjectAlgorithm.h"

class PPFMEAMIO_EXPORT vtkMEAMCameraReader : public vtkDataObjectAlgorithm
{
public:
  vtkTypeMacro(vtkMEAMCameraReader, vtkDataObjectAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The file to read. Default: none. */
  vtkMEAMFileMemberMacro(FileName);

  /**
   * The camera's calibration, lengths in mm: OpenCV's own format (YAML, XML or JSON: camera_matrix,
   * distortion_coefficients, image_width, image_height, R and T), or the camera.json of a BOP dataset. None: a
   * pinhole with the next two properties. Default: none.
   */
  vtkMEAMFileMemberMacro(CameraFile);

  /** fx and fy in pixels; 0: not known. No meaning with a CameraFile. Default: 0, 0. */
  vtkMEAMVectorMemberMacro(FocalLength, double, 2);

  /** cx and cy in pixels; the centre of the upper left pixel is 0, 0. No meaning with a CameraFile. Default: 0, 0. */
  vtkMEAMVectorMemberMacro(PrincipalPoint, double, 2);

protected:
  vtkMEAMCameraReader();
  ~vtkMEAMCameraReader() override;

  char* FileName = nullptr;
  char* CameraFile = nullptr;
  double FocalLength[2] = { 0.0, 0.0 };
  double PrincipalPoint[2] = { 0.0, 0.0 };
};

#endif
