// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMXYZReader
 * @brief Reads the points of a text, one in a line: .xyz, .csv, .txt, .asc, .pts; with the camera they come back onto
 * its pixels.
 *
 * Numbers stand between blanks, tabs, commas or semicolons. The columns are told by the names in a first line, or are
 * x y z and, by their number and values, an intensity, a colour and a normal.
 *
 * Output port 0 and its point arrays `Normals`, `Intensity` and `RGB` are those of vtkMEAMPLYReader.
 */
#ifndef vtkMEAMXYZReader_h
#define vtkMEAMXYZReader_h

#include "ppfmeamIOModule.h"
#include "vtkMEAMCloudReader.h"

class PPFMEAMIO_EXPORT vtkMEAMXYZReader : public vtkMEAMCloudReader
{
public:
  static vtkMEAMXYZReader* New();
  vtkTypeMacro(vtkMEAMXYZReader, vtkMEAMCloudReader);
  /**
   * 1 when the file begins with points in lines, after their names or without, and when it is called .xyz, .asc or .pts
   * and begins with no number at all, which Update says.
   */
  int CanReadFile(const char* fileName);

protected:
  vtkMEAMXYZReader() = default;
  ~vtkMEAMXYZReader() override = default;

  meam::MeasuredCloud Read(const std::function<bool(double)>& progress) override;
  std::array<int, 2> GridSize() override { return { 0, 0 }; }
};

#endif
