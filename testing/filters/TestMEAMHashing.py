# SPDX-License-Identifier: BSD-3-Clause
"""A table of few pairs against features worked out by hand; the trained model's shape."""
import math

from vtkmodules.vtkCommonDataModel import vtkPartitionedDataSetCollection, vtkPolyData

from ppfmeam.filters import vtkMEAMHashing
from meamtest import check, close, cloud, collection, connect, fails, field, partitions, run, set_fields, text, tuples

# d = (3, 4, 0): f1 = 5, f2 = 53.13 degrees, f3 = 36.87 degrees, f4 = 90 degrees; and back: f2 and f3 change places.
PLACES = [(0.0, 0.0, 0.0), (3.0, 4.0, 0.0)]
TANGENTS = [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0)]


def view(places=PLACES, tangents=TANGENTS, direction=(0, 0, 1)):
    arrays = {"Tangent": tangents} if tangents else {}
    return set_fields(cloud(places, **arrays), ViewDirection=direction)


def hashing(views, surface=None, **properties):
    return connect(vtkMEAMHashing(), views, surface, **properties)


def values(data, name):
    return [v for v, in tuples(data, name)]


def table(model):
    """{key: [(reference, referred, angle, views)]}"""
    parts = dict(partitions(model))
    offsets = values(parts["PairTableBuckets"], "Offset")
    rows = list(zip(*(values(parts["PairTableEntries"], n) for n in ("Reference", "Referred", "Angle", "ViewBits"))))
    check(offsets[0] == 0 and offsets[-1] == len(rows) == field(model, "NumberOfPairs")[0][0],
          "all entries are in a bucket")
    return {k: rows[int(a):int(b)] for k, (a, b) in enumerate(zip(offsets, offsets[1:])) if a != b}


def find(buckets, key):
    check(key in buckets and len(buckets[key]) == 1, f"bucket {key} is not in {buckets}")
    return buckets[key][0]


paper = {"Feature": 0, "DistanceStep": 0.1, "AngleStep": 10.0, "CoVisibilityDirections": 0}
one = collection(("top", view()), Diameter=10.0)
model = run(hashing(one, **paper))
buckets = table(model)
check(sum(map(len, buckets.values())) == 2, "two points make two ordered pairs")
# 11 steps of distance, 9 of each angle; a right angle belongs to the last step.
reference, referred, angle, bits = find(buckets, ((5 * 9 + 5) * 9 + 3) * 9 + 8)
check((reference, referred, bits) == (0, 1, 1), "the pair from the first point to the second")
check(abs(abs(angle) - math.pi / 2) < 1e-6, "the turn of d about the x axis")
reference, referred, angle, bits = find(buckets, ((5 * 9 + 3) * 9 + 5) * 9 + 8)
check((reference, referred, bits) == (1, 0, 1), "the pair from the second point to the first")
offsets = values(dict(partitions(model))["PairTableBuckets"], "Offset")
check(len(offsets) == 11 * 9 * 9 * 9 + 1, f"{len(offsets) - 1} keys")

# The sign of a tangent carries no meaning.
flipped = run(hashing(collection(("top", view(tangents=[(-1, 0, 0), (0, 1, 0)])), Diameter=10.0), **paper))
check(set(table(flipped)) == set(buckets), "a tangent turned round gives the same keys")

# Seen from two sides: the merged points keep both bits, and no pair joins points of different views.
both = collection(("top", view()), ("front", view(direction=(1, 0, 0))), Diameter=10.0)
merged = run(hashing(both, **paper))
check(sum(map(len, table(merged).values())) == 2, "points of two views at one place are one")
check(values(dict(partitions(merged))["Edges"], "ViewBits") == [3, 3], "they are on the edge in both views")
check(find(table(merged), ((5 * 9 + 5) * 9 + 3) * 9 + 8)[3] == 3, "so is the pair")
apart = collection(("top", view()), ("front", view([(0, 0, 5), (3, 4, 5)], direction=(1, 0, 0))), Diameter=10.0)
check(sum(map(len, table(run(hashing(apart, **paper))).values())) == 4, "points of different views make no pair")
codes = run(hashing(both, ViewMerging=1, VoxelSize=0.5, **paper))
check(sum(map(len, table(codes).values())) == 2, "voxel codes save a pair once")
check(values(dict(partitions(codes))["Edges"], "ViewBits") == [1, 1, 2, 2], "each view keeps its points")
apart = run(hashing(both, ViewMerging=2, **paper))
check(sum(map(len, table(apart).values())) == 4, "separate tables save it once for each view")
check(field(apart, "TableBytes")[0][0] == 4 * (11 * 9 ** 3 + 1 + 4 * 4), f"{field(apart, 'TableBytes')} bytes")

# The shape of the trained model.
check([name for name, _ in partitions(merged)] == ["View 0", "View 1", "Edges", "PairTableBuckets", "PairTableEntries"],
      f"{[name for name, _ in partitions(merged)]}")
for v, (_, edges) in enumerate(partitions(merged)[:2]):
    check(edges.GetNumberOfPoints() == 2 and len(tuples(edges, "Tangent")) == 2, "a view shows its edges")
    check(close(field(edges, "ViewDirection")[0], ((0, 0, 1), (1, 0, 0))[v]), "and knows its direction")
expected = {"FormatVersion": 4, "Features": 0, "Diameter": 10.0, "Feature": 0, "DistanceStep": 0.1, "AngleStep": 10.0, "ViewMerging": 0,
            "VoxelSize": 0.0, "LeafSize": 0.0, "CoVisibilityDirections": 0, "NumberOfViews": 2, "NumberOfEdgePoints": 2,
            "NumberOfSurfacePoints": 0, "NumberOfPairs": 2}
for name, value in expected.items():
    check(abs(field(merged, name)[0][0] - value) < 1e-12, f"{name} is {field(merged, name)}")


check(text(merged, "Units") == "mm", "units")
digest = text(merged, "Digest")
check(len(digest) == 16, f"the digest is '{digest}'")
check(text(run(hashing(both, **paper)), "Digest") == digest, "the same input")
check(text(run(hashing(both, **{**paper, "AngleStep": 11.0})), "Digest") != digest, "other parameters")
surface = cloud([(0, 0, 0), (3, 4, 0), (9, 0, 0)], Normals=[(0, 0, 1)] * 3, PointId=range(3))
with_surface = dict(partitions(run(hashing(one, surface, **paper))))
check(tuples(with_surface["Surface"], "Normals") == [(0, 0, 1)] * 3, "the surface is kept, with normals")
without_diameter = run(hashing(collection(("top", view())), **paper))
check(abs(field(without_diameter, "Diameter")[0][0] - 5.0) < 1e-6, "without a diameter that of the points is taken")

many = [(str(v), view()) for v in range(33)]
fails(hashing(collection(*many, Diameter=10.0)), "32")
fails(hashing(collection(("top", view(tangents=None)), Diameter=10.0)), "top", "no tangents")
fails(hashing(collection(("top", view([], [])), Diameter=10.0)), "no edges")
fails(hashing(vtkPartitionedDataSetCollection()), "no appearance models")
fails(hashing(collection(("top", cloud(PLACES, Tangent=TANGENTS)))), "ViewDirection")
fails(hashing(one, vtkPolyData()), "surface", "no points")
fails(hashing(one, cloud(PLACES)), "Normals", "SurfaceSampling")
fails(hashing(view()), "vtkPartitionedDataSetCollection")
