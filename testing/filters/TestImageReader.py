# SPDX-License-Identifier: BSD-3-Clause
"""Images of every kind: the pixels of VTK's readers, and files that are damaged or cut off."""

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_UNSIGNED_CHAR
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkIOImage import (vtkBMPReader, vtkBMPWriter, vtkJPEGReader, vtkJPEGWriter, vtkPNGReader, vtkPNGWriter,
                                   vtkTIFFReader, vtkTIFFWriter)

from ppfmeam.filters import vtkMEAMImageReader
from meamtest import Errors, Folder, check, connect, fails, picture, png, run, tuples, written

KINDS = {"png": (vtkPNGWriter, vtkPNGReader), "jpg": (vtkJPEGWriter, vtkJPEGReader), "bmp": (vtkBMPWriter, vtkBMPReader),
         "tif": (vtkTIFFWriter, vtkTIFFReader)}
W, H = 37, 23
file = Folder()


def reader(path, kind=vtkMEAMImageReader):
    return connect(kind(), FileName=path)


def scalars(image):
    return vtk_to_numpy(image.GetPointData().GetScalars())


def bytes_read():
    """By this process until now."""
    with open("/proc/self/io", encoding="ascii") as io:
        return int(io.readline().split()[1])


# Rows from the lower left; grey or colour, 8 bits out of 16, no alpha.
image = run(reader(png(file("a.png"), [[(0,), (50,), (100,)], [(150,), (200,), (255,)]])))
check(image.GetDimensions() == (3, 2, 1) and image.GetSpacing() == (1, 1, 1) and image.GetOrigin() == (0, 0, 0), str(image))
check(tuples(image, "Intensity") == [(150,), (200,), (255,), (0,), (50,), (100,)], f"{tuples(image, 'Intensity')}")
row = [[(0, 0, 257, 65535), (128, 129, 65535, 1), (65406, 65407, 300, 0)]]
image = run(reader(png(file("b.png"), row, "uint16")))
check(tuples(image, "RGB") == [(0, 0, 1), (0, 1, 255), (254, 255, 1)], f"16 bits: {tuples(image, 'RGB')}")
image = run(reader(png(file("c.png"), [[(7, 255), (9, 0)]])))
check(tuples(image, "RGB") == [(7, 7, 7), (9, 9, 9)], f"grey with alpha: {tuples(image, 'RGB')}")
image = run(reader(png(file("d.png"), [[(257,), (65535,)]], "uint16")))
check(tuples(image, "Intensity") == [(1,), (255,)], "16 bits, grey")
image = run(reader(png(file("e.png"), [[(0, 0, 4095, 65535), (1, 0, 2048, 65535)]], "uint16")))
check(tuples(image, "RGB") == [(0, 0, 255), (1, 0, 128)], f"12 bits with alpha: {tuples(image, 'RGB')}")

# The same pixels as VTK's own readers have.
random = numpy.random.default_rng(1)
ramp = numpy.add.outer(numpy.arange(H) * 5, numpy.arange(W) * 3)[..., None]
for extension, (writer, theirs) in KINDS.items():
    for channels in (1, 3, 4):
        if channels == 4 and extension == "jpg":
            continue
        pixels = (ramp + random.integers(0, 30, (H, W, channels))).astype(numpy.uint8)
        path = written(file(f"{channels}.{extension}"), picture(pixels[::-1]), writer)
        image = run(reader(path))
        check(vtkMEAMImageReader().CanReadFile(path) and image.GetDimensions() == (W, H, 1), path)
        found = scalars(image)
        if extension != "tif" or channels == 1:  # of colours VTK's reader takes no file that starts with the upper row
            expected = reader(path, theirs)
            if extension == "tif":
                expected.SetOrientationType(4)  # else it is upside down
            wanted = scalars(run(expected))
            check(found.dtype == numpy.uint8 and (found.reshape(W * H, -1) == wanted.reshape(W * H, -1)[:, :3]).all(), f"other pixels of {path} than VTK's")
        if extension != "jpg":
            wanted = numpy.broadcast_to(pixels[..., :3], (H, W, found[0].size)).reshape(found.shape)
            check((found == wanted).all(), f"other pixels of {path} than were written")

        # Cut off at any place it is an error or an image of that size, damaged it is never a crash.
        with open(path, "rb") as whole:
            content = whole.read()
        for place in (*range(0, len(content), max(len(content) // 40, 1)), len(content) - 1):
            same = reader(file("cut", content[:place]))
            errors = Errors(same)
            same.Update()
            check(not errors.messages or "cut" in str(errors), f"{path} up to byte {place}: {errors}")
            check(bool(errors.messages) or same.GetOutput().GetDimensions() == (W, H, 1), f"{path} up to byte {place}")
            if extension == "png" and place < len(content) / 2:
                check(errors.messages, f"half of {path} is an image")

# What the pipeline asks before it reads: the size and type of the pixels, of which the head of the file tells.
noise = picture(random.integers(0, 256, (1000, 1000)))
for extension in ("png", "bmp", "jpg"):
    asked = reader(written(file(f"noise.{extension}"), noise, KINDS[extension][0]))
    before = bytes_read()
    asked.CanReadFile(asked.GetFileName())
    asked.UpdateInformation()
    check(bytes_read() - before < 200000, f"{bytes_read() - before} bytes are read of {asked.GetFileName()}")
    info = asked.GetOutputInformation(0)
    check(info.Get(vtkStreamingDemandDrivenPipeline.WHOLE_EXTENT()) == (0, 999, 0, 999, 0, 0), f"{info}")
    check(vtkImageData.GetScalarType(info) == VTK_UNSIGNED_CHAR, f"{info}")

fails(reader(__file__), "not a PNG")
check(not vtkMEAMImageReader().CanReadFile(__file__) and not vtkMEAMImageReader().CanReadFile(None), "no image")
# An error takes the old output away.
same = reader(file("1.png"))
run(same)
same.SetFileName(__file__)
fails(same, "not a PNG")
