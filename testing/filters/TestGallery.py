# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of every step, testing/evaluation/gallery.py: what docs/gallery.md shows of the sample part; every one is there, small,
and has something in it."""
import os
import re
import subprocess
import sys
import tempfile

from meamtest import check, read, skip

if not os.environ.get("DISPLAY"):
    skip("no display")
EVALUATION = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "evaluation")
names = set(re.findall(r"gallery_sample_\w+\.jpg", read(os.path.join(EVALUATION, "..", "..", "docs", "gallery.md"))))
with tempfile.TemporaryDirectory() as folder:
    result = subprocess.run([sys.executable, os.path.join(EVALUATION, "gallery.py"), "--out", folder], capture_output=True,
                            text=True)
    check(result.returncode == 0 and result.stderr == "", f"status {result.returncode}: {result.stderr}")
    check(names == set(os.listdir(folder)) and len(names) == 17, f"{sorted(names)} and {sorted(os.listdir(folder))}")
    for name in names:
        size = os.path.getsize(os.path.join(folder, name))
        check(30000 < size < 120000, f"{name} has {size} bytes")
