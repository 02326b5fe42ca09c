# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""The panel of Gable: in the sidebar of the 3D view, for the active object."""
import bpy

from . import attributes, build, operators, preferences, program, run, state

MOST_MESSAGES = 8
# Letters of a line of the sidebar.
WIDTH = 44


def _lines(text, width=WIDTH):
    """A text in lines: labels do not wrap."""
    lines = [""]
    for word in text.split():
        if lines[-1] and len(lines[-1]) + len(word) >= width:
            lines.append("")
        lines[-1] += (" " if lines[-1] else "") + word
    return lines


def _paragraph(layout, text, icon):
    for number, line in enumerate(_lines(text)):
        layout.label(text=line, icon=icon if number == 0 else "BLANK1")


class _Panel:
    bl_space_type, bl_region_type, bl_category = "VIEW_3D", "UI", "Gable"

    @classmethod
    def poll(cls, context):
        obj = operators.target(context)
        return obj is not None and obj.type == "MESH"


class GABLE_PT_main(_Panel, bpy.types.Panel):
    bl_idname, bl_label = "GABLE_PT_main", "Gable"

    def draw(self, context):
        layout, obj = self.layout, operators.target(context)
        own = obj.gable
        try:
            preferences.find()
        except program.Unusable as error:
            _paragraph(layout, error.text, "ERROR")
            _paragraph(layout, error.hint, "BLANK1")
            return
        layout.prop(own, "rules", text="")
        row = layout.row(align=True)
        row.operator("gable.load", icon="FILE_REFRESH")
        row.operator("gable.check", icon="VIEWZOOM")
        if own.starts:
            layout.prop_search(own, "start", own, "starts", icon="OUTLINER_OB_MESH")
        if len(own.styles) > 1:
            layout.prop_search(own, "style", own, "styles", icon="BRUSH_DATA")
        layout.prop(own, "joined")
        row = layout.row(align=True)
        row.prop(own, "seed")
        row.operator("gable.next_seed", text="", icon="FORWARD")
        self.draw_runs(layout, obj)

    def draw_runs(self, layout, obj):
        own, work = obj.gable, run.running.get(obj.name)
        column = layout.column(align=True)
        if work:
            column.label(text=work.label(), icon="TIME")
            column.operator("gable.cancel", text="Cancel (Esc)", icon="CANCEL")
            return
        row = column.row(align=True)
        row.scale_y = 1.4
        row.enabled = bool(own.rules)
        row.operator("gable.generate", icon="HOME")
        row.prop(own, "live", text="", icon="RADIOBUT_ON" if own.live else "RADIOBUT_OFF")
        row = column.row(align=True)
        row.enabled = bool(own.rules)
        row.operator("gable.vary")
        row.prop(own, "count", text="")
        if build.generations(obj.name):
            column.operator("gable.clear", icon="TRASH")


class GABLE_PT_attributes(_Panel, bpy.types.Panel):
    bl_idname, bl_label, bl_parent_id = "GABLE_PT_attributes", "Attributes", "GABLE_PT_main"

    @classmethod
    def poll(cls, context):
        obj = operators.target(context)
        return obj is not None and obj.type == "MESH" and len(obj.gable.attributes) > 0

    def draw(self, context):
        layout, own = self.layout, operators.target(context).gable
        layout.use_property_split = True
        layout.use_property_decorate = False
        box, group = layout.column(align=True), ""
        for item in own.attributes:
            if item.group != group:
                group = item.group
                layout.separator()
                layout.label(text=group)
                box = layout.column(align=True)
            self.draw_one(box, item)

    def draw_one(self, layout, item):
        row = layout.row(align=True)
        field = row.row(align=True)
        if item.kind in (attributes.NUMBER, attributes.WHOLE):
            field.prop(item, f'["{state.VALUE}"]', text=item.label, slider=item.bounded)
        else:
            name = {attributes.FLAG: "flag", attributes.COLOR: "color", attributes.CHOICE: "choice",
                    attributes.FILE: "file", attributes.FOLDER: "folder"}.get(item.kind, "text")
            field.prop(item, name, text=item.label)
        if not item.known:
            field.enabled = item.own
            row.prop(item, "own", text="", icon="CHECKBOX_HLT" if item.own else "CHECKBOX_DEHLT")
        elif item.is_own():
            row.operator("gable.reset", text="", icon="LOOP_BACK").attribute = item.name


class GABLE_PT_messages(_Panel, bpy.types.Panel):
    bl_idname, bl_label, bl_parent_id = "GABLE_PT_messages", "Messages", "GABLE_PT_main"

    @classmethod
    def poll(cls, context):
        obj = operators.target(context)
        return obj is not None and obj.type == "MESH" and len(obj.gable.messages) > 0

    def draw(self, context):
        own = operators.target(context).gable
        for number, message in enumerate(own.messages[:MOST_MESSAGES]):
            box = self.layout.box().column(align=True)
            if message.line:
                row = box.row()
                row.label(text=f"{message.file}, line {message.line}")
                row.operator("gable.open", text="", icon="TEXT").number = number
            _paragraph(box, message.text, "CANCEL" if message.severity == "error" else "ERROR")
            if message.hint:
                _paragraph(box, message.hint, "LIGHT")
        if len(own.messages) > MOST_MESSAGES:
            self.layout.label(text=f"and {len(own.messages) - MOST_MESSAGES} more")


class GABLE_PT_made(_Panel, bpy.types.Panel):
    bl_idname, bl_label, bl_parent_id = "GABLE_PT_made", "Selected Part", "GABLE_PT_main"

    @classmethod
    def poll(cls, context):
        return context.object and context.object.get(build.MADE) and operators.target(context) is not None

    def draw(self, context):
        obj = context.object
        line = obj.get(build.LINE)
        self.layout.label(text=f"Rule {obj.get(build.RULE, '')}" + (f", line {line}" if line else ""))
        if obj.data and obj.data.users > 1:
            self.layout.label(text=f"One of {obj.data.users} with this mesh")


CLASSES = (GABLE_PT_main, GABLE_PT_attributes, GABLE_PT_messages, GABLE_PT_made)
