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
  vtkSetClampMacro(Projection, int, Automatic, Perspective);
  vtkGetMacro(Projection, int);
  void SetProjectionToAutomatic() { this->SetProjection(Automatic); }
  void SetProjectionToOrthographic() { this->SetProjection(Orthographic); }
  void SetProjectionToPerspective() { this->SetProjection(Perspective); }
  ///@}

  ///@{
  /**
   * The way the sensor looks, in scene coordinates; of any length. 0, 0, 0: a perspective one looks at the middle of
   * the scene's surface. Default: 0, 0, -1 (from above).
   */
  vtkSetVector3Macro(ViewDirection, double);
  vtkGetVector3Macro(ViewDirection, double);
  ///@}

  ///@{
  /** Where a perspective sensor is, in scene coordinates, in mm. Default: 0, 0, 0. */
  vtkSetVector3Macro(SensorPosition, double);
  vtkGetVector3Macro(SensorPosition, double);
  ///@}

  ///@{
  /** Threads to work with; 0: one for each processor. The result does not depend on it. Default: 0. */
  vtkSetClampMacro(NumberOfThreads, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

protected:
  vtkMEAMSensorAlgorithm() = default;
  ~vtkMEAMSensorAlgorithm() override = default;

  int Projection = Automatic;
  double ViewDirection[3] = { 0.0, 0.0, -1.0 };
  double SensorPosition[3] = { 0.0, 0.0, 0.0 };
  int NumberOfThreads = 0;

private:
  vtkMEAMSensorAlgorithm(const vtkMEAMSensorAlgorithm&) = delete;
  void operator=(const vtkMEAMSensorAlgorithm&) = delete;
};

#endif
