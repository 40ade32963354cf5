#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Finds the copies of a part in a scan: prints the poses, best first, and the time of every stage."""
import argparse

from ppfmeam import filters, picture, scripting


def options_of_user():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cad", metavar="PART", help="CAD file of the part: .stl, .obj or .ply, in mm")
    parser.add_argument("--cad-offset", nargs=3, type=float, default=(0, 0, 0), metavar=("X", "Y", "Z"),
                        help="added to the CAD's coordinates, in mm")
    parser.add_argument("--cad-scale", type=float, default=1, metavar="F", help="factor to mm: 1000 for a CAD in metres")
    parser.add_argument("--model", help="trained model of train.py, instead of training; --cad is then for the picture")
    scan = parser.add_mutually_exclusive_group(required=True)
    scan.add_argument("--scene", metavar="CLOUD", help="scan: .pcd, .ply, .stl or .obj, in mm")
    scan.add_argument("--depth", metavar="PNG", help="scan: a depth image of 16 bits, with --camera")
    parser.add_argument("--camera", metavar="FILE",
                        help="calibration of the sensor (OpenCV's YAML, XML or JSON, or a BOP camera.json): of the depth "
                             "image, or of a .ply scan, which it brings back onto its pixels")
    parser.add_argument("--depth-scale", type=float, default=0, metavar="F",
                        help="mm that 1 in the depth image stands for (default: depth_scale of the calibration, or 1)")
    parser.add_argument("--scene-scale", type=float, default=1, metavar="F", help="factor to mm, also of the boundary")
    parser.add_argument("--boundary", metavar="CLOUD", help="the scan's edge points, instead of those of its image")
    parser.add_argument("--image", metavar="FILE",
                        help="image of an organized scan that carries none: .png, .jpg, .bmp or .tif")
    parser.add_argument("--image-camera", metavar="FILE",
                        help="calibration of the camera beside the sensor that took the image (default: it is registered)")
    parser.add_argument("--poses", type=scripting.count, default=5, help="poses wanted; 0: all (default: %(default)s)")
    parser.add_argument("--threads", type=scripting.count, default=0, help="threads to work with; 0: all cores (default)")
    parser.add_argument("--method", choices=("meam",), default="meam", help="(default: %(default)s)")
    parser.add_argument("--preset", choices=("paper", "recommended"), default="recommended",
                        help="parameters of all steps (default: %(default)s)")
    parser.add_argument("--out", metavar="CSV", help="write the poses as BOP results")
    parser.add_argument("--json", help="write the poses as JSON")
    parser.add_argument("--matrices", metavar="TXT", help="write the poses as 4x4 matrices")
    parser.add_argument("--picture", metavar="PNG", help="write a picture of the scan with the part at each pose")
    options = parser.parse_args()
    if not options.cad and not options.model:
        parser.error("give the part: --cad, or --model of train.py")
    if options.depth and not options.camera:
        parser.error("a depth image needs its --camera")
    return options


def main():
    options = options_of_user()
    scripting.require_folder_of(options.out, options.json, options.matrices, options.picture)
    if options.picture:
        picture.require_display()
    mesh = scripting.read_mesh(options.cad, options.cad_offset, options.cad_scale) if options.cad else None
    part = scripting.read_model(options.model) if options.model else mesh
    if options.depth:
        scene = scripting.read_depth(options.depth, options.camera, options.depth_scale)
    else:
        scene = scripting.read_scan(options.scene, options.scene_scale, options.camera)

    estimation = filters.vtkMEAMPoseEstimation()
    estimation.SetInputDataObject(part)
    estimation.SetInputDataObject(1, scene)
    if options.boundary:
        estimation.SetInputDataObject(2, scripting.read(options.boundary, options.scene_scale))
    if options.image:
        estimation.SetInputDataObject(3, scripting.read_image(options.image))
        estimation.SetCameraFile(options.image_camera)
    scripting.set_choice(estimation, "Preset", options.preset)
    estimation.SetMaximumNumberOfPoses(options.poses)
    estimation.SetNumberOfThreads(options.threads)
    scripting.update(estimation)

    poses = estimation.GetOutput()
    scripting.print_poses(poses)
    scripting.print_times(poses)
    for path, form in ((options.out, "BOPCSV"), (options.json, "JSON"), (options.matrices, "Matrices")):
        if path:
            scripting.write_poses(poses, path, form)
    if options.picture:
        picture.save(options.picture, scene, poses, mesh or part)


scripting.run(main)
