// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMSceneEdgeExtraction
 * @brief Finds the edges of a scene in its image and takes them to 3D (paper, Section 5.1).
 *
 * Canny's edge detector runs on the image; every edge pixel becomes the scene point there. At a depth jump
 * the edge belongs to the surface that is nearer to the camera, and a pixel without depth takes its
 * neighbour's. The image is registered with the organized cloud, or comes from a camera beside the sensor
 * whose calibration is known: then the cloud tells what that camera sees, and what is hidden from it gets no
 * edge. The cloud's own depth jumps and creases are added: smooth parts have few in the image.
 *
 * Input port 0: the scene, a vtkStructuredGrid of W x H x 1 points in the sensor's frame (mm); points
 * without depth are blanked or NaN. Without the second input it needs the point array `Intensity` (1) or
 * `RGB` (3).
 * Input port 1 (optional): the image, a vtkImageData with 1, 3 or 4 components: of the same W x H, or of any
 * size with a camera, which is read from CameraFile or else from the image's field data `CameraMatrix` (9,
 * row-major, pixels) and `CameraPose` (16, row-major; takes points of the scan to the camera's frame, mm).
 *
 * Output port 0: the edge points, a vtkPolyData with a vertex each and the point arrays `PointId`, the
 * index of the point in the grid, `EdgeSource` (unsigned char: 0 image, 1 depth jump, 2 crease) and, with
 * ImageTangents, `Tangent` (unit), which vtkMEAMTangentEstimation keeps. Field data, from the scan itself:
 * `ScanReport`, in a sentence how well the sensor measured, and `ScanQuality`, a tuple of `PointDistance` (mm),
 * `Noise` (mm, standard deviation), `Smoothing` (points over which noise is alike), `DepthStep` (mm, 0: none seen),
 * `JumpGap` (points without depth at a depth jump), `Flying` (share of the jumps with a point that hangs between their
 * sides) and `Coverage` (share of the points with depth).
 * Output port 1: a vtkImageData of W x H with the point array `Edges` (unsigned char): 255 where an edge
 * point came from, otherwise 0.
 */
#ifndef vtkMEAMSceneEdgeExtraction_h
#define vtkMEAMSceneEdgeExtraction_h

#include "ppfmeamDetectionModule.h"
#include "vtkMEAMPropertyMacros.h"
#include "vtkPolyDataAlgorithm.h"

#include <memory>

namespace meam
{
struct SceneEdgeExtractionSettings;
}

class PPFMEAMDETECTION_EXPORT vtkMEAMSceneEdgeExtraction : public vtkPolyDataAlgorithm
{
public:
  static vtkMEAMSceneEdgeExtraction* New();
  vtkTypeMacro(vtkMEAMSceneEdgeExtraction, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The image, when the cloud does not carry it. */
  void SetImageConnection(vtkAlgorithmOutput* image) { this->SetInputConnection(1, image); }

  /** Edges of the image. Default: true. */
  vtkMEAMDeclareFlagMacro(ImageEdges);

  /** Points at which the surface ends in front of another one, from the cloud alone. Default: true. */
  vtkMEAMDeclareFlagMacro(DepthEdges);

  /** Points at which two pieces of the surface meet at an angle, from the cloud alone. Default: true. */
  vtkMEAMDeclareFlagMacro(Creases);

  /** Degrees: pieces of the surface that meet at less make no crease. Default: 30. */
  vtkMEAMDeclareSettingMacro(CreaseAngle, double);

  /**
   * Tangents from the direction of the edge in the image and the local surface, in place of those that
   * vtkMEAMTangentEstimation finds among the points. Default: true.
   */
  vtkMEAMDeclareFlagMacro(ImageTangents);

  /**
   * The calibration of a camera beside the sensor that took the image, a file as meam::readCamera() knows it:
   * OpenCV's YAML, XML or JSON, or a BOP camera.json. None: the image's field data, or else the image is
   * registered with the scene. Default: none.
   */
  vtkMEAMFileMemberMacro(CameraFile);

  /** Pixels: sigma of the Gaussian before Canny; 0 for none. Default: 1. */
  vtkMEAMDeclareSettingMacro(Smoothing, double);

  /** Grey values (Sobel): where an edge ends; 0 for 40 % of the high threshold. Default: 0. */
  vtkMEAMDeclareSettingMacro(LowThreshold, double);

  /** Grey values (Sobel): where an edge begins; 0 finds it from the image's gradients. Default: 0. */
  vtkMEAMDeclareSettingMacro(HighThreshold, double);

  /** Grid steps around an edge pixel in which its depth is looked for. Default: 1. */
  vtkMEAMDeclareSettingMacro(SearchRadius, int);

  /**
   * mm: neighbours that differ by more in depth are of two surfaces; 0 for three times the distance of
   * neighbouring points and five times the noise. Default: 0.
   */
  vtkMEAMDeclareSettingMacro(DepthJump, double);

  /** Threads to work with; 0: one for each processor. The result does not depend on it. Default: 0. */
  vtkMEAMDeclareSettingMacro(NumberOfThreads, int);

  /** The paper's: edges of the image alone, without tangents. CameraFile and the number of threads stay. */
  void SetParametersToPaper();
  /** The parameters that measure better: the defaults. CameraFile and the number of threads stay. */
  void SetParametersToRecommended();

protected:
  vtkMEAMSceneEdgeExtraction();
  ~vtkMEAMSceneEdgeExtraction() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  void SetParameters(const meam::SceneEdgeExtractionSettings& settings);

  std::unique_ptr<meam::SceneEdgeExtractionSettings> Settings;
  char* CameraFile = nullptr;
};

#endif
