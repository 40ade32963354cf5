#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Finds a part in simulated bins, the depth of which gets noisier and then the image worse, and prints what is found.

The bins are the same at every level, and so are the random numbers of the noise. What is not varied has the simulated
sensor's defaults. The scan's edges are those of its image and of its depth; where a row says so, those of the image alone,
or both without the bin's walls (Region of BackgroundRemoval). Columns:
  strict   right poses among the best / poses asked for, in %: each true instance counts once, a missing pose is wrong
  recall   of the instances that are at least half visible, in %, by all poses that come out
  mm, deg  median errors of the right poses
"""
import argparse
import csv
import sys

from vtkmodules.vtkCommonDataModel import vtkPolyData

from ppfmeam import evaluation, filters, scripting

# The second of each is the default. The levels of one place are simulated at once, for the sensor draws the same random
# numbers whatever its quality: the physics is what takes time.
DEPTHS = (0.0, 0.3, 0.6, 0.9, 1.2, 1.5)  # mm at 1 m
IMAGES = ((0.0, 0.0), (1.5, 0.7), (8.0, 1.5), (12.0, 2.0), (16.0, 2.5), (20.0, 3.0))  # grey values, blur in pixels
DEFAULT = 1
WORST = (3, 4, 5)  # images that are also tried with other edges
BOTH, IMAGE, INSIDE = "both", "image", "no walls"  # where edges are looked for
INNER = 0.97  # of the bin's side: what is nearer to a wall is left out
FIGURES = ("strict", "top1", "recall", "AP", "mm", "deg")


def options_of_user():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    scripting.add_bin_arguments(parser, scenes=5)
    parser.add_argument("--poses", type=scripting.count, default=5, help="poses wanted of a scene; 0: all (default: %(default)s)")
    parser.add_argument("--threads", type=scripting.count, default=0, help="threads to work with; 0: all cores (default)")
    parser.add_argument("--out", metavar="CSV", help="write the table, with more columns")
    options = parser.parse_args()
    if min(options.copies, options.scenes) < 1:
        parser.error("--copies and --scenes have to be 1 or more")
    return options


def levels():
    """The rows: index of the depth, index of the image, and where edges are looked for."""
    return ([(depth, DEFAULT, BOTH) for depth in range(len(DEPTHS))]
            + [(DEFAULT, image, BOTH) for image in range(len(IMAGES))]
            + [(DEFAULT, image, edges) for edges in (IMAGE, INSIDE) for image in WORST])


def simulate(source, level):
    """The scan, the true poses and the image of a bin, the depth and the image at a level."""
    source.SetDepthNoise(DEPTHS[level])
    source.SetImageNoise(IMAGES[level][0])
    source.SetImageBlur(IMAGES[level][1])
    scripting.update(source)
    outputs = []
    for port in (0, 1, 3):
        outputs.append(source.GetOutputDataObject(port).NewInstance())
        outputs[-1].ShallowCopy(source.GetOutputDataObject(port))
    return outputs


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


def measure(mesh, options):
    """The figures of each level, and how many scans failed."""
    model = scripting.train(mesh)
    runs = {level: evaluation.Evaluation(model, poses_asked_for=options.poses, threads=options.threads)
            for level in dict.fromkeys(levels())}
    source, failed = filters.vtkMEAMBinSceneSource(), 0
    source.SetInputDataObject(mesh)
    source.SetCopies(options.copies)
    for seed in range(options.seed, options.seed + options.scenes):
        source.SetSeed(seed)
        scenes = [simulate(source, level) for level in range(len(DEPTHS))]
        for (depth, image, edges), run in runs.items():
            poses = vtkPolyData()
            try:
                poses = find(run, scenes[depth][0], scenes[image][2], edges)
            except scripting.Failure as failure:
                print(f"bin {seed}, {words(depth, image, edges)}: {failure}", file=sys.stderr)
                failed += 1
            run.add(poses, scenes[depth][1])
        print(f"bin {seed} is done", file=sys.stderr)
    return {level: run.figures() for level, run in runs.items()}, failed


def words(depth, image, edges):
    noise, blur = IMAGES[image]
    return f"{DEPTHS[depth]:8.1f}  {noise:11.1f}  {blur:4.1f}  {edges:>10}"


def main():
    options = options_of_user()
    scripting.require_folder_of(options.out)
    table, failed = measure(scripting.read_mesh(options.cad, scale=options.cad_scale), options)
    print("depth mm  image noise  blur       edges   strict   recall     mm    deg")
    for level in levels():
        print(words(*level) + "   {strict:4.0f} %   {recall:4.0f} %  {mm:5.3f}  {deg:5.3f}".format(**table[level]))
    if options.out:
        with scripting.written(options.out, newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(("depth_noise_mm", "image_noise", "image_blur_px", "edges", *FIGURES))
            for level, figures in table.items():
                depth, image, edges = level
                writer.writerow((DEPTHS[depth], *IMAGES[image], edges, *(figures[name] for name in FIGURES)))
    if failed:
        raise scripting.Failure(f"{failed} scans failed; they count as scenes in which nothing was found")


scripting.run(main)
