#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""From a scan to picks: `ppfmeam pick`, from the build tree."""
from ppfmeam import scripting
from ppfmeam.commands import pick

scripting.run(pick.main)
