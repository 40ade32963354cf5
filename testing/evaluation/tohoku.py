#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the method on the Tohoku University 6D Pose Estimation Dataset (simulation), DIR/Part_P/{Part_P.STL, Scenes, Results}, and
prints a row for each part. A pose is right when a true one is within 10 % of the part's diameter and 5 degrees. Rates in %:
paper, right poses of those that came out; strict, of those asked for, each true instance once; top1, scenes whose first pose is
right; recall, AP and recall_99 (at 99 % precision) of instances at least half visible by all poses that come out; AP_mm, at MSSD
of 2 to 20 mm. Times are medians, without reading files and training."""
import os

from vtkmodules.vtkCommonDataModel import vtkPolyData

from ppfmeam import dataset, evaluation, instances, scripting

import results
import scenes as sources


def part_row(folder, part, scenes, poses, threads, noise, found, matrices, preset, lost):
    """Trains, runs every scene and returns the row of the table."""
    mesh = sources.tohoku_mesh(folder, part)
    model = scripting.train(mesh, preset)
    run = evaluation.Evaluation(model, preset, poses, threads, mesh=mesh)
    deviation = noise(scripting.field(model, "Diameter"))
    if matrices:
        scripting.make_folder(os.path.join(matrices, f"Part_{part}"))
    for scene in scenes:
        out = matrices and os.path.join(matrices, f"Part_{part}", f"trans{scene}.txt")
        if out and os.path.exists(out):
            os.remove(out)  # of an earlier run
        truth, there, where = vtkPolyData(), vtkPolyData(), f"part {part}, scene {scene}"
        with results.told(where):
            truth = sources.tohoku_truth(folder, part, scene)
            surface, edges = sources.tohoku_clouds(folder, part, scene)
            truth = evaluation.with_visibility(truth, model, edges, surface)
            if found:
                there = dataset.stored_poses(os.path.join(found, f"Part_{part}", f"trans{scene}.txt"))
            else:
                surface, edges = sources.with_noise((surface, edges), deviation, scene)
                there = run.find(surface, edges)
            if out:
                scripting.write_poses(there, out, "Matrices", MaximumNumberOfPoses=poses)
        run.add(there, truth)
        if lost and where not in results.failed:
            with results.told(where):
                lost.add({"part": part, "scene": scene}, run, there, truth, surface, boundary=edges)
    return {"part": part, "scenes": len(scenes), **run.figures()}


def measure(dir, parts: evaluation.numbers = [1, 2, 3], scenes: evaluation.numbers = list(range(20)), poses=5,
            preset="recommended", threads=0,
            noise: sources.noise = "0", found=None, matrices=None, why=None):
    if why and found:
        raise scripting.Failure("--why tells of our own search: leave --found out")
    scripting.require_folder_of(why)
    if found:
        sources.require_found(found, parts)
    lost = instances.Instances(preset=preset, threads=threads) if why else None
    noise = sources.noise(noise) if isinstance(noise, str) else noise
    rows = [part_row(dir, part, scenes, poses, threads, noise, found, matrices, preset, lost) for part in parts]
    if lost:
        lost.write(why)
    return rows


if __name__ == "__main__":
    results.command(measure, dir="where the dataset is", parts="such as 1,3", scenes="such as 0-4,7", poses="wanted of a scene",
                    noise=sources.NOISE_HELP,
                    preset="recommended or paper, or what the paper compares itself with: without-meam, ppf, b2b",
                    found="folder of poses that another program left, Part_P/transI.txt, best first, 16 numbers each: judge these",
                    matrices="folder that gets Part_P/transI.txt, 4x4 matrices best first",
                    why="CSV with a row for each true instance: the pose that found it, or the stage that lost it and why")
