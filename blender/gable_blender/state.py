# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""What an object knows about its rules: kept in the file, so that it is there after saving and loading."""
import json
import os

import bpy
from bpy.props import (BoolProperty, CollectionProperty, EnumProperty, FloatVectorProperty, IntProperty,
                       PointerProperty, StringProperty)

from . import attributes, command, messages

# The name of the slider's value: a property of its own has the range that the rules say.
VALUE = "value"
# Lists of choices that panels show; Blender reads their texts later.
_choices = {}


def _choices_of(item, _context):
    known = _choices.get(item.choices)
    if known is None:
        known = _choices[item.choices] = [(c, c, "") for c in json.loads(item.choices or "[]")] or [("", "", "")]
    return known


class GableMessage(bpy.types.PropertyGroup):
    severity: StringProperty()
    text: StringProperty()
    hint: StringProperty()
    file: StringProperty()
    line: IntProperty()


class GableRule(bpy.types.PropertyGroup):
    """A rule to start with, by its name."""


class GableAttribute(bpy.types.PropertyGroup):
    """An attribute; its control shows the field of its kind, sliders the property VALUE."""
    label: StringProperty()
    kind: StringProperty()
    group: StringProperty()
    description: StringProperty()
    choices: StringProperty()
    bounded: BoolProperty()
    # What the rules say, as a text; `known`: whether that is told before they run.
    default: StringProperty()
    known: BoolProperty()
    own: BoolProperty(name="Own value", description="Give this value instead of what the rules say")
    flag: BoolProperty()
    text: StringProperty()
    color: FloatVectorProperty(subtype="COLOR_GAMMA", size=3, min=0, max=1)
    file: StringProperty(subtype="FILE_PATH")
    folder: StringProperty(subtype="DIR_PATH")
    choice: EnumProperty(items=_choices_of)

    def value_text(self):
        """The control's value as the program takes it."""
        if self.kind in (attributes.NUMBER, attributes.WHOLE):
            return attributes.text_of(self.get(VALUE, 0))
        if self.kind == attributes.FLAG:
            return attributes.text_of(self.flag)
        if self.kind == attributes.COLOR:
            return attributes.hex_of(self.color)
        if self.kind == attributes.CHOICE:
            return self.choice
        return {attributes.FILE: self.file, attributes.FOLDER: self.folder}.get(self.kind, self.text)

    def is_own(self):
        return self.value_text() != self.default if self.known else self.own

    def show(self, text):
        """Sets the control to a value."""
        if self.kind in (attributes.NUMBER, attributes.WHOLE):
            try:
                number = float(text or 0)
            except ValueError:
                number = 0.0
            self[VALUE] = round(number) if self.kind == attributes.WHOLE else number
        elif self.kind == attributes.FLAG:
            self.flag = text == "true"
        elif self.kind == attributes.COLOR:
            self.color = attributes.color_of(text)
        elif self.kind == attributes.CHOICE:
            names = json.loads(self.choices)
            if text and text in names:
                self.choice = text
        elif self.kind in (attributes.FILE, attributes.FOLDER):
            setattr(self, self.kind, text)
        else:
            self.text = text

    def reset(self):
        self.own = False
        self.show(self.default)


def _set_control(item, control):
    item.name, item.label, item.kind = control.name, control.label, control.kind
    item.group, item.description = control.group, control.description
    item.bounded = control.bounded
    item.known = control.default is not None
    choices = list(control.choices)
    default = attributes.text_of(control.default) if item.known else ""
    if control.kind == attributes.CHOICE and item.known and default not in choices:
        choices.insert(0, default)
    item.choices = json.dumps(choices)
    item.default = default
    if not item.known and control.kind in (attributes.NUMBER, attributes.WHOLE):
        item.show(str(max(control.minimum, min(control.maximum, 0))))
    else:
        item.show(default)
    if control.kind in (attributes.NUMBER, attributes.WHOLE):
        cast = int if control.kind == attributes.WHOLE else float
        wanted = {"min": cast(control.minimum), "max": cast(control.maximum), "description": control.description}
        wanted.update(soft_min=wanted["min"], soft_max=wanted["max"])
        if control.step and control.kind == attributes.NUMBER:
            wanted["step"] = control.step
        # A default of the rules may lie outside of their range.
        value = item[VALUE]
        wanted["min"], wanted["max"] = min(wanted["min"], value), max(wanted["max"], value)
        item.id_properties_ui(VALUE).update(**wanted)
    # What the control shows is what the program is told: the last digits of numbers do not count.
    if item.known:
        item.default = item.value_text()


class GableObject(bpy.types.PropertyGroup):
    rules: StringProperty(name="Rules", subtype="FILE_PATH", description="The rule file or package")
    start: StringProperty(name="Start rule", description="The rule that lots begin with; empty: the rules' own choice")
    style: StringProperty(name="Style", description="A style that the rule file declares")
    seed: IntProperty(name="Seed", min=0, max=2**31 - 1, description="Another number, another variation")
    joined: BoolProperty(name="Join touching faces",
                         description="Faces that touch are one lot, with holes where they enclose any")
    live: BoolProperty(name="Live", description="Generate again when a rule file, an attribute or the mesh changes")
    count: IntProperty(name="Variations", default=4, min=2, max=32, description="So many seeds, one beside the other")
    loaded: StringProperty()
    attributes: CollectionProperty(type=GableAttribute)
    starts: CollectionProperty(type=GableRule)
    styles: CollectionProperty(type=GableRule)
    messages: CollectionProperty(type=GableMessage)
    files: StringProperty()
    made: StringProperty()
    # The digest of the lots that the last run had.
    lots: StringProperty()
    # How the lots were shown before a model stood on them; empty while none does.
    shown: StringProperty()

    def path(self):
        return os.path.abspath(bpy.path.abspath(self.rules)) if self.rules else ""

    def own_attributes(self):
        return {a.name: a.value_text() for a in self.attributes if a.is_own()}

    def wishes(self, preferences, seed=None):
        limits = {"seconds": preferences.seconds, "megabytes": preferences.megabytes} if preferences else {}
        return command.Wishes(self.path(), self.start, self.style, self.seed if seed is None else seed,
                              self.own_attributes(), **limits)

    def take_info(self, info):
        """Shows what the rules offer; values that a person chose stay where the attribute does."""
        own = self.own_attributes()
        self.attributes.clear()
        for control in attributes.controls(info):
            item = self.attributes.add()
            _set_control(item, control)
            if control.name in own:
                item.show(own[control.name])
                item.own = True
        for collection, names in ((self.starts, attributes.start_rules(info)), (self.styles, info.get("styles", []))):
            collection.clear()
            for name in names:
                collection.add().name = name
        if self.start not in self.starts:
            self.start = ""
        self.loaded = self.rules
        named = [i["file"] for i in info.get("imports", [])] + [a["file"] for a in info.get("assets", [])]
        found = [messages.locate(name, self.path()) for name in named if name]
        self.files = json.dumps([self.path(), *filter(None, found)])

    def take_messages(self, found):
        self.messages.clear()
        for message in found:
            item = self.messages.add()
            item.severity, item.text, item.hint = message.severity, message.text, message.hint
            item.file, item.line = message.file, message.line

    def step_back(self, obj):
        """Lots lie where the ground of their model lies: they are shown as wire, and not rendered."""
        if not self.shown:
            self.shown = json.dumps([obj.display_type, obj.hide_render])
            obj.display_type, obj.hide_render = "WIRE", True

    def step_forward(self, obj):
        if self.shown:
            obj.display_type, obj.hide_render = json.loads(self.shown)
        self.shown = ""

    def watched(self):
        """The files that the rules are made of, and when each changed last."""
        times = []
        for path in json.loads(self.files or "[]"):
            try:
                times.append((path, os.stat(path).st_mtime_ns))
            except OSError:
                times.append((path, 0))
        return times

    def signature(self):
        """Changes when another model would come out."""
        return json.dumps([self.path(), self.start, self.style, self.seed, self.joined, self.own_attributes(),
                           self.watched()])


CLASSES = (GableMessage, GableRule, GableAttribute, GableObject)


def attach():
    bpy.types.Object.gable = PointerProperty(type=GableObject)


def detach():
    del bpy.types.Object.gable
