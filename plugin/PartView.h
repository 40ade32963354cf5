// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Keeps apart what lies in the part's frame and what lies in the scan's: where a scan is seen from the sensor, a step of
/// the part that is applied comes up in a view beside it, with the part.
void addPartView();
