# SPDX-License-Identifier: BSD-3-Clause
"""Runs the method on scenes with true poses and prints how many it finds.

tohoku: the Tohoku University 6D Pose Estimation Dataset (simulation), DIR/Part_P/{Part_P.STL, Scenes, Results}.
bop: a dataset in the form of the BOP benchmark, DIR/{models, test/SSSSSS}, such as `simulate` writes; without true
poses only the results are written.
world: simulated bins of the sample parts, each seen by each kind of sensor, and for each as many bins of the next part, in
which the part is not; by each choice of features. DIR/world.csv gets a row for each search and DIR/poses.csv one for each pose as they come; a run that was
stopped goes on from there (bins that failed are done, too). The table, also in DIR/world.md: strict (best five right) and
recall as below, median errors, by how much the mean probability of all poses is above the share of the right ones, the
highest probability of a pose where the part is not; and how far at most a hundred poses of like probability are from it.
A pose is right when a true one is within 10 % of the part's diameter and 5 degrees. Rates in %:
  paper   right poses / poses that came out (duplicates count)
  strict  right poses / poses asked for: each true instance counts once, a missing pose is wrong
  top1    scenes whose first pose is right
  recall, AP  (average precision) of all poses that come out, over instances that are at least half visible
  AP2-20  the benchmark's for industrial parts: AP at MSSD less than 2, 4, ..., 20 mm, over instances at least a tenth visible
  R@99    recall by the likeliest poses of all scenes, as long as 99 % of them are right
  ADD, ADI    recall at a tenth of the diameter, over instances that are at least a tenth visible, by as many poses
  MSSD, MSPD, VSD  of the benchmark: recall over its ten thresholds; AR is the mean of the three. These are of all poses
  that come out; the file holds --poses of each object
Times are the median over the scenes, without reading files and training.
"""
import argparse
import contextlib
import csv
import math
import os
import statistics
import sys
import time

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData

from .. import dataset, evaluation, instances, paper, scripting, simulation, world

COLUMNS = ("scenes  poses   paper  strict    top1  recall      AP  AP2-20    R@99  median error: mm  degrees (axis  roll)  ms/scene")
ROW = ("{part:4d}  {scenes:6d}  {poses:5d}  {paper:6.1f}  {strict:6.1f}  {top1:6.1f}  {recall:6.1f}  {AP:6.1f}  {AP_mm:6.1f}  {recall_99:6.1f}"
       "  {mm:16.3f}  {deg:7.3f} ({axis_deg:.3f} {roll_deg:.3f})  {ms:8.0f}")


def evaluation_of(model, mesh, options, features):
    """What finds and judges poses of a part, as the options have it."""
    return evaluation.Evaluation(model, options.preset, options.poses, options.threads, options.references, features, mesh)


def instances_of(options):
    """What collects the rows of --why, or None."""
    if options.why and options.found:
        raise scripting.Failure("--why tells of our own search: leave --found out")
    scripting.require_folder_of(options.why)
    return instances.Instances(references=options.references, features=options.features, preset=options.preset,
                               threads=options.threads) if options.why else None


@contextlib.contextmanager
def told(where, failed):
    """Says what fails there, and adds it to those that failed."""
    try:
        yield
    except scripting.Failure as failure:
        print(f"{where}: {failure}", file=sys.stderr)
        failed.add(where)


def run_part(part, options, lost, failed):
    """Trains, runs every scene and returns the row of the table; scenes that fail are added to `failed`."""
    mesh = evaluation.tohoku_mesh(options.folder, part)
    model = scripting.train(mesh, options.preset, options.features)
    run = evaluation_of(model, mesh, options, options.features)
    deviation = options.noise(scripting.field(model, "Diameter"))
    if options.out:
        scripting.make_folder(os.path.join(options.out, f"Part_{part}"))
    for scene in options.scenes:
        out = options.out and os.path.join(options.out, f"Part_{part}", f"trans{scene}.txt")
        if out and os.path.exists(out):
            os.remove(out)  # of an earlier run
        truth, poses, where = vtkPolyData(), vtkPolyData(), f"part {part}, scene {scene}"
        with told(where, failed):
            truth = evaluation.tohoku_truth(options.folder, part, scene)
            surface, edges = evaluation.tohoku_clouds(options.folder, part, scene)
            truth = evaluation.with_visibility(truth, model, edges, surface)
            if options.found:
                poses = dataset.stored_poses(os.path.join(options.found, f"Part_{part}", f"trans{scene}.txt"))
            else:
                surface, edges = evaluation.with_noise((surface, edges), deviation, scene)
                poses = run.find(surface, edges)
            if out:
                scripting.write_poses(poses, out, "Matrices", MaximumNumberOfPoses=options.poses)
        run.add(poses, truth)
        if lost and where not in failed:
            with told(where, failed):
                lost.add({"part": part, "scene": scene}, run, poses, truth, surface, boundary=edges)
    return {"part": part, "scenes": len(options.scenes), **run.figures()}


def print_stages(rows):
    if all(math.isnan(row["ms"]) for row in rows):
        return  # another program's poses
    print("\nmedian ms of each stage\npart  " + "  ".join(f"{stage.lower():>12}" for stage in evaluation.STAGES))
    for row in rows:
        print(f"{row['part']:4d}  " + "  ".join(f"{row[stage + '_ms']:12.0f}" for stage in evaluation.STAGES))


def tohoku(options):
    """Part by part; returns how many scenes failed."""
    rows, failed, lost = [], set(), instances_of(options)
    if options.found:
        evaluation.require_found(options.found, options.parts)
    print("part  " + COLUMNS)
    for part in options.parts:
        row = run_part(part, options, lost, failed)
        rows.append(row)
        print(ROW.format(**row), flush=True)
    print_stages(rows)
    if lost:
        lost.write(options.why)
    if options.out:
        with scripting.written(os.path.join(options.out, "tohoku.csv"), newline="") as file:
            writer = csv.DictWriter(file, list(rows[0]))
            writer.writeheader()
            writer.writerows(rows)
    return len(failed)


def place_of(image, number):
    """What messages call an object in an image."""
    return f"scene {image.scene}, image {image.number}, object {number}"


def find_objects(image, runs, camera, stored, failed):
    """The poses of each object in an image, or those stored; those that fail are left out and added to `failed`."""
    found = {}
    for number, run in runs.items():
        with told(place_of(image, number), failed):
            found[number] = stored.poses(image, number) if stored else run.find(image.scan, None, image.beside, camera)
    return found


def judge(image, found, runs, benchmark, camera, lost, failed):
    """Judges the poses of each object in an image, but for one that is not in it; those that fail are added to `failed`."""
    edges = None
    for number, run in runs.items():
        truth, poses, where = image.truth_of(number), vtkPolyData(), place_of(image, number)
        if not truth.GetNumberOfPoints():
            continue
        with told(where, failed):
            edges = edges or evaluation.scene_edges(image.scan, image.beside, camera)
            evaluation.with_visibility(evaluation.half_visible(truth), run.model, edges, image.scan)
            poses = found.get(number, poses)
        with told(where, failed):
            benchmark[number].add(poses, truth, image.scan)
        run.add(poses, truth)
        if lost and where not in failed:
            beside = {"image": image.beside, "image_camera": camera} if image.beside else {}
            with told(where, failed):
                lost.add({"part": number, "scene": image.scene, "image": image.number}, run, poses, truth, image.scan, **beside)


def bop(options):
    """Image by image, all objects in each; returns how many of these failed."""
    if options.out:
        scripting.require_folder_of(options.out)
    lost = instances_of(options)
    data = dataset.Dataset(options.folder, options.split)
    objects = options.objects or data.objects()
    stored = options.found and dataset.Found(options.found, objects)
    runs, benchmark = {}, {}
    for number in objects:
        model, mesh = data.train(number, options.preset, options.features), data.mesh(number)
        runs[number] = evaluation_of(model, mesh, options, options.features)
        benchmark[number] = dataset.BOPFigures(mesh, model)
    judged, failed = dict.fromkeys(runs, 0), set()
    with scripting.written(options.out, newline="") if options.out else contextlib.nullcontext() as file:
        results = dataset.Results(file) if file else None
        for scene in map(data.scene, options.scenes or data.scenes()):
            for step in scene.steps:
                try:
                    image = scene.image(step)
                except scripting.Failure as failure:
                    print(failure, file=sys.stderr)
                    failed.add((scene.folder, step))
                    continue
                found = find_objects(image, runs, data.beside(), stored, failed)
                if results:
                    results.add(image, found, options.poses)
                judge(image, found, runs, benchmark, data.beside(), lost, failed)
                for number in runs:
                    judged[number] += image.truth_of(number).GetNumberOfPoints() > 0
    rows = [{"part": number, "scenes": judged[number], **run.figures()} for number, run in runs.items() if judged[number]]
    if rows:
        print("obj.  " + COLUMNS)
        for row in rows:
            print(ROW.format(**row))
        print("\nobj.  recall of " + "  ".join(f"{name:>6}" for name in (*dataset.BOP_FIGURES, "AR")))
        for row in rows:
            print(f"{row['part']:4d}            " + "  ".join(f"{r:6.1f}" for r in benchmark[row["part"]].recalls().values()))
        print_stages(rows)
    if lost:
        lost.write(options.why)
    return len(failed)


def find_in_bin(run, benchmark, bins, row):
    """Finds a part in a bin, completes the bin's row and returns a row for each pose."""
    scan, truth = bins.scene(row["bin"], row["sensor"], row["seed"])
    if row["bin"] != row["part"]:
        truth = vtkPolyData()
    seen = truth.GetPointData().GetArray("VisibleFraction")
    half = {i for i in range(truth.GetNumberOfPoints()) if seen.GetValue(i) >= run.judge.GetMinimumVisibleFraction()}
    row.update(half_visible=len(half), half_visible_found=0)
    poses = run.find(scan)
    run.add(poses, truth)
    benchmark.add(poses, truth, scan)

    def median(errors):
        return f"{statistics.median(errors):.4f}" if errors.size else ""

    names = ("Right", "Duplicate", "Instance", "TranslationError", "RotationError")
    right, duplicate, instance, mm, degrees = map(run.judged, names)
    best = slice(row["asked"] or None)
    row.update(half_visible_found=len(half.intersection(instance)), poses=len(right),
               right=int((right[best] * (1 - duplicate[best])).sum()),
               mm=median(mm[best][right[best] == 1]), degrees=median(degrees[best][right[best] == 1]),
               **benchmark.row(run.figures()["AP_mm"]), ms=f"{run.times[0]['Total'] - run.times[0]['Training']:.0f}")
    probability = vtk_to_numpy(poses.GetPointData().GetArray("Probability")) if len(right) else ()
    here = {name: row[name] for name in world.BIN}
    return [{**here, "rank": i + 1, "probability": f"{probability[i]:.5f}", "right": right[i],
             "found": 0 if not right[i] else int(not duplicate[i]) if instance[i] in half else "",
             "mm": f"{mm[i]:.4f}", "degrees": f"{degrees[i]:.4f}"} for i in range(len(right))]


def world_bins(options):
    """The searches to make, those in a bin one after the other: it is simulated for the next part, too."""
    for sensor in options.sensors:
        for seed in range(options.seed, options.seed + options.bins):
            for part in options.parts:
                for lies in (part, simulation.PARTS[(simulation.PARTS.index(part) + 1) % len(simulation.PARTS)]):
                    for features in options.features:
                        yield dict(zip(world.BIN, (part, features, sensor, seed, options.copies, lies)))


def run_world(options):
    """Bin by bin; returns how many searches failed."""
    bins, record = simulation.Bins(options.copies, options.scenes), world.Record(options.out)
    planned = list(world_bins(options))
    todo = [row for row in planned if world.bin_of(row) not in record.done]
    meshes, models, start = {}, {}, time.time()
    for count, row in enumerate(todo):
        part = row["part"]
        if part not in models:
            print(f"training {part}", file=sys.stderr, flush=True)
            meshes[part] = simulation.part_mesh(part)
            models[part] = scripting.train(meshes[part], options.preset)
        row = {**dict.fromkeys(world.ROW, ""), **row, "asked": options.poses, "right": 0}
        poses = []
        try:
            poses = find_in_bin(evaluation_of(models[part], meshes[part], options, row["features"]),
                                dataset.BOPFigures(meshes[part], models[part]), bins, row)
        except scripting.Failure as failure:
            row["failure"] = str(failure)
        record.add(row, poses)
        left = (time.time() - start) / (count + 1) * (len(todo) - count - 1)
        print(f"{len(planned) - len(todo) + count + 1} of {len(planned)}: {part} by {row['features']}, {row['sensor']}, a bin of "
              f"{row['bin']}: {row['failure'] or str(row['right']) + ' right'}; {left / 60:.0f} min left", file=sys.stderr,
              flush=True)
    wanted = set(map(world.bin_of, planned))
    print(record.table(wanted), end="")
    return sum(row["failure"] != "" for row in record.bins.rows if world.bin_of(row) in wanted)


def names_of(known):
    """For argparse: some of the known names, with commas between them."""
    def read(text):
        names = text.split(",")
        unknown = [name for name in names if name not in known]
        if unknown:
            raise argparse.ArgumentTypeError(f"there is no {unknown[0]}; known are {', '.join(known)}")
        return names
    return read


def main():
    shared = argparse.ArgumentParser(add_help=False)
    scripting.add_method_options(shared)
    scripting.add_reference_argument(shared)
    shared.add_argument("--threads", type=scripting.count, default=0, help="threads to work with; 0: all cores (default)")
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    datasets = parser.add_subparsers(dest="dataset", required=True)

    stored = argparse.ArgumentParser(add_help=False)
    stored.add_argument("folder", metavar="DIR", help="where the dataset is")
    stored.add_argument("--why", metavar="CSV",
                        help="write a row for each true instance: the pose that found it, or the stage that lost it and why, which takes "
                             "another search of each scene that misses one")
    scripting.add_features_argument(stored)
    one = datasets.add_parser("tohoku", parents=[stored, shared])
    one.set_defaults(run=tohoku)
    one.add_argument("--parts", type=evaluation.numbers, default=[1, 2, 3], help="such as 1,3 (default: 1,2,3)")
    one.add_argument("--scenes", type=evaluation.numbers, default=list(range(20)), help="such as 0-4,7 (default: 0-19)")
    one.add_argument("--poses", type=scripting.count, default=5, help="poses wanted of a scene; 0: all (default: %(default)s)")
    one.add_argument("--noise", type=evaluation.noise, default="0", help=evaluation.NOISE_HELP)
    one.add_argument("--found", metavar="DIR",
                     help="judge the poses that another program left in DIR/Part_P/transI.txt, best first, 16 numbers each, "
                          "instead of looking for them")
    one.add_argument("--out", metavar="OUTDIR",
                     help="write OUTDIR/Part_P/transI.txt, 4x4 matrices best first, and OUTDIR/tohoku.csv")

    one = datasets.add_parser("bop", parents=[stored, shared])
    one.set_defaults(run=bop)
    one.add_argument("--split", default="test", help="folder of the scenes (default: %(default)s)")
    one.add_argument("--objects", type=evaluation.numbers, help="such as 1,5-7 (default: all in models/)")
    one.add_argument("--scenes", type=evaluation.numbers, help="such as 0-4,7 (default: all)")
    one.add_argument("--poses", type=scripting.count, default=5,
                     help="poses wanted of each object in an image; 0: all (default: %(default)s)")
    result = one.add_mutually_exclusive_group(required=True)
    result.add_argument("--out", metavar="CSV", help="write the poses as BOP results")
    result.add_argument("--found", metavar="PATH",
                        help="judge the poses that another program left instead of looking for them: a file of BOP results, or a "
                             "folder with PATH/obj_OOOOOO/SSSSSS_IIIIII.txt, best first, 16 numbers each")

    one = datasets.add_parser("world", parents=[shared])
    one.set_defaults(run=run_world)
    one.add_argument("--parts", type=names_of(simulation.PARTS), default=simulation.PARTS, metavar="PART,...",
                     help=f"(default: {','.join(simulation.PARTS)})")
    one.add_argument("--sensors", type=names_of(simulation.SENSORS), default=simulation.SENSORS, metavar="SENSOR,...",
                     help=f"(default: {','.join(simulation.SENSORS)})")
    one.add_argument("--features", type=names_of(scripting.FEATURES), default=scripting.FEATURES, metavar="FEATURES,...",
                     help=f"points that vote (default: {','.join(scripting.FEATURES)})")
    one.add_argument("--bins", type=scripting.count, default=5,
                     help="of each part and sensor, and as many without the part (default: %(default)s)")
    one.add_argument("--seed", type=scripting.count, default=1,
                     help="of the first bin, the next has the next one (default: %(default)s)")
    one.add_argument("--copies", type=scripting.count, default=20, help="copies in a bin (default: %(default)s)")
    one.add_argument("--poses", type=scripting.count, default=5, help="poses wanted of a bin; 0: all (default: %(default)s)")
    one.add_argument("--scenes", metavar="DIR",
                     help="keep the simulated bins there (.vts and .vtp) and read those that are there")
    one.add_argument("--out", metavar="DIR", required=True, help="write DIR/world.csv, DIR/poses.csv and DIR/world.md")
    paper.add_parser(datasets, shared)
    options = parser.parse_args()
    failures = options.run(options)
    if failures:
        raise scripting.Failure(f"{failures} failed, see above; where the search or the check of the true poses failed nothing counts as found")
