# SPDX-License-Identifier: BSD-3-Clause
"""The simulated bin: the scan, the truth and the mesh fit each other."""
import math

from vtkmodules.vtkCommonDataModel import vtkPolyData

from ppfmeam.filters import vtkMEAMBinSceneSource, vtkMEAMSamplePartSource
from meamtest import bracket, check, close, connect, fails, field, is_empty, points, prints, run, tuples


def bin_of(part=None, **properties):
    filter = vtkMEAMBinSceneSource()
    if part:
        filter.SetInputDataObject(part)
    for name, value in {**dict(Copies=3, Width=160, Height=120, Dropout=0.01), **properties}.items():
        getattr(filter, "Set" + name)(value)
    return filter


part = run(vtkMEAMSamplePartSource())
source = bin_of()
scan = run(source)
truth, mesh = source.GetOutputDataObject(1), source.GetOutputDataObject(2)
size = [0, 0, 0]
scan.GetDimensions(size)
check(size == [160, 120, 1], f"the scan is {size}")
check(truth.GetNumberOfPoints() == 3, f"{truth.GetNumberOfPoints()} true poses")
check(points(mesh) == points(part) and field(truth, "Diameter") == field(part, "Diameter"), "the part is the sample")
check(len(tuples(scan, "Intensity")) == 160 * 120, "every pixel has a grey value")
blank = [i for i, p in enumerate(points(scan)) if not all(map(math.isfinite, p))]
check(0 < len(blank) < 160 * 120 / 4 and not any(scan.IsPointVisible(i) for i in blank), "some pixels have no depth")
# A pixel of an instance lies on that instance: in its frame it is inside the part's bounds.
low, high = mesh.GetBounds()[::2], mesh.GetBounds()[1::2]
transforms = tuples(truth, "Transform")
seen = 0
for point, (instance,) in zip(points(scan), tuples(scan, "Instance")):
    if instance >= 0 and math.isfinite(point[2]):
        t = transforms[int(instance)]
        d = [point[k] - t[4 * k + 3] for k in range(3)]
        inside = [sum(t[4 * k + c] * d[k] for k in range(3)) for c in range(3)]
        check(all(low[c] - 1 < inside[c] < high[c] + 1 for c in range(3)), f"{inside} is not on the part")
        seen += 1
check(seen > 1000, f"only {seen} pixels show the part")
check(all(0 < f <= 1 for f, in tuples(truth, "VisibleFraction")), "every copy is seen")

# The same seed is the same scene, another one is not.
check(tuples(run(bin_of()), "Intensity") == tuples(scan, "Intensity"), "not the same scene again")
check(tuples(run(bin_of(Seed=2)), "Intensity") != tuples(scan, "Intensity"), "another seed, the same scene")
# Another part; its points may be far from its origin.
other = bin_of(bracket(), Copies=2)
run(other)
check(points(other.GetOutputDataObject(2)) == points(bracket()), "the part is the input")

fails(bin_of(vtkPolyData()))
source.SetBinSize(5)
fails(source, "fit")
check(is_empty(truth) and is_empty(mesh), "no truth without a scene")
prints(source, "Copies", "Seed", "BinSize", "SensorHeight", "Width", "Height", "DepthNoise", "Dropout", "ImageNoise")
