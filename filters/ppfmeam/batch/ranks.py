# SPDX-License-Identifier: BSD-3-Clause
"""The processes that work on a run together, as ParaView and mpirun start them. Each takes the next scan from a counter
that the first one holds and that all reach by one-sided MPI: nobody has to stop working to hand out scans, which
ParaView's own controller would ask for, because in Python it can only wait for a message."""
import os
import sys
import time

from .. import scripting

PAUSE = 0.02  # seconds between two looks: waiting inside MPI would take a processor
SERVICE_PAUSE = 0.001
FAILED = 1 << 40  # in the counter: below it how many scans were taken, above it how many of these have failed
LAUNCHERS = ("OMPI_COMM_WORLD_SIZE", "PMI_SIZE")  # variables by which Open MPI and MPICH tell how many there are


class Alone:
    """One process."""
    rank, size, serves = 0, 1, False

    def __init__(self):
        self.counter = 0

    def add(self, number):
        """Adds to the counter and returns what it was."""
        self.counter += number
        return self.counter - number

    def take(self, failed=False):
        """The place of the next scan; `failed`: whether the one before has."""
        return self.add(1 + FAILED * failed) % FAILED

    def state(self):
        """How many scans were taken, and how many have failed."""
        failed, taken = divmod(self.add(0), FAILED)
        return taken, failed

    def share(self, value):
        """The first one's value."""
        return value

    def all(self, value):
        """The values of all."""
        return [value]

    def close(self):
        pass

    def abort(self):
        pass


class MPIRanks(Alone):
    """All processes of mpirun. On one machine the counter is in memory that they share. Between machines a network may
    need the first one to look after it, so there it `serves` and takes no scans."""

    def __init__(self, MPI, numpy):
        self.MPI, self.comm = MPI, MPI.COMM_WORLD
        self.rank, self.size = self.comm.rank, self.comm.size
        self.serves = self.comm.Split_type(MPI.COMM_TYPE_SHARED).size < self.size  # there are others than this machine's
        self.serves = self.comm.bcast(self.serves) and self.rank == 0
        self.numbers = numpy.zeros(2, numpy.int64)
        self.window = MPI.Win.Allocate(8 if self.rank == 0 else 0, 8, comm=self.comm)
        if self.rank == 0:
            numpy.frombuffer(self.window.tomemory(), numpy.int64)[:] = 0
        self.comm.Barrier()
        self.window.Lock_all()

    def add(self, number):
        self.numbers[0] = number
        self.window.Fetch_and_op(self.numbers[:1], self.numbers[1:], 0, 0, self.MPI.SUM)
        self.window.Flush(0)
        return int(self.numbers[1])

    def state(self):
        self.comm.Iprobe()  # lets MPI answer the others, which an operation on this process's own memory does not
        return super().state()

    def share(self, value):
        return self.comm.bcast(value)

    def all(self, value):
        self.wait()
        return self.comm.allgather(value)

    def wait(self):
        """Until all are here, without taking a processor."""
        request = self.comm.Ibarrier()
        while not request.Test():
            time.sleep(PAUSE)

    def close(self):
        """MPI ends here: pvbatch does not end it when a script ends with a status, which mpirun takes for a crash."""
        self.window.Unlock_all()
        self.window.Free()
        sys.stdout.flush()
        sys.stderr.flush()
        self.MPI.Finalize()

    def abort(self):
        """Ends all processes, after what nobody has foreseen."""
        self.comm.Abort(1)


def together(ranks, work):
    """Calls work() in every process and returns what it does. If it fails in one, it fails in all: the first process
    raises the Failure, the others end."""
    value, failure = None, None
    try:
        value = work()
    except scripting.Failure as error:
        failure = str(error)
    failures = [text for text in ranks.all(failure) if text]
    if failures:
        raise scripting.Failure(failures[0]) if ranks.rank == 0 else SystemExit(1)
    return value


def processes():
    """How many there are, without loading MPI where there is none."""
    try:
        from vtkmodules.vtkParallelCore import vtkMultiProcessController
        controller = vtkMultiProcessController.GetGlobalController()
    except ImportError:
        controller = None
    launched = [int(os.environ[name]) for name in LAUNCHERS if os.environ.get(name, "").isdigit()]
    return max(controller.GetNumberOfProcesses() if controller else 1, *launched, 1), bool(launched)


def ranks():
    """Alone, or all processes of mpirun."""
    size, launched = processes()
    if size == 1 and not launched:
        return Alone()
    try:
        import numpy
        from mpi4py import MPI
    except ImportError:
        if size == 1:
            return Alone()
        raise scripting.Failure("several processes need mpi4py: apt install python3-mpi4py") from None
    if MPI.COMM_WORLD.size != size:
        raise scripting.Failure(f"mpirun started {size} processes, but this one knows of {MPI.COMM_WORLD.size}: "
                                "give pvbatch --symmetric, and use the mpirun of ParaView's MPI")
    return MPIRanks(MPI, numpy)
