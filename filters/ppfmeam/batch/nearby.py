# SPDX-License-Identifier: BSD-3-Clause
"""Copies of the trained models' files in the memory of each machine, so that many processes read them once from the disk."""
import contextlib
import fcntl
import os
import shutil
import tempfile

from .. import scripting
from .parts import files_of_model
from .ranks import together

MEMORY, PREFIX = "/dev/shm", "ppfmeam-models-"
PIECE = 1 << 24  # bytes


def lock(folder):
    """A handle that keeps remove_left() off a folder while its process lives; an OSError if another process has one."""
    handle = os.open(folder, os.O_RDONLY | os.O_NOFOLLOW | os.O_DIRECTORY)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        os.stat(folder)  # else it was removed meanwhile
    except OSError:
        os.close(handle)
        raise
    return handle


def remove_left():
    """Removes this user's folders whose processes were killed."""
    for entry in os.scandir(MEMORY):
        with contextlib.suppress(OSError):  # it has gone, or is in use
            if entry.name.startswith(PREFIX) and entry.stat(follow_symlinks=False).st_uid == os.getuid():
                handle = lock(entry.path)
                shutil.rmtree(entry.path, ignore_errors=True)
                os.close(handle)


@contextlib.contextmanager
def memory():
    """A new folder, which goes at the end; None where there can be none."""
    folder, handle = None, None
    with contextlib.suppress(OSError):
        remove_left()
        folder = tempfile.mkdtemp(prefix=PREFIX, dir=MEMORY)
        handle = lock(folder)
    try:
        yield folder if handle is not None else None
    finally:
        if folder:
            shutil.rmtree(folder, ignore_errors=True)
        if handle is not None:
            os.close(handle)


def pieces(path):
    """Of a file; what is wrong with it is a text."""
    try:
        with open(path, "rb") as file:
            while piece := file.read(PIECE):
                yield piece
    except OSError as error:
        yield f"cannot read {path}: {error.strerror}"
    yield b""


def is_added(piece, path):
    """Adds to a file; False where that cannot be done."""
    try:
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "ab", buffering=0) as file:
            scripting.write_all(file, piece)
        return True
    except OSError:
        return False


def copy(ranks, files, folder):
    """Brings files, (path, path in the folder), from the first process to the folder of each machine's first one, if it
    has one. Returns whether all are there; where not, nothing is, so that the memory does not stay full."""
    whole = folder is not None
    for path, name in files:
        source = pieces(path)
        while piece := ranks.hand_on(lambda: next(source)):
            if isinstance(piece, str):
                raise scripting.Failure(piece)
            if whole and not is_added(piece, os.path.join(folder, name)):
                shutil.rmtree(folder, ignore_errors=True)
                whole = False
    return whole


@contextlib.contextmanager
def nearby(ranks, paths):
    """Where the processes of each machine find the models: in copies, which go at the end, or where they are if there is
    no room."""
    if ranks.size == 1:
        yield paths
        return
    files = ranks.share([(file, os.path.join(str(number), os.path.relpath(file, os.path.dirname(path))))
                         for number, path in enumerate(paths) for file in files_of_model(path)]
                        if ranks.rank == 0 else None)
    with memory() if ranks.leads else contextlib.nullcontext() as folder:
        whole = together(ranks, lambda: ranks.leads and copy(ranks, files, folder))
        folder = ranks.share_here(folder if whole else None)
        yield [os.path.join(folder, str(number), os.path.basename(path)) if folder else path
               for number, path in enumerate(paths)]
