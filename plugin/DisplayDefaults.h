// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class vtkSMProxy;
class vtkSMSourceProxy;

/// How scans and poses look when ParaView shows them first, in the application as in Python: poses in the colours of
/// their ranks, a scan in the grey or the colours of its image, and both seen from where the sensor is. Called when
/// ParaView loads the plugin.
void setMEAMDisplayDefaults();

/// Whether the view has been placed where the sensor is, by a scan that it shows.
bool isSeenFromSensor(vtkSMProxy* view);

/// Hides the parts that a source searches in all views that have been placed there: they lie where the sensor is.
void hideParts(vtkSMSourceProxy* source);
