# SPDX-License-Identifier: BSD-3-Clause
"""testing/evaluation/tohoku.py on a tenth of the scenes of the Tohoku data, with --long on all: enough of the top five are right
on every part, enough of the visible instances come out, they are precise, and what it prints agrees with what it wrote."""
import os
import subprocess
import sys
import tempfile

from meamtest import LONG, check, rows_of, skip

SCENES = range(20) if LONG else (3, 12)
STRICT = 98.0  # percent of the top five, each instance once, missing poses wrong
RECALL = dict(zip("123", (97.0, 99.0, 98.5) if LONG else (95.0, 94.0, 95.0)))  # percent of what is at least half visible
ERROR = 0.03, 0.06  # median, mm and degrees

data = os.path.join(os.environ.get("PPFMEAM_DATA", ""), "tohoku")
if not os.path.isdir(data):
    skip(f"no dataset at {data}: set PPFMEAM_DATA")
root = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
with tempfile.TemporaryDirectory() as out:
    rows = os.path.join(out, "tohoku.csv")
    subprocess.run([sys.executable, os.path.join(root, "testing", "evaluation", "tohoku.py"), data, "--matrices", out, "--out", rows,
                    "--scenes", ",".join(map(str, SCENES))],
                   check=True)
    rows = rows_of(rows)
    check([row["part"] for row in rows] == ["1", "2", "3"], rows)
    for row in rows:
        check(float(row["strict"]) >= STRICT, f"part {row['part']}: {row['strict']} % of the top five")
        check(float(row["recall"]) >= RECALL[row["part"]], f"part {row['part']}: {row['recall']} % come out")
        check(float(row["mm"]) < ERROR[0] and float(row["deg"]) < ERROR[1], f"part {row['part']}: {row['mm']} mm, {row['deg']} degrees")
        files = sorted(os.listdir(os.path.join(out, f"Part_{row['part']}")))
        check(len(files) == len(SCENES), files)
        numbers = sum(len(open(os.path.join(out, f"Part_{row['part']}", name), encoding="utf-8").read().split())
                      for name in files)
        check(numbers == 16 * int(row["poses"]), f"part {row['part']}: {numbers} numbers written")
print("ok")
