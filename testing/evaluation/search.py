# SPDX-License-Identifier: BSD-3-Clause
"""Searches in scenes with true poses, judged: the rows that the paper's tables and that of parts and sensors are made of. A row
for each search and one for each of its poses, in CSV files from which a run goes on that was stopped."""
import os

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData

from ppfmeam import dataset, evaluation, scripting
from ppfmeam.lines import Lines

import results
import scenes as sources

FOUND = "found "  # begins the name of a method of another program, which has left its poses
KEY = ("source", "part", "method", "features", "views", "sensor", "bin", "copies", "seed")  # `source`: perfect (bins without any
# error), image (bins with the edges of their image) or tohoku; `bin`: the part that lies in it
OUTCOMES = ("right", "duplicate", "wrong turn", "wrong place")  # of a pose, by vtkMEAMPoseEvaluation's numbers
ROW = (*KEY, "asked", "poses", *OUTCOMES, "half_visible", "half_visible_found", *dataset.BIN_FIGURES, "ms", "failure")  # outcomes
# of the poses asked for
POSE = (*KEY, "rank", "probability", "outcome", "found", "mm", "degrees")  # `found`: a copy that is half visible, for the first
# time; empty of a copy that is less visible
EDGE_TOLERANCE = 0.01  # of the diameter: an edge point so far behind what is measured there is hidden


def key_of(row):
    return tuple(str(row[name]) for name in KEY)


class Scenes:
    """The scenes of rows. `found`: by the names of other programs the folders with the poses that they left of the dataset."""

    def __init__(self, bins=None, tohoku=None, found=None):
        self.bins, self.data, self.of_others = sources.Bins(bins), tohoku, found or {}
        self.meshes, self.models, self.edges, self.last = {}, {}, {}, (None, None)

    def mesh(self, part):
        if part not in self.meshes:
            self.meshes[part] = sources.tohoku_mesh(self.data,
                                                    part[-1]) if part.startswith("tohoku_") else sources.part_mesh(part)
        return self.meshes[part]

    def model(self, part, method="recommended", views="6"):
        """A trained model; those of other methods are large, and kept until another part's is asked for."""
        method = "recommended" if method.startswith(FOUND) else method  # it tells when poses are equal
        kind = (part, method, views)
        if kind not in self.models:
            self.models = {known: model for known, model in self.models.items() if known[0] == part
                           or known[1:] == ("recommended", "6")}
            training = scripting.Training(self.mesh(part), method)
            if views != "6":
                training.views.SetNumberOfViewpoints(int(views))
            self.models[kind] = training.model()
        return self.models[kind]

    def scene(self, row):
        """The surface, the edge points if they are given, the true poses of a row's scene, and the scan of a bin with its image.
        What of the true poses is visible, and whether they are of this scene, the recommended model tells for all methods. The
        last scene is remembered."""
        kind = tuple(row[name] for name in ("source", "part", "sensor", "bin", "copies", "seed"))
        if self.last[0] != kind:
            self.last = (kind, self.tohoku(row) if row["source"] == "tohoku" else self.bin(row))
        return self.last[1]

    def tohoku(self, row):
        return *sources.tohoku_scene(self.data, row["part"][-1], int(row["seed"]), self.model(row["part"])), None

    def bin(self, row):
        scan, truth = self.bins.scene(row["bin"], row["sensor"], row["copies"], row["seed"])
        truth = truth if row["bin"] == row["part"] else vtkPolyData()
        if row["source"] == "image":
            return scan, None, truth, scan
        exact, edges = self.perfect(row["part"], truth)
        return exact, edges, truth, None

    def perfect(self, part, truth):
        """The parts at those true poses, without the bin, as a sensor without any error sees them, and the edge points of the
        part's edge appearance models at each pose, as far as nothing hides them (Section 6.1)."""
        source = sources.bin_source(self.mesh(part), 1, DepthNoise=0, DepthStep=0, Dropout=0, JumpDropout=0, MatchingWindow=1)
        source.SetInputDataObject(1, truth)
        scan = sources.without_bin(scripting.update(source).GetOutput())
        if part not in self.edges:
            self.edges[part] = model_edges(self.model(part, "paper"))
        return scan, seen(self.edges[part], truth, scan)

    def stored(self, row):
        """The poses that another program left, and how many ms it took, where it has left that in seconds.txt: lines of the
        scan's path and seconds."""
        folder = self.of_others[row["method"].removeprefix(FOUND)]
        poses = dataset.stored_poses(os.path.join(folder, f"Part_{row['part'][-1]}", f"trans{row['seed']}.txt"))
        path, scan = os.path.join(folder, "seconds.txt"), os.path.join(f"Part_{row['part'][-1]}", "Scenes",
                                                                       f"Scene{row['seed']}.pcd")
        for line in scripting.whole_lines(path) if os.path.exists(path) else ():
            name, _, seconds = line.strip().rpartition(" ")
            if name.endswith(scan):
                try:
                    return poses, f"{1000 * float(seconds):.0f}"
                except ValueError:
                    raise scripting.Failure(f"{path}: {line.strip()} does not end with a number of seconds") from None
        return poses, ""


def model_edges(model):
    """The edge points of a trained model."""
    for index in range(model.GetNumberOfPartitionedDataSets()):
        if model.GetMetaData(index).Get(model.NAME()) == "Edges":
            return vtk_to_numpy(model.GetPartitionedDataSet(index).GetPartition(0).GetPoints().GetData()).astype(float)
    raise scripting.Failure("the model has no edges")


def seen(edges, truth, scan):
    """Of the part's edge points at each pose those that no measured point hides, as a cloud."""
    depth = vtk_to_numpy(scan.GetPoints().GetData())[:, 2]
    tolerance = EDGE_TOLERANCE * scripting.field(truth, "Diameter")
    kept = []
    for transform in scripting.column(truth, "Transform", 4, 4):
        points = edges @ transform[:3, :3].T + transform[:3, 3]
        column, row, inside = sources.pixels_of(points, scan)
        behind = numpy.full(len(points), -numpy.inf)
        behind[inside] = numpy.nan_to_num(depth[row[inside] * scan.GetDimensions()[0] + column[inside]],
                                          nan=numpy.inf)  # nothing before the bin
        kept.append(points[points[:, 2] <= behind + tolerance])
    cloud = vtkPolyData()
    cloud.SetPoints(vtkPoints())
    cloud.GetPoints().SetData(numpy_to_vtk(numpy.concatenate(kept).astype(numpy.float32), deep=True))
    return cloud


def search(row, scenes, threads):
    """A row's search: the row, complete, and a row for each of its poses."""
    result, of_others = {**dict.fromkeys(ROW, ""), **row}, row["method"].startswith(FOUND)
    try:
        mesh, model = scenes.mesh(row["part"]), scenes.model(row["part"], row["method"], row["views"])
        run = evaluation.Evaluation(model, "recommended" if of_others else row["method"], row["asked"], threads,
                                    features=row["features"], mesh=mesh)
        surface, edges, truth, scan = scenes.scene(row)
        poses, ms = scenes.stored(row) if of_others else (run.find(surface, edges), "")
        run.add(poses, truth)
        visible = truth.GetPointData().GetArray("VisibleFraction")
        half = {i for i in range(truth.GetNumberOfPoints()) if visible.GetValue(i) >= run.judge.GetMinimumVisibleFraction()}
        if scan:
            benchmark = dataset.BOPFigures(mesh, model)
            benchmark.add(poses, truth, scan)
            result.update(benchmark.row(run.figures()["AP_mm"]))
        outcomes, instances, mm, degrees = (run.judged(name).tolist()
                                            for name in ("Outcome", "Instance", "TranslationError", "RotationError"))
        asked = outcomes[:row["asked"] or None]
        result.update(poses=len(asked), **{name: asked.count(kind) for kind, name in enumerate(OUTCOMES)}, half_visible=len(half),
                      half_visible_found=len(half.intersection(instances)),
                      ms=ms if of_others else f"{run.times[0]['Total'] - run.times[0]['Training']:.0f}")
    except scripting.Failure as failure:
        return {**result, "failure": str(failure)}, []
    known = poses.GetPointData().GetArray("Probability")
    return result, [{**{name: row[name] for name in KEY}, "rank": k + 1,
                     "probability": f"{known.GetValue(k):.5f}" if known else "",
                     "outcome": OUTCOMES[outcome],
                     "found": 0 if outcome > 1 else int(outcome == 0) if instances[k] in half else "",
                     "mm": f"{mm[k]:.4f}", "degrees": f"{degrees[k]:.4f}"} for k, outcome in enumerate(outcomes)]


class Searches:
    """The searches that are done: DIR/NAME.csv, a row for each, and DIR/poses.csv, one for each of their poses. Searches that
    failed are made again, and poses of other programs judged again."""

    def __init__(self, folder, name):
        scripting.make_folder(folder)
        self.rows = Lines(os.path.join(folder, name + ".csv"), ROW,
                          lambda row: not (row["failure"] or row["method"].startswith(FOUND)))
        self.done = set(map(key_of, self.rows.rows))
        self.poses = Lines(os.path.join(folder, "poses.csv"), POSE, lambda row: key_of(row) in self.done)

    def measure(self, wanted, scenes, threads):
        """The rows and the poses of these searches; each is a row of the file as soon as it is done, the search last."""
        todo = [row for row in wanted if key_of(row) not in self.done]
        progress = results.Progress(len(wanted), len(todo))
        for row in todo:
            result, poses = search(row, scenes, threads)
            self.poses.add(poses)
            self.rows.add([result])
            self.done.add(key_of(row))
            where = f"{row['sensor']}, a bin of {row['bin']}" if row["bin"] else row["source"]
            progress.tell(f"{row['method']} by {row['features']}, {row['part']}, {row['source']}, {where}, scene {row['seed']}: "
                          f"{result['failure'] or str(result['right']) + ' right'}")
            if result["failure"]:
                results.failed.append(key_of(row))
        order = {key_of(row): number for number, row in enumerate(wanted)}
        return [sorted((row for row in lines.rows if key_of(row) in order), key=lambda row: order[key_of(row)])
                for lines in (self.rows, self.poses)]
