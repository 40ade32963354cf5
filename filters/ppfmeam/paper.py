# SPDX-License-Identifier: BSD-3-Clause
"""The experiments of the paper (Liu et al., Sensors 2018, Section 6): its tables and Figure 13, with parts of our own in
place of its parts A to D, which were never published, beside the paper's figures."""
import argparse
import os
import sys
import time

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkStructuredGrid

from . import cell, charts, dataset, evaluation, filters, papertables, scripting, simulation, stage, world
from .papertables import COPIES, FOUND, OUTCOMES, PARTS, POSE, ROW, TABLES, name_of, run_of

POSES = 5  # wanted of a scene
QUICK = 3  # scenes of each part in a quick run
QUICK_COPIES = 6
QUICK_VIEWS = (1, 6)
QUICK_PICKS = 3  # copies in the bin of Table 9
EDGE_TOLERANCE = 0.01  # of the diameter: an edge point so far behind what is measured there is hidden
TOHOKU_PARTS = (1, 2, 3)


class Scenes:
    """Scenes with their true poses, by source: `perfect`, `image` or `tohoku`; `found`: by the names of other programs the
    folders with the poses that they left of the dataset."""

    def __init__(self, bins, copies, data, found=None):
        self.bins, self.data, self.found = bins, data, found or {}
        self.simulated = simulation.Bins(copies, bins and os.path.join(bins, "bins"))
        self.meshes, self.models, self.edges, self.last = {}, {}, {}, (None, None)

    def mesh(self, part):
        if part not in self.meshes:
            tohoku = part.startswith("tohoku_")
            self.meshes[part] = evaluation.tohoku_mesh(self.data, int(part[-1])) if tohoku else simulation.part_mesh(part)
        return self.meshes[part]

    def model(self, part, method, views):
        """A trained model; those of a part are kept until another's is asked for."""
        method = "recommended" if method.startswith(FOUND) else method  # it tells when poses are equal
        kind = (part, method, views)
        if kind not in self.models:
            self.models = {known: model for known, model in self.models.items() if known[0] == part}
            training = scripting.Training(self.mesh(part), method)
            if views != "6":
                training.views.SetNumberOfViewpoints(int(views))
            self.models[kind] = training.model()
        return self.models[kind]

    def scene(self, row):
        """The surface, the edge points if they are given, the true poses of a row's scene, and the scan of a bin with its
        image. What of the true poses is visible, and whether they are of this scene, the recommended model tells for all
        methods. The last scene is remembered."""
        kind = (row["part"], row["source"], row["seed"])
        if self.last[0] != kind:
            self.last = (kind, self.tohoku(row) if row["source"] == "tohoku" else self.bin(row))
        return self.last[1]

    def tohoku(self, row):
        part, seed = int(row["part"][-1]), int(row["seed"])
        surface, edges = evaluation.tohoku_clouds(self.data, part, seed)
        truth = evaluation.tohoku_truth(self.data, part, seed)
        return surface, edges, evaluation.with_visibility(truth, self.model(row["part"], "recommended", "6"), edges, surface), None

    def bin(self, row):
        scan, truth = self.simulated.scene(row["part"], simulation.SENSORS[0], int(row["seed"]))
        if row["source"] == "image":
            return scan, None, truth, scan
        exact, edges = self.perfect(row["part"], truth)
        return exact, edges, truth, None

    def find(self, run, row):
        """The poses and the true ones of a row's scene, and the scan of a bin with its image."""
        surface, edges, truth, scan = self.scene(row)
        return self.stored(row) if row["method"].startswith(FOUND) else run.find(surface, edges), truth, scan

    def stored(self, row):
        """The poses that another program left."""
        return dataset.stored_poses(os.path.join(self.found[name_of(row["method"])], f"Part_{row['part'][-1]}", f"trans{row['seed']}.txt"))

    def seconds(self, row):
        """How long another program took, where it has left that in seconds.txt: lines of the scan's path and seconds."""
        path = os.path.join(self.found[name_of(row["method"])], "seconds.txt")
        scan = os.path.join(f"Part_{row['part'][-1]}", "Scenes", f"Scene{row['seed']}.pcd")
        for line in scripting.whole_lines(path) if os.path.exists(path) else ():
            name, _, seconds = line.strip().rpartition(" ")
            if name.endswith(scan):
                try:
                    return float(seconds)
                except ValueError:
                    raise scripting.Failure(f"{path}: {line.strip()} does not end with a number of seconds") from None
        return None

    def perfect(self, part, truth):
        """The parts at those true poses, without the bin, as a sensor without any error sees them, and the edge points of
        the part's edge appearance models at each pose, as far as nothing hides them (Section 6.1)."""
        source = filters.vtkMEAMBinSceneSource()
        source.SetInputDataObject(self.mesh(part))
        source.SetInputDataObject(1, truth)
        for name in ("DepthNoise", "DepthStep", "Dropout", "JumpDropout"):
            getattr(source, "Set" + name)(0)
        source.SetMatchingWindow(1)
        scan = vtkStructuredGrid()
        scan.DeepCopy(scripting.update(source).GetOutput())
        vtk_to_numpy(scan.GetPoints().GetData())[vtk_to_numpy(scan.GetPointData().GetArray("Instance")) < 0] = numpy.nan
        if part not in self.edges:
            self.edges[part] = model_edges(self.model(part, "paper", "6"))
        return scan, seen(self.edges[part], truth, scan)


def model_edges(model):
    """The edge points of a trained model."""
    for index in range(model.GetNumberOfPartitionedDataSets()):
        if model.GetMetaData(index).Get(model.NAME()) == "Edges":
            return vtk_to_numpy(model.GetPartitionedDataSet(index).GetPartition(0).GetPoints().GetData()).astype(float)
    raise scripting.Failure("the model has no edges")


def seen(edges, truth, scan):
    """Of the part's edge points at each pose those that no measured point hides, as a cloud."""
    size = [0, 0, 0]
    scan.GetDimensions(size)
    depth = vtk_to_numpy(scan.GetPoints().GetData())[:, 2].reshape(size[1], size[0])
    fx, _, cx, _, fy, cy, _, _, _ = scan.GetFieldData().GetArray("CameraMatrix").GetTuple(0)
    tolerance = EDGE_TOLERANCE * scripting.field(truth, "Diameter")
    kept = []
    for transform in vtk_to_numpy(truth.GetPointData().GetArray("Transform")).reshape(-1, 4, 4):
        x, y, z = (edges @ transform[:3, :3].T + transform[:3, 3]).T
        column, row = (numpy.rint(value).astype(int) for value in (fx * x / z + cx, fy * y / z + cy))
        inside = (column >= 0) & (row >= 0) & (column < size[0]) & (row < size[1])
        behind = numpy.full(len(z), -numpy.inf)
        behind[inside] = numpy.nan_to_num(depth[row[inside], column[inside]], nan=numpy.inf)  # nothing before the bin
        kept.append(numpy.stack((x, y, z), 1)[z <= behind + tolerance])
    cloud = vtkPolyData()
    cloud.SetPoints(vtkPoints())
    cloud.GetPoints().SetData(numpy_to_vtk(numpy.concatenate(kept).astype(numpy.float32), deep=True))
    return cloud


class Record:
    """The searches that are done: DIR/paper.csv, a row for each, and DIR/poses.csv, one for each of the best poses. Searches that
    failed are made again, and poses of other programs judged again."""

    def __init__(self, folder):
        self.searches = world.Lines(os.path.join(folder, "paper.csv"), ROW, lambda row: not (row["failure"] or row["method"].startswith(FOUND)))
        self.done = set(map(run_of, self.searches.rows))
        self.poses = world.Lines(os.path.join(folder, "poses.csv"), POSE, lambda row: run_of(row) in self.done)

    def add(self, row, poses):
        """A search and its poses; the search last, with it it is done."""
        self.poses.add(poses)
        self.searches.add([row])
        self.done.add(run_of(row))


def search(row, scenes, threads):
    """A row's search: the row, complete, and a row for each of its best poses."""
    result = {**dict.fromkeys(ROW, ""), **row, "asked": POSES}
    try:
        mesh, model = scenes.mesh(row["part"]), scenes.model(row["part"], row["method"], row["views"])
        of_others = row["method"].startswith(FOUND)
        run = evaluation.Evaluation(model, "recommended" if of_others else row["method"], POSES, threads, mesh=mesh)
        poses, truth, scan = scenes.find(run, row)
        run.add(poses, truth)
        if scan:
            benchmark = dataset.BOPFigures(mesh, model)
            benchmark.add(poses, truth, scan)
            result.update(benchmark.row(run.figures()["AP_mm"]))
        outcomes, mm, degrees = (run.judged(name)[:POSES].tolist() for name in ("Outcome", "TranslationError", "RotationError"))
        seconds = scenes.seconds(row) if of_others else (run.times[0]["Total"] - run.times[0]["Training"]) / 1000
        result.update(poses=len(outcomes), **{name: outcomes.count(kind) for kind, name in enumerate(OUTCOMES)},
                      ms="" if seconds is None else f"{1000 * seconds:.0f}")
    except scripting.Failure as failure:
        return {**result, "failure": str(failure)}, []
    known = poses.GetPointData().GetArray("Probability")
    return result, [{**{name: row[name] for name in papertables.RUN}, "rank": k + 1,
                     "probability": f"{known.GetValue(k):.5f}" if known else "", "outcome": OUTCOMES[outcome],
                     "mm": f"{mm[k]:.4f}", "degrees": f"{degrees[k]:.4f}"} for k, outcome in enumerate(outcomes)]


def measure(rows, record, scenes, threads):
    """Runs the searches that are not done; each is a row as soon as it is."""
    todo = [row for row in rows if run_of(row) not in record.done]
    start = time.time()
    for count, row in enumerate(todo):
        result, poses = search(row, scenes, threads)
        record.add(result, poses)
        left = (time.time() - start) / (count + 1) * (len(todo) - count - 1)
        print(f"{len(rows) - len(todo) + count + 1} of {len(rows)}: {name_of(row['method'])}, {row['part']}, {row['source']} scene "
              f"{row['seed']}: {result['failure'] or str(result['right']) + ' right'}; {left / 60:.0f} min left",
              file=sys.stderr, flush=True)


def found_by(text):
    """For argparse: NAME=DIR."""
    name, equals, folder = text.partition("=")
    if not (name and equals and folder):
        raise argparse.ArgumentTypeError(f"it has to be NAME=DIR, not {text}")
    return name, folder


def add_parser(datasets, shared):
    """The sub-command of evaluate.py."""
    one = datasets.add_parser("paper", parents=[shared], help="the paper's own experiments, its figures beside ours")
    one.set_defaults(run=run)
    which = one.add_mutually_exclusive_group(required=True)
    which.add_argument("--table", type=evaluation.numbers, metavar="N,...", help="such as 1,2 or 5-8")
    which.add_argument("--figure", type=int, choices=(13,), metavar="13", help="the stage: relative errors of moves and turns")
    which.add_argument("--all", action="store_true", help="all of them")
    one.add_argument("--scenes", type=scripting.count, default=30, help="of each part (default: %(default)s)")
    one.add_argument("--quick", action="store_true",
                     help=f"to see it run: {QUICK} scenes of each part, {QUICK_COPIES} copies, {' and '.join(map(str, QUICK_VIEWS))} appearance models, "
                          f"of Table 9 one bin of {QUICK_PICKS} parts and of Figure 13 one trial")
    one.add_argument("--seed", type=scripting.count, default=1, help="of the first bin, the next has the next one")
    one.add_argument("--copies", type=scripting.count, default=COPIES, help="in a bin (default: %(default)s)")
    one.add_argument("--tohoku", metavar="DIR", help="where the Tohoku dataset is, for tables 7 and 8")
    one.add_argument("--found", metavar="NAME=DIR", type=found_by, action="append", default=[],
                     help="in tables 7 and 8 also the poses that another program left in DIR/Part_P/transI.txt, best first, 16 numbers "
                          "each, and its times, where DIR/seconds.txt has lines such as Part_1/Scenes/Scene0.pcd 0.5; again for more")
    one.add_argument("--out", metavar="DIR", required=True,
                     help="write there paper.csv, a row for each scene, and poses.csv, one for each pose, from which a run goes on "
                          "that was stopped, scenes that failed again; of each table a .md, a .csv and a chart; and the bins")


def tables_of(options):
    """The numbers of the tables to make of scenes, and whether Table 9 is wanted; says what is wrong with the options."""
    numbers = list(TABLES) if options.all else options.table or []
    for number in numbers:
        if number not in TABLES and number != 9:
            raise scripting.Failure(f"there is no table {number}; known are 1 to 9")
    for name in ("scenes", "copies"):
        if getattr(options, name) < 1:
            raise scripting.Failure(f"--{name} has to be 1 or more")
    of_dataset = [number for number in numbers if number in TABLES and TABLES[number].source == "tohoku"]
    if options.tohoku and not os.path.isdir(options.tohoku):
        raise scripting.Failure(f"cannot read {options.tohoku}: --tohoku has to be the folder that holds Part_1, Part_2 and Part_3")
    if of_dataset and not options.tohoku:
        if not options.all:
            raise scripting.Failure(f"table {of_dataset[0]} needs the Tohoku dataset: --tohoku DIR")
        print("tables 7 and 8 are left out: they need the Tohoku dataset, --tohoku DIR", file=sys.stderr)
        numbers = [number for number in numbers if number not in of_dataset]
    if options.found and not (of_dataset and options.tohoku):
        raise scripting.Failure("--found is for tables 7 and 8, which need --tohoku DIR")
    for _, folder in options.found:
        evaluation.require_found(folder, TOHOKU_PARTS)
    return [number for number in numbers if number != 9], options.all or 9 in numbers


def searches(tables, options, scenes, copies):
    """The rows to measure: of the dataset as many scenes as there are, and of a part that is not there one, which says so."""
    there = {f"tohoku_{part}": evaluation.tohoku_scenes(options.tohoku, part, scenes) or [0] for part in TOHOKU_PARTS} if options.tohoku else {}
    return [row for row in papertables.planned(tables, scenes, options.seed, copies)
            if (row["source"] != "tohoku" or int(row["seed"]) in there[row["part"]])
            and not (options.quick and int(row["views"]) not in QUICK_VIEWS)]


def run(options):
    """Returns how many searches failed."""
    numbers, picking = tables_of(options)
    scripting.make_folder(options.out)
    scenes, copies, bins, parts, trials = options.scenes, options.copies, cell.BINS, cell.COPIES, stage.TRIALS
    if options.quick:
        scenes, copies, bins, parts, trials = min(scenes, QUICK), min(copies, QUICK_COPIES), 1, QUICK_PICKS, 1
    found = dict(options.found)
    tables = papertables.with_others(found)
    record = Record(options.out)
    rows = searches([tables[number] for number in numbers], options, scenes, copies)
    measure(rows, record, Scenes(options.out, copies, options.tohoku, found), options.threads)
    order = {run_of(row): number for number, row in enumerate(rows)}
    of_these, poses = (sorted((row for row in lines.rows if run_of(row) in order), key=lambda row: order[run_of(row)])
                       for lines in (record.searches, record.poses))
    for number in numbers:
        table = tables[number]
        print(papertables.written(number, table, of_these, options.out), flush=True)
        if table.value is papertables.rate and len(table.methods) > 1:
            print(papertables.details(number, table, of_these, poses, options.out), flush=True)
    failed = sum(row["failure"] != "" for row in of_these)
    if picking:
        print(cell.run(options.out, [PARTS[0]], [simulation.SENSORS[0]], "cup", min(bins, scenes), parts,
                       options.seed, options.threads), flush=True)
    if options.all or options.figure:
        text, lost = stage.run(options.out, PARTS[0], options.preset, options.threads, options.seed, trials)
        print(text, flush=True)
        failed += lost
    charts.tell_of_display()
    return failed
