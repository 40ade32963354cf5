// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMHashing
 * @brief Trains the model of a part: the pairs of its edge and surface points, sorted by their feature.
 *
 * Sections 3 and 4 of the paper. Every ordered pair of edge points that can be seen together is described by
 * B2B-TL (the distance, and the angles of the two tangent lines to it and to each other), the feature is cut
 * into steps, and the pair is stored once under the resulting key. Pairs of surface points with normals (Drost et al.,
 * the paper's [12]) have a table of their own. The result can be saved and loaded with
 * VTK's own XML writer and reader for partitioned dataset collections; use the data mode `Binary`.
 *
 * Input port 0: vtkPartitionedDataSetCollection of edge appearance models with `Tangent`
 * (vtkMEAMTangentEstimation); `PointId` where it is there says which surface sample a point is. The part's
 * diameter is the field data `Diameter`; without it that of the points is taken.
 * Input port 1, optional: vtkPolyData, the samples of the whole surface with `Normals`
 * (vtkMEAMSurfaceSampling). They say which points are seen together, and poses are verified and refined with
 * them. Without them only edges count.
 *
 * Output port 0: vtkPartitionedDataSetCollection, the trained model:
 * - `View 0`, `View 1`, ...: the edge points of each appearance model with `Tangent`; field data
 *   `ViewDirection`, `ViewIndex`.
 * - `Edges`: the edge points of the table with `Tangent`, `ViewBits` (bit v: on the edge seen in view v) and
 *   `VisibleBits` (bit c: visible from co-visibility direction c).
 * - `Surface`: thinned surface samples with `Normals`, where the surface is given.
 * - `PairTableBuckets`: a row of values `Offset`: the entries of key k are [Offset[k], Offset[k + 1]).
 * - `PairTableEntries`: a row of values `Reference`, `Referred` (points of `Edges`), `Angle` (radians, of the
 *   referred point about the reference's tangent) and `ViewBits`.
 * - `SurfacePairPoints` with `Normals`, `SurfacePairTableBuckets`, `SurfacePairTableEntries`: the same of surface
 * points.
 * - Field data: `FormatVersion`, `Units`, `Digest` (of the surface, the edges and the parameters), `Diameter`,
 *   `ViewDirections`, the parameters by their names, and `NumberOfViews`, `NumberOfEdgePoints`,
 *   `NumberOfSurfacePoints`, `NumberOfPairs`, `NumberOfSurfacePairPoints`, `NumberOfSurfacePairs`.
 */
#ifndef vtkMEAMHashing_h
#define vtkMEAMHashing_h

#include "ppfmeamTrainingModule.h"
#include "vtkMEAMPropertyMacros.h"
#include "vtkPartitionedDataSetCollectionAlgorithm.h"

#include <memory>

namespace meam
{
struct MEAMHashingSettings;
}

class PPFMEAMTRAINING_EXPORT vtkMEAMHashing : public vtkPartitionedDataSetCollectionAlgorithm
{
public:
  static vtkMEAMHashing* New();
  vtkTypeMacro(vtkMEAMHashing, vtkPartitionedDataSetCollectionAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum FeatureChoices
  {
    Edges = 0,
    Surface = 1,
    Both = 2
  };

  enum EdgeFeatures
  {
    Paper = 0,
    Oriented = 1
  };

  enum ViewMergings
  {
    Points = 0,
    VoxelCodes = 1,
    None = 2
  };

  ///@{
  /**
   * Which points make pairs. Edges (0): edge points with tangents, which carry flat, thin and ribbed parts. Surface
   * (1): surface points with normals, which carry smooth, round and thick ones; needs the samples of the surface. Both
   * (2). Default: Both.
   */
  vtkMEAMDeclareSettingMacro(Features, int);
  void SetFeaturesToEdges() { this->SetFeatures(Edges); }
  void SetFeaturesToSurface() { this->SetFeatures(Surface); }
  void SetFeaturesToBoth() { this->SetFeatures(Both); }
  ///@}

  /** Of surface points: step of distances as a share of the part's diameter, in (0, 1]. Default: 0.05. */
  vtkMEAMDeclareSettingMacro(SurfaceDistanceStep, double);

  /** Of surface points: step of angles in degrees, 1 to 90; also of the votes' turn about the normal. Default: 12. */
  vtkMEAMDeclareSettingMacro(SurfaceAngleStep, double);

  /**
   * Of the surface points in a cube of this side, a share of the part's diameter, one makes pairs and votes, in the
   * model as in a scene. Default: 0.05.
   */
  vtkMEAMDeclareSettingMacro(SurfaceLeafSize, double);

  ///@{
  /**
   * Of edge points. Paper (0): the distance and three acute angles, Equation (1). Oriented (1): both tangents are
   * turned along the pair, so the third angle is full and mirror images differ: fewer wrong votes. Default: Oriented.
   */
  vtkMEAMDeclareSettingMacro(Feature, int);
  void SetFeatureToPaper() { this->SetFeature(Paper); }
  void SetFeatureToOriented() { this->SetFeature(Oriented); }
  ///@}

  /** Step of distances as a share of the part's diameter, in (0, 1]. Default: 0.07. */
  vtkMEAMDeclareSettingMacro(DistanceStep, double);

  /** Step of angles in degrees, 1 to 90; also of the votes' turn about the tangent. Default: 7.2. The paper: 3.6. */
  vtkMEAMDeclareSettingMacro(AngleStep, double);

  ///@{
  /**
   * How the views come into one table. Points (0): edge points that several views share become one. VoxelCodes
   * (1): each view keeps its own, and a pair that several views show is stored once, by voxel code, Equation (2)
   * of the paper. None (2): all pairs of each view are stored, as many tables as views. Default: Points.
   */
  vtkMEAMDeclareSettingMacro(ViewMerging, int);
  void SetViewMergingToPoints() { this->SetViewMerging(Points); }
  void SetViewMergingToVoxelCodes() { this->SetViewMerging(VoxelCodes); }
  void SetViewMergingToNone() { this->SetViewMerging(None); }
  ///@}

  /** Points of two views nearer than this are the same, in mm; 0: 1.5 % of the part's diameter. Default: 0. */
  vtkMEAMDeclareSettingMacro(VoxelSize, double);

  /**
   * With ViewMerging Points, of the edge points in a cube of this side, in mm, one makes pairs and votes, in the model
   * as in a scene; all of them judge and refine poses. 0: 4 % of the part's diameter. Otherwise every edge point makes
   * pairs. Default: 0.
   */
  vtkMEAMDeclareSettingMacro(LeafSize, double);

  /**
   * Number of directions, up to 32, from which two points have to be visible together to make a pair;
   * 0: only the views themselves, as in the paper. Default: 26.
   */
  vtkMEAMDeclareSettingMacro(CoVisibilityDirections, int);

  /** The parameters of the paper, Section 6. */
  void SetParametersToPaper();
  /** The parameters that measure better: the defaults. */
  void SetParametersToRecommended();

protected:
  vtkMEAMHashing();
  ~vtkMEAMHashing() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  struct SharedData;
  std::unique_ptr<SharedData> Shared; ///< what other filters find as long as this one holds it

  std::unique_ptr<meam::MEAMHashingSettings> Settings;
};

#endif
