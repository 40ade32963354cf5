# SPDX-License-Identifier: BSD-3-Clause
"""Every filter that has long work stops when it is asked to, reports no error, leaves nothing in its output and works
again."""
import json

from ppfmeam import filters
from meamtest import Errors, Folder, MovedView, Trained, bracket, check, concrete_classes, connect, is_empty, png, poses, run

# Their work takes milliseconds, whatever their input.
QUICK = {"vtkMEAMGraspWriter", "vtkMEAMHandEyeCalibration", "vtkMEAMImageReader", "vtkMEAMModelCalibration", "vtkMEAMModelReader", "vtkMEAMModelWriter",
         "vtkMEAMPoseEvaluation", "vtkMEAMPoseReader", "vtkMEAMPoseWriter", "vtkMEAMSamplePartSource"}
ROWS = [[(500,)] * 8] * 200  # a depth image
path = Folder()


def reader(kind, file):
    return connect(kind(), FileName=file)


def readers():
    """One of each, of files that take several steps."""
    depth = reader(filters.vtkMEAMDepthImageReader, png(path("depth.png"), ROWS, "uint16"))
    ply = reader(filters.vtkMEAMPLYReader, path("cloud.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                                                     "property float y\nproperty float z\nend_header\n0 0 500\n"))
    ply.SetImageSize(8, 200)
    for sensor in (depth, ply):
        sensor.SetFocalLength(100, 100)
    pcd = path("cloud.pcd", "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1000\nHEIGHT 200\n"
                            "POINTS 200000\nDATA ascii\n" + "1 2 3\n" * 200000)
    off = path("fan.off", "OFF\n100001 100000 0\n" + "0 0 1\n" * 100001 + "3 0 1 2\n" * 100000)
    png(path("bop/test/000001/depth/000000.png", b""), ROWS, "uint16")
    path("bop/test/000001/scene_camera.json",
         json.dumps({"0": {"cam_K": [100, 0, 4, 0, 100, 100, 0, 0, 1], "depth_scale": 1.0}}))
    return [depth, ply, reader(filters.vtkMEAMPCDReader, pcd), reader(filters.vtkMEAMXYZReader, path("cloud.xyz", "1 2 3\n" * 20000)),
            reader(filters.vtkMEAMMeshReader, off), reader(filters.vtkMEAMBOPReader, path("bop"))]


def steps():
    """Every step of a part, and of a scan of it."""
    trained = Trained(bracket())
    model = run(trained.model)
    scene = MovedView(trained)
    tangents = connect(filters.vtkMEAMTangentEstimation(), scene.edges, model)
    edges = run(tangents)
    true_pose, candidates = poses(scene.transform), poses(*[scene.transform] * 400)
    exact_views = connect(filters.vtkMEAMVisibilityExtraction(), trained.samples, trained.prepared)
    exact_views.SetMethodToMeshVisibility()
    exact_edges = connect(filters.vtkMEAMBoundaryExtraction(), exact_views, trained.prepared)
    exact_edges.SetMethodToMeshEdges()
    verification = connect(filters.vtkMEAMPoseVerification(), candidates, model, edges)
    diagnosis = connect(filters.vtkMEAMPoseDiagnosis(), model, scene.surface, scene.edges, None, true_pose)
    diagnosis.SetPlaceToRankedPose()
    grasps = connect(filters.vtkMEAMGraspDefinition(), trained.prepared, Propose=filters.vtkMEAMGraspDefinition.ParallelJaws)
    planning = connect(filters.vtkMEAMPickPlanning(), true_pose, trained.prepared, grasps, MaximumTilt=180)
    planning.SetBinToNone()  # some are possible, and tried
    return [
        trained.prepared, trained.samples, trained.views, trained.edges, trained.tangents, trained.symmetries,
        trained.model, connect(filters.vtkMEAMFeatureEdges(), trained.prepared), exact_views, exact_edges,
        connect(filters.vtkMEAMPoseEstimation(), trained.prepared, scene.surface, scene.edges),  # most of it is training
        diagnosis,
        tangents,
        connect(filters.vtkMEAMPoseDetection(), edges, model),
        connect(filters.vtkMEAMPoseScreening(), candidates, model, edges),
        verification,
        connect(filters.vtkMEAMPoseSelection(), candidates, model, edges),
        connect(filters.vtkMEAMPoseRefinement(), candidates, model, edges),
        connect(filters.vtkMEAMConflictResolution(), run(verification), model, edges, scene.surface),
        connect(filters.vtkMEAMPoseInstances(), candidates, trained.prepared),
        grasps, planning, connect(filters.vtkMEAMPickTrial(), planning, trained.prepared, true_pose),
    ]


def bins():
    """A bin, and what is done with a whole scan."""
    source = connect(filters.vtkMEAMBinSceneSource(), Copies=2, Width=160, Height=120)
    scan = run(source)
    truth, mesh = source.GetOutputDataObject(1), source.GetOutputDataObject(2)
    return [source, connect(filters.vtkMEAMSceneEdgeExtraction(), scan), connect(filters.vtkMEAMBackgroundRemoval(), scan),
            connect(filters.vtkMEAMBOPEvaluation(), truth, truth, mesh, scan)]


def check_stops(filter):
    name = filter.GetClassName()
    shares = []

    def watch(caller, event):
        shares.append(caller.GetProgress())

    def stop(caller, event):
        if caller.GetProgress() > 0:
            caller.AbortExecuteOn()

    check(not is_empty(run(filter)), f"{name} has an output")
    observer = filter.AddObserver("ProgressEvent", watch)
    filter.Modified()
    run(filter)
    filter.RemoveObserver(observer)
    check(shares == sorted(shares) and shares[0] >= 0 and shares[-1] == 1, f"{name} reports progress {shares}")

    observer = filter.AddObserver("ProgressEvent", stop)
    errors = Errors(filter)
    filter.Modified()
    filter.Update()
    check(is_empty(filter.GetOutputDataObject(0)), f"{name} was stopped but has an output")
    check(not errors.messages, f"{name} was stopped, that is no error: {errors}")
    filter.RemoveObserver(observer)
    filter.AbortExecuteOff()  # since VTK 9.2 the wish stands until it is taken back
    filter.Modified()
    check(not is_empty(run(filter)), f"{name} does not work again after it was stopped")


algorithms = [*readers(), *steps(), *bins()]
tried = {filter.GetClassName() for filter in algorithms}
classes = {kind.__name__ for kind in concrete_classes()}
check(classes == tried | QUICK and not tried & QUICK, f"neither stopped here nor quick, or both: {classes ^ tried ^ QUICK}")
for filter in algorithms:
    check_stops(filter)
