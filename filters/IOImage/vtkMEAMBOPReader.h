// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMBOPReader
 * @brief Reads a dataset in the form of the BOP benchmark: scans with their images and true poses, as time steps.
 *
 * FileName is the folder of the dataset, of one of its splits or of a scene, or a file in one of them, such as the
 * dataset's camera.json or a scene's scene_camera.json. The images of all scenes, by scene and number, are the time
 * steps 0, 1, 2...
 *
 * Output port 0: the scan, a vtkStructuredGrid of W x H x 1 points, row by row from the top left, in mm in the
 * camera's frame (x right, y down, z the way it looks); points without depth are NaN and blanked. With an image the
 * point array `Intensity` (unsigned char) or `RGB` (3, unsigned char). Field data `SceneId` and `ImageId`.
 * Output port 1: the true poses, a vtkPolyData with the arrays of every pose; `VisibleFraction` is 0 where it is
 * not known, `Score` and `Votes` are without meaning. The point array `ObjectId` (int) names the object. No points
 * where the truth is not known.
 */
#ifndef vtkMEAMBOPReader_h
#define vtkMEAMBOPReader_h

#include "ppfmeamIOImageModule.h"
#include "vtkMEAMPropertyMacros.h"
#include "vtkStructuredGridAlgorithm.h"

#include <memory>

class PPFMEAMIOIMAGE_EXPORT vtkMEAMBOPReader : public vtkStructuredGridAlgorithm
{
public:
  static vtkMEAMBOPReader* New();
  vtkTypeMacro(vtkMEAMBOPReader, vtkStructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The folder to read, or a file in it. Default: none. */
  vtkMEAMFileMemberMacro(FileName);

  ///@{
  /** The part of a whole dataset to read: the folder's name. Default: test. */
  vtkSetStringMacro(Split);
  vtkGetStringMacro(Split);
  ///@}

  /** The object whose true poses come out; 0 for all. Default: 0. */
  vtkMEAMClampedMemberMacro(ObjectId, int, 0, VTK_INT_MAX);

  /** 1 when there is a scene with images in the folder. */
  int CanReadFile(const char* fileName);

protected:
  vtkMEAMBOPReader();
  ~vtkMEAMBOPReader() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  class Images;
  std::unique_ptr<Images> Listed;

  char* FileName = nullptr;
  char* Split = nullptr;
  int ObjectId = 0;
};

#endif
