// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMBinSceneSource
 * @brief A simulated bin: copies of a part as they fell, seen by a virtual sensor, and the truth.
 *
 * Copies of the part are dropped into a square bin one after the other; a sensor straight above returns
 * an organized cloud with a registered grey image, with noise and pixels without depth.
 *
 * Input port 0 (optional): the part, a vtkPolyData with faces in mm. Default: vtkMEAMSamplePartSource.
 *
 * Output port 0: the scan, a vtkStructuredGrid of W x H x 1 points (mm, sensor's frame: x right, y down,
 * z the way it looks); points without depth are NaN and blanked. Point arrays: `Intensity` (unsigned
 * char) and `Instance` (int; index of the true pose, -1: the bin). Field data: `FocalLength` (pixels),
 * `BinSize` (mm).
 * Output port 1: the true poses, a vtkPolyData with the arrays of every pose; `VisibleFraction` is the
 * share of the pixels that nothing hides; `Score` and `Votes` are without meaning. Field data `Diameter`.
 * Output port 2: the mesh that lies in the bin, a vtkPolyData.
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
  /** mm: standard deviation of the depth. Default: 0.1. */
  vtkSetClampMacro(DepthNoise, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(DepthNoise, double);
  ///@}

  ///@{
  /** Share of the pixels without depth, in [0, 1], besides those seen too flatly. Default: 0.002. */
  vtkSetClampMacro(Dropout, double, 0.0, 1.0);
  vtkGetMacro(Dropout, double);
  ///@}

  ///@{
  /** Grey values: standard deviation of the image. Default: 1.5. */
  vtkSetClampMacro(ImageNoise, double, 0.0, 255.0);
  vtkGetMacro(ImageNoise, double);
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
  double DepthNoise = 0.1;
  double Dropout = 0.002;
  double ImageNoise = 1.5;
};

#endif
