// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMPoseInstances
 * @brief Puts a copy of the CAD mesh at every pose, coloured by rank, to look at.
 *
 * Input port 0: poses, best first, a vtkPolyData with the point array `Transform` (16, row-major
 * T_scene_model) and, where they are there, `Score`, `PlaceProbability`, `Probability` and `Rank`.
 * Input port 1: the CAD mesh in the frame of the poses, a vtkPolyData; MeshPreparation gives it. Repeatable, for poses
 * of several types of part, in the order of their `PartId`.
 *
 * Output port 0: a vtkPolyData with all copies, best first. Point and cell arrays:
 * - `Rank`, the active scalars: 1 for the best; that of the poses, so that those of one part (a threshold of `PartId`)
 *   keep theirs; of several meshes `PartId` is active;
 * - `Score`, `PlaceProbability`, `Probability`, `Certainty`, `VisibleFraction`: [0, 1], of the pose;
 * - `RankColor` (3, unsigned char): red, green, blue, yellow and pink for the ranks 1 to 5, the
 *   same, dark, for 6 to 10, grey for the others.
 *
 * Output port 1: with an UncertaintyScale the ellipsoids of how uncertain the place of each copy's middle is, a
 * vtkPolyData with the same arrays; empty otherwise. For it the poses need the arrays of vtkMEAMPoseRefinement and the
 * field data `PartBounds` and `PartMiddle`, as vtkMEAMPoseEstimation gives them.
 *
 * Output port 2: a vtkTable with one row, `Text`: how many poses get no copy for their probability, to show in a view;
 * empty when all get one.
 */
#ifndef vtkMEAMPoseInstances_h
#define vtkMEAMPoseInstances_h

#include "ppfmeamDetectionModule.h"
#include "vtkMEAMPropertyMacros.h"
#include "vtkPolyDataAlgorithm.h"

#include <memory>

namespace vtkMEAMConversion
{
struct InstanceSettings;
}

class PPFMEAMDETECTION_EXPORT vtkMEAMPoseInstances : public vtkPolyDataAlgorithm
{
public:
  static vtkMEAMPoseInstances* New();
  vtkTypeMacro(vtkMEAMPoseInstances, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Takes the meshes of all types of part away; one is added by AddInputConnection(1, ...). */
  void RemoveAllMeshConnections() { this->RemoveAllInputConnections(1); }

  /** The CAD mesh. */
  void SetMeshConnection(vtkAlgorithmOutput* mesh) { this->SetInputConnection(1, mesh); }

  /** Copies made, the best poses; 0 for all. Default: 0. */
  vtkMEAMDeclareSettingMacro(MaximumNumberOfInstances, int);

  /**
   * Poses get no copy where one is less likely to be there, however it is turned; poses whose probability is not known
   * (0), such as true ones, do. Default: 0.5, those that are there more likely than not.
   */
  vtkMEAMDeclareSettingMacro(MinimumProbability, double);

  /** Standard deviations that the ellipsoids on output port 1 reach to, such as 1000; 0: none. Default: 0. */
  vtkMEAMClampedMemberMacro(UncertaintyScale, double, 0.0, VTK_DOUBLE_MAX);

protected:
  vtkMEAMPoseInstances();
  ~vtkMEAMPoseInstances() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  std::unique_ptr<vtkMEAMConversion::InstanceSettings> Settings;
  double UncertaintyScale = 0.0;
};

#endif
