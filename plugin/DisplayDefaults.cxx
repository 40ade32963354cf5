// SPDX-License-Identifier: BSD-3-Clause
#include "DisplayDefaults.h"

#include "Legends.h"
#include "RankColors.h"
#include "ShownData.h"
#include "TypeNames.h"

#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkNew.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVDataSetAttributesInformation.h"
#include "vtkSMInputProperty.h"
#include "vtkSMPVRepresentationProxy.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMPropertyIterator.h"
#include "vtkSMProxyIterator.h"
#include "vtkSMProxyManager.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSettings.h"
#include "vtkSMSourceProxy.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <cstring>
#include <vector>

namespace
{
constexpr double SettingsPriority = 0.5;                     // above ParaView's own, below a user's
// Annotations of views
constexpr const char* SeenFromSensor = "PPFMEAM.FromSensor"; // whose camera has been placed where the sensor is
constexpr const char* Placed = "PPFMEAM.CameraPlaced";       // whose camera has been placed once

/// Draws a scan behind what lies on its surface, such as a part at its pose, by a shift of its depth alone: a share of
/// what lies between the near and the far end of the view.
constexpr const char* BehindParts = R"([{ "type": "fragment", "original": "//VTK::Depth::Impl", "replacement":
  "//VTK::Depth::Impl\n  gl_FragDepth = min(1.0, gl_FragCoord.z + 0.005);\n" }])";

/// Draws points in front of all else, in their own order.
constexpr const char* InFront = R"([{ "type": "fragment", "original": "//VTK::Depth::Impl", "replacement":
  "//VTK::Depth::Impl\n  gl_FragDepth = 0.01 * gl_FragCoord.z;\n" }])";

void hide(vtkSMRenderViewProxy* view, vtkSMSourceProxy* source, unsigned int port)
{
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  controller->Hide(source, static_cast<int>(port), view);
}

/// What the representation is colored by; null when it has one color.
vtkPVArrayInformation* colorArray(vtkSMProxy* representation, vtkPVDataInformation* data)
{
  if (!representation->GetProperty("ColorArrayName"))
  {
    return nullptr;
  }
  const vtkSMPropertyHelper color(representation, "ColorArrayName");
  const char* name = color.GetInputArrayNameToProcess();
  return name ? data->GetArrayInformation(name, color.GetInputArrayAssociation()) : nullptr;
}

/// From where the sensor is, which looks along z with y down, and near enough that the data fill the view.
void lookFromSensor(vtkSMRenderViewProxy* view, const double bounds[6])
{
  const double position[3] = { 0.0, 0.0, 0.0 }, focus[3] = { 0.0, 0.0, 1.0 }, up[3] = { 0.0, -1.0, 0.0 };
  vtkSMPropertyHelper(view, "CameraPosition").Set(position, 3);
  vtkSMPropertyHelper(view, "CameraFocalPoint").Set(focus, 3);
  vtkSMPropertyHelper(view, "CameraViewUp").Set(up, 3);
  view->UpdateVTKObjects();
  view->ResetCamera(bounds);
  view->SetAnnotation(SeenFromSensor, "1");
}

/// A scan: the gray values or colors of its image as they are, not through a color map and without light. Points alone
/// without these are gray, since labels are white.
void showScan(vtkSMProxy* representation, const ShownData& shown)
{
  vtkPVDataInformation* data = shown.data();
  const bool isCloud = readsClouds(shown.source) && !isOrganized(data);
  if ((!isCloud && !isOrganized(data)) || !representation->GetProperty("ShaderReplacements"))
  {
    return;
  }
  vtkSMPropertyHelper(representation, "UseShaderReplacements").Set(1);
  vtkSMPropertyHelper(representation, "ShaderReplacements").Set(BehindParts);
  vtkPVArrayInformation* colors = colorArray(representation, data);
  if (colors && colors->GetDataType() == VTK_UNSIGNED_CHAR)
  {
    vtkSMPropertyHelper(representation, "MapScalars").Set(0);
    vtkSMPropertyHelper(representation, "Ambient").Set(1.0);
    vtkSMPropertyHelper(representation, "Diffuse").Set(0.0);
  }
  else if (isCloud)
  {
    const double gray[3] = { 0.45, 0.45, 0.45 };
    for (const char* color : { "AmbientColor", "DiffuseColor" })
    {
      vtkSMPropertyHelper(representation, color).Set(gray, 3);
    }
  }
  representation->UpdateVTKObjects();
}

/// A mesh of a single solid: the numbers that VTK's STL reader gives to solids are no colors.
void showPlain(vtkSMProxy* representation, vtkPVDataInformation* data)
{
  vtkPVArrayInformation* colors = colorArray(representation, data);
  if (colors && std::strcmp(colors->GetName(), "STLSolidLabeling") == 0 &&
      colors->GetComponentRange(0)[0] == colors->GetComponentRange(0)[1])
  {
    if (auto* geometry = vtkSMPVRepresentationProxy::SafeDownCast(representation))
    {
      geometry->SetScalarColoring(nullptr, vtkDataObject::CELL);
    }
  }
}

/// A text of ours, the answer of a filter: where nothing else is, in letters of a map, dark behind them where a small
/// view has the scan there, too.
void showText(vtkSMProxy* representation)
{
  constexpr int UpperLeftCorner = 4, Left = 0, Always = 1;
  const double background[4] = { 0.0, 0.0, 0.0, 0.6 };
  vtkSMPropertyHelper(representation, "WindowLocation").Set(UpperLeftCorner);
  vtkSMPropertyHelper(representation, "Justification").Set(Left);
  vtkSMPropertyHelper(representation, "FontSize").Set(12);
  vtkSMPropertyHelper(representation, "BackgroundColor").Set(background, 4);
  vtkSMPropertyHelper(representation, "ShowBorder").Set(Always); // which the background needs
  vtkSMPropertyHelper(representation, "BorderThickness").Set(0.0);
  representation->UpdateVTKObjects();
}

/// Points of ours that often lie under other parts are in front of these: those of Pose Diagnosis, and the poses of Pose
/// Evaluation, which are few.
void showInFront(vtkSMProxy* representation, const ShownData& shown)
{
  const char* name = shown.source->GetVTKClassName();
  const bool isDiagnosis = (shown.port == 0 || shown.port == 4) && std::strcmp(name, "vtkMEAMPoseDiagnosis") == 0;
  const bool isEvaluation = shown.port == 2 && std::strcmp(name, "vtkMEAMPoseEvaluation") == 0;
  if ((isDiagnosis || isEvaluation) && representation->GetProperty("ShaderReplacements"))
  {
    vtkSMPropertyHelper(representation, "UseShaderReplacements").Set(1);
    vtkSMPropertyHelper(representation, "ShaderReplacements").Set(InFront);
    vtkSMPropertyHelper(representation, "PointSize").Set(isDiagnosis ? 3.0 : 12.0);
    representation->UpdateVTKObjects();
  }
}

/// Hides answers of other filters, which would stand in the same place.
void hideAnswers(vtkSMRenderViewProxy* view, vtkSMSourceProxy* but)
{
  const vtkSMPropertyHelper representations(view, "Representations");
  for (unsigned int k = 0; k < representations.GetNumberOfElements(); ++k)
  {
    vtkSMProxy* representation = representations.GetAsProxy(k);
    const ShownData shown(representation);
    if (isOurs(shown.source) && shown.source != but && std::strcmp(representation->GetXMLName(), "TextSourceRepresentation") == 0)
    {
      hide(view, shown.source, shown.port);
    }
  }
}

/// An answer in words comes up with the first output of its filter.
void showAnswer(vtkSMRenderViewProxy* view, const ShownData& shown)
{
  for (unsigned int port = 1; shown.port == 0 && port < shown.source->GetNumberOfOutputPorts(); ++port)
  {
    if (std::strcmp(shown.source->GetOutputPortName(port), "Answer") == 0)
    {
      hideAnswers(view, shown.source);
      vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
      controller->Show(shown.source, port, view);
    }
  }
}

/// Hides the parts that were searched, which lie where the sensor is, when their poses are shown.
void hideParts(vtkSMRenderViewProxy* view, vtkSMSourceProxy* source)
{
  for (const char* name : { "Input", "Mesh" })
  {
    auto* input = vtkSMInputProperty::SafeDownCast(source->GetProperty(name));
    for (unsigned int k = 0; input && k < input->GetNumberOfProxies(); ++k)
    {
      auto* part = vtkSMSourceProxy::SafeDownCast(input->GetProxy(k));
      const unsigned int port = input->GetOutputPortForConnection(k);
      if (part && !isInScene(part->GetDataInformation(port)))
      {
        hide(view, part, port);
      }
    }
  }
}

/// Hides the labels of the poses when those of the picks take their place.
void hidePoses(vtkSMRenderViewProxy* view, const ShownData& shown)
{
  auto* input = vtkSMInputProperty::SafeDownCast(shown.source->GetProperty("Input"));
  auto* poses = input && input->GetNumberOfProxies() == 1 ? vtkSMSourceProxy::SafeDownCast(input->GetProxy(0)) : nullptr;
  if (poses && shown.port == 0 && std::strcmp(shown.source->GetVTKClassName(), "vtkMEAMPickPlanning") == 0)
  {
    hide(view, poses, input->GetOutputPortForConnection(0));
  }
}

/// Hides what a step of poses was made of, as ParaView does it for other filters, but for the scan.
void hideInputs(vtkSMRenderViewProxy* view, vtkSMSourceProxy* source)
{
  if (!source->GetProperty("SceneSurface"))
  {
    return;
  }
  auto properties = vtkSmartPointer<vtkSMPropertyIterator>::Take(source->NewPropertyIterator());
  for (properties->Begin(); !properties->IsAtEnd(); properties->Next())
  {
    auto* input = vtkSMInputProperty::SafeDownCast(properties->GetProperty());
    for (unsigned int k = 0; input && k < input->GetNumberOfProxies(); ++k)
    {
      auto* producer = vtkSMSourceProxy::SafeDownCast(input->GetProxy(k));
      const unsigned int port = input->GetOutputPortForConnection(k);
      if (producer && !isOrganized(producer->GetDataInformation(port)))
      {
        hide(view, producer, port);
      }
    }
  }
}

/// Hides what stands between the sensor and the scan, such as a CAD in its own coordinates.
void hideInFront(vtkSMRenderViewProxy* view, double nearest)
{
  const vtkSMPropertyHelper representations(view, "Representations");
  for (unsigned int k = 0; k < representations.GetNumberOfElements(); ++k)
  {
    const ShownData shown(representations.GetAsProxy(k));
    if (shown.source)
    {
      double bounds[6];
      shown.data()->GetBounds(bounds);
      if (bounds[4] <= bounds[5] && bounds[5] < nearest)
      {
        hide(view, shown.source, shown.port);
      }
    }
  }
}

/// By the active scalars, as ParaView colors what has them when it is added.
void colorByScalars(vtkSMRenderViewProxy* view, vtkSMProxy* representation, vtkPVDataInformation* data)
{
  auto* shown = vtkSMPVRepresentationProxy::SafeDownCast(representation);
  for (const int kind : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    vtkPVArrayInformation* scalars =
      data->GetAttributeInformation(kind)->GetAttributeInformation(vtkDataSetAttributes::SCALARS);
    if (shown && scalars)
    {
      shown->SetScalarColoring(scalars->GetName(), kind);
      shown->SetScalarBarVisibility(view, true);
      return;
    }
  }
}

/// The color of a representation without an array that colors it; empty when it has one.
std::vector<double> colorOf(vtkSMProxy* representation)
{
  const char* array = vtkSMPropertyHelper(representation, "ColorArrayName", true).GetInputArrayNameToProcess();
  return array && *array ? std::vector<double>() : vtkSMPropertyHelper(representation, "DiffuseColor", true).GetDoubleArray();
}

/// Listens for what is added to views.
class DisplayDefaults
{
public:
  void listen()
  {
    vtkSMProxyManager* proxies = vtkSMProxyManager::GetProxyManager();
    proxies->AddObserver(vtkCommand::RegisterEvent, this, &DisplayDefaults::onRegistered);
  }

private:
  void onRegistered(vtkObject*, unsigned long, void* data)
  {
    const auto* information = static_cast<vtkSMProxyManager::RegisteredProxyInformation*>(data);
    auto* view = vtkSMRenderViewProxy::SafeDownCast(information->Proxy);
    if (view && std::strcmp(information->GroupName, "views") == 0)
    {
      view->AddObserver(vtkCommand::PropertyModifiedEvent, this, &DisplayDefaults::onViewModified);
      this->look(view); // that of a state has its representations already
    }
  }

  void onViewModified(vtkObject* caller, unsigned long, void* data)
  {
    auto* view = vtkSMRenderViewProxy::SafeDownCast(caller);
    if (view && data && std::strcmp(static_cast<const char*>(data), "Representations") == 0)
    {
      this->look(view);
    }
  }

  /// For representations that are new.
  void look(vtkSMRenderViewProxy* view)
  {
    this->Seen.erase(std::remove(this->Seen.begin(), this->Seen.end(), nullptr), this->Seen.end());
    const vtkSMPropertyHelper representations(view, "Representations");
    for (unsigned int k = 0; k < representations.GetNumberOfElements(); ++k)
    {
      vtkSMProxy* representation = representations.GetAsProxy(k);
      if (representation && std::find(this->Seen.begin(), this->Seen.end(), representation) == this->Seen.end())
      {
        this->Seen.emplace_back(representation);
        representation->AddObserver(vtkCommand::UpdateDataEvent, this, &DisplayDefaults::onUpdated);
        const bool isOfState = view->GetSessionProxyManager()->GetInLoadXMLState(); // which brings its own
        if (std::strcmp(representation->GetXMLName(), "ScalarBarWidgetRepresentation") == 0)
        {
          this->InViews.onAdded(view, representation, isOfState);
        }
        else if (!isOfState)
        {
          this->onAdded(view, representation);
        }
      }
    }
  }

  void onAdded(vtkSMRenderViewProxy* view, vtkSMProxy* representation)
  {
    const ShownData shown(representation);
    if (!shown.source)
    {
      return;
    }
    nameTypes(representation);
    showPlain(representation, shown.data());
    if (!isOurs(shown.source))
    {
      return;
    }
    if (std::strcmp(representation->GetXMLName(), "TextSourceRepresentation") == 0)
    {
      showText(representation);
      return;
    }
    if (shown.data()->GetNumberOfPoints() == 0) // where Apply failed it shows something after another one
    {
      this->Empty.push_back({ view, representation, colorOf(representation) });
    }
    showInFront(representation, shown);
    showAnswer(view, shown);
    showScan(representation, shown);
    if (isInScene(shown.data()))
    {
      hideParts(view, shown.source);
      hideInputs(view, shown.source);
      hidePoses(view, shown);
      if (!view->HasAnnotation(Placed) && comesFromScan(shown.source, shown.port))
      {
        double bounds[6];
        shown.data()->GetBounds(bounds);
        if (bounds[4] > 0.0)
        {
          hideInFront(view, bounds[4]);
          lookFromSensor(view, bounds);
        }
        else // not in the sensor's frame
        {
          view->ResetCamera(bounds);
        }
        view->SetAnnotation(Placed, "1");
      }
    }
  }

  void onUpdated(vtkObject* caller, unsigned long, void*)
  {
    auto* representation = vtkSMProxy::SafeDownCast(caller);
    this->showFilled(representation);
    nameTypes(representation);
  }

  /// What came without data, and was not colored by the user since, is shown as what comes with them.
  void showFilled(vtkSMProxy* representation)
  {
    this->Empty.erase(std::remove_if(this->Empty.begin(), this->Empty.end(), [](const Added& one) { return !one.representation; }),
      this->Empty.end());
    const auto known = std::find_if(
      this->Empty.begin(), this->Empty.end(), [&](const Added& one) { return one.representation == representation; });
    const ShownData shown(representation);
    if (known == this->Empty.end() || !shown.source || shown.data()->GetNumberOfPoints() == 0)
    {
      return;
    }
    const Added added = *known;
    this->Empty.erase(known);
    if (added.view && colorOf(representation) == added.color)
    {
      colorByScalars(added.view, representation, shown.data());
    }
    if (added.view)
    {
      this->onAdded(added.view, representation);
    }
  }

  /// A representation, as it was without data.
  struct Added
  {
    vtkWeakPointer<vtkSMRenderViewProxy> view;
    vtkWeakPointer<vtkSMProxy> representation;
    std::vector<double> color;
  };

  std::vector<vtkWeakPointer<vtkSMProxy>> Seen;
  std::vector<Added> Empty;
  Legends InViews;
};
}

bool isSeenFromSensor(vtkSMProxy* view) { return view->HasAnnotation(SeenFromSensor); }

void hideParts(vtkSMSourceProxy* source)
{
  vtkNew<vtkSMProxyIterator> views;
  views->SetSession(source->GetSession());
  for (views->Begin("views"); !views->IsAtEnd(); views->Next())
  {
    auto* view = vtkSMRenderViewProxy::SafeDownCast(views->GetProxy());
    if (view && isSeenFromSensor(view))
    {
      hideParts(view, source);
    }
  }
}

void setMEAMDisplayDefaults()
{
  vtkSMSettings::GetInstance()->AddCollectionFromString(RankColors, SettingsPriority);
  static DisplayDefaults defaults;
  defaults.listen();
}
