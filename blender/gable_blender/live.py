# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Generates again when what a live object depends on has changed: rule files, attributes, its mesh."""
import json

import bpy

from . import lots, run

SECONDS = 0.5
# By object: what it was when the timer last looked. A value that is still being dragged waits.
_seen = {}
# Objects that Blender says have changed since the timer last looked at their faces.
_changed = set()


def _regenerate(obj):
    window = bpy.context.window_manager.windows[0] if bpy.context.window_manager.windows else None
    if window is None:
        bpy.ops.gable.generate("EXEC_DEFAULT", source=obj.name)
        return
    with bpy.context.temp_override(window=window):
        bpy.ops.gable.generate("INVOKE_DEFAULT", source=obj.name)


def look():
    """One look at all live objects; the names of those that were generated."""
    done = []
    for obj in list(bpy.data.objects):
        own = obj.gable
        if not own.live or not own.rules or obj.name in run.running or obj.mode != "OBJECT":
            continue
        now = own.signature()
        settled = _seen.get(obj.name) == now
        _seen[obj.name] = now
        if not settled or (now == own.made and not _has_other_lots(obj)):
            continue
        if own.loaded == own.rules and own.watched() != _times_in(own.made):
            # The rules themselves: they may have other attributes now.
            own.loaded = ""
        _regenerate(obj)
        done.append(obj.name)
    return done


def _has_other_lots(obj):
    """Blender tells of changes to an object that are none of its faces."""
    if obj.name not in _changed:
        return False
    _changed.discard(obj.name)
    try:
        good, _ = run.lots_of(obj)
    except run.Refused:
        return True
    return run.digest(lots.to_glb(good)) != obj.gable.lots


def _times_in(signature):
    return [tuple(pair) for pair in json.loads(signature)[-1]] if signature else []


def _tick():
    try:
        look()
    except (ReferenceError, RuntimeError) as error:
        # A file is being opened or an operator runs: the next look will do.
        print("Gable:", error)
    return SECONDS


@bpy.app.handlers.persistent
def _on_change(_scene, depsgraph):
    for update in depsgraph.updates:
        if isinstance(update.id, bpy.types.Object) and (update.is_updated_geometry or update.is_updated_transform):
            if update.id.gable.live:
                _changed.add(update.id.name)


@bpy.app.handlers.persistent
def _on_load(*_):
    for work in list(run.running.values()):
        work.cancel()
    _seen.clear()
    _changed.clear()


def start():
    bpy.app.timers.register(_tick, first_interval=SECONDS, persistent=True)
    bpy.app.handlers.depsgraph_update_post.append(_on_change)
    bpy.app.handlers.load_pre.append(_on_load)


def stop():
    if bpy.app.timers.is_registered(_tick):
        bpy.app.timers.unregister(_tick)
    bpy.app.handlers.depsgraph_update_post.remove(_on_change)
    bpy.app.handlers.load_pre.remove(_on_load)
    _on_load()
