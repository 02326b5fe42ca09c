# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Models of each profile in Blender: blender -b --python import.py -- FOLDER, which has godot.glb and others of the yard."""
import sys
from pathlib import Path

import bpy
import numpy

# The importer of Debian's Blender 3.4 is older than numpy 1.24.
if not hasattr(numpy, "bool"):
    numpy.bool = bool
FOLDER = Path(sys.argv[sys.argv.index("--") + 1])
# What there is beside the yard and two houses.
WANTED = {
    "blender": set(),
    "godot": {"House-colonly", "House_2-colonly", "Yard-colonly"},
    "unity": {"House_LOD1", "House_LOD2", "House_collision", "House_2_LOD1", "House_2_LOD2", "House_2_collision", "Yard_LOD1",
              "Yard_LOD2", "Yard_collision"},
    "unreal": {"UCX_House_00", "UCX_House_2_00", "UCX_Yard_00"},
}


def imported(path):
    bpy.ops.wm.read_homefile(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=str(path))
    return {o.name: o for o in bpy.data.objects if o.type == "MESH"}


def highest(obj):
    return max((obj.matrix_world @ v.co).z for v in obj.data.vertices)


for profile, wanted in WANTED.items():
    found = imported(FOLDER / f"{profile}.glb")
    missing = wanted - found.keys()
    assert not missing, (profile, missing, sorted(found))
    for name in wanted:
        if "House" in name:
            assert abs(highest(found[name]) - 11.887) < 1.5, (name, highest(found[name]))
    print(f"import: {profile}: {len(found)} objects, {len(bpy.data.meshes)} meshes")
