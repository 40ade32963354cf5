#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Finds a part in simulated bins whose scans get worse: surfaces that shine have no depth, exposure is wrong, depth is missing
anywhere. The bins are the same at every level. strict, recall: %, see tohoku.py."""
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

from ppfmeam import evaluation, scripting

import results
from scenes import bin_source, outputs_of

SHINE = (0, 10, 20, 30)        # degrees: a surface that faces the sensor to within them has no depth
EXPOSURE = (0.06, 0.25, 2, 4)  # times the light; a pixel is white from 255 on
MISSING = (20, 50, 80)         # % of the pixels without depth, anywhere
LEVELS = [("shine, degrees", level) for level in SHINE] + [("exposure", level) for level in EXPOSURE] + [
    ("missing, %", level) for level in MISSING]
IMAGE_NOISE = 1.5  # grey values, whatever the exposure


def exposed(scan, factor, seed):
    """The scan with the grey values that another exposure makes of its own."""
    data, random = scan.NewInstance(), numpy.random.default_rng(seed)
    data.ShallowCopy(scan)
    grey = vtk_to_numpy(scan.GetPointData().GetArray("Intensity"))
    noisy = numpy.clip(numpy.rint(factor * grey + random.normal(0, IMAGE_NOISE, grey.shape)), 0, 255)
    array = numpy_to_vtk(noisy.astype(grey.dtype), deep=True)
    array.SetName("Intensity")
    data.GetPointData().AddArray(array)
    return data


def simulate(source, what, level, seed):
    """The scan and the true poses of a bin at a level."""
    source.SetGlareAngle(level if what == "shine, degrees" else -1)
    source.SetDropout(level / 100 if what == "missing, %" else -1)
    scan, truth = outputs_of(source, 0, 1)
    return exposed(scan, level, seed) if what == "exposure" else scan, truth


def measure(cad, cad_scale=1.0, copies=20, scenes=5, seed=1):
    mesh = scripting.read_mesh(cad, scale=cad_scale)
    model = scripting.train(mesh)
    runs = {level: evaluation.Evaluation(model, poses_asked_for=5) for level in LEVELS}
    progress = results.Progress(scenes, scenes)
    for number in range(seed, seed + scenes):
        source = bin_source(mesh, copies, number)
        for (what, level), run in runs.items():
            scan, truth = simulate(source, what, level, number)
            run.add(run.find(scan), truth)
        progress.tell(f"bin {number} is done")
    return [{"what": what, "level": level, **{name: run.figures()[name] for name in ("strict", "recall", "mm", "deg")}}
            for (what, level), run in runs.items()]


if __name__ == "__main__":
    results.command(measure, cad="CAD file of the part", cad_scale="factor to mm", seed="of the first bin", scenes="bins")
