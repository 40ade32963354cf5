// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMDepthImageReader
 * @brief Reads a depth image as the organized cloud that its camera measured.
 *
 * The depth image has one channel of 16 bits (PNG, TIFF or PGM) or of real numbers (TIFF or PFM); 0 stands for no
 * depth. The lens is undone.
 *
 * Output port 0: a vtkStructuredGrid of W x H x 1 points, row by row from the top left, in mm in the camera's
 * frame (x right, y down, z the way it looks); points without depth are NaN and blanked. With an image the
 * point array `Intensity` (unsigned char) or `RGB` (3, unsigned char).
 */
#ifndef vtkMEAMDepthImageReader_h
#define vtkMEAMDepthImageReader_h

#include "ppfmeamIOImageModule.h"
#include "vtkMEAMPropertyMacros.h"
#include "vtkMEAMCameraReader.h"

class PPFMEAMIOIMAGE_EXPORT vtkMEAMDepthImageReader : public vtkMEAMCameraReader
{
public:
  static vtkMEAMDepthImageReader* New();
  vtkTypeMacro(vtkMEAMDepthImageReader, vtkMEAMCameraReader);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The registered grey or colour image of the same size: PNG, JPEG, BMP or TIFF. Default: none. */
  vtkMEAMFileMemberMacro(ImageFileName);

  /**
   * mm that a value of 1 in the depth image stands for; 0: the depth_scale of the CameraFile or, without, 1.
   * Default: 0.
   */
  vtkMEAMClampedMemberMacro(DepthScale, double, 0.0, 1e9);

protected:
  vtkMEAMDepthImageReader() = default;
  ~vtkMEAMDepthImageReader() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  char* ImageFileName = nullptr;
  double DepthScale = 0.0;
};

#endif
