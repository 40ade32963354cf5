// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class pqOutputPort;
class pqPipelineSource;

/// What is open in the application, for the buttons that take it: the one that is selected or, if none is, the one that
/// was opened last; null: there is none.

/// A CAD's mesh in its own coordinates, or a trained model.
pqOutputPort* openPart();
/// An organized cloud.
pqOutputPort* openScan();
/// A MEAM Pose Estimation.
pqPipelineSource* openEstimation();
