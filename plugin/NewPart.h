// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class QMainWindow;

/// The entry PPFMEAM: New Part of the menu Help: a page that asks for the files of a part, trains it, finds it in a
/// scan, and writes the trained model and programs that do the same.
void addNewPart(QMainWindow* window);
