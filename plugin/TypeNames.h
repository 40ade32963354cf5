// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class vtkSMSourceProxy;

/// Types of part are called by the files that ParaView's readers read. Called when ParaView loads the plugin.
void addMEAMTypeNames();

/// The legend of types lists those that poses are of.
void nameTypes(vtkSMSourceProxy* poses);
