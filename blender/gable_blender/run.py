# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""A generation, from the faces of an object to its collection: seeds one after the other, in the background.

What was there stays until all of the new is there; a run that fails or is cancelled changes nothing but the
messages.
"""
import dataclasses
import hashlib
import json
import os
import tempfile

import bpy

from . import build, command, faces, glb, job, lots, messages, preferences, program

# Runs at work, by the name of their object.
running = {}
# From variation to variation, as a share of the width of all lots.
GAP = 1.15


class Refused(Exception):
    """A run that cannot begin; has its messages."""

    def __init__(self, found):
        super().__init__(found[0].sentence())
        self.messages = found


def refuse(text, hint=""):
    return Refused([messages.Message("error", text, hint)])


def find_program():
    try:
        return preferences.find()[0]
    except program.Unusable as error:
        raise refuse(error.text, error.hint) from error


def lots_of(obj):
    """(lots, messages); raises Refused where there are none."""
    if obj.type != "MESH":
        raise refuse(f"{obj.name} is no mesh", "choose a mesh whose faces are lots")
    try:
        all_lots = faces.lots_of(obj, obj.gable.joined, faces.metres_of(bpy.context.scene), faces.depsgraph())
    except ValueError as error:
        raise refuse(str(error), "split the mesh into several objects") from error
    if not all_lots:
        raise refuse(f"{obj.name} has no faces", "give it a face: each face is a lot")
    good, faults, caveats = lots.sort_out(all_lots)
    found = [messages.Message("warning", f"{fault}: it is left out", "mend or delete the face") for fault in faults]
    found += [messages.Message("warning", caveat, "select it, and flatten or flip it") for caveat in caveats]
    if not good:
        raise Refused([messages.Message("error", f"none of the faces of {obj.name} can be a lot: {faults[0]}",
                                        "mend the face"), *found])
    found += [messages.Message("warning", f"{value}: it is left out", "give it a finite number")
              for value in lots.leave_out_values(good)]
    return good, found


def digest(data):
    return hashlib.sha1(data).hexdigest()


def load_rules(obj):
    """Reads what the rules of an object offer; raises Refused."""
    own = obj.gable
    if not own.rules:
        raise refuse("no rule file is chosen", "choose one in the panel of Gable")
    good, _ = lots_of(obj)
    handle, shapes = tempfile.mkstemp(prefix="gable-", suffix=".glb")
    try:
        # The first lot is all that the values of attributes need.
        with os.fdopen(handle, "wb") as file:
            file.write(lots.to_glb(good[:1]))
        # Without the values that a person chose: what the rules say by themselves is asked for.
        wishes = dataclasses.replace(own.wishes(preferences.get()), attributes={})
        info, found = job.ask(command.info(find_program(), wishes, shapes), program.SECONDS)
    finally:
        os.remove(shapes)
    if info is None or any(m.severity == "error" for m in found) or not info.get("rules"):
        raise Refused(messages.ordered(found) or [messages.Message("error", "the rules are empty", "write a rule")])
    own.take_info(info)
    return found


class Run:
    """One object's generation. step() until it is True; then the work is done, or `failed`."""

    def __init__(self, obj, seeds=None):
        self.name = obj.name
        self.seeds = list(seeds or [obj.gable.seed])
        self.found, self.outcomes, self.failed = [], [], False
        self.job = None
        try:
            self.program = find_program()
            if obj.gable.loaded != obj.gable.rules or not obj.gable.attributes:
                load_rules(obj)
            good, self.found = lots_of(obj)
        except Refused as error:
            obj.gable.take_messages(error.messages)
            raise
        self.count = len(good)
        self.data = lots.to_glb(good)
        low = min(lot.points[:, 0].min() for lot in good)
        high = max(lot.points[:, 0].max() for lot in good)
        self.stride = float(high - low) * GAP / faces.metres_of(bpy.context.scene)
        self.signature = obj.gable.signature()
        self.wishes = [obj.gable.wishes(preferences.get(), seed) for seed in self.seeds]
        running[self.name] = self

    def step(self):
        if self.job is None:
            self.job = job.Job(self.program, self.wishes[len(self.outcomes)], self.data)
        outcome = self.job.poll()
        if outcome is None:
            return False
        if outcome.ok:
            with open(outcome.model, "rb") as file:
                outcome.model = file.read()
        self.outcomes.append(outcome)
        self.job.close()
        self.job = None
        self.failed = not outcome.ok
        return self.failed or len(self.outcomes) == len(self.seeds)

    def label(self):
        part = f" {len(self.outcomes) + 1} of {len(self.seeds)}" if len(self.seeds) > 1 else ""
        return f"Generating{part}: {self.job.seconds() if self.job else 0:.0f} s"

    def cancel(self):
        if self.job:
            self.job.close()
            self.job = None
        running.pop(self.name, None)

    def finish(self):
        """Shows what came out. True where there is a new model."""
        running.pop(self.name, None)
        obj = bpy.data.objects.get(self.name)
        if obj is None:
            return False
        own = obj.gable
        own.made, own.lots = self.signature, digest(self.data)
        found = messages.ordered(self.found + [m for o in self.outcomes for m in o.messages])
        made = []
        if not self.failed:
            try:
                models = [glb.read(outcome.model) for outcome in self.outcomes]
                made = [self._build(obj, *each) for each in zip(range(len(models)), models)]
            except glb.BrokenModel as error:
                found.insert(0, messages.Message("error", str(error), "update Gable and the add-on to the same version"))
                self.failed = True
        own.take_messages(found)
        if self.failed:
            return False
        build.remove(build.generations(obj.name))
        for collection, name in made:
            collection.name = name
            collection[build.SOURCE] = obj.name
            bpy.context.scene.collection.children.link(collection)
        own.step_back(obj)
        bpy.ops.ed.undo_push(message="Gable: generate")
        return True

    def _build(self, obj, number, model):
        wishes, outcome = self.wishes[number], self.outcomes[number]
        name = f"{obj.name} by Gable" + (f", seed {wishes.seed}" if len(self.seeds) > 1 else "")
        metres = faces.metres_of(bpy.context.scene)
        # Lots lie where they are: the first model is on them, variations stand beside it.
        collection = build.build(model, name, metres, (number * self.stride, 0, 0))
        collection[build.FILE] = wishes.rules
        collection[build.RULE] = wishes.start or (obj.gable.starts[0].name if obj.gable.starts else "")
        collection["gable_seed"] = wishes.seed
        collection["gable_attributes"] = json.dumps({a.name: a.value_text() for a in obj.gable.attributes
                                                     if a.known or a.is_own()})
        for key, total in outcome.report_sums().items():
            collection[key] = total
        return collection, name
