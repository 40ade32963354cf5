# SPDX-License-Identifier: BSD-3-Clause
"""testing/evaluation/real_scans.py on the real scans: most rings are met, both pictures of each scan are written."""
import os
import subprocess
import sys
import tempfile

from meamtest import check, skip
import results

LEAST = 9  # of ten rings met

data = os.environ.get("PPFMEAM_DATA", "")
if not (data and all(os.path.isdir(os.path.join(data, name)) for name in ("rings", "scanner"))):
    skip(f"no scans at {data}: set PPFMEAM_DATA")
script = [sys.executable, os.path.join(os.path.dirname(results.__file__), "real_scans.py")]
with tempfile.TemporaryDirectory() as out:
    table = os.path.join(out, "rings.csv")
    done = subprocess.run([*script, data, "--edges", "image,depth", "--pictures", out, "--out", table], capture_output=True, text=True)
    check(done.returncode == 0, done.stderr)
    row, = results.read(table)
    check(row["known"] == "10" and int(row["met"]) >= LEAST, f"{row}")
    check(sorted(os.listdir(out)) == ["gallery_rings_edges.jpg", "gallery_rings_poses.jpg", "gallery_scanner_edges.jpg",
                                      "gallery_scanner_poses.jpg", "rings.csv"], f"{os.listdir(out)}")
    done = subprocess.run([*script, out], capture_output=True, text=True)
    check(done.returncode == 1 and "Traceback" not in done.stderr and "triangles_scene.ply" in done.stderr, done.stderr)
