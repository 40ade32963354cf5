// SPDX-License-Identifier: BSD-3-Clause
#include "LabelMapper.h"

#include "vtkActor2D.h"
#include "vtkCamera.h"
#include "vtkCoordinate.h"
#include "vtkObjectFactory.h"
#include "vtkRenderer.h"
#include "vtkStdString.h"
#include "vtkTextMapper.h"
#include "vtkTextProperty.h"
#include "vtkTextRenderer.h"
#include "vtkTransform.h"
#include "vtkWindow.h"

#include <algorithm>

vtkStandardNewMacro(LabelMapper);

namespace
{
constexpr double Gap = 5.0;          // pixels between labels: two numbers are not read as one
constexpr std::size_t MostTexts = 3; // of a label: as `cut` makes them

/// "12", "12 (plate): 97 %" and all of "12 (plate): 97 %, rotation 80 %"; what begins with no rank is whole.
std::vector<std::string> cut(const std::string& text)
{
  std::vector<std::string> texts;
  const std::size_t rank = text.find_first_not_of("0123456789"), colon = text.find(": ");
  if (rank > 0 && rank != std::string::npos && (rank == colon || text.compare(rank, 2, " (") == 0))
  {
    texts.push_back(text.substr(0, rank));
    const std::size_t comma = text.find(", ", colon);
    if (comma != std::string::npos)
    {
      texts.push_back(text.substr(0, comma));
    }
  }
  texts.push_back(text);
  return texts;
}
}

LabelMapper::Box LabelMapper::around(const std::array<double, 2>& place, const Box& box)
{
  return { place[0] + box[0], place[0] + box[1], place[1] + box[2], place[1] + box[3] };
}

bool LabelMapper::areApart(const Box& a, const Box& b)
{
  return a[1] + Gap <= b[0] || b[1] + Gap <= a[0] || a[3] + Gap <= b[2] || b[3] + Gap <= a[2];
}

LabelMapper::Box LabelMapper::boxOf(const std::string& text, int dpi)
{
  int box[4] = { 0, 0, 0, 0 };
  vtkTextRenderer::GetInstance()->GetBoundingBox(this->GetLabelTextProperty(0), vtkStdString(text), box, dpi);
  return { double(box[0]), double(box[1]), double(box[2]), double(box[3]) };
}

void LabelMapper::collect()
{
  this->Labels.clear();
  for (int k = 0; k < this->NumberOfLabels; ++k)
  {
    const std::string text = this->GetLabelText(k);
    if (!text.empty())
    {
      this->Labels.push_back({ k, cut(text), {} });
    }
  }
}

void LabelMapper::measure(int dpi)
{
  for (Label& label : this->Labels)
  {
    label.boxes.clear();
    for (const std::string& text : label.texts)
    {
      label.boxes.push_back(this->boxOf(text, dpi));
    }
  }
  this->MeasuredDPI = dpi;
}

bool LabelMapper::isBehind(int index, vtkViewport* viewport)
{
  auto* renderer = vtkRenderer::SafeDownCast(viewport);
  if (!renderer || this->CoordinateSystem != WORLD || renderer->GetActiveCamera()->GetParallelProjection())
  {
    return false;
  }
  double point[3], eye[3], direction[3];
  this->GetLabelPosition(index, point);
  if (this->Transform)
  {
    this->Transform->TransformPoint(point, point);
  }
  renderer->GetActiveCamera()->GetPosition(eye);
  renderer->GetActiveCamera()->GetDirectionOfProjection(direction);
  return (point[0] - eye[0]) * direction[0] + (point[1] - eye[1]) * direction[1] + (point[2] - eye[2]) * direction[2] <= 0.0;
}

void LabelMapper::goTo(int index, vtkActor2D* actor)
{
  double point[3];
  this->GetLabelPosition(index, point);
  if (this->Transform)
  {
    this->Transform->TransformPoint(point, point);
  }
  vtkCoordinate* place = actor->GetPositionCoordinate();
  place->SetCoordinateSystem(this->CoordinateSystem == WORLD ? VTK_WORLD : VTK_DISPLAY);
  place->SetValue(point);
}

void LabelMapper::RenderOpaqueGeometry(vtkViewport* viewport, vtkActor2D* actor)
{
  const vtkMTimeType built = this->BuildTime;
  this->Superclass::RenderOpaqueGeometry(viewport, actor);
  const bool isNew = this->BuildTime > built; // by the superclass, from the data
  const int dpi = viewport->GetVTKWindow()->GetDPI();
  if (isNew || this->NumberOfLabels == 0) // without data the superclass builds nothing
  {
    this->collect();
  }
  if (isNew || dpi != this->MeasuredDPI)
  {
    this->measure(dpi);
  }

  struct Drawn
  {
    const Label* label;
    std::array<double, 2> place;
    std::size_t text; // which of the label's
    Box box;
  };
  std::vector<Drawn> drawn;
  const auto hasRoom = [&](const Box& box, const Drawn* but)
  {
    return std::all_of(
      drawn.begin(), drawn.end(), [&](const Drawn& other) { return &other == but || areApart(box, other.box); });
  };
  for (const Label& label : this->Labels)
  {
    if (!this->isBehind(label.index, viewport))
    {
      this->goTo(label.index, actor);
      const double* at = actor->GetPositionCoordinate()->GetComputedDoubleViewportValue(viewport);
      const std::array<double, 2> place = { at[0], at[1] };
      const Box box = around(place, label.boxes.front());
      if (hasRoom(box, nullptr))
      {
        drawn.push_back({ &label, place, 0, box });
      }
    }
  }
  for (std::size_t text = 1; text < MostTexts; ++text)
  {
    for (Drawn& one : drawn)
    {
      const Box box = text < one.label->boxes.size() ? around(one.place, one.label->boxes[text]) : one.box;
      if (text < one.label->boxes.size() && hasRoom(box, &one))
      {
        one.text = text;
        one.box = box;
      }
    }
  }
  this->Shown.clear();
  for (const Drawn& one : drawn)
  {
    const std::string& text = one.label->texts[one.text];
    if (text != this->GetLabelText(one.label->index))
    {
      this->TextMappers[one.label->index]->SetInput(text.c_str());
    }
    this->Shown.push_back(one.label->index);
  }
}

void LabelMapper::RenderOverlay(vtkViewport* viewport, vtkActor2D* actor)
{
  for (const int index : this->Shown)
  {
    this->goTo(index, actor);
    this->TextMappers[index]->RenderOverlay(viewport, actor);
  }
}
