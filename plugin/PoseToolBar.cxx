// SPDX-License-Identifier: BSD-3-Clause
#include "PoseToolBar.h"

#include "ShownData.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqCoreUtilities.h"
#include "pqObjectBuilder.h"
#include "pqOutputPort.h"
#include "pqPipelineSource.h"
#include "pqPropertiesPanel.h"
#include "pqServerManagerModel.h"
#include "pqUndoStack.h"
#include "vtkPVDataInformation.h"
#include "vtkSMSourceProxy.h"

#include <QAction>
#include <QApplication>
#include <QDialog>
#include <QEvent>
#include <QIcon>
#include <QLabel>
#include <QMainWindow>
#include <QMessageBox>
#include <QRadioButton>
#include <QTimer>
#include <QToolBar>

#include <cstring>

namespace
{
constexpr int UntilNextLook = 100; // ms

/// A CAD's mesh in its own coordinates, or a trained model.
bool isPart(pqOutputPort* port)
{
  const char* name = port->getSourceProxy()->GetVTKClassName();
  if (name && (std::strcmp(name, "vtkMEAMHashing") == 0 || std::strcmp(name, "vtkMEAMModelReader") == 0))
  {
    return true;
  }
  vtkPVDataInformation* data = port->getDataInformation();
  return data->DataSetTypeIsA("vtkPolyData") && data->GetNumberOfCells() > 0 && !isInScene(data);
}

bool isScan(pqOutputPort* port) { return isOrganized(port->getDataInformation()); }

/// The output of that kind that is selected or, if none is, the one that was opened last; null: there is none.
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

void estimatePoses()
{
  if (auto* panel = pqCoreUtilities::mainWidget()->findChild<pqPropertiesPanel*>())
  {
    panel->apply();
  }
  pqOutputPort* part = choose(isPart);
  pqOutputPort* scan = choose(isScan);
  if (!part || !scan)
  {
    QMessageBox::information(pqCoreUtilities::mainWidget(), "MEAM Pose Estimation",
      QString("There is no %1: open one first.")
        .arg(!part ? "part, a CAD file or a trained model" : "scan, an organized cloud"));
    return;
  }
  QMap<QString, QList<pqOutputPort*>> inputs;
  inputs["Input"] = { part };
  inputs["Scene"] = { scan };
  BEGIN_UNDO_SET("Create 'MEAM Pose Estimation'");
  pqApplicationCore::instance()->getObjectBuilder()->createFilter(
    "filters", "MEAMPoseEstimation", inputs, pqActiveObjects::instance().activeServer());
  END_UNDO_SET();
}

/// ParaView's dialog for inputs calls them by the names that scripts have; a user looks for a part and a scan.
class InputNames : public QObject
{
public:
  using QObject::QObject;

  bool eventFilter(QObject* object, QEvent* event) override
  {
    auto* dialog = event->type() == QEvent::Show ? qobject_cast<QDialog*>(object) : nullptr;
    if (dialog && dialog->inherits("pqChangeInputDialog"))
    {
      const bool wholeMethod = dialog->findChild<QRadioButton*>("Scene") && dialog->findChild<QRadioButton*>("Boundary");
      const bool stepOfPoses = dialog->findChild<QRadioButton*>("SceneSurface") && dialog->findChild<QRadioButton*>("Model");
      rename(dialog, "Scene", wholeMethod, "Scan");
      rename(dialog, "Input", wholeMethod, "Part");
      rename(dialog, "Boundary", wholeMethod, "Edge Points");
      rename(dialog, "SceneSurface", stepOfPoses, "Scan");
    }
    return false;
  }

private:
  static void rename(QDialog* dialog, const char* name, bool ours, const char* shown)
  {
    if (auto* button = ours ? dialog->findChild<QRadioButton*>(name) : nullptr)
    {
      button->setText(shown);
      auto* chosen = dialog->findChild<QLabel*>("selectInputLabel");
      if (chosen && button->isChecked())
      {
        chosen->setText(QString("Select <b>%1</b>").arg(shown));
      }
    }
  }
};

void build()
{
  auto* window =
    pqApplicationCore::instance() ? qobject_cast<QMainWindow*>(pqCoreUtilities::mainWidget()) : nullptr;
  if (!window || !window->isVisible()) // a plugin that is always loaded is so before the window and its menus are there
  {
    QTimer::singleShot(UntilNextLook, build);
    return;
  }
  QToolBar* bar = window->addToolBar("Pose Estimation");
  bar->setObjectName("PoseEstimationToolbar");
  QAction* action = bar->addAction(QIcon(":/PPFMEAM/icons/found.svg"), "MEAM Pose Estimation", estimatePoses);
  action->setObjectName("EstimatePoses");
  action->setToolTip("Finds the copies of the open part in the open scan (MEAM Pose Estimation)");
  for (const char* name : { "PoseInstances", "ConflictResolution" }) // ParaView's own actions
  {
    for (QAction* filter : window->findChildren<QAction*>(name))
    {
      bar->addAction(filter);
    }
  }
  qApp->installEventFilter(new InputNames(window));
}
}

void addMEAMToolBar()
{
  if (qobject_cast<QApplication*>(QCoreApplication::instance()))
  {
    QTimer::singleShot(0, build);
  }
}
