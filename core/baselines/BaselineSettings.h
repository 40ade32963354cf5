// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/MEAMPoseEstimation.h"

namespace meam
{
// The paper's settings (Section 6), stage by stage.
PoseDetectionSettings paperDetectionSettings();
PoseVerificationSettings paperVerificationSettings();
PoseSelectionSettings paperSelectionSettings();
PoseRefinementSettings paperRefinementSettings();

/// Of the original pair feature (Drost et al. 2010): every fifth surface point is a reference.
PoseDetectionSettings originalDetectionSettings();
/// Of the methods that rank poses by their votes.
PoseVerificationSettings votesVerificationSettings();
/// The same before refinement.
PoseSelectionSettings votesSelectionSettings();

/// All stages of a preset other than the recommended one.
DetectionSettings baselineSettings(Preset preset);
}
