# SPDX-License-Identifier: BSD-3-Clause
"""Writes simulated bins as a dataset in the form of the BOP benchmark: one part, one image in each scene."""
import json
import os

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOPLY import vtkPLYWriter

from . import scripting

SPLIT = "test"
SCALES = [step * 10.0 ** power for power in range(-3, 3) for step in (1, 2, 5)]  # mm


def write_json(path, data):
    """An object as JSON; of a dictionary each entry in a line of its own."""
    with scripting.written(path) as file:
        lines = ",\n".join(f"  {json.dumps(key)}: {json.dumps(value)}" for key, value in data.items())
        file.write("{\n" + lines + "\n}\n")


def write_png(path, pixels):
    """H x W or H x W x 3 values of 8 or 16 bits, from the top left."""
    scripting.make_folder(os.path.dirname(path))
    writer = vtkPNGWriter()
    writer.SetInputData(scripting.vtk_image(pixels[::-1]))
    scripting.write_by(writer, path)


def pixels_of(image):
    """The pixels of a vtkImageData from the top left, H x W or H x W x 3."""
    width, height, _ = image.GetDimensions()
    pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[::-1]
    return pixels[..., 0] if pixels.shape[2] == 1 else pixels


def numbers(data, name):
    """The first tuple of a field data array."""
    return list(data.GetFieldData().GetArray(name).GetTuple(0))


def write_part(folder, mesh, entry, number=1):
    """models/: the mesh, and its entry (text) of models_info.json."""
    models = os.path.join(folder, "models")
    scripting.make_folder(models)
    writer = vtkPLYWriter()
    writer.SetInputData(mesh)
    path = os.path.join(models, f"obj_{number:06d}.ply")
    scripting.require_room(models, mesh, path)
    writer.SetFileName(path)
    scripting.update(writer, "Write")
    write_json(os.path.join(models, "models_info.json"), {str(number): json.loads(entry)})


def write_camera(folder, scan, image):
    """camera.json; for a camera beside the sensor also image_camera.json, in OpenCV's form."""
    fx, _, cx, _, fy, cy, _, _, _ = numbers(scan, "CameraMatrix")
    width, height, _ = scan.GetDimensions()
    write_json(os.path.join(folder, "camera.json"), {
        "fx": fx, "fy": fy, "cx": cx, "cy": cy, "width": width, "height": height, "depth_scale": scale_of(scan)})
    if is_beside(scan):
        def matrix(rows, columns, values):
            return {"type_id": "opencv-matrix", "rows": rows, "cols": columns, "dt": "d", "data": values}

        width, height, _ = image.GetDimensions()
        write_json(os.path.join(folder, "image_camera.json"), {
            "image_width": width, "image_height": height,
            "camera_matrix": matrix(3, 3, numbers(image, "CameraMatrix")),
            "distortion_coefficients": matrix(1, 5, [0.0] * 5),
            "T_camera_scene": matrix(4, 4, numbers(image, "CameraPose"))})


def is_beside(scan):
    """Whether a camera beside the sensor took the image: the scan carries none."""
    return not scripting.has_image(scan)


def depths_of(scan):
    """mm along the sensor's axis, H x W; 0 where there is no depth."""
    width, height, _ = scan.GetDimensions()
    return numpy.nan_to_num(vtk_to_numpy(scan.GetPoints().GetData())[:, 2].reshape(height, width).astype(float))


def scale_of(scan):
    """mm that a depth of 1 stands for: the finest round number with which 16 bits hold all."""
    return next(scale for scale in SCALES if depths_of(scan).max() <= 65000 * scale)


def box_of(mask):
    """Column and row of the first pixel, width and height; -1 when there is none."""
    rows, columns = numpy.nonzero(mask)
    if not rows.size:
        return [-1, -1, -1, -1]
    low, high = (columns.min(), rows.min()), (columns.max(), rows.max())
    return [int(value) for value in (*low, high[0] - low[0] + 1, high[1] - low[1] + 1)]


def masks_of(truth, width, height):
    """Of each copy, H x W: whether it would be seen at a pixel if nothing else were there."""
    pixels = vtk_to_numpy(truth.GetFieldData().GetArray("Silhouettes"))
    place = 0
    for left, top, across, down in vtk_to_numpy(truth.GetPointData().GetArray("Box")):
        mask = numpy.zeros((height, width), bool)
        mask[top:top + down, left:left + across] = pixels[place:place + across * down].reshape(down, across) > 0
        place += across * down
        yield mask


def write_scene(folder, scene, scan, truth, image, number=1):
    """SPLIT/SSSSSS: depth, image, masks and truth of what vtkMEAMBinSceneSource returned."""
    place = os.path.join(folder, SPLIT, f"{scene:06d}")
    width, height, _ = scan.GetDimensions()
    depths, scale = depths_of(scan), scale_of(scan)
    pixels = pixels_of(image)
    kind = ("gray" if pixels.ndim == 2 else "rgb") + ("_beside" if is_beside(scan) else "")
    write_png(os.path.join(place, "depth", "000000.png"), numpy.rint(depths / scale).astype(numpy.uint16))
    write_png(os.path.join(place, kind, "000000.png"), pixels)

    instances = vtk_to_numpy(scan.GetPointData().GetArray("Instance")).reshape(height, width)
    poses, infos = [], []
    for i, mask in enumerate(masks_of(truth, width, height)):
        visible = instances == i
        for name, values in (("mask", mask), ("mask_visib", visible)):
            write_png(os.path.join(place, name, f"000000_{i:06d}.png"), 255 * values.astype(numpy.uint8))
        T = truth.GetPointData().GetArray("Transform").GetTuple(i)
        poses.append({"obj_id": number, "cam_R_m2c": [*T[0:3], *T[4:7], *T[8:11]], "cam_t_m2c": [T[3], T[7], T[11]]})
        infos.append({
            "px_count_all": int(mask.sum()), "px_count_valid": int((mask & (depths > 0)).sum()),
            "px_count_visib": int(visible.sum()), "visib_fract": float(visible.sum() / max(mask.sum(), 1)),
            "bbox_obj": box_of(mask), "bbox_visib": box_of(visible)})
    write_json(os.path.join(place, "scene_camera.json"),
               {"0": {"cam_K": numbers(scan, "CameraMatrix"), "depth_scale": scale}})
    write_json(os.path.join(place, "scene_gt.json"), {"0": poses})
    write_json(os.path.join(place, "scene_gt_info.json"), {"0": infos})
