// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// The toolbar Pose Estimation, in the application alone. Its first button connects the part and the scan that are open
/// to a new MEAM Pose Estimation, and applies what is not applied yet; others show its scores and ask why a part was missed.
/// With it comes the tutorial. Called when ParaView loads the plugin.
void addMEAMToolBar();
