# SPDX-License-Identifier: BSD-3-Clause
"""Images that are cut off or damaged: `detect` and `why` say so in a sentence, `batch` in the scan's row, and none ends the
program."""
import glob
import os
import shutil

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkBMPWriter, vtkJPEGWriter, vtkPNGWriter, vtkTIFFWriter

from ppfmeam import scripting
from batchtest import H, W, command, content, dataset, finished
from meamtest import check, picture, rows_of, write, written
from scripttest import refuses, write_pcd

WRITERS = {"png": vtkPNGWriter, "jpg": vtkJPEGWriter, "bmp": vtkBMPWriter, "tif": vtkTIFFWriter}
CORPUS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "fuzz", "corpus")

model, scan = dataset("bins", 1)
scripting.write_model(model, "plate.meam")
points = vtk_to_numpy(scan.GetPoints().GetData())
write_pcd("scan.pcd", points, W, H, "x y z")
image = picture(vtk_to_numpy(scan.GetPointData().GetArray("Intensity")).reshape(H, W))

random = numpy.random.default_rng(1)
good, cut, flipped = [], [], []
for extension, kind in WRITERS.items():
    path = f"whole.{extension}"
    good.append(written(path, image, kind))
    whole = content(path)
    for k, share in enumerate((0.01, 0.3, 0.6, 0.95)):
        cut.append(f"cut{k}.{extension}")
        write(cut[-1], whole[:int(share * len(whole))])
    for k in range(6):
        flipped.append(f"flipped{k}.{extension}")
        damaged = bytearray(whole)
        for place in random.integers(0, (60, 400, len(whole))[k % 3], 3):
            damaged[place] ^= 1 << random.integers(8)
        write(flipped[-1], damaged)
kept = []
for path in sorted(glob.glob(os.path.join(CORPUS, "*image", "*"))):
    kept.append("kept_" + os.path.basename(path))
    shutil.copy(path, kept[-1])
check(len(kept) > 10, f"the kept damaged files: {kept}")

for extension in WRITERS:
    name = f"cut2.{extension}"
    refuses(f"{name}' is cut off", "detect.py", "--model", "plate.meam", "--scene", "scan.pcd", "--image", name)
    refuses(f"{name}' is cut off", "why.py", "plate.meam", "scan.pcd", "--at", "0", "0", "1", "--image", name)

images = good + cut + flipped + kept
for k, _ in enumerate(images):
    os.link("scan.pcd", f"{k}.pcd")
with open("list.txt", "w", encoding="utf-8") as file:
    file.writelines(f"{k}.pcd\t{name}\n" for k, name in enumerate(images))
finished(*command("list.txt", "--model", "plate.meam", "--poses", "1", "--features", "edges", "--out", "list.csv"))
found = {images[int(row["scan"][:-4])]: row for row in rows_of("list.csv")}
check(list(found) == images, "a row for each scan")
check(all(found[name]["R"] for name in good), f"whole images are searched: {[found[name] for name in good]}")
for name in cut:
    check("cut off" in found[name]["failure"] and name in found[name]["failure"], f"{name}: {found[name]['failure']}")
for name in kept:  # of another size than the scan, if they are images at all
    check(found[name]["failure"], f"{name} is no image of this scan")
