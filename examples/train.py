#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Trains the model of a part from its CAD file: `ppfmeam train`, from the build tree."""
from ppfmeam import scripting
from ppfmeam.commands import train

scripting.run(train.main)
