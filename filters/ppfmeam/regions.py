# SPDX-License-Identifier: BSD-3-Clause
"""Where in a scan parts are looked for."""
import os

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

from . import Error, scripting

EVERYWHERE = (0.0,) * 6


def add_option(parser):
    parser.add_argument("--roi", nargs="+", metavar="FROM/TO", help=(
        "where parts are looked for: six numbers, from and to along x, y and z of the scan, mm; or an image of the scan's size "
        "that is not black there. Parts whose middle lies elsewhere are not looked for"))


def of(region):
    """The box, six numbers, and the mask, H x W of bytes, of a region; None: that there is none."""
    if region is None:
        return None, None
    if isinstance(region, numpy.ndarray) and (region.ndim > 1 or region.dtype == bool):
        if region.ndim > 2 or region.dtype.kind not in "biu":
            raise Error(f"a region as a mask has to be an array H x W of flags, not {region.dtype} with the shape {region.shape}")
        return None, numpy.ma.filled(region != 0, False).astype(numpy.uint8)
    if isinstance(region, (list, tuple)) and len(region) == 1:  # of a command
        region, = region
    if not isinstance(region, (list, tuple, numpy.ndarray)):
        return None, mask_of(os.fspath(region))
    try:
        box = tuple(map(float, region))
    except (TypeError, ValueError):
        box = ()
    if len(box) != 6 or not all(a < b for a, b in zip(box[::2], box[1::2])) or not numpy.isfinite(box).all():
        given = f"an array with the shape {region.shape}" if isinstance(region, numpy.ndarray) and len(region) != 6 else \
            " ".join(map(str, region)) if len(region) <= 6 else f"{len(region)} values"
        raise Error(f"the region has to be six numbers, from and to along x, y and z of the scan, mm, or a mask, not {given}")
    return box, None


def mask_of(path):
    """That of an image: what is not black."""
    image = scripting.read_image(path)
    width, height, _ = image.GetDimensions()
    pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[::-1]
    return (pixels[..., :3] != 0).any(axis=2).astype(numpy.uint8)


def require_shape(mask, shape):
    """Of the scan: H x W, or the number of its points."""
    if mask.size != numpy.prod(shape) or mask.ndim == len(shape) == 2 and mask.shape != shape:
        size, scan = (" x ".join(map(str, reversed(each))) for each in (mask.shape, shape))
        raise Error(f"the mask of the region has {size} pixels, and the scan {scan} points: give one of the scan's size")


def masked(scan, mask):
    """VTK's scan with the mask, which it then carries; the scan itself without one."""
    if mask is None:
        return scan
    width, height, _ = scan.GetDimensions() if scan.IsA("vtkStructuredGrid") else (scan.GetNumberOfPoints(), 1, 1)
    require_shape(mask, (height, width) if height > 1 else (width,))
    result = scan.NewInstance()
    result.ShallowCopy(scan)
    result.GetPointData().AddArray(scripting.vtk_array(mask.ravel(), "Region"))
    return result
