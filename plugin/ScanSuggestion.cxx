// SPDX-License-Identifier: BSD-3-Clause
#include "ScanSuggestion.h"

#include <pqApplicationCore.h>
#include <pqInterfaceTracker.h>
#include <pqPipelineSource.h>
#include <pqPropertyWidget.h>
#include <pqPropertyWidgetInterface.h>
#include <pqServerManagerModel.h>

#include <QApplication>
#include <QLabel>
#include <QTimer>
#include <QVBoxLayout>

#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

#include <cstring>

namespace
{
constexpr const char* WidgetOfPanel = "meam_suggestion"; // as xml/MEAMPoseEstimation.xml has it

class ScanSuggestion : public pqPropertyWidget
{
public:
  ScanSuggestion(vtkSMProxy* estimation, vtkSMProperty* property, QWidget* parent)
    : pqPropertyWidget(estimation, parent)
    , Text(new QLabel(this))
  {
    this->setProperty(property);
    this->setShowLabel(false);
    this->Text->setObjectName("Text");
    this->Text->setWordWrap(true);
    this->Text->setTextInteractionFlags(Qt::TextSelectableByMouse);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(this->Text);
    auto* model = pqApplicationCore::instance()->getServerManagerModel();
    if (auto* source = model->findItem<pqPipelineSource*>(estimation))
    {
      QObject::connect(source, qOverload<pqPipelineSource*>(&pqPipelineSource::dataUpdated), this, [this] { this->tell(); });
    }
    this->tell();
  }

private:
  void tell()
  {
    vtkSMProxy* estimation = this->proxy();
    estimation->UpdatePropertyInformation(estimation->GetProperty("SuggestionInfo"));
    const QString text = vtkSMPropertyHelper(estimation, "SuggestionInfo").GetAsString();
    this->Text->setText(text.isEmpty() ? "After Apply it stands here what to change first." : text);
  }

  QLabel* Text;
};

/// Makes it for the panels of ParaView.
class Suggestions : public QObject, public pqPropertyWidgetInterface
{
  Q_OBJECT
  Q_INTERFACES(pqPropertyWidgetInterface)

public:
  using QObject::QObject;

  pqPropertyWidget* createWidgetForProperty(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent) override
  {
    const char* kind = property->GetPanelWidget();
    return kind && std::strcmp(kind, WidgetOfPanel) == 0 ? new ScanSuggestion(proxy, property, parent) : nullptr;
  }
};
}

void addMEAMScanSuggestion()
{
  if (qobject_cast<QApplication*>(QCoreApplication::instance()))
  {
    QTimer::singleShot(0, // when the application is there
      []
      {
        pqInterfaceTracker* tracker = pqApplicationCore::instance()->interfaceTracker();
        tracker->addInterface(new Suggestions(tracker));
      });
  }
}

#include "ScanSuggestion.moc"
