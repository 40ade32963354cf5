# SPDX-License-Identifier: BSD-3-Clause
"""What a page says beside the poses, of the command `detect` and of ppfmeam.detect()."""
import os
import re
import shlex
import sys

from .. import api, asked, choices, filters, regions, scripting

SAME = ("CADOffset", "CADScale", "CameraFile", "Projection", "Region", "SensorPosition", "ViewDirection")  # and the choices


class Told:
    """`names` of the parts, and of the scan; `facts`, sentences of the scan; `advice`, what to change first; `seconds`, of each stage or
    "total"; `settings` that are not the defaults, by name; `command`, which finds the same again; `why`, a command with {x} {y} {z} for
    the place that was clicked; `reasons`, of each pose what speaks for it and against it; `diagnosis`, of a page that tells why a part was missed;
    `chosen`, the rank that is selected at first, 0 for none; `grippers`, of a page of picks each pose's rank, whether it can be picked, and the
    gripper at its best pick, vertices and triangles."""

    def __init__(self, names, scan, facts, advice, seconds, settings, command, why, reasons, diagnosis=None):
        self.names, self.facts, self.advice, self.seconds, self.settings = names, facts, advice, seconds, settings
        self.command, self.why, self.reasons = command, why, reasons
        self.title = title_of(names, scan)
        self.diagnosis, self.chosen = diagnosis, int(diagnosis is not None and diagnosis.pose is not None)
        self.grippers = []

    def add_picks(self, picks):
        """What a gripper can take: a page of picks says it of each pose first, and starts at the best pick."""
        self.advice = f"{picks.report} {picks.advice}".rstrip()
        for row in picks.best():
            pick = picks[row]
            said = f"Pick {row + 1}, {pick.name}: {pick.clearance:.1f} mm clearance." if pick.possible else f"No pick: {pick.reason}."
            self.reasons[pick.instance] = f"{said}\n{self.reasons[pick.instance]}"
            self.grippers.append((pick.instance + 1, pick.possible, *picks.gripper(row)))
        self.chosen = picks[0].instance + 1 if len(picks) and picks[0].possible else 0

    @classmethod
    def of_command(cls, options, poses, parts, data, image_camera):
        """Of the options of `detect`, the poses, the parts and the scan, its edge points and its image, and the calibration of that."""
        return cls(names_of(options.cad or options.model), os.path.basename(options.scan), facts(poses), advice(poses),
                   stages(poses), settings(options), shlex.join(["ppfmeam", "detect", *sys.argv[1:]]),
                   why_command(options, options.scan, options.image, options.boundary),
                   reasons(poses, parts, data, set_up_by(options, image_camera)))

    @classmethod
    def of_batch(cls, options, names, scan, files, poses, parts, data):
        """Of the options of `batch`, the names of the parts and of a scan, its file and its image's or nothing, the poses, the parts
        and the scan (scans.Scan)."""
        said = reasons(poses, parts, (data.scene, None, data.image), set_up_by(options, data.image_camera)) if options.why else None
        return cls(names, scan, facts(poses), advice(poses), stages(poses), settings(options),
                   shlex.join(["ppfmeam", "batch", *sys.argv[1:]]), why_command(options, *files) if files else "", said)

    @classmethod
    def of_evaluation(cls, options, names, image, found):
        """Of the options of `evaluate`, the names of the objects in an image, and the poses of each."""
        ours = [(name, poses) for name, poses in zip(names, found) if poses.GetFieldData().HasArray("SecondsTotal")]
        seconds = {name: scripting.field(poses, "SecondsTotal") for name, poses in ours} if len(ours) > 1 else \
            stages(ours[0][1]) if ours else {}
        return cls(names, image, list(dict.fromkeys(fact for _, poses in ours for fact in facts(poses))),
                   " ".join(dict.fromkeys(filter(None, (advice(poses) for _, poses in ours)))), seconds,
                   choices.of_options("detect", options).differing(), shlex.join(["ppfmeam", "evaluate", *sys.argv[1:]]), "", None)

    @classmethod
    def of_why(cls, options, inputs, diagnosis):
        """Of the options of `why`, the arguments of api.why() and what it returned."""
        given = choices.Chosen("detect", {name: value for name, value in inputs.items() if name in choices.TABLE["detect"]})
        command = shlex.join(["ppfmeam", "why", *sys.argv[1:]])
        return cls(names_of(options.parts), os.path.basename(options.scan), [], "", {}, given.differing(), command, "",
                   [sentences(diagnosis)] * (diagnosis.pose is not None), diagnosis)

    @classmethod
    def of_filter(cls, found, scan, poses, parts, data):
        """Of a vtkMEAMPoseEstimation, the name of the scan, the poses, the parts and the scan, its edge points and its image."""
        def chosen(choice):
            value = getattr(found, "Get" + choice["property"])()
            return list(choice["values"])[value] if choice["type"] == "choice" else value

        def set_up(diagnosis):
            for property in (*SAME, *(choice["property"] for choice in choices.TABLE["detect"].values())):
                getattr(diagnosis, "Set" + property)(getattr(found, "Get" + property)())

        settings = choices.Chosen("detect", {name: chosen(choice) for name, choice in choices.TABLE["detect"].items()}).differing()
        names = poses.GetFieldData().GetAbstractArray("PartName")
        names = [names.GetValue(k) for k in range(names.GetNumberOfValues())]
        return cls(names, scan, facts(poses), advice(poses), stages(poses), settings, "MEAM Pose Estimation, in ParaView", "",
                   reasons(poses, parts, data, set_up))

    @classmethod
    def of_python(cls, found):
        """Of Detections."""
        call = {name: value for name, value in {**found.inputs, **found.of_cad}.items() if name != "scan" and is_given(value)}
        chosen = found.settings.differing()
        parts = [repr(model.file) if model.file else "model" for model in found.models]
        part = parts[0] if len(parts) == 1 else f"[{', '.join(parts)}]"
        scan = found.inputs["scan"]
        name, scan = os.path.basename(scan) if is_file(scan) else "a scan", written(scan) or "scan"
        words = "".join(f", {name}={written(value) or name}" for name, value in call.items())
        said = [sentences(why) for why in api.why(found.models, pose=found.data, **found.inputs, **found.settings.values)]
        choices_made = "".join(f", {choice}={value!r}" for choice, value in chosen.items())
        return cls([model.name for model in found.models], name, found.report.splitlines(), found.advice, {"total": found.seconds}, chosen,
                   f"ppfmeam.detect({part}, {scan}{words}{choices_made})", f"print(ppfmeam.why({part}, {scan}{words}{choices_made}, at=({{x}}, {{y}}, {{z}})))", said)


def title_of(names, scan):
    return " and ".join(dict.fromkeys(names)) + f" in {scan}"


def is_given(value):
    """Whether it is no default, None or a scale of 1; arrays are given."""
    return value is not None and not (isinstance(value, (int, float)) and value == 1)


def names_of(parts):
    """Of the parts of `why`: files, or numbers of objects."""
    return [f"object {part}" if part.isdecimal() else name for part, name in zip(parts, scripting.part_names(parts))]


def sentences(why):
    """Of a Diagnosis, and behind an empty line all that speaks for it and against it; that a pose of the table was found goes without
    saying."""
    brief = "\n".join(filter(None, (why.verdict if why.lost_in else "", why.main_reason, why.advice)))
    return "\n\n".join(filter(None, (brief, why.reasons)))


def written(value):
    """An argument as Python's source has it; empty for what cannot be written, such as an array."""
    if is_file(value):
        return repr(os.fspath(value))
    return repr(value) if isinstance(value, (int, float, tuple, list)) else ""


def is_file(value):
    return isinstance(value, (str, os.PathLike))


def facts(found):
    """What vtkMEAMPoseEstimation says of the scan."""
    return [line for name in ("Report", "ScanReport") for line in text_of(found, name).splitlines()]


def advice(found):
    """What vtkMEAMPoseEstimation would change first."""
    return text_of(found, "Advice")


def text_of(found, name):
    text = found.GetFieldData().GetAbstractArray(name)
    return choices.worded(text.GetValue(0)) if text else ""


def settings(options):
    """What differs from the defaults, by name."""
    given = {name: getattr(options, name) for name in ("roi", "viewpoint")}
    return {**choices.of_options("detect", options).differing(),
            **{name: " ".join(map(str, values)) for name, values in given.items() if values}}


def why_command(options, scan, image=None, boundary=None):
    """That of `why` for a scan, with {x} {y} {z} for the place; empty where the options name no part."""
    image = image if getattr(options, "image_edges", True) else None  # it is then of the page alone
    beside = {"camera": options.camera, "image": image, "image-camera": image and options.image_camera, "boundary": boundary,
              "scale": options.scene_scale, "cad-scale": None if options.model else options.cad_scale}
    words = [text for name, value in beside.items() if value not in (None, "", 1) for text in ("--" + name, str(value))]
    words += ["--solid", str(options.solid)] if options.solid and not options.model else []
    if options.depth_scale and scan.lower().endswith(scripting.DEPTH_IMAGES):
        words += ["--depth-scale", str(options.depth_scale)]
    offset = None if options.model else getattr(options, "cad_offset", None)  # batch has none
    for name, values in (("--roi", options.roi), ("--viewpoint", options.viewpoint), ("--cad-offset", offset and any(offset) and offset)):
        words += [name, *map(str, values)] if values else []
    words += choices.words_of("detect", {name: value for name, value in choices.of_options("detect", options).differing().items()
                                         if name in asked.OF_SEARCH})
    parts = options.model or options.cad or list(map(str, getattr(options, "objects", None) or ()))
    named = [parts[0], scan] if len(parts) == 1 else [scan, *(word for part in parts for word in ("--model" if options.model else "--cad", part))]
    return shlex.join(["ppfmeam", "why", *named, *words]) + " --at {x} {y} {z}" if parts else ""


def stages(found):
    """The time of each stage."""
    words = {stage: re.sub("([a-z])([A-Z])", r"\1 \2", stage).lower() for stage in scripting.STAGES}
    return {words[stage]: scripting.field(found, "Seconds" + stage) for stage in scripting.STAGES}


def set_up_by(options, image_camera):
    """Sets a vtkMEAMPoseDiagnosis by the options of a command."""
    box, mask = regions.of(options.roi)

    def set_up(diagnosis):
        diagnosis.SetCameraFile(image_camera if diagnosis.GetInputDataObject(3, 0) else None)
        diagnosis.SetRegion(*(box or regions.EVERYWHERE))
        diagnosis.SetInputDataObject(1, regions.masked(diagnosis.GetInputDataObject(1, 0), mask))
        choices.of_options("detect", options).set(diagnosis)
        scripting.set_viewpoint(diagnosis, options.viewpoint, options.scene_scale)
    return set_up


def reasons(poses, parts, data, set_up):
    """Of each pose what speaks for it and against it, which takes another detection of each part; `data`: the scan, its edge points
    and its image; `set_up` sets the properties of the vtkMEAMPoseDiagnosis that has them."""
    diagnosis, said = filters.vtkMEAMPoseDiagnosis(), []
    for part in parts:
        diagnosis.AddInputDataObject(0, part)
    for port, given in enumerate((*data, poses), 1):
        diagnosis.SetInputDataObject(port, given)
    set_up(diagnosis)
    diagnosis.SetPlaceToRankedPose()
    for rank in range(1, poses.GetNumberOfPoints() + 1):
        diagnosis.SetRankOfPose(rank)
        said.append(sentences(api.diagnosed(diagnosis)))
    return said
