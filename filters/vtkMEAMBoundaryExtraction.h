// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMBoundaryExtraction
 * @brief Reduces each appearance model to its edge points.
 *
 * Section 4 of the paper. A point is on the boundary when the directions to its neighbours, on its tangent
 * plane, leave a gap that is wider than an angle (PCL's boundary estimation). What hides behind other faces
 * is gone from the appearance models, so creases and silhouettes are boundaries there.
 *
 * Input port 0: vtkPartitionedDataSetCollection of appearance models (vtkMEAMVisibilityExtraction); the
 * points need `Normals`.
 *
 * Output port 0: vtkPartitionedDataSetCollection with the same partitions, their edge points alone, with
 * `Normals` and `PointId`. Field data is passed on.
 */
#ifndef vtkMEAMBoundaryExtraction_h
#define vtkMEAMBoundaryExtraction_h

#include "ppfmeamFiltersModule.h"
#include "vtkPartitionedDataSetCollectionAlgorithm.h"

class PPFMEAMFILTERS_EXPORT vtkMEAMBoundaryExtraction : public vtkPartitionedDataSetCollectionAlgorithm
{
public:
  static vtkMEAMBoundaryExtraction* New();
  vtkTypeMacro(vtkMEAMBoundaryExtraction, vtkPartitionedDataSetCollectionAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Neighbourhood of a point in mm; 0: 2.5 times the distance between neighbouring points. Default: 0. */
  vtkSetClampMacro(Radius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /** A point with a wider gap between its neighbours is on the boundary, in degrees. Default: 90. */
  vtkSetClampMacro(Angle, double, 0.0, 360.0);
  vtkGetMacro(Angle, double);
  ///@}

protected:
  vtkMEAMBoundaryExtraction();
  ~vtkMEAMBoundaryExtraction() override = default;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkMEAMBoundaryExtraction(const vtkMEAMBoundaryExtraction&) = delete;
  void operator=(const vtkMEAMBoundaryExtraction&) = delete;

  double Radius;
  double Angle;
};

#endif
