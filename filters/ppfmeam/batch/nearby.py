# SPDX-License-Identifier: BSD-3-Clause
"""Copies of the trained models' files in the memory of each machine, so that many processes read them once from the disk."""
import contextlib
import os
import shutil
import tempfile

from .. import scripting
from .parts import files_of_model
from .ranks import together

MEMORY = "/dev/shm"
PIECE = 1 << 24  # bytes


def pieces(path):
    """Of a file; what is wrong with it is a text."""
    try:
        with open(path, "rb") as file:
            while piece := file.read(PIECE):
                yield piece
    except OSError as error:
        yield f"cannot read {path}: {error.strerror}"
    yield b""


def copy(ranks, files, folder):
    """Brings files, (path, path in the folder), from the first process to the folder of each machine's first one."""
    failure = None
    for path, name in files:
        source, target = pieces(path), os.path.join(folder, name)
        while piece := ranks.hand_on(lambda: next(source)):
            if isinstance(piece, str):
                raise scripting.Failure(piece)
            try:
                os.makedirs(os.path.dirname(target), exist_ok=True)
                with open(target, "ab", buffering=0) as file:
                    scripting.write_all(file, piece)
            except OSError as error:
                failure = failure or f"cannot write {target}: {error.strerror}"  # told at the end: the others wait for this one
    if failure:
        raise scripting.Failure(failure)


@contextlib.contextmanager
def nearby(ranks, paths):
    """Where all processes find the models; the copies go at the end."""
    if ranks.size == 1:
        yield paths
        return
    names = [os.path.join(str(number), os.path.basename(path)) for number, path in enumerate(paths)]
    folder = None
    try:
        if ranks.leads:
            folder = tempfile.mkdtemp(dir=MEMORY if os.access(MEMORY, os.W_OK) else None)
        files = ranks.share([(file, os.path.join(str(number), os.path.relpath(file, os.path.dirname(path))))
                             for number, path in enumerate(paths) for file in files_of_model(path)]
                            if ranks.rank == 0 else None)
        together(ranks, lambda: copy(ranks, files, folder) if ranks.leads else None)
        yield [os.path.join(ranks.share_here(folder), name) for name in names]
    finally:
        if folder:
            shutil.rmtree(folder, ignore_errors=True)
