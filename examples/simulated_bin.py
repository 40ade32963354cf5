#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The main job: finds the sample part in a simulated bin, from its CAD mesh, an organized scan and an image, and
compares the poses with the truth."""
import argparse
import os

from ppfmeam import choices, filters, picture, scripting

BUILD = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "build")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--copies", type=scripting.count, default=20, help="copies in the bin (default: %(default)s)")
    parser.add_argument("--seed", type=scripting.count, default=1, help="another seed, another bin (default: %(default)s)")
    choices.add_options(parser, "detect", "poses", "threads")
    scripting.add_method_options(parser)
    parser.add_argument("--picture", metavar="PNG", default=os.path.join(BUILD, "simulated_bin.png"),
                        help="the picture to write (default: %(default)s)")
    options = parser.parse_args()
    scripting.require_folder_of(options.picture)
    picture.require_display()

    scene = filters.vtkMEAMBinSceneSource()
    scene.SetCopies(options.copies)
    scene.SetSeed(options.seed)
    scripting.update(scene)
    scan, truth, mesh = (scene.GetOutputDataObject(port) for port in range(3))
    size = [0, 0, 0]
    scan.GetDimensions(size)
    print(f"a bin of {truth.GetNumberOfPoints()} copies, scanned with {size[0]} x {size[1]} points")

    estimation = filters.vtkMEAMPoseEstimation()
    estimation.SetInputConnection(scene.GetOutputPort(2))
    estimation.SetSceneConnection(scene.GetOutputPort(0))
    scripting.set_preset(estimation, options.preset)
    estimation.SetMaximumNumberOfPoses(options.poses)
    estimation.SetNumberOfThreads(options.threads)
    scripting.update(estimation)
    poses = estimation.GetOutput()
    scripting.print_poses(poses)
    scripting.print_times(poses)

    evaluation = filters.vtkMEAMPoseEvaluation()
    evaluation.SetInputConnection(estimation.GetOutputPort())
    evaluation.SetTrueConnection(scene.GetOutputPort(1))
    evaluation.SetPosesAskedFor(options.poses)
    table = scripting.update(evaluation).GetOutput()
    right = sum(table.GetColumnByName("Right").GetValue(i) for i in range(table.GetNumberOfRows()))
    print(f"against the truth: {right} of {table.GetNumberOfRows()} poses right, median error "
          f"{scripting.field(table, 'MedianTranslationError'):.3f} mm and "
          f"{scripting.field(table, 'MedianRotationError'):.3f} degrees")
    picture.save(options.picture, scan, poses, mesh)
    print(f"picture: {os.path.relpath(options.picture)}")


scripting.run(main)
