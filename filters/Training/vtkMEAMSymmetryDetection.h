// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMSymmetryDetection
 * @brief Finds the rotations that map a part onto itself, exactly or nearly.
 *
 * Axes through the part's middle are tried in all directions, the best are fitted, and what a turn about
 * them maps is measured. Mirror images are no symmetries here: a part cannot be turned into its image.
 *
 * Input port 0: vtkPolyData, even samples of the part's surface with `Normals` (vtkMEAMSurfaceSampling), mm.
 *
 * Output port 0: the samples with the point array `Deviation` (mm): how far each comes to lie from the
 * surface after the near-symmetry `ShownNearSymmetry`; 0 when there is none. Field data `SymmetriesDiscrete`
 * (16 components, row-major, one tuple for each turn, the identity left out), `SymmetriesContinuous` (6
 * components: unit axis and a point on it), `NearSymmetries` (16), `NearSymmetryOverlap` (share of the surface
 * that comes to lie on the surface, [0, 1]) and `NearSymmetryDeviation` (mm, the largest distance; 8 % of the diameter
 * stands for more), best first.
 * `ModelsInfo` is the part's entry in a BOP dataset's models_info.json, as text.
 */
#ifndef vtkMEAMSymmetryDetection_h
#define vtkMEAMSymmetryDetection_h

#include "ppfmeamTrainingModule.h"
#include "vtkMEAMPropertyMacros.h"
#include "vtkPolyDataAlgorithm.h"

#include <memory>

namespace meam
{
struct SymmetryDetectionSettings;
}

class PPFMEAMTRAINING_EXPORT vtkMEAMSymmetryDetection : public vtkPolyDataAlgorithm
{
public:
  static vtkMEAMSymmetryDetection* New();
  vtkTypeMacro(vtkMEAMSymmetryDetection, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Distance in mm that the turned surface may keep from itself; 0: 1 % of the diameter. Default: 0. */
  vtkMEAMDeclareSettingMacro(Tolerance, double);

  /** Share of the surface that a near-symmetry has to map onto the surface, in [0, 1]. Default: 0.8. */
  vtkMEAMDeclareSettingMacro(LeastOverlap, double);

  /** The near-symmetry whose deviation the points show, counted from 0. Default: 0. */
  vtkMEAMClampedMemberMacro(ShownNearSymmetry, int, 0, VTK_INT_MAX);

  /**
   * A BOP dataset's models_info.json that names the exact symmetries; only the near ones are then looked for.
   * Default: none, all are found.
   */
  vtkMEAMFileMemberMacro(ModelsInfoFile);

  /** The part's number in the ModelsInfoFile. Default: 1. */
  vtkMEAMClampedMemberMacro(ObjectId, int, 0, VTK_INT_MAX);

protected:
  vtkMEAMSymmetryDetection();
  ~vtkMEAMSymmetryDetection() override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  std::unique_ptr<meam::SymmetryDetectionSettings> Settings;
  int ShownNearSymmetry = 0;
  char* ModelsInfoFile = nullptr;
  int ObjectId = 1;
};

#endif
