# SPDX-License-Identifier: BSD-3-Clause
"""A client and a server, of one process and of two, give the poses that ParaView alone gives, and the client shows them. A server
of one process writes their page.

Usage: TestRemote.py PVSERVER MPIRUN, under pvpython with a display.
"""
import os
import socket
import subprocess
import sys
import tempfile

from paraview import servermanager, simple

import pictures

SEEN = 0.003  # share of the picture
PLUGIN = os.path.join(os.environ["PV_PLUGIN_PATH"].split(os.pathsep)[0], "PPFMEAM", "PPFMEAM.so")


def check(condition, message):
    if not condition:
        raise AssertionError(message)


def free_port():
    with socket.socket() as listener:
        listener.bind(("localhost", 0))
        return listener.getsockname()[1]


def red(view):
    """Share of the picture that is red."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "view.png")
        return pictures.red(pictures.pixels(path, view, [320, 240])).mean()


def found():
    """The poses in a simulated bin, where the data are, and the part at them in the client's view."""
    plate = simple.SamplePartSource(Part="Hole plate")
    scene = simple.BinSceneOfPart(Input=plate, Copies=2, Width=320, Height=240)
    poses = simple.MEAMPoseEstimation(Input=plate, Scene=simple.OutputPort(scene, 0), MaximumNumberOfPoses=2)
    view = simple.CreateRenderView()
    for source, port in ((scene, 0), (poses, 0), (poses, 2)):
        simple.Show(simple.OutputPort(source, port), view)
    simple.Render(view)
    share = red(view)
    check(share > SEEN, f"{share} of the picture is red")
    array = servermanager.Fetch(simple.OutputPort(poses, 0)).GetPointData().GetArray("Transform")
    return [array.GetTuple(k) for k in range(array.GetNumberOfTuples())]


def by_server(*command):
    port = free_port()
    # The plugin is loaded from here; MPI's own variables are those of this process.
    environment = {name: value for name, value in os.environ.items()
                   if name != "PV_PLUGIN_PATH" and not name.startswith(("OMPI_", "PMIX_"))}
    server = subprocess.Popen([*command, f"--server-port={port}"], env=environment, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)
    for line in server.stdout:
        if "Accepting connection" in line:
            break
    try:
        simple.Connect("localhost", port)
        simple.LoadPlugin(PLUGIN, remote=True, ns=vars(simple))
        poses = found()
        if len(command) == len(pvserver) and os.path.exists("/usr/share/javascript/three"):
            with tempfile.TemporaryDirectory() as folder:
                path = os.path.join(folder, "found.html")
                simple.SaveData(path, simple.OutputPort(simple.GetActiveSource(), 0))
                check(os.path.getsize(path) > 1e6, "the page of a server")
        processes = servermanager.ActiveConnection.GetNumberOfDataPartitions()
        simple.Disconnect()
        return poses, processes
    finally:
        server.terminate()
        server.wait()


alone = found()
check(len(alone) == 2, f"{len(alone)} poses")
pvserver = [sys.argv[1], "--force-offscreen-rendering"]
check(by_server(*pvserver) == (alone, 1), "a server gives other poses")
mpirun = [sys.argv[2], "--allow-run-as-root", "--oversubscribe", "-n", "2"]
check(by_server(*mpirun, *pvserver) == (alone, 2), "a server of two processes gives other poses")
