// SPDX-License-Identifier: BSD-3-Clause
#include "Tutorial.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqCoreUtilities.h"
#include "pqObjectBuilder.h"
#include "pqPropertiesPanel.h"
#include "pqUndoStack.h"

#include <QAction>
#include <QDockWidget>
#include <QFile>
#include <QMainWindow>
#include <QMenu>
#include <QPushButton>
#include <QTextBrowser>
#include <QVBoxLayout>
#include <QWidget>

namespace
{
constexpr int Width = 330; // pixels

void openExample()
{
  BEGIN_UNDO_SET("Create 'Bin Scene'");
  pqApplicationCore::instance()->getObjectBuilder()->createSource(
    "sources", "BinSceneSource", pqActiveObjects::instance().activeServer());
  END_UNDO_SET();
  if (auto* panel = pqCoreUtilities::mainWidget()->findChild<pqPropertiesPanel*>())
  {
    panel->apply();
  }
}

QDockWidget* makeTutorial(QMainWindow* window)
{
  auto* page = new QWidget;
  page->setObjectName("Page");
  auto* text = new QTextBrowser(page);
  text->setObjectName("Text");
  text->setOpenExternalLinks(true);
  QFile file(":/PPFMEAM/tutorial.md");
  if (file.open(QIODevice::ReadOnly))
  {
    text->setMarkdown(QString::fromUtf8(file.readAll()));
  }
  auto* open = new QPushButton("Open the Example", page);
  open->setObjectName("OpenExample");
  QObject::connect(open, &QPushButton::clicked, openExample);
  auto* layout = new QVBoxLayout(page);
  layout->addWidget(open);
  layout->addWidget(text);
  auto* dock = new QDockWidget("PPFMEAM Tutorial", window);
  dock->setObjectName("PPFMEAMTutorial");
  dock->setWidget(page);
  window->addDockWidget(Qt::RightDockWidgetArea, dock);
  window->resizeDocks({ dock }, { Width }, Qt::Horizontal);
  return dock;
}
}

void addTutorial(QMainWindow* window)
{
  auto* help = window->findChild<QMenu*>("menu_Help");
  if (!help)
  {
    return;
  }
  QAction* entry = help->addAction("PPFMEAM Tutorial");
  entry->setObjectName("actionPPFMEAMTutorial");
  QObject::connect(entry, &QAction::triggered, window,
    [window]
    {
      auto* dock = window->findChild<QDockWidget*>("PPFMEAMTutorial");
      (dock ? dock : makeTutorial(window))->show();
    });
}
