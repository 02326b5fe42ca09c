# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Where the program is, and what a generation may take."""
import os

import bpy
from bpy.props import IntProperty, StringProperty

from . import program

PACKAGE = __package__


class GablePreferences(bpy.types.AddonPreferences):
    bl_idname = PACKAGE

    program: StringProperty(
        name="Program", subtype="FILE_PATH",
        description="The program gable; empty: the one on the PATH, or beside the add-on")
    seconds: IntProperty(name="Seconds", default=600, min=1, description="A generation stops after so many")
    megabytes: IntProperty(name="Megabytes", default=4096, min=64, description="A generation stops beyond so many")

    def draw(self, _context):
        layout = self.layout
        layout.prop(self, "program")
        row = layout.row()
        row.prop(self, "seconds")
        row.prop(self, "megabytes")
        try:
            path, version = find()
            layout.label(text=f"{path}: version {'.'.join(map(str, version))}", icon="CHECKMARK")
        except program.Unusable as error:
            layout.label(text=error.text, icon="ERROR")
            layout.label(text=error.hint, icon="BLANK1")


def get():
    """None where the add-on runs without having been enabled."""
    addon = bpy.context.preferences.addons.get(PACKAGE)
    return addon.preferences if addon else None


# {path asked for: what was found}: a panel asks often.
_found = {}


def find():
    """(program, version); raises program.Unusable."""
    own = get()
    wanted = bpy.path.abspath(own.program) if own and own.program else ""
    folder = os.path.dirname(os.path.abspath(__file__))
    candidates = program.candidates(wanted, folder)
    key = (candidates[0], os.path.getmtime(candidates[0])) if candidates and os.path.isfile(candidates[0]) else None
    if key not in _found or key is None:
        found = program.find(wanted, folder)
        _found[key] = found
    return _found[key]
