// SPDX-License-Identifier: BSD-3-Clause
#include "OpenData.h"

#include "ShownData.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqOutputPort.h"
#include "pqPipelineFilter.h"
#include "pqPipelineSource.h"
#include "pqProxySelection.h"
#include "pqServerManagerModel.h"
#include "vtkPVDataInformation.h"
#include "vtkSMCoreUtilities.h"
#include "vtkSMSourceProxy.h"

#include <cstring>

namespace
{
bool isOf(pqPipelineSource* source, const char* className)
{
  const char* name = source->getSourceProxy()->GetVTKClassName();
  return name && std::strcmp(name, className) == 0;
}

bool isGrid(pqOutputPort* port) { return isOrganized(port->getDataInformation()); }

/// Points alone are one where they come from a file.
bool isScan(pqOutputPort* port) { return readsClouds(port->getSourceProxy()) || isGrid(port); }

bool isPart(pqOutputPort* port)
{
  if (isOf(port->getSource(), "vtkMEAMHashing") || isOf(port->getSource(), "vtkMEAMModelReader"))
  {
    return true;
  }
  vtkPVDataInformation* data = port->getDataInformation();
  return data->DataSetTypeIsA("vtkPolyData") && data->GetNumberOfCells() > 0 && !isInScene(data) && !isScan(port) &&
         !comesFromScan(port->getSourceProxy(), port->getPortNumber()) &&
         !isOf(port->getSource(), "vtkMEAMGraspDefinition"); // its jaws
}

bool isPartOrEmpty(pqOutputPort* port) { return isPart(port) || isEmptyPart(port); }

bool isEstimation(pqOutputPort* port)
{
  return port->getPortNumber() == 0 && isOf(port->getSource(), "vtkMEAMPoseEstimation");
}

pqOutputPort* choose(bool (*isKind)(pqOutputPort*))
{
  pqOutputPort* last = nullptr;
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  for (pqPipelineSource* source : model->findItems<pqPipelineSource*>(pqActiveObjects::instance().activeServer()))
  {
    for (pqOutputPort* port : source->getOutputPorts())
    {
      if (isKind(port))
      {
        if (pqActiveObjects::instance().activePort() == port)
        {
          return port;
        }
        last = port;
      }
    }
  }
  return last;
}
}

bool isEmptyPart(pqOutputPort* port)
{
  pqPipelineSource* source = port->getSource();
  vtkSMSourceProxy* proxy = source->getSourceProxy();
  const bool isFile = isOf(source, "vtkMEAMMeshReader") || (!isOurs(proxy) && vtkSMCoreUtilities::GetFileNameProperty(proxy));
  vtkPVDataInformation* data = port->getDataInformation();
  return isFile && data->DataSetTypeIsA("vtkPolyData") && data->GetNumberOfPoints() == 0;
}

QList<pqOutputPort*> openParts()
{
  QList<pqOutputPort*> parts;
  for (pqServerManagerModelItem* item : pqActiveObjects::instance().selection())
  {
    auto* source = qobject_cast<pqPipelineSource*>(item);
    pqOutputPort* port = source ? source->getOutputPort(0) : qobject_cast<pqOutputPort*>(item);
    if (port && isPartOrEmpty(port))
    {
      parts.append(port);
    }
  }
  pqOutputPort* last = choose(isPartOrEmpty);
  return parts.empty() && last ? QList<pqOutputPort*>{ last } : parts;
}

pqOutputPort* openScan()
{
  pqOutputPort *scan = choose(isScan), *grid = choose(isGrid); // points alone beside a grid may be its edges
  return grid && scan != pqActiveObjects::instance().activePort() ? grid : scan;
}

pqPipelineSource* openEstimation()
{
  pqOutputPort* port = choose(isEstimation);
  return port ? port->getSource() : nullptr;
}
