# SPDX-License-Identifier: BSD-3-Clause
"""What the scripts of examples/ share: files by extension, errors as exceptions, tables and pictures."""
import argparse
import contextlib
import json
import math
import os
import re
import signal
import sys
import tempfile
import warnings

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLogger, vtkMath, vtkOutputWindow, vtkPoints, vtkStringOutputWindow
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkThreshold
from vtkmodules.vtkFiltersGeneral import vtkTransformFilter
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
from vtkmodules.vtkIOParallelXML import vtkXMLPartitionedDataSetCollectionWriter
from vtkmodules.vtkIOXML import vtkXMLPartitionedDataSetCollectionReader

from . import Error as Failure
from . import choices, filters, progress

TEXTS = (".xyz", ".csv", ".txt", ".asc", ".pts")  # with a point in each line
CLOUDS = (".pcd", ".ply", *TEXTS)
MESHES = (".off", ".ply", ".stl", ".obj", ".step", ".stp", ".iges", ".igs")
EXTENSIONS = (".pcd", *MESHES, *TEXTS)
SCANS = (*CLOUDS, ".stl", ".obj", ".off")
MODELS = (".meam", ".vtpc")
DEPTH_IMAGES = (".png", ".tif", ".tiff", ".pgm", ".pfm", ".exr")  # their reader says what to do with the last
AS_GOOD = 0.02  # share of the surface that near-symmetries may differ by and count as equally near
STAGES = ("Training", "SceneEdges", "Scene", "Tangents", "Detection", "Screening", "Verification", "Refinement", "Selection",
          "Output", "Total")


class Interruption:
    """Ctrl-C in a script. Python looks at signals between its own steps alone, so what works in VTK is asked to stop whenever
    it tells of its progress, which is shown as well."""

    def __init__(self):
        self.asked = self.watched = False
        self.shows, self.steps = True, None  # how far the steps are, in a terminal

    def ask(self, *_):
        self.asked = True
        if not self.watched:
            raise KeyboardInterrupt

    def watch(self, step, algorithm, *arguments):
        """Calls the step, with the filters before the algorithm watched as well."""
        ours = signal.getsignal(signal.SIGINT) == self.ask  # a program of others has its own
        watched = [(a, a.AddObserver("ProgressEvent", self.hear)) for a in upstream(algorithm)] if ours else []
        self.watched, self.steps = True, progress.Steps()
        try:
            step(*arguments)
        finally:
            self.watched = False
            self.steps.end()
            for filter, observer in watched:
                filter.RemoveObserver(observer)
        if self.asked:
            raise KeyboardInterrupt

    def hear(self, filter, event):
        if self.asked:
            filter.AbortExecuteOn()
        if self.shows:
            self.steps.show(filter)


interruption = Interruption()


def upstream(algorithm):
    """The algorithm and all that feed it."""
    # Not by a function that calls itself: it would keep them, and their data, until Python looks for garbage.
    found, next_ones = {}, [algorithm]
    while next_ones:
        filter = next_ones.pop()
        if filter is not None and id(filter) not in found:
            found[id(filter)] = filter
            next_ones += [filter.GetInputAlgorithm(port, connection) for port in range(filter.GetNumberOfInputPorts())
                          for connection in range(filter.GetNumberOfInputConnections(port))]
    return list(found.values())


@contextlib.contextmanager
def writing(path):
    """Of what goes wrong when a file or folder is written a Failure."""
    try:
        yield
    except BrokenPipeError:  # of the output
        raise
    except OSError as error:
        raise Failure(f"cannot write {path}: {error.strerror}") from None


@contextlib.contextmanager
def written(path, newline=None, mode="w"):
    """A file to write, a text or with mode "wb" bytes, which appears whole or not at all."""
    is_file = os.path.isfile(path) or not os.path.exists(path)  # a device or a pipe must not be renamed over
    part = f"{path}.{os.getpid()}.part" if is_file else path
    try:
        with writing(path):
            text = {} if "b" in mode else {"encoding": "utf-8", "errors": "backslashreplace"}  # names of files may be no UTF-8
            with open(part, mode, newline=newline, **text) as file:
                yield file
            if is_file:
                os.replace(part, path)
    finally:
        if is_file and os.path.exists(part):
            os.remove(part)


def write_all(file, content):
    """Adds bytes to an open file without a buffer."""
    while content:
        content = content[file.write(content):]


def append(file, lines):
    """Adds a text of whole lines to such a file. A process that is killed meanwhile leaves a part of them, and so does a disk
    that becomes full: whole_lines() does without it."""
    write_all(file, lines.encode())


def whole_lines(path):
    """The lines of a file that append() wrote."""
    with open(path, encoding="utf-8", newline="\n") as file:
        return [line for line in file if line.endswith("\n")]


def make_folder(path):
    """Makes a folder and those that it is in, unless they are there."""
    with writing(path):
        os.makedirs(path, exist_ok=True)


def bytes_of(writer):
    """What one of VTK's writers of images or of a single file of XML would write. Of a full disk some of them say nothing,
    others end the program, so they get no file."""
    if hasattr(writer, "WriteToMemoryOn"):  # of images
        writer.WriteToMemoryOn()
        update(writer, "Write")
        return vtk_to_numpy(writer.GetResult()).tobytes()
    writer.WriteToOutputStringOn()
    update(writer, "Write")
    text = writer.GetOutputString()
    return text if isinstance(text, bytes) else text.encode()


def write_by(writer, path):
    """Writes a file by one of VTK's writers, whole or not at all."""
    content = bytes_of(writer)
    with written(path, mode="wb") as file:
        file.write(content)


def run(main):
    """Runs a script's main function; a Failure is one message and exit status 1, a warning is a line on stderr, and Ctrl-C ends
    it within a second, with whole files alone left behind."""
    choices.is_command = True
    warnings.simplefilter("always", UserWarning)
    warnings.showwarning = lambda message, *_: print(f"warning: {message}", file=sys.stderr)
    signal.signal(signal.SIGINT, interruption.ask)
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        print(f"{os.path.basename(sys.argv[0])}: stopped", file=sys.stderr)
        sys.exit(128 + signal.SIGINT)
    except Failure as failure:
        sys.exit(f"{os.path.basename(sys.argv[0])}: {failure}")
    except BrokenPipeError:  # the reader of the output, such as head, has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def update(algorithm, step="Update", *arguments):
    """Updates an algorithm (or calls another method); what it reports as an error is raised as a Failure, and what our own
    filters warn of is a warning."""
    window, before = vtkStringOutputWindow(), vtkOutputWindow.GetInstance()
    verbosity = vtkLogger.GetCurrentVerbosityCutoff()
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
    vtkOutputWindow.SetInstance(window)
    try:
        interruption.watch(getattr(algorithm, step), algorithm, *arguments)
    finally:
        vtkOutputWindow.SetInstance(before)
        vtkLogger.SetStderrVerbosity(verbosity)
    text = window.GetOutput()
    if isinstance(text, bytes):  # a message with bytes of a file that is not text
        text = text.decode(errors="replace")
    for warning in re.findall(r"Warning: In .*\nvtkMEAM\w+ \(.*?\): ((?:.+\n?)+)", text):
        warnings.warn(choices.worded(" ".join(warning.split())), stacklevel=3)
    errors = re.findall(r"ERROR: In .*\n(?:\w+ \(.*?\): )?((?:.+\n?)+)", text)
    if errors:
        causes = [error for error in errors if "returned failure for request" not in error]
        raise Failure(" ".join(causes[0].split()) if causes else f"{algorithm.GetClassName()} failed")
    return algorithm


class Once(argparse.Action):
    """Stores the value of an option; a second one is an error and does not take the place of the first."""
    is_given = False

    def __call__(self, parser, namespace, values, option_string=None):
        if option_string and self.is_given:
            raise argparse.ArgumentError(self, "it is given twice")
        self.is_given = True
        setattr(namespace, self.dest, values)


class Parser(argparse.ArgumentParser):
    """That of a command."""

    def __init__(self, *arguments, **options):
        super().__init__(*arguments, allow_abbrev=False, **options)
        for action in (None, "store"):
            self.register("action", action, Once)


def count(text):
    """A number of things, as argparse wants it."""
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(f"it has to be a whole number, 0 or more, not {text}")
    return int(text)


def has_image(scan):
    """Whether a scan carries the image of its sensor."""
    return any(map(scan.GetPointData().HasArray, ("Intensity", "RGB")))


PRESETS, FEATURES = (choices.TABLE["detect"][name]["values"] for name in ("preset", "features"))


class MethodAction(argparse.Action):
    """--method names what --preset does not: every method but meam is a preset of its own."""

    def __call__(self, parser, namespace, values, option_string=None):
        if values != "meam":
            namespace.preset = values


def add_method_options(parser):
    """The options --method and --preset of a parser; both say `preset`."""
    parser.add_argument("--preset", choices=("paper", "recommended"), default="recommended",
                        help="parameters of all steps of PPF-MEAM: the paper's, Section 6, or those that measure better "
                             "(default: %(default)s)")
    parser.add_argument("--method", choices=("meam", "without-meam", "ppf", "b2b"), action=MethodAction,
                        help="meam: PPF-MEAM (default). In its place, as the paper compares itself with them: without-meam, "
                             "B2B-TL with one model of the whole part; ppf, pairs of surface points with normals (Drost et al. "
                             "2010); b2b, pairs of points on line segments (Choi et al. 2012)")


def set_preset(estimation, preset):
    """A preset of vtkMEAMPoseEstimation by its name on the command line."""
    set_choice(estimation, "Preset", PRESETS[preset])


def add_bin_arguments(parser, scenes):
    """What a script that simulates bins asks for: the part, and how many bins of how many copies; `scenes` by default."""
    parser.add_argument("--cad", required=True, help="CAD file: .step or .iges, or .stl, .obj, .ply or .off in mm")
    choices.add_options(parser, "train", "scale")
    choices.add_options(parser, "read", "solid")
    parser.add_argument("--copies", type=count, default=20, help="copies in a bin (default: %(default)s)")
    parser.add_argument("--scenes", type=count, default=scenes, help="bins to fill (default: %(default)s)")
    parser.add_argument("--seed", type=count, default=1,
                        help="of the first bin, the next has the next one (default: %(default)s)")


def require_cad(parser, options, cad):
    """Ends the command where something is chosen of a CAD file, and there is none."""
    for name in ("solid", "cad_scale", "cad_offset"):
        if not cad and getattr(options, name, None) != parser.get_default(name):
            parser.error(f"--{name.replace('_', '-')} is of a CAD file: leave it out, trained models and datasets have their own")


def require_shown(parser, options, *where):
    """Ends the command where --cad does not go with --model, or nothing shows it."""
    if options.cad and options.model and len(options.cad) != len(options.model):
        parser.error("give a --cad for each --model, in the same order, or none")
    if options.cad and options.model and not any(where):
        parser.error("--cad beside --model is for what shows the part, as --report does: leave one of them out")


def set_choice(algorithm, name, choice):
    """Sets an enumerated property: Preset, recommended calls SetPresetToRecommended()."""
    getattr(algorithm, f"Set{name}To{choice[0].upper()}{choice[1:]}")()


def set_viewpoint(algorithm, viewpoint, scale=1.0):
    """The sensor of a filter, at a place of the scan before it is scaled; None: as the scan tells."""
    if viewpoint is not None:
        algorithm.SetProjectionToPerspective()
        algorithm.SetSensorPosition([scale * float(value) for value in viewpoint])
        algorithm.SetViewDirection(0, 0, 0)  # at the middle of the scan


def require_file(path):
    """Raises a Failure when a file cannot be read."""
    try:
        with open(path, "rb"):
            pass
    except OSError as error:
        raise Failure(f"cannot read {path}: {error.strerror}") from None


def require_folder_of(*paths):
    """Raises a Failure when one of the files (or None) could not be written: before any work is done."""
    for path in filter(None, paths):
        folder = os.path.dirname(os.path.abspath(path))
        if os.path.isdir(path) or not os.access(folder, os.W_OK):
            why = "it is a folder" if os.path.isdir(path) else "the folder is protected" if os.path.isdir(folder) else "no such folder"
            raise Failure(f"cannot write {path}: {why}")


def read_json(path):
    """What a JSON file holds."""
    require_file(path)
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except ValueError as error:
        raise Failure(f"{path} is not JSON: {error}") from None


def write_json(path, value):
    """Writes a value with NumPy's arrays and numbers; what is not a number becomes null."""
    def plain(value):
        if isinstance(value, dict):
            return {name: plain(each) for name, each in value.items()}
        if isinstance(value, (list, tuple)):
            return [plain(each) for each in value]
        if isinstance(value, (numpy.ndarray, numpy.generic)):
            return plain(value.tolist())
        return None if isinstance(value, float) and not math.isfinite(value) else value
    with written(path) as file:
        json.dump(plain(value), file, indent=1)
        file.write("\n")


def read_with(reader, path):
    """What a reader finds in a file."""
    require_file(path)
    reader.SetFileName(os.fsencode(path))
    try:
        return update(reader).GetOutputDataObject(0)
    except Failure as failure:
        raise failure if path in str(failure) else Failure(f"{path}: {failure}") from None


def read(path, scale=1.0, solid=0, known=EXTENSIONS):
    """The mesh or the cloud in a file of EXTENSIONS, its coordinates times a factor; of a STEP file `solid` alone, or all. `known`:
    what a message names."""
    extension = os.path.splitext(path)[1].lower()
    require_kind(path, extension in EXTENSIONS, known)
    if extension in CLOUDS and (extension != ".ply" or filters.vtkMEAMPLYReader().CanReadFile(path)):  # without faces
        reader = cloud_reader(extension)
    else:
        reader = filters.vtkMEAMMeshReader()
        reader.SetSolid(solid)
    data = read_with(reader, path)
    return scaled(data, scale, path)


def cloud_reader(extension):
    """The reader of a file of CLOUDS."""
    readers = {".pcd": filters.vtkMEAMPCDReader, ".ply": filters.vtkMEAMPLYReader}
    return readers.get(extension, filters.vtkMEAMXYZReader)()


def require_kind(path, is_known, known):
    """Raises a Failure where a file of meshes or clouds is of no kind that is known."""
    if not is_known:
        kind = "it is a folder" if os.path.isdir(path) else "unknown kind of file"
        if path.lower().endswith(MODELS):
            kind = "it is a trained model" + (", for the --model of commands that take one" if choices.is_command else "")
        export = "; CAD programs export .step" if known == MESHES else ""
        raise Failure(f"{path}: {kind}; known are {', '.join(known)}{export}")


def scaled(data, scale, what):
    """The points times a factor; `what` they are is for the message."""
    if scale == 1.0:
        return data
    if not 0 < scale < float("inf"):
        raise Failure(f"{what}: the scale has to be a positive number, not {scale}")
    transform, filter = vtkTransform(), vtkTransformFilter()
    transform.Scale(scale, scale, scale)
    filter.SetTransform(transform)
    filter.SetInputDataObject(data)
    return update(filter).GetOutputDataObject(0)


def read_mesh(path, offset=(0, 0, 0), scale=1.0, solid=0):
    """The clean mesh of a CAD file, scaled to mm and moved by an offset in mm."""
    data = read(path, solid=solid, known=MESHES)
    if not data.IsA("vtkPolyData"):
        raise Failure(f"{path} is an organized scan: the part has to be a mesh with faces (.step, .iges, .stl, .obj, .ply or .off)")
    if data.GetNumberOfPoints() and not data.GetNumberOfPolys() + data.GetNumberOfStrips():
        raise Failure(f"{path} holds points alone: the part has to be a mesh with faces; is it the scan?")
    report = data.GetFieldData().GetAbstractArray("CADReport")
    if report:
        print("cad: " + report.GetValue(0))
    return prepare_mesh(data, offset, scale)


def prepare_mesh(data, offset=(0, 0, 0), scale=1.0):
    """The clean mesh of a vtkPolyData, scaled to mm and moved by an offset in mm."""
    preparation = filters.vtkMEAMMeshPreparation()
    preparation.SetInputDataObject(data)
    preparation.SetScale(scale)
    preparation.SetOffset(offset)
    return update(preparation).GetOutput()


def read_image(path):
    """The image in a PNG, JPEG, BMP or TIFF file."""
    return read_with(filters.vtkMEAMImageReader(), path)


def read_scan(path, scale=1.0, camera=None):
    """The cloud in a file of CLOUDS, or the points of a mesh, in mm; with its camera's calibration (a file) points that
    are not organized come back onto the camera's pixels."""
    extension = os.path.splitext(path)[1].lower()
    if camera and extension not in CLOUDS:
        raise Failure(f"{path}: only a cloud ({', '.join(CLOUDS)}) is organized with the camera of the sensor")
    if extension in DEPTH_IMAGES:
        raise Failure(f"{path} is an image: give a depth image with --depth and its --camera, and the scan's image with --image")
    if extension not in CLOUDS:
        require_kind(path, extension in SCANS, SCANS)
        return read(path, scale) if extension != ".obj" else points_of_obj(path, scale)
    if not 0 < scale < float("inf"):
        raise Failure(f"{path}: the scale has to be a positive number, not {scale}")
    reader = cloud_reader(extension)
    reader.SetScale(scale)
    reader.SetCameraFile(camera)
    return read_with(reader, path)


def points_of_obj(path, scale):
    """The vertices of an OBJ file, with faces or points alone, in mm."""
    from . import _core  # only now: most commands do without
    require_file(path)
    data = vtkPolyData()
    data.SetPoints(vtk_points(_core.load_scan(path, "", scale).points))
    return data


def read_depth(path, camera, scale=None):
    """The organized cloud of a depth image and its camera's calibration; `scale` in place of the calibration's."""
    reader = filters.vtkMEAMDepthImageReader()
    reader.SetCameraFile(camera)
    reader.SetDepthScale(scale or 0.0)
    return read_with(reader, path)


def read_model(path):
    """The trained model that write_model wrote."""
    if path.lower().endswith(".meam"):
        return read_with(filters.vtkMEAMModelReader(), path)
    if not path.lower().endswith(".vtpc"):
        raise Failure(f"{path}: the name of a trained model ends in .meam, or .vtpc; `train` makes one of a CAD file")
    return read_with(vtkXMLPartitionedDataSetCollectionReader(), path)


def calibration_of(model):
    """Constant and slope of places and of rotations; those that change nothing of a model that was not calibrated."""
    array = model.GetFieldData().GetArray("Calibration")
    return tuple(array.GetValue(k) for k in range(4)) if array else (0.0, 1.0, 0.0, 1.0)


class Training:
    """The steps from a clean mesh to the trained model, connected; parameters may be changed before model()."""

    def __init__(self, mesh, preset="recommended", features="both"):
        self.surface = filters.vtkMEAMSurfaceSampling()
        self.views = filters.vtkMEAMVisibilityExtraction()
        self.boundary = filters.vtkMEAMBoundaryExtraction()
        self.tangents = filters.vtkMEAMTangentEstimation()
        self.symmetries = filters.vtkMEAMSymmetryDetection()
        self.hashing = filters.vtkMEAMHashing()
        for step in (self.tangents, self.hashing):
            set_choice(step, "Parameters", "recommended" if preset == "recommended" else "paper")
        if preset == "recommended":
            set_choice(self.hashing, "Features", features)
        if preset in ("without-meam", "b2b"):
            self.views.SetNumberOfViewpoints(0)
        if preset == "b2b":
            self.tangents.SetMethodToLineSegments()
        if preset == "ppf":
            self.hashing.SetFeaturesToSurface()
        steps = (self.surface, self.views, self.boundary, self.tangents, self.hashing)
        self.surface.SetInputDataObject(mesh)
        for before, step in zip(steps, steps[1:]):
            step.SetInputConnection(before.GetOutputPort())
        for step in (self.views, self.boundary):
            step.SetInputDataObject(1, mesh)  # only their methods that use the mesh look at it
        self.symmetries.SetInputConnection(self.surface.GetOutputPort())
        samples = self.symmetries if preset == "recommended" else self.surface
        self.hashing.SetInputConnection(1, samples.GetOutputPort())

    def model(self):
        """The trained model."""
        return update(self.hashing).GetOutput()

    def symmetric_samples(self):
        """The samples with the part's symmetries as field data."""
        return update(self.symmetries).GetOutput()


def train(mesh, preset="recommended", features="both"):
    """The trained model of a mesh."""
    return Training(mesh, preset, features).model()


def require_room(folder, data, path):
    """Raises a Failure unless a folder takes a data object, whatever its form, for those of VTK's writers that bytes_of() does
    not know."""
    with writing(path), tempfile.TemporaryFile(dir=folder) as file:
        os.posix_fallocate(file.fileno(), 0, 2048 * (data.GetActualMemorySize() + 1))  # KiB; a text is a third longer


def part_names(files):
    """Of parts in files, as the labels of poses have them (vtkMEAMPartNames.h)."""
    stems = [os.path.splitext(os.path.basename(os.fspath(file)))[0] for file in files]
    return [f"{stem} {k + 1}" if stem in stems[:k] else stem for k, stem in enumerate(stems)]


def require_model_name(path):
    """Raises a Failure when a trained model cannot have that name: before any work is done."""
    if os.path.splitext(path)[1] not in (".meam", ".vtpc"):
        raise Failure(f"{path}: the name of a trained model ends in .meam, or .vtpc")


def write_model(model, path):
    """Writes a trained model, NAME.meam, or NAME.vtpc and the folder NAME beside it, whole or not at all."""
    require_model_name(path)
    name, extension = os.path.splitext(os.path.basename(path))
    if extension == ".meam":
        writer = filters.vtkMEAMModelWriter()
        writer.SetInputDataObject(model)
        writer.SetFileName(path)
        update(writer, "Write")
        return
    folder = os.path.dirname(os.path.abspath(path))
    with tempfile.TemporaryDirectory(dir=folder) as scratch:
        require_room(scratch, model, path)
        writer = vtkXMLPartitionedDataSetCollectionWriter()
        writer.SetInputDataObject(model)
        writer.SetFileName(os.path.join(scratch, name + extension))
        writer.SetDataModeToBinary()  # the default mode is not read back by every VTK
        update(writer, "Write")
        pieces, old = os.path.join(folder, name), os.path.join(scratch, "old")
        if os.path.lexists(pieces):
            if not os.path.isdir(pieces) or any(not re.fullmatch(re.escape(name) + r"_\d+_\d+\.vt[pi]", entry)
                                                for entry in os.listdir(pieces)):
                raise Failure(f"cannot write {path}: its pieces go to the folder {pieces}, which holds other files; "
                              "choose another name")
            os.rename(pieces, old)
        try:
            os.rename(os.path.join(scratch, name), pieces)
            os.replace(os.path.join(scratch, name + extension), os.path.join(folder, name + extension))
        except OSError as error:
            if os.path.isdir(old):
                if os.path.isdir(pieces):
                    os.rename(pieces, os.path.join(scratch, "new"))
                os.rename(old, pieces)
            raise Failure(f"cannot write {path}: {error.strerror}") from None


def write_with(writer, data, path):
    """Writes a data object to a file."""
    require_folder_of(path)
    writer.SetInputDataObject(data)
    writer.SetFileName(os.fspath(path))
    update(writer, "Write")


def column(data, name, *shape):
    """A copy of a point array; `shape` of each value. None where there is no such array, without points an empty one."""
    array = data.GetPointData().GetArray(name)
    if array:
        return vtk_to_numpy(array).reshape(-1, *shape).copy()
    return None if data.GetNumberOfPoints() else numpy.zeros((0, *shape))


def texts(data, name):
    """The texts of a point array."""
    array = data.GetPointData().GetAbstractArray(name)
    return [array.GetValue(k) for k in range(data.GetNumberOfPoints())]


def write_poses(poses, path, form, **numbers):
    """Writes poses in a form of vtkMEAMPoseWriter: "BOPCSV", "JSON" or "Matrices"; numbers: SceneId=3."""
    writer = filters.vtkMEAMPoseWriter()
    writer.SetInputDataObject(poses)
    writer.SetFileName(os.fsencode(path))
    set_choice(writer, "Format", form)
    for name, value in numbers.items():
        getattr(writer, "Set" + name)(value)
    update(writer, "Write")


def field(data, name):
    """A number of the field data."""
    return data.GetFieldData().GetArray(name).GetValue(0)


def tuples(data, name):
    """The rows of a field data array."""
    array = data.GetFieldData().GetArray(name)
    return [array.GetTuple(i) for i in range(array.GetNumberOfTuples())]


def vtk_array(values, name=None):
    """VTK's array of a copy of these values; a row has those of a tuple."""
    array = numpy_to_vtk(numpy.ascontiguousarray(values), deep=True)
    array.SetName(name)
    return array


def vtk_points(points):
    """VTK's points of a copy of these, ... x 3."""
    result = vtkPoints()
    result.SetData(vtk_array(points.reshape(-1, 3)))
    return result


def vtk_image(pixels):
    """A vtkImageData of H x W or H x W x C pixels, the lowest row first."""
    image = vtkImageData()
    image.SetDimensions(pixels.shape[1], pixels.shape[0], 1)
    image.GetPointData().SetScalars(vtk_array(pixels.reshape(pixels.shape[0] * pixels.shape[1], -1)))
    return image


def poses_of(transforms):
    """Poses, N x 4 x 4, as the filters take them."""
    data = vtkPolyData()
    data.SetPoints(vtk_points(transforms[:, :3, 3]))
    data.GetPointData().AddArray(vtk_array(transforms.reshape(-1, 16), "Transform"))
    return data


def with_value(data, name, value, cells=False):
    """Of a vtkPolyData the points, or the cells, whose array has that value, with all their arrays."""
    threshold, geometry = vtkThreshold(), vtkGeometryFilter()
    threshold.SetInputDataObject(data)
    threshold.SetInputArrayToProcess(0, 0, 0, int(cells), name)
    threshold.SetLowerThreshold(value)
    threshold.SetUpperThreshold(value)
    geometry.SetInputConnection(threshold.GetOutputPort())
    return update(geometry).GetOutput()


def shape_of(part):
    """What stands for the part: its mesh, or the surface points of a trained model."""
    if part.IsA("vtkPolyData"):
        return part
    names = [part.GetMetaData(i).Get(part.NAME()) for i in range(part.GetNumberOfPartitionedDataSets())]
    if "Surface" not in names:
        raise Failure("the model has no surface to draw: give the CAD file, too")
    return part.GetPartition(names.index("Surface"), 0)


def angle_of(transform):
    """Degrees of a rotation, 16 components."""
    return math.degrees(math.acos(max(-1.0, min(1.0, (transform[0] + transform[5] + transform[10] - 1) / 2))))


def near_symmetries(samples):
    """Of each near-symmetry, best first, its angle in degrees, the share of the surface that fits, and how far the rest is off."""
    most = 0.0799 * field(samples, "Diameter")  # farther is not measured
    rows = zip(*(tuples(samples, name) for name in ("NearSymmetries", "NearSymmetryOverlap", "NearSymmetryDeviation")))
    return [(angle_of(row), overlap, f"{'more than' if deviation > most else 'up to'} {deviation:.2f} mm off")
            for row, (overlap,), (deviation,) in rows]


def symmetry_words(samples):
    """The symmetries that vtkMEAMSymmetryDetection found, as lines of text."""
    axes = tuples(samples, "SymmetriesContinuous")
    lines = ["any turn about any axis"] if len(axes) > 1 else [
        "any turn about the axis ({:.3f}, {:.3f}, {:.3f})".format(*axis) for axis in axes]
    turns = [f"{angle_of(row):.0f}" for row in tuples(samples, "SymmetriesDiscrete")]
    if turns:
        lines.append(f"{len(turns)} exact turn{'s' * (len(turns) > 1)}: {', '.join(turns)} degrees")
    near = near_symmetries(samples)
    while near:  # those that are as good as the first in one line
        _, overlap, off = near[0]
        alike = [angle for angle, share, other in near if share > overlap - AS_GOOD and other == off]
        near = [one for one in near if one[1] <= overlap - AS_GOOD or one[2] != off]
        degrees = sorted({f"{angle:.0f}" for angle in alike}, key=int)
        lines.append(f"nearly {', '.join(degrees)} degrees: {100 * overlap:.1f} % of the surface, the rest {off}")
    return lines or ["none"]


def symmetry_conclusion(samples):
    """What the symmetries mean for the poses that will be found, in a sentence or two."""
    axes, exact, near = tuples(samples, "SymmetriesContinuous"), tuples(samples, "SymmetriesDiscrete"), near_symmetries(samples)
    if len(axes) > 1:
        return "A ball: any rotation is as good as another."
    said = ["Round: any rotation about its axis is as good as another."] if axes else [
        f"The same in {len(exact) + 1} rotations: one pose stands for all of them."] if exact else []
    if near:
        _, overlap, off = near[0]
        alike = [max(1, round(angle)) for angle, share, _ in near if share > overlap - AS_GOOD]
        step = min(alike)
        regular = 360 % step == 0 and all(angle % step == 0 for angle in alike)
        often = "after half a turn" if step == 180 else f"every {step} degrees"
        said.append(f"{f'Nearly the same {often}' if regular else 'Nearly round'}: {100 * (1 - overlap):.0f} % of its surface "
                    f"differs, by {off.removesuffix(' off')}. Where that is hidden, the rotation is unsure.")
    return " ".join(said) or "No rotation of the whole part looks like another; where a plain side shows alone, one may."


def quaternion_of(transform):
    """x y z w of its rotation, w at least 0."""
    w_first = numpy.zeros(4)
    vtkMath.Matrix3x3ToQuaternion(transform[:3, :3].tolist(), w_first)
    return numpy.roll(w_first if w_first[0] >= 0 else -w_first, -1)


def print_poses(poses):
    """Prints poses as a table; with the number of the part, from 1, where there are several."""
    array = poses.GetPointData().GetArray
    part, likely = array("PartId"), array("PlaceProbability")
    is_known = likely.GetNumberOfTuples() > 0 and likely.GetRange()[1] > 0
    print(f"rank  {'part  ' if part else ''}score  likely  rotation  translation (mm)               quaternion (x y z w)                view  visible")
    for i in range(poses.GetNumberOfPoints()):
        t = array("Transform").GetTuple(i)
        q = array("Quaternion").GetTuple(i)
        number = f"{part.GetValue(i) + 1:4d}  " if part else ""
        print(f"{array('Rank').GetValue(i):4d}  {number}{array('Score').GetValue(i):.3f}  {f'{100 * likely.GetValue(i):4.0f} %' if is_known else '     -'}"
              f"  {100 * array('Certainty').GetValue(i):6.0f} %  {t[3]:9.3f} {t[7]:9.3f} {t[11]:9.3f}  {q[0]:8.5f} {q[1]:8.5f} {q[2]:8.5f} {q[3]:8.5f}"
              f"  {array('ViewId').GetValue(i):4d}  {100 * array('VisibleFraction').GetValue(i):5.0f} %")
    if poses.GetNumberOfPoints() == 0:
        print("      no part found")
    else:
        print("found: " + poses.GetFieldData().GetAbstractArray("Report").GetValue(0))


def print_scan_quality(poses):
    """Prints what vtkMEAMPoseEstimation measured of the sensor: nothing for a scan that is not organized."""
    report = poses.GetFieldData().GetAbstractArray("ScanReport")
    if report:
        print("scan: " + report.GetValue(0))
    advice = poses.GetFieldData().GetAbstractArray("Advice")
    if advice and advice.GetValue(0):
        print("advice: " + choices.worded(advice.GetValue(0)))
    if poses.GetFieldData().GetArray("EdgesFound"):
        print(f"edges: {100 * field(poses, 'EdgesFound'):.0f} % of a part's are found, "
              f"{100 * field(poses, 'EdgesByChance'):.0f} % anywhere")


def print_times(poses):
    """Prints the time of every stage of vtkMEAMPoseEstimation."""
    words = [re.sub("([a-z])([A-Z])", r"\1 \2", stage).lower() for stage in STAGES]
    print("time: " + ", ".join(f"{word} {field(poses, 'Seconds' + stage):.3f} s" for word, stage in zip(words, STAGES)))
