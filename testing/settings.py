#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Whether every field of the *Settings structs of core/ is set by a preset, a filter, a switch of the ablation, a benchmark or an
example.

A number that nothing sets is a constexpr beside its use. What is set is told from the declared types of variables:
"settings.evidence.tolerance = 1.5" sets two fields, PoseVerificationSettings.evidence and EvidenceSettings.tolerance; a
filter's vtkMEAMSettingMacro does the same. The structs that core/meam.h and core/picks.h take are
the user's choices and count as set.

  testing/settings.py ROOT        prints the fields that nothing sets, and fails when there are any
"""
import pathlib
import re
import sys

STRUCT = re.compile(r"^struct (\w+Settings)\n\{\n(.*?)^\};", re.M | re.S)
FIELD = re.compile(r"^  (?:std::optional<)?([\w:]+(?:<[^;]*>)?)>? (\w+)(?: = [^;]*|\{[^;]*\})?;", re.M)
ALIAS = re.compile(r"\busing (\w+) = (?:meam::)?(\w+Settings);")
VARIABLE = re.compile(r"\b(\w+)(?:&|>)? (?=(\w+)\b)")
ASSIGNED = re.compile(r"\b(?!this\b)(\w+)(?:->|\.)((?:\w+(?:\.emplace\(\))?\.)*\w+)(?: [&|]?= |\.push_back\()")
MACRO = re.compile(r"SettingMacro\(\s*\w+, \w+, [\w ]+, ([\w.]+)")


def structs_of(root):
    """{struct: {field: type}} and {struct: header}."""
    fields, headers = {}, {}
    for header in sorted((root / "core").glob("**/*.h")):
        for name, body in STRUCT.findall(header.read_text()):
            fields[name] = {field: kind for kind, field in FIELD.findall(body)}
            headers[name] = header.relative_to(root)
    return fields, headers


def set_fields(root, structs):
    """All (struct, field) that something sets."""
    found = set()
    patterns = ("core/**/*.cpp", "core/**/*.h", "filters/**/*.cxx", "testing/benchmarks/*.cpp", "testing/evaluation/*.cpp",
                "examples/**/*.cpp")
    sources = [path for pattern in patterns for path in root.glob(pattern)]
    for source in sources:
        text = source.read_text(errors="replace")
        header = source.with_suffix(".h")
        aliases = dict(ALIAS.findall(text))
        types = {}
        for kind, name in VARIABLE.findall(text + (header.read_text() if header.exists() else "")):
            if aliases.get(kind, kind) in structs:
                types.setdefault(name, set()).add(aliases.get(kind, kind))
        paths = ASSIGNED.findall(text) + [("Settings", path) for path in MACRO.findall(text)]
        for variable, path in paths:
            for struct in types.get(variable, ()):
                for field in path.replace("emplace().", "").split("."):
                    found.add((struct, field))
                    struct = structs.get(struct, {}).get(field, "")
    return found


def main():
    root = pathlib.Path(sys.argv[1])
    structs, headers = structs_of(root)
    found = set_fields(root, structs)
    chosen = {name for door in ("meam.h", "picks.h") for name in re.findall(r"(\w+)&", (root / "core" / door).read_text())}
    unset = [(struct, field) for struct, fields in structs.items() for field in fields
             if struct not in chosen and (struct, field) not in found]
    for struct, field in unset:
        print(f"{headers[struct]}: nothing sets {struct}::{field}: make it a constexpr beside its use")
    if len(structs) < 10 or len(found) < 50:
        sys.exit(f"only {len(structs)} settings structs are found under {root}/core, and {len(found)} fields that are set")
    return 1 if unset else 0


if __name__ == "__main__":
    sys.exit(main())
