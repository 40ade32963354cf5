// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMBinSceneSource
 * @brief A simulated bin: copies of a part as they fell, seen by a virtual sensor, and the truth.
 *
 * Copies of the part are dropped into a bin one after the other and come to rest (rigid bodies with
 * friction); a sensor straight above measures the depth, a camera takes the image. `Sensor` is its kind, with the
 * pixels, noise, steps and missing points of such sensors; each of these can be chosen on its own, too.
 *
 * Input port 0 (optional): the part, a vtkPolyData with faces in mm. Default: vtkMEAMSamplePartSource.
 * Input port 1 (optional): poses in the sensor's frame (mm), as output port 1 has them: copies stand there and,
 * unless Settle is on, nothing falls; Copies does not count.
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
 * Box, row by row, one copy after the other, 255 where the copy would be; `Bin` (20: its frame, row-major, inner
 * length, inner width, height, wall; mm).
 *
 * Output port 2: the mesh that lies in the bin, a vtkPolyData.
 *
 * Output port 3: the image, a vtkImageData of W x H; field data `CameraMatrix` and `CameraPose`.
 */
#ifndef vtkMEAMBinSceneSource_h
#define vtkMEAMBinSceneSource_h

#include "ppfmeamTrainingModule.h"
#include "vtkMEAMPropertyMacros.h"
#include "vtkStructuredGridAlgorithm.h"

#include <memory>

namespace meam
{
struct BinSceneSettings;
}

class PPFMEAMTRAINING_EXPORT vtkMEAMBinSceneSource : public vtkStructuredGridAlgorithm
{
public:
  static vtkMEAMBinSceneSource* New();
  vtkTypeMacro(vtkMEAMBinSceneSource, vtkStructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Copies of the part in the bin. Default: 20. */
  vtkMEAMDeclareSettingMacro(Copies, int);

  /** Copies at the poses of input port 1 are let go and come to rest. Default: false. */
  vtkMEAMDeclareFlagMacro(Settle);

  /** The same seed gives the same scene. Default: 1. */
  vtkMEAMDeclareSettingMacro(Seed, int);

  /** mm: inner side of the bin; 0 follows the part and the copies. Default: 0. */
  vtkMEAMDeclareSettingMacro(BinSize, double);

  /** mm: other inner side of the bin, along y; 0: the bin is a square. Default: 0. */
  vtkMEAMDeclareSettingMacro(BinWidth, double);

  /** mm: height of the bin's walls; 0 for 0.6 diameters of the part. Default: 0. */
  vtkMEAMDeclareSettingMacro(WallHeight, double);

  /** mm: sensor above the floor; 0 for three times the bin's longer side. Default: 0. */
  vtkMEAMDeclareSettingMacro(SensorHeight, double);

  enum Sensors
  {
    StructuredLight,
    ActiveStereo,
    TimeOfFlight
  };

  ///@{
  /**
   * What kind of sensor measures the depth: structured light (sharp edges, little noise), active stereo (steps of
   * disparity, rounded edges, shadows on one side of each jump) or time of flight (noise, flying pixels, few pixels).
   * It decides all properties below that are negative. Default: StructuredLight.
   */
  vtkMEAMClampedMemberMacro(Sensor, int, StructuredLight, TimeOfFlight);
  void SetSensorToStructuredLight() { this->SetSensor(StructuredLight); }
  void SetSensorToActiveStereo() { this->SetSensor(ActiveStereo); }
  void SetSensorToTimeOfFlight() { this->SetSensor(TimeOfFlight); }
  ///@}

  /** Pixels of the sensor across, 16 to 8192; -1: the sensor's 960, 1280 or 640. Default: -1. */
  vtkMEAMClampedMemberMacro(Width, int, -1, 8192);

  /** Pixels of the sensor down, 16 to 8192; -1: the sensor's 768, 720 or 480. Default: -1. */
  vtkMEAMClampedMemberMacro(Height, int, -1, 8192);

  /** The image has red, green and blue, or grey alone. Default: false. */
  vtkMEAMDeclareFlagMacro(Colored);

  /** mm: from the sensor to a camera beside it that takes the image; 0: the image is the sensor's. Default: 0. */
  vtkMEAMDeclareSettingMacro(Baseline, double);

  /**
   * mm: standard deviation of the depth at a distance of 1 m; it grows with the distance's square. -1: the sensor's,
   * 0.3 of structured light, 0 of the others. Default: -1.
   */
  vtkMEAMClampedMemberMacro(DepthNoise, double, -1.0, VTK_DOUBLE_MAX);

  /**
   * mm: between depths that the sensor can tell apart; 0 for none. -1: the sensor's, 0.05 of structured light, 0 of
   * the others. Default: -1.
   */
  vtkMEAMClampedMemberMacro(DepthStep, double, -1.0, VTK_DOUBLE_MAX);

  /**
   * Share of the pixels without depth, in [0, 1], wherever they look. -1: the sensor's, 0.002, of active stereo 0.005.
   * Default: -1.
   */
  vtkMEAMClampedMemberMacro(Dropout, double, -1.0, 1.0);

  /**
   * Share of the pixels beside a depth jump that have no depth, in [0, 1]. -1: the sensor's, 0.5, of active stereo 0.
   * Default: -1.
   */
  vtkMEAMClampedMemberMacro(JumpDropout, double, -1.0, 1.0);

  /**
   * Pixels: a surface that fills less than half of so large a square, such as a ridge, has no depth; 1 for any. -1: the
   * sensor's 17, 7 or 1. Default: -1.
   */
  vtkMEAMClampedMemberMacro(MatchingWindow, int, -1, 101);

  /**
   * Degrees: surfaces that face the sensor to within this angle mirror its light and have no depth. -1: the sensor's, 2
   * of active stereo, 0 of the others. Default: -1.
   */
  vtkMEAMClampedMemberMacro(GlareAngle, double, -1.0, 90.0);

  /**
   * Pixels, odd: the noise of the depth is alike within so large a square; 1: each pixel has its own. -1: the sensor's,
   * 5 of active stereo, 1 of the others. Default: -1.
   */
  vtkMEAMClampedMemberMacro(NoiseWindow, int, -1, 101);

  /**
   * mm: from the sensor to its second eye, on the right, which does not see what is left of a jump; 0 for no stereo:
   * the next three have no effect. -1: the sensor's, 55 of active stereo, 0 of the others. Default: -1.
   */
  vtkMEAMClampedMemberMacro(StereoBaseline, double, -1.0, VTK_DOUBLE_MAX);

  /**
   * Pixels: standard deviation of the disparity. -1: the sensor's, 0.08 of active stereo, 0 of the others. Default: -1.
   */
  vtkMEAMClampedMemberMacro(DisparityNoise, double, -1.0, VTK_DOUBLE_MAX);

  /**
   * Pixels: between disparities that the sensor can tell apart, so that steps of the depth grow with the square of the
   * distance; 0 for none. -1: the sensor's, 1/32 of active stereo, 0 of the others. Default: -1.
   */
  vtkMEAMClampedMemberMacro(DisparityStep, double, -1.0, VTK_DOUBLE_MAX);

  /**
   * Pixels, odd: a disparity is the mean over so large a square, which rounds edges; 1 for its own. -1: the sensor's, 5
   * of active stereo, 1 of the others. Default: -1.
   */
  vtkMEAMClampedMemberMacro(SmoothingWindow, int, -1, 101);

  /**
   * mm: standard deviation along the line of sight at a distance of 1 m; it grows with the distance and where a surface
   * returns less light. -1: the sensor's, 1 of time of flight, 0 of the others. Default: -1.
   */
  vtkMEAMClampedMemberMacro(RangeNoise, double, -1.0, VTK_DOUBLE_MAX);

  /**
   * Pixels: sigma within which light of neighbors mixes into the range, so that pixels at jumps lie between both
   * surfaces; 0 for none. -1: the sensor's, 0.7 of time of flight, 0 of the others. Default: -1.
   */
  vtkMEAMClampedMemberMacro(PixelBlur, double, -1.0, 50.0);

  /**
   * Share of its light that a surface throws on, in [0, 1], which makes concave corners seem deeper. -1: the sensor's,
   * 0.2 of time of flight, 0 of the others. Default: -1.
   */
  vtkMEAMClampedMemberMacro(Multipath, double, -1.0, 1.0);

  /**
   * Gray values: standard deviation of the image. -1: the sensor's 1.5. Default: -1.
   */
  vtkMEAMClampedMemberMacro(ImageNoise, double, -1.0, 255.0);

  /**
   * Pixels: sigma of the image's blur; 0 for none. -1: the sensor's 0.7. Default: -1.
   */
  vtkMEAMClampedMemberMacro(ImageBlur, double, -1.0, 50.0);

protected:
  vtkMEAMBinSceneSource();
  ~vtkMEAMBinSceneSource() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  std::unique_ptr<meam::BinSceneSettings> Settings;
  int Sensor = StructuredLight;
  int Width = -1;
  int Height = -1;
  double DepthNoise = -1.0;
  double DepthStep = -1.0;
  double Dropout = -1.0;
  double JumpDropout = -1.0;
  int MatchingWindow = -1;
  double GlareAngle = -1.0;
  int NoiseWindow = -1;
  double StereoBaseline = -1.0;
  double DisparityNoise = -1.0;
  double DisparityStep = -1.0;
  int SmoothingWindow = -1;
  double RangeNoise = -1.0;
  double PixelBlur = -1.0;
  double Multipath = -1.0;
  double ImageNoise = -1.0;
  double ImageBlur = -1.0;
};

#endif
