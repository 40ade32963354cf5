#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Simulates scans of bins with copies of a part: `ppfmeam simulate`, from the build tree."""
from ppfmeam import scripting
from ppfmeam.commands import simulate

scripting.run(simulate.main)
