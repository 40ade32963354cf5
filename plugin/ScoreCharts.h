// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class pqPipelineSource;

/// Bars of the scores of a MEAM Pose Estimation's poses and of the time of its stages, beside the picture of the poses.
/// Nothing when they are shown already.
void showScoreCharts(pqPipelineSource* estimation);
