# SPDX-License-Identifier: BSD-3-Clause
"""Ctrl-C in scripts: they end within a second of work of two threads, without a traceback, and leave no file that is not whole.
What is watched for it goes when it is no longer needed."""
import gc
import os
import resource
import signal
import subprocess
import sys
import tempfile
import time
import weakref

from ppfmeam import filters, scripting
from meamtest import check

root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
part = os.path.join(root, "examples", "data", "ribbed_flange.stl")


def processor_seconds(process=None):
    """Of a running process, or of those that have ended."""
    if process:
        with open(f"/proc/{process.pid}/stat", encoding="utf-8") as file:
            user, system = file.read().rpartition(")")[2].split()[11:13]
        return (int(user) + int(system)) / os.sysconf("SC_CLK_TCK")
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def command_of(script, *arguments):
    return [sys.executable, os.path.join(root, "examples", script), *arguments]


def work_of(script, *arguments, until=None):
    """Processor seconds of a script that nothing stops, or those before a file of its is there."""
    before, process = processor_seconds(), subprocess.Popen(command_of(script, *arguments), stdout=subprocess.DEVNULL)
    spent = None
    while until and process.poll() is None and spent is None:
        spent = processor_seconds(process) if os.path.exists(until) else None
        time.sleep(0.01)
    check(process.wait() == 0, f"{script} ends with {process.returncode}")
    return processor_seconds() - before if spent is None else spent


def interrupted(work, folder, *command):
    """Starts a script, sends Ctrl-C after so many seconds of the processor, and returns what is in the folder then."""
    before = processor_seconds()
    process = subprocess.Popen(command_of(*command), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    while process.poll() is None and processor_seconds(process) < work:
        time.sleep(0.01)
    check(process.poll() is None, f"{command[0]} has ended before it was stopped")
    before += processor_seconds(process)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=30)
    took = processor_seconds() - before
    check(took < 2.0, f"{command[0]} worked for {took:.1f} s before it stopped")
    check(process.returncode == 130 and errors == f"{command[0]}: stopped\n", f"{process.returncode}: {errors}")
    return [os.path.join(place, name) for place, _, names in os.walk(folder) for name in names]


loading = work_of("train.py", "--help")  # its modules, which Ctrl-C may cut off anyhow
with tempfile.TemporaryDirectory() as folder:
    model = os.path.join(folder, "part.meam")
    training = ["train.py", "--cad", part, "--out", model]
    before_writing = []
    for _ in range(2):  # the first reads its modules from the disk
        before_writing.append(work_of(*training, until=model))
        os.remove(model)
    for share in (0.25, 0.6):
        left = interrupted(loading + share * (min(before_writing) - loading), folder, *training)
        check(not left, f"train.py leaves {left}")
    bins = os.path.join(folder, "bins")
    left = interrupted(loading + 1.2, bins, "simulate.py", "--cad", part, "--scenes", "50", "--out", bins)
    check(not [name for name in left if name.endswith(".part")] and all(map(os.path.getsize, left)), f"left: {left}")

# Not when Python looks for garbage: filters hold scans.
signal.signal(signal.SIGINT, scripting.interruption.ask)
gc.disable()
source, thinned = filters.vtkMEAMSamplePartSource(), filters.vtkMEAMSurfaceSampling()
thinned.SetInputConnection(source.GetOutputPort())
scripting.update(thinned)
check(len(scripting.upstream(thinned)) == 2, f"{scripting.upstream(thinned)}")
held = [weakref.ref(source), weakref.ref(thinned)]
del source, thinned
check([reference() for reference in held] == [None, None], "filters are held after their use")
