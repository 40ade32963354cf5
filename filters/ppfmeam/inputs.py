# SPDX-License-Identifier: BSD-3-Clause
"""What users have, files, NumPy arrays or VTK's data objects, as the C++ library takes it, and back to VTK's for the filters."""
import os
import tempfile
import warnings

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkDataObject, vtkDataSetAttributes, vtkPolyData, vtkStructuredGrid
from vtkmodules.vtkFiltersCore import vtkTriangleFilter

from . import Error, _core, regions, scripting
from .choices import checked_scale

PLAIN_MODES = ("L", "RGB", "RGBA")  # of PIL's images: those whose bytes are grey values or colours
HIDDEN = vtkDataSetAttributes.HIDDENPOINT


def name_of(file, wanted):
    """The name of a file; `wanted`: what an argument has to be."""
    try:
        return os.fspath(file)
    except TypeError:
        raise Error(f"{wanted}, not {type(file).__name__}") from None


def path_of(file):
    """The name of a file that is there."""
    path = os.fspath(file)
    scripting.require_file(path)
    return path


def age_of(scan):
    """When the file of a scan was written, in ns; None of what is no file."""
    return os.stat(scan).st_mtime_ns if isinstance(scan, (str, os.PathLike)) and os.path.exists(scan) else None


def arrays_of(cad):
    """Vertices and triangles of a mesh of trimesh or Open3D, or of a tuple of both; None of anything else."""
    if isinstance(cad, tuple):
        return cad if len(cad) == 2 and isinstance(cad[0], numpy.ndarray) else None
    triangles = next((getattr(cad, name) for name in ("faces", "triangles") if hasattr(cad, name)), None)
    return (cad.vertices, triangles) if triangles is not None and hasattr(cad, "vertices") else None


def is_mesh(cad):
    """Whether it is a mesh in memory: VTK's, of another library, or its arrays."""
    return isinstance(cad, vtkDataObject) or arrays_of(cad) is not None


def mesh_of_arrays(vertices, triangles):
    vertices, triangles = numpy.asarray(vertices), numpy.asarray(triangles)
    if vertices.ndim != 2 or vertices.shape[1] != 3 or vertices.dtype.kind not in "fiu" or not numpy.isfinite(vertices).all():
        raise Error(f"the part's vertices have to be finite numbers N x 3, not {vertices.dtype} {vertices.shape}")
    if triangles.ndim != 2 or triangles.shape[1] != 3 or triangles.dtype.kind not in "iu":
        raise Error(f"the part's triangles have to be whole numbers M x 3, not {triangles.dtype} {triangles.shape}")
    if not len(triangles):
        raise Error("the part has no triangles")
    if triangles.min() < 0 or triangles.max() >= len(vertices):
        raise Error(f"the part's triangles have to be of its {len(vertices)} vertices, the first of which is 0")
    return _core.Mesh(vertices.astype(numpy.float32), triangles.astype(numpy.int32))


def mesh_of(cad, reading):
    """The mesh of a file, a vtkPolyData or arrays, as it came; `reading`: what is chosen of the file."""
    if is_mesh(cad) and reading.solid:
        raise Error("solid is chosen from a STEP or IGES file: give the file, not its mesh")
    if arrays_of(cad) is not None:
        return mesh_of_arrays(*arrays_of(cad))
    if not isinstance(cad, vtkDataObject):
        if name_of(cad, "the part has to be a file, a mesh, or two arrays, vertices and triangles").lower().endswith(".pcd"):
            raise Error(f"{cad} is a scan: the part has to be a mesh with faces ({', '.join(scripting.MESHES)})")
        mesh = _core.load_cad(mesh_file(cad, scripting.MESHES), reading.apply(_core.CADSettings(), _core))
        if mesh.report:
            warnings.warn(mesh.report, stacklevel=4)
        return mesh
    triangles = vtkTriangleFilter()
    triangles.SetInputDataObject(cad)
    triangles.PassLinesOff()
    triangles.PassVertsOff()
    mesh = scripting.update(triangles).GetOutput()
    corners = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    return _core.Mesh(vtk_to_numpy(mesh.GetPoints().GetData()), corners)


def mesh_file(file, known):
    """The name of a file that is there, and of a kind that has a mesh, or at least points."""
    path = os.fspath(file)
    scripting.require_kind(path, os.path.splitext(path)[1].lower() in known, known)
    return path_of(path)


def model_from_vtk(data):
    """The model in a vtkPartitionedDataSetCollection."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "model.meam")
        scripting.write_model(data, path)
        return _core.load_model(path)


def model_to_vtk(model):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "model.meam")
        model.save(path)
        return scripting.read_model(path)


def scan_of(scan, camera=None, scale=1.0, image=None, boundary=None, image_camera=None, region=None, viewpoint=None):
    """A scan with its image, its edge points, its region and its viewpoint, where they are given."""
    seen = cloud_of(scan, camera, scale)
    if viewpoint is not None:
        if camera is not None:
            raise Error("the camera tells where the scan is seen from: leave the viewpoint out")
        seen.sensor = _core.Sensor()
        seen.sensor.position = scale * numpy.array(viewpoint)
    if boundary is not None:
        seen.edges = cloud_of(boundary, None, scale).points.reshape(-1, 3)
    if image is not None:
        set_image(seen, image, image_camera)
    elif image_camera is not None:
        raise Error("image_camera is the camera of image: give that, too")
    box, mask = regions.of(region)
    if box is not None:
        seen.region_box = box
    if mask is not None:
        regions.require_shape(mask, seen.points.shape[:-1])
        seen.region_mask = mask
    return seen


def unmasked(values):
    """Points or depths without NumPy's mask: what it hides is not measured."""
    if not isinstance(values, numpy.ma.MaskedArray):
        return values
    hidden = numpy.ma.getmaskarray(values)
    if values.ndim and values.shape[-1] == 3:
        hidden = numpy.broadcast_to(hidden.any(axis=-1, keepdims=True), hidden.shape)  # of a point all
    return numpy.where(hidden, numpy.float32(numpy.nan), values.data) if hidden.any() else values.data


def cloud_of(scan, camera, scale):
    """The points, with the image of an organized scan that carries one."""
    scale = checked_scale("scale", scale)
    if isinstance(scan, numpy.ndarray) and scan.ndim == 2 and scan.shape[1] != 3:
        return depths_seen(scan, camera, scale)
    if camera is not None and isinstance(scan, (vtkDataObject, numpy.ndarray)):
        raise Error("camera brings the points of a file onto its pixels: give a file, or the points as a grid without camera")
    if isinstance(scan, vtkDataObject):
        return from_dataset(scan, scale)
    if isinstance(scan, numpy.ndarray):
        return _core.Scan(scaled(unmasked(scan), scale, "scan"))
    path = name_of(scan, "the scan has to be a file, an array of points, or VTK's data object")
    if camera is not None:
        name_of(camera, "the camera of a file has to be a calibration file; a matrix is that of an array of depths")
    extension = os.path.splitext(path)[1].lower()
    if extension in scripting.DEPTH_IMAGES and camera is None:
        raise Error(f"{path}: a depth image needs the calibration of its camera")
    if camera is not None and extension not in (*scripting.CLOUDS, *scripting.DEPTH_IMAGES):
        raise Error(f"{path}: only a cloud ({', '.join(scripting.CLOUDS)}) is organized with the camera of the sensor")
    path_of(path)
    if extension in scripting.DEPTH_IMAGES:
        return _core.load_depth_image(path, path_of(camera), scale)
    if extension in (*scripting.CLOUDS, ".obj"):  # which may have points alone
        return _core.load_scan(path, "" if camera is None else path_of(camera), scale)
    return _core.Scan(scaled(_core.load_cad(mesh_file(path, scripting.SCANS)).vertices, scale, "scan"))


def depths_seen(depths, camera, scale):
    """The scan of depths H x W, whose camera is a calibration file, or a camera matrix."""
    if camera is None:
        points = "array[:, :3] of points with more columns" if 3 < depths.shape[1] < 12 else "array.T of 3 x N" if depths.shape[0] == 3 else None
        raise Error(f"an array of {depths.shape[0]} x {depths.shape[1]} numbers is no points, which are H x W x 3 or N x 3" +
                    (f": give {points}" if points else "") + "; a depth image needs its camera, a calibration file or a matrix of 3 x 3")
    if depths.dtype.kind not in "fui" or not depths.size:
        raise Error(f"the depth image has to be an array of numbers, H x W, not {depths.dtype} with the shape {depths.shape}")
    values = unmasked(depths).astype(numpy.float32)
    if depths.dtype in (numpy.uint8, numpy.uint16):
        values[numpy.asarray(depths) == numpy.iinfo(depths.dtype).max] = numpy.nan  # as cameras write what they did not measure
    if isinstance(camera, (str, os.PathLike)):
        path = path_of(camera)
        return _core.scan_of_depths(values, _core.load_depth_camera(path), scale * _core.load_depth_scale(path))
    matrix = numpy.asarray(camera)
    if matrix.shape != (3, 3) or matrix.dtype.kind not in "fiu":
        raise Error(f"the camera of a depth image has to be a calibration file or a matrix of 3 x 3, not {camera!r}")
    if matrix[0, 1] or matrix[1, 0] or (matrix[2] != (0, 0, 1)).any():
        raise Error(f"the camera matrix has to be fx 0 cx, 0 fy cy, 0 0 1, in pixels, not {matrix.tolist()}")
    return _core.scan_of_depths(values, _core.Camera(depths.shape[1], depths.shape[0], matrix, numpy.eye(4)), scale)


def scaled(points, scale, what):
    """An array of points, in mm."""
    if points.ndim not in (2, 3) or points.shape[-1] != 3 or points.dtype.kind != "f":
        raise Error(f"the {what} has to be an array of floats, H x W x 3 or N x 3, not {points.dtype} with the shape {points.shape}")
    return points if scale == 1.0 else points * scale


def from_dataset(data, scale):
    """The points of a vtkStructuredGrid, a grid, or of another vtkPointSet."""
    points = vtk_to_numpy(data.GetPoints().GetData()) if data.GetNumberOfPoints() else numpy.zeros((0, 3), numpy.float32)
    if not data.IsA("vtkStructuredGrid"):
        return with_pixels(_core.Scan(scaled(points, scale, "scan")), data, 1, len(points))
    width, height, layers = data.GetDimensions()
    if layers != 1:
        raise Error(f"the scan is a grid of {width} x {height} x {layers} points: an organized cloud is width x height x 1")
    ghosts = data.GetPointGhostArray()
    scan = _core.Scan(scaled(points.reshape(height, width, 3), scale, "scan"))
    if ghosts:
        scan.blank(vtk_to_numpy(ghosts) & numpy.uint8(HIDDEN))
    return with_pixels(scan, data, height, width)


def with_pixels(scan, data, height, width):
    """The scan with the image that the points' arrays hold, if they do."""
    values = data.GetPointData()
    pixels = values.GetArray("Intensity") or values.GetArray("RGB")
    if pixels:
        scan.image = bytes_of(vtk_to_numpy(pixels)).reshape(height, width, -1)
    return scan


def bytes_of(pixels):
    """Grey values or colours; those of 16 bits have the whole range."""
    if pixels.dtype == numpy.uint8:
        return pixels
    values = numpy.rint(pixels / 257.0 if pixels.dtype == numpy.uint16 else pixels)
    if not ((values >= 0) & (values <= 255)).all():
        raise Error("the image has values outside of 0 to 255")
    return values.astype(numpy.uint8)


def set_image(scan, image, camera):
    """The image of the sensor, or of another camera, whose calibration is a file or stands in the field data of a vtkImageData."""
    if isinstance(image, vtkDataObject):
        width, height, _ = image.GetDimensions()
        pixels = image.GetPointData().GetScalars() or image.GetPointData().GetArray(0)
        scan.image = numpy.ascontiguousarray(bytes_of(vtk_to_numpy(pixels)).reshape(height, width, -1)[::-1, :, :3])
        fields = [image.GetFieldData().GetArray(name) for name in ("CameraMatrix", "CameraPose")]
        if all(fields) and camera is None:
            matrix, pose = (vtk_to_numpy(field).reshape(n, n) for field, n in zip(fields, (3, 4)))
            if scan.points.shape[:2] != (height, width) or not numpy.allclose(pose, numpy.eye(4), atol=1e-9):
                scan.image_camera = _core.Camera(width, height, matrix, pose)
    elif hasattr(image, "__array_interface__"):
        if getattr(image, "mode", "RGB") not in PLAIN_MODES:
            raise Error(f"the image is one of PIL's mode {image.mode}: give image.convert('RGB')")
        if numpy.ma.is_masked(image):
            raise Error("the image has masked pixels: give image.data, and what is not to be searched as region")
        image = numpy.asarray(image)
        if image.dtype != numpy.uint8 or image.ndim not in (2, 3) or image.shape[2:] not in ((), (1,), (3,), (4,)):
            raise Error(f"the image has to be an array of bytes, H x W or H x W x 3, not {image.dtype} with the shape {image.shape}")
        scan.image = numpy.ascontiguousarray(image[..., :3] if image.ndim == 3 else image)
    else:
        scan.image = _core.load_image(path_of(name_of(image, "the image has to be a file, an array of bytes, or a vtkImageData")))
    if camera is not None:
        scan.image_camera = _core.load_camera(path_of(name_of(camera, "the image's camera has to be a calibration file")))


def to_vtk(scan):
    """A scan as the filters take it: a grid, or points; its edge points; and its image. None for what it has not."""
    points = scan.points
    data = vtkStructuredGrid() if points.ndim == 3 else vtkPolyData()
    if points.ndim == 3:
        data.SetDimensions(points.shape[1], points.shape[0], 1)
    data.SetPoints(scripting.vtk_points(points))
    if scan.region_mask.size:
        data = regions.masked(data, scan.region_mask.reshape(points.shape[:-1]))
    edges = image = None
    if len(scan.edges):
        edges = vtkPolyData()
        edges.SetPoints(scripting.vtk_points(scan.edges))
    if scan.image is not None:
        image = scripting.vtk_image(scan.image[::-1])  # VTK's rows go upwards
    return data, edges, image


def vtk_mesh(corners, triangles):
    data, cells = vtkPolyData(), vtkCellArray()
    cells.SetData(3, numpy_to_vtkIdTypeArray(numpy.ascontiguousarray(triangles, numpy.int64).ravel(), deep=True))
    data.SetPoints(scripting.vtk_points(corners))
    data.SetPolys(cells)
    return data
