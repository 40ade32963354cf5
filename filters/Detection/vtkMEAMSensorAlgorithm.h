// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMSensorAlgorithm
 * @brief Base of the filters that need to know where the scene is seen from.
 *
 * Holds the sensor's properties and the number of threads; what the sensor sees decides which points of the
 * part should be visible at a pose, and what hides them.
 */
#ifndef vtkMEAMSensorAlgorithm_h
#define vtkMEAMSensorAlgorithm_h

#include "ppfmeamDetectionModule.h"
#include "vtkMEAMPropertyMacros.h"
#include "vtkPolyDataAlgorithm.h"

class PPFMEAMDETECTION_EXPORT vtkMEAMSensorAlgorithm : public vtkPolyDataAlgorithm
{
public:
  vtkTypeMacro(vtkMEAMSensorAlgorithm, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Projections
  {
    Automatic = 0,
    Orthographic = 1,
    Perspective = 2
  };

  ///@{
  /**
   * How the sensor looks at the scene. Automatic (0): perspective from the origin along +z when the scene's
   * surface is an organized cloud (vtkStructuredGrid), otherwise orthographic along ViewDirection. Where edges are
   * found in a scan, its points tell, unless ViewDirection is given. Orthographic (1): along ViewDirection. Perspective
   * (2): from SensorPosition, looking along ViewDirection. Default: Automatic.
   */
  vtkMEAMClampedMemberMacro(Projection, int, Automatic, Perspective);
  void SetProjectionToAutomatic() { this->SetProjection(Automatic); }
  void SetProjectionToOrthographic() { this->SetProjection(Orthographic); }
  void SetProjectionToPerspective() { this->SetProjection(Perspective); }
  ///@}

  /**
   * The way the sensor looks, in scene coordinates; of any length. 0, 0, 0: a perspective one looks at the middle of
   * the scene's surface. Default: 0, 0, -1 (from above).
   */
  vtkMEAMVectorMemberMacro(ViewDirection, double, 3);

  /** Where a perspective sensor is, in scene coordinates, in mm. Default: 0, 0, 0. */
  vtkMEAMVectorMemberMacro(SensorPosition, double, 3);

  /** Threads to work with; 0: one for each processor. The result does not depend on it. Default: 0. */
  vtkMEAMClampedMemberMacro(NumberOfThreads, int, 0, VTK_INT_MAX);

protected:
  vtkMEAMSensorAlgorithm() = default;
  ~vtkMEAMSensorAlgorithm() override = default;

  int Projection = Automatic;
  double ViewDirection[3] = { 0.0, 0.0, -1.0 };
  double SensorPosition[3] = { 0.0, 0.0, 0.0 };
  int NumberOfThreads = 0;
};

#endif
