// SPDX-License-Identifier: BSD-3-Clause
#include "PartPrograms.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QMap>
#include <QSaveFile>

#include <algorithm>
#include <stdexcept>

namespace
{
/// A text of Python and of C++.
QString quoted(QString text)
{
  return "\"" + text.replace("\\", "\\\\").replace("\"", "\\\"").replace("\n", "\\n") + "\"";
}

/// A text of a comment: in one line, and with nothing that ends it or goes on after it.
QString remark(QString text) { return text.replace('\n', ' ').replace('\\', '/').replace('"', '\''); }

/// Words of a template, @NAME@, and what they stand for.
QMap<QString, QString> wordsOf(const PartFiles& part, const QString& found)
{
  return { { "NAME", part.name() }, { "SCAN_NAME", remark(QFileInfo(part.scan).fileName()) },
    { "FOUND", remark(found) }, { "CAD", quoted(part.cad) }, { "SCAN", quoted(part.scan) },
    { "CHOSEN", part.solid > 0          ? QString(", solid=%1").arg(part.solid)
                : part.cadScale != 1.0 ? QString(", scale=%1").arg(part.cadScale)
                                       : QString() },
    { "CAD_SCALE", QString::number(part.cadScale) },
    { "SOLID", QString::number(part.solid) }, { "MODEL", quoted(part.modelFile()) }, { "GRASPS", quoted(part.graspFile()) },
    { "CALIBRATION", quoted(part.calibration) }, { "IMAGE", quoted(part.image) },
    { "ROBOT_FRAME", quoted(part.robotFrame) }, { "SCALE", QString::number(part.scanScale) },
    { "SIZE", QString::number(part.gripperSize) }, { "FINGER_WIDTH", QString::number(part.fingerWidth) },
    { "FINGER_THICKNESS", QString::number(part.fingerThickness) } };
}

/// What lines of a template ask for that begin with "?NAME ", and those that hold.
QStringList conditionsOf(const PartFiles& part)
{
  const QMap<QString, bool> all{ { "picks", part.gripper != PartFiles::NoGripper },
    { "cup", part.gripper == PartFiles::Cup }, { "bin", part.hasBin }, { "robot", !part.robotFrame.isEmpty() },
    { "calibration", !part.calibration.isEmpty() }, { "image", !part.image.isEmpty() },
    { "scale", part.scanScale != 1.0 }, { "depth", part.isDepthImage() }, { "solid", part.hasSolids() },
    { "chosen", part.solid > 0 }, { "unit", part.cadScale != 1.0 } };
  return all.keys(true);
}

/// Of "?NAME+!NAME " whether the first holds and the second does not.
bool holds(const QString& asked, const QStringList& conditions)
{
  const QStringList names = asked.mid(1).split('+');
  return std::all_of(names.begin(), names.end(),
    [&](const QString& name) { return conditions.contains(QString(name).remove('!')) != name.startsWith('!'); });
}

QString filled(const QString& resource, const QMap<QString, QString>& words, const QStringList& conditions)
{
  QFile file(resource);
  file.open(QIODevice::ReadOnly);
  QString text;
  for (QString line : QString::fromUtf8(file.readAll()).split('\n'))
  {
    if (line.startsWith('?'))
    {
      if (!holds(line.section(' ', 0, 0), conditions))
      {
        continue;
      }
      line = line.section(' ', 1);
    }
    text += line + "\n";
  }
  text.chop(1); // after the last line there is none
  QString result;
  for (const QString& piece : text.split('@')) // one after the other: a file's name may have words, too
  {
    result += words.value(piece, piece);
  }
  return result;
}
}

QStringList writePrograms(const PartFiles& part, const QString& found)
{
  const QMap<QString, QString> words = wordsOf(part, found);
  const QStringList conditions = conditionsOf(part);
  QStringList names;
  for (const char* name : { "find_part.py", "find_part.cpp", "CMakeLists.txt" })
  {
    names += QString(name).replace("part", part.name());
    QSaveFile file(QDir(part.folder).filePath(names.last()));
    const QByteArray text = filled(QString(":/PPFMEAM/programs/%1.in").arg(name), words, conditions).toUtf8();
    if (!file.open(QIODevice::WriteOnly) || file.write(text) != text.size() || !file.commit())
    {
      throw std::runtime_error((file.fileName() + " cannot be written: choose another folder.").toStdString());
    }
  }
  return names;
}
