# SPDX-License-Identifier: BSD-3-Clause
"""The simulated bin: the scan, the truth and the mesh fit each other."""
import math

from vtkmodules.vtkCommonDataModel import vtkPolyData

from ppfmeam.filters import vtkMEAMBinSceneSource, vtkMEAMSamplePartSource
from meamtest import bracket, check, close, connect, fails, field, is_empty, points, run, tuples


def bin_of(part=None, **properties):
    return connect(vtkMEAMBinSceneSource(), part, **{**dict(Copies=3, Width=160, Height=120, MatchingWindow=3), **properties})


part = run(vtkMEAMSamplePartSource())
source = bin_of()
scan = run(source)
truth, mesh, image = (source.GetOutputDataObject(port) for port in (1, 2, 3))
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
fractions = [f for f, in tuples(truth, "VisibleFraction")]
check(all(0 < f <= 1 for f in fractions), "every copy is seen")

# The truth in the image: what is seen of a copy is in its silhouette.
instances = [int(i) for i, in tuples(scan, "Instance")]
silhouettes = [value for value, in field(truth, "Silhouettes")]
place = 0
for i, (left, top, width, height) in enumerate(tuples(truth, "Box")):
    left, top, width, height = int(left), int(top), int(width), int(height)
    mask = silhouettes[place:place + width * height]
    place += width * height
    check(set(mask) <= {0, 255} and mask.count(255) == tuples(truth, "Pixels")[i][0], f"the pixels of copy {i}")
    check(instances.count(i) == tuples(truth, "VisiblePixels")[i][0], f"the visible pixels of copy {i}")
    check(close([fractions[i]], [instances.count(i) / mask.count(255)]), f"the visible share of copy {i}")
    seen = [k for k, instance in enumerate(instances) if instance == i]
    check(all(mask[(k // 160 - top) * width + k % 160 - left] == 255 for k in seen), f"copy {i} is outside")
check(place == len(silhouettes), "silhouettes of all copies")

# The scan and its image come from one camera, at the origin.
fx, _, cx, _, fy, cy, _, _, _ = field(scan, "CameraMatrix")[0]
for i in range(0, 160 * 120, 37):
    x, y, z = points(scan)[i] if i not in blank else (0, 0, 0)
    check(z == 0 or (abs(fx * x / z + cx - i % 160) < 0.01 and abs(fy * y / z + cy - i // 160) < 0.01), f"point {i}")
check(field(image, "CameraMatrix") == field(scan, "CameraMatrix"), "another camera took the image")
check(field(image, "CameraPose")[0] == tuple(float(k % 5 == 0) for k in range(16)), "the camera is not at the origin")
grey, whole = tuples(image, "Intensity"), tuples(scan, "Intensity")
check(grey[-160:] == whole[:160], "the image is upside down")

# A camera beside the sensor, in colour.
beside = bin_of(Baseline=80, Colored=True)
beside_scan = run(beside)
picture = beside.GetOutputDataObject(3)
check(not beside_scan.GetPointData().HasArray("RGB"), "the scan has the image of another camera")
check(len(tuples(picture, "RGB")) == 160 * 120, "an image of its own")
pose = field(picture, "CameraPose")[0]
check(close([math.dist((0, 0, 0), pose[3::4][:3])], [80]), f"the camera is {pose[3::4]} from the sensor")
colored = run(bin_of(Colored=True))
check(len(tuples(colored, "RGB")[0]) == 3 and not colored.GetPointData().HasArray("Intensity"), "an image in colour")

# The same seed is the same scene, another one is not.
check(tuples(run(bin_of()), "Intensity") == tuples(scan, "Intensity"), "not the same scene again")
check(tuples(run(bin_of(Seed=2)), "Intensity") != tuples(scan, "Intensity"), "another seed, the same scene")

# Copies stand at given poses: those that fell, seen again by another sensor.
again = bin_of(Copies=1, Sensor=1)
again.SetInputDataObject(1, truth)
run(again)
check(tuples(again.GetOutputDataObject(1), "Transform") == tuples(truth, "Transform"), "the copies stand elsewhere")
again.SetInputDataObject(1, vtkPolyData())
fails(again, "no poses")
# Another part; its points may be far from its origin.
other = bin_of(bracket(), Copies=2)
run(other)
check(points(other.GetOutputDataObject(2)) == points(bracket()), "the part is the input")

fails(bin_of(vtkPolyData()))
source.SetBinSize(5)
fails(source, "fit")
check(is_empty(truth) and is_empty(mesh), "no truth without a scene")
fails(bin_of(part, SensorHeight=10), "raise")


# Kinds of sensors: the same bin, and what is chosen wins over what the kind has.
def depths_of(**properties):
    data = run(bin_of(MatchingWindow=1, **properties))
    return tuples(data, "Instance"), [p[2] for p in points(data)]


bins = [depths_of(Sensor=kind) for kind in range(3)]
check(bins[0][0] == bins[1][0] == bins[2][0], "another bin")
check(len({str(depths) for _, depths in bins}) == 3, "kinds of sensors that measure the same")
other = depths_of(Sensor=2, RangeNoise=0, PixelBlur=0, Multipath=0, DepthNoise=0.3, DepthStep=0.05)
check(str(other) == str(bins[0]), "time of flight with the quality of structured light is that")
sizes = []
for choice in ("StructuredLight", "ActiveStereo", "TimeOfFlight"):
    source = bin_of(Copies=1, Width=-1, Height=-1, MatchingWindow=1)
    getattr(source, "SetSensorTo" + choice)()
    run(source).GetDimensions(size)
    sizes.append(tuple(size[:2]))
check(sizes == [(960, 768), (1280, 720), (640, 480)], f"{sizes}")
