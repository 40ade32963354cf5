#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the method on scenes with true poses and prints how many it finds: `ppfmeam evaluate`, from the build tree."""
from ppfmeam import scripting
from ppfmeam.commands import evaluate

scripting.run(evaluate.main)
