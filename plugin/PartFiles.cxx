// SPDX-License-Identifier: BSD-3-Clause
#include "PartFiles.h"

#include <QDir>
#include <QFileInfo>
#include <QRegularExpression>
#include <QStringList>

QString PartFiles::name() const
{
  return QFileInfo(this->cad).completeBaseName().replace(QRegularExpression("[^A-Za-z0-9_]"), "_");
}

bool PartFiles::hasSolids() const
{
  return QStringList{ "step", "stp", "iges", "igs" }.contains(QFileInfo(this->cad).suffix().toLower());
}

bool PartFiles::isDepthImage() const
{
  return QStringList{ "png", "tif", "tiff", "pgm", "pfm" }.contains(QFileInfo(this->scan).suffix().toLower());
}

const char* PartFiles::reader() const
{
  const QString kind = QFileInfo(this->scan).suffix().toLower();
  return this->isDepthImage()                                           ? "DepthImageReader"
    : kind == "pcd"                                                     ? "PCDReader"
    : kind == "ply"                                                     ? "PLYCloudReader"
    : QStringList{ "xyz", "csv", "txt", "asc", "pts" }.contains(kind) ? "XYZCloudReader"
                                                                        : nullptr;
}

QString PartFiles::modelFile() const { return QDir(this->folder).filePath(this->name() + ".meam"); }

QString PartFiles::graspFile() const { return QDir(this->folder).filePath(this->name() + ".grasps.json"); }
