// SPDX-License-Identifier: BSD-3-Clause
/**
 * Clouds of points, of a part or of a scene, between VTK's data objects and the core. Not wrapped.
 */
#ifndef vtkMEAMCloudConversion_h
#define vtkMEAMCloudConversion_h

#include "base/LocalFrame.h"
#include "base/PointCloud.h"

namespace meam
{
struct EdgeTangents;
}
class vtkPointSet;
class vtkPolyData;

namespace vtkMEAMConversion
{
/// Points with the arrays `Normals`, `Tangent` (3 components each), `PointId` and `EdgeType`, where they are there.
meam::PointCloud toCloud(vtkPointSet* input);
/// The same arrays, `Weight` where it is known, and a vertex cell for each point.
void fromCloud(const meam::PointCloud& cloud, vtkPolyData* output);
/// Edge points with the arrays `Tangent`, made unit, and `Weight`, where they are there.
meam::PreciseCloud toPreciseCloud(vtkPointSet* input);
/// Of `input` the points that stay, in the precision they have there, with the arrays of toCloud(), `Tangent` in double
/// precision and `Weight`.
void fromEdgeTangents(const meam::EdgeTangents& edges, vtkPointSet* input, vtkPolyData* output);
}

#endif
