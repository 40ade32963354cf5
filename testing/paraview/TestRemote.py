# SPDX-License-Identifier: BSD-3-Clause
"""A client and a server, of one process and of two, give the poses, picks and reasons that ParaView alone gives, show them with
their labels, drawn here or there, and save them. In the application as a client a part is pointed at.

Usage: TestRemote.py PVSERVER MPIRUN PARAVIEW REPOSITORY, under pvpython with a display.
"""
import contextlib
import json
import os
import re
import socket
import subprocess
import sys
import tempfile

from paraview import servermanager, simple

import clicks
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


def picture(view):
    with tempfile.TemporaryDirectory() as folder:
        return pictures.pixels(os.path.join(folder, "view.png"), view, [320, 240])


def look(view, labels):
    """Parts and labels are in the view, wherever it is drawn."""
    for megabytes in (1000, 0):  # of data that are drawn by the client
        view.RemoteRenderThreshold = megabytes
        labels.Visibility = 0
        without = picture(view)
        labels.Visibility = 1
        share = pictures.red(without).mean()
        check(share > SEEN, f"{share} of the picture is red")
        text = (abs(picture(view) - without).max(axis=1) > 60).sum()
        check(text > 50, f"labels take {text} pixels")


def texts(data, name):
    array = data.GetAbstractArray(name)
    return [array.GetValue(k) for k in range(array.GetNumberOfValues())]


def found():
    """Poses and picks in a simulated bin, where the data are, why the first pose came out, and the files of all of it."""
    plate = simple.SamplePartSource(Part="Hole plate")
    bin = simple.BinSceneOfPart(Input=plate, Copies=2, Width=320, Height=240)
    scan = simple.OutputPort(bin, 0)
    poses = simple.MEAMPoseEstimation(Input=plate, Scene=scan, MaximumNumberOfPoses=2)
    view = simple.CreateRenderView()
    simple.Show(scan, view)
    labels = simple.Show(simple.OutputPort(poses, 0), view)
    simple.Show(simple.OutputPort(poses, 2), view)
    simple.Render(view)
    look(view, labels)
    jaws = {"FingerWidth": 6, "FingerThickness": 4}
    grasps = simple.GraspDefinition(Input=plate, **jaws)
    picks = simple.PickPlanning(Input=simple.OutputPort(poses, 0), Mesh=plate, Grasps=grasps, Scan=scan, Bin="None", **jaws)
    simple.Show(simple.OutputPort(picks, 1), view)
    look(view, simple.Show(simple.OutputPort(picks, 0), view))
    data = servermanager.Fetch(poses)
    parts = servermanager.Fetch(poses, idx=2)
    ranks = parts.GetPointData().GetArray("Rank")
    first = [parts.GetPoint(k) for k in range(parts.GetNumberOfPoints()) if ranks.GetValue(k) == 1]
    why = simple.PoseDiagnosis(Input=plate, Scene=scan, Poses=simple.OutputPort(poses, 0), Place="Point",
                               Position=min(first, key=lambda point: point[2]))
    simple.Show(why, view)
    simple.Render(view)
    said = texts(servermanager.Fetch(why).GetFieldData(), "Verdict")
    check(re.match("Found as rank 1, ", said[0]), f"the first pose: {said}")
    array = data.GetPointData().GetArray("Transform")
    planned = texts(servermanager.Fetch(picks).GetPointData(), "Reason")
    check(planned, "no picks")
    return [array.GetTuple(k) for k in range(array.GetNumberOfTuples())], planned, said, saved(poses, grasps, picks)


def saved(poses, grasps, picks):
    """What the writers write, but for times and the page, which has them."""
    content = {}
    with tempfile.TemporaryDirectory() as folder:
        for name, source, port in (("poses.json", poses, 0), ("part.grasps", grasps, 0), ("picks.json", picks, 0),
                                   ("part.meam", poses, 6)):
            path = os.path.join(folder, name)
            simple.SaveData(path, simple.OutputPort(source, port))
            with open(path, "rb") as file:
                content[name] = file.read()
            if name.endswith(".json"):
                content[name] = [{key: value for key, value in pose.items() if key != "time"}
                                 for pose in json.loads(content[name])["poses"]]
        if os.path.exists("/usr/share/javascript/three"):
            path = os.path.join(folder, "found.html")
            simple.SaveData(path, simple.OutputPort(poses, 0))
            check(os.path.getsize(path) > 1e6, "the page")
    return content


@contextlib.contextmanager
def served(command, keep_plugins=False):
    """The port of a server while it runs. MPI's own variables are those of this process."""
    port = free_port()
    environment = {name: value for name, value in os.environ.items()
                   if (keep_plugins or name != "PV_PLUGIN_PATH") and not name.startswith(("OMPI_", "PMIX_"))}
    server = subprocess.Popen([*command, f"--server-port={port}"], env=environment, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)
    for line in server.stdout:
        if "Accepting connection" in line:
            break
    try:
        yield port
    finally:
        server.terminate()
        server.communicate()


def by_server(*command):
    """The plugin is loaded from here."""
    with served(command) as port:
        simple.Connect("localhost", port)
        simple.LoadPlugin(PLUGIN, remote=True, ns=vars(simple))
        result = found()
        processes = servermanager.ActiveConnection.GetNumberOfDataPartitions()
        simple.Disconnect()
        return result, processes


def point_at_a_part(command, paraview, repository):
    """By clicks in a client, whose server has the plugin, too: a part is found, pointed at by Ctrl+P, and its poses are saved."""
    with tempfile.TemporaryDirectory() as folder, served(command, keep_plugins=True) as port:
        scan = os.path.join(repository, "testing", "install", "scan.py")
        subprocess.run(["/usr/bin/python3", scan, "make", folder], check=True)
        events = [event for name in ("part.stl", "scan.pcd") for event in clicks.files("actionFileOpen", "FileOpenDialog", f"{folder}/{name}")]
        events += [clicks.event("PoseEstimationToolbar/EstimatePoses", "activate"), clicks.APPLY,
                   *clicks.files("actionFileSaveData", "FileSaveDialog", f"{folder}/found.html"),
                   clicks.event("PoseEstimationToolbar/AskWhy", "activate"),
                   *clicks.point_and_press(clicks.view(0), 0.5, 0.5, "P", control=True), clicks.APPLY,
                   *clicks.files("actionFileSaveServerState", "FileSaveServerStateDialog", f"{folder}/state.pvsm")]
        picture = os.environ.get("PPFMEAM_PICTURE")
        if picture:
            clicks.shoot(paraview, folder, events, os.path.join(picture, "remote.png"), f"--server-url=cs://localhost:{port}")
        else:
            clicks.play(paraview, folder, events, f"--server-url=cs://localhost:{port}")
        check(os.path.getsize(f"{folder}/found.html") > 1e6, "the page")
        with open(f"{folder}/state.pvsm") as file:
            diagnosis = re.search('<Proxy group="filters" type="PoseDiagnosis".*?</Proxy>', file.read(), re.DOTALL)[0]
        position = re.search('<Property name="Position".*?</Property>', diagnosis, re.DOTALL)[0]
        place = [float(value) for value in re.findall(' value="([^"]+)"/>', position)]
        check(len(place) == 3 and 300 < place[2] < 1000, f"{place} is not on a part: {position}")


pvserver = [sys.argv[1], "--force-offscreen-rendering"]
mpirun = [sys.argv[2], "--allow-run-as-root", "--oversubscribe", "-n", "2"]
alone = found()
check(len(alone[0]) == 2, f"{len(alone[0])} poses")
for command, processes in ((pvserver, 1), (mpirun + pvserver, 2)):
    result, count = by_server(*command)
    check(count == processes, f"{count} processes")
    for here, there, what in zip(alone[:3], result[:3], ("poses", "picks", "reasons")):
        check(here == there, f"a server of {processes} processes gives other {what}: {there} instead of {here}")
    other = [name for name in alone[3] if alone[3][name] != result[3].get(name)]
    check(not other, f"a server of {processes} processes saves other {other}")
point_at_a_part(pvserver, *sys.argv[3:])
