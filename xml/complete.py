# SPDX-License-Identifier: BSD-3-Clause
"""Writes the plugin's XML files from those of this folder.

<Choice name="detect.poses" /> becomes the property that choices.json describes, with the attributes and elements that it has
besides; a proxy without a long help has its text as that. Arguments: choices.json, a folder to write to, and the files."""
import json
import os
import re
import sys
import xml.etree.ElementTree as ElementTree

DOMAINS = {"choice": ("EnumerationDomain", "enum"), "flag": ("BooleanDomain", "bool"), "integer": ("IntRangeDomain", "range")}
LEAST_ABOVE_0 = "1e-9"


def fill(element, choice):
    """Makes the property of a choice of an element <Choice>."""
    kind, default = choice["type"], choice["default"]
    if kind == "choice":
        default = list(choice["values"]).index(default)
    values = default if isinstance(default, list) else [0, 0, 0] if default is None else [default]
    tag, name = DOMAINS.get(kind, ("DoubleRangeDomain", "range"))
    domain = ElementTree.Element(tag, name=name)
    for place, value in enumerate(choice.get("values", {}).values()):
        ElementTree.SubElement(domain, "Entry", value=str(place), text=re.sub("(?<=[a-z])(?=[A-Z])", " ", value))
    if "above" in choice:
        domain.set("min", LEAST_ABOVE_0)
    for bound in ("minimum", "maximum"):
        if bound in choice:
            domain.set(bound[:3], f"{choice[bound]:g}")
    element.tag = ("Int" if kind in DOMAINS else "Double") + "VectorProperty"
    element.attrib.update(name=choice["property"], command="Set" + choice["property"], number_of_elements=str(len(values)),
                          default_values=" ".join(f"{value:g}" for value in values))
    help = ElementTree.Element("Documentation")
    help.text = choice["help"]
    element[:0] = [domain, help]


def main(table, folder, *files):
    with open(table, encoding="utf-8") as file:
        choices = json.load(file)
    os.makedirs(folder, exist_ok=True)
    for path in files:
        root = ElementTree.parse(path).getroot()
        for element in root.iter("Choice"):
            group, name = element.get("name").split(".")
            fill(element, choices[group][name])
        for help in root.iterfind("*/*/Documentation[@short_help]"):
            help.attrib.setdefault("long_help", " ".join(help.text.split()))
        target, text = os.path.join(folder, os.path.basename(path)), ElementTree.tostring(root, encoding="unicode")
        if not os.path.exists(target) or open(target, encoding="utf-8").read() != text:  # else nothing is built anew
            with open(target, "w", encoding="utf-8") as file:
                file.write(text)


main(*sys.argv[1:])
