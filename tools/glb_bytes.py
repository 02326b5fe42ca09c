#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""What the bytes of models are for: tools/glb_bytes.py MODEL.glb...

A line for each kind: attributes by name, indices, instances, pictures and the parts of the JSON text. Padding
counts for the attribute before it.
"""
import json
import struct
import sys
from collections import Counter
from pathlib import Path

COMPONENT = {5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4}
WIDTH = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


def read_json(data):
    """The JSON chunk, and how long it is."""
    magic, version, _, size = struct.unpack_from("<IIII", data)
    if magic != 0x46546C67 or version != 2:
        raise ValueError("this is no GLB file of version 2")
    return json.loads(data[20:20 + size]), size


def packed(accessor):
    return accessor["count"] * COMPONENT[accessor["componentType"]] * WIDTH[accessor["type"]]


def attribute_bytes(document, attributes):
    """Of interleaved vertices: each attribute takes what lies before the next."""
    accessors, views = document["accessors"], document["bufferViews"]
    by_place = sorted((accessors[a].get("byteOffset", 0), name, accessors[a]) for name, a in attributes.items())
    for (offset, name, accessor), following in zip(by_place, [*by_place[1:], None]):
        stride = views[accessor["bufferView"]].get("byteStride")
        if stride is None:
            yield name, packed(accessor)
        else:
            yield name, accessor["count"] * ((following[0] if following else stride) - offset)


def bytes_by_kind(data):
    document, size = read_json(data)
    accessors, views = document.get("accessors", []), document.get("bufferViews", [])
    out = Counter()
    primitives = [p for mesh in document.get("meshes", []) for p in mesh["primitives"]]
    # Several primitives may show the same numbers.
    for attributes in {tuple(sorted(p["attributes"].items())) for p in primitives}:
        out.update(dict(attribute_bytes(document, dict(attributes))))
    for number in {p["indices"] for p in primitives if "indices" in p}:
        out["indices"] += packed(accessors[number])
    for node in document.get("nodes", []):
        instances = node.get("extensions", {}).get("EXT_mesh_gpu_instancing", {}).get("attributes", {})
        for name, accessor in instances.items():
            out["instances " + name] += packed(accessors[accessor])
    for image in document.get("images", []):
        if "bufferView" in image:
            out["images"] += views[image["bufferView"]]["byteLength"]
    for part, value in document.items():
        out["JSON " + part] = len(json.dumps(value, separators=(",", ":"), ensure_ascii=False).encode())
    out["other"] = len(data) - sum(out.values())
    return out


def main(paths):
    for path in paths:
        data = Path(path).read_bytes()
        print(f"{path}: {len(data)} bytes")
        for kind, count in bytes_by_kind(data).most_common():
            print(f"  {kind:24} {count:12} {100 * count / len(data):5.1f} %")


if __name__ == "__main__":
    main(sys.argv[1:])
