// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMCloudReader
 * @brief Base of the readers of clouds, which bring those that are not organized onto the pixels of their camera.
 */
#ifndef vtkMEAMCloudReader_h
#define vtkMEAMCloudReader_h

#include "ppfmeamIOModule.h"
#include "vtkMEAMPropertyMacros.h"
#include "vtkMEAMCameraReader.h"

#include <array>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>

namespace meam
{
struct MeasuredCloud;
}

class PPFMEAMIO_EXPORT vtkMEAMCloudReader : public vtkMEAMCameraReader
{
public:
  vtkTypeMacro(vtkMEAMCloudReader, vtkMEAMCameraReader);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Factor on the coordinates, to bring them to mm: 1000 for a file in metres. Default: 1. */
  vtkMEAMClampedMemberMacro(Scale, double, 1e-9, 1e9);

  /** Pixels of the camera, width and height; 0: those of the CameraFile. Default: 0, 0. */
  vtkMEAMVectorMemberMacro(ImageSize, int, 2);

protected:
  vtkMEAMCloudReader() = default;
  ~vtkMEAMCloudReader() override = default;

  /** The first bytes of a file with one of these extensions; without a value: it has another one, or is not there. */
  static std::optional<std::string> StartOf(const char* fileName, std::initializer_list<const char*> extensions);

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  /** What the file holds. Throws the core's Error. */
  virtual meam::MeasuredCloud Read(const std::function<bool(double)>& progress) = 0;
  /** Width and height of the file's own grid; a height of 1 or less: it has none, or cannot be read. */
  virtual std::array<int, 2> GridSize() = 0;

private:
  /** A camera is given. */
  bool HasCamera() const;

  double Scale = 1.0;
  int ImageSize[2] = { 0, 0 };
};

#endif
