# SPDX-License-Identifier: BSD-3-Clause
"""The main job, examples/simulated_bin.py: right poses, and a picture with the parts in the colours of their ranks."""
import os
import re
import subprocess
import sys
import tempfile

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

from meamtest import check, connect, run, skip

if not os.environ.get("DISPLAY"):
    skip("no display")
EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples")
script = os.path.join(EXAMPLES, "simulated_bin.py")
with tempfile.TemporaryDirectory() as folder:
    picture = os.path.join(folder, "bin.png")
    result = subprocess.run([sys.executable, script, "--copies", "6", "--poses", "2", "--picture", picture],
                            capture_output=True, text=True)
    check(result.returncode == 0 and result.stderr == "", f"status {result.returncode}: {result.stderr}")
    check(re.search("against the truth: 2 of 2 poses right", result.stdout), result.stdout)
    pixels = vtk_to_numpy(run(connect(vtkPNGReader(), FileName=picture)).GetPointData().GetScalars()).astype(int)

red, green, blue = pixels[:, 0], pixels[:, 1], pixels[:, 2]
shares = {
    "red": ((red > 2 * green) & (red > 2 * blue) & (red > 60)).mean(),
    "green": ((green > 2 * red) & (green > 2 * blue) & (green > 60)).mean(),
    "blue": ((blue > 2 * red) & (blue > 60)).mean(),
    "grey": ((abs(red - green) < 8) & (abs(green - blue) < 8) & (red > 60)).mean(),
}
print(shares)
check(shares["red"] > 0.02 and shares["green"] > 0.02, f"two parts should be seen: {shares}")
check(shares["blue"] < 0.001, f"nobody has rank 3: {shares}")
check(shares["grey"] > 0.2, f"the scan should be seen: {shares}")
