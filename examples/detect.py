#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Finds the copies of a part, or of several parts, in a scan: `ppfmeam detect`, from the build tree."""
from ppfmeam import scripting
from ppfmeam.commands import detect

scripting.run(detect.main)
