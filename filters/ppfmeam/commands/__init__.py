# SPDX-License-Identifier: BSD-3-Clause
"""The sub-commands of `ppfmeam`, one module each (a dash is an underscore there) with a main() that reads sys.argv, as the
scripts of examples/ call it. SUMMARIES is what `ppfmeam --help` says of them, in the order of a first use."""

SUMMARIES = {
    "train": "train the model of a part from its CAD file",
    "detect": "find the copies of one or several parts in a scan",
    "why": "tell why a part of a scan was missed: which step lost it, and what to change",
    "pick": "tell where a gripper can take which part of a scan, and why not elsewhere",
    "batch": "find them in many scans, with one process or many, and go on where a run was stopped",
    "calibrate": "make a model's probabilities hold in scans of one's own, of which it is known what is right",
    "hand-eye": "find where the camera is for the robot, from pairs of poses",
    "simulate": "simulate scans of bins with their true poses, as a dataset",
    "cell": "tell whether a bin of a part will be emptied: simulate, find, pick, until it is empty",
    "evaluate": "run the method on scenes with true poses and print how many it finds",
}
