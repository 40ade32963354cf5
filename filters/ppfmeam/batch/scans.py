# SPDX-License-Identifier: BSD-3-Clause
"""Where many scans come from: a dataset in the form of the BOP benchmark, a list in a file, or a folder."""
import os

from .. import dataset, scripting
from . import table

UNSURE = (".csv", ".txt")  # may be anything
CLOUDS = tuple(kind for kind in scripting.CLOUDS if kind not in UNSURE)


class Scan:
    """A scan as it was read, `image` of a camera with the calibration `image_camera`, or of the scan's own pixels, or
    None; `files`, of both, where `ppfmeam why` reads them."""

    def __init__(self, scene, image=None, image_camera=None, files=None):
        self.scene, self.image, self.image_camera, self.files = scene, image, image_camera, files


class Files:
    """Scans in files. A row of list() is (name, path of the scan, path of its image or "")."""

    def __init__(self, options):
        self.options = options

    def is_scan(self, name):
        """By its extension; a depth image is one when there is a calibration of its camera."""
        extension = os.path.splitext(name)[1].lower()  # OpenEXR is none that can be read
        return extension in CLOUDS or bool(self.options.camera) and extension in scripting.DEPTH_IMAGES and extension != ".exr"

    def read(self, _, path, image):
        """A row of list()."""
        options = self.options
        if os.path.splitext(path)[1].lower() not in scripting.DEPTH_IMAGES:
            scene = scripting.read_scan(path, options.scene_scale, options.camera)
        elif options.camera:
            scene = scripting.scaled(
                scripting.read_depth(path, options.camera, options.depth_scale), options.scene_scale, path)
        else:
            raise scripting.Failure(f"{path}: a depth image needs the calibration of its camera, --camera")
        return Scan(scene, scripting.read_image(image) if image else None, options.image_camera, (path, image))


class Folder(Files):
    """The scans of a folder, by name."""

    def is_result(self, name):
        """Whether it is a table that this command writes."""
        out = os.path.abspath(self.options.out)
        return os.path.abspath(os.path.join(self.options.scans, name)) in (out, table.path_of_scans(out))

    def list(self):
        folder = self.options.scans
        names = sorted(os.listdir(folder))
        rows = [(name, os.path.join(folder, name), "") for name in names if self.is_scan(name)]
        left_out = [name for name in names if name.lower().endswith(UNSURE) and not self.is_result(name)]
        if not rows:
            raise scripting.Failure(f"{folder} has no scans: {', '.join(CLOUDS)} or, with --camera and --no-image, depth images, or "
                                    f"{self.options.split}/ of a BOP dataset" +
                                    (f"; {' and '.join(UNSURE)} are taken from a list of scans" if left_out else ""))
        if left_out:
            more = f" and {len(left_out) - 1} more are" if len(left_out) > 1 else " is"
            print(f"{folder}: {left_out[0]}{more} not taken for scans; a list of scans may name {' and '.join(UNSURE)}", flush=True)
        return rows


class ListFile(Files):
    """The scans that a text file names, one in a line, after a tab the scan's image; paths as seen from the file."""

    def list(self):
        path = self.options.scans
        scripting.require_file(path)
        try:
            with open(path, encoding="utf-8-sig") as file:
                lines = [line for line in file.read().splitlines() if line.strip() and not line.startswith("#")]
        except UnicodeDecodeError:
            raise scripting.Failure(f"{path} is not a list of scans, a text file with a path in each line") from None
        if not lines:
            raise scripting.Failure(f"{path} names no scans")
        folder, rows = os.path.dirname(path), []
        for line in lines:
            scan, _, image = (word.strip() for word in line.partition("\t"))
            rows.append((scan, os.path.join(folder, scan), os.path.join(folder, image) if image else ""))
        names = [name for name, _, _ in rows]
        twice = len(set(names)) < len(names) and next(name for k, name in enumerate(names) if name in names[:k])
        if twice:
            raise scripting.Failure(f"{path} names {twice} twice")
        return rows


class BOP:
    """The images of a BOP dataset. A row of list() is (name, scene, step); without a step where the scene cannot be
    listed."""

    def __init__(self, options):
        self.data = dataset.Dataset(options.scans, options.split)
        for name in ("camera", "depth_scale", "image_camera", "scene_scale"):
            if getattr(options, name) not in (None, 1):
                raise scripting.Failure(f"{options.scans} is a BOP dataset, which has its cameras and scales: leave --{name.replace('_', '-')} out")
        self.scene, self.number = None, None  # the last one

    def list(self):
        rows = []
        for number in self.data.scenes():
            try:
                cameras = scripting.read_json(os.path.join(self.data.split, f"{number:06d}", "scene_camera.json"))
                images = sorted(map(int, cameras))
            except (scripting.Failure, TypeError, ValueError):
                images = []
            rows += [(f"{number:06d}/{image:06d}", number, step) for step, image in enumerate(images)]
            if not images:
                rows.append((f"{number:06d}", number, None))
        if not rows:
            raise scripting.Failure(f"{self.data.split} has no scenes")
        return rows

    def read(self, _, number, step):
        """A row of list()."""
        if self.number != number:
            self.scene, self.number = None, None
            self.scene, self.number = self.data.scene(number), number
        image = self.scene.image(step or 0)
        return Scan(image.scan, image.beside, self.data.beside(), (os.path.join(self.scene.folder, f"{image.number:06d}"), None))


def source(options):
    """Of the folder or file `options.scans`."""
    if not os.path.isdir(options.scans):
        return ListFile(options)
    return BOP(options) if os.path.isdir(os.path.join(options.scans, options.split)) else Folder(options)
