# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of examples/ and testing/evaluation/ share: a temporary folder to work in, a scan of a bin, scripts in processes of their own. Not
a test."""
import json
import os
import subprocess
import sys
import tempfile

import numpy
from vtkmodules.vtkIOGeometry import vtkSTLWriter

from ppfmeam.filters import vtkMEAMBinSceneSource
from meamtest import check, connect, plate, run

TESTING = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
EXAMPLES, EVALUATION = os.path.join(TESTING, "..", "examples"), os.path.join(TESTING, "evaluation")
folder = tempfile.TemporaryDirectory()
os.chdir(folder.name)
server = subprocess.Popen([sys.executable, os.path.join(os.path.dirname(os.path.abspath(__file__)), "scriptserver.py")],
                          env={k: v for k, v in os.environ.items() if k != "DISPLAY"}, stdin=subprocess.PIPE,
                          stdout=subprocess.PIPE, text=True)


def script(name, *arguments):
    """Runs it without a display, in a process of its own."""
    path = next(filter(os.path.exists, (os.path.join(folder, name) for folder in (EXAMPLES, EVALUATION))))
    print(json.dumps([path, *arguments]), file=server.stdin, flush=True)
    answer = server.stdout.readline()
    check(answer, f"{name} {arguments}: the server of scripts has ended")
    return subprocess.CompletedProcess((name, *arguments), *json.loads(answer))


def works(name, *arguments):
    result = script(name, *arguments)
    check(result.returncode == 0, f"{name} {arguments}: {result.stderr}")
    check(result.stderr == "", f"{name} {arguments} says {result.stderr}")
    return result.stdout


def refuses(word, name, *arguments):
    """Exit status 1, one message with the word, no file."""
    before = sorted(os.listdir())
    result = script(name, *arguments)
    what = f"{name} {' '.join(arguments)}: status {result.returncode}, {result.stderr}"
    check(result.returncode == 1 and word.lower() in result.stderr.lower(), f"expected '{word}': {what}")
    check(result.stderr.count("\n") == 1 and result.stderr.startswith(name), f"more than a message: {what}")
    check(sorted(os.listdir()) == before, f"left files behind: {what}")


def write_pcd(path, columns, width, height, fields):
    """Binary, floats."""
    count = len(fields.split())
    with open(path, "wb") as file:
        file.write(f"VERSION .7\nFIELDS {fields}\nSIZE{' 4' * count}\nTYPE{' F' * count}\nCOUNT{' 1' * count}\n"
                   f"WIDTH {width}\nHEIGHT {height}\nPOINTS {width * height}\nDATA binary\n".encode())
        file.write(numpy.ascontiguousarray(columns, dtype="<f4").tobytes())


def write_stl(path, mesh):
    connect(vtkSTLWriter(), mesh, FileName=path, FileType=2).Write()  # binary


W, H = 480, 360


def scan_of_bin():
    """Of three copies of the plate, which is trained in a third of the sample part's time: the scan, the true poses, the part."""
    source = connect(vtkMEAMBinSceneSource(), plate(), Copies=3, Width=W, Height=H)
    run(source)
    return [source.GetOutputDataObject(port) for port in range(3)]
