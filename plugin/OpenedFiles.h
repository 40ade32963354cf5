// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class QObject;

/// Files of another kind that are opened as STL are closed again with a sentence: VTK's reader makes triangles all over
/// space of them, or ends the program.
void addOpenedFiles(QObject* window);
