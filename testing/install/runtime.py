# SPDX-License-Identifier: BSD-3-Clause
"""Everything that is installed is made by the target `runtime` alone. Usage: runtime.py BUILD_DIR"""
import pathlib
import re
import sys

build = pathlib.Path(sys.argv[1])
inputs_of = {}  # output -> what is made before it or with it
for line in (build / "build.ninja").read_text().splitlines():
    if line.startswith("build "):
        words = re.sub(r"\$(.)", lambda escape: {" ": "\0", ":": "\1"}.get(escape[1], escape[1]), line[6:])
        outputs, _, inputs = words.partition(":")
        outputs, inputs = ([word.replace("\0", " ").replace("\1", ":") for word in side.split()] for side in (outputs, inputs))
        inputs_of.update(dict.fromkeys(outputs, inputs[1:] + outputs))  # what makes one makes the others, too
made, ahead = set(), ["runtime"]
while ahead:
    name = ahead.pop()
    if name not in made:
        made.add(name)
        ahead += inputs_of.get(name, [])

installed = [pathlib.Path(file) for rules in build.rglob("cmake_install.cmake")
             for files in re.findall(r'\bFILES((?:\s+"[^"]+")+)', rules.read_text())
             for file in re.findall(r'"([^"]+)"', files) if "$" not in file]
lacking = []
for file in installed:
    output = str(file.relative_to(build)) if build in file.parents else None
    is_there = file.exists() or file.is_symlink()  # which leads somewhere where it is installed
    if output not in made if output in inputs_of else not is_there:
        lacking.append(str(file))
print(f"{len(installed)} files are installed")
assert len(installed) > 10 and "runtime" in inputs_of
sys.exit(f"not made by the target runtime: {lacking}" if lacking else 0)
