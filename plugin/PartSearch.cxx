// SPDX-License-Identifier: BSD-3-Clause
#include "PartSearch.h"

#include "ShownData.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqCoreUtilities.h"
#include "pqObjectBuilder.h"
#include "pqOutputPort.h"
#include "pqPipelineSource.h"
#include "pqPropertiesPanel.h"
#include "pqServer.h"
#include "pqUndoStack.h"
#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"

#include <QDir>
#include <QMainWindow>
#include <QMap>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{
constexpr int ModelOutput = 6; // of MEAM Pose Estimation
constexpr double Likely = 0.5; // poses that are there more likely than not

using Inputs = QMap<QString, QList<pqOutputPort*>>;

/// What sources say goes wrong while this lives, in place of the window Output Messages.
class Messages
{
public:
  Messages() = default;
  Messages(const Messages&) = delete;
  void operator=(const Messages&) = delete;

  ~Messages()
  {
    for (const auto& [algorithm, tag] : this->Heard)
    {
      algorithm->RemoveObserver(tag);
    }
  }

  void listen(vtkSMProxy* proxy)
  {
    if (auto* algorithm = vtkAlgorithm::SafeDownCast(proxy->GetClientSideObject()))
    {
      this->Heard.emplace_back(algorithm, algorithm->AddObserver(vtkCommand::ErrorEvent, this, &Messages::onError));
      this->Heard.emplace_back(algorithm, algorithm->AddObserver(vtkCommand::WarningEvent, this, &Messages::onWarning));
    }
  }

  QString error, warning; ///< the first one

private:
  void onError(vtkObject*, unsigned long, void* text) { keep(this->error, text); }
  void onWarning(vtkObject*, unsigned long, void* text) { keep(this->warning, text); }

  /// Without the line of the source and the object that VTK puts before it.
  static void keep(QString& first, void* text)
  {
    if (first.isEmpty())
    {
      first = QString::fromUtf8(static_cast<const char*>(text)).section("): ", 1).trimmed();
    }
  }

  std::vector<std::pair<vtkSmartPointer<vtkAlgorithm>, unsigned long>> Heard;
};

void applyAll()
{
  if (auto* panel = pqCoreUtilities::mainWidget()->findChild<pqPropertiesPanel*>())
  {
    panel->apply();
  }
}

/// An output as data of this process.
vtkDataObject* dataOf(pqPipelineSource* source, int port = 0)
{
  return vtkAlgorithm::SafeDownCast(source->getProxy()->GetClientSideObject())->GetOutputDataObject(port);
}

QString fieldText(vtkDataObject* data, const char* name)
{
  auto* text = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(name));
  return text && text->GetNumberOfValues() > 0 ? QString::fromStdString(text->GetValue(0)) : QString();
}

/// How many poses are likely, how large the part is, which tells a wrong unit, and what to change first.
QString describePoses(vtkDataObject* data)
{
  QStringList sentences{ fieldText(data, "Report") };
  vtkDataArray* likely = vtkDataSet::SafeDownCast(data)->GetPointData()->GetArray("PlaceProbability");
  const double surest = likely && likely->GetNumberOfTuples() > 0 ? likely->GetRange()[1] : 0.0;
  if (surest > Likely)
  {
    sentences += QString("The surest is there with %1 %.").arg(std::lround(100.0 * surest));
  }
  if (vtkDataArray* diameter = data->GetFieldData()->GetArray("Diameter"))
  {
    sentences += QString("The part is %1 mm long.").arg(diameter->GetTuple1(0), 0, 'f', 1);
  }
  sentences += fieldText(data, "Advice");
  sentences.removeAll(QString());
  return sentences.join(' ');
}
}

/// Sources and filters as they are made, one after the other.
class PartSearch::Steps
{
public:
  explicit Steps(QList<QPointer<pqPipelineSource>>& made)
    : Made(made)
  {
  }

  pqPipelineSource* open(const char* reader, const QString& file)
  {
    pqPipelineSource* source = this->builder()->createSource("sources", reader, this->server());
    this->keep(source);
    set(source, "FileName", file.toStdString().c_str());
    return source;
  }

  pqPipelineSource* openCAD(const PartFiles& part)
  {
    pqPipelineSource* cad = this->open("MEAMMeshReader", part.cad);
    set(cad, "Solid", part.solid);
    this->update(cad);
    return cad;
  }

  /// A CAD file of another unit.
  pqPipelineSource* inMillimeters(pqPipelineSource* cad, double scale)
  {
    if (scale == 1.0)
    {
      return cad;
    }
    pqPipelineSource* mesh = this->filter("MeshPreparation", { { "Input", { cad->getOutputPort(0) } } });
    set(mesh, "Scale", scale);
    this->update(mesh);
    leaveHidden(mesh);
    return mesh;
  }

  pqPipelineSource* openScan(const PartFiles& part)
  {
    pqPipelineSource* scan = this->open(part.reader(), part.scan);
    set(scan, "CameraFile", part.calibration.toStdString().c_str());
    if (!part.isDepthImage())
    {
      set(scan, "Scale", part.scanScale);
    }
    this->update(scan);
    if (part.gripper != PartFiles::NoGripper && part.hasBin &&
        !isOrganized(scan->getOutputPort(0)->getDataInformation()))
    {
      throw std::runtime_error(
        "No bin is found among points that are not organized: say that the parts lie in no bin, or choose the "
        "sensor's calibration.");
    }
    return scan;
  }

  /// All poses, likely or not.
  pqPipelineSource* find(pqPipelineSource* cad, pqPipelineSource* scan, const QString& imageFile)
  {
    Inputs inputs{ { "Input", { cad->getOutputPort(0) } }, { "Scene", { scan->getOutputPort(0) } } };
    if (!imageFile.isEmpty())
    {
      pqPipelineSource* image = this->open("MEAMImageReader", imageFile);
      this->update(image);
      leaveHidden(image);
      inputs["Image"] = { image->getOutputPort(0) };
    }
    pqPipelineSource* poses = this->filter("MEAMPoseEstimation", inputs);
    set(poses, "MaximumNumberOfPoses", 0);
    this->update(poses);
    applyAll();
    return poses;
  }

  /// Grasps, which are written, and picks of the likely poses; null where none is.
  pqPipelineSource* plan(pqPipelineSource* cad, pqPipelineSource* scan, pqPipelineSource* poses, const PartFiles& part)
  {
    const bool isCup = part.gripper == PartFiles::Cup;
    set(poses, "MinimumProbability", Likely);
    this->update(poses);
    pqPipelineSource* grasps = this->filter("GraspDefinition",
      { { "Input", { cad->getOutputPort(0) } }, { "Symmetries", { poses->getOutputPort(ModelOutput) } } });
    set(grasps, "Propose", isCup ? 2 : 1); // suction or parallel jaws
    setLengths(grasps, part);
    this->update(grasps);
    if (vtkPointSet::SafeDownCast(dataOf(grasps))->GetNumberOfPoints() == 0)
    {
      throw std::runtime_error(std::string("The part has no place for this gripper: give ") +
                               (isCup ? "a smaller cup" : "another opening, thinner fingers, or a cup") +
                               ", or None to find the part alone.");
    }
    leaveHidden(grasps);
    if (vtkDataSet::SafeDownCast(dataOf(poses))->GetNumberOfPoints() == 0)
    {
      this->write("GraspWriter", grasps, 0, part.graspFile());
      return nullptr;
    }
    pqPipelineSource* picks = this->filter(
      "PickPlanning", { { "Input", { poses->getOutputPort(0) } }, { "Mesh", { cad->getOutputPort(0) } },
                        { "Grasps", { grasps->getOutputPort(0) } }, { "Scan", { scan->getOutputPort(0) } } });
    set(picks, "Gripper", isCup ? 1 : 0); // suction cup or parallel jaws
    setLengths(picks, part);
    set(picks, "Bin", part.hasBin ? 0 : 2); // detected or none
    set(picks, "RobotFrameFile", part.robotFrame.toStdString().c_str());
    this->update(picks);
    this->write("GraspWriter", grasps, 0, part.graspFile());
    applyAll();
    return picks;
  }

  void update(pqPipelineSource* source) { this->update(source->getSourceProxy()); }

  void write(const char* writer, pqPipelineSource* source, int port, const QString& file)
  {
    auto proxy = vtkSmartPointer<vtkSMProxy>::Take(source->getServer()->proxyManager()->NewProxy("writers", writer));
    vtkSMPropertyHelper(proxy, "Input").Set(source->getProxy(), port);
    vtkSMPropertyHelper(proxy, "FileName").Set(file.toStdString().c_str());
    proxy->UpdateVTKObjects();
    this->Said.listen(proxy);
    this->update(vtkSMSourceProxy::SafeDownCast(proxy));
  }

  /// Applying what has been made shows it.
  static void leaveHidden(pqPipelineSource* source) { source->setModifiedState(pqProxy::UNMODIFIED); }

  QString warning() const { return this->Said.warning; }

private:
  template <typename Value>
  static void set(pqPipelineSource* source, const char* property, Value value)
  {
    vtkSMPropertyHelper(source->getProxy(), property).Set(value);
  }

  static void setLengths(pqPipelineSource* source, const PartFiles& part)
  {
    const bool isCup = part.gripper == PartFiles::Cup;
    set(source, isCup ? "CupDiameter" : "Opening", part.gripperSize);
    if (!isCup)
    {
      set(source, "FingerWidth", part.fingerWidth);
      set(source, "FingerThickness", part.fingerThickness);
    }
  }

  pqPipelineSource* filter(const char* name, const Inputs& inputs)
  {
    pqPipelineSource* source = this->builder()->createFilter("filters", name, inputs, this->server());
    this->keep(source);
    return source;
  }

  static pqObjectBuilder* builder() { return pqApplicationCore::instance()->getObjectBuilder(); }
  static pqServer* server() { return pqActiveObjects::instance().activeServer(); }

  void keep(pqPipelineSource* source)
  {
    this->Made.append(source);
    this->Said.listen(source->getProxy());
  }

  void update(vtkSMSourceProxy* proxy)
  {
    proxy->UpdateVTKObjects();
    proxy->UpdatePipeline();
    if (!this->Said.error.isEmpty())
    {
      throw std::runtime_error(this->Said.error.toStdString());
    }
  }

  QList<QPointer<pqPipelineSource>>& Made;
  Messages Said;
};

void PartSearch::removeLast()
{
  while (!this->Made.empty())
  {
    QPointer<pqPipelineSource> last = this->Made.takeLast();
    if (last && last->getAllConsumers().empty()) // a user may have gone on with it
    {
      pqApplicationCore::instance()->getObjectBuilder()->destroy(last);
    }
  }
}

QString PartSearch::run(const PartFiles& part)
{
  BEGIN_UNDO_SET("New part");
  this->removeLast();
  QString told;
  try
  {
    Steps steps(this->Made);
    pqPipelineSource* cad = steps.openCAD(part);
    Steps::leaveHidden(cad);
    pqPipelineSource* scan = steps.openScan(part);
    applyAll();
    pqPipelineSource* mesh = steps.inMillimeters(cad, part.cadScale);
    pqPipelineSource* poses = steps.find(mesh, scan, part.image);
    told = (fieldText(dataOf(cad), "CADReport") + "\n" + describePoses(dataOf(poses))).trimmed();
    if (!QDir().mkpath(part.folder))
    {
      throw std::runtime_error(("The folder " + part.folder + " cannot be made: choose another one.").toStdString());
    }
    if (part.gripper != PartFiles::NoGripper)
    {
      pqPipelineSource* picks = steps.plan(mesh, scan, poses, part);
      told += "\n" + (picks ? fieldText(dataOf(picks), "PickReport") // what to change stands in the view
                            : QString("No picks are planned: no copy is more likely there than not."));
    }
    steps.write("ModelWriter", poses, ModelOutput, part.modelFile()); // last: what an earlier run wrote belongs together
    if (!told.contains(steps.warning())) // one says the same as the report
    {
      told += "\n" + steps.warning();
    }
  }
  catch (const std::runtime_error&)
  {
    this->removeLast();
    END_UNDO_SET();
    throw;
  }
  END_UNDO_SET();
  return told.trimmed();
}
