// SPDX-License-Identifier: BSD-3-Clause
#include "PartView.h"

#include "DisplayDefaults.h"
#include "ShownData.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqCoreUtilities.h"
#include "pqObjectBuilder.h"
#include "pqOutputPort.h"
#include "pqPipelineSource.h"
#include "pqPropertiesPanel.h"
#include "pqRenderView.h"
#include "pqServer.h"
#include "pqServerManagerModel.h"
#include "pqUndoStack.h"
#include "vtkNew.h"
#include "vtkPVDataInformation.h"
#include "vtkPVXMLElement.h"
#include "vtkSMInputProperty.h"
#include "vtkSMPVRepresentationProxy.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewLayoutProxy.h"

#include <QMainWindow>

#include <cstring>

namespace
{
constexpr double ShareOfScan = 0.6;                 // of the width
constexpr const char* OfPart = "PPFMEAM.PartFrame"; // annotation of a view beside a scan

/// Outputs that the view shows and that lie in the part's frame.
QList<pqOutputPort*> outputsOfPart(pqPipelineSource* source, pqView* view)
{
  QList<pqOutputPort*> outputs;
  for (pqOutputPort* port : source->getOutputPorts())
  {
    pqDataRepresentation* shown = port->getRepresentation(view);
    if (shown && shown->isVisible() && !port->getDataInformation()->DataSetTypeIsA("vtkTable") && // a text
        !isInScene(port->getDataInformation()) &&
        !comesFromScan(port->getSourceProxy(), port->getPortNumber()))
    {
      outputs.append(port);
    }
  }
  return outputs;
}

/// The view of the part beside that of the scan; null: there is none yet.
pqRenderView* partViewBeside(pqRenderView* scan)
{
  vtkSMViewLayoutProxy* layout = vtkSMViewLayoutProxy::FindLayout(scan->getViewProxy());
  for (auto* view : pqApplicationCore::instance()->getServerManagerModel()->findItems<pqRenderView*>(scan->getServer()))
  {
    if (view->getProxy()->HasAnnotation(OfPart) && vtkSMViewLayoutProxy::FindLayout(view->getViewProxy()) == layout)
    {
      return view;
    }
  }
  return nullptr;
}

pqRenderView* makePartView(pqRenderView* scan)
{
  vtkSMViewLayoutProxy* layout = vtkSMViewLayoutProxy::FindLayout(scan->getViewProxy());
  auto* view = layout ? qobject_cast<pqRenderView*>(
                          pqApplicationCore::instance()->getObjectBuilder()->createView("RenderView", scan->getServer()))
                      : nullptr;
  if (!view)
  {
    return nullptr;
  }
  const int cell = layout->GetViewLocation(scan->getViewProxy());
  layout->SplitHorizontal(cell, ShareOfScan);
  layout->AssignView(vtkSMViewLayoutProxy::GetSecondChild(cell), view->getViewProxy());
  view->getProxy()->SetAnnotation(OfPart, "1");
  const double position[3] = { -1.0, -1.5, 1.0 }, focus[3] = { 0.0, 0.0, 0.0 }, up[3] = { 0.0, 0.0, 1.0 };
  vtkSMPropertyHelper(view->getProxy(), "CameraPosition").Set(position, 3);
  vtkSMPropertyHelper(view->getProxy(), "CameraFocalPoint").Set(focus, 3);
  vtkSMPropertyHelper(view->getProxy(), "CameraViewUp").Set(up, 3);
  view->getProxy()->UpdateVTKObjects();
  return view;
}

/// The part that stays in sight where the source is shown.
void showPart(pqPipelineSource* source, pqRenderView* view)
{
  vtkPVXMLElement* hints = source->getProxy()->GetHints();
  vtkPVXMLElement* visibility = hints ? hints->FindNestedElementByName("Visibility") : nullptr;
  auto* input = vtkSMInputProperty::SafeDownCast(source->getProxy()->GetProperty("Input"));
  auto* part = input && input->GetNumberOfProxies() == 1 ? vtkSMSourceProxy::SafeDownCast(input->GetProxy(0)) : nullptr;
  if (part && visibility && std::strcmp(visibility->GetAttributeOrEmpty("replace_input"), "0") == 0)
  {
    vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
    controller->Show(part, static_cast<int>(input->GetOutputPortForConnection(0)), view->getViewProxy());
  }
}

void showBeside(pqPipelineSource* source)
{
  auto* scan = qobject_cast<pqRenderView*>(pqActiveObjects::instance().activeView());
  if (!source || !scan || !isOurs(source->getSourceProxy()) || !isSeenFromSensor(scan->getViewProxy()))
  {
    return;
  }
  const QList<pqOutputPort*> outputs = outputsOfPart(source, scan);
  if (outputs.empty())
  {
    return;
  }
  BEGIN_UNDO_SET("Show the part beside the scan");
  pqRenderView* known = partViewBeside(scan);
  pqRenderView* view = known ? known : makePartView(scan);
  if (view)
  {
    vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
    showPart(source, view);
    for (pqOutputPort* port : outputs)
    {
      vtkSMProxy* inFront = port->getRepresentation(scan)->getProxy();
      controller->Hide(port->getSourceProxy(), port->getPortNumber(), scan->getViewProxy());
      if (auto* hidden = vtkSMPVRepresentationProxy::SafeDownCast(inFront))
      {
        hidden->HideScalarBarIfNotNeeded(scan->getViewProxy());
      }
      controller->Show(port->getSourceProxy(), port->getPortNumber(), view->getViewProxy());
    }
    if (!known)
    {
      view->resetCamera();
    }
    view->render();
    pqActiveObjects::instance().setActiveView(scan);
  }
  END_UNDO_SET();
}
}

void addPartView()
{
  for (auto* panel : pqCoreUtilities::mainWidget()->findChildren<pqPropertiesPanel*>())
  {
    QObject::connect(panel, QOverload<pqProxy*>::of(&pqPropertiesPanel::applied), panel,
      [](pqProxy* proxy) { showBeside(qobject_cast<pqPipelineSource*>(proxy)); });
  }
}
