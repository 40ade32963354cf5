#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Finds a part in simulated bins, the depth of which gets noisier and then the image worse. The bins are the same at every level,
and so are the random numbers of the noise; what is not varied has the simulated sensor's defaults. Edges are those of the scan's
image and of its depth, of the image alone, or both without the bin's walls (Region of BackgroundRemoval). Columns: see
tohoku.py."""
from vtkmodules.vtkCommonDataModel import vtkPolyData

from ppfmeam import evaluation, filters, scripting

import results
from scenes import bin_source, outputs_of

# The second of each is the default. The levels of one place are simulated at once, for the sensor draws the same random
# numbers whatever its quality: the physics is what takes time.
DEPTHS = (0.0, 0.3, 0.6, 0.9, 1.2, 1.5)  # mm at 1 m
IMAGES = ((0.0, 0.0), (1.5, 0.7), (8.0, 1.5), (12.0, 2.0), (16.0, 2.5), (20.0, 3.0))  # grey values, blur in pixels
DEFAULT = 1
WORST = (3, 4, 5)  # images that are also tried with other edges
BOTH, IMAGE, INSIDE = "both", "image", "no walls"  # where edges are looked for
INNER = 0.97  # of the bin's side: what is nearer to a wall is left out
LEVELS = list(dict.fromkeys([(depth, DEFAULT, BOTH) for depth in range(len(DEPTHS))] + [(DEFAULT, image, BOTH)
                                                                                        for image in range(len(IMAGES))]
                            + [(DEFAULT, image, edges) for edges in (IMAGE, INSIDE) for image in WORST]))


def simulate(source, level):
    """The scan, the true poses and the image of a bin, the depth and the image at a level."""
    source.SetDepthNoise(DEPTHS[level])
    source.SetImageNoise(IMAGES[level][0])
    source.SetImageBlur(IMAGES[level][1])
    return outputs_of(source, 0, 1, 3)


def find(run, scan, image, where):
    """The poses in a scan, by the edges that are wanted."""
    if where == BOTH:
        return run.find(scan, image=image)
    background, edges = filters.vtkMEAMBackgroundRemoval(), filters.vtkMEAMSceneEdgeExtraction()
    half = INNER * scripting.field(scan, "BinSize") / 2 if where == INSIDE else 0.0  # 0: no limits
    background.SetInputDataObject(scan)
    background.SetRegion(-half, half, -half, half, 0, 0)
    background.SetNumberOfPlanes(0)
    edges.SetInputConnection(background.GetOutputPort())
    edges.SetInputDataObject(1, image)
    edges.SetDepthEdges(where != IMAGE)
    return run.find(scan, scripting.update(edges).GetOutputDataObject(0))


def measure(cad, cad_scale=1.0, copies=20, scenes=5, seed=1, poses=5, threads=0):
    if min(copies, scenes, poses) < 1:
        raise scripting.Failure("--copies, --scenes and --poses have to be 1 or more")
    mesh = scripting.read_mesh(cad, scale=cad_scale)
    model = scripting.train(mesh)
    runs = {level: evaluation.Evaluation(model, poses_asked_for=poses, threads=threads) for level in LEVELS}
    progress = results.Progress(scenes, scenes)
    for number in range(seed, seed + scenes):
        source = bin_source(mesh, copies, number)
        places = [simulate(source, level) for level in range(len(DEPTHS))]
        for (depth, image, edges), run in runs.items():
            found = vtkPolyData()
            with results.told(f"bin {number}, {DEPTHS[depth]} mm, image {IMAGES[image]}, {edges}"):
                found = find(run, places[depth][0], places[image][2], edges)
            run.add(found, places[depth][1])
        progress.tell(f"bin {number} is done")
    return [{"depth noise, mm": DEPTHS[depth], "image noise": IMAGES[image][0], "blur, pixels": IMAGES[image][1], "edges": edges,
             **{name: run.figures()[name] for name in ("strict", "top1", "recall", "AP", "mm", "deg")}}
            for (depth, image, edges), run in runs.items()]


if __name__ == "__main__":
    results.command(measure, cad="CAD file of the part", cad_scale="factor to mm", seed="of the first bin", scenes="bins")
