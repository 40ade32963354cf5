# SPDX-License-Identifier: BSD-3-Clause
"""PPF-MEAM: 6D poses of industrial parts in a bin, as VTK algorithms. See ppfmeam.filters."""
