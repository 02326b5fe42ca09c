#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Reads models back and tells what no reader should meet: model_check.py FILE-OR-FOLDER...

.glb .gltf .obj (with its .mtl) .ply .stl; a folder stands for the models in it. Looked for: numbers that are not finite
or beyond single precision, bounds that are not those of the vertices, normals of another length than 1, indices beyond
the vertices, turns that are no turns. Ends with 1 when a model has any.
"""
import json
import math
import struct
import sys
from array import array
from pathlib import Path
from urllib.parse import unquote

LARGEST = 3.4e38
MOST = 5  # Of each kind.


class Faults(list):
    def add(self, text):
        if sum(1 for each in self if each.split(":")[0] == text.split(":")[0]) < MOST:
            self.append(text)

    def number(self, value, what):
        if not isinstance(value, (int, float)) or not math.isfinite(value) or abs(value) > LARGEST:
            self.add(f"{what}: {value} is no number of a model")


def floats(data):
    values = array("f")
    values.frombytes(data)
    if sys.byteorder == "big":
        values.byteswap()
    return values


def check_json_numbers(value, where, faults):
    stack = [(value, where)]
    while stack:
        value, where = stack.pop()
        if isinstance(value, dict):
            stack.extend((v, f"{where}.{k}") for k, v in value.items())
        elif isinstance(value, list):
            stack.extend((v, where) for v in value)
        elif value is None:
            faults.add(f"{where}: null")
        elif isinstance(value, float):
            faults.number(value, where)


WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
KINDS = {5120: ("b", 1), 5121: ("B", 1), 5122: ("h", 2), 5123: ("H", 2), 5125: ("I", 4), 5126: ("f", 4)}
# What a number of a normalized accessor is divided by (glTF 2.0, 3.11).
WHOLE = {5120: 127, 5121: 255, 5122: 32767, 5123: 65535}


def read_accessor(document, buffer, accessor):
    view = document["bufferViews"][accessor["bufferView"]]
    width, (kind, size) = WIDTHS[accessor["type"]], KINDS[accessor["componentType"]]
    step = view.get("byteStride", width * size)
    at = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    out = array(kind)
    for i in range(accessor["count"]):
        out.frombytes(buffer[at + i * step:at + i * step + width * size])
    return out, width


def check_unit(values, width, used, what, faults, margin=1e-3):
    for i in range(0, len(values) - width + 1, width):
        if abs(math.hypot(*values[i:i + used]) - 1) > margin:
            faults.add(f"{what}: the length of {list(values[i:i + used])} is not 1")


def check_directions(document, buffer, accessor, what, faults):
    values, width = read_accessor(document, buffer, accessor)
    whole = WHOLE[accessor["componentType"]] if accessor.get("normalized") else 1
    # Each of three numbers is off by half a step at most.
    margin = 1e-3 if whole == 1 else math.sqrt(3) / 2 / whole + 1e-6
    check_unit([max(v / whole, -1) for v in values], width, 3, what, faults, margin)


def check_gltf(document, buffer, faults):
    check_json_numbers(document, "json", faults)
    accessors = document.get("accessors", [])
    for number, accessor in enumerate(accessors):
        values, width = read_accessor(document, buffer, accessor)
        if not all(map(math.isfinite, values)):
            faults.add(f"accessor {number}: not finite")
        for k in range(width if "min" in accessor else 0):
            told = accessor["min"][k], accessor["max"][k]
            own = min(values[k::width]), max(values[k::width])
            # Shortest texts of floats read back as doubles that are near them.
            if any(not math.isclose(a, b, rel_tol=1e-6, abs_tol=1e-37) for a, b in zip(told, own)):
                faults.add(f"minmax {number}: {told} for {own}")
    for mesh in document.get("meshes", []):
        for primitive in mesh["primitives"]:
            attributes = primitive["attributes"]
            for name in {"NORMAL", "TANGENT"} & attributes.keys():
                check_directions(document, buffer, accessors[attributes[name]], name.lower(), faults)
            indices, _ = read_accessor(document, buffer, accessors[primitive["indices"]])
            if not indices or max(indices) >= accessors[attributes["POSITION"]]["count"]:
                faults.add("indices: none, or beyond the vertices")
    for node in document.get("nodes", []):
        if "rotation" in node:
            check_unit(node["rotation"], 4, 4, "rotation", faults)


def check_glb(path, faults):
    data = path.read_bytes()
    magic, version, length = struct.unpack_from("<III", data)
    if magic != 0x46546C67 or version != 2 or length != len(data):
        faults.add("head: broken")
        return
    size, = struct.unpack_from("<I", data, 12)
    check_gltf(json.loads(data[20:20 + size]), data[28 + size:], faults)


def check_gltf_file(path, faults):
    document = json.loads(path.read_text())
    buffers = document.get("buffers", [])
    buffer = (path.parent / unquote(buffers[0]["uri"])).read_bytes() if buffers else b""
    check_gltf(document, buffer, faults)


def check_words(path, counts, faults):
    """Lines of words of which some are followed by numbers: OBJ and MTL."""
    for line in path.read_text().splitlines():
        words = line.split()
        if not words or words[0] not in counts:
            continue
        numbers = []
        for word in words[1:]:
            try:
                numbers.append(float(word))
            except ValueError:
                # Those of textures (map_Kd, norm) end with the name of a file.
                if words[0][0] not in "mn":
                    faults.add(f"{words[0]}: '{word}' is no number")
        for number in numbers:
            faults.number(number, words[0])
        counts[words[0]] += 1
        yield words[0], numbers


def check_obj(path, faults):
    counts = dict.fromkeys(["v", "vt", "vn"], 0)
    for word, numbers in check_words(path, counts, faults):
        if word == "vn":
            check_unit(numbers, 3, 3, "normal", faults)
    most = [counts["v"], counts["vt"], counts["vn"]]
    for line in path.read_text().splitlines():
        if not line.startswith("f "):
            continue
        for corner in line.split()[1:]:
            for index, end in zip(corner.split("/"), most):
                if index and not 1 <= int(index) <= end:
                    faults.add(f"index: {corner}")
    materials = path.with_suffix(".mtl")
    if materials.exists():
        names = dict.fromkeys("Kd Ka Ks Ke Ns d Pr Pm map_Kd map_bump map_d norm map_Ke map_Pr map_Pm".split(), 0)
        for _ in check_words(materials, names, faults):
            pass


def check_ply(path, faults):
    data = path.read_bytes()
    end = data.index(b"end_header\n") + 11
    head = data[:end].decode()
    kind, size = ("d", 8) if "property double x" in head else ("f", 4)
    count = {words[1]: int(words[2]) for words in map(str.split, head.splitlines()) if words[:1] == ["element"]}
    step = 3 * size + 4
    for i in range(count["vertex"]):
        for number in struct.unpack_from("<3" + kind, data, end + i * step):
            faults.number(number, "vertex")
    at = end + count["vertex"] * step
    for _ in range(count["face"]):
        corners = data[at]
        if not all(0 <= i < count["vertex"] for i in struct.unpack_from(f"<{corners}i", data, at + 1)):
            faults.add("index: beyond the vertices")
        at += 1 + 4 * corners
    if at != len(data):
        faults.add(f"length: {len(data)} for {at}")


def check_stl(path, faults):
    data = path.read_bytes()
    count, = struct.unpack_from("<I", data, 80)
    if len(data) != 84 + 50 * count:
        faults.add(f"length: {len(data)} for {count} triangles")
        return
    for i in range(count):
        values = floats(data[84 + 50 * i:132 + 50 * i])
        if not all(map(math.isfinite, values)):
            faults.add(f"triangle {i}: not finite")
        check_unit(values[:3], 3, 3, "normal", faults)


CHECKS = {".glb": check_glb, ".gltf": check_gltf_file, ".obj": check_obj, ".ply": check_ply, ".stl": check_stl}


def problems(path):
    """What is wrong with a model, a sentence each."""
    faults = Faults()
    try:
        CHECKS[path.suffix](path, faults)
    except (ValueError, KeyError, IndexError, struct.error, OSError) as e:
        faults.add(f"unreadable: {e!r}")
    return list(faults)


def main():
    failed = count = 0
    for name in sys.argv[1:]:
        path = Path(name)
        for model in sorted(p for p in path.rglob("*") if p.suffix in CHECKS) if path.is_dir() else [path]:
            count += 1
            found = problems(model)
            failed += bool(found)
            for fault in found:
                print(f"{model}: {fault}")
    print(f"{count} models read, {failed} with faults")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
