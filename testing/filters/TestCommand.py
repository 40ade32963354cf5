# SPDX-License-Identifier: BSD-3-Clause
"""The command `ppfmeam`: it lists its sub-commands, and each does what the script of examples/ with its name does."""
import os
import subprocess
import sys

import ppfmeam
from ppfmeam.commands import SUMMARIES
from meamtest import box, check, read
from scripttest import EXAMPLES, script, works, write_stl

COMMAND = os.path.join(EXAMPLES, "..", "filters", "command", "ppfmeam")
MODULES = os.path.join(EXAMPLES, "..", "filters", "ppfmeam", "commands")


def module_of(name):
    return name.replace("-", "_") + ".py"


# The list, without loading VTK, and the same of the module.
text = works(COMMAND, "--help")
check(text.startswith("usage: ppfmeam [-h]"), text)
for name, summary in SUMMARIES.items():
    lines = [line for line in text.splitlines() if line.split()[:1] == [name]]
    check(len(lines) == 1 and lines[0].endswith(summary), f"a line for {name}: {text}")
check({module_of(name) for name in SUMMARIES} | {"__init__.py"} == {n for n in os.listdir(MODULES) if n.endswith(".py")},
      "every sub-command is listed")
module = subprocess.run([sys.executable, "-m", "ppfmeam", "--help"], capture_output=True, text=True)
check(module.returncode == 0 and module.stdout == text, f"python3 -m ppfmeam: {module}")
check(works(COMMAND, "--version") == f"ppfmeam {ppfmeam.__version__}\n", "the version")
for arguments, word in (((), "COMMAND"), (("fly",), "invalid choice: 'fly'")):
    result = script(COMMAND, *arguments)
    check(result.returncode == 2 and word in result.stderr, f"{arguments}: {result.stderr}")

# Options and output are those of the scripts, but for the name; what is printed is to be had as JSON.
for name in SUMMARIES:
    own, of_script = works(COMMAND, name, "--help"), works(module_of(name), "--help")
    check(own.startswith(f"usage: ppfmeam {name} ") and own.split()[3:] == of_script.split()[2:], f"{name}: {own}")
    own = works(COMMAND, name, "bop", "--help") if name == "evaluate" else own
    check("--json" in own, f"{name}: {own}")
write_stl("box.stl", box(30, 20, 10))
own = works(COMMAND, "train", "--cad", "box.stl", "--out", "a.meam")
of_script = works("train.py", "--cad", "box.stl", "--out", "b.meam")
check("symmetry: 3 exact turns" in own and own.splitlines()[1:] == of_script.splitlines()[1:], f"{own}\n{of_script}")
with open("a.meam", "rb") as one, open("b.meam", "rb") as other:
    check(one.read() == other.read(), "the same model")
works(COMMAND, "simulate", "--cad", "box.stl", "--copies", "2", "--sensor", "time-of-flight", "--out", "bins")
scan = ("--depth", "bins/test/000000/depth/000000.png", "--camera", "bins/camera.json", "--image", "bins/test/000000/gray/000000.png")
works(COMMAND, "detect", "--model", "a.meam", *scan, "--matrices", "a.txt")
works("detect.py", "--model", "b.meam", *scan, "--matrices", "b.txt")
check(len(read("a.txt").split()) % 16 == 0 and read("a.txt") == read("b.txt") != "", "the same poses")

# A message names the sub-command.
result = script(COMMAND, "detect", "--cad", "none.stl", *scan)
check(result.returncode == 1 and result.stderr.startswith("ppfmeam detect: cannot read none.stl"), result.stderr)
# What cannot be written is told before any work.
result = script(COMMAND, "train", "--cad", "none.stl", "--out", "a.xyz")
check(result.returncode == 1 and "the name of a trained model ends in .meam" in result.stderr, result.stderr)
