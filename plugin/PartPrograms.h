// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "PartFiles.h"

#include <QStringList>

/// Writes a program in Python and one in C++, with what builds it, that do what PartSearch did. `found`: what it told,
/// for a comment. Returns the names of the files. Throws std::runtime_error with a sentence when one cannot be written.
QStringList writePrograms(const PartFiles& part, const QString& found);
