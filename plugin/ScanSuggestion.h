// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// The panel of MEAM Pose Estimation says what the last scan suggests to change first. Called when ParaView loads the
/// plugin.
void addMEAMScanSuggestion();
