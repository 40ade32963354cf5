// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMTangentEstimation
 * @brief Thins edge points and gives each the direction of its edge.
 *
 * The paper (Section 5.1, Algorithms 1 and 2) cuts the edge points into tiles of a plane and takes, for each
 * point, the line to another point of its tile that most points lie on. The recommended method looks for the
 * best supported line in a sphere around the point and takes the principal axis of the points on it. Points
 * without a supported line are left out. Edge points that carry tangents, those of a mesh's edges, keep
 * them and are only thinned.
 *
 * Lengths of 0 follow the part's diameter: the field data `Diameter` of the model, or else of the input.
 *
 * Input port 0: vtkPolyData, edge points of a scene, or vtkPartitionedDataSetCollection, edge appearance
 * models (vtkMEAMBoundaryExtraction).
 * Input port 1, optional: any data object with the field data `Diameter` in mm, usually the trained model.
 *
 * Output port 0: of the input's type; the points that stay, in the precision they came with, with `Tangent` (unit; the
 * sign carries no meaning; of a scene in double precision), and `Normals`, `PointId`, `EdgeType` and `EdgeSource` where
 * they were there; in a scene `Weight`, [0, 1]: less of a point that stands only for points at the border of its cube,
 * so that poses change steadily as points move. Field data is passed on.
 */
#ifndef vtkMEAMTangentEstimation_h
#define vtkMEAMTangentEstimation_h

#include "ppfmeamDetectionModule.h"
#include "vtkMEAMPropertyMacros.h"
#include "vtkPassInputTypeAlgorithm.h"

#include <memory>

namespace meam
{
struct TangentEstimationSettings;
}

class PPFMEAMDETECTION_EXPORT vtkMEAMTangentEstimation : public vtkPassInputTypeAlgorithm
{
public:
  static vtkMEAMTangentEstimation* New();
  vtkTypeMacro(vtkMEAMTangentEstimation, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Methods
  {
    Tiles = 0,
    RobustLine = 1,
    LineSegments = 2
  };

  ///@{
  /**
   * Tiles (0, the paper's), RobustLine (1), or LineSegments (2): robust lines of those points alone that lie on line
   * segments, as the feature B2B has it (Choi et al. 2012, the paper's [23]). Default: RobustLine.
   */
  vtkMEAMDeclareSettingMacro(Method, int);
  void SetMethodToTiles() { this->SetMethod(Tiles); }
  void SetMethodToRobustLine() { this->SetMethod(RobustLine); }
  void SetMethodToLineSegments() { this->SetMethod(LineSegments); }
  ///@}

  /**
   * One point is kept for each cube of this side, in mm; 0: 3 % of the part's diameter in a scene, 2 % in a model;
   * negative: all points are kept. Default: 0. The paper: 1.
   */
  vtkMEAMDeclareSettingMacro(LeafSize, double);

  /**
   * RobustLine, LineSegments: radius of the sphere in mm; 0: 6 % of the part's diameter, up to 12 % where a scene's
   * points are noisy or sparse, and no less than the length of a segment. Default: 0.
   */
  vtkMEAMDeclareSettingMacro(Radius, double);

  /**
   * RobustLine, LineSegments: points this near to the line are on it, in mm; 0: 1.2 % of the part's diameter, up to 3 %
   * where a scene's points are noisy. Default: 0.
   */
  vtkMEAMDeclareSettingMacro(InlierDistance, double);

  /**
   * LineSegments: a run of points on a line that is shorter, in mm, is no segment; 0: 15 % of the part's diameter.
   * Default: 0.
   */
  vtkMEAMDeclareSettingMacro(SegmentLength, double);

  /** Tiles: height and width of a tile in pixels of the projection plane. Default: 10. */
  vtkMEAMDeclareSettingMacro(TilePixels, int);

  /** Tiles: size of a pixel of the projection plane in mm; the paper does not say. Default: 0.5. */
  vtkMEAMDeclareSettingMacro(PixelSize, double);

  /** Tiles: points this near to the line support it, in mm (D_thresh). Default: 0.3. */
  vtkMEAMDeclareSettingMacro(LineDistance, double);

  /** Tiles: share of a tile's points that has to support a line, in [0, 1] (S_thresh). Default: 0.18. */
  vtkMEAMDeclareSettingMacro(LineSupport, double);

  /**
   * Tiles: the way the sensor looks at the scene; tiles are cut on the plane across it. Each appearance
   * model uses its own direction instead. Default: 0, 0, -1 (from above).
   */
  vtkMEAMVectorMemberMacro(ViewDirection, double, 3);

  /** Threads to work with; 0: one for each processor. The tangents do not depend on it. Default: 0. */
  vtkMEAMDeclareSettingMacro(NumberOfThreads, int);

  /** The parameters of the paper, Section 6. The view direction and the number of threads stay. */
  void SetParametersToPaper();
  /** The parameters that measure better: the defaults. The view direction and the number of threads stay. */
  void SetParametersToRecommended();

protected:
  vtkMEAMTangentEstimation();
  ~vtkMEAMTangentEstimation() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  void SetParameters(const meam::TangentEstimationSettings& settings);

  std::unique_ptr<meam::TangentEstimationSettings> Settings;
  double ViewDirection[3] = { 0.0, 0.0, -1.0 };
};

#endif
