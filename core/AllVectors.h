// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Before a function: it is compiled for several widths of vectors, and the widest that the processor has is called.
/// A file that uses it is compiled without contraction of a * b + c, so all of them give the same result.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define MEAM_ALL_VECTORS __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define MEAM_ALL_VECTORS
#endif
