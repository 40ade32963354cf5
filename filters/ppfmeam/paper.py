# SPDX-License-Identifier: BSD-3-Clause
"""The experiments of the paper (Liu et al., Sensors 2018, Section 6): its tables and Figure 13, with parts of our own in
place of its parts A to D, which were never published, beside the paper's figures."""
import os
import sys
import time

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkStructuredGrid

from . import cell, charts, dataset, evaluation, filters, scripting, simulation, stage, world

PARTS = ("ridged_disc", "arc_lever", "flap", "hole_plate")  # in place of A, B, C and D
LETTERS = "ABCD"
POSES = 5  # wanted of a scene
QUICK = 3  # scenes of each part in a quick run
QUICK_COPIES = 8
QUICK_VIEWS = 6  # training with more takes a minute
METHODS = {"recommended": "PPF-MEAM, recommended", "paper": "PPF-MEAM as in the paper", "without-meam": "B2B-TL without MEAM",
           "ppf": "original PPF", "b2b": "B2B"}
VIEWS = (1, 2, 6, 14, 26)
EDGE_TOLERANCE = 0.01  # of the diameter: an edge point so far behind what is measured there is hidden
COPIES = 20  # in a bin
RUN = ("source", "part", "method", "views", "seed", "copies")  # a search in a scene
OUTCOMES = ("right", "duplicate", "wrong turn", "wrong place")  # of a pose, by vtkMEAMPoseEvaluation's numbers
ROW = (*RUN, "poses", *OUTCOMES, "asked", *dataset.BIN_FIGURES, "ms", "failure")


class Figure:
    """What a table of the paper says: by the methods of its rows the values of its columns, and its average."""

    def __init__(self, title, source, columns, methods, paper, value):
        self.title, self.source, self.columns, self.methods, self.paper, self.value = title, source, columns, methods, paper, value


def rate(rows):
    """Percent of the poses that come out, as the paper counts."""
    poses = sum(int(row["poses"] or 0) for row in rows)
    return 100 * sum(int(row["right"] or 0) for row in rows) / poses if poses else float("nan")


def strict(rows):
    """Percent of the poses asked for: a missing one is wrong."""
    asked = sum(int(row["asked"]) for row in rows)
    return 100 * sum(int(row["right"] or 0) for row in rows) / asked if asked else float("nan")


def milliseconds(rows):
    times = [float(row["ms"]) for row in rows if row["ms"]]
    return float(numpy.median(times)) if times else float("nan")


def by_part(parts, views=6):
    return [(letter, {"part": part, "views": str(views)}) for letter, part in parts]


OURS = by_part(zip(LETTERS, PARTS))
TOHOKU = by_part((str(part), f"tohoku_{part}") for part in (1, 2, 3))
COMPARED = ("paper", "recommended", "ppf")
OF_VIEWS = [(str(count), {"part": PARTS[0], "views": str(count)}) for count in VIEWS]
OF_PART_A = [("A", {"part": PARTS[0], "views": "6"})]
TABLES = {  # the paper's figures by method, column by column; its own method stands for ours in both presets
    1: Figure("Table 1. Recognition rate, synthetic scenes with perfect edges", "perfect", OURS, COMPARED,
              {"paper": (100, 99.3, 100, 100), "ppf": (49, 66, 71.3, 90)}, rate),
    2: Figure("Table 2. Speed, synthetic scenes with perfect edges (ms a scene)", "perfect", OURS, COMPARED,
              {"paper": (1276, 401, 987, 892), "ppf": (3033, 1470, 1754, 4430)}, milliseconds),
    3: Figure("Table 3. Recognition rate, edges of the image (the paper's real scans were never published: a simulated "
              "structured-light sensor)", "image", OURS, COMPARED, {"paper": (97, 97, 98.3, 97), "ppf": (8, 72, 58.3, 89)}, rate),
    4: Figure("Table 4. Speed, edges of the image (ms a scene)", "image", OURS, COMPARED,
              {"paper": (1322, 1353, 1271, 1360), "ppf": (2752, 3673, 1765, 1438)}, milliseconds),
    5: Figure("Table 5. Recognition rate by the number N of appearance models, part A, edges of the image", "image", OF_VIEWS,
              ("paper",), {"paper": (69, 93, 97, 95, None)}, rate),
    6: Figure("Table 6. Recognition rate with MEAM, without it, and of the original PPF, part A, edges of the image", "image",
              OF_PART_A, ("paper", "without-meam", "ppf", "b2b", "recommended"),
              {"paper": (97,), "without-meam": (91,), "ppf": (8,)}, rate),
    7: Figure("Table 7. Recognition rate, Tohoku University 6D Pose Estimation Dataset", "tohoku", TOHOKU,
              ("paper", "recommended", "without-meam", "ppf", "b2b"), {"paper": (96.7, 97.3, 100), "ppf": (92, 96.7, 100)}, rate),
    8: Figure("Table 8. Speed, Tohoku University 6D Pose Estimation Dataset (ms a scene)", "tohoku", TOHOKU,
              ("paper", "recommended", "without-meam", "ppf", "b2b"), {}, milliseconds),
}


class Scenes:
    """Scenes with their true poses, by source: `perfect`, `image` or `tohoku`."""

    def __init__(self, bins, copies, data):
        self.bins, self.data = bins, data
        self.simulated = simulation.Bins(copies, bins and os.path.join(bins, "bins"))
        self.meshes, self.models, self.edges = {}, {}, {}

    def mesh(self, part):
        if part not in self.meshes:
            tohoku = part.startswith("tohoku_")
            self.meshes[part] = evaluation.tohoku_mesh(self.data, int(part[-1])) if tohoku else simulation.part_mesh(part)
        return self.meshes[part]

    def model(self, part, method, views):
        """A trained model; those of a part are kept until another's is asked for."""
        kind = (part, method, views)
        if kind not in self.models:
            self.models = {known: model for known, model in self.models.items() if known[0] == part}
            training = scripting.Training(self.mesh(part), method)
            if views != "6":
                training.views.SetNumberOfViewpoints(int(views))
            self.models[kind] = training.model()
        return self.models[kind]

    def find(self, run, row):
        """The poses and the true ones of a row's scene, and the scan of a bin with its image."""
        part, seed = row["part"], int(row["seed"])
        if row["source"] == "tohoku":
            truth = evaluation.tohoku_truth(self.data, int(part[-1]), seed)
            return run.find(*evaluation.tohoku_clouds(self.data, int(part[-1]), seed)), truth, None
        scan, truth = self.simulated.scene(part, simulation.SENSORS[0], seed)
        if row["source"] == "image":
            return run.find(scan), truth, scan
        exact, edges = self.perfect(part, truth)
        return run.find(exact, edges), truth, None

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


def planned(tables, scenes, first, copies=COPIES):
    """The searches that the tables need, those of one model one after the other."""
    rows = {}
    for number in tables:
        table = TABLES[number]
        for method in table.methods:
            for _, where in table.columns:
                for seed in range(first, first + scenes):
                    at = seed - first if table.source == "tohoku" else seed
                    row = {"source": table.source, "method": method, "seed": str(at),
                           "copies": "" if table.source == "tohoku" else str(copies), **where}
                    rows[tuple(row[name] for name in RUN)] = row
    return sorted(rows.values(), key=lambda row: (row["part"], row["method"], int(row["views"]), row["source"], int(row["seed"])))


def belongs(row, table, method, where):
    return row["source"] == table.source and row["method"] == method and all(row[name] == value for name, value in where.items())


def measure(rows, done, scenes, threads):
    """Runs the searches that are not done; each is a row as soon as it is."""
    known = {tuple(row[name] for name in RUN) for row in done.rows}
    todo = [row for row in rows if tuple(row[name] for name in RUN) not in known]
    start = time.time()
    for count, row in enumerate(todo):
        result = {**dict.fromkeys(ROW, ""), **row, "asked": POSES}
        try:
            mesh, model = scenes.mesh(row["part"]), scenes.model(row["part"], row["method"], row["views"])
            run = evaluation.Evaluation(model, row["method"], POSES, threads, mesh=mesh)
            poses, truth, scan = scenes.find(run, row)
            run.add(poses, truth)
            if scan:
                benchmark = dataset.BOPFigures(mesh, model)
                benchmark.add(poses, truth, scan)
                result.update(benchmark.row(run.figures()["AP_mm"]))
            outcomes = run.judged("Outcome")[:POSES].tolist()
            result.update(poses=len(outcomes), **{name: outcomes.count(kind) for kind, name in enumerate(OUTCOMES)},
                          ms=f"{run.times[0]['Total'] - run.times[0]['Training']:.0f}")
        except scripting.Failure as failure:
            result["failure"] = str(failure)
        done.add([result])
        left = (time.time() - start) / (count + 1) * (len(todo) - count - 1)
        print(f"{len(rows) - len(todo) + count + 1} of {len(rows)}: {METHODS[row['method']]}, {row['part']}, {row['source']} scene "
              f"{row['seed']}: {result['failure'] or str(result['right']) + ' right'}; {left / 60:.0f} min left",
              file=sys.stderr, flush=True)


def details(number, rows, folder):
    """What the poses of a table are, and the figures of the BOP benchmark where it has them, in Markdown, which is also
    written."""
    table = TABLES[number]
    figures = dataset.BIN_FIGURES[1:] if table.source == "image" else ()
    head = ["method", *OUTCOMES, "missing", *figures]
    lines = [f"The poses of Table {number}, of those asked for"
             + ("; and the BOP benchmark's recalls over copies of which at least a tenth is visible, AP2-20 by the ranks in each bin."
                if figures else "."), "", "| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    for method in table.methods:
        of_method = [row for row in rows for _, where in table.columns if belongs(row, table, method, where)]
        asked = sum(int(row["asked"]) for row in of_method)
        shares = [100 * sum(int(row[name] or 0) for row in of_method) / asked if asked else None for name in OUTCOMES]
        values = [*shares, None if None in shares else 100 - sum(shares), *(dataset.mean_of(of_method, name) for name in figures)]
        lines.append("| " + " | ".join([METHODS[method]] + ["-" if value is None else f"{value:.1f} %" for value in values]) + " |")
    text = "\n".join(lines) + "\n"
    with scripting.written(os.path.join(folder, f"table{number}_poses.md")) as file:
        file.write(text)
    return text


def written(number, rows, folder):
    """The table in Markdown, which is also written, as CSV and, where there is a display, as a chart."""
    table = TABLES[number]
    names = [name if table.source != "tohoku" else "Part " + name for name, _ in table.columns]
    head = ["method", *names] + (["average"] if len(names) > 1 and number != 5 else [])
    lines, bars = [], {}
    for method in table.methods:
        of_method = [[row for row in rows if belongs(row, table, method, where)] for _, where in table.columns]
        values = [table.value(of) for of in of_method]
        bars[METHODS[method]] = values
        lines.append((METHODS[method], values))
        if table.value is rate:
            lines.append((METHODS[method] + ", of the poses asked for", [strict(of) for of in of_method]))
        if method in table.paper:
            lines.append((METHODS[method] + ": the paper says", table.paper[method]))
            bars[METHODS[method] + " (paper)"] = [value if value is not None else float("nan") for value in table.paper[method]]
    unit = " %" if table.value is rate else ""

    def cells(values):
        shown = ["-" if value is None or value != value else f"{value:.{1 if unit else 0}f}{unit}" for value in values]
        mean = numpy.mean([value for value in values if value is not None]) if len(head) > len(names) + 1 else None
        return shown + ([f"{mean:.{1 if unit else 0}f}{unit}"] if mean is not None else [])

    text = "\n".join([table.title + ".", "", "| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
                     + ["| " + " | ".join([name, *cells(values)]) + " |" for name, values in lines]) + "\n"
    for extension, content in (("md", text), ("csv", "\n".join([",".join(head[:len(names) + 1])] + [
            ",".join([f'"{name}"', *("" if value is None else f"{value:.2f}" for value in values)]) for name, values in lines]) + "\n")):
        with scripting.written(os.path.join(folder, f"table{number}.{extension}")) as file:
            file.write(content)
    charts.bars(os.path.join(folder, f"table{number}.png"), table.title.partition(" (")[0], names, bars,
                "%" if unit else "ms a scene")
    return text


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
                     help=f"to see it run: no more than {QUICK} scenes of each part, {QUICK_COPIES} copies and {QUICK_VIEWS} appearance "
                          "models, one bin of Table 9 and one trial of Figure 13")
    one.add_argument("--seed", type=scripting.count, default=1, help="of the first bin, the next has the next one")
    one.add_argument("--copies", type=scripting.count, default=COPIES, help="in a bin (default: %(default)s)")
    one.add_argument("--tohoku", metavar="DIR", help="where the Tohoku dataset is, for tables 7 and 8")
    one.add_argument("--out", metavar="DIR", required=True,
                     help="write there paper.csv, a row for each scene, from which a run goes on that was stopped; of each table "
                          "a .md, a .csv and a chart; and the bins")


def run(options):
    """Returns how many searches failed."""
    scripting.make_folder(options.out)
    scenes, copies, bins, trials = options.scenes, options.copies, cell.BINS, stage.TRIALS
    if options.quick:
        scenes, copies, bins, trials = min(scenes, QUICK), min(copies, QUICK_COPIES), 1, 1
    tables = list(TABLES) if options.all else options.table or []
    picking = options.all or 9 in tables
    tables = [number for number in tables if number != 9]
    unknown = [number for number in tables if number not in TABLES]
    if unknown:
        raise scripting.Failure(f"there is no table {unknown[0]}; known are 1 to 9")
    if not options.tohoku:
        without = [number for number in tables if TABLES[number].source == "tohoku"]
        if without and not options.all:
            raise scripting.Failure(f"table {without[0]} needs the Tohoku dataset: --tohoku DIR")
        tables = [number for number in tables if number not in without]
    elif not options.all or os.path.isdir(options.tohoku):
        scripting.require_file(os.path.join(options.tohoku, "Part_1", "Part_1.STL"))
    done = world.Lines(os.path.join(options.out, "paper.csv"), ROW)
    rows = planned(tables, scenes, options.seed, copies)
    if options.quick:
        rows = [row for row in rows if int(row["views"]) <= QUICK_VIEWS]
    # Of the dataset as many scenes as there are.
    rows = [row for row in rows if row["source"] != "tohoku" or os.path.exists(
        os.path.join(options.tohoku, f"Part_{row['part'][-1]}", "Results", f"trans{row['seed']}.txt"))]
    measure(rows, done, Scenes(options.out, copies, options.tohoku), options.threads)
    wanted = {tuple(row[name] for name in RUN) for row in rows}
    of_these = [row for row in done.rows if tuple(row[name] for name in RUN) in wanted]
    for number in tables:
        print(written(number, of_these, options.out), flush=True)
        if TABLES[number].value is rate and len(TABLES[number].methods) > 1:
            print(details(number, of_these, options.out), flush=True)
    if picking:
        print(cell.run(options.out, [PARTS[0]], [simulation.SENSORS[0]], "cup", min(bins, scenes), cell.COPIES,
                       options.seed, options.threads), flush=True)
    if options.all or options.figure:
        print(stage.run(options.out, PARTS[0], options.preset, options.threads, options.seed, trials), flush=True)
    return sum(row["failure"] != "" for row in of_these)
