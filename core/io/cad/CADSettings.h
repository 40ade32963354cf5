// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace meam
{
/// What a user chooses of a part's file.
struct CADSettings
{
  int solid = 0; ///< of a STEP or IGES file with several, the one that is the part, from 1; 0: all together
};
}
