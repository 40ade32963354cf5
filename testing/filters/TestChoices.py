# SPDX-License-Identifier: BSD-3-Clause
"""choices.json against what has its choices: C++'s structs, the filters, Python's functions and docs/parameters.md. (Their XML is
made from it, and TestProxies compares that with the filters.)"""
import inspect
import os
import re

import ppfmeam
from meamtest import check, read
from ppfmeam import _core, choices, filters
from ppfmeam.choices import TABLE

SOURCES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
# Of each group of the table the struct, the filters and the functions.
GROUPS = {
    "detect": (_core.DetectSettings, (filters.vtkMEAMPoseEstimation, filters.vtkMEAMPoseDiagnosis), (ppfmeam.detect, ppfmeam.why)),
    "train": (_core.TrainSettings, (filters.vtkMEAMPoseEstimation,), (ppfmeam.train,)),
    "read": (_core.CADSettings, (filters.vtkMEAMMeshReader,), (ppfmeam.train, ppfmeam.detect, ppfmeam.why, ppfmeam.grasps)),
    "sensor": (_core.Sensor, (filters.vtkMEAMPoseEstimation, filters.vtkMEAMPoseDiagnosis), (ppfmeam.detect, ppfmeam.why)),
    "gripper": (_core.GripperModel, (filters.vtkMEAMGraspDefinition, filters.vtkMEAMPickPlanning), (ppfmeam.grasps, ppfmeam.pick)),
    "propose": (_core.ProposeSettings, (filters.vtkMEAMGraspDefinition,), (ppfmeam.grasps,)),
    "plan": (_core.PlanSettings, (filters.vtkMEAMPickPlanning,), (ppfmeam.pick,)),
}
LENGTHS_OF_GRIPPER_ONLY = {"mesh"}


def cxx_value(choice):
    """The default as C++ and the filters have it; of what is not given zeros that do not count."""
    if choice["default"] is None:
        return [0.0] * 3
    if choice["type"] == "choice":
        return getattr(getattr(_core, choice["property"]), choice["values"][choice["default"]])
    return choice["default"]


def number(value):
    return [float(v) for v in value] if hasattr(value, "__len__") else [float(int(value) if not isinstance(value, float) else value)]


def check_filter(where, choice, kind):
    filter = kind()
    getter, setter = (getattr(filter, word + choice["property"]) for word in ("Get", "Set"))
    check(number(getter()) == number(cxx_value(choice)), f"{where}: {kind.__name__} has {getter()}")
    if choice["type"] == "choice":
        for name in choice["values"].values():
            getattr(filter, f"Set{choice['property']}To{name}")()
            check(getter() == int(getattr(getattr(_core, choice["property"]), name)), f"{where}: {name}")
    elif choice["type"] != "vector":
        other = not choice["default"] if choice["type"] == "flag" else choice.get("maximum", choice["default"] + 1)
        setter(other)
        check(getter() == other, f"{where}: {kind.__name__} does not take {other}")


for group, (struct, kinds, functions) in GROUPS.items():
    fields = {name for name, member in vars(struct).items() if isinstance(member, property)} - LENGTHS_OF_GRIPPER_ONLY
    check(fields == {choice["field"] for choice in TABLE[group].values()}, f"{group}: C++ has {fields}")
    for name, choice in TABLE[group].items():
        where = f"{group}.{name}"
        value = getattr(struct(), choice["field"])
        check(number(value) == number(cxx_value(choice)), f"{where}: C++ has {value}")
        if choice["type"] == "choice":  # which the XML counts
            values = [int(getattr(getattr(_core, choice["property"]), value)) for value in choice["values"].values()]
            check(values == list(range(len(values))), f"{where}: C++ has {values}")
        for kind in kinds:
            check_filter(where, choice, kind)
        for function in functions:
            check(inspect.signature(function).parameters[name].default == choice["default"], f"{where}: {function.__name__}")
            check(choice["help"] in function.__doc__, f"{where}: help({function.__name__})")

# The table of one call.
rows = re.findall(r"^\| `(\w+)` \| `(\w+)` \| `(\w+)` \| ([^|]+) \|", read(os.path.join(SOURCES, "docs", "parameters.md")), re.MULTILINE)
words = {True: "on", False: "off"}
check({row[1]: row for row in rows} == {
    name: (choice["property"], name, choice["field"],
           choice["values"][choice["default"]] if choice["type"] == "choice" else
           words[choice["default"]] if choice["type"] == "flag" else f"{choice['default']:g}")
    for name, choice in TABLE["detect"].items()}, f"docs/parameters.md: {rows}")

# What the library says names properties: Python and the commands have other names for them.
said = "Raise MaximumNumberOfPoses; RotationCounts keeps these back; let the surface vote (Features: Both); switch on DepthEdges."
check(choices.worded(said) == "Raise poses; rotation_counts keeps these back; let the surface vote (features='both'); switch on depth_edges.",
      choices.worded(said))
scaled = "Scale the scene (Scale of its reader), or the part (CADScale)."
check(str(ppfmeam.Error(scaled)) == "Scale the scene (scale), or the part (cad_scale).", "errors name arguments")
choices.is_command = True
check(str(ppfmeam.Error(scaled)) == "Scale the scene (--scene-scale), or the part (--cad-scale).", "errors name options")
check(choices.worded("cannot read /data/CADScale/Seed.stl") == "cannot read /data/CADScale/Seed.stl", "names of files stay")
check(choices.worded(said) == "Raise --poses; --rotation-counts keeps these back; let the surface vote (--features both); switch on DepthEdges.",
      choices.worded(said))
choices.is_command = False

# What is out of range is one sentence that names the argument.
for group, function, arguments in (("detect", ppfmeam.detect, (None, None)), ("train", ppfmeam.train, (None,)), ("read", ppfmeam.train, (None,)),
                                   ("plan", ppfmeam.pick, (None, None)), ("propose", ppfmeam.grasps, (None,))):
    for name, choice in TABLE[group].items():
        wrong = [None, "many", float("nan")] + [choice[key] + change for key, change in
                                                (("minimum", -1), ("maximum", 1), ("above", 0)) if key in choice]
        for value in wrong:
            try:
                function(*arguments, **{name: value})
            except ppfmeam.Error as error:
                check(str(error).startswith(f"{name} has to be ") and str(error).endswith(f", not {value!r}"), f"{error}")
            else:
                check(False, f"{group}.{name} takes {value!r}")
# What the single filters set at once, one after the other; the number of threads stays.
SETS = {
    filters.vtkMEAMHashing: {
        "Paper": {"Feature": 0, "AngleStep": 3.6, "ViewMerging": 1, "VoxelSize": 1.0, "CoVisibilityDirections": 0},
        "Recommended": {"Feature": 1, "ViewMerging": 0}},
    filters.vtkMEAMTangentEstimation: {"Paper": {"Method": 0, "LeafSize": 1.0}, "Recommended": {"Method": 1, "LeafSize": 0.0}},
    filters.vtkMEAMPoseDetection: {"Paper": {"ReferenceShare": 0.2, "ReferredShare": 0.2}},
    filters.vtkMEAMPoseVerification: {"Paper": {"Method": 0, "Tolerance": 1.5, "PosesPerView": 20}, "Votes": {"Method": 2, "PosesPerView": 0},
                                      "Candidates": {"Method": 1, "PointStride": 2}},
    filters.vtkMEAMPoseSelection: {"Paper": {"Method": 0}, "Votes": {"Method": 0, "MaximumNumberOfPoses": 30},
                                   "Candidates": {"Method": 1, "MaximumNumberOfPoses": 0}},
    filters.vtkMEAMPoseRefinement: {"Paper": {"Method": 0}, "Recommended": {"Method": 1}},
    filters.vtkMEAMSceneEdgeExtraction: {
        "Paper": {"ImageEdges": True, "DepthEdges": False, "Creases": False, "ImageTangents": False},
        "Recommended": {"DepthEdges": True, "Creases": True, "ImageTangents": True}},
}
for kind, sets in SETS.items():
    filter = kind()
    for name, values in sets.items():
        if hasattr(filter, "SetNumberOfThreads"):
            filter.SetNumberOfThreads(2)
            values["NumberOfThreads"] = 2
        getattr(filter, "SetParametersTo" + name)()
        found = {key: getattr(filter, "Get" + key)() for key in values}
        check(found == values, f"{kind.__name__}, {name}: {found}")
print(f"{sum(map(len, TABLE.values()))} choices")
