# SPDX-License-Identifier: BSD-3-Clause
"""What ParaView drew."""
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader


def pixels(path, view=None, size=None):
    """The colours of a PNG file, N x 3; of a view it is made first."""
    if view:
        from paraview import simple

        simple.SaveScreenshot(path, view, ImageResolution=size)
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())[:, :3].astype(int)


def share(pixels, color):
    """Share of the pixels whose hue is that of the colour."""
    level = pixels.max(axis=1)
    near = sum(abs(pixels[:, c] / level.clip(1) - color[c] / max(color)) for c in range(3)) < 0.35
    return (near & (level - pixels.min(axis=1) > 40)).mean()


def red(pixels):
    """Of each pixel whether it is red."""
    return (pixels[:, 0] > 80) & (pixels[:, 1:].max(axis=1) < pixels[:, 0] // 2)
