// SPDX-License-Identifier: BSD-3-Clause
/**
 * Meshes between VTK's data objects and the core. Not wrapped.
 */
#ifndef vtkMEAMMeshConversion_h
#define vtkMEAMMeshConversion_h

#include "mesh/TriangleMesh.h"

class vtkPolyData;

namespace vtkMEAMConversion
{
/// Polygons and strips become triangles. Coordinates as they are.
meam::TriangleMesh toMesh(vtkPolyData* input);
void fromMesh(const meam::TriangleMesh& mesh, vtkPolyData* output);
}

#endif
