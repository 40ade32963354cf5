// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMSceneEdgeExtraction
 * @brief Finds the edges of a scene in its image and takes them to 3D (paper, Section 5.1).
 *
 * Canny's edge detector runs on the image that is registered with the organized cloud; every edge pixel
 * becomes the scene point there. At a depth jump the edge belongs to the surface that is nearer to the
 * sensor, and a pixel without depth takes its neighbour's.
 *
 * Input port 0: the scene, a vtkStructuredGrid of W x H x 1 points in the sensor's frame (mm); points
 * without depth are blanked or NaN. Without the second input it needs the point array `Intensity` (1) or
 * `RGB` (3).
 * Input port 1 (optional): the image, a vtkImageData of the same W x H with 1, 3 or 4 components.
 *
 * Output port 0: the edge points, a vtkPolyData with a vertex each and the point array `PointId`: the
 * index of the point in the grid.
 * Output port 1: a vtkImageData of W x H with the point array `Edges` (unsigned char): 255 where an edge
 * point came from, otherwise 0.
 */
#ifndef vtkMEAMSceneEdgeExtraction_h
#define vtkMEAMSceneEdgeExtraction_h

#include "ppfmeamFiltersModule.h"
#include "vtkPolyDataAlgorithm.h"

class PPFMEAMFILTERS_EXPORT vtkMEAMSceneEdgeExtraction : public vtkPolyDataAlgorithm
{
public:
  static vtkMEAMSceneEdgeExtraction* New();
  vtkTypeMacro(vtkMEAMSceneEdgeExtraction, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The image, when the cloud does not carry it. */
  void SetImageConnection(vtkAlgorithmOutput* image) { this->SetInputConnection(1, image); }

  ///@{
  /** Pixels: sigma of the Gaussian before Canny; 0 for none. Default: 1. */
  vtkSetClampMacro(Smoothing, double, 0.0, 50.0);
  vtkGetMacro(Smoothing, double);
  ///@}

  ///@{
  /** Grey values (Sobel): where an edge ends; 0 for 40 % of the high threshold. Default: 0. */
  vtkSetClampMacro(LowThreshold, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(LowThreshold, double);
  ///@}

  ///@{
  /** Grey values (Sobel): where an edge begins; 0 finds it from the image's gradients. Default: 0. */
  vtkSetClampMacro(HighThreshold, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(HighThreshold, double);
  ///@}

  ///@{
  /** Pixels around an edge pixel in which its depth is looked for. Default: 1. */
  vtkSetClampMacro(SearchRadius, int, 0, 50);
  vtkGetMacro(SearchRadius, int);
  ///@}

  ///@{
  /**
   * mm: neighbours that differ by more in depth are of two surfaces; 0 for three times the distance of
   * neighbouring points. Default: 0.
   */
  vtkSetClampMacro(DepthJump, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(DepthJump, double);
  ///@}

protected:
  vtkMEAMSceneEdgeExtraction();
  ~vtkMEAMSceneEdgeExtraction() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkMEAMSceneEdgeExtraction(const vtkMEAMSceneEdgeExtraction&) = delete;
  void operator=(const vtkMEAMSceneEdgeExtraction&) = delete;

  double Smoothing = 1.0;
  double LowThreshold = 0.0;
  double HighThreshold = 0.0;
  int SearchRadius = 1;
  double DepthJump = 0.0;
};

#endif
