# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Reads the GLB that Gable writes, into arrays with z up. Needs no Blender.

A mesh has its vertices welded: corners of faces share a vertex where they lie at the same place, while
texture coordinates and normals stay with the corners, as Blender has them.
"""
import json
import struct
from dataclasses import dataclass, field

import numpy as np

# Component types of glTF.
TYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
# What this reader knows of what a file may require.
KNOWN = {"KHR_texture_transform"}
# A face is smooth where the normal at a corner leaves its own by more: the cosine of a degree.
SMOOTH = 0.99985
MOST_UV_SETS = 8


class BrokenModel(Exception):
    """The file is not what Gable writes."""


@dataclass
class MeshData:
    name: str
    positions: np.ndarray   # (vertices, 3)
    triangles: np.ndarray   # (faces, 3) vertices
    normals: np.ndarray     # (faces, 3, 3), by corner
    uvs: list               # by set: (faces, 3, 2) with v up
    materials: list         # by slot: a number of the model's materials, or None
    slots: np.ndarray       # (faces,)
    smooth: np.ndarray      # (faces,) bool


@dataclass
class Node:
    name: str
    matrix: np.ndarray      # (4, 4), relative to the parent
    mesh: object            # a number or None
    parent: object          # a number or None
    extras: dict = field(default_factory=dict)


@dataclass
class Image:
    name: str
    mime: str
    data: bytes


@dataclass
class Model:
    nodes: list             # parents before their children
    meshes: list
    materials: list         # as glTF has them
    textures: list          # numbers of images
    images: list


def z_up(vectors):
    """(x, y, z) with y up as (x, -z, y) with z up."""
    return np.stack([vectors[..., 0], -vectors[..., 2], vectors[..., 1]], axis=-1)


def _chunks(data):
    if len(data) < 20 or data[:4] != b"glTF":
        raise BrokenModel("the model is not a GLB")
    at, found = 12, {}
    while at + 8 <= len(data):
        size, kind = struct.unpack_from("<I4s", data, at)
        if at + 8 + size > len(data):
            raise BrokenModel("the model ends in the middle")
        found[kind] = memoryview(data)[at + 8:at + 8 + size]
        at += 8 + size
    if b"JSON" not in found:
        raise BrokenModel("the model has no contents")
    return json.loads(bytes(found[b"JSON"])), found.get(b"BIN\0", memoryview(b""))


class _Reader:
    def __init__(self, data):
        self.document, self.binary = _chunks(data)
        unknown = set(self.document.get("extensionsRequired", [])) - KNOWN
        if unknown:
            raise BrokenModel(f"the model needs {', '.join(sorted(unknown))}")

    def array(self, number):
        accessor = self.document["accessors"][number]
        view = self.document["bufferViews"][accessor["bufferView"]]
        kind, width = np.dtype(TYPES[accessor["componentType"]]), WIDTHS[accessor["type"]]
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        stride = view.get("byteStride", kind.itemsize * width)
        return np.ndarray((accessor["count"], width), kind, self.binary, start, (stride, kind.itemsize))

    def mesh(self, mesh):
        positions, triangles, normals, uvs, slots, materials = [], [], [], [], [], []
        base = 0
        for primitive in mesh["primitives"]:
            attributes = primitive["attributes"]
            points = self.array(attributes["POSITION"]).astype(np.float32)
            faces = self.array(primitive["indices"]).astype(np.int64).reshape(-1, 3)
            sets = [self.array(attributes[f"TEXCOORD_{n}"])[faces] for n in range(MOST_UV_SETS)
                    if f"TEXCOORD_{n}" in attributes]
            positions.append(points)
            triangles.append(faces + base)
            normals.append(self.array(attributes["NORMAL"])[faces])
            uvs.append(sets)
            material = primitive.get("material")
            if material not in materials:
                materials.append(material)
            slots.append(np.full(len(faces), materials.index(material), np.int32))
            base += len(points)
        return _welded(mesh.get("name", ""), positions, triangles, normals, uvs, slots, materials)

    def image(self, image, number):
        view = self.document["bufferViews"][image["bufferView"]]
        start = view.get("byteOffset", 0)
        return Image(image.get("name", f"image {number}"), image.get("mimeType", ""),
                     bytes(self.binary[start:start + view["byteLength"]]))

    def nodes(self):
        """Parents first."""
        document, ordered, stack = self.document, [], []
        scene = document["scenes"][document.get("scene", 0)]
        stack = [(number, None) for number in reversed(scene.get("nodes", []))]
        while stack:
            number, parent = stack.pop()
            node = document["nodes"][number]
            own = len(ordered)
            ordered.append(Node(node.get("name", ""), _matrix(node), node.get("mesh"), parent,
                                node.get("extras", {})))
            stack.extend((child, own) for child in reversed(node.get("children", [])))
        return ordered


def _matrix(node):
    """Turned to z up: the turn, then the node's own, then the turn back."""
    x, y, z, w = node.get("rotation", (0, 0, 0, 1))
    turn = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
    own = np.eye(4)
    own[:3, :3] = turn * np.array(node.get("scale", (1, 1, 1)))
    own[:3, 3] = node.get("translation", (0, 0, 0))
    up = np.array([[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1.0]])
    return up @ own @ up.T


def _welded(name, positions, triangles, normals, uvs, slots, materials):
    points = np.concatenate(positions)
    # Negative zero is the same place.
    keys = np.ascontiguousarray(points + np.float32(0)).view("V12").reshape(-1)
    _, first, place = np.unique(keys, return_index=True, return_inverse=True)
    faces = place.reshape(-1)[np.concatenate(triangles)]
    by_corner = z_up(np.concatenate(normals).astype(np.float32))
    welded = z_up(points[first])
    corners = welded[faces].astype(np.float64)
    own = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    own /= np.maximum(np.linalg.norm(own, axis=1, keepdims=True), 1e-300)
    smooth = (np.einsum("fci,fi->fc", by_corner, own) < SMOOTH).any(axis=1)
    layers = []
    for n in range(max(len(sets) for sets in uvs)):
        layer = np.concatenate([sets[n] if n < len(sets) else np.zeros((len(t), 3, 2), np.float32)
                                for sets, t in zip(uvs, triangles)]).astype(np.float32)
        layer[..., 1] = 1 - layer[..., 1]
        layers.append(layer)
    return MeshData(name, welded, faces, by_corner, layers, materials, np.concatenate(slots), smooth)


def read(data):
    """The model in the bytes of a GLB; raises BrokenModel."""
    try:
        reader = _Reader(data)
        document = reader.document
        return Model(reader.nodes() if document.get("scenes") else [],
                     [reader.mesh(m) for m in document.get("meshes", [])],
                     document.get("materials", []), [t["source"] for t in document.get("textures", [])],
                     [reader.image(image, n) for n, image in enumerate(document.get("images", []))])
    except (KeyError, IndexError, TypeError, ValueError, struct.error) as error:
        raise BrokenModel(f"the model cannot be read: {error}") from error
