// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMBinSceneSource
 * @brief A simulated bin: copies of a part as they fell, seen by a virtual sensor, and the truth.
 *
 * Copies of the part are dropped into a square bin one after the other and come to rest (rigid bodies with
 * friction); a sensor straight above measures the depth, a camera takes the image. Noise, steps and missing
 * points are those of a stereo sensor of moderate quality by default.
 *
 * Input port 0 (optional): the part, a vtkPolyData with faces in mm. Default: vtkMEAMSamplePartSource.
 *
 * Output port 0: the scan, a vtkStructuredGrid of W x H x 1 points (mm, sensor's frame: x right, y down,
 * z the way it looks); points without depth are NaN and blanked. Point arrays: `Intensity` (unsigned
 * char) or `RGB` (3) when no camera beside the sensor takes the image, and `Instance` (int; index of the true
 * pose, -1: the bin). Field data: `CameraMatrix` (9, row-major; pixels), `CameraPose` (16, row-major; takes
 * points of the scan to the camera's frame, here the identity), `BinSize` (mm).
 * Output port 1: the true poses, a vtkPolyData with the arrays of every pose; `VisibleFraction` is the
 * share of the pixels that nothing hides; `Score` and `Votes` are without meaning. Point arrays: `Pixels` (int;
 * that the copy would have if nothing else were there), `VisiblePixels` (int), `Box` (4 int: column and row of
 * its first pixel, width, height). Field data: `Diameter`; `Silhouettes` (unsigned char): the pixels of every
 * Box, row by row, one copy after the other, 255 where the copy would be.
 * Output port 2: the mesh that lies in the bin, a vtkPolyData.
 * Output port 3: the image, a vtkImageData of W x H; field data `CameraMatrix` and `CameraPose`.
 */
#ifndef vtkMEAMBinSceneSource_h
#define vtkMEAMBinSceneSource_h

#include "ppfmeamFiltersModule.h"
#include "vtkStructuredGridAlgorithm.h"

class PPFMEAMFILTERS_EXPORT vtkMEAMBinSceneSource : public vtkStructuredGridAlgorithm
{
public:
  static vtkMEAMBinSceneSource* New();
  vtkTypeMacro(vtkMEAMBinSceneSource, vtkStructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Copies of the part in the bin. Default: 20. */
  vtkSetClampMacro(Copies, int, 1, 10000);
  vtkGetMacro(Copies, int);
  ///@}

  ///@{
  /** The same seed gives the same scene. Default: 1. */
  vtkSetClampMacro(Seed, int, 0, VTK_INT_MAX);
  vtkGetMacro(Seed, int);
  ///@}

  ///@{
  /** mm: inner side of the bin; 0 follows the part and the copies. Default: 0. */
  vtkSetClampMacro(BinSize, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(BinSize, double);
  ///@}

  ///@{
  /** mm: sensor above the floor; 0 for three times the bin's side. Default: 0. */
  vtkSetClampMacro(SensorHeight, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(SensorHeight, double);
  ///@}

  ///@{
  /** Pixels of the sensor across. Default: 960. */
  vtkSetClampMacro(Width, int, 16, 8192);
  vtkGetMacro(Width, int);
  ///@}

  ///@{
  /** Pixels of the sensor down. Default: 768. */
  vtkSetClampMacro(Height, int, 16, 8192);
  vtkGetMacro(Height, int);
  ///@}

  ///@{
  /** The image has red, green and blue, or grey alone. Default: false. */
  vtkSetMacro(Colored, bool);
  vtkGetMacro(Colored, bool);
  vtkBooleanMacro(Colored, bool);
  ///@}

  ///@{
  /** mm: from the sensor to a camera beside it that takes the image; 0: the image is the sensor's. Default: 0. */
  vtkSetClampMacro(Baseline, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Baseline, double);
  ///@}

  ///@{
  /** mm: standard deviation of the depth at a distance of 1 m; it grows with the distance's square. Default: 0.3. */
  vtkSetClampMacro(DepthNoise, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(DepthNoise, double);
  ///@}

  ///@{
  /** mm: between depths that the sensor can tell apart; 0 for none. Default: 0.05. */
  vtkSetClampMacro(DepthStep, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(DepthStep, double);
  ///@}

  ///@{
  /** Share of the pixels without depth, in [0, 1], wherever they look. Default: 0.002. */
  vtkSetClampMacro(Dropout, double, 0.0, 1.0);
  vtkGetMacro(Dropout, double);
  ///@}

  ///@{
  /** Share of the pixels beside a depth jump that have no depth, in [0, 1]. Default: 0.5. */
  vtkSetClampMacro(JumpDropout, double, 0.0, 1.0);
  vtkGetMacro(JumpDropout, double);
  ///@}

  ///@{
  /** Pixels: a surface that fills less than half of so large a square, such as a ridge, has no depth; 1 for any.
   * Default: 17. */
  vtkSetClampMacro(MatchingWindow, int, 1, 101);
  vtkGetMacro(MatchingWindow, int);
  ///@}

  ///@{
  /** Grey values: standard deviation of the image. Default: 1.5. */
  vtkSetClampMacro(ImageNoise, double, 0.0, 255.0);
  vtkGetMacro(ImageNoise, double);
  ///@}

  ///@{
  /** Pixels: sigma of the image's blur; 0 for none. Default: 0.7. */
  vtkSetClampMacro(ImageBlur, double, 0.0, 50.0);
  vtkGetMacro(ImageBlur, double);
  ///@}

protected:
  vtkMEAMBinSceneSource();
  ~vtkMEAMBinSceneSource() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkMEAMBinSceneSource(const vtkMEAMBinSceneSource&) = delete;
  void operator=(const vtkMEAMBinSceneSource&) = delete;

  int Copies = 20;
  int Seed = 1;
  double BinSize = 0.0;
  double SensorHeight = 0.0;
  int Width = 960;
  int Height = 768;
  bool Colored = false;
  double Baseline = 0.0;
  double DepthNoise = 0.3;
  double DepthStep = 0.05;
  double Dropout = 0.002;
  double JumpDropout = 0.5;
  int MatchingWindow = 17;
  double ImageNoise = 1.5;
  double ImageBlur = 0.7;
};

#endif
