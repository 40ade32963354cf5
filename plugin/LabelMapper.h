// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkLabeledDataMapper.h"

#include <array>
#include <string>
#include <vector>

/// Draws labels of which none covers another. Where there is no room for "12: 97 %, rotation 80 %" it is cut to "12: 97 %"
/// or to "12", and where there is none for that it is left out: the labels of the first points are drawn first. First all
/// get as little as they can be cut to. Zooming in makes room.
class LabelMapper : public vtkLabeledDataMapper
{
public:
  static LabelMapper* New();
  vtkTypeMacro(LabelMapper, vtkLabeledDataMapper);

  void RenderOpaqueGeometry(vtkViewport* viewport, vtkActor2D* actor) override;
  void RenderOverlay(vtkViewport* viewport, vtkActor2D* actor) override;

protected:
  LabelMapper() = default;

private:
  using Box = std::array<double, 4>; // pixels: from and to along x, from and to along y

  struct Label
  {
    int index; // of the superclass
    std::vector<std::string> texts; // the longer the later
    std::vector<Box> boxes;         // of the texts, about the label's point
  };

  static Box around(const std::array<double, 2>& place, const Box& box);
  static bool areApart(const Box& a, const Box& b);
  Box boxOf(const std::string& text, int dpi);
  void collect();
  void measure(int dpi);
  bool isBehind(int index, vtkViewport* viewport);
  void goTo(int index, vtkActor2D* actor);

  std::vector<Label> Labels;
  std::vector<int> Shown; // of the superclass
  int MeasuredDPI = 0;
};
