#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of what every step makes, of the sample part in a simulated bin and of part 1 of the Tohoku dataset: those
of docs/gallery.md."""
import argparse
import os

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkFiltersCore import vtkFeatureEdges
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor

from ppfmeam import cellpicture, filters, picture, scripting

import chains
import scenes

SIZE = (840, 650)
MOST_BYTES = 119000
UNCERTAINTY = 1000  # standard deviations
UNEXPLAINED = (0.0, 0.0, 0.0)
DARK = (0.15, 0.3, 0.55)
TYPES = {0: ("contour", (0.12, 0.35, 0.75)), 1: ("crease", (0.85, 0.33, 0.0)), 2: ("hole border", (0.0, 0.55, 0.3))}
EDGE_TYPES = {1: ("sharp edge", TYPES[1][1]), 2: ("border", TYPES[2][1])}


def points_of(data):
    return vtk_to_numpy(data.GetPoints().GetData()).astype(float)


def array(data, name):
    return vtk_to_numpy(data.GetPointData().GetArray(name))


def partition(collection, name):
    names = [collection.GetMetaData(i).Get(collection.NAME()) for i in range(collection.GetNumberOfPartitionedDataSets())]
    return collection.GetPartition(names.index(name), 0)


def by_type(data, types):
    """Dots in the colours of their EdgeType, and the legend of those that are there."""
    values = array(data, "EdgeType")
    types = {t: item for t, item in types.items() if (values == t).any()}
    return [picture.dots(points_of(data)[values == t], color, 7) for t, (_, color) in types.items()], types.values()


def ramp(values, title):
    """Colours from light grey to red for values in mm, and the bar that explains them."""
    high = max(1.0, numpy.ceil(values.max()))
    table = vtkLookupTable()
    table.SetNumberOfTableValues(256)
    for i in range(256):
        share = i / 255
        table.SetTableValue(i, 0.62 + 0.28 * share, 0.66 * (1 - share) + 0.02, 0.74 * (1 - share) + 0.02, 1)
    table.SetRange(0, high)
    table.Build()
    shares = numpy.clip(values / high, 0, 1)[:, None]
    colors = 255 * ((1 - shares) * (0.62, 0.68, 0.76) + shares * (0.90, 0.02, 0.02))
    return colors, bar(table, title)


def bar(table, title):
    result = vtkScalarBarActor()
    result.SetLookupTable(table)
    result.SetTitle(title)
    result.SetLabelFormat("%.0f")
    result.SetNumberOfLabels(2)
    result.SetUnconstrainedFontSize(True)
    result.SetOrientationToHorizontal()
    result.GetPositionCoordinate().SetValue(0.03, 0.02)
    result.SetWidth(0.46)
    result.SetHeight(0.11)
    result.SetTextPositionToSucceedScalarBar()
    for style in (result.GetTitleTextProperty(), result.GetLabelTextProperty()):
        style.SetColor(0.1, 0.1, 0.1)
        style.SetFontSize(18)
        style.ShadowOff()
        style.ItalicOff()
        style.BoldOff()
    return result


class Gallery:
    """The pictures of one part; `towards` is where its own pictures are seen from."""

    def __init__(self, folder, name, mesh, towards):
        self.folder, self.name, self.mesh = folder, name, mesh
        self.training = scripting.Training(mesh)
        self.model = self.training.model()
        self.frame = picture.frame_of(points_of(mesh), towards, SIZE, margin=1.25)
        self.part = picture.solid(mesh)

    def save(self, step, actors, labels=(), frame=None):
        path = os.path.join(self.folder, f"gallery_{self.name}_{step}.jpg")
        picture.save_actors(path, actors, frame or self.frame, SIZE, labels, MOST_BYTES)
        print(f"{path}: {os.path.getsize(path) / 1000:.0f} kB")

    def offline(self, view):
        self.save("mesh", [picture.solid(self.mesh, (0.75, 0.8, 0.88), edges=True)])
        edges = filters.vtkMEAMFeatureEdges()
        edges.SetInputDataObject(self.mesh)
        actors, labels = by_type(scripting.update(edges).GetOutput(), EDGE_TYPES)
        self.save("feature_edges", [self.part, *actors], labels)
        samples = self.training.symmetric_samples()
        places = points_of(samples)
        self.save("samples", [self.part, picture.dots(places, DARK, 3)])
        near = scripting.tuples(samples, "NearSymmetryOverlap")
        deviation = array(samples, "Deviation")
        words = scripting.symmetry_words(samples)
        near_words = next((line for line in words if line.startswith("nearly")), words[0])
        colors, explained = ramp(deviation, f"{near_words.split(':')[0]}: mm off the surface")
        order = numpy.argsort(deviation)  # the deviating ones over the others
        self.save("symmetry", [self.part, picture.dots(places[order], colors[order], 5), *([explained] if near else [])],
                  [] if near else [(words[0], None)])

        name = f"View {view}"
        seen = partition(self.training.views.GetOutputDataObject(0), name)
        direction = numpy.array(scripting.tuples(seen, "ViewDirection")[0])
        self.save("visible", [self.part, picture.dots(points_of(seen), DARK, 4)])
        up = (0, 1, 0) if abs(direction[2]) > 0.9 else (0, 0, 1)
        along = picture.frame_of(points_of(self.mesh), direction, SIZE, up, margin=1.15)
        actors, labels = by_type(partition(self.training.boundary.GetOutputDataObject(0), name), TYPES)
        self.save("edges", [self.part, *actors], labels, along)
        tangents = partition(self.training.tangents.GetOutputDataObject(0), name)
        self.save("tangents", [self.part, self.tangents(tangents)], frame=along)

        edges = partition(self.model, "Edges")
        views = array(edges, "ViewBits").astype(numpy.int64)
        counts = sum((views >> bit) & 1 for bit in range(32))
        shades = {1: (0.12, 0.35, 0.75), 2: (0.0, 0.55, 0.45), 3: (0.85, 0.5, 0.0), 4: (0.75, 0.1, 0.1)}
        actors = [picture.dots(points_of(edges)[numpy.minimum(counts, 4) == n], color, 8) for n, color in shades.items()
                  if (numpy.minimum(counts, 4) == n).any()]
        labels = [(f"{n}{' or more' * (n == 4)} view{'s' * (n > 1)}", color) for n, color in shades.items()
                  if (numpy.minimum(counts, 4) == n).any()]
        self.save("model", [self.part, *actors], labels)

    def tangents(self, edges, color=DARK, width=2.5):
        half = 0.015 * scripting.field(self.model, "Diameter") * array(edges, "Tangent")
        return picture.strokes(points_of(edges) - half, points_of(edges) + half, color, width)

    def online(self, surface, edges, looks):
        places = points_of(surface)
        valid = numpy.isfinite(places).all(axis=1)
        greys = (0.3, 0.85) if surface.GetPointData().GetArray("Intensity") else (0.35, 0.7)
        scan = picture.scan(surface, places, valid, looks, greys)
        scan.GetProperty().SetPointSize(2)

        def frame(camera):
            height = picture.look(camera, places[valid], looks)
            camera.SetParallelScale(camera.GetParallelScale() * max(1.0, picture.WIDTH * SIZE[1] / SIZE[0] / height))

        self.save("scene", [scan], frame=frame)
        found = points_of(edges)
        self.save("scene_edges", [scan, picture.dots(self.lifted(found, looks), (0.9, 0.1, 0.1), 2)], frame=frame)
        steps = self.steps(surface, edges)
        lines = self.tangents(steps[0])
        lines.SetPosition(*(-0.01 * scripting.field(self.model, "Diameter") * numpy.array(looks)))
        self.save("scene_tangents", [lines], frame=frame)
        outline = self.outline()
        for step, poses, words in (("candidates", steps[1], "{} candidates"),
                                   ("verified", steps[2], "{} poses: red the best score, blue the lowest")):
            self.save(step, [scan, self.outlines(outline, poses, looks, step)], frame=frame,
                      labels=[(words.format(poses.GetNumberOfPoints()), None)])
        instances = filters.vtkMEAMPoseInstances()
        instances.SetInputDataObject(0, steps[3])
        instances.SetInputDataObject(1, self.mesh)
        copies = picture.copies(scripting.update(instances))
        colors = vtk_to_numpy(instances.GetOutput().GetPointData().GetArray("RankColor"))
        ranks = array(instances.GetOutput(), "Rank")
        scores = enumerate(array(steps[3], "Score"), 1)
        labels = [(f"rank {r}: score {score:.2f}", tuple(colors[numpy.argmax(ranks == r)] / 255.0)) for r, score in scores]
        self.save("poses", [scan, copies], labels, frame)
        self.certainty(surface, edges, scan, looks, frame)
        return steps[3]

    def certainty(self, surface, edges, scan, looks, frame):
        """Which edges the poses explain, and how uncertain they are."""
        estimation, instances = filters.vtkMEAMPoseEstimation(), filters.vtkMEAMPoseInstances()
        for port, data in enumerate((self.model, surface, edges)):
            estimation.SetInputDataObject(port, data)
        instances.SetInputConnection(estimation.GetOutputPort())
        instances.SetInputDataObject(1, self.mesh)
        instances.SetUncertaintyScale(UNCERTAINTY)
        scripting.update(instances)
        shown = instances.GetOutput()
        colors = dict(zip(array(shown, "Rank"), vtk_to_numpy(shown.GetPointData().GetArray("RankColor")) / 255.0))
        found = estimation.GetOutputDataObject(1)
        places, ranks = self.lifted(points_of(found), looks), array(found, "Rank")
        actors = [picture.dots(places[ranks == rank], tuple(colors.get(rank, UNEXPLAINED)), 2)
                  for rank in sorted(set(ranks))]
        labels = [(f"rank {rank}: {(ranks == rank).sum()} points" if rank else f"unexplained: {(ranks == 0).sum()} points",
                   tuple(colors.get(rank, UNEXPLAINED))) for rank in sorted(set(ranks))]
        self.save("explained", [scan, *actors], labels, frame)
        ellipsoids = picture.copies(instances, 1)
        self.save("uncertainty", [scan, ellipsoids], [(f"{UNCERTAINTY} standard deviations", None)], frame)

    def picks(self, scan, truth, poses):
        """The gripper at the best pick of each pose."""
        grasps, planning = filters.vtkMEAMGraspDefinition(), filters.vtkMEAMPickPlanning()
        grasps.SetInputDataObject(self.mesh)
        grasps.SetInputDataObject(1, self.model)
        grasps.SetProposeToParallelJaws()
        for algorithm in (grasps, planning):
            algorithm.SetFingerWidth(6)
            algorithm.SetFingerThickness(4)
            algorithm.SetBodyWidth(30)
            algorithm.SetBodyLength(30)
        planning.SetInputDataObject(0, poses)
        planning.SetInputDataObject(1, self.mesh)
        planning.SetInputConnection(2, grasps.GetOutputPort())
        planning.SetInputDataObject(3, scan)
        scripting.update(planning)
        picks = planning.GetOutput()
        reasons = picks.GetPointData().GetAbstractArray("Reason")
        instances, labels = array(picks, "Instance"), []
        for number in sorted(set(instances)):
            reason = reasons.GetValue(int(numpy.argmax(instances == number)))
            color = cellpicture.POSSIBLE if reason == "possible" else cellpicture.NOT
            labels.append((f"instance {number}: {reason}", color))
        self.save("picks", cellpicture.actors(scan, poses, self.mesh, planning.GetOutputDataObject(1)), labels,
                  cellpicture.frame(truth, SIZE))

    @staticmethod
    def lifted(points, looks):
        """A little nearer to the sensor, over the scan."""
        return points - 0.5 * numpy.array(looks)

    def steps(self, surface, edges):
        """Scene edges with tangents, candidates, verified and final poses."""
        chain = chains.Detection(self.model, edges, surface)
        chain.selection.SetMaximumNumberOfPoses(5)
        scripting.update(chain.selection)
        return [step.GetOutput() for step in (chain.tangents, chain.detection, chain.alternatives, chain.selection)]

    def outline(self):
        """The part's sharp edges as pairs of points."""
        sharp = vtkFeatureEdges()
        sharp.SetInputData(self.mesh)
        sharp.SetFeatureAngle(30)
        lines = scripting.update(sharp).GetOutput()
        ids = vtk_to_numpy(lines.GetLines().GetConnectivityArray()).reshape(-1, 2)
        return points_of(lines)[ids]

    def outlines(self, outline, poses, looks, step):
        transforms = array(poses, "Transform").reshape(-1, 4, 4)
        moved = numpy.concatenate([outline @ t[:3, :3].T + t[:3, 3] for t in transforms])
        scores = array(poses, "Score")
        if step == "candidates":
            return picture.strokes(moved[:, 0], moved[:, 1], (0.0, 0.15, 0.8), 1.0, 0.1)
        share = numpy.repeat((scores - scores.min()) / max(numpy.ptp(scores), 1e-9), len(outline))[:, None]
        colors = 255 * (share * (0.85, 0.05, 0.05) + (1 - share) * (0.2, 0.45, 0.85))
        return picture.strokes(moved[:, 0], moved[:, 1], colors, 1.5)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--tohoku", metavar="DIR", help="where the Tohoku dataset is; without, only the sample part")
    parser.add_argument("--out", metavar="DIR", default=".", help="folder for the pictures (default: %(default)s)")
    options = parser.parse_args()
    picture.require_display()
    scripting.require_folder_of(os.path.join(options.out, "gallery"))

    source, edges = filters.vtkMEAMBinSceneSource(), filters.vtkMEAMSceneEdgeExtraction()
    edges.SetInputConnection(source.GetOutputPort())
    scripting.update(edges)
    gallery = Gallery(options.out, "sample", source.GetOutputDataObject(2), (0.8, -1.3, 1.5))
    gallery.offline(0)
    poses = gallery.online(source.GetOutputDataObject(0), edges.GetOutputDataObject(0), (0, 0, 1))
    gallery.picks(source.GetOutputDataObject(0), source.GetOutputDataObject(1), poses)
    if options.tohoku:
        gallery = Gallery(options.out, "tohoku", scenes.tohoku_mesh(options.tohoku, 1), (0.6, -1.1, 1.6))
        gallery.offline(0)
        surface, edges = scenes.tohoku_clouds(options.tohoku, 1, 0)
        gallery.online(surface, edges, (0, 0, -1))


scripting.run(main)
