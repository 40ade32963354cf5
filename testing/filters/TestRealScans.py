# SPDX-License-Identifier: BSD-3-Clause
"""examples/real_scans.py on the real scans: most rings are met, both pictures of each scan are written."""
import os
import re
import subprocess
import sys
import tempfile

from meamtest import check, skip

LEAST = 9  # of ten rings met

data = os.environ.get("PPFMEAM_DATA", "")
if not (data and all(os.path.isdir(os.path.join(data, name)) for name in ("rings", "scanner"))):
    skip(f"no scans at {data}: set PPFMEAM_DATA")
root = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
script = [sys.executable, os.path.join(root, "examples", "real_scans.py")]
with tempfile.TemporaryDirectory() as out:
    done = subprocess.run([*script, data, "--out", out], capture_output=True, text=True)
    check(done.returncode == 0, done.stderr)
    check(int(re.search(r"flips are wrong: (\d+) of 10", done.stdout)[1]) >= LEAST, done.stdout)
    check(sorted(os.listdir(out)) == ["gallery_rings_edges.jpg", "gallery_rings_poses.jpg", "gallery_scanner_edges.jpg",
                                      "gallery_scanner_poses.jpg"], f"{os.listdir(out)}")
    done = subprocess.run([*script, out, "--out", out], capture_output=True, text=True)
    check(done.returncode == 1 and "Traceback" not in done.stderr and "triangles_scene.ply" in done.stderr, done.stderr)
