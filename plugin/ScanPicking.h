// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class QMainWindow;

/// Ctrl+P while the panel shows Pose Diagnosis: its point becomes the scan's point under the mouse, wherever the
/// keyboard's focus is. ParaView's own pick renders the scan several times over. Of a scan on a remote server ParaView
/// picks.
void addScanPicking(QMainWindow* window);
