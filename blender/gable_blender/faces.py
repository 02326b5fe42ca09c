# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""The faces of an object's mesh as lots, in metres of the world."""
import bpy
import numpy as np

from . import lots
from .attributes import value_of_color

# Faces that can be lots at once.
MOST = 100_000
# What Blender itself keeps with faces.
BUILT_IN = {"material_index", "sharp_face", "shade_smooth", "face_maps"}
PLAIN = {"FLOAT", "INT", "BOOLEAN", "STRING"}
COLORS = {"FLOAT_COLOR", "BYTE_COLOR"}


def _arrays(mesh):
    points = np.empty(len(mesh.vertices) * 3)
    mesh.vertices.foreach_get("co", points)
    mesh.calc_loop_triangles()
    triangles = np.empty(len(mesh.loop_triangles) * 3, np.int64)
    mesh.loop_triangles.foreach_get("vertices", triangles)
    owners = np.empty(len(mesh.loop_triangles), np.int64)
    mesh.loop_triangles.foreach_get("polygon_index", owners)
    return points.reshape(-1, 3), triangles.reshape(-1, 3), owners


def _plain(value):
    return value.decode(errors="replace") if isinstance(value, bytes) else value


def _own_of(obj):
    """The custom properties of an object that rules can take as attributes."""
    return {key: _plain(value) for key, value in obj.items() if isinstance(value, (bool, int, float, str))}


def _values_of(mesh):
    """{name: a value for each face} of the attributes of faces."""
    found = {}
    for layer in mesh.attributes:
        if layer.domain != "FACE" or layer.name in BUILT_IN or layer.name.startswith("."):
            continue
        if layer.data_type in PLAIN:
            found[layer.name] = [_plain(item.value) for item in layer.data]
        elif layer.data_type in COLORS:
            found[layer.name] = [value_of_color(item.color_srgb if hasattr(item, "color_srgb") else item.color)
                                 for item in layer.data]
    return found


def _lot(number, polygons, points, triangles, owners_order, ends):
    """The faces of `polygons` as one lot, with the points that they use."""
    rows = np.concatenate([owners_order[ends[p]:ends[p + 1]] for p, _ in polygons])
    corners = triangles[rows]
    outlines = [outline for _, outline in polygons]
    used, place = np.unique(np.concatenate([corners.ravel(), *map(np.asarray, outlines)]), return_inverse=True)
    number_of = dict(zip(used.tolist(), range(len(used))))
    return lots.Lot(f"lot {number}", points[used], place[:corners.size].reshape(-1, 3),
                    [[number_of[v] for v in outline] for outline in outlines])


def lots_of(obj, joined, metres, depsgraph):
    """A lot for each face after modifiers, or for each group of faces that touch."""
    evaluated = obj.evaluated_get(depsgraph)
    mesh = evaluated.to_mesh()
    try:
        faces = [list(p.vertices) for p in mesh.polygons]
        if len(faces) > MOST:
            raise ValueError(f"{obj.name} has {len(faces)} faces, and {MOST} can be lots")
        if not faces:
            return []
        points, triangles, owners = _arrays(mesh)
        values = _values_of(mesh)
    finally:
        evaluated.to_mesh_clear()
    matrix = np.array(obj.matrix_world)
    world = (points @ matrix[:3, :3].T + matrix[:3, 3]) * metres
    if np.linalg.det(matrix[:3, :3]) < 0:
        triangles = triangles[:, ::-1]
        faces = [face[::-1] for face in faces]
    order = np.argsort(owners, kind="stable")
    ends = np.searchsorted(owners[order], np.arange(len(faces) + 1))
    groups = lots.islands(faces) if joined else [[n] for n in range(len(faces))]
    own = _own_of(obj)
    found = []
    for group in groups:
        lot = _lot(group[0] + 1, [(p, faces[p]) for p in group], world, triangles, order, ends)
        # A face's empty text says nothing.
        lot.attributes = {**own, **{name: v[group[0]] for name, v in values.items() if v[group[0]] != ""}}
        found.append(lot)
    return found


def metres_of(scene):
    """The metres of a unit of Blender."""
    return scene.unit_settings.scale_length if scene.unit_settings.system != "NONE" else 1.0


def depsgraph():
    return bpy.context.evaluated_depsgraph_get()
