# SPDX-License-Identifier: BSD-3-Clause
"""Labels of poses and of picks: none covers another, those of the first points come first, texts are cut where they have no
room, and those that are left out come when one zooms in."""
import os
import tempfile

from paraview import simple

from pictures import pixels

SIZE = [600, 450]
SOURCE = """
import vtk
points, labels = vtk.vtkPoints(), vtk.vtkStringArray()
labels.SetName("Label")
for place, text in {labels}:
    points.InsertNextPoint(place)
    labels.InsertNextValue(text)
self.GetOutput().SetPoints(points)
self.GetOutput().GetPointData().AddArray(labels)
"""


def check(condition, message):
    if not condition:
        raise AssertionError(message)


def drawn(labels, angle=30, above=100):
    """The picture of labels ((x, y, z), text), seen along -z from above: an image of what is not black."""
    view = simple.CreateRenderView()
    view.OrientationAxesVisibility, view.ViewSize = 0, SIZE
    view.Background, view.UseColorPaletteForBackground = [0, 0, 0], 0
    source = simple.ProgrammableSource(Script=SOURCE.format(labels=labels))
    shown = simple.Show(source, view)
    shown.Representation = "Pose Labels"
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0, 0, above], [0, 0, above - 100], [0, 1, 0]
    view.CameraViewAngle = angle
    with tempfile.TemporaryDirectory() as folder:
        picture = pixels(os.path.join(folder, "labels.png"), view, SIZE).max(axis=1) > 0
    simple.Delete(view)
    simple.Delete(source)
    return picture


def same(labels, others, **how):
    return (drawn(labels, **how) == drawn(others, **how)).all()


# Of two labels in one place that of the first point; both from near.
first, second = ((0, 0, 0), "1: 99 %"), ((0.5, 0.5, 0), "2: 98 %")
check(drawn([first]).sum() > 100, "no label is drawn")
check(same([first, second], [first]) and same([second, first], [second]), "a label covers that of the point before")
apart = drawn([first], angle=1) | drawn([second], angle=1)
check((drawn([first, second], angle=1) == apart).all() and apart.sum() > 1.5 * drawn([first]).sum(), "the second label does not come up")

# Cut as far as it must be; a text without a rank is not, and has to go.
places = [(-16, 0, 0), (-8, 0, 0), (0, 0, 0), (7, 0, 0), (7, 12, 0), (7, -12, 0)]
texts = ["1 (perforated plate): 99 %", "2: 98 %, rotation 70 %", "3: 97 %", "33 % covered", "4 (plate, thin): 96 %, rotation 60 %", ""]
cut = ["1", "2: 98 %", "3: 97 %", "", "4 (plate, thin): 96 %, rotation 60 %", ""]
check(same(list(zip(places, texts)), list(zip(places, cut))), "labels are cut in another way")

# A crowd: the number of each, and from far those of the first.
crowd = [((7 * (k % 10) - 32, 6 * (k // 10) - 27, 0), f"{k + 1}: 9{k % 10} %, rotation 80 %") for k in range(100)]
numbers = [(place, text.split(":")[0]) for place, text in crowd]
check(same(crowd, numbers, angle=60), "labels of a crowd")
far, best = drawn(crowd, angle=120), drawn(numbers[:1], angle=120)
check((far & best).sum() == best.sum(), "the first label is left out")
check(far.sum() < 0.7 * drawn(numbers, angle=60).sum(), "nothing is left out from far")

# What lies behind the camera has no label.
check(not drawn([first], above=-10).any(), "a label of what is behind the camera")
