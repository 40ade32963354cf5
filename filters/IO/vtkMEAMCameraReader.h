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
#include "vtkDataObjectAlgorithm.h"

class PPFMEAMIO_EXPORT vtkMEAMCameraReader : public vtkDataObjectAlgorithm
{
public:
  vtkTypeMacro(vtkMEAMCameraReader, vtkDataObjectAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** The file to read. Default: none. */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * The camera's calibration, lengths in mm: OpenCV's own format (YAML, XML or JSON: camera_matrix,
   * distortion_coefficients, image_width, image_height, R and T), or the camera.json of a BOP dataset. None: a
   * pinhole with the next two properties. Default: none.
   */
  vtkSetFilePathMacro(CameraFile);
  vtkGetFilePathMacro(CameraFile);
  ///@}

  ///@{
  /** fx and fy in pixels; 0: not known. No meaning with a CameraFile. Default: 0, 0. */
  vtkSetVector2Macro(FocalLength, double);
  vtkGetVector2Macro(FocalLength, double);
  ///@}

  ///@{
  /** cx and cy in pixels; the centre of the upper left pixel is 0, 0. No meaning with a CameraFile. Default: 0, 0. */
  vtkSetVector2Macro(PrincipalPoint, double);
  vtkGetVector2Macro(PrincipalPoint, double);
  ///@}

protected:
  vtkMEAMCameraReader();
  ~vtkMEAMCameraReader() override;

  char* FileName = nullptr;
  char* CameraFile = nullptr;
  double FocalLength[2] = { 0.0, 0.0 };
  double PrincipalPoint[2] = { 0.0, 0.0 };

private:
  vtkMEAMCameraReader(const vtkMEAMCameraReader&) = delete;
  void operator=(const vtkMEAMCameraReader&) = delete;
};

#endif
