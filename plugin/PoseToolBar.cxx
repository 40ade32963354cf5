// SPDX-License-Identifier: BSD-3-Clause
#include "PoseToolBar.h"

#include "DisplayDefaults.h"
#include "NewPart.h"
#include "OpenData.h"
#include "OpenedFiles.h"
#include "PartView.h"
#include "ScanPicking.h"
#include "ScoreCharts.h"
#include "ShownData.h"
#include "Tutorial.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqCoreUtilities.h"
#include "pqObjectBuilder.h"
#include "pqOutputPort.h"
#include "pqPipelineFilter.h"
#include "pqPropertiesPanel.h"
#include "pqServerManagerModel.h"
#include "pqUndoStack.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyIterator.h"
#include "vtkSMProxy.h"
#include "vtkSMSourceProxy.h"
#include "vtkSmartPointer.h"

#include <QAction>
#include <QApplication>
#include <QDialog>
#include <QEvent>
#include <QIcon>
#include <QLabel>
#include <QMainWindow>
#include <QMessageBox>
#include <QRadioButton>
#include <QStatusBar>
#include <QTimer>
#include <QToolBar>

namespace
{
constexpr int UntilNextLook = 100; // ms

using Inputs = QMap<QString, QList<pqOutputPort*>>;

/// The parts and the scan that are open. None: they are not, or a part is empty, which is said.
Inputs openInputs(const char* label)
{
  const QList<pqOutputPort*> parts = openParts();
  pqOutputPort* scan = openScan();
  for (pqOutputPort* part : parts)
  {
    if (isEmptyPart(part))
    {
      QMessageBox::information(pqCoreUtilities::mainWidget(), label,
        QString("%1 has no triangles: delete it, or select another part.").arg(part->getSource()->getSMName()));
      return {};
    }
  }
  if (parts.empty() || !scan)
  {
    QMessageBox::information(pqCoreUtilities::mainWidget(), label,
      QString("There is no %1: open one first.")
        .arg(parts.empty() ? "part, a CAD file or a trained model" : "scan, a cloud (PCD, PLY, XYZ) or a depth image"));
    return {};
  }
  return { { "Input", parts }, { "Scene", { scan } } };
}

pqPipelineSource* addFilter(const char* name, const char* label, const Inputs& inputs)
{
  BEGIN_UNDO_SET(QString("Create '%1'").arg(label));
  pqPipelineSource* filter = pqApplicationCore::instance()->getObjectBuilder()->createFilter(
    "filters", name, inputs, pqActiveObjects::instance().activeServer());
  END_UNDO_SET();
  return filter;
}

void applyAll()
{
  if (auto* panel = pqCoreUtilities::mainWidget()->findChild<pqPropertiesPanel*>())
  {
    panel->apply();
  }
}

void estimatePoses()
{
  constexpr const char* Label = "MEAM Pose Estimation";
  applyAll();
  const Inputs inputs = openInputs(Label);
  if (!inputs.empty())
  {
    addFilter("MEAMPoseEstimation", Label, inputs);
  }
}

/// Of the parts in the scan, with the properties that they were searched with, if they were.
void askWhy()
{
  constexpr const char* Label = "Pose Diagnosis";
  applyAll();
  pqPipelineSource* estimation = openEstimation();
  auto* searched = qobject_cast<pqPipelineFilter*>(estimation);
  Inputs inputs = searched ? searched->getNamedInputs() : openInputs(Label);
  if (searched)
  {
    inputs["Poses"] = { searched->getOutputPort(0) }; // those that are drawn
  }
  pqPipelineSource* diagnosis = inputs.empty() ? nullptr : addFilter("PoseDiagnosis", Label, inputs);
  if (diagnosis)
  {
    // Ctrl, because the cells of a scan are often smaller than the pixels of the picture: P alone may miss them.
    qobject_cast<QMainWindow*>(pqCoreUtilities::mainWidget())
      ->statusBar()
      ->showMessage("Point at the part, Ctrl+P, Apply");
  }
  if (!searched || !diagnosis)
  {
    return;
  }
  auto properties = vtkSmartPointer<vtkSMPropertyIterator>::Take(searched->getProxy()->NewPropertyIterator());
  for (properties->Begin(); !properties->IsAtEnd(); properties->Next())
  {
    vtkSMProperty* property = diagnosis->getProxy()->GetProperty(properties->GetKey());
    if (property && !property->GetInformationOnly())
    {
      property->Copy(properties->GetProperty()); // inputs, too: ParaView turns the order of the parts round
    }
  }
}

void showCharts()
{
  if (pqPipelineSource* estimation = openEstimation())
  {
    showScoreCharts(estimation);
    return;
  }
  QMessageBox::information(
    pqCoreUtilities::mainWidget(), "Scores and Times", "There are no poses: apply MEAM Pose Estimation first.");
}

/// A button of our own.
void addButton(QToolBar* bar, const char* name, const char* icon, const char* text, const char* tip, void (*clicked)())
{
  QAction* action = bar->addAction(QIcon(QString(":/PPFMEAM/icons/%1.svg").arg(icon)), text, clicked);
  action->setObjectName(name);
  action->setToolTip(tip);
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
      const bool picks = dialog->findChild<QRadioButton*>("Grasps") && dialog->findChild<QRadioButton*>("Mesh");
      rename(dialog, "Scene", wholeMethod, "Scan");
      rename(dialog, "Input", wholeMethod, "Part");
      rename(dialog, "Boundary", wholeMethod, "Edge Points");
      rename(dialog, "SceneSurface", stepOfPoses, "Scan");
      rename(dialog, "Input", picks, "Poses");
      rename(dialog, "Mesh", picks, "Part");
      rename(dialog, "GripperMesh", picks, "Gripper");
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
  addButton(bar, "EstimatePoses", "found", "MEAM Pose Estimation",
    "Finds the copies of the open part in the open scan (MEAM Pose Estimation)", estimatePoses);
  addButton(bar, "ShowCharts", "chart", "Scores and Times",
    "Shows how likely the poses are and how long each stage took, beside the picture", showCharts);
  addButton(bar, "AskWhy", "why", "Pose Diagnosis", "Tells why a part was missed, or why a pose came out: point at it, Ctrl+P, Apply (Pose Diagnosis)", askWhy);
  for (const char* name : { "PoseInstances", "ConflictResolution" }) // ParaView's own actions
  {
    for (QAction* filter : window->findChildren<QAction*>(name))
    {
      bar->addAction(filter);
    }
  }
  addTutorial(window);
  addNewPart(window);
  addPartView();
  addScanPicking(window);
  addOpenedFiles(window);
  qApp->installEventFilter(new InputNames(window));
  // ParaView shows the inputs of a filter that is deleted.
  QObject::connect(pqApplicationCore::instance()->getServerManagerModel(), &pqServerManagerModel::preSourceRemoved, window,
    [](pqPipelineSource* source)
    {
      if (isOurs(source->getSourceProxy()))
      {
        hideParts(source->getSourceProxy());
      }
    });
}
}

void addMEAMToolBar()
{
  if (qobject_cast<QApplication*>(QCoreApplication::instance()))
  {
    QTimer::singleShot(0, build);
  }
}
