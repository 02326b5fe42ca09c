# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Run inside Blender by check.sh: opens one model and says what arrived, and after how long."""
import sys
import time

import bpy
import numpy

# The importer of Debian's Blender 3.4 knows an older numpy.
numpy.bool = bool

path = sys.argv[sys.argv.index("--") + 1]
bpy.ops.wm.read_factory_settings(use_empty=True)
begin = time.perf_counter()
bpy.ops.import_scene.gltf(filepath=path)
seconds = time.perf_counter() - begin
triangles = 0
counted = {}
for o in bpy.context.scene.objects:
    if o.type != "MESH":
        continue
    if o.data.name not in counted:
        counted[o.data.name] = sum(len(p.vertices) - 2 for p in o.data.polygons)
    triangles += counted[o.data.name]
print(f"blender {seconds:.1f} s {len(bpy.context.scene.objects)} objects {triangles} triangles", flush=True)
