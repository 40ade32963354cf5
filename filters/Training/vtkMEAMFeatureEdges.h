// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMFeatureEdges
 * @brief Samples the sharp edges and the borders of a part's mesh.
 *
 * An edge is sharp where two faces meet at more than an angle, or where more than two faces meet. Points are
 * even along the chains that the edges form, and their tangents are the directions of the mesh's edges: nothing
 * is estimated.
 *
 * Input port 0: vtkPolyData, the prepared mesh in mm (vtkMEAMMeshPreparation); polygons and triangle strips
 * are cut into triangles.
 *
 * Output port 0: vtkPolyData, the points with `Tangent` (unit), `Normals` (unit, the mean of the edge's faces),
 * `PointId` (their number) and `EdgeType` (1 sharp edge, 2 border of an open mesh). A closed, smooth mesh gives no
 * points. Field data `Diameter`: d_max of the mesh in mm.
 */
#ifndef vtkMEAMFeatureEdges_h
#define vtkMEAMFeatureEdges_h

#include "ppfmeamTrainingModule.h"
#include "vtkMEAMPropertyMacros.h"
#include "vtkPolyDataAlgorithm.h"

#include <memory>

namespace meam
{
struct FeatureEdgesSettings;
}

class PPFMEAMTRAINING_EXPORT vtkMEAMFeatureEdges : public vtkPolyDataAlgorithm
{
public:
  static vtkMEAMFeatureEdges* New();
  vtkTypeMacro(vtkMEAMFeatureEdges, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Faces that meet at more than this make a sharp edge, in degrees. Default: 30. */
  vtkMEAMDeclareSettingMacro(Angle, double);

  /** Distance between neighbouring points along an edge in mm; 0: 1 % of the part's diameter. Default: 0. */
  vtkMEAMDeclareSettingMacro(Spacing, double);

protected:
  vtkMEAMFeatureEdges();
  ~vtkMEAMFeatureEdges() override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  std::unique_ptr<meam::FeatureEdgesSettings> Settings;
};

#endif
