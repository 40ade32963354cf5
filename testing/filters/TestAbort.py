# SPDX-License-Identifier: BSD-3-Clause
"""A filter that is asked to stop stops, reports no error, leaves nothing in its output and works again."""
import os
import tempfile

from vtkmodules.vtkCommonCore import VTK_UNSIGNED_SHORT

from ppfmeam.filters import (
    vtkMEAMBoundaryExtraction,
    vtkMEAMDepthImageReader,
    vtkMEAMFeatureEdges,
    vtkMEAMPLYReader,
    vtkMEAMPoseDetection,
    vtkMEAMPoseEstimation,
    vtkMEAMPoseRefinement,
    vtkMEAMPoseScreening,
    vtkMEAMPoseSelection,
    vtkMEAMPoseVerification,
    vtkMEAMTangentEstimation,
    vtkMEAMVisibilityExtraction,
)
from meamtest import Errors, MovedView, Trained, bracket, check, connect, is_empty, png, poses, run

trained = Trained(bracket())
model = run(trained.model)
scene = MovedView(trained)
tangents = connect(vtkMEAMTangentEstimation(), scene.edges, model)
edges = run(tangents)
candidates = poses(*[scene.transform] * 400)
exact_views = connect(vtkMEAMVisibilityExtraction(), trained.samples, trained.prepared)
exact_views.SetMethodToMeshVisibility()
exact_edges = connect(vtkMEAMBoundaryExtraction(), exact_views, trained.prepared)
exact_edges.SetMethodToMeshEdges()
folder = tempfile.TemporaryDirectory()
depth_reader, ply_reader = vtkMEAMDepthImageReader(), vtkMEAMPLYReader()
depth_reader.SetFileName(png(os.path.join(folder.name, "depth.png"), [[(500,)] * 8] * 200, VTK_UNSIGNED_SHORT))
ply_reader.SetFileName(os.path.join(folder.name, "cloud.ply"))
ply_reader.SetImageSize(8, 200)
with open(ply_reader.GetFileName(), "w") as file:
    file.write("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
               "0 0 500\n")
for reader in (depth_reader, ply_reader):
    reader.SetFocalLength(100, 100)
filters = [
    depth_reader, ply_reader,
    trained.prepared, trained.samples, trained.views, trained.edges, trained.tangents, trained.symmetries, trained.model,
    connect(vtkMEAMFeatureEdges(), trained.prepared), exact_views, exact_edges,
    connect(vtkMEAMPoseEstimation(), trained.prepared, scene.surface, scene.edges),  # most of it is training
    tangents,
    connect(vtkMEAMPoseDetection(), edges, model),
    connect(vtkMEAMPoseScreening(), candidates, model, edges),
    connect(vtkMEAMPoseVerification(), candidates, model, edges),
    connect(vtkMEAMPoseSelection(), candidates, model, edges),
    connect(vtkMEAMPoseRefinement(), candidates, model, edges),
]
for filter in filters:
    name = filter.GetClassName()
    shares = []

    def watch(caller, event):
        shares.append(caller.GetProgress())

    def stop(caller, event):
        if caller.GetProgress() > 0:
            caller.AbortExecuteOn()

    before = run(filter)
    check(not is_empty(before), f"{name} has an output")
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
