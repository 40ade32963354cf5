// SPDX-License-Identifier: BSD-3-Clause
#include "OpenedFiles.h"

#include "pqApplicationCore.h"
#include "pqObjectBuilder.h"
#include "pqPipelineSource.h"
#include "vtkMEAMXYZReader.h"
#include "vtkNew.h"
#include "vtkOutputWindow.h"
#include "vtkSMSourceProxy.h"

#include <QFile>
#include <QFileInfo>
#include <QPointer>
#include <QTimer>
#include <QtEndian>

#include <algorithm>
#include <iterator>
#include <utility>

namespace
{
constexpr int Header = 80, Counted = Header + 4, Triangle = 50; // bytes of a binary STL

/// The kind that the first bytes tell; null: none that is known.
const char* kindOf(const QByteArray& start)
{
  const std::pair<QByteArray, const char*> kinds[] = { { "\x89PNG", "a PNG image" }, { "\xff\xd8\xff", "a JPEG image" },
    { "II*", "a TIFF image" }, { QByteArray("MM\0*", 4), "a TIFF image" }, { "GIF8", "a GIF image" }, { "%PDF", "a PDF" },
    { "PK\x03\x04", "a ZIP archive" }, { "# .PCD", "a PCD cloud" }, { "ply\n", "a PLY file" }, { "ply\r", "a PLY file" },
    { "ISO-10303-21", "a STEP file" } };
  const auto* const kind = std::find_if(
    std::begin(kinds), std::end(kinds), [&](const auto& known) { return start.startsWith(known.first); });
  return kind == std::end(kinds) ? nullptr : kind->second;
}

/// What a file is that can be no OBJ; empty: it can.
QString otherThanOBJ(const QByteArray& start)
{
  if (const char* kind = kindOf(start))
  {
    return QString("it is no OBJ but %1").arg(kind);
  }
  const QByteArray first = start.trimmed().toLower();
  const bool isSTL = first.startsWith("solid") && (first.size() == 5 || QByteArray(" \t\r\n").contains(first[5]));
  return isSTL ? "it is no OBJ but an STL file" : start.contains('\0') ? "it is no OBJ: its bytes are no text" : QString();
}

/// What a file is that can be no STL; empty: it can.
QString otherThanSTL(const QFile& file, const QByteArray& start)
{
  const qint64 promised = start.size() < Counted ? -1 : qFromLittleEndian<quint32>(start.constData() + Header);
  const qint64 there = (file.size() - Counted) / Triangle;
  if (promised == there) // a binary one, whatever its header
  {
    return {};
  }
  if (const char* kind = kindOf(start))
  {
    return QString("it is no STL but %1").arg(kind);
  }
  const bool isASCII = std::all_of(start.begin(), start.end(), [](char letter) { return (letter & 0x80) == 0; });
  const bool isSolid = start.mid(start.startsWith("\xef\xbb\xbf") ? 3 : 0).trimmed().toLower().startsWith("solid");
  const bool isText = !start.contains('\0') && (isASCII || isSolid);
  if (isText || start.size() < Counted)
  {
    return {};
  }
  return promised > 2 * there + 1 // a file that is cut off may have half
    ? QString("it is no STL, or damaged: it promises %1 triangles and has room for %2").arg(promised).arg(there)
    : QString();
}

/// Of a file that one of ParaView's readers would read; empty: it can, or it is on another computer.
QString otherThan(const QString& reader, const QString& path)
{
  QFile file(path);
  const bool isMesh = reader == "stlreader" || reader == "objreader", isGrid = reader == "P3DReader";
  if ((!isMesh && !isGrid) || !file.open(QIODevice::ReadOnly))
  {
    return {};
  }
  if (isGrid) // ParaView proposes it first for .xyz
  {
    const bool arePoints = vtkNew<vtkMEAMXYZReader>()->CanReadFile(path.toUtf8().constData()) != 0;
    return arePoints ? "it is no PLOT3D grid, which ParaView proposes first: choose XYZ Cloud Reader" : QString();
  }
  const QByteArray start = file.read(Counted);
  return start.isEmpty() ? "it is empty" : reader == "stlreader" ? otherThanSTL(file, start) : otherThanOBJ(start);
}

void closeOther(pqPipelineSource* source, const QStringList& files)
{
  if (!source)
  {
    return;
  }
  for (const QString& file : files)
  {
    const QString other = otherThan(source->getSourceProxy()->GetXMLName(), file);
    if (!other.isEmpty())
    {
      const QString said = QString("%1 was not opened: %2.\n").arg(QFileInfo(file).fileName(), other);
      QTimer::singleShot(0, // ParaView goes on with the source
        [opened = QPointer<pqPipelineSource>(source), said]
        {
          if (opened)
          {
            pqApplicationCore::instance()->getObjectBuilder()->destroy(opened);
            vtkOutputWindow::GetInstance()->DisplayErrorText(said.toUtf8().constData());
          }
        });
      return;
    }
  }
}
}

void addOpenedFiles(QObject* window)
{
  QObject::connect(pqApplicationCore::instance()->getObjectBuilder(),
    QOverload<pqPipelineSource*, const QStringList&>::of(&pqObjectBuilder::readerCreated), window, closeOther);
}
