# SPDX-License-Identifier: BSD-3-Clause
"""The whole pipeline in ParaView, step by step: parts in a simulated bin. pipeline.pvsm is the state that it saves.

pvpython examples/paraview/pipeline.py [--picture found.png] [--state pipeline.pvsm]
"""
import argparse
from xml.etree import ElementTree

from paraview import servermanager
from paraview.simple import *  # noqa: F401,F403  as a trace of ParaView has it

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--picture", help="PNG file to write")
parser.add_argument("--state", help="state file to write, for File > Load State")
arguments = parser.parse_args()

# A scan; of your own, open a PCD or PLY file, a depth image or a BOP dataset instead.
bin = BinSceneSource(registrationName="Bin", Copies=8)
scan = OutputPort(bin, 0)

# The part, once: what can be seen of it from where, and which pairs its edge and surface points make.
mesh = MeshPreparation(registrationName="Mesh", Input=OutputPort(bin, 2))
samples = SurfaceSampling(registrationName="Samples", Input=mesh)
symmetries = SymmetryDetection(registrationName="Symmetries", Input=samples)
views = VisibilityExtraction(registrationName="Views", Input=samples)
edges = BoundaryExtraction(registrationName="Edges", Input=views)
tangents = TangentEstimation(registrationName="Tangents", Input=edges)
model = MEAMHashing(registrationName="Model", Input=tangents, Surface=symmetries)

# The scan: its edges, candidates, and what remains of them.
found_edges = SceneEdgeExtraction(registrationName="SceneEdges", Input=scan)
scene_edges = TangentEstimation(registrationName="SceneTangents", Input=found_edges, Model=model)
candidates = PoseDetection(registrationName="Candidates", Input=scene_edges, Model=model, SceneSurface=scan)
scene = {"Model": model, "SceneEdges": scene_edges, "SceneSurface": scan}
screened = PoseScreening(registrationName="Screened", Input=candidates, **scene)
verified = PoseVerification(registrationName="Verified", Input=screened, PointStride=2, **scene)
alternatives = PoseSelection(registrationName="Alternatives", Input=verified, Method="Alternatives", **scene)
refined = PoseRefinement(registrationName="Refined", Input=alternatives, **scene)
scored = PoseVerification(registrationName="Scored", Input=refined, **scene)
poses = PoseSelection(registrationName="Poses", Input=scored, MaximumNumberOfPoses=5, **scene)
parts = PoseInstances(registrationName="Parts", Input=poses, Mesh=mesh)

view = GetActiveViewOrCreate("RenderView")
Show(scan, view)
display = Show(parts, view)
display.SetScalarBarVisibility(view, True)
Render(view)
if arguments.picture:
    SaveScreenshot(arguments.picture, view, ImageResolution=[1200, 900])
if arguments.state:
    SaveState(arguments.state)
    state, session = ElementTree.parse(arguments.state), servermanager.ActiveConnection.Session
    for node in filter(lambda node: node.get("id"), state.iter("Proxy")):  # what differs from the defaults is enough
        proxy = session.GetRemoteObject(int(node.get("id")))
        for part in node.findall("Property"):
            if not part.get("number_of_elements") or proxy.GetProperty(part.get("name")).IsValueDefault():
                node.remove(part)
    for node in state.iter("Property"):
        for part in node.findall("Domain"):
            if part.find("Proxy") is None:
                node.remove(part)
    ElementTree.indent(state)
    state.write(arguments.state)
