# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Faces as lots: what a lot must be, and the GLB that hands them to the program. Needs no Blender.

Coordinates are metres in the world of Blender, z up. Gable and glTF have y up. What lies in one plane and
touches becomes one polygon again when Gable reads it, with holes where it encloses any: so a lot is handed
over as triangles, and the two faces that Blender makes around a hole are one lot with a hole.
"""
import json
import math
import struct
from dataclasses import dataclass, field

import numpy as np

# A lot has at least this area, in square metres.
LEAST_AREA = 1e-4
# So much more area than their outline's the triangles of a face may have.
MOST_BENT = 1.25
# Farther out single precision has no centimetres; with the middle of all lots as origin it stays fine.
FARTHEST = 1e7
# What looks down within eight degrees is a footprint that lies on its face.
DOWN = 0.99
FLOAT, UNSIGNED = 5126, 5125


@dataclass
class Lot:
    name: str
    # (n, 3) corners, and (m, 3) triangles that count from 0.
    points: np.ndarray
    triangles: np.ndarray
    # Lists of corners, one a face, around it.
    outlines: list
    # Attributes of the rules, by name: numbers, texts, truths.
    attributes: dict = field(default_factory=dict)


def vector_area(points):
    """Of a closed outline, by Newell: its length is the area of a flat one that does not cross itself."""
    following = np.roll(points, -1, axis=0)
    return np.cross(points - points[0], following - points[0]).sum(axis=0) / 2


def area_of(lot):
    corners = lot.points[lot.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return float(np.linalg.norm(normals, axis=1).sum() / 2)


def fault_of(lot):
    """Why a lot cannot be used, or an empty text."""
    if not np.isfinite(lot.points).all():
        return "has a corner that is not a number"
    if np.abs(lot.points).max(initial=0) > FARTHEST:
        return f"lies more than {FARTHEST / 1000:.0f} km from the origin"
    area = area_of(lot)
    if area < LEAST_AREA:
        return "has no area"
    sizes = [float(np.linalg.norm(vector_area(lot.points[outline]))) for outline in lot.outlines]
    # The triangles of an outline that crosses itself have more area than it; those of a bent one a little.
    if min(sizes) <= 0 or area > sum(sizes) * MOST_BENT:
        return "crosses itself or is strongly bent"
    return ""


def is_bent(lot):
    """Whether a single face leaves its plane by more than a hundredth of its size: it becomes several."""
    if len(lot.outlines) != 1:
        return False
    points = lot.points[lot.outlines[0]]
    normal = vector_area(points)
    normal = normal / max(float(np.linalg.norm(normal)), 1e-300)
    off = np.abs((points - points.mean(axis=0)) @ normal).max()
    return bool(off > 0.01 * np.ptp(points, axis=0).max())


def faces_down(lot):
    """Whether all of it looks straight down."""
    corners = lot.points[lot.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return bool((normals[:, 2] < -DOWN * np.linalg.norm(normals, axis=1)).all())


def islands(faces):
    """Lists of the numbers of faces that hang together by edges: `faces` are lists of vertex numbers."""
    parent = list(range(len(faces)))

    def root(i):
        while parent[i] != i:
            parent[i] = parent[parent[i]]
            i = parent[i]
        return i

    owner = {}
    for number, face in enumerate(faces):
        for a, b in zip(face, [*face[1:], *face[:1]]):
            other = owner.setdefault((min(a, b), max(a, b)), number)
            if other != number:
                low, high = sorted((root(other), root(number)))
                parent[high] = low
    found = {}
    for number in range(len(faces)):
        found.setdefault(root(number), []).append(number)
    return list(found.values())


def sort_out(lots):
    """(those that can be used, a sentence for each other, a sentence for each that is used with a caveat)."""
    good, faults, caveats = [], [], []
    for lot in lots:
        fault = fault_of(lot)
        if fault:
            faults.append(f"{lot.name} {fault}")
            continue
        good.append(lot)
        if faces_down(lot):
            lot.triangles = lot.triangles[:, ::-1]
            caveats.append(f"{lot.name} faces the ground: it is turned up")
        if is_bent(lot):
            caveats.append(f"{lot.name} is bent: it becomes several flat pieces")
    return good, faults, caveats


def leave_out_values(lots):
    """Takes away attributes that are infinite or no number, which JSON has not; a sentence for each name of one."""
    owners = {}
    for lot in lots:
        for name, value in list(lot.attributes.items()):
            if isinstance(value, float) and not math.isfinite(value):
                del lot.attributes[name]
                owners.setdefault(name, []).append(lot.name)
    return [f"the attribute '{name}' of {names[0]}" + (f" and {len(names) - 1} more" if len(names) > 1 else "") +
            " is infinite or not a number" for name, names in owners.items()]


def _padded(data, filler):
    return data + filler * (-len(data) % 4)


def to_glb(lots):
    """The bytes of a GLB with a node for each lot, which has its name; single precision about its middle.

    All numbers are finite (fault_of, leave_out_values), or ValueError is raised.
    """
    nodes, meshes, accessors, views = [], [], [], []
    binary = bytearray()

    def accessor(array, kind, count, shape, **more):
        views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": array.nbytes})
        binary.extend(_padded(array.tobytes(), b"\0"))
        accessors.append({"bufferView": len(views) - 1, "componentType": kind, "count": count, "type": shape, **more})
        return len(accessors) - 1

    for lot in lots:
        up = lot.points[:, [0, 2, 1]] * np.array([1.0, 1.0, -1.0])
        origin = np.floor(up.mean(axis=0))
        local = (up - origin).astype("<f4")
        indices = lot.triangles.astype("<u4").reshape(-1)
        position = accessor(local, FLOAT, len(local), "VEC3", min=local.min(axis=0).tolist(),
                            max=local.max(axis=0).tolist())
        index = accessor(indices, UNSIGNED, len(indices), "SCALAR")
        meshes.append({"primitives": [{"attributes": {"POSITION": position}, "indices": index}]})
        nodes.append({"name": lot.name, "mesh": len(meshes) - 1, "translation": origin.tolist(),
                      "extras": lot.attributes})
    document = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(nodes)))}],
                "nodes": nodes, "meshes": meshes, "accessors": accessors, "bufferViews": views,
                "buffers": [{"byteLength": len(binary)}]}
    text = _padded(json.dumps(document, allow_nan=False).encode(), b" ")
    head = struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(binary))
    return b"".join([head, struct.pack("<I4s", len(text), b"JSON"), text,
                     struct.pack("<I4s", len(binary), b"BIN\0"), bytes(binary)])
