// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMImageReader
 * @brief Reads a grey or colour image: PNG, JPEG, BMP or TIFF.
 *
 * What is damaged or cut off is an error. An alpha channel is dropped; 16 bit images use their whole range.
 *
 * Output port 0: a vtkImageData of W x H with the scalars `Intensity` (unsigned char) or `RGB` (3, unsigned char),
 * row by row from the lower left, as VTK's readers have it.
 */
#ifndef vtkMEAMImageReader_h
#define vtkMEAMImageReader_h

#include "ppfmeamIOImageModule.h"
#include "vtkMEAMPropertyMacros.h"
#include "vtkImageAlgorithm.h"

class PPFMEAMIOIMAGE_EXPORT vtkMEAMImageReader : public vtkImageAlgorithm
{
public:
  static vtkMEAMImageReader* New();
  vtkTypeMacro(vtkMEAMImageReader, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The file to read; its content, not its name, tells of what kind it is. Default: none. */
  vtkMEAMFileMemberMacro(FileName);

  /** 1 when the file starts like an image whose size it can hold. */
  int CanReadFile(const char* fileName);

protected:
  vtkMEAMImageReader();
  ~vtkMEAMImageReader() override;

  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  char* FileName = nullptr;
};

#endif
