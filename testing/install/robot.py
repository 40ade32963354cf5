# SPDX-License-Identifier: BSD-3-Clause
"""A robot's program against the cells of examples/cell: scans arrive, answers are asked for over a connection, a bad scan is
an answer, too, and what was logged is replayed. All cells say the same.
Usage: robot.py FOLDER (of scan.py make, with part.meam and part.grasps.json) CELL.PY [CELL]"""
import json
import os
import shutil
import socket
import subprocess
import sys
import time

import numpy

WAY_IN, SECONDS = 80.0, 60
GRIPPER = (10, -20, 30, 0, 0, 0.6, 0.8)  # x y z qx qy qz qw


def free_port():
    with socket.create_server(("127.0.0.1", 0)) as server:
        return server.getsockname()[1]


def connected(port, process):
    until = time.monotonic() + SECONDS
    while True:
        try:
            return socket.create_connection(("127.0.0.1", port), timeout=SECONDS)
        except ConnectionRefusedError:
            assert process.poll() is None and time.monotonic() < until, f"no cell on port {port}: {process.poll()}"
            time.sleep(0.05)


def ask(link, request):
    link.sendall(request.encode())
    line = b""
    while not line.endswith(b"\n"):
        data = link.recv(4096)
        assert data, "the cell has closed the connection"
        line += data
    return line.decode().rstrip("\n")


def arrives(name, of):
    """A scan, as most sensors write it: it grows."""
    with open(of, "rb") as file:
        content = file.read()
    with open(f"scans/{name}", "wb") as file:
        for half in (content[:len(content) // 2], content[len(content) // 2:]):
            file.write(half)
            file.flush()
            time.sleep(0.05)


def frame_of(line):
    """T of a pick, and where its way in begins."""
    words = line.split()
    assert words[0] == "PICK" and len(words) == 14, line
    values = [float(word) for word in words[1:]]
    x, y, z, w = values[3:7]
    T = numpy.eye(4)
    T[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                 [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                 [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    T[:3, 3] = values[:3]
    assert numpy.allclose(T[:3, 3] - WAY_IN * T[:3, 2], values[7:10], atol=0.01), line
    assert 0 < values[10] < 60 and values[11] > 0 and 0.5 < values[12] <= 1, line  # width, clearance, probability
    return T


def run(command):
    """The cell, until its robot goes. Returns the answers."""
    shutil.rmtree("scans", ignore_errors=True)
    os.makedirs("scans")
    shutil.copy("scan.pcd", "scans/old.pcd")
    for file in ("cell.log", "pick.txt"):
        if os.path.exists(file):
            os.remove(file)
    parts = ["part.meam", "part.stl", "part.grasps.json", "--robot-frame", "robot.json", "--time-limit", "60"]
    port = free_port()
    process = subprocess.Popen([*command, *parts, "--watch", "scans", "--port", str(port), "--log", "cell.log", "--out",
                                "pick.txt"], stdout=subprocess.DEVNULL)
    try:
        first = connected(port, process)
        assert ask(first, "GIVE ME A PART\n").startswith("NONE the request has to be NEXT")
        assert ask(first, "NEXT 1 2 3 0 0 0 0\n").startswith("NONE the request has to be NEXT")
        first.sendall(b"NE")  # a robot that is switched off in the middle
        robot = connected(port, process)
        arrives("one.pcd", "scan.pcd")
        answers = [ask(robot, "NEXT\n")]
        with open("pick.txt", encoding="utf-8") as file:
            assert file.read() == answers[0] + "\n", "pick.txt has another line"
        arrives("bad.pcd", "part.stl")
        answers.append(ask(robot, "NEXT\r\n"))
        assert answers[1].startswith("NONE ") and "bad.pcd" in answers[1], answers[1]
        arrives("two.pcd", "scan.pcd")
        answers.append(ask(robot, "NEXT " + " ".join(map(str, GRIPPER)) + "\n"))
        T, moved = frame_of(answers[0]), frame_of(answers[2])
        begin = numpy.array(GRIPPER[:3]) - [0, 0, WAY_IN]
        gripper = frame_of(" ".join(map(str, ("PICK", *GRIPPER, *begin, 1, 1, 1))))
        assert numpy.allclose(gripper @ T, moved, atol=0.01), f"{gripper @ T} is not {moved}"
        robot.sendall(b"NEXT\n")  # each scan is answered once
        robot.settimeout(0.5)
        try:
            raise AssertionError(f"a scan is answered twice: {robot.recv(4096)}")
        except socket.timeout:
            pass
    finally:
        process.terminate()
        process.wait()
    with open("cell.log", encoding="utf-8") as file:
        rows = [line.rstrip("\n").split("\t") for line in file]
    assert [(row[1], os.path.basename(row[2])) for row in rows] == [
        (kind, f"{name}.pcd") for name in ("one", "bad", "two") for kind in ("SCAN", "SENT")], rows
    assert [row[3] for row in rows if row[1] == "SENT"] == answers, rows
    again = subprocess.run([*command, *parts, "--replay", "cell.log"], capture_output=True, text=True)
    assert again.returncode == 0 and again.stdout.count("the same\n") == 3, again
    with open("cell.log", encoding="utf-8") as file:
        other = file.read().replace("PICK ", "PICK 1")
    with open("cell.log", "w", encoding="utf-8") as file:
        file.write(other)
    again = subprocess.run([*command, *parts, "--replay", "cell.log"], capture_output=True, text=True)
    assert again.returncode == 1 and again.stdout.count("it was PICK 1") == 2, again
    one = subprocess.run([*command, *parts, "scan.pcd"], capture_output=True, text=True)
    assert one.stdout == f"SCAN scan.pcd {answers[0]}\n", one
    # What is given is used or refused.
    for wrong, words in ((["scan.pcd", "--robotframe", "robot.json"], "--robotframe"), (["--watch"], "--watch"), ([], "give scans, --watch or --replay"),
                         (["scan.pcd", "--time-limit", "-1"], "--time-limit has to be"), (["--watch", "scans", "--port", "99999"], "--port")):
        refused = subprocess.run([*command, *parts[:3], *wrong], capture_output=True, text=True, timeout=SECONDS)
        assert refused.returncode != 0 and words in refused.stderr and not refused.stdout, (wrong, refused)
    # The same part as a second type: the pick is of one of them, and says of which.
    two = subprocess.run([*command, *parts, "--beside", *parts[:3], "scan.pcd"], capture_output=True, text=True)
    assert len(two.stdout.split()) == 17 and two.stdout.split()[-1] in ("1", "2"), two
    answers.append(two.stdout)
    return answers


os.chdir(sys.argv[1])
cells = [[sys.executable, sys.argv[2]]] + [[cell] for cell in sys.argv[3:]]
told = [run(cell) for cell in cells]
print("\n".join(told[0]))
assert all(answers[::2] == told[0][::2] for answers in told), f"the cells differ: {told}"
truth = numpy.loadtxt("truth.txt").reshape(-1, 4, 4)
grasp = frame_of(told[0][0])[:3, 3]
with open("robot.json", encoding="utf-8") as file:
    T_robot_camera = numpy.array(json.load(file)["T_robot_camera"])
distance = min(numpy.linalg.norm((T_robot_camera @ T)[:3, 3] - grasp) for T in truth)
assert distance < 60, f"the pick is {distance} mm from any part"
