// SPDX-License-Identifier: BSD-3-Clause
/**
 * Clouds of points, of a part or of a scene, between VTK's data objects and the core. Not wrapped.
 */
#ifndef vtkMEAMCloudConversion_h
#define vtkMEAMCloudConversion_h

#include "base/LocalCloud.h"
#include "base/PointCloud.h"

namespace meam
{
struct ThinnedEdges;
}
class vtkPointSet;
class vtkPolyData;

namespace vtkMEAMConversion
{
/// Points with the arrays `Normals`, `Tangent` (3 components each), `PointId` and `EdgeType`, where they are there.
meam::PointCloud toCloud(vtkPointSet* input);
/// The same arrays, `Weight` where it is known, and a vertex cell for each point.
void fromCloud(const meam::PointCloud& cloud, vtkPolyData* output);
/// Edge points in double precision, with the arrays `Tangent`, made unit, and `Weight`, where they are there, in their
/// local frame: that of the field data `LocalFrame` when it is that of these points, otherwise their principal frame.
/// What has no tangent, or an invalid one, has one that is not finite.
meam::LocalCloud toLocalCloud(vtkPointSet* input, int threads);
/// Of `input` the points that stay, in the precision they have there, with the arrays of toCloud(), `Tangent` in double
/// precision, `Weight` and `EdgeSource`; field data: `LocalFrame` (16, row-major, takes the points to the frame they
/// were thinned in) and `LocalFrameCheck` (9: three points there, which tell whether the points have been moved since).
void fromThinnedEdges(const meam::ThinnedEdges& edges, vtkPointSet* input, vtkPolyData* output);
}

#endif
