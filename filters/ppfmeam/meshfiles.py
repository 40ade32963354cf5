# SPDX-License-Identifier: BSD-3-Clause
"""Finds files that are cut off before VTK's readers see them: some of those would end the program."""
import os
import re
import struct

TYPES = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I", "float": "f", "double": "d",
         "int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i", "uint32": "I",
         "float32": "f", "float64": "d"}


def whole_stl(path):
    """False for a binary STL file that has fewer triangles than it promises, or is no STL file at all."""
    with open(path, "rb") as file:
        start = file.read(84)
    triangles = int.from_bytes(start[80:], "little")
    return start.lstrip().startswith(b"solid") or 84 + 50 * triangles <= os.path.getsize(path)


def whole_ply(path):
    """False for a PLY file that has fewer elements than it promises, or is no PLY file at all."""
    with open(path, "rb") as file:
        data = file.read()
    header = re.match(rb"ply\s(.*?\n)end_header[ \t]*\r?\n", data, re.DOTALL)
    if not header:
        return False
    elements, form = [], ""
    try:
        for line in header.group(1).decode("latin-1").splitlines():
            words = line.split()
            if words[:1] == ["format"]:
                form = words[1]
            elif words[:1] == ["element"]:
                elements.append((int(words[2]), []))
            elif words[:1] == ["property"]:
                elements[-1][1].append([TYPES[word] for word in words[1:-1] if word != "list"])
    except (IndexError, KeyError, ValueError):
        return False
    if form == "ascii":
        return whole_ascii(data[header.end():], elements)
    order = {"binary_little_endian": "<", "binary_big_endian": ">"}.get(form)
    return order is not None and whole_binary(data, header.end(), elements, order)


def whole_ascii(body, elements):
    """A line for each element; in the last one no value may be missing."""
    promised = sum(count for count, _ in elements)
    lines = [line for line in body.splitlines() if line.strip()][:promised]
    if len(lines) < promised:
        return False
    words = lines[-1].split() if lines else []
    for types in elements[-1][1] if lines else []:
        listed = len(types) == 2
        if not words or (listed and not words[0].isdigit()):
            return False
        used = 1 + int(words[0]) if listed else 1
        if used > len(words):
            return False
        words = words[used:]
    return True


def whole_binary(data, place, elements, order):
    """Walks through the lists, whose lengths only the file knows."""
    for count, properties in elements:
        if all(len(types) == 1 for types in properties):
            place += count * sum(struct.calcsize(order + types[0]) for types in properties)
            continue
        for _ in range(count):
            for types in properties:
                first = struct.calcsize(order + types[0])
                if place + first > len(data):
                    return False
                if len(types) == 2:
                    length = struct.unpack_from(order + types[0], data, place)[0]
                    if not 0 <= length <= len(data):
                        return False
                    place += int(length) * struct.calcsize(order + types[1])
                place += first
    return place <= len(data)
