// SPDX-License-Identifier: BSD-3-Clause
/**
 * What sensors measure, between VTK's data objects and the core: organized clouds, images, calibrations. Not wrapped.
 */
#ifndef vtkMEAMScanConversion_h
#define vtkMEAMScanConversion_h

#include "scene/OrganizedCloud.h"

namespace meam
{
struct CameraFile;
struct MeasuredCloud;
}
class vtkImageData;
class vtkPointSet;
class vtkStructuredGrid;

namespace vtkMEAMConversion
{
/// Throws Error for a grid that is not a single layer.
void requireLayer(vtkStructuredGrid* grid);
/// W x H x 1; blanked points become NaN. Throws for a grid that is not a single layer.
meam::OrganizedCloud toOrganizedCloud(vtkStructuredGrid* input, int threads = 1);
/// NaN points are blanked.
void fromOrganizedCloud(const meam::OrganizedCloud& cloud, vtkStructuredGrid* output);
/// The same, or N x 1 points that are not organized.
meam::OrganizedCloud toScanCloud(vtkPointSet* input, int threads = 1);
/// From the point array `Intensity` (1 component) or `RGB` (3) of such a cloud. Empty without.
meam::Image imageOfCloud(vtkPointSet* input);
/// From image scalars of 1, 3 or 4 components; VTK's images start at the lower left, ours at the upper left.
meam::Image toImage(vtkImageData* input);
void fromImage(const meam::Image& image, vtkImageData* output);

/// An organized cloud for a vtkStructuredGrid, otherwise a vertex for each point that has depth; `Normals`, `Intensity`
/// (whole numbers from 0 to 255 are kept, other values are spread so that the largest becomes 255) and `RGB` where
/// they are known.
void fromMeasuredCloud(const meam::MeasuredCloud& measured, vtkPointSet* output);
/// The point array `Intensity` or `RGB` of an organized cloud.
void addRegisteredImage(const meam::Image& image, vtkStructuredGrid* output);
/// The sensor's calibration: that of the file, when one is named, otherwise a pinhole. Throws Error for neither.
meam::CameraFile calibrationOf(const char* file, const double focalLength[2], const double principalPoint[2]);
}

#endif
