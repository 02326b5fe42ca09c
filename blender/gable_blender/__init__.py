# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Gable in Blender: faces of a mesh become buildings, by the rules of a file.

The add-on calls the program `gable`, which is installed on its own. Modules that say so need no Blender.
"""
bl_info = {
    "name": "Gable",
    "author": "The Gable authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > Gable",
    "description": "Faces become buildings by rules (shape grammars, CGA)",
    "category": "Add Mesh",
}


def _classes():
    from . import operators, panel, preferences, state
    return (preferences.GablePreferences, *state.CLASSES, *operators.CLASSES, *panel.CLASSES)


def register():
    import bpy

    from . import live, state
    for each in _classes():
        bpy.utils.register_class(each)
    state.attach()
    live.start()


def unregister():
    import bpy

    from . import live, state
    live.stop()
    state.detach()
    for each in reversed(_classes()):
        bpy.utils.unregister_class(each)
