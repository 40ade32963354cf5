# SPDX-License-Identifier: BSD-3-Clause
"""What a page says beside the poses, of the command `detect` and of ppfmeam.detect()."""
import os
import re
import shlex
import sys

import numpy

from .. import api, choices, filters, regions, scripting
from .content import parts_of


class Told:
    """`names` of the parts, and of the scan; `facts`, sentences of the scan; `seconds`, of each stage or "total"; `settings` that are
    not the defaults, by name; `command`, which finds the same again; `why`, a command with {x} {y} {z} for the place that was
    clicked; `reasons`, of each pose what speaks for it and against it."""

    def __init__(self, names, scan, facts, seconds, settings, command, why, reasons):
        self.names, self.facts, self.seconds, self.settings = names, facts, seconds, settings
        self.command, self.why, self.reasons = command, why, reasons
        self.title = " and ".join(dict.fromkeys(names)) + f" in {scan}"

    @classmethod
    def of_command(cls, options, poses, parts, data):
        """Of the options of `detect`, the poses, the parts and the scan, its edge points and its image."""
        scan, files = options.scene or options.depth, options.cad or options.model
        beside = [text for name in ("camera", "image", "image_camera", "boundary") if getattr(options, name)
                  for text in ("--" + name.replace("_", "-"), getattr(options, name))]
        beside += [text for name, scale in (("--scale", options.scene_scale), ("--cad-scale", options.cad_scale)) if scale != 1
                   for text in (name, str(scale))]
        why = shlex.join(["ppfmeam", "why", (options.model or options.cad)[0], scan, *beside]) + " --at {x} {y} {z}"
        if options.roi:
            beside += ["--roi", *options.roi]
        chosen = choices.of_options("detect", options)
        settings = {**chosen.differing(), **({"roi": " ".join(options.roi)} if options.roi else {})}
        return cls([os.path.basename(file) for file in files], os.path.basename(scan), facts(poses), stages(poses), settings,
                   shlex.join(["ppfmeam", "detect", *sys.argv[1:]]), why,
                   reasons(poses, parts, data, chosen, options))

    @classmethod
    def of_python(cls, found):
        """Of Detections."""
        call = {name: value for name, value in found.inputs.items() if name != "scan" and value not in (None, 1.0)}
        chosen = found.settings.differing()
        parts = [repr(model.file) if model.file else "model" for model in found.models]
        part = parts[0] if len(parts) == 1 else f"[{', '.join(parts)}]"
        scan = repr(str(found.inputs["scan"])) if is_file(found.inputs["scan"]) else "scan"
        words = "".join(f", {name}={str(value) if is_file(value) else value!r}" if is_file(value) or isinstance(value, (int, float, str))
                        else f", {name}={name}" for name, value in call.items())
        said, of = [""] * len(found), numpy.array(parts_of(found.data))
        for number, model in enumerate(found.models):
            places = numpy.flatnonzero(of == number)
            if len(places):
                for k, why in zip(places, api.why(model, pose=found.poses[places], **found.inputs, **found.settings.values)):
                    said[k] = sentences(why)
        return cls([model.name for model in found.models], os.path.basename(found.inputs["scan"]) if is_file(found.inputs["scan"]) else "a scan",
                   found.report.splitlines(), {"total": found.seconds}, chosen,
                   f"ppfmeam.detect({part}, {scan}{words}{''.join(f', {name}={value!r}' for name, value in chosen.items())})",
                   f"print(ppfmeam.why({parts[0]}, {scan}{words}, at=({{x}}, {{y}}, {{z}})))", said)


def sentences(why):
    """Of a Diagnosis; that a pose of the table was found goes without saying."""
    return "\n".join(filter(None, (why.verdict if why.lost_in else "", why.reasons, why.advice)))


def is_file(value):
    return isinstance(value, (str, os.PathLike))


def facts(found):
    """What vtkMEAMPoseEstimation says of the scan."""
    said = [found.GetFieldData().GetAbstractArray(name) for name in ("Report", "ScanReport")]
    return [line for text in said if text for line in text.GetValue(0).splitlines()]


def stages(found):
    """The time of each stage."""
    words = {stage: re.sub("([a-z])([A-Z])", r"\1 \2", stage).lower() for stage in scripting.STAGES}
    return {words[stage]: scripting.field(found, "Seconds" + stage) for stage in scripting.STAGES}


def reasons(poses, parts, data, chosen, options):
    """Of each pose what speaks for it and against it, which takes another detection of each part."""
    said, of = [""] * poses.GetNumberOfPoints(), numpy.array(parts_of(poses))
    scan, boundary, image = data
    box, mask = regions.of(options.roi)
    for number, part in enumerate(parts):
        places = numpy.flatnonzero(of == number)
        if not len(places):
            continue
        diagnosis = filters.vtkMEAMPoseDiagnosis()
        transforms = scripting.column(poses, "Transform", 4, 4)[places]
        for port, given in enumerate((part, regions.masked(scan, mask), boundary, image, scripting.poses_of(transforms))):
            diagnosis.SetInputDataObject(port, given)
        diagnosis.SetCameraFile(options.image_camera)
        diagnosis.SetRegion(*(box or regions.EVERYWHERE))
        chosen.set(diagnosis)
        diagnosis.SetPlaceToRankedPose()
        for rank, place in enumerate(places, 1):
            diagnosis.SetRankOfPose(rank)
            said[place] = sentences(api.diagnosed(diagnosis))
    return said
