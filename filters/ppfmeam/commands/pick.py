# SPDX-License-Identifier: BSD-3-Clause
"""From a scan to picks: where jaws or a cup can take which part out of the bin, best first, and what is against the others."""
import argparse
import os
import shlex
import sys

import ppfmeam
from ppfmeam import api, asked, choices, inputs, picture, scripting

from ..report import notebook, page
from ..report.told import names_of, why_command


def length(words):
    """For argparse: NAME=MM."""
    name, _, value = words.partition("=")
    try:
        return name, float(value)
    except ValueError:
        raise argparse.ArgumentTypeError(f"it has to be NAME=MM, not {words}") from None


def add_gripper_options(parser):
    kind = parser.add_mutually_exclusive_group()
    kind.add_argument("--opening", type=float, default=60.0, metavar="MM", help="of the jaws (default: %(default)s)")
    kind.add_argument("--cup", type=float, metavar="MM", help="diameter of a suction cup, in place of the jaws")
    parser.add_argument("--gripper", type=length, nargs="+", default=[], metavar="NAME=MM",
                        help="other lengths of the gripper, such as finger_length=80, as ppfmeam.grasps() has them")


def gripper_of(options):
    """Jaws or cup, and its lengths by name."""
    known = choices.TABLE["gripper"]
    for name, _ in options.gripper:
        if name not in known:
            raise scripting.Failure(f"a gripper has no length {name}; it has {', '.join(known)}")
    main = {"opening": options.opening} if options.cup is None else {"cup_diameter": options.cup}
    return "jaws" if options.cup is None else "cup", {**main, **dict(options.gripper)}


def grasps_of(of, names, gripper, lengths):
    """Of each type of part."""
    kind = "suction" if gripper == "cup" else "parallel"
    sets = [ppfmeam.grasps(mesh, propose=kind, symmetries=model, **lengths) for mesh, model in zip(of.shapes(), of.models)]
    for name, found in zip(names, sets):
        if not len(found):
            raise scripting.Failure(f"no place of {name} is one for this gripper: give another --opening, or a smaller --cup")
    return sets


def print_picks(picks, names):
    """The best pick of each copy: where the gripper goes."""
    transforms = picks.transforms if picks.robot_transforms is None else picks.robot_transforms
    rows = [row for row in picks.best() if picks.possible[row]]
    if rows:
        print("pick  of rank  grasp          clearance  x, y, z (mm)                    quaternion (x y z w)")
    for k in rows:
        which = "" if len(names) == 1 else f"  {names[picks.parts[k]]}"
        x, y, z = transforms[k][:3, 3]
        turn = " ".join(f"{value:8.5f}" for value in scripting.quaternion_of(transforms[k]))
        print(f"{k + 1:4d}  {picks.instances[k] + 1:7d}  {picks.names[k]:13s}  {picks.clearances[k]:6.1f} mm  "
              f"{x:9.3f} {y:9.3f} {z:9.3f}  {turn}{which}")


def main():
    parser = scripting.Parser(description=__doc__)
    asked.add_options(parser, "time_limit")
    parser.set_defaults(poses=0, probability=0.5)  # all copies are in the way
    add_gripper_options(parser)
    choices.add_options(parser, "plan", "tilt", "covered", "margin")
    parser.add_argument("--no-bin", action="store_true", help="the parts lie in no bin: do not look for one")
    parser.add_argument("--robot-frame", metavar="FILE", help="the camera in the robot's frame, of OpenCV or ROS: picks are printed in it")
    parser.add_argument("--json", metavar="FILE", help="write all picks as JSON, with what is against those that are not possible")
    parser.add_argument("--picture", metavar="FILE", help="write a picture, PNG or JPEG, of the scan with the part at each pose")
    parser.add_argument("--report", metavar="HTML",
                        help="write a page for any browser, in one file: scan, parts and the gripper at the best pick of each in 3D")
    options = asked.parsed(parser, holds=True)
    if not options.cad or any(map(api.is_model, options.cad)):
        parser.error("give a trained model by --model, and its --cad: grasps are places on the faces of that")
    scripting.require_folder_of(options.json, options.picture, options.report)
    picture.require(options.picture)
    page.require(options.report)
    gripper, lengths = gripper_of(options)
    of, names = asked.Asked(options), names_of(options.parts)
    sets = grasps_of(of, names, gripper, lengths)
    found = ppfmeam.detect(of.models, of.scan, time_limit=options.time_limit, **of.inputs())
    no_bin = options.no_bin or not len(found)  # without a copy it matters to none
    picks = ppfmeam.pick(found, sets, of.scan, gripper=gripper, bin="none" if no_bin else "detected", robot_frame=options.robot_frame,
                         camera=of.beside["camera"], scale=options.scene_scale, **choices.of_options("plan", options).values)
    advice = picks.advice if len(found) else found.advice
    print(picks.report, advice)
    print_picks(picks, names)
    if options.json:
        scripting.write_json(options.json, {**picks.content(), "advice": advice, "parts": names})
    if options.picture:
        picture.save(options.picture, inputs.to_vtk(found.scan())[0], found.data, *picks.shapes())
    if options.report:
        again = shlex.join(["ppfmeam", "pick", *sys.argv[1:]]), why_command(options, options.scan, options.image, options.boundary)
        notebook.save(found, options.report, picks, (os.path.basename(options.scan), *again))
