#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Simulates a picking cell: `ppfmeam cell`, from the build tree."""
from ppfmeam import scripting
from ppfmeam.commands import cell

scripting.run(cell.main)
