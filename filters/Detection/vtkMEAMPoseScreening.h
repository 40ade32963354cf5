// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMPoseScreening
 * @brief Drops raw candidates that are duplicates or whose surface is not there.
 *
 * Pre-screening, at a fraction of the cost of a score. Of candidates that are nearly the same the one with most votes
 * times the share of its surface that is there stays; candidates less than half of whose surface is there go, when
 * there are more than a few; those that stay are turned by the approximate symmetry that the scene's edges speak for.
 * Candidates that any rotation of a nearly round part makes equal are duplicates, too. Without a surface only
 * duplicates go.
 *
 * Input ports: as vtkMEAMPoseAlgorithm has them; port 0: raw candidates (vtkMEAMPoseDetection).
 * Output port 0: the candidates that stay, in the order they came; a vtkPolyData with the arrays of
 * vtkMEAMPoseDetection.
 */
#ifndef vtkMEAMPoseScreening_h
#define vtkMEAMPoseScreening_h

#include "vtkMEAMPoseAlgorithm.h"

namespace meam
{
struct PoseScreeningSettings;
}

class PPFMEAMDETECTION_EXPORT vtkMEAMPoseScreening : public vtkMEAMPoseAlgorithm
{
public:
  static vtkMEAMPoseScreening* New();
  vtkTypeMacro(vtkMEAMPoseScreening, vtkMEAMPoseAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Share of the surface towards the sensor that has to be there, in [0, 1]. Default: 0.5.
   */
  vtkMEAMDeclareSettingMacro(LeastSurface, double);

  /**
   * Of so many candidates or fewer none has to go for want of surface. Default: 100.
   */
  vtkMEAMDeclareSettingMacro(Enough, int);

  /**
   * Surface of a pose that the sensor saw past speaks against it; false: it says nothing, as where nothing was
   * measured. Default: true.
   */
  vtkMEAMDeclareFlagMacro(FreeSpace);

protected:
  vtkMEAMPoseScreening();
  ~vtkMEAMPoseScreening() override;
  void Process(Work& work) override;

private:
  std::unique_ptr<meam::PoseScreeningSettings> Settings;
};

#endif
