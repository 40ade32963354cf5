#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Finds the copies of a part, or of several parts, in many scans: `ppfmeam batch`, from the build tree. Several processes:
mpirun -n N pvbatch --symmetric examples/batch.py ..."""
from ppfmeam import scripting
from ppfmeam.commands import batch

scripting.run(batch.main)
