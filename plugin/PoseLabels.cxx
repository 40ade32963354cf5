// SPDX-License-Identifier: BSD-3-Clause
#include "PoseLabels.h"

#include "LabelMapper.h"

#include "vtkActor2D.h"
#include "vtkClientServerInterpreter.h"
#include "vtkClientServerInterpreterInitializer.h"
#include "vtkMaskPoints.h"
#include "vtkObjectFactory.h"
#include "vtkTextProperty.h"
#include "vtkTransform.h"

vtkStandardNewMacro(vtkMEAMPoseLabelRepresentation);

vtkMEAMPoseLabelRepresentation::vtkMEAMPoseLabelRepresentation()
{
  this->PointLabelMapper->Delete();
  this->PointLabelMapper = LabelMapper::New();
  this->PointLabelMapper->SetInputConnection(this->PointMask->GetOutputPort());
  this->PointLabelMapper->SetLabelTextProperty(this->PointLabelProperty);
  this->PointLabelMapper->SetTransform(this->Transform);
  this->PointLabelActor->SetMapper(this->PointLabelMapper);
}

namespace
{
constexpr const char* ClassName = "vtkMEAMPoseLabelRepresentation";

vtkObjectBase* newRepresentation(void*) { return vtkMEAMPoseLabelRepresentation::New(); }

/// The class has no method of its own: ParaView's wrapping of the superclass calls them all.
int callSuperclass(vtkClientServerInterpreter* interpreter, vtkObjectBase* representation, const char* method,
  const vtkClientServerStream& message, vtkClientServerStream& result, void*)
{
  return interpreter->CallCommandFunction("vtkDataLabelRepresentation", representation, method, message, result);
}

void addTo(vtkClientServerInterpreter* interpreter)
{
  interpreter->AddNewInstanceFunction(ClassName, newRepresentation);
  interpreter->AddCommandFunction(ClassName, callSuperclass);
}
}

void addMEAMPoseLabels() { vtkClientServerInterpreterInitializer::GetInitializer()->RegisterCallback(addTo); }
