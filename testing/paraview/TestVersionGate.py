# SPDX-License-Identifier: BSD-3-Clause
"""A plugin that was built for another ParaView is refused with one sentence; ParaView goes on.

Usage: TestVersionGate.py GATE, the library PPFMEAM.so as it would be for ParaView 5.0.
"""
import os
import sys
import tempfile

from paraview import simple

gate = sys.argv[1]
before = os.dup(2)
with tempfile.TemporaryFile() as said:
    os.dup2(said.fileno(), 2)  # what ParaView prints comes from C++
    try:
        simple.LoadPlugin(gate, remote=False, ns=globals())
        loaded = True
    except RuntimeError:
        loaded = False
    os.dup2(before, 2)
    said.seek(0)
    text = said.read().decode()
sys.stderr.write(text)

version = "%d.%d" % (simple.GetParaViewVersion().major, simple.GetParaViewVersion().minor)
expected = (f"The plugin PPFMEAM was built for ParaView 5.0 and this is ParaView {version}: "
            "load the one that was built for it.")
assert not loaded
assert text.count("PPFMEAM was built") == 1 and expected in text
assert "MEAMPoseEstimation" not in globals()

source = simple.Sphere()
source.UpdatePipeline()
assert source.GetDataInformation().GetNumberOfPoints() > 0
simple.LoadDistributedPlugin("PPFMEAM", remote=False, ns=globals())
assert "MEAMPoseEstimation" in globals()
