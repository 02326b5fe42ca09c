# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""The add-on in a window of Blender: its panel is drawn, a generation runs while the page lives, Esc ends it.

    blender --factory-startup --enable-event-simulate --python tests/blender/window_test.py -- ZIP GABLE OUT

A timer takes the steps, one at a time, as Blender draws between them. Prints `window: passed` and leaves
panel.png in OUT; the exit status is 1 where a step fails.
"""
import os
import sys
import tempfile
import time
import traceback
from pathlib import Path

import bpy

ROOT = Path(__file__).resolve().parents[2]
ZIP, GABLE, OUT = (Path(p).resolve() for p in sys.argv[sys.argv.index("--") + 1:][:3])
SLOW = ("@StartRule\nLot --> Deep(40)\nDeep(n) --> case n > 0 : [ t(rand(1), 0, 0) Deep(n - 1) ] "
        "[ t(rand(1), 0, 0) Deep(n - 1) ] else : X.\n")
PATIENCE = 120


def area():
    return next(a for a in bpy.context.window_manager.windows[0].screen.areas if a.type == "VIEW_3D")


def context():
    window = bpy.context.window_manager.windows[0]
    view = area()
    region = next(r for r in view.regions if r.type == "WINDOW")
    return bpy.context.temp_override(window=window, area=view, region=region)


def module(name):
    return sys.modules[f"gable_blender.{name}"]


def lots():
    return bpy.data.objects["Lots"]


def steps():
    """Yields a condition to wait for, or None for a moment."""
    bpy.ops.preferences.addon_install(filepath=str(ZIP))
    bpy.ops.preferences.addon_enable(module="gable_blender")
    module("preferences").get().program = str(GABLE)
    for each in list(bpy.data.objects):
        if each.type == "MESH":
            bpy.data.objects.remove(each)
    mesh = bpy.data.meshes.new("Lots")
    mesh.from_pydata([(0, 0, 0), (460, 0, 0), (460, 460, 0), (0, 460, 0)], [], [(0, 1, 2, 3)])
    obj = bpy.data.objects.new("Lots", mesh)
    bpy.context.scene.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    # A short path, for the picture.
    examples = Path(tempfile.mkdtemp()) / "examples"
    os.symlink(ROOT / "examples", examples)
    obj.gable.rules = str(examples / "castle" / "castle.cga")
    obj.gable.seed = 5
    space = area().spaces.active
    space.show_region_ui = True
    space.clip_end = 5000
    yield None
    running = module("run").running
    with context():
        assert bpy.ops.gable.generate("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    assert list(running) == ["Lots"]
    yield lambda: not running
    assert module("build").generations("Lots"), "no model came out in the background"
    yield from esc(running)
    yield from undone()
    yield from pictured(space)


def esc(running):
    """Esc ends a long generation, and what was there stays."""
    before = len(bpy.data.objects)
    slow = OUT / "slow.cga"
    slow.write_text(SLOW)
    rules = lots().gable.rules
    lots().gable.rules = str(slow)
    with context():
        assert bpy.ops.gable.generate("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    work = running["Lots"]
    yield lambda: work.job is not None
    yield None
    assert running, "it ended by itself"
    folder = work.job.folder
    window = bpy.context.window_manager.windows[0]
    window.event_simulate("ESC", "PRESS", x=300, y=300)
    window.event_simulate("ESC", "RELEASE", x=300, y=300)
    yield lambda: not running
    assert not os.path.exists(folder), "its folder is still there"
    assert len(bpy.data.objects) == before, "the model has changed"
    lots().gable.rules = rules
    with context():
        bpy.ops.gable.load()


def undone():
    """Undo takes the model away, redo brings it back."""
    with context():
        bpy.ops.ed.undo_push(message="rules")
        bpy.ops.gable.clear()
        bpy.ops.ed.undo_push(message="clear")
        nothing = (len(bpy.data.objects), len(bpy.data.meshes), len(bpy.data.materials))
        bpy.ops.gable.generate("INVOKE_DEFAULT")
    yield lambda: not module("run").running
    assert len(bpy.data.objects) > nothing[0]
    with context():
        bpy.ops.ed.undo()
        assert (len(bpy.data.objects), len(bpy.data.meshes), len(bpy.data.materials)) == nothing
        bpy.ops.ed.redo()
    assert len(bpy.data.objects) > nothing[0]


def pictured(space):
    """The panel beside the model."""
    from mathutils import Quaternion
    space.shading.type = "SOLID"
    space.shading.color_type = "MATERIAL"
    space.shading.show_cavity = True
    space.overlay.show_overlays = False
    view = space.region_3d
    view.view_location, view.view_distance = (238, 225, 8), 250
    view.view_rotation = Quaternion((1, 0, 0), 1.05)
    # The tab of Gable, in a window of 1280 x 800.
    window = bpy.context.window_manager.windows[0]
    for kind, value in (("MOUSEMOVE", "NOTHING"), ("LEFTMOUSE", "PRESS"), ("LEFTMOUSE", "RELEASE")):
        window.event_simulate(kind, value, x=1044, y=555)
        yield None
    area().tag_redraw()
    yield None
    yield None
    with context():
        bpy.ops.screen.screenshot(filepath=str(OUT / "panel.png"))


class Walk:
    def __init__(self):
        self.steps, self.wanted, self.since = steps(), None, time.monotonic()

    def __call__(self):
        try:
            if self.wanted is not None and not self.wanted():
                assert time.monotonic() - self.since < PATIENCE, "waited too long"
                return 0.1
            self.wanted, self.since = next(self.steps), time.monotonic()
            return 0.5
        except StopIteration:
            print("window: passed", flush=True)
            status = 0
        except BaseException:
            traceback.print_exc()
            status = 1
        sys.stdout.flush()
        os._exit(status)


# Nothing of the person's settings, and no greeting over the page.
bpy.context.preferences.view.show_splash = False
bpy.app.timers.register(Walk(), first_interval=1.0, persistent=True)
