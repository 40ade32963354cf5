// SPDX-License-Identifier: BSD-3-Clause
#include "NewPart.h"

#include "PartPrograms.h"
#include "PartSearch.h"

#include "pqActiveObjects.h"
#include "pqFileChooserWidget.h"
#include "pqServer.h"

#include <QAction>
#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QMainWindow>
#include <QMenu>
#include <QPushButton>
#include <QRegularExpression>
#include <QScrollArea>
#include <QSpinBox>
#include <QVBoxLayout>

#include <exception>
#include <stdexcept>

namespace
{
constexpr int Width = 400;                // pixels
constexpr double LargestGripper = 1000.0; // mm, and what the filters have by default
constexpr double Opening = 60.0, CupDiameter = 20.0, FingerWidth = 12.0, FingerThickness = 8.0;

/// The fields, the button and the answer.
class Page : public QWidget
{
public:
  explicit Page(QWidget* parent)
    : QWidget(parent)
    , Form(new QFormLayout)
  {
    this->setObjectName("Page");
    this->Form->setRowWrapPolicy(QFormLayout::WrapLongRows);
    this->CAD = this->addFile("CAD", "CAD file", "CAD (*.step *.stp *.iges *.igs *.stl *.obj *.ply *.off)",
      "The part: STEP or IGES, or a mesh in mm (STL, OBJ, PLY, OFF).");
    this->Solid = this->add(new QSpinBox, "Solid", "Solid",
      "Of a STEP or IGES file with several solids the one that is the part, by its number; all: they are one part. The "
      "answer tells how large each is.");
    this->Solid->setSpecialValueText("all");
    this->CADUnit = this->addUnit("CADUnit", "CAD's unit", "The unit of a mesh. STEP and IGES files tell theirs.");
    this->Scan = this->addFile("Scan", "Scan", "Scan (*.pcd *.ply *.xyz *.csv *.txt *.asc *.pts *.png *.tif *.tiff *.pgm *.pfm)",
      "One scan of the bin: a cloud (PCD, PLY, or a text of points), best organized, or a depth image (PNG, TIFF, PGM, PFM).");
    this->Unit = this->addUnit(
      "Unit", "Scan's unit", "The unit of the cloud's points. A depth image has its own in the calibration.");
    this->Calibration = this->addFile("Calibration", "Calibration", "Calibration (*.yaml *.yml *.json *.xml)",
      "The calibration of the sensor (OpenCV, ROS, BOP): of depth images, and of clouds that are not organized. An "
      "organized cloud needs none.");
    this->Image = this->addFile("Image", "Image", "Image (*.png *.jpg *.jpeg *.bmp *.tif *.tiff)",
      "The sensor's image, where the scan has none of its own: a pixel for each point. Without an image the edges of "
      "the depth are used.");
    this->Gripper = this->add(new QComboBox, "Gripper", "Gripper",
      "What takes the parts. With a gripper grasps are proposed and picks are planned, too.");
    this->Gripper->addItems({ "None", "Parallel jaws", "Suction cup" });
    this->Size = this->addLength("Size", "Opening", "Between the jaws, at most; of a cup its diameter.");
    this->FingerWide = this->addLength("FingerWidth", "Finger width", "A finger across the direction of closing.");
    this->FingerWide->setValue(FingerWidth);
    this->FingerThick = this->addLength("FingerThickness", "Finger thickness",
      "A finger along the direction of closing. The gripper's other lengths are properties of Grasp Definition and "
      "Pick Planning.");
    this->FingerThick->setValue(FingerThickness);
    this->Bin = this->add(new QCheckBox("The parts lie in a bin"), "Bin", "",
      "The gripper keeps away from the bin, which is found by its rim in an organized scan. Off: down is the way the "
      "sensor looks.");
    this->Bin->setChecked(true);
    this->RobotFrame = this->addFile("RobotFrame", "Robot frame", "Robot frame (*.json *.yaml *.yml *.xml *.txt)",
      "Where the camera is for the robot (ppfmeam hand-eye, OpenCV, ROS): picks come out in the robot's frame.");
    this->Folder = this->addFile("Folder", "Write to", "",
      "The folder of the trained model, the grasps and the programs. Files of the same names in it are replaced.");
    this->Folder->setUseDirectoryMode(true);
    this->Start = new QPushButton("Train and Find", this);
    this->Start->setObjectName("Start");
    this->Start->setToolTip("Trains the part, finds it in the scan, shows it, and writes the model and the programs.");
    this->Answer = new QLabel("Choose a CAD file and a scan. The rest may stay as it is.", this);
    this->Answer->setObjectName("Answer");
    this->Answer->setToolTip("What was found and written, or what is wrong.");
    this->Answer->setWordWrap(true);
    this->Answer->setTextFormat(Qt::PlainText);
    this->Answer->setTextInteractionFlags(Qt::TextSelectableByMouse);
    auto* layout = new QVBoxLayout(this); // where there is little room the fields scroll, and the answer stays
    layout->addWidget(makeScrolled(this->Form));
    layout->addWidget(this->Start);
    layout->addWidget(this->Answer);
    QObject::connect(this->Start, &QPushButton::clicked, this, [this] { this->run(); });
    QObject::connect(this->CAD, &pqFileChooserWidget::filenameChanged, this, [this] { this->showCAD(); });
    QObject::connect(
      this->Gripper, QOverload<int>::of(&QComboBox::currentIndexChanged), this, [this] { this->showGripper(); });
    this->showCAD();
    this->showGripper();
  }

private:
  static QScrollArea* makeScrolled(QLayout* layout)
  {
    auto* fields = new QWidget;
    fields->setObjectName("Fields");
    fields->setLayout(layout);
    auto* area = new QScrollArea;
    area->setObjectName("Area");
    area->setFrameShape(QFrame::NoFrame);
    area->setWidgetResizable(true);
    area->setWidget(fields);
    return area;
  }

  template <typename Field>
  Field* add(Field* field, const char* name, const char* label, const char* tip)
  {
    field->setObjectName(name);
    field->setToolTip(tip);
    this->Form->addRow(label, field);
    if (QWidget* text = this->Form->labelForField(field))
    {
      text->setToolTip(tip);
    }
    return field;
  }

  QDoubleSpinBox* addLength(const char* name, const char* label, const char* tip)
  {
    QDoubleSpinBox* length = this->add(new QDoubleSpinBox, name, label, tip);
    length->setMaximum(LargestGripper);
    length->setSuffix(" mm");
    return length;
  }

  QComboBox* addUnit(const char* name, const char* label, const char* tip)
  {
    QComboBox* unit = this->add(new QComboBox, name, label, tip);
    unit->addItem("mm", 1.0);
    unit->addItem("cm", 10.0);
    unit->addItem("m", 1000.0);
    unit->addItem("inch", 25.4);
    return unit;
  }

  pqFileChooserWidget* addFile(const char* name, const char* label, const char* kinds, const char* tip)
  {
    pqFileChooserWidget* chooser = this->add(new pqFileChooserWidget(this), name, label, tip);
    chooser->setForceSingleFile(true);
    chooser->setExtension(kinds);
    chooser->setTitle(label);
    return chooser;
  }

  /// Where it is written to unless another folder is chosen.
  QString ownFolder() const
  {
    const QFileInfo cad(this->CAD->singleFilename());
    return cad.filePath().isEmpty() ? QString() : cad.dir().filePath("find_" + this->files().name());
  }

  void showCAD()
  {
    this->Folder->findChild<QLineEdit*>()->setPlaceholderText(this->ownFolder());
    this->Solid->setValue(0);
    this->Solid->setEnabled(this->files().hasSolids());
    this->CADUnit->setEnabled(!this->files().hasSolids());
  }

  void showGripper()
  {
    const int gripper = this->Gripper->currentIndex();
    qobject_cast<QLabel*>(this->Form->labelForField(this->Size))
      ->setText(gripper == PartFiles::Cup ? "Diameter" : "Opening");
    this->Size->setValue(gripper == PartFiles::Cup ? CupDiameter : Opening);
    this->Size->setEnabled(gripper != PartFiles::NoGripper);
    this->FingerWide->setEnabled(gripper == PartFiles::Jaws);
    this->FingerThick->setEnabled(gripper == PartFiles::Jaws);
    this->Bin->setEnabled(gripper != PartFiles::NoGripper);
    this->RobotFrame->setEnabled(gripper != PartFiles::NoGripper);
  }

  PartFiles files() const
  {
    PartFiles part;
    part.cad = this->CAD->singleFilename();
    part.solid = this->Solid->value();
    part.cadScale = part.hasSolids() ? 1.0 : this->CADUnit->currentData().toDouble();
    part.scan = this->Scan->singleFilename();
    part.scanScale = part.isDepthImage() ? 1.0 : this->Unit->currentData().toDouble();
    part.calibration = this->Calibration->singleFilename();
    part.image = this->Image->singleFilename();
    part.gripper = static_cast<PartFiles::Gripper>(this->Gripper->currentIndex());
    part.gripperSize = this->Size->value();
    part.fingerWidth = this->FingerWide->value();
    part.fingerThickness = this->FingerThick->value();
    part.hasBin = this->Bin->isChecked();
    part.robotFrame = this->RobotFrame->isEnabled() ? this->RobotFrame->singleFilename() : QString();
    part.folder = this->Folder->singleFilename();
    return part;
  }

  /// Throws what has to be changed before anything can be done.
  static void require(const PartFiles& part)
  {
    const auto fail = [](const QString& sentence) { throw std::runtime_error(sentence.toStdString()); };
    if (pqActiveObjects::instance().activeServer()->isRemote())
    {
      fail("This page takes files of this computer: disconnect ParaView from the server first.");
    }
    if (part.cad.isEmpty() || part.scan.isEmpty())
    {
      fail(part.cad.isEmpty() ? "Choose a CAD file." : "Choose a scan.");
    }
    for (const QString& file : { part.cad, part.scan, part.calibration, part.image, part.robotFrame })
    {
      if (!file.isEmpty() && !QFileInfo(file).isFile())
      {
        fail("There is no file " + file + ".");
      }
    }
    if (!part.reader())
    {
      fail(part.scan + " is no scan: choose a PCD, a PLY, a text of points (XYZ, CSV, TXT, ASC, PTS), or a depth image as "
                       "PNG, TIFF, PGM or PFM.");
    }
  }

  /// With the fields of this page in place of what filters and programs have for them.
  static QString worded(QString text)
  {
    return text.replace("(CADScale)", "(CAD's unit)")
      .replace("(Scale of its reader)", "(Scan's unit)")
      .replace(QRegularExpression("Give the place and the size of the bin, or do without one \\(--no-bin;.*C\\+\\+\\)\\."),
        "Say that the parts lie in no bin, or scan all of it.");
  }

  void run()
  {
    PartFiles part = this->files();
    part.folder = QFileInfo(part.folder.isEmpty() ? this->ownFolder() : part.folder).absoluteFilePath();
    this->Start->setEnabled(false);
    this->Answer->setText("Training and finding. The progress is at the bottom of the window.");
    this->Answer->repaint();
    try
    {
      require(part);
      const QString found = worded(this->Search.run(part));
      const QStringList programs = writePrograms(part, found);
      this->Answer->setText(found + "\n\nIn " + part.folder +
                            " are the trained model and programs that find it in any scan: " + programs.join(", ") +
                            ".\n\nA part was missed or is wrong? Click the question mark of the toolbar.");
    }
    catch (const std::exception& error)
    {
      this->Answer->setText(worded(error.what()));
    }
    this->Start->setEnabled(true);
  }

  QFormLayout* Form;
  pqFileChooserWidget *CAD, *Scan, *Calibration, *Image, *RobotFrame, *Folder;
  QComboBox *CADUnit, *Unit, *Gripper;
  QSpinBox* Solid;
  QDoubleSpinBox *Size, *FingerWide, *FingerThick;
  QCheckBox* Bin;
  QPushButton* Start;
  QLabel* Answer;
  PartSearch Search;
};

QDockWidget* makePage(QMainWindow* window)
{
  auto* dock = new QDockWidget("PPFMEAM: New Part", window);
  dock->setObjectName("PPFMEAMNewPart");
  dock->setWidget(new Page(dock));
  window->addDockWidget(Qt::RightDockWidgetArea, dock);
  window->resizeDocks({ dock }, { Width }, Qt::Horizontal);
  return dock;
}
}

void addNewPart(QMainWindow* window)
{
  auto* help = window->findChild<QMenu*>("menu_Help");
  if (!help)
  {
    return;
  }
  QAction* entry = help->addAction("PPFMEAM: New Part");
  entry->setObjectName("actionPPFMEAMNewPart");
  QObject::connect(entry, &QAction::triggered, window,
    [window]
    {
      auto* dock = window->findChild<QDockWidget*>("PPFMEAMNewPart");
      (dock ? dock : makePage(window))->show();
    });
}
