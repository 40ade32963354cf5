// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QList>

class pqOutputPort;
class pqPipelineSource;

/// What is open in the application, for the buttons that take it: the one that is selected or, if none is, the one that
/// was opened last; null: there is none.

/// CADs' meshes in their own coordinates, be they empty, or trained models: all that are selected together; empty: there
/// is none.
QList<pqOutputPort*> openParts();
/// A CAD file without triangles, as a damaged one may be.
bool isEmptyPart(pqOutputPort* port);
/// An organized cloud.
pqOutputPort* openScan();
/// A MEAM Pose Estimation.
pqPipelineSource* openEstimation();
