# SPDX-License-Identifier: BSD-3-Clause
"""The sub-commands of `ppfmeam`, one module each with a main() that reads sys.argv, as the scripts of examples/ call it.
SUMMARIES is what `ppfmeam --help` says of them, in the order of a first use."""

SUMMARIES = {
    "train": "train the model of a part from its CAD file",
    "detect": "find the copies of one or several parts in a scan",
    "simulate": "simulate scans of bins with their true poses, as a dataset",
    "cell": "simulate a picking cell: find, pick, until the bin is empty",
    "evaluate": "run the method on scenes with true poses and print how many it finds",
}
