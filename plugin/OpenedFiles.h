// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class QObject;

/// Files of another kind that are opened as STL or OBJ are closed again with a sentence: VTK's reader makes triangles of
/// them all over space, shows nothing, or ends the program. So are texts of points that are opened as PLOT3D grids.
void addOpenedFiles(QObject* window);
