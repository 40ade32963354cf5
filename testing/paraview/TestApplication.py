# SPDX-License-Identifier: BSD-3-Clause
"""Inside the ParaView application: the chain is built from the proxies of the menu, shown, its steps are coloured by what
they found, and the picture holds the found parts in the colours of their ranks."""
import os
import sys
import tempfile
import traceback


def build_and_show():
    from paraview import simple

    simple._DisableFirstRenderCameraReset()
    scene = simple.BinSceneSource(Copies=8, Width=640, Height=480)
    mesh = simple.MeshPreparation(Input=simple.OutputPort(scene, 2))
    samples = simple.SurfaceSampling(Input=mesh)
    views = simple.VisibilityExtraction(Input=samples)
    boundary = simple.BoundaryExtraction(Input=views)
    tangents = simple.TangentEstimation(Input=boundary)
    symmetries = simple.SymmetryDetection(Input=samples)
    model = simple.MEAMHashing(Input=tangents, Surface=symmetries)
    edges = simple.SceneEdgeExtraction(Input=simple.OutputPort(scene, 0))
    edges = simple.TangentEstimation(Input=simple.OutputPort(edges, 0), Model=model)
    candidates = simple.PoseDetection(Input=edges, Model=model, SceneSurface=simple.OutputPort(scene, 0))
    scan = simple.OutputPort(scene, 0)
    scene = {"Model": model, "SceneEdges": edges, "SceneSurface": scan}
    screened = simple.PoseScreening(Input=candidates, **scene)
    verified = simple.PoseVerification(Input=screened, PointStride=2, **scene)
    alternatives = simple.PoseSelection(Input=verified, Method="Alternatives", **scene)
    refined = simple.PoseRefinement(Input=alternatives, **scene)
    scored = simple.PoseVerification(Input=refined, **scene)
    ranked = simple.PoseSelection(Input=scored, MaximumNumberOfPoses=0, **scene)
    chain = simple.PoseInstances(Input=ranked, Mesh=mesh, MaximumNumberOfInstances=5)
    box = simple.MEAMPoseEstimation(Input=mesh, Scene=scan, MaximumNumberOfPoses=0)  # of a few it need not look for all

    view = simple.GetActiveViewOrCreate("RenderView")
    exact = simple.BoundaryExtraction(Input=views, Mesh=mesh, Method="Mesh Edges")
    whole = simple.BoundaryExtraction(Input=simple.VisibilityExtraction(Input=samples, NumberOfViewpoints=0))
    for step, array in ((symmetries, "Deviation"), (simple.MEAMFeatureEdges(Input=mesh), "EdgeType"),
                        (boundary, "EdgeType"), (exact, "EdgeType"), (whole, "EdgeType"), (tangents, "EdgeType")):
        colours = list(simple.Show(step, view).ColorArrayName)
        assert colours == ["POINTS", array], f"{step} is coloured by {colours}"
        simple.Hide(step, view)
    simple.Show(scan, view)  # grey: the only colours are those of the ranks
    simple.Show(chain, view)
    simple.GetActiveCamera().Dolly(1.6)  # the bin fills the view
    simple.Render(view)
    picture = os.path.join(tempfile.mkdtemp(), "found.png")
    simple.SaveScreenshot(picture, view, ImageResolution=[800, 600])

    of_chain = ranked.GetClientSideObject().GetOutputDataObject(0).GetPointData().GetArray("Transform")
    box.UpdatePipeline()
    of_box = box.GetClientSideObject().GetOutputDataObject(0).GetPointData().GetArray("Transform")
    assert of_chain.GetNumberOfTuples() == of_box.GetNumberOfTuples() >= 5, f"{of_chain.GetNumberOfTuples()} poses"
    for pose in range(5):
        assert of_chain.GetTuple(pose) == of_box.GetTuple(pose), f"pose {pose + 1} of the chain is not that of the box"
    return picture


def share_of(picture, colour):
    """Share of the pixels whose hue is that of the colour."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOImage import vtkPNGReader

    reader = vtkPNGReader()
    reader.SetFileName(picture)
    reader.Update()
    pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())[:, :3].astype(float)
    level = pixels.max(axis=1)
    spread = level - pixels.min(axis=1)
    wanted = [c / max(colour) for c in colour]
    near = sum(abs(pixels[:, c] / level.clip(1) - wanted[c]) for c in range(3)) < 0.35
    return (near & (spread > 40)).mean()


status = 1
try:
    found = build_and_show()
    for name, colour in (("red", (255, 30, 30)), ("green", (40, 170, 50)), ("blue", (40, 90, 220))):
        share = share_of(found, colour)
        print(f"{name}: {100 * share:.2f} % of {found}", file=sys.__stderr__)
        assert share > 0.005, f"no {name} part in {found}"
    status = 0
except BaseException:
    traceback.print_exc(file=sys.__stderr__)
sys.__stderr__.flush()
os._exit(status)
