// SPDX-License-Identifier: BSD-3-Clause
#include "ScanPicking.h"

#include "pqActiveObjects.h"
#include "pqPropertiesPanel.h"
#include "pqPropertyWidget.h"
#include "pqProxy.h"
#include "pqQVTKWidget.h"
#include "pqRenderView.h"
#include "vtkAlgorithm.h"
#include "vtkCamera.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPVDataInformation.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSmartPointer.h"
#include "vtkStaticCellLocator.h"
#include "vtkStructuredGrid.h"

#include <QApplication>
#include <QCursor>
#include <QKeyEvent>
#include <QMainWindow>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

namespace
{
constexpr double NotThere = std::numeric_limits<double>::quiet_NaN();

/// A point in the picture: pixels to the right of the mouse and above it, and depth.
using Projected = std::array<double, 3>;

double squaredDistance(const Projected& point) { return point[0] * point[0] + point[1] * point[1]; }

/// The scan's points against the pixel; NaN where nothing was measured, and behind the camera.
std::vector<Projected> project(vtkPointSet* scan, vtkRenderer* renderer, const int pixel[2])
{
  const double* M = renderer->GetActiveCamera()
                      ->GetCompositeProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1.0, 1.0)
                      ->GetData();
  const int* size = renderer->GetSize();
  auto* grid = vtkStructuredGrid::SafeDownCast(scan);
  std::vector<Projected> projected(
    scan->GetNumberOfPoints(), { NotThere, NotThere, NotThere });
  for (vtkIdType k = 0; k < scan->GetNumberOfPoints(); ++k)
  {
    double p[3];
    scan->GetPoint(k, p);
    const auto row = [&](int r) { return M[4 * r] * p[0] + M[4 * r + 1] * p[1] + M[4 * r + 2] * p[2] + M[4 * r + 3]; };
    const double w = row(3);
    if (w > 0.0 && (!grid || grid->IsPointVisible(k)))
    {
      projected[k] = { (row(0) / w + 1.0) / 2.0 * size[0] - pixel[0] - 0.5,
        (row(1) / w + 1.0) / 2.0 * size[1] - pixel[1] - 0.5, row(2) / w };
    }
  }
  return projected;
}

/// Whether the mouse is in the polygon, by the number of its edges to the right of it.
bool isAtMouse(const std::array<const Projected*, 4>& corners)
{
  bool isInside = false;
  for (int k = 0; k < 4; ++k)
  {
    const Projected &a = *corners[k], &b = *corners[(k + 1) % 4];
    if ((a[1] > 0.0) != (b[1] > 0.0) && a[0] + (b[0] - a[0]) * a[1] / (a[1] - b[1]) > 0.0)
    {
      isInside = !isInside;
    }
  }
  return isInside;
}

/// Where the ray through the pixel meets the mesh first; false: nowhere.
bool meetsMesh(vtkPolyData* mesh, vtkRenderer* renderer, const int pixel[2], double met[3])
{
  double ends[2][4]; // nearest and farthest of what the camera shows
  for (int k = 0; k < 2; ++k)
  {
    renderer->SetDisplayPoint(pixel[0] + 0.5, pixel[1] + 0.5, k);
    renderer->DisplayToWorld();
    renderer->GetWorldPoint(ends[k]);
    std::for_each(ends[k], ends[k] + 3, [w = ends[k][3]](double& coordinate) { coordinate /= w; });
  }
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(mesh);
  locator->BuildLocator();
  double along = 0.0, parametric[3];
  int part = 0;
  return locator->IntersectWithLine(ends[0], ends[1], 0.0, along, met, parametric, part) != 0;
}

/// The point of the scan at the pixel: of the nearest cell of its grid there the corner that is next to the pixel;
/// where there is no cell the point next to the pixel. -1: the scan has no point in front of the camera.
vtkIdType pointAt(vtkPointSet* scan, vtkRenderer* renderer, const int pixel[2])
{
  const std::vector<Projected> projected = project(scan, renderer, pixel);
  std::vector<vtkIdType> candidates;
  double nearest = std::numeric_limits<double>::infinity();
  int size[3] = { 0, 0, 0 };
  if (auto* grid = vtkStructuredGrid::SafeDownCast(scan))
  {
    grid->GetDimensions(size);
  }
  for (vtkIdType y = 0; y + 1 < size[1]; ++y)
  {
    for (vtkIdType x = 0; x + 1 < size[0]; ++x)
    {
      const vtkIdType first = y * size[0] + x;
      const std::array<vtkIdType, 4> cell{ first, first + 1, first + 1 + size[0], first + size[0] };
      const std::array<const Projected*, 4> corners{ &projected[cell[0]], &projected[cell[1]], &projected[cell[2]],
        &projected[cell[3]] };
      const double depth = (*corners[0])[2] + (*corners[1])[2] + (*corners[2])[2] + (*corners[3])[2]; // NaN, if one is
      if (depth < nearest && isAtMouse(corners))
      {
        nearest = depth;
        candidates.assign(cell.begin(), cell.end());
      }
    }
  }
  if (candidates.empty())
  {
    for (vtkIdType k = 0; k < scan->GetNumberOfPoints(); ++k)
    {
      if (!std::isnan(projected[k][2]))
      {
        candidates.push_back(k);
      }
    }
  }
  const auto found = std::min_element(candidates.begin(), candidates.end(),
    [&](vtkIdType a, vtkIdType b) { return squaredDistance(projected[a]) < squaredDistance(projected[b]); });
  return found == candidates.end() ? -1 : *found;
}

/// An output as data of this process. Of a server it is fetched from the first process, which has all.
vtkSmartPointer<vtkDataObject> dataOf(vtkSMSourceProxy* source, unsigned int port)
{
  if (auto* producer = vtkAlgorithm::SafeDownCast(source->GetClientSideObject()))
  {
    return producer->GetOutputDataObject(static_cast<int>(port));
  }
  const auto make = [&](const char* name, vtkSMProxy* input, unsigned int inputPort)
  {
    auto proxy = vtkSmartPointer<vtkSMSourceProxy>::Take(
      vtkSMSourceProxy::SafeDownCast(source->GetSessionProxyManager()->NewProxy("filters", name)));
    if (proxy)
    {
      vtkSMPropertyHelper(proxy, "Input").Set(input, inputPort);
    }
    return proxy;
  };
  const auto ofFirst = make("ReductionFilter", source, port);
  if (!ofFirst)
  {
    return nullptr;
  }
  vtkSMPropertyHelper(ofFirst, "PassThrough").Set(0);
  ofFirst->UpdateVTKObjects();
  ofFirst->UpdatePipeline();
  vtkPVDataInformation* data = ofFirst->GetDataInformation(0);
  const auto mover = data->GetDataSetType() >= 0 ? make("ClientServerMoveData", ofFirst, 0) : nullptr;
  if (!mover)
  {
    return nullptr;
  }
  vtkSMPropertyHelper(mover, "OutputDataType").Set(data->GetDataSetType());
  vtkSMPropertyHelper(mover, "WholeExtent").Set(data->GetExtent(), 6);
  mover->UpdateVTKObjects();
  mover->UpdatePipeline();
  auto* moved = vtkAlgorithm::SafeDownCast(mover->GetClientSideObject());
  return moved ? moved->GetOutputDataObject(0) : nullptr;
}

/// The one input of a diagnosis by this name; null: there is none.
vtkSMSourceProxy* inputOf(vtkSMProxy* diagnosis, const char* name)
{
  const vtkSMPropertyHelper input(diagnosis, name);
  return input.GetNumberOfElements() == 1 ? vtkSMSourceProxy::SafeDownCast(input.GetAsProxy()) : nullptr;
}

/// The parts at the poses of a diagnosis, where they are drawn in the view, in front of the scan.
vtkSmartPointer<vtkDataObject> drawnPartsOf(vtkSMProxy* diagnosis, vtkSMProxy* view)
{
  constexpr unsigned int Parts = 2; // output of MEAM Pose Estimation
  vtkSMSourceProxy* source = inputOf(diagnosis, "Poses");
  if (!source || std::strcmp(source->GetXMLName(), "MEAMPoseEstimation") != 0)
  {
    return nullptr;
  }
  const vtkSMPropertyHelper shown(view, "Representations");
  for (unsigned int k = 0; k < shown.GetNumberOfElements(); ++k)
  {
    vtkSMProxy* representation = shown.GetAsProxy(k);
    const vtkSMPropertyHelper input(representation, "Input", true);
    if (input.GetNumberOfElements() == 1 && input.GetAsProxy() == source && input.GetOutputPort() == Parts &&
        vtkSMPropertyHelper(representation, "Visibility").GetAsInt() != 0)
    {
      return dataOf(source, Parts);
    }
  }
  return nullptr;
}

/// What the mouse points at: of the parts that are drawn, or else of the scan; false: nothing.
bool findPlace(vtkSMProxy* diagnosis, vtkSMRenderViewProxy* view, double place[3])
{
  const int* mouse = view->GetInteractor()->GetEventPosition();
  const auto drawn = drawnPartsOf(diagnosis, view);
  auto* parts = vtkPolyData::SafeDownCast(drawn);
  if (parts && meetsMesh(parts, view->GetRenderer(), mouse, place))
  {
    return true;
  }
  const auto data = dataOf(inputOf(diagnosis, "Scene"), vtkSMPropertyHelper(diagnosis, "Scene").GetOutputPort());
  auto* scan = vtkPointSet::SafeDownCast(data);
  const vtkIdType found = scan ? pointAt(scan, view->GetRenderer(), mouse) : -1;
  if (found >= 0)
  {
    scan->GetPoint(found, place);
  }
  return found >= 0;
}

bool isDiagnosis(vtkSMProxy* proxy) { return std::strcmp(proxy->GetXMLName(), "PoseDiagnosis") == 0; }

class ScanPicking : public QObject
{
public:
  explicit ScanPicking(QMainWindow* window)
    : QObject(window)
    , Window(window)
  {
  }

  /// Accepts the keys before ParaView's shortcut gets them.
  bool eventFilter(QObject* object, QEvent* event) override
  {
    const bool isKey = event->type() == QEvent::ShortcutOverride || event->type() == QEvent::KeyPress;
    if (isKey && static_cast<QKeyEvent*>(event)->key() == Qt::Key_P)
    {
      pqPropertyWidget* point = this->shownPoint();
      auto* view = point ? qobject_cast<pqRenderView*>(point->view()) : nullptr;
      if (view && isPick(static_cast<QKeyEvent*>(event)->modifiers(), view->widget()) && inputOf(point->proxy(), "Scene"))
      {
        event->accept();
        if (event->type() == QEvent::KeyPress &&
            view->widget()->rect().contains(view->widget()->mapFromGlobal(QCursor::pos())))
        {
          pick(point, view->getRenderViewProxy());
        }
        return true;
      }
    }
    return QObject::eventFilter(object, event);
  }

private:
  /// P alone is a letter where a text is written.
  bool isPick(Qt::KeyboardModifiers modifiers, QWidget* view) const
  {
    return modifiers == Qt::ControlModifier ||
           (modifiers == Qt::NoModifier && view->isAncestorOf(this->Window->focusWidget()));
  }

  /// The point of the diagnosis in the panel; null: there is none.
  pqPropertyWidget* shownPoint() const
  {
    for (auto* widget : this->Window->findChildren<pqPropertyWidget*>())
    {
      if (widget->inherits("pqHandlePropertyWidget") && widget->isVisible() && isDiagnosis(widget->proxy()))
      {
        return widget;
      }
    }
    return nullptr;
  }

  static void pick(pqPropertyWidget* point, vtkSMRenderViewProxy* view)
  {
    double place[3];
    QApplication::setOverrideCursor(Qt::WaitCursor); // a server may be far away
    const bool isFound = findPlace(point->proxy(), view, place);
    QApplication::restoreOverrideCursor();
    if (isFound)
    {
      QMetaObject::invokeMethod(
        point, "setWorldPosition", Q_ARG(double, place[0]), Q_ARG(double, place[1]), Q_ARG(double, place[2]));
    }
  }

  QMainWindow* Window;
};

/// After Apply the keys are those of the picture again.
void giveFocusBack(pqProxy* applied)
{
  auto* view = pqActiveObjects::instance().activeView();
  auto* picture = view ? qobject_cast<pqQVTKWidget*>(view->widget()) : nullptr;
  if (applied && picture && isDiagnosis(applied->getProxy()))
  {
    picture->renderWidget()->setFocus();
  }
}
}

void addScanPicking(QMainWindow* window)
{
  qApp->installEventFilter(new ScanPicking(window));
  for (auto* panel : window->findChildren<pqPropertiesPanel*>())
  {
    QObject::connect(panel, QOverload<pqProxy*>::of(&pqPropertiesPanel::applied), panel, giveFocusBack);
  }
}
