// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkDataLabelRepresentation.h"

/// Labels of poses and of picks, of which none covers another, with all properties of ParaView's own labels.
class vtkMEAMPoseLabelRepresentation : public vtkDataLabelRepresentation
{
public:
  static vtkMEAMPoseLabelRepresentation* New();
  vtkTypeMacro(vtkMEAMPoseLabelRepresentation, vtkDataLabelRepresentation);

protected:
  vtkMEAMPoseLabelRepresentation();
};

/// Makes the representation known to ParaView's client or server. Called when it loads the plugin.
void addMEAMPoseLabels();
