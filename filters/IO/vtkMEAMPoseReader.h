// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMPoseReader
 * @brief Reads poses from a file: results of the BOP benchmark, JSON or 4x4 matrices.
 *
 * The forms are those of vtkMEAMPoseWriter, told apart by what the file holds:
 * - BOP results: a table with the header scene_id,im_id,obj_id,score,R,t,time;
 * - JSON: an object with a list `poses` of objects with at least a `matrix`;
 * - blocks of 16 numbers, row-major T_scene_model in mm; '#' starts a comment, line breaks do not matter. The Tohoku
 *   dataset's ground truth has this form. A file without numbers gives no poses.
 *
 * Output port 0: a vtkPolyData with one vertex for each pose, in the file's order, with the point
 * arrays `Transform` (16), `Quaternion` (x y z w), `Rank` (the file's, or 1 for the first), `SceneId`, `ImageId` and
 * `ObjectId` (0, 0 and 1 where the file has none), and `Score`, `PlaceProbability`, `Probability`, `Certainty`,
 * `Votes`, `ViewId` and `VisibleFraction` as far as the file has them.
 */
#ifndef vtkMEAMPoseReader_h
#define vtkMEAMPoseReader_h

#include "ppfmeamIOModule.h"
#include "vtkMEAMPropertyMacros.h"
#include "vtkPolyDataAlgorithm.h"

class PPFMEAMIO_EXPORT vtkMEAMPoseReader : public vtkPolyDataAlgorithm
{
public:
  static vtkMEAMPoseReader* New();
  vtkTypeMacro(vtkMEAMPoseReader, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The file to read. Default: none. */
  vtkMEAMFileMemberMacro(FileName);

  /** 1 when the file can be read as poses. */
  int CanReadFile(const char* fileName);

protected:
  vtkMEAMPoseReader();
  ~vtkMEAMPoseReader() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  char* FileName = nullptr;
};

#endif
