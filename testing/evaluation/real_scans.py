#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Finds the parts in real scans: how many of the known poses are met. `--pictures DIR` writes those of docs/gallery.md.

DATA may hold pipes/ (known.csv, elbow.stl and the scans that it names) and real/ (in its folders SCAN.pcd, SCAN_known.txt and the
part's mesh beside), of which the poses are known of some copies alone. It holds rings/ (structured light, ten rings with three
lugs: triangles_scene.ply, triangle_model.ply and the poses pseudo_gt_poses.txt, which are made by ICP) and scanner/ (time of
flight, one housing among other things: data.ply and V2D63xModel.ply, without true poses). Both come as PLY clouds that have lost
their pixels; the cameras below give them back. The ring's model is points only: its mesh is made here."""
import glob
import json
import os
import tempfile

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

from ppfmeam import filters, picture, scripting

import results

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


def judge(found, truth, model, degrees=5):
    """The rows (right, instance, mm, degrees) of the poses found, and the symmetries of the model, or of samples, count."""
    evaluation = filters.vtkMEAMPoseEvaluation()
    for port, data in enumerate((found, scripting.poses_of(truth), model)):
        evaluation.SetInputDataObject(port, data)
    evaluation.SetDiameter(scripting.field(model, "Diameter"))
    evaluation.SetPosesAskedFor(0)
    evaluation.SetRotationTolerance(degrees)
    table = scripting.update(evaluation).GetOutput()
    names = ("Right", "Instance", "TranslationError", "RotationError")
    return numpy.stack([vtk_to_numpy(table.GetColumnByName(name)).astype(float) for name in names], axis=1)


def figures(found, truth, model, others=(), degrees=5):
    """How many true poses, or their others, are met, which ranks are wrong, and the median errors of the right ones."""
    rows = judge(found, numpy.concatenate((truth, *others)), model, degrees)
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


def rings(data, edges, seeds, pictures=None):
    """A row; with pictures what was found, too."""
    folder = os.path.join(data, "rings")
    scene = read_scan(os.path.join(folder, "triangles_scene.ply"), 1000, RINGS_CAMERA)
    points = vtk_to_numpy(scripting.read(os.path.join(folder, "triangle_model.ply"), 1000).GetPoints().GetData())
    truth, flipped = ring_truth(os.path.join(folder, "pseudo_gt_poses.txt"))
    mesh = ring_mesh(points.astype(float))
    model = scripting.train(mesh)
    poses, found = estimate(model, scene, len(truth), edges)
    met, wrong, medians = figures(poses, truth, model)
    several = [met, *(figures(estimate(model, scene, len(truth), edges, seed)[0], truth, model)[0]
                      for seed in range(2, seeds + 1))]
    if pictures:
        scripting.print_poses(poses)
        scripting.print_times(poses)
        save_pictures(pictures, "rings", scene, found, poses, mesh)
    return {"scan": "rings", "edges": ", ".join(edges), "known": len(truth), "met": met,
            "or on the other side": figures(poses, truth, model, (flipped,))[0],
            "wrong ranks": " ".join(map(str, wrong)), "mm": float(medians[0]), "degrees": float(medians[1]), "seeds": seeds,
            "met on average": float(numpy.mean(several)), "least": min(several), "most": max(several)}


def scanner(data, pictures):
    folder = os.path.join(data, "scanner")
    scene = read_scan(os.path.join(folder, "data.ply"), 1, SCANNER_CAMERA)
    mesh = scripting.read_mesh(os.path.join(folder, "V2D63xModel.ply"))
    poses, edges = estimate(scripting.train(mesh), scene, 5, ("image",))
    scripting.print_poses(poses)
    save_pictures(pictures, "scanner", scene, edges, poses, mesh, SCANNER_BOX)


def exact(poses):
    """The poses with the nearest rotations: those of files are rounded."""
    u, _, v = numpy.linalg.svd(poses[:, :3, :3])
    poses[:, :3, :3] = u @ v
    return poses


def of_known(data):
    """The mesh, the scan and the known poses, N x 4 x 4, of the scans of pipes/ and real/ that are there."""
    path = os.path.join(data, "pipes", "known.csv")
    rows = results.read(path) if os.path.exists(path) else []
    for name in dict.fromkeys(row["scene"] for row in rows):
        truth = numpy.tile(numpy.eye(4), (sum(row["scene"] == name for row in rows), 1, 1))
        for pose, row in zip(truth, (row for row in rows if row["scene"] == name)):
            pose[:3, :3], pose[:3, 3] = numpy.reshape(row["R"].split(), (3, 3)), row["t"].split()
        yield os.path.join(data, "pipes", "elbow.stl"), os.path.join(data, "pipes", name + ".pcd"), exact(truth)
    for known in sorted(glob.glob(os.path.join(data, "real", "*", "*_known.txt"))):
        stem, truth = known.removesuffix("_known.txt"), numpy.loadtxt(known).reshape(-1, 4, 4)
        meshes = glob.glob(os.path.join(os.path.dirname(known), "*.stl"))
        mesh = next((path for path in meshes if stem.endswith(os.path.splitext(os.path.basename(path))[0])), meshes[0])
        scan = next(path for path in (stem + ".pcd", stem.rpartition("_")[0] + ".pcd") if os.path.exists(path))
        yield mesh, scan, exact(truth)


def samples_of(mesh, path):
    """The part's samples with its symmetries, those of PART.json beside its mesh where that is there (an entry of a BOP
    models_info.json)."""
    training, info = scripting.Training(mesh), os.path.splitext(path)[0] + ".json"
    if not os.path.exists(info):
        return training.symmetric_samples()
    with tempfile.TemporaryDirectory() as folder:
        entry = os.path.join(folder, "models_info.json")
        with scripting.written(entry) as file:
            json.dump({"1": scripting.read_json(info)}, file)
        training.symmetries.SetModelsInfoFile(entry)
        training.symmetries.SetObjectId(1)
        return training.symmetric_samples()


def known(data, poses=10):
    """Of each scan a row: how many of the known poses, which are fitted, are met by the best ones: within 10 % of D and 10
    degrees. Poses that are not known are not wrong."""
    rows, parts = [], {}
    for path, scan, truth in of_known(data):
        if path not in parts:
            mesh = scripting.read_mesh(path)
            parts[path] = scripting.train(mesh), samples_of(mesh, path)
        found, _ = estimate(parts[path][0], scripting.read(scan), poses, ("image", "depth", "creases"))
        met, _, medians = figures(found, truth, parts[path][1], degrees=10)
        rows.append({"scan": os.path.relpath(scan, data), "part": os.path.splitext(os.path.basename(path))[0],
                     "known": len(truth), "met": met,
                     "mm": float(medians[0]), "degrees": float(medians[1]),
                     "likely": int((scripting.column(found, "Probability") > 0.5).sum()),
                     "ms": 1000 * (scripting.field(found, "SecondsTotal") - scripting.field(found, "SecondsTraining"))})
    return rows


def measure(data, edges=("image", "depth", "creases"), seeds=1, pictures=None):
    if pictures:
        picture.require_display()
        scripting.require_folder_of(os.path.join(pictures, "gallery"))
        scanner(data, pictures)
    return [rings(data, edges, seeds, pictures)]


if __name__ == "__main__":
    results.command(measure, data="the folder that holds rings/ and scanner/", edges="of the scan to look for",
                    seeds="to search the rings with",
                    pictures="folder for the pictures of docs/gallery.md")
