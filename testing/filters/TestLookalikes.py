# SPDX-License-Identifier: BSD-3-Clause
"""A part that is not in the bin, but one that looks alike, is not likely; the one that is there is."""
import os

import ppfmeam
from meamtest import check, skip

folder = os.path.join(os.environ.get("PPFMEAM_DATA", ""), "failing")
BINS = (("absent_part_likely/bin_of_pin36.pcd", "pin36.stl", ("pin30.stl",)),
        ("absent_part_likely/bin_of_rods75.pcd", "rod75.stl", ("headed_pin32.stl",)),
        ("handed_part/bin_of_right.pcd", "right.stl", ("left.stl",)))  # what lies there, and what does not

if not all(os.path.exists(os.path.join(folder, scan)) for scan, _, _ in BINS):
    skip(f"no scans at {folder}: set PPFMEAM_DATA")
for scan, there, absent in BINS:
    def places(part, scan=os.path.join(folder, scan)):
        return [pose.place_probability for pose in ppfmeam.detect(os.path.join(os.path.dirname(scan), part), scan)]
    found = places(there)
    check(len(found) == 5 and min(found) > 0.9, f"{there}: {found}")
    for part in absent:
        alike = places(part)
        check(max(alike, default=0.0) < 0.5, f"{part} in {scan}: {alike}")
