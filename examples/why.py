#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tells why a part of a scan was missed: `ppfmeam why`, from the build tree."""
from ppfmeam import scripting
from ppfmeam.commands import why

scripting.run(why.main)
