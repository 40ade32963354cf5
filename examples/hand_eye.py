#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Finds where the camera is for the robot: `ppfmeam hand-eye`, from the build tree."""
from ppfmeam import scripting
from ppfmeam.commands import hand_eye

scripting.run(hand_eye.main)
