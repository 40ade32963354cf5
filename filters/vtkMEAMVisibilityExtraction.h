// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMVisibilityExtraction
 * @brief Makes the appearance models: what is seen of the part from each of several viewpoints.
 *
 * Section 4 of the paper. The viewpoints stand around the part; the points that are visible from each are
 * found by hidden point removal (Katz, Tal and Basri 2007): the points are inverted in a sphere around the
 * viewpoint, and those on the convex hull of the result are visible.
 *
 * Input port 0: vtkPolyData, samples of the part's surface in mm (vtkMEAMSurfaceSampling); `Normals` and
 * `PointId` are passed on.
 *
 * Output port 0: vtkPartitionedDataSetCollection, one named vtkPolyData for each viewpoint: its visible
 * points with `Normals` and `PointId`; field data of each `ViewDirection` (unit, from the part to the
 * viewpoint) and `ViewIndex`. The input's field data (`Diameter`) is on the collection.
 */
#ifndef vtkMEAMVisibilityExtraction_h
#define vtkMEAMVisibilityExtraction_h

#include "ppfmeamFiltersModule.h"
#include "vtkPartitionedDataSetCollectionAlgorithm.h"

class PPFMEAMFILTERS_EXPORT vtkMEAMVisibilityExtraction : public vtkPartitionedDataSetCollectionAlgorithm
{
public:
  static vtkMEAMVisibilityExtraction* New();
  vtkTypeMacro(vtkMEAMVisibilityExtraction, vtkPartitionedDataSetCollectionAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Number of viewpoints. 1: above (+z); 2: above and below; 6: along the axes, as in the paper; 14: and
   * the cube's corners; 26: and the middles of its edges; any other number is spread over the sphere.
   * A trained model takes up to 32. Default: 6.
   */
  vtkSetClampMacro(NumberOfViewpoints, int, 1, 1000);
  vtkGetMacro(NumberOfViewpoints, int);
  ///@}

  ///@{
  /**
   * Radius of the inversion sphere over the distance of the farthest point. Smaller loses the rims of
   * holes, larger lets the back side through. Default: 1000.
   */
  vtkSetClampMacro(RadiusFactor, double, 1.0, VTK_DOUBLE_MAX);
  vtkGetMacro(RadiusFactor, double);
  ///@}

  ///@{
  /** Distance of the viewpoints from the middle of the part, in part diameters. Default: 10. */
  vtkSetClampMacro(ViewpointDistance, double, 1.0, VTK_DOUBLE_MAX);
  vtkGetMacro(ViewpointDistance, double);
  ///@}

protected:
  vtkMEAMVisibilityExtraction();
  ~vtkMEAMVisibilityExtraction() override = default;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkMEAMVisibilityExtraction(const vtkMEAMVisibilityExtraction&) = delete;
  void operator=(const vtkMEAMVisibilityExtraction&) = delete;

  int NumberOfViewpoints;
  double RadiusFactor;
  double ViewpointDistance;
};

#endif
