// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class vtkSMProxy;

/// Types of part are called by the files that ParaView's readers read. Called when ParaView loads the plugin.
void addMEAMTypeNames();

/// The legend of a representation that is colored by types of part lists those of its MEAM Pose Estimation, unless the
/// user has changed it. An estimation of other types than those that the session's color map names gets one of its own.
void nameTypes(vtkSMProxy* representation);
