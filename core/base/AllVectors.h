// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Before a function: it is compiled for several widths of vectors, and the widest that the processor has is called.
/// A file that uses it is compiled without contraction of a * b + c, so all of them give the same result.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define MEAM_ALL_VECTORS __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define MEAM_ALL_VECTORS
#endif

#include <algorithm>
#include <cstddef>
#include <limits>

namespace meam
{
/// Points that a loop over a scan looks at together: sums and bounds are kept lane by lane, so that the width of
/// vectors has no part in the result.
constexpr int PointLanes = 8;

/// Calls work(coordinates, count) with all points and a count that is a multiple of PointLanes: the last ones are
/// filled up with points that are no numbers.
template <typename Scalar, typename Work>
void inLanes(const Scalar* xyz, std::size_t count, Work&& work)
{
  const std::size_t whole = count / PointLanes * PointLanes;
  if (whole > 0)
  {
    work(xyz, whole);
  }
  if (whole < count)
  {
    Scalar rest[3 * PointLanes];
    std::fill_n(rest, 3 * PointLanes, std::numeric_limits<Scalar>::quiet_NaN());
    std::copy_n(xyz + 3 * whole, 3 * (count - whole), rest);
    work(rest, PointLanes);
  }
}
}
