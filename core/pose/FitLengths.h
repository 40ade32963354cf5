// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace meam
{
/// Lengths that several steps mean, as shares of the part's diameter: they follow how finely parts of any size are
/// sampled, trained and measured in a usual bin (docs/parameters.md).
struct FitLengths
{
  double fits = 0.03;        ///< a model point this near to the scene fits
  double explained = 0.01;   ///< a scene edge this near to an edge of the part is explained by it
  double unexplained = 0.02; ///< a scene point this far from the part is not explained by it
};
}
