# SPDX-License-Identifier: BSD-3-Clause
"""A series of three scans: every filter that has a scene follows its time, whatever its first input is."""
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline

from ppfmeam import filters
from meamtest import Errors, Trained, check, connect, field, plate, pose_error, run, tuples
from chains import Detection

TIMES = (0.0, 1.5, 4.0)  # seconds of the three scans


class Series(VTKPythonAlgorithmBase):
    """Scans one after the other, and beside them the true poses."""

    def __init__(self, scans, truths):
        super().__init__(nInputPorts=0, nOutputPorts=2, outputType="vtkStructuredGrid")
        self.data = scans, truths

    def FillOutputPortInformation(self, port, info):
        info.Set(vtkDataObject.DATA_TYPE_NAME(), ("vtkStructuredGrid", "vtkPolyData")[port])
        return 1

    def RequestInformation(self, request, inputs, outputs):
        for port in range(2):
            info = outputs.GetInformationObject(port)
            info.Set(Pipeline.TIME_STEPS(), TIMES, len(TIMES))
            info.Set(Pipeline.TIME_RANGE(), (TIMES[0], TIMES[-1]), 2)
        outputs.GetInformationObject(0).Set(Pipeline.WHOLE_EXTENT(), self.data[0][0].GetExtent(), 6)
        return 1

    def RequestData(self, request, inputs, outputs):
        for port in range(2):
            info = outputs.GetInformationObject(port)
            time = info.Get(Pipeline.UPDATE_TIME_STEP()) if info.Has(Pipeline.UPDATE_TIME_STEP()) else TIMES[0]
            data = self.data[port][max((i for i, t in enumerate(TIMES) if t <= time), default=0)]
            info.Get(data.DATA_OBJECT()).ShallowCopy(data)
        return 1


part = plate()


def bin_of(seed):
    source = connect(filters.vtkMEAMBinSceneSource(), part, Copies=3, Width=480, Height=360, Seed=seed)
    run(source)
    return [source.GetOutputDataObject(port) for port in range(3)]


bins = [bin_of(seed) for seed in (1, 2, 3)]
part = bins[0][2]
series = Series([scan for scan, _, _ in bins], [truth for _, truth, _ in bins])
trained = Trained(part)
model = run(trained.model)
diameter = field(model, "Diameter")[0][0]


def at(filter, time, port=0):
    """The output at a time; fails on any error."""
    errors = Errors(filter)
    filter.UpdateTimeStep(time, -1, 1, 0, port) if port else filter.UpdateTimeStep(time)
    check(not errors.messages, f"{filter.GetClassName()}: {errors}")
    return filter.GetOutputDataObject(port)


def announces(filter):
    """All outputs have the times of the scene."""
    filter.UpdateInformation()
    for port in range(filter.GetNumberOfOutputPorts()):
        info = filter.GetOutputInformation(port)
        name = f"{filter.GetClassName()}, output {port}"
        check(info.Get(Pipeline.TIME_STEPS()) == TIMES, f"{name}: steps {info.Get(Pipeline.TIME_STEPS())}")
        check(info.Get(Pipeline.TIME_RANGE()) == (TIMES[0], TIMES[-1]), f"{name}: {info.Get(Pipeline.TIME_RANGE())}")


def rightly(poses, truth):
    """The best pose is one of the true ones."""
    found = tuples(poses, "Transform")[0]
    return any(mm < 0.1 * diameter and degrees < 5 for mm, degrees in
               (pose_error(found, true) for true in tuples(truth, "Transform")))


estimation = connect(filters.vtkMEAMPoseEstimation(), model)
estimation.SetInputConnection(1, series.GetOutputPort(0))

# The chain of single filters, the part's model first where a filter has it first.
edges = connect(filters.vtkMEAMSceneEdgeExtraction(), series)
steps = Detection(model, edges, series)
resolved = connect(filters.vtkMEAMConflictResolution(), steps.selection, model, steps.tangents, series)
instances = connect(filters.vtkMEAMPoseInstances(), resolved, part)
chain = [edges, *steps.steps, resolved, instances]

for filter in (estimation, *chain):
    announces(filter)

# Played forwards, back, and from one to the other, each step has its own poses.
expected = {}
for step in (0, 1, 2, 1, 0, 2):
    scan, truth, _ = bins[step]
    poses = at(estimation, TIMES[step])
    check(rightly(poses, truth), f"step {step}: the first pose is not a true one of its scan")
    check(poses.GetInformation().Get(poses.DATA_TIME_STEP()) == TIMES[step], f"step {step}: the data have another time")
    alone = connect(filters.vtkMEAMPoseEstimation(), model, scan)
    expected.setdefault(step, tuples(run(alone), "Transform"))
    check(tuples(poses, "Transform") == expected[step], f"step {step}: other poses than of the scan alone")
    found = estimation.GetOutputDataObject(1)
    check(found.GetNumberOfPoints() == run(connect(filters.vtkMEAMSceneEdgeExtraction(), scan)).GetNumberOfPoints(),
          f"step {step}: the edges are another step's")
    check(rightly(at(resolved, TIMES[step]), truth), f"step {step}: the chain's first pose is not a true one of its scan")
    at(instances, TIMES[step])
check(len({tuple(poses) for poses in expected.values()}) == 3, "three scans, three results")

# What came before the first step is the first step; poses of a scan without time are what they are.
check(tuples(at(estimation, -7.0), "Transform") == expected[0], "before the first step")
single = connect(filters.vtkMEAMPoseEstimation(), model, bins[1][0])
single.UpdateInformation()
check(not single.GetOutputInformation(0).Has(Pipeline.TIME_STEPS()), "a scan alone has no time")
check(tuples(at(single, 4.0), "Transform") == expected[1], "a scan alone at any time")

# Poses from a file, which have no time, judged against the truths of a series.
judge = connect(filters.vtkMEAMPoseEvaluation(), bins[1][1])
judge.SetInputConnection(1, series.GetOutputPort(1))
judge.SetDiameter(diameter)
judge.SetPosesAskedFor(3)
announces(judge)
rates = [field(at(judge, time), "StrictRate")[0][0] for time in TIMES]
check(rates[1] == 100 and rates[0] < 100 and rates[2] < 100, f"the truths of step 1 are right at step 1 alone: {rates}")
