// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMPoseRefinement
 * @brief Moves each pose to where edges and surface fit best.
 *
 * Section 5.3 of the paper: iterative closest point with the appearance model of the pose. PointToPoint is
 * the paper's way, on edge points alone. EdgesAndSurface, the recommended one, draws visible edge points to
 * the tangent lines of the scene's edges and visible surface points to the scene's surface along the part's
 * normals.
 *
 * Input port 0: vtkPolyData of poses (vtkMEAMPoseVerification): `Transform`.
 * Input port 1: vtkPartitionedDataSetCollection, the trained model (vtkMEAMHashing).
 * Input port 2: vtkPolyData, edge points of the scene in mm with `Tangent` (vtkMEAMTangentEstimation).
 * Input port 3, optional: vtkPointSet, all points the sensor measured, in mm: an organized cloud
 * (vtkStructuredGrid, invalid points NaN or blanked) or any cloud. Without it only edges count.
 *
 * Output port 0: vtkPolyData, the same poses in the same order with a better `Transform`; the other arrays
 * of vtkMEAMPoseDetection stay, so verify them again for a score. Added: `Residual` (mm, root mean square),
 * `Iterations`, `Covariance` (6 x 6: rotation vector in radians and translation in mm of a small motion about the
 * middle of the part's surface, scene axes), `ConstrainedDegreesOfFreedom` (0 to 6: what the scene's points fix) and
 * `ConstrainedAxes` (6: which, as shares from 0 to 1 of the turns about the part's x, y and z axis through that middle
 * and of the shifts along them). Field data `Diameter` (mm, of the part).
 */
#ifndef vtkMEAMPoseRefinement_h
#define vtkMEAMPoseRefinement_h

#include "vtkMEAMPoseAlgorithm.h"

namespace meam
{
struct PoseRefinementSettings;
}

class PPFMEAMDETECTION_EXPORT vtkMEAMPoseRefinement : public vtkMEAMPoseAlgorithm
{
public:
  static vtkMEAMPoseRefinement* New();
  vtkTypeMacro(vtkMEAMPoseRefinement, vtkMEAMPoseAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Methods
  {
    PointToPoint = 0,
    EdgesAndSurface = 1
  };

  ///@{
  /**
   * PointToPoint (0, the paper's) or EdgesAndSurface (1). Default: EdgesAndSurface.
   */
  vtkMEAMDeclareSettingMacro(Method, int);
  void SetMethodToPointToPoint() { this->SetMethod(PointToPoint); }
  void SetMethodToEdgesAndSurface() { this->SetMethod(EdgesAndSurface); }
  ///@}

  /**
   * Steps of each pose, at least 1. Default: 10. The paper: 50.
   */
  vtkMEAMDeclareSettingMacro(NumberOfIterations, int);

  /**
   * Between corresponding points at the start, in mm; 0: 10 % of the part's diameter, PointToPoint 4 %. Default: 0.
   */
  vtkMEAMDeclareSettingMacro(MaximumDistance, double);

  /** The parameters of the paper, Section 6. Sensor and number of threads stay. */
  void SetParametersToPaper();
  /** The parameters that measure better: the defaults. Sensor and number of threads stay. */
  void SetParametersToRecommended();

protected:
  vtkMEAMPoseRefinement();
  ~vtkMEAMPoseRefinement() override;
  void Process(Work& work) override;

private:
  std::unique_ptr<meam::PoseRefinementSettings> Settings;
};

#endif
