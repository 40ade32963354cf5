# SPDX-License-Identifier: BSD-3-Clause
"""The same poses, bit for bit, on processors with and without AVX2 and AVX-512, and for 1 to 8 threads.

Three look at the processor: the C library, whose functions are told to forget what it has by GLIBC_TUNABLES; OpenCV, by
OPENCV_CPU_DISABLE; and our own loops, which ask the processor itself: for them qemu-user is a processor without, where
it is installed."""
import os
import shutil
import subprocess
import sys

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "filters"))

from batchtest import command, content, dataset  # noqa: E402
from meamtest import check  # noqa: E402
from ppfmeam import scripting  # noqa: E402
from scripttest import works  # noqa: E402

scripting.write_model(dataset("bins", 1, 160, 120, copies=2)[0], "plate.meam")
WITHOUT = ("AVX", "AVX2", "AVX512F", "AVX512VL", "AVX512BW", "AVX512DQ", "AVX512CD", "FMA", "FMA4", "ERMS")
PLAIN_LIBRARY = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=" + ",".join(f"-{name},-{name}_Usable" for name in WITHOUT)}
PLAIN_OPENCV = {"OPENCV_CPU_DISABLE": "SSE4.1,SSE4.2,AVX,FP16,AVX2,FMA3,AVX512F,AVX512-SKX"}


def arguments(name, threads):
    return "bins", "--model", "plate.meam", "--threads", str(threads), "--out", f"{name}.csv"


def here(threads):
    """The table on this processor, as bytes."""
    check(", 0 failed, " in works("batch.py", *arguments(f"here{threads}", threads)), f"{threads} threads")
    return content(f"here{threads}.csv")


def poses(name, threads=1, environment=None, before=()):
    """The table on another one."""
    done = subprocess.run((*before, *command(*arguments(name, threads))), env={**os.environ, **(environment or {})}, capture_output=True,
                          text=True)
    check(done.returncode == 0 and ", 0 failed, " in done.stdout, f"{name}: {done.stdout}{done.stderr}")
    return content(f"{name}.csv")


expected = here(1)
check(expected.count(b"\n") > 2, "no poses to compare")
for threads in (2, 3, 5, 8):
    check(here(threads) == expected, f"other poses with {threads} threads")
check(poses("plain", 2, {**PLAIN_LIBRARY, **PLAIN_OPENCV}) == expected,
      "other poses with the C library's and OpenCV's functions for old processors")
qemu = shutil.which("qemu-x86_64")
if qemu:
    check(poses("qemu", 1, None, (qemu, "-cpu", "Nehalem")) == expected, "other poses on a processor without AVX")
else:
    print("there is no qemu-user: our own loops were not run without AVX2")
