// SPDX-License-Identifier: BSD-3-Clause
#include "ScoreCharts.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqObjectBuilder.h"
#include "pqOutputPort.h"
#include "pqPipelineSource.h"
#include "pqRenderView.h"
#include "pqServer.h"
#include "pqServerManagerModel.h"
#include "pqUndoStack.h"
#include "vtkNew.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMStringVectorProperty.h"
#include "vtkSMViewLayoutProxy.h"
#include "vtkSMViewProxy.h"

#include <iterator>
#include <string>
#include <vector>

namespace
{
constexpr double ShareOfPicture = 0.62; // of the width
constexpr int FontSize = 10;
constexpr int Scores = 3, Times = 4;    // outputs of MEAM Pose Estimation
/// Above each other, so that there is room for them.
constexpr const char* Stages[] = { "Training", "\nScene Edges", "\n\nScene", "Tangents", "\nDetection",
  "\n\nScreening", "Verification", "\nRefinement", "\n\nSelection", "Output" };

pqView* addView(pqPipelineSource* estimation, const char* title, vtkSMViewLayoutProxy* layout, int cell)
{
  pqView* view =
    pqApplicationCore::instance()->getObjectBuilder()->createView("XYBarChartView", estimation->getServer());
  layout->AssignView(cell, view->getViewProxy());
  vtkSMPropertyHelper(view->getProxy(), "ChartTitle").Set(title);
  for (const char* size : { "ChartTitleFontSize", "LegendFontSize", "BottomAxisTitleFontSize", "BottomAxisLabelFontSize" })
  {
    vtkSMPropertyHelper(view->getProxy(), size).Set(FontSize);
  }
  return view;
}

vtkSMProxy* addBars(pqPipelineSource* estimation, int port, pqView* view)
{
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  return controller->Show(estimation->getSourceProxy(), port, view->getViewProxy());
}

void show(pqView* view, vtkSMProxy* bars)
{
  view->getProxy()->UpdateVTKObjects();
  bars->UpdateVTKObjects();
  view->render();
}

/// Five bars for each pose, from 0 to 1, with the legend above them.
void addScores(pqPipelineSource* estimation, vtkSMViewLayoutProxy* layout, int cell)
{
  constexpr double Highest = 1.5;
  pqView* view = addView(estimation, "Scores of the poses", layout, cell);
  vtkSMProxy* bars = addBars(estimation, Scores, view);
  vtkSMPropertyHelper(view->getProxy(), "BottomAxisTitle").Set("Rank");
  vtkSMPropertyHelper(view->getProxy(), "LeftAxisUseCustomRange").Set(1);
  vtkSMPropertyHelper(view->getProxy(), "LeftAxisRangeMinimum").Set(0.0);
  vtkSMPropertyHelper(view->getProxy(), "LeftAxisRangeMaximum").Set(Highest);
  vtkSMPropertyHelper(bars, "UseIndexForXAxis").Set(0);
  vtkSMPropertyHelper(bars, "XArrayName").Set("Pose");
  vtkSMPropertyHelper(bars, "SeriesVisibility").SetStatus("Pose", 0);
  show(view, bars);
}

/// A bar for each stage, in their order.
void addTimes(pqPipelineSource* estimation, vtkSMViewLayoutProxy* layout, int cell)
{
  pqView* view = addView(estimation, "Seconds of each stage", layout, cell);
  vtkSMProxy* bars = addBars(estimation, Times, view);
  vtkSMPropertyHelper(view->getProxy(), "ShowLegend").Set(0);
  vtkSMPropertyHelper(view->getProxy(), "BottomAxisUseCustomLabels").Set(1);
  std::vector<std::string> labels; // where, and what
  for (const char* stage : Stages)
  {
    labels.push_back(std::to_string(labels.size() / 2));
    labels.emplace_back(stage);
  }
  vtkSMStringVectorProperty::SafeDownCast(view->getProxy()->GetProperty("BottomAxisLabels"))->SetElements(labels);
  vtkSMPropertyHelper(view->getProxy(), "BottomAxisUseCustomRange").Set(1);
  vtkSMPropertyHelper(view->getProxy(), "BottomAxisRangeMinimum").Set(-0.5);
  vtkSMPropertyHelper(view->getProxy(), "BottomAxisRangeMaximum").Set(std::size(Stages) - 0.5);
  vtkSMPropertyHelper(bars, "UseIndexForXAxis").Set(1);
  show(view, bars);
}

/// The picture that charts are put beside: the active one, if it is of this kind.
pqRenderView* pictureOf(pqServer* server)
{
  auto* active = qobject_cast<pqRenderView*>(pqActiveObjects::instance().activeView());
  const auto all = pqApplicationCore::instance()->getServerManagerModel()->findItems<pqRenderView*>(server);
  return active ? active : all.empty() ? nullptr : all.first();
}
}

void showScoreCharts(pqPipelineSource* estimation)
{
  pqRenderView* picture = pictureOf(estimation->getServer());
  vtkSMViewLayoutProxy* layout = picture ? vtkSMViewLayoutProxy::FindLayout(picture->getViewProxy()) : nullptr;
  if (!layout || !estimation->getOutputPort(Scores)->getViews().empty())
  {
    return;
  }
  BEGIN_UNDO_SET("Show scores and times");
  const int cell = layout->GetViewLocation(picture->getViewProxy());
  layout->SplitHorizontal(cell, ShareOfPicture);
  const int beside = vtkSMViewLayoutProxy::GetSecondChild(cell);
  layout->SplitVertical(beside, 0.5);
  addScores(estimation, layout, vtkSMViewLayoutProxy::GetFirstChild(beside));
  addTimes(estimation, layout, vtkSMViewLayoutProxy::GetSecondChild(beside));
  pqActiveObjects::instance().setActiveView(picture);
  END_UNDO_SET();
}
