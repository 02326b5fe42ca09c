# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""W2 in Blender: blender -b --factory-startup --python-exit-code 1 --python blender_w2.py -- FILE.glb|FILE.obj

100,000 boxes as one mesh, made by numpy as fast as Blender takes them, and written by Blender's exporter.
"""
import sys

import bpy
import numpy

# Debian's exporter asks for names that its numpy no longer has.
numpy.bool = bool

path = sys.argv[sys.argv.index("--") + 1]
i = numpy.arange(1000)
j, k = i * 0.618033988749895 % 1, i * 0.754877666246693 % 1
w, d, h = (8 + 6 * j) / 4, (8 + 6 * k) / 5, (13.6 + 2.6 * j) / 5
f, b, p = (a.ravel() for a in numpy.meshgrid(range(5), range(4), range(5), indexing="ij"))
size = numpy.repeat(numpy.stack([w, d, h], 1), 100, 0)
at = numpy.stack([(i[:, None] % 40 * 30 + b * w[:, None]).ravel(), (i[:, None] // 40 * 30 + p * d[:, None]).ravel(),
                  (f * h[:, None]).ravel()], 1)
unit = numpy.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)])
faces = numpy.array([[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]])
vertices = (at[:, None] + unit * size[:, None]).reshape(-1, 3)
corners = (faces.ravel() + numpy.arange(len(at))[:, None] * 8).ravel()

mesh = bpy.data.meshes.new("boxes")
mesh.vertices.add(len(vertices))
mesh.vertices.foreach_set("co", vertices.ravel())
mesh.loops.add(len(corners))
mesh.loops.foreach_set("vertex_index", corners)
mesh.polygons.add(len(corners) // 4)
mesh.polygons.foreach_set("loop_start", numpy.arange(0, len(corners), 4))
mesh.polygons.foreach_set("loop_total", numpy.full(len(corners) // 4, 4))
mesh.update(calc_edges=True)
for other in list(bpy.data.objects):
    bpy.data.objects.remove(other)
bpy.context.scene.collection.objects.link(bpy.data.objects.new("boxes", mesh))
if path.endswith(".obj"):
    bpy.ops.wm.obj_export(filepath=path, export_materials=False)
else:
    bpy.ops.export_scene.gltf(filepath=path, export_format="GLB")
