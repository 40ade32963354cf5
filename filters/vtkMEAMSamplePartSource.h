// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMSamplePartSource
 * @brief The part of the examples: a ribbed flange, made without outside data.
 *
 * 80 mm across and 22 mm high with thin walls, as in car air-conditioning. Its axis is z; a lug, a gap in
 * the rim and a missing rib fix the roll.
 *
 * Output port 0: a vtkPolyData of triangles in mm, closed and facing outwards; field data `Diameter`.
 */
#ifndef vtkMEAMSamplePartSource_h
#define vtkMEAMSamplePartSource_h

#include "ppfmeamFiltersModule.h"
#include "vtkPolyDataAlgorithm.h"

class PPFMEAMFILTERS_EXPORT vtkMEAMSamplePartSource : public vtkPolyDataAlgorithm
{
public:
  static vtkMEAMSamplePartSource* New();
  vtkTypeMacro(vtkMEAMSamplePartSource, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkMEAMSamplePartSource();
  ~vtkMEAMSamplePartSource() override = default;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkMEAMSamplePartSource(const vtkMEAMSamplePartSource&) = delete;
  void operator=(const vtkMEAMSamplePartSource&) = delete;
};

#endif
