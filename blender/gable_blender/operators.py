# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""What a person can ask for: look at rules, generate, cancel, vary, take away."""
import bpy
from bpy.props import IntProperty, StringProperty

from . import build, command, job, messages, preferences, program, run


def target(context, name=""):
    """The object with the lots: the named one, the active one, or the one that the active one was made for."""
    if name:
        return bpy.data.objects.get(name)
    obj = context.view_layer.objects.active
    if obj is not None and obj.get(build.MADE):
        sources = [c.get(build.SOURCE) for c in obj.users_collection if c.get(build.SOURCE)]
        return bpy.data.objects.get(sources[0]) if sources else None
    return obj


def redraw(context):
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


def tell(operator, obj):
    """The first message of an object, where Blender shows it."""
    for message in obj.gable.messages:
        place = f"{message.file}:{message.line}: " if message.line else ""
        hint = f" ({message.hint})" if message.hint else ""
        operator.report({"ERROR" if message.severity == "error" else "WARNING"}, place + message.text + hint)
        break


class _OnLots(bpy.types.Operator):
    @classmethod
    def poll(cls, context):
        obj = target(context)
        return obj is not None and obj.type == "MESH"


class GABLE_OT_load(_OnLots):
    """Look at the rule file again: its start rules, attributes and mistakes"""
    bl_idname, bl_label = "gable.load", "Read Rules"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        obj = target(context)
        try:
            found = run.load_rules(obj)
            obj.gable.take_messages(found)
        except run.Refused as error:
            obj.gable.take_messages(error.messages)
            tell(self, obj)
            return {"CANCELLED"}
        return {"FINISHED"}


class GABLE_OT_check(_OnLots):
    """Report all mistakes of the rule file"""
    bl_idname, bl_label = "gable.check", "Check Rules"

    def execute(self, context):
        obj = target(context)
        try:
            line = command.check(run.find_program(), obj.gable.wishes(preferences.get()))
        except run.Refused as error:
            obj.gable.take_messages(error.messages)
            tell(self, obj)
            return {"CANCELLED"}
        _, found = job.ask(line, program.SECONDS)
        obj.gable.take_messages(messages.ordered(found))
        if not obj.gable.messages:
            self.report({"INFO"}, "No mistakes")
        tell(self, obj)
        return {"FINISHED"}


class _Generating(_OnLots):
    """From the panel in the background; from a script until it is done."""
    source: StringProperty(options={"HIDDEN", "SKIP_SAVE"})
    _timer = None

    def seeds(self, obj):
        return [obj.gable.seed]

    def begin(self, context):
        obj = target(context, self.source)
        if obj is None:
            self.report({"ERROR"}, "There is no object with lots")
            return None
        if obj.name in run.running:
            self.report({"WARNING"}, f"{obj.name} is being generated already")
            return None
        try:
            return run.Run(obj, self.seeds(obj))
        except run.Refused:
            # Tried: not again until something changes.
            obj.gable.made = obj.gable.signature()
            tell(self, obj)
            redraw(context)
            return None

    def end(self, context, work):
        done = work.finish()
        obj = bpy.data.objects.get(work.name)
        if obj is not None:
            tell(self, obj)
        redraw(context)
        return {"FINISHED"} if done else {"CANCELLED"}

    def execute(self, context):
        work = self.begin(context)
        if work is None:
            return {"CANCELLED"}
        try:
            job.complete(work)
        except OSError as error:
            return self.fail(context, error)
        return self.end(context, work)

    def fail(self, context, error):
        redraw(context)
        self.report({"ERROR"}, f"gable cannot be run: {error}")
        return {"CANCELLED"}

    def invoke(self, context, _event):
        self.work = self.begin(context)
        if self.work is None:
            return {"CANCELLED"}
        manager = context.window_manager
        self._timer = manager.event_timer_add(0.1, window=context.window)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        gone = run.running.get(self.work.name) is not self.work
        if gone or (event.type == "ESC" and event.value == "PRESS"):
            self.work.cancel()
            self.stop(context)
            self.report({"INFO"}, "Cancelled: what was there stays")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        redraw(context)
        try:
            if not self.work.step():
                return {"PASS_THROUGH"}
        except OSError as error:
            self.work.cancel()
            self.stop(context)
            return self.fail(context, error)
        self.stop(context)
        return self.end(context, self.work)

    def stop(self, context):
        if self._timer:
            context.window_manager.event_timer_remove(self._timer)
            self._timer = None
        redraw(context)


class GABLE_OT_generate(_Generating):
    """Make a model on each face. Esc cancels, and what was there stays"""
    bl_idname, bl_label = "gable.generate", "Generate"


class GABLE_OT_vary(_Generating):
    """Models of several seeds, one beside the other"""
    bl_idname, bl_label = "gable.vary", "Variations"

    def seeds(self, obj):
        return range(obj.gable.seed, obj.gable.seed + obj.gable.count)


class GABLE_OT_cancel(_OnLots):
    """End the generation; what was there stays"""
    bl_idname, bl_label = "gable.cancel", "Cancel"

    def execute(self, context):
        work = run.running.get(target(context).name)
        if work:
            work.cancel()
        redraw(context)
        return {"FINISHED"}


class GABLE_OT_next_seed(_OnLots):
    """The next seed, and generate"""
    bl_idname, bl_label = "gable.next_seed", "Next Seed"

    def execute(self, context):
        target(context).gable.seed += 1
        how = "EXEC_DEFAULT" if bpy.app.background else "INVOKE_DEFAULT"
        bpy.ops.gable.generate(how)
        return {"FINISHED"}


class GABLE_OT_clear(_OnLots):
    """Take away what was generated for this object"""
    bl_idname, bl_label = "gable.clear", "Remove Models"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        obj = target(context)
        build.remove(build.generations(obj.name))
        obj.gable.step_forward(obj)
        return {"FINISHED"}


class GABLE_OT_reset(_OnLots):
    """Take the value that the rules say"""
    bl_idname, bl_label = "gable.reset", "Reset"
    bl_options = {"REGISTER", "UNDO"}
    attribute: StringProperty()

    def execute(self, context):
        for item in target(context).gable.attributes:
            if item.name == self.attribute or not self.attribute:
                item.reset()
        return {"FINISHED"}


class GABLE_OT_open(_OnLots):
    """Show the place of a message in a text editor"""
    bl_idname, bl_label = "gable.open", "Show Place"
    number: IntProperty()

    def execute(self, context):
        own = target(context).gable
        if not 0 <= self.number < len(own.messages):
            return {"CANCELLED"}
        message = own.messages[self.number]
        path = messages.locate(message.file, own.path())
        if not path:
            self.report({"WARNING"}, f"'{message.file}' is not found")
            return {"CANCELLED"}
        known = [t for t in bpy.data.texts if bpy.path.abspath(t.filepath) == path]
        text = known[0] if known else bpy.data.texts.load(path)
        text.current_line_index = max(0, message.line - 1)
        editors = [a for a in context.screen.areas if a.type == "TEXT_EDITOR"] if context.screen else []
        for area in editors:
            area.spaces.active.text = text
        if not editors:
            self.report({"INFO"}, f"{text.name} is among the texts, at line {message.line}")
        return {"FINISHED"}


CLASSES = (GABLE_OT_load, GABLE_OT_check, GABLE_OT_generate, GABLE_OT_vary, GABLE_OT_cancel,
           GABLE_OT_next_seed, GABLE_OT_clear, GABLE_OT_reset, GABLE_OT_open)
