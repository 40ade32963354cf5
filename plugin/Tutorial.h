// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class QMainWindow;

/// The entry PPFMEAM Tutorial of the menu Help: docs/tutorial.md beside the picture, and a button that
/// opens its example.
void addTutorial(QMainWindow* window);
