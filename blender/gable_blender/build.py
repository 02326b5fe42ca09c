# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""A model as data of Blender: one mesh for each of the model's, one object for each node, one collection for all.

Everything made here is tagged, so that a later generation can take its place and leave nothing behind.
"""
import bpy
import numpy as np
from mathutils import Matrix

from . import materials

# Marks of a generation's collection and of its objects.
MADE = materials.MADE
SOURCE, RULE, LINE, FILE = "gable_source", "gable_rule", "gable_line", "gable_file"


def _mesh(data, made_materials):
    mesh = bpy.data.meshes.new(data.name or "Gable")
    materials.tag(mesh)
    faces = len(data.triangles)
    mesh.vertices.add(len(data.positions))
    mesh.vertices.foreach_set("co", data.positions.astype(np.float32).ravel())
    mesh.loops.add(faces * 3)
    mesh.loops.foreach_set("vertex_index", data.triangles.astype(np.int32).ravel())
    mesh.polygons.add(faces)
    mesh.polygons.foreach_set("loop_start", np.arange(faces, dtype=np.int32) * 3)
    mesh.polygons.foreach_set("loop_total", np.full(faces, 3, np.int32))
    for slot in data.materials:
        mesh.materials.append(None if slot is None else made_materials[slot])
    mesh.polygons.foreach_set("material_index", data.slots)
    mesh.polygons.foreach_set("use_smooth", data.smooth)
    for number, uvs in enumerate(data.uvs):
        layer = mesh.uv_layers.new(name=materials.uv_name(number), do_init=False)
        layer.data.foreach_set("uv", uvs.ravel())
    mesh.update(calc_edges=True)
    if data.smooth.any():
        # Before 4.1, normals of corners count only with this.
        if hasattr(mesh, "use_auto_smooth"):
            mesh.use_auto_smooth = True
        mesh.normals_split_custom_set(data.normals.reshape(-1, 3).tolist())
    return mesh


def _unique_meshes(model, made_materials):
    return [_mesh(data, made_materials) for data in model.meshes]


def build(model, name, metres, offset=(0, 0, 0)):
    """A collection with the model, not linked to a scene yet. `metres`: a unit of Blender; `offset`: in units."""
    images = materials.load_images(model.images)
    meshes = _unique_meshes(model, materials.make(model, images))
    collection = bpy.data.collections.new(name)
    into_units = Matrix.Translation(offset) @ Matrix.Scale(1 / metres, 4)
    objects = []
    for node in model.nodes:
        mesh = None if node.mesh is None else meshes[node.mesh]
        made = bpy.data.objects.new(node.name or (mesh.name if mesh else "Gable"), mesh)
        materials.tag(made)
        made[RULE] = node.extras.get("rule", node.name)
        if "line" in node.extras:
            made[LINE] = node.extras["line"]
        matrix = Matrix(node.matrix.tolist())
        if node.parent is None:
            made.matrix_basis = into_units @ matrix
        else:
            made.parent = objects[node.parent]
            made.matrix_basis = matrix
        collection.objects.link(made)
        objects.append(made)
    return collection


def generations(source):
    """The collections that an object's lots have become."""
    return [c for c in bpy.data.collections if c.get(SOURCE) == source]


def _images_of(material):
    tree = material.node_tree
    return [n.image for n in tree.nodes if n.type == "TEX_IMAGE" and n.image] if tree else []


def remove(collections):
    """Collections with all that was made for them. What somebody uses elsewhere stays."""
    objects, meshes, used, images = set(), set(), set(), set()
    for collection in collections:
        for each in collection.objects:
            if each.get(MADE):
                objects.add(each)
                if each.data:
                    meshes.add(each.data)
    for mesh in meshes:
        used.update(m for m in getattr(mesh, "materials", []) if m and m.get(MADE))
    for material in used:
        images.update(i for i in _images_of(material) if i.get(MADE))
    bpy.data.batch_remove(objects)
    bpy.data.batch_remove({m for m in meshes if m.users == 0 and m.get(MADE)})
    bpy.data.batch_remove({m for m in used if m.users == 0})
    bpy.data.batch_remove({i for i in images if i.users == 0})
    bpy.data.batch_remove(collections)
