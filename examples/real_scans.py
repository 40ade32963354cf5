#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Finds the parts in two real scans, prints the poses and writes the pictures of docs/gallery.md.

DATA holds rings/ (structured light, ten rings with three lugs: triangles_scene.ply, triangle_model.ply and the poses
pseudo_gt_poses.txt, which are made by ICP) and scanner/ (time of flight, one housing among other things: data.ply and
V2D63xModel.ply, without true poses). Both come as PLY clouds that have lost their pixels; the cameras below give them
back. The ring's model is points only: its mesh is made here."""
import argparse
import json
import os
import tempfile

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

from ppfmeam import filters, picture, scripting

SIZE = (840, 650)
MOST_BYTES = 119000
LOOKS = (0, 0, 1)

# A quarter of the sensor's 936 x 778 pixels, since the scan kept every tenth: (c + 0.5) / 4 - 0.5.
RINGS_CAMERA = {"fx": 3567.5 / 4, "fy": 3567.5 / 4, "cx": 124.01925, "cy": 101.0175, "width": 234, "height": 195}
# Fitted to the order of the points in the file, which is that of 176 x 144 pixels: 0.02 pixels off (rms).
SCANNER_CAMERA = {"camera_matrix": [[146.315, 0, 87.52], [0, 146.315, 73.54], [0, 0, 1]],
                  "dist_coeffs": [-0.3157, 0.10263, 0, 0, 0], "image_width": 176, "image_height": 144,
                  "T_camera_scene": [[-1, 0, 0, 0], [0, 1, 0, -139.6], [0, 0, -1, 1120], [0, 0, 0, 1]]}
SCANNER_BOX = ((-140, -160, 600), (140, 160, 760))  # mm: what the pictures show

# The ring, measured on its points: mm, its axes in the model's frame (rows), which is 1.64 degrees askew.
RING_AXES = numpy.array(((0.99959, 0, 0.02864), (0, 1, 0), (-0.02864, 0, 0.99959)))
BORE, FLANGE, FLANGE_TOP, BOTTOM = 15.0, 26.5, -12.0, -14.0


def poly_data(points, triangles=None):
    data, coordinates = vtkPolyData(), vtkPoints()
    coordinates.SetData(numpy_to_vtk(numpy.ascontiguousarray(points), deep=True))
    data.SetPoints(coordinates)
    if triangles is not None:
        cells = vtkCellArray()
        cells.SetData(3, numpy_to_vtkIdTypeArray(numpy.ascontiguousarray(triangles).ravel(), deep=True))
        data.SetPolys(cells)
    return data


def ring_mesh(points):
    """The ring as a solid: the outline of its wall, a bore and a flange. The outline is the mean of the points of each
    degree from a lug, over the six halves of lugs."""
    ring = points @ RING_AXES.T
    radius = numpy.hypot(ring[:, 0], ring[:, 1])
    wall = (ring[:, 2] < -1) & (ring[:, 2] > FLANGE_TOP + 0.5) & (radius > 20)

    def from_lug(degrees):
        return numpy.abs((degrees + 60) % 120 - 60)

    of_points = from_lug(numpy.degrees(numpy.arctan2(ring[wall, 1], ring[wall, 0])))
    steps = numpy.arange(0.5, 60)
    means = [radius[wall][numpy.abs(of_points - step) <= 0.5].mean() for step in steps]
    angles = numpy.arange(360)
    outline = numpy.interp(from_lug(angles), steps, means)
    brim = numpy.maximum(outline, FLANGE)
    x, y = numpy.cos(numpy.radians(angles)), numpy.sin(numpy.radians(angles))
    circles = ((BORE, 0), (outline, 0), (outline, FLANGE_TOP), (brim, FLANGE_TOP), (brim, BOTTOM), (BORE, BOTTOM))
    corners = numpy.concatenate([numpy.stack((r * x, r * y, numpy.full(360, float(z))), axis=1) for r, z in circles])
    here = numpy.arange(len(corners)).reshape(len(circles), -1)
    there, beside = numpy.roll(here, -1, axis=0), numpy.roll(here, -1, axis=1)
    across = numpy.roll(there, -1, axis=1)
    triangles = numpy.stack((here, there, across, here, across, beside), axis=-1)
    preparation = filters.vtkMEAMMeshPreparation()
    preparation.SetInputDataObject(poly_data(corners @ RING_AXES, triangles))
    return scripting.update(preparation).GetOutput()


def ring_truth(path):
    """The poses of the file in mm, and the same of rings that lie on their other side."""
    scripting.require_file(path)
    poses = numpy.loadtxt(path).reshape(-1, 4, 4)
    poses[:, :3, 3] *= 1000
    flip = numpy.eye(4)
    flip[:3, :3] = RING_AXES.T @ numpy.diag((1, -1, -1)) @ RING_AXES
    flip[:3, 3] = BOTTOM * RING_AXES[2]
    return poses, poses @ flip


def judge(found, truth, model):
    """The rows (right, instance, mm, degrees) of the poses found, and the symmetries of the model count."""
    true = poly_data(truth[:, :3, 3])
    matrices = numpy_to_vtk(truth.reshape(-1, 16), deep=True)
    matrices.SetName("Transform")
    true.GetPointData().AddArray(matrices)
    evaluation = filters.vtkMEAMPoseEvaluation()
    for port, data in enumerate((found, true, model)):
        evaluation.SetInputDataObject(port, data)
    evaluation.SetDiameter(scripting.field(model, "Diameter"))
    evaluation.SetPosesAskedFor(0)
    table = scripting.update(evaluation).GetOutput()
    names = ("Right", "Instance", "TranslationError", "RotationError")
    return numpy.stack([vtk_to_numpy(table.GetColumnByName(name)).astype(float) for name in names], axis=1)


def figures(found, truth, model, others=()):
    """How many true poses, or their others, are met, which ranks are wrong, and the median errors of the right ones."""
    rows = judge(found, numpy.concatenate((truth, *others)), model)
    right = rows[rows[:, 0] == 1]
    met = len(set(right[:, 1].astype(int) % len(truth)))
    return met, numpy.nonzero(rows[:, 0] == 0)[0] + 1, numpy.median(right[:, 2:], axis=0) if met else (numpy.nan, numpy.nan)


def estimate(model, scene, poses, edges, seed=1):
    """The poses and the scene's edge points."""
    estimation = filters.vtkMEAMPoseEstimation()
    estimation.SetInputDataObject(model)
    estimation.SetInputDataObject(1, scene)
    estimation.SetMaximumNumberOfPoses(poses)
    estimation.SetImageEdges("image" in edges)
    estimation.SetDepthEdges("depth" in edges)
    estimation.SetCreases("creases" in edges)
    estimation.SetSeed(seed)
    scripting.update(estimation)
    return estimation.GetOutput(), estimation.GetOutputDataObject(1)


def save_pictures(folder, name, scene, edges, poses, mesh, box=None):
    """The scan with its edges and with the part at each pose; of a box (mm) of the scene, or of the whole."""
    points = vtk_to_numpy(scene.GetPoints().GetData()).astype(float)
    valid = numpy.isfinite(points).all(axis=1)
    if box:
        valid &= ((points > box[0]) & (points < box[1])).all(axis=1)
    scan = picture.scan(scene, points, valid, LOOKS, (0.3, 0.85))
    if box:
        scan.GetProperty().SetPointSize(9)  # few points, drawn large

    def frame(camera):
        height = picture.look(camera, points[valid], LOOKS)
        camera.SetParallelScale(camera.GetParallelScale() * max(1.0, picture.WIDTH * SIZE[1] / SIZE[0] / height))

    def save(step, actors, labels=()):
        path = os.path.join(folder, f"gallery_{name}_{step}.jpg")
        picture.save_actors(path, actors, frame, SIZE, labels, MOST_BYTES)
        print(f"{path}: {os.path.getsize(path) / 1000:.0f} kB")

    found = vtk_to_numpy(edges.GetPoints().GetData()).astype(float)
    if box:
        found = found[((found > box[0]) & (found < box[1])).all(axis=1)]
    save("edges", [scan, picture.dots(found - 0.5 * numpy.array(LOOKS), (0.9, 0.1, 0.1), 5 if box else 3)])
    instances = filters.vtkMEAMPoseInstances()
    instances.SetInputDataObject(0, poses)
    instances.SetInputDataObject(1, mesh)
    instances.SetMinimumProbability(0.0)  # what is doubtful is told by the labels
    copies = picture.copies(scripting.update(instances))
    ranks, colors = (vtk_to_numpy(instances.GetOutput().GetPointData().GetArray(array)) for array in ("Rank", "RankColor"))
    scores, sure = (vtk_to_numpy(poses.GetPointData().GetArray(array)) for array in ("Score", "Probability"))
    labels = [(f"rank {i + 1}: score {score:.2f}, {100 * sure[i]:.0f} %", tuple(colors[numpy.argmax(ranks == i + 1)] / 255.0))
              for i, score in enumerate(scores[:5])]
    save("poses", [scan, copies], labels or [("no part found", None)])


def read_scan(path, scale, camera):
    """The cloud on the pixels of its camera."""
    with tempfile.TemporaryDirectory() as folder:
        calibration = os.path.join(folder, "camera.json")
        with scripting.written(calibration) as file:
            json.dump(camera, file)
        return scripting.read_scan(path, scale, calibration)


def rings(options):
    folder = os.path.join(options.data, "rings")
    scene = read_scan(os.path.join(folder, "triangles_scene.ply"), 1000, RINGS_CAMERA)
    points = vtk_to_numpy(scripting.read(os.path.join(folder, "triangle_model.ply"), 1000).GetPoints().GetData())
    truth, flipped = ring_truth(os.path.join(folder, "pseudo_gt_poses.txt"))
    mesh = ring_mesh(points.astype(float))
    training = scripting.Training(mesh)
    model = training.model()
    edge_kinds = options.edges or ("image", "depth")  # the image is dark
    poses, edges = estimate(model, scene, len(truth), edge_kinds)
    print(f"rings: {mesh.GetFieldData().GetAbstractArray('Report').GetValue(0)}; "
          f"symmetries: {scripting.symmetry_words(training.symmetric_samples())[0]}; edges: {', '.join(edge_kinds)}")
    scripting.print_poses(poses)
    scripting.print_times(poses)
    for words, others in (("wrong", ()), ("right", (flipped,))):
        met, wrong, medians = figures(poses, truth, model, others)
        print(f"flips are {words}: {met} of {len(truth)} pseudo poses met, median error {medians[0]:.2f} mm, "
              f"{medians[1]:.2f} degrees; wrong ranks: {', '.join(map(str, wrong)) or 'none'}")
    if options.seeds > 1:
        found = [estimate(model, scene, len(truth), edge_kinds, seed)[0] for seed in range(1, options.seeds + 1)]
        met, _, medians = zip(*(figures(each, truth, model) for each in found))
        print(f"{options.seeds} seeds: {numpy.mean(met):.1f} met on average, {min(met)} to {max(met)}; median errors "
              "{:.2f} mm, {:.2f} degrees".format(*numpy.median(medians, axis=0)))
    save_pictures(options.out, "rings", scene, edges, poses, mesh)


def scanner(options):
    folder = os.path.join(options.data, "scanner")
    scene = read_scan(os.path.join(folder, "data.ply"), 1, SCANNER_CAMERA)
    mesh = scripting.read_mesh(os.path.join(folder, "V2D63xModel.ply"))
    poses, edges = estimate(scripting.train(mesh), scene, 5, options.edges or ("image",))
    print(f"scanner: {mesh.GetFieldData().GetAbstractArray('Report').GetValue(0)}")
    scripting.print_poses(poses)
    scripting.print_times(poses)
    save_pictures(options.out, "scanner", scene, edges, poses, mesh, SCANNER_BOX)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("data", metavar="DATA", help="the folder that holds rings/ and scanner/")
    parser.add_argument("--out", metavar="DIR", default=".", help="folder for the pictures (default: %(default)s)")
    parser.add_argument("--edges", nargs="+", choices=("image", "depth", "creases"),
                        help="edges of the scene to look for (default: image, and depth for the rings)")
    parser.add_argument("--seeds", type=scripting.count, default=1, metavar="N",
                        help="search the rings with this many seeds and print the mean (default: %(default)s)")
    options = parser.parse_args()
    picture.require_display()
    scripting.require_folder_of(os.path.join(options.out, "gallery"))
    rings(options)
    scanner(options)


scripting.run(main)
