// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "PartFiles.h"

#include <QList>
#include <QPointer>
#include <QString>

class pqPipelineSource;

/// The part of a page New Part in its scan: the sources and filters that a user would have made, applied and shown.
class PartSearch
{
public:
  /// Makes them in place of those that the last call made, writes the trained model and the grasps, and returns what
  /// was found, in sentences. Throws std::runtime_error with a sentence that says what is wrong.
  QString run(const PartFiles& part);

private:
  class Steps;

  void removeLast();

  QList<QPointer<pqPipelineSource>> Made; ///< in their order
};
