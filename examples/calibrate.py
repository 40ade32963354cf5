#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the probabilities of a model hold in scans of one's own: `ppfmeam calibrate`, from the build tree."""
from ppfmeam import scripting
from ppfmeam.commands import calibrate

scripting.run(calibrate.main)
