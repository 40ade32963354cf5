# SPDX-License-Identifier: BSD-3-Clause
"""choices.json against what has its choices: C++'s structs, the filters and their XML, Python's functions and
docs/parameters.md."""
import inspect
import os
import re
import xml.etree.ElementTree as ElementTree

import ppfmeam
from meamtest import check
from ppfmeam import _core, choices, filters
from ppfmeam.choices import TABLE

SOURCES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
# Of each group of the table the struct, the filters, their XML (file, proxy) and the function.
GROUPS = {
    "detect": (_core.DetectSettings, (filters.vtkMEAMPoseEstimation, filters.vtkMEAMPoseDiagnosis),
               (("Base", "Estimation"), ("Base", "Threads")), (ppfmeam.detect, ppfmeam.why)),
    "train": (_core.TrainSettings, (filters.vtkMEAMPoseEstimation,), (("Base", "Estimation"),), (ppfmeam.train,)),
    "read": (_core.CADSettings, (filters.vtkMEAMMeshReader,), (("MeshReader", "MEAMMeshReader"),),
             (ppfmeam.train, ppfmeam.detect, ppfmeam.why, ppfmeam.grasps)),
    "sensor": (_core.Sensor, (filters.vtkMEAMPoseEstimation, filters.vtkMEAMPoseDiagnosis), (("Base", "Sensor"),),
               (ppfmeam.detect, ppfmeam.why)),
    "gripper": (_core.GripperModel, (filters.vtkMEAMGraspDefinition, filters.vtkMEAMPickPlanning), (("Base", "Gripper"),),
                (ppfmeam.grasps, ppfmeam.pick)),
    "propose": (_core.ProposeSettings, (filters.vtkMEAMGraspDefinition,), (("GraspDefinition", "GraspDefinition"),),
                (ppfmeam.grasps,)),
    "plan": (_core.PlanSettings, (filters.vtkMEAMPickPlanning,), (("PickPlanning", "PickPlanning"),), (ppfmeam.pick,)),
}
LENGTHS_OF_GRIPPER_ONLY = {"mesh"}


def plain(text):
    return " ".join((text or "").split())


def cxx_value(choice):
    """The default as C++ and the filters have it; of what is not given zeros that do not count."""
    if choice["default"] is None:
        return [0.0] * 3
    if choice["type"] == "choice":
        return getattr(getattr(_core, choice["property"]), choice["values"][choice["default"]])
    return choice["default"]


def number(value):
    return [float(v) for v in value] if hasattr(value, "__len__") else [float(int(value) if not isinstance(value, float) else value)]


def check_xml(where, choice, element):
    check(plain(element.find("Documentation").text) == choice["help"], f"{where}: the help of the XML differs")
    default = [float(v) for v in element.get("default_values").split()]
    check(default == number(cxx_value(choice)), f"{where}: the XML's default is {default}")
    domain = next(e for e in element if e.tag.endswith("Domain"))
    tags = {"choice": "EnumerationDomain", "flag": "BooleanDomain", "integer": "IntRangeDomain"}
    check(domain.tag == tags.get(choice["type"], "DoubleRangeDomain"), f"{where}: {domain.tag}")
    if choice["type"] == "choice":
        entries = [(int(e.get("value")), e.get("text").replace(" ", "")) for e in domain]
        check(entries == [(int(getattr(getattr(_core, choice["property"]), name)), name) for name in choice["values"].values()],
              f"{where}: {entries}")
    for key, bound in (("minimum", "min"), ("maximum", "max")):
        if "above" not in choice:
            has = domain.get(bound)
            check((has is None) == (key not in choice) and (has is None or float(has) == choice[key]), f"{where}: {bound} {has}")


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


for group, (struct, kinds, places, functions) in GROUPS.items():
    fields = {name for name, member in vars(struct).items() if isinstance(member, property)} - LENGTHS_OF_GRIPPER_ONLY
    check(fields == {choice["field"] for choice in TABLE[group].values()}, f"{group}: C++ has {fields}")
    properties = {}
    for file, proxy in places:
        tree = ElementTree.parse(os.path.join(SOURCES, "xml", file + ".xml")).getroot()
        for element in tree.iter():
            if element.get("name") == proxy and element.tag in ("Proxy", "SourceProxy"):
                properties.update({e.get("name"): e for e in element if e.tag.endswith("VectorProperty")})
    for name, choice in TABLE[group].items():
        where = f"{group}.{name}"
        value = getattr(struct(), choice["field"])
        check(number(value) == number(cxx_value(choice)), f"{where}: C++ has {value}")
        check_xml(where, choice, properties[choice["property"]])
        for kind in kinds:
            check_filter(where, choice, kind)
        for function in functions:
            check(inspect.signature(function).parameters[name].default == choice["default"], f"{where}: {function.__name__}")
            check(choice["help"] in function.__doc__, f"{where}: help({function.__name__})")

# The table of one call.
with open(os.path.join(SOURCES, "docs", "parameters.md"), encoding="utf-8") as file:
    rows = re.findall(r"^\| `(\w+)` \| `(\w+)` \| `(\w+)` \| ([^|]+) \|", file.read(), re.MULTILINE)
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
print(f"{sum(map(len, TABLE.values()))} choices")
