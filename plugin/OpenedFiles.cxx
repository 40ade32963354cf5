// SPDX-License-Identifier: BSD-3-Clause
#include "OpenedFiles.h"

#include "pqApplicationCore.h"
#include "pqObjectBuilder.h"
#include "pqPipelineSource.h"
#include "vtkOutputWindow.h"
#include "vtkSMSourceProxy.h"

#include <QFile>
#include <QFileInfo>
#include <QPointer>
#include <QTimer>
#include <QtEndian>

#include <algorithm>
#include <cstring>
#include <utility>

namespace
{
/// What a file is that can be no STL; empty: it can, or it is on another computer.
QString otherThanSTL(const QString& path)
{
  constexpr int Header = 80, Counted = Header + 4, Triangle = 50; // bytes of a binary STL
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly))
  {
    return {};
  }
  const QByteArray start = file.read(Counted);
  if (start.isEmpty())
  {
    return "it is empty";
  }
  const qint64 promised = start.size() < Counted ? -1 : qFromLittleEndian<quint32>(start.constData() + Header);
  const qint64 there = (file.size() - Counted) / Triangle;
  if (promised == there) // a binary one, whatever its header
  {
    return {};
  }
  const std::pair<QByteArray, const char*> kinds[] = { { "\x89PNG", "a PNG image" }, { "\xff\xd8\xff", "a JPEG image" },
    { "II*", "a TIFF image" }, { QByteArray("MM\0*", 4), "a TIFF image" }, { "GIF8", "a GIF image" }, { "%PDF", "a PDF" },
    { "PK\x03\x04", "a ZIP archive" }, { "# .PCD", "a PCD cloud" }, { "ply\n", "a PLY file" }, { "ply\r", "a PLY file" },
    { "ISO-10303-21", "a STEP file" } };
  for (const auto& [bytes, kind] : kinds)
  {
    if (start.startsWith(bytes))
    {
      return QString("it is no STL but %1").arg(kind);
    }
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

void closeOther(pqPipelineSource* source, const QStringList& files)
{
  if (!source || std::strcmp(source->getSourceProxy()->GetXMLName(), "stlreader") != 0)
  {
    return;
  }
  for (const QString& file : files)
  {
    const QString other = otherThanSTL(file);
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
