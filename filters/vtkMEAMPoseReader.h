// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMPoseReader
 * @brief Reads poses from a text file of 4x4 matrices.
 *
 * Blocks of 16 numbers, row-major T_scene_model in mm; '#' starts a comment, line breaks do not matter.
 * This is the form of the Tohoku dataset's ground truth and one of those of vtkMEAMPoseWriter. A file
 * without numbers gives no poses.
 *
 * Output port 0: a vtkPolyData with one vertex for each pose, in the file's order, with the point
 * arrays `Transform` (16), `Quaternion` (x y z w), `Rank` (1 for the first) and, without meaning here,
 * `Score`, `Votes`, `ViewId` and `VisibleFraction`.
 */
#ifndef vtkMEAMPoseReader_h
#define vtkMEAMPoseReader_h

#include "ppfmeamFiltersModule.h"
#include "vtkPolyDataAlgorithm.h"

class PPFMEAMFILTERS_EXPORT vtkMEAMPoseReader : public vtkPolyDataAlgorithm
{
public:
  static vtkMEAMPoseReader* New();
  vtkTypeMacro(vtkMEAMPoseReader, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** The file to read. Default: none. */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  /** 1 when the file can be read as poses. */
  int CanReadFile(const char* fileName);

protected:
  vtkMEAMPoseReader();
  ~vtkMEAMPoseReader() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkMEAMPoseReader(const vtkMEAMPoseReader&) = delete;
  void operator=(const vtkMEAMPoseReader&) = delete;

  char* FileName = nullptr;
};

#endif
