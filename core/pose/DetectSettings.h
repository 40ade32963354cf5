// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../features/Preset.h"

namespace meam
{
/// What a user chooses of detection; the preset has everything else. filters/ppfmeam/choices.json names each field's
/// property, Python argument and command line option.
struct DetectSettings
{
  Preset preset = Preset::Recommended;
  Features features = Features::Both; ///< by which poses are looked for; with the preset Paper edges alone
  int maximumPoses = 5;               ///< the best ones; 0: all
  double minimumProbability = 0.0;    ///< [0, 1], of each, that a copy is there, however it is turned;
  bool rotationCounts = false;        ///< or that it is also turned like this
  /// [0, 1], of the scene's edge points those that vote; more find more of the hidden copies and take longer; 0: the
  /// preset's
  double referenceShare = 0.0;
  bool imageEdges = true; ///< edges from the image
  bool depthEdges = true; ///< and where a surface ends in front of another one; not with the preset Paper
  bool creases = true;    ///< and where two flat pieces meet; not with the preset Paper
  /// Seconds from the scan to the poses, after which the best that are found until then come out, in their order; 0: no
  /// limit. What is found by then depends on the machine.
  double timeLimit = 0.0;
  unsigned seed = 1; ///< of all random choices
  int threads = 0;   ///< 0: one for each processor
};
}
