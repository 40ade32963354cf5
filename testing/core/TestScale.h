// SPDX-License-Identifier: BSD-3-Clause
// Sanitizers make everything slow: there the heaviest tests take less data, by which the same code
// runs; all of it with testing/run.sh --long.
#pragma once

#if defined(__SANITIZE_ADDRESS__)
constexpr bool SmallData = true;
#else
constexpr bool SmallData = false;
#endif
