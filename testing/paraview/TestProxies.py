# SPDX-License-Identifier: BSD-3-Clause
"""Every proxy of the plugin can be created and documents itself, and its XML defaults are the C++ defaults.

Runs under pvpython with the plugin loaded; the arguments are the plugin's XML files.
"""
import importlib
import re
import sys
import xml.etree.ElementTree as ElementTree

from paraview import servermanager
from paraview.simple import *  # noqa: F401,F403  connects, loads the plugin
import ppfmeam.filters

failures = []
compared = 0
# What has no default to compare, by the class or the command of its property.
WITHOUT_DEFAULT = {
    "vtkSMInputProperty": "an input",
    "vtkSMProperty": "a button",
    "SetInputArrayToProcess": "an array selection",
}
MANY = 6  # properties of a filter, which have to be in groups


def check(condition, message):
    if not condition:
        failures.append(message)


def as_list(value):
    if value is None or value == "":
        return []
    return list(value) if isinstance(value, (tuple, list)) else [value]


def same(xml, cxx):
    if len(xml) != len(cxx):
        return False
    return all(a == b if isinstance(b, str) else abs(float(a) - float(b)) <= 1e-6 * max(1, abs(float(b)))
               for a, b in zip(xml, cxx))


def check_property(name, key, prop, instance):
    """One property of the proxy against the object's Get method."""
    global compared
    where = f"{name}.{key}"
    check(re.fullmatch(r"[A-Z][A-Za-z0-9]*", key), f"{where}: not CamelCase")
    documentation = prop.GetDocumentation()
    check(documentation is not None and (documentation.GetDescription() or "").strip(), f"{where}: no documentation")
    command = prop.GetCommand() or ""
    if prop.GetClassName() in WITHOUT_DEFAULT or command in WITHOUT_DEFAULT or prop.GetInformationOnly():
        return
    if not command and prop.GetPanelWidget() == "meam_suggestion":  # the panel's alone
        return
    domains = prop.NewDomainIterator()
    domains.Begin()
    check(not domains.IsAtEnd() or prop.GetClassName() == "vtkSMStringVectorProperty", f"{where}: no domain")  # any text
    if not hasattr(prop, "GetElement") or not command.startswith("Set"):
        failures.append(f"{where}: a {prop.GetClassName()} with the command {command} cannot be compared")
        return
    getter = getattr(instance, "Get" + command[3:], None)
    if getter is None:
        failures.append(f"{where}: the class has no Get{command[3:]}")
        return
    compared += 1
    xml = [v for v in (prop.GetElement(i) for i in range(prop.GetNumberOfElements())) if v not in (None, "")]
    cxx = as_list(getter())
    check(same(xml, cxx), f"{where}: XML default {xml}, C++ default {cxx}")


def check_proxy(group, element):
    name, class_name = element.get("name"), element.get("class")
    proxy = manager.NewProxy(group, name)
    if proxy is None:
        failures.append(f"{name}: cannot be created")
        return
    proxy.UpdateVTKObjects()
    made = proxy.GetClientSideObject()
    module, _, python_class = class_name.rpartition(".")  # a class in Python has its module's name before it
    if made is None or made.GetClassName() != ("vtkPythonAlgorithm" if module else class_name):
        failures.append(f"{name}: made {made and made.GetClassName()} instead of {class_name}")
        return
    documentation = element.find("Documentation")
    check(documentation is not None and (documentation.text or "").strip() and documentation.get("short_help")
          and documentation.get("long_help"), f"{name}: no documentation, short_help or long_help")
    if group in ("filters", "sources"):
        check(element.find("Hints/ReaderFactory") is not None
              or (element.find("Hints/ShowInMenu") is not None and (group, name) in in_menus),
              f"{name}: not in the menu Pose Estimation")
    instance = getattr(importlib.import_module(module or "ppfmeam.filters"), python_class)()
    keys = proxy.NewPropertyIterator()
    keys.Begin()
    found, commands = set(), set()
    while not keys.IsAtEnd():
        found.add(keys.GetKey())
        commands.add(keys.GetProperty().GetCommand())
        check_property(name, keys.GetKey(), keys.GetProperty(), instance)
        keys.Next()
    declared = {p.get("name") for p in element if p.tag.endswith("Property")}
    if len([p for p in element if p.tag.endswith("VectorProperty")]) >= MANY or name.startswith("BinScene"):
        check(proxy.GetNumberOfPropertyGroups() >= 2 or group == "writers", f"{name}: its properties are in no groups")
    check(declared <= found, f"{name}: not made: {declared - found}")
    # And the other way round: what can be set on an instance of ours can be set in the panel, or is set by ParaView.
    if group == "writers":
        commands |= {"SetNumberOfPieces", "SetPiece"}
    ours = {m for kind in type(instance).__mro__ if kind.__name__.startswith("vtkMEAM") for m in vars(kind)}
    for setter in sorted(m for m in ours if m.startswith("Set") and "Get" + m[3:] in ours):
        check(setter in commands, f"{name}: no property for {setter}")


def is_abstract(kind):
    try:
        kind()
    except (TypeError, NotImplementedError):
        return True
    return False


in_menus = {(p.get("group"), p.get("name")) for file in sys.argv[1:]
            for p in ElementTree.parse(file).getroot().iterfind("*/Category/Proxy")}
seen = set()
manager = servermanager.ProxyManager().SMProxyManager
for file in sys.argv[1:]:
    for group in ElementTree.parse(file).getroot().iter("ProxyGroup"):
        if group.get("name") not in ("meam_base", "representations"):  # not of our classes
            for element in group:
                seen.add(element.get("class"))
                check_proxy(group.get("name"), element)

for class_name in dir(ppfmeam.filters):
    kind = getattr(ppfmeam.filters, class_name)
    if class_name.startswith("vtkMEAM") and hasattr(kind, "GetOutputPort") and not is_abstract(kind):
        check(class_name in seen, f"{class_name}: no XML")

print(f"{len(seen)} proxies, {compared} defaults compared")
for failure in failures:
    print(failure)
sys.exit(1 if failures or not seen or not compared else 0)
