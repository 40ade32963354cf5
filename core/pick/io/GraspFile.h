// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pick/Grasp.h"

#include <string>

namespace meam
{
/// Reads the grasps of a part: JSON with `format` "meam-grasps", `version` 1, `units` "mm" and the list `grasps`, each
/// an object with `kind` ("parallel", "suction"), `position`, `approach`, `closing` (three numbers each; directions of
/// any length, closing is made perpendicular to the approach), `width`, and, where they are not the defaults, `name`
/// ("grasp 1" for the first), `free_turn` ("none", "approach", "closing") and `quality` (1). A cup needs no width and
/// no closing; without closing it may be turned about its approach unless `free_turn` says otherwise. Throws Error, in
/// a sentence that names the file, the grasp and its entry, for what is missing, wrong, unknown, or named twice.
Grasps readGrasps(const std::string& path);

/// Writes such a file, a line for each grasp, with enough digits to read the same numbers back; a frame comes back
/// within rounding. Throws Error for a grasp that requireGrasp refuses, two of one name, or a file that cannot be
/// written, and leaves no partial file.
void writeGrasps(const std::string& path, const Grasps& grasps);
}
