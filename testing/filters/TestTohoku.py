# SPDX-License-Identifier: BSD-3-Clause
"""examples/evaluate.py on all scenes of the Tohoku data: enough of the top five are right on every part, and what
it prints agrees with what it wrote."""
import csv
import os
import subprocess
import sys
import tempfile

from meamtest import check, skip

LEAST = 90.0  # percent of the top five, each instance once, missing poses wrong

data = os.path.join(os.environ.get("PPFMEAM_DATA", ""), "tohoku")
if not os.path.isdir(data):
    skip(f"no dataset at {data}: set PPFMEAM_DATA")
root = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
with tempfile.TemporaryDirectory() as out:
    subprocess.run([sys.executable, os.path.join(root, "examples", "evaluate.py"), "tohoku", data, "--out", out],
                   check=True)
    with open(os.path.join(out, "tohoku.csv"), newline="", encoding="utf-8") as table:
        rows = list(csv.DictReader(table))
    check([row["part"] for row in rows] == ["1", "2", "3"], rows)
    for row in rows:
        check(float(row["strict"]) >= LEAST, f"part {row['part']}: {row['strict']} % of the top five")
        files = sorted(os.listdir(os.path.join(out, f"Part_{row['part']}")))
        check(len(files) == 20, files)
        numbers = sum(len(open(os.path.join(out, f"Part_{row['part']}", name), encoding="utf-8").read().split())
                      for name in files)
        check(numbers == 16 * int(row["poses"]), f"part {row['part']}: {numbers} numbers written")
print("ok")
