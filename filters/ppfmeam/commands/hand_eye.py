# SPDX-License-Identifier: BSD-3-Clause
"""Finds where the camera is for the robot (hand-eye calibration, OpenCV) from pairs of poses: of the gripper, as the robot
tells it, and of a target, or a part, as the camera sees it at the same moment."""
import argparse

from .. import choices, filters, scripting


def main():
    parser = scripting.Parser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
        epilog="""The pairs, as JSON:
  {"mount": "beside", "units": "mm", "pairs": [{"T_base_gripper": [[4x4]], "T_camera_target": [[4x4]]}, ...]}
or as a table, CSV, with 32 numbers in a row: T_base_gripper and T_camera_target, mm, each row by row.
Twenty pairs, with the gripper turned by 30 degrees and more about several axes.""")
    parser.add_argument("pairs", metavar="FILE", help="pairs of poses, .json or .csv")
    parser.add_argument("--camera", choices=("beside", "hand"),
                        help="beside the robot, which holds the target, or on its hand, with the target at rest (default: as "
                             "the file says, or else beside)")
    parser.add_argument("--out", metavar="FILE",
                        help="write T_robot_camera: .json in mm, or .yaml, a transform of ROS in metres")
    parser.add_argument("--json", metavar="FILE", help="write what is printed as JSON, mm and degrees")
    parser.add_argument("--limit", type=choices.factor, metavar="MM", help="fail when the residual is larger than this")
    options = parser.parse_args()

    scripting.require_file(options.pairs)
    scripting.require_folder_of(options.out, options.json)
    calibration = filters.vtkMEAMHandEyeCalibration()
    calibration.SetFileName(options.pairs)
    if options.camera:
        scripting.set_choice(calibration, "Mount", options.camera)
    found = scripting.update(calibration).GetOutput()
    matrix = [found.GetPointData().GetArray("Transform").GetComponent(0, k) for k in range(16)]
    on_hand = found.GetFieldData().GetAbstractArray("CameraMount").GetValue(0) == "hand"
    print("T_robot_camera (mm), to the robot's", "gripper:" if on_hand else "base:")
    for row in range(4):
        print("  " + " ".join(f"{value:12.6f}" for value in matrix[4 * row:4 * row + 4]))
    table = calibration.GetOutputDataObject(1)
    pairs = [[table.GetValue(row, column).ToDouble() for column in range(3)] for row in range(table.GetNumberOfRows())]
    for pair, shift, turn in pairs:
        print(f"pair {pair:3.0f}: {shift:8.3f} mm {turn:8.3f} degrees")
    report = found.GetFieldData().GetAbstractArray("Report").GetValue(0)
    print(report)
    if options.json:
        scripting.write_json(options.json, {
            "mount": "hand" if on_hand else "beside", "T_robot_camera": [matrix[4 * row:4 * row + 4] for row in range(4)], "report": report,
            "pairs": [{"pair": int(pair), "mm": shift, "degrees": turn} for pair, shift, turn in pairs]})
    residual = scripting.field(found, "ResidualShift")
    if options.limit is not None and residual > options.limit:
        raise scripting.Failure(f"the residual of {residual:.2f} mm is larger than {options.limit:g} mm: leave out pairs that stand out, "
                    "check that the camera is " + ("on the hand" if on_hand else "beside the robot"))
    if options.out:
        scripting.update(calibration, "WriteRobotFrame", options.out)
