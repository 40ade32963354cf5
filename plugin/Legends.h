// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkWeakPointer.h"

#include <utility>
#include <vector>

class vtkObject;
class vtkSMProxy;
class vtkSMRenderViewProxy;

/// The legends of views: that of the ranks is small, and colors that need no map, such as gray values, have none.
class Legends
{
public:
  /// One that a state brings looks as it was saved.
  void onAdded(vtkSMRenderViewProxy* view, vtkSMProxy* legend, bool isOfState);

private:
  void onModified(vtkObject* caller, unsigned long, void* data);
  void hideUnused(vtkSMProxy* legend);
  /// Ours stand one above the other at the right, where their names do not meet those of others in narrow views.
  void place(vtkSMProxy* legend);

  std::vector<std::pair<vtkWeakPointer<vtkSMRenderViewProxy>, vtkWeakPointer<vtkSMProxy>>> Known;
};
