// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace meam
{
/// From which on two poses of a part are one and the same to a step that has not refined them yet: they lead to one
/// instance, and to one rotation of it.
struct SamePose
{
  double distance = 0.1; ///< of the diameter, between the part's middles: nearer no two copies lie beside each other
  double angle = 15.0;   ///< degrees: two steps of the voted turn (7.2)
};
}
