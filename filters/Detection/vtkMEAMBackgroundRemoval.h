// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMBackgroundRemoval
 * @brief Blanks the points of a scan that are not worth looking for parts in: the bin, and what is around it.
 *
 * Points outside a region and points that a mask hides are removed, then the largest planes that nothing lies
 * behind: the floor and the walls. Edges on removed points vanish. Parts that lie flat on the floor keep what
 * stands out of it by more than the tolerance. Use the result for vtkMEAMSceneEdgeExtraction; as the surface for
 * vtkMEAMPoseVerification and vtkMEAMPoseRefinement the whole scan is better, because the floor tells where
 * there is no part.
 *
 * Input port 0: the scene, a vtkStructuredGrid of W x H x 1 points in the sensor's frame (mm).
 * Input port 1 (optional): the mask, a vtkImageData of W x H; what is 0 in it is removed.
 *
 * Output: the scene with the removed points NaN and blanked, all its arrays, and the point array `Background`
 * (unsigned char): 0 kept, 1 hidden by the mask, 2 outside the region, 3 on a plane. Field data `Planes` (4
 * components: normal towards the sensor, distance from it in mm).
 */
#ifndef vtkMEAMBackgroundRemoval_h
#define vtkMEAMBackgroundRemoval_h

#include "ppfmeamDetectionModule.h"
#include "vtkMEAMPropertyMacros.h"
#include "vtkStructuredGridAlgorithm.h"

#include <memory>

namespace meam
{
struct BackgroundRemovalSettings;
}

class PPFMEAMDETECTION_EXPORT vtkMEAMBackgroundRemoval : public vtkStructuredGridAlgorithm
{
public:
  static vtkMEAMBackgroundRemoval* New();
  vtkTypeMacro(vtkMEAMBackgroundRemoval, vtkStructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The mask. */
  void SetMaskConnection(vtkAlgorithmOutput* mask) { this->SetInputConnection(1, mask); }

  /**
   * mm, scene coordinates: least and greatest x, y and z of the points to keep; an axis whose two values are
   * equal has no limits. Default: 0, 0, 0, 0, 0, 0.
   */
  vtkMEAMVectorMemberMacro(Region, double, 6);

  /** Planes that are removed at most, the largest first. Default: 1. */
  vtkMEAMDeclareSettingMacro(NumberOfPlanes, int);

  /**
   * mm: points nearer to a plane are on it; 0 for twice the distance of neighbouring points and three times the
   * noise. Default: 0.
   */
  vtkMEAMDeclareSettingMacro(Tolerance, double);

  /** % of the points that mask and region leave: a plane with fewer stays. Default: 10. */
  vtkMEAMDeclareSettingMacro(LeastShare, double);

protected:
  vtkMEAMBackgroundRemoval();
  ~vtkMEAMBackgroundRemoval() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  std::unique_ptr<meam::BackgroundRemovalSettings> Settings;
  double Region[6] = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
};

#endif
