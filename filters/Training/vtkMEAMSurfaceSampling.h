// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMSurfaceSampling
 * @brief Covers the part's surface evenly with points.
 *
 * Poisson discs: no two samples that face the same way are closer than the spacing and no more would fit, so
 * that narrow faces and both sides of a thin wall get samples of their own. Normals come from the winding of
 * the triangles. What is visible of the part and where its edges are is found on these points.
 *
 * Input port 0: vtkPolyData, the prepared mesh in mm (vtkMEAMMeshPreparation); polygons and triangle strips
 * are cut into triangles.
 *
 * Output port 0: vtkPolyData, the points with `Normals` (unit, outward) and `PointId` (their number: the
 * point's identity in all appearance models). Field data `Diameter`: d_max of the mesh in mm.
 */
#ifndef vtkMEAMSurfaceSampling_h
#define vtkMEAMSurfaceSampling_h

#include "ppfmeamTrainingModule.h"
#include "vtkMEAMPropertyMacros.h"
#include "vtkPolyDataAlgorithm.h"

class PPFMEAMTRAINING_EXPORT vtkMEAMSurfaceSampling : public vtkPolyDataAlgorithm
{
public:
  static vtkMEAMSurfaceSampling* New();
  vtkTypeMacro(vtkMEAMSurfaceSampling, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Distance between neighbouring samples in mm; 0: 1 % of the part's diameter. Default: 0. */
  vtkMEAMClampedMemberMacro(Spacing, double, 0.0, VTK_DOUBLE_MAX);

  /** Seed of the random choice: the same seed gives the same samples. Default: 1. */
  vtkMEAMClampedMemberMacro(Seed, int, 0, VTK_INT_MAX);

protected:
  vtkMEAMSurfaceSampling();
  ~vtkMEAMSurfaceSampling() override = default;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  double Spacing;
  int Seed;
};

#endif
