// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace meam
{
/// Of the values in their order the one at a place from 0 on; 0 without values. Leaves them in another order.
template <typename T>
T nthOf(std::vector<T>& values, std::size_t place)
{
  if (values.empty())
  {
    return T(0);
  }
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

/// The same at a share of them, in [0, 1].
template <typename T>
T quantileOf(std::vector<T>& values, double share)
{
  return nthOf(values, values.empty() ? 0 : static_cast<std::size_t>(share * static_cast<double>(values.size() - 1)));
}

/// The same in the middle; of an even number the larger of the two there.
template <typename T>
T medianOf(std::vector<T>& values)
{
  return nthOf(values, values.size() / 2);
}
}
