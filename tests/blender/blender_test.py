# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""The add-on in Blender itself, without a screen. tools/partners.sh runs it:

    blender -b --factory-startup --python-exit-code 1 --python tests/blender/blender_test.py -- ZIP GABLE OUT

ZIP is installed and enabled as a person would; OUT takes the pictures and the saved files.
"""
import json
import os
import shutil
import sys
import time
import unittest
from pathlib import Path

import addon_utils
import bpy
import numpy as np
from mathutils import Vector

ROOT = Path(__file__).resolve().parents[2]
ZIP, GABLE, OUT = (Path(p).resolve() for p in sys.argv[sys.argv.index("--") + 1:][:3])
NAME = "gable_blender"
LEGACY = bpy.app.version < (4, 2, 0)


def install():
    if LEGACY:
        bpy.ops.preferences.addon_install(filepath=str(ZIP))
        bpy.ops.preferences.addon_enable(module=NAME)
        return NAME
    bpy.ops.extensions.package_install_files(filepath=str(ZIP), repo="user_default", enable_on_install=True)
    return f"bl_ext.user_default.{NAME}"


MODULE = install()


def module(name):
    return sys.modules[f"{MODULE}.{name}"]


def empty():
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=False)
    bpy.ops.ed.undo_push(message="empty")


def plane(points, faces=None, name="Lots"):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([tuple(p) for p in points], [], faces or [tuple(range(len(points)))])
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    bpy.context.view_layer.update()
    return obj


def rectangle(width, depth):
    return plane([(0, 0, 0), (width, 0, 0), (width, depth, 0), (0, depth, 0)])


def write_rules(name, text):
    path = OUT / name
    path.write_text(text)
    return str(path)


def generate():
    return bpy.ops.gable.generate()


def blocks():
    return {kind: len(getattr(bpy.data, kind))
            for kind in ("objects", "meshes", "materials", "images", "collections", "node_groups", "texts")}


def made(obj):
    return module("build").generations(obj.name)


def bounds(collections):
    """Of all vertices in the world."""
    bpy.context.view_layer.update()
    boxes = [bounds_of(o) for c in collections for o in c.objects if o.data]
    return (np.min([low for low, _ in boxes], axis=0).tolist(), np.max([high for _, high in boxes], axis=0).tolist())


def bounds_of(obj):
    points = np.empty(len(obj.data.vertices) * 3, np.float32)
    obj.data.vertices.foreach_get("co", points)
    matrix = np.array(obj.matrix_world)
    world = points.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]
    return world.min(axis=0).round(3).tolist(), world.max(axis=0).round(3).tolist()


def triangles(collections):
    return sum(len(o.data.polygons) for c in collections for o in c.objects if o.data)


def render(path, eye, target, lens=32, size=(640, 400)):
    """A small picture by Cycles: sun and sky."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 24
    scene.cycles.use_denoising = False
    scene.cycles.max_bounces = 3
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.render.filepath = str(path)
    scene.view_settings.view_transform = "Filmic"
    scene.view_settings.look = "Medium High Contrast"
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.data.lens, camera.data.clip_end = lens, 5000
    direction = np.array(target) - np.array(eye)
    camera.location = eye
    camera.rotation_euler = Vector(direction).to_track_quat("-Z", "Y").to_euler()
    sun = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN"))
    sun.data.energy, sun.data.angle = 3.2, 0.01
    sun.rotation_euler = (0.85, 0.1, 0.6)
    for each in (camera, sun):
        scene.collection.objects.link(each)
    scene.camera = camera
    world = bpy.data.worlds.new("Sky")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs[0].default_value = (0.5, 0.68, 0.95, 1)
    world.node_tree.nodes["Background"].inputs[1].default_value = 0.7
    scene.world = world
    bpy.ops.render.render(write_still=True)


def brightness(path):
    """Mean and spread of a picture's pixels."""
    image = bpy.data.images.load(str(path))
    pixels = np.array(image.pixels[:]).reshape(-1, 4)[:, :3]
    bpy.data.images.remove(image)
    return float(pixels.mean()), float(pixels.std())


HOUSE = """
@Group("Body", 1) @Order(2) @Range(min=3, max=30) @Description("To the eaves, in metres")
attr height = 9
@Group("Body", 1) @Order(1) @Range(min=1, max=9, stepsize=1)
attr floors = 3
@Group("Look", 2) @Color
attr tint = "#c08040"
@Group("Look", 2) @Enum("flat", "hip")
attr roof = "hip"
attr door = true
@Hidden
attr inner = 1
@StartRule
Lot --> extrude(world.y, height) color(tint) report("area", geometry.area)
        comp(f) { side : Wall | top : Roof }
Wall --> split(x) { ~3 : Bay }*
Bay --> [ primitiveCube() s('0.5, '0.5, 0.2) center(xy) color("#334455") Window. ] Plain.
Roof --> case roof == "hip" : roofHip(30) else : Flat.
"""


class Blender(unittest.TestCase):
    def setUp(self):
        empty()
        self.assertEqual(module("preferences").get().program, str(GABLE))

    def test_panel_is_made_of_annotations(self):
        obj = rectangle(12, 9)
        obj.gable.rules = write_rules("house.cga", HOUSE)
        self.assertEqual(bpy.ops.gable.load(), {"FINISHED"})
        shown = [(a.name, a.kind, a.group) for a in obj.gable.attributes]
        self.assertEqual(shown, [("floors", "whole", "Body"), ("height", "number", "Body"), ("tint", "color", "Look"),
                                 ("roof", "choice", "Look"), ("door", "flag", "Look")])
        height = obj.gable.attributes["height"]
        ui = height.id_properties_ui("value").as_dict()
        self.assertEqual((ui["min"], ui["max"], height["value"]), (3, 30, 9))
        self.assertEqual(ui["description"], "To the eaves, in metres")
        self.assertEqual([r.name for r in obj.gable.starts][0], "Lot")

    def test_house_stands_on_its_face(self):
        obj = rectangle(12, 9)
        obj.location = (100, 50, 4)
        obj.gable.rules = write_rules("house.cga", HOUSE)
        bpy.ops.gable.load()
        obj.gable.attributes["height"]["value"] = 6.0
        obj.gable.attributes["roof"].choice = "flat"
        bpy.context.view_layer.update()
        self.assertEqual(generate(), {"FINISHED"})
        low, high = bounds(made(obj))
        self.assertEqual((low[2], high[2]), (4, 10))
        self.assertTrue(100 - 0.3 < low[0] < 100 and 112 < high[0] < 112.3, (low, high))
        collection = made(obj)[0]
        self.assertEqual(json.loads(collection["gable_attributes"])["height"], "6")
        self.assertEqual(collection["gable_rule"], "Lot")
        self.assertEqual(collection["report area"], 12 * 9 * 2 + 2 * 6 * (12 + 9))
        tint = [m for m in bpy.data.materials if m.get("gable_made")]
        self.assertIn((0.527, 0.216, 0.051), [tuple(round(c, 3) for c in m.diffuse_color[:3]) for m in tint])

    def test_units_are_metres(self):
        bpy.context.scene.unit_settings.scale_length = 0.01
        obj = rectangle(1200, 900)
        obj.gable.rules = write_rules("box.cga", "@StartRule\nLot --> extrude(world.y, 5)\n")
        self.assertEqual(generate(), {"FINISHED"})
        self.assertEqual(bounds(made(obj)), ([0, 0, 0], [1200, 900, 500]))

    def test_faces_as_blender_has_them(self):
        area = "@StartRule\nLot --> report(\"area\", geometry.area) report(\"lots\", 1) extrude(world.y, 2)\n"
        ring = [(0, 0, 0), (10, 0, 0), (10, 10, 0), (0, 10, 0), (3, 3, 0), (7, 3, 0), (7, 7, 0), (3, 7, 0)]
        around = [(0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
        concave = [(0, 0, 0), (10, 0, 0), (10, 10, 0), (5, 10, 0), (5, 4, 0), (0, 4, 0)]
        for points, faces, joined, flip, lots, size in (
                (ring, around, False, False, 4, 84), (ring, around, True, False, 1, 84),
                (ring, around, True, True, 1, 84), (concave, None, False, False, 1, 70),
                ([*concave][::-1], None, False, False, 1, 70)):
            empty()
            obj = plane(points, faces)
            obj.gable.joined = joined
            if flip:
                obj.scale = (-1, 1, 1)
                bpy.context.view_layer.update()
            obj.gable.rules = write_rules("area.cga", area)
            self.assertEqual(generate(), {"FINISHED"})
            collection = made(obj)[0]
            self.assertAlmostEqual(collection["report area"], size, 3)
            self.assertEqual(collection["report lots"], lots)
            self.assertEqual(bounds([collection])[1][2], 2)

    def test_faces_and_objects_have_attributes(self):
        obj = plane([(0, 0, 0), (10, 0, 0), (20, 0, 0), (0, 10, 0), (10, 10, 0), (20, 10, 0)],
                    [(0, 1, 4, 3), (1, 2, 5, 4)])
        obj["storey"] = 4.0
        heights = obj.data.attributes.new("floors", "INT", "FACE")
        heights.data.foreach_set("value", [2, 5])
        obj.gable.rules = write_rules("floors.cga", "attr floors = 1\nattr storey = 3\n@StartRule\n"
                                      "Lot --> extrude(world.y, floors * storey)\n")
        self.assertEqual(generate(), {"FINISHED"})
        tops = [bounds_of(o)[1][2] for o in made(obj)[0].objects if o.data]
        self.assertEqual(sorted(tops), [8, 20])

    def test_hostile_faces_are_told(self):
        obj = plane([(0, 0, 0), (10, 0, 0), (0, 10, 0), (10, 10, 0)])
        obj.gable.rules = write_rules("box.cga", "@StartRule\nLot --> extrude(world.y, 5)\n")
        with self.assertRaises(RuntimeError) as told:
            generate()
        self.assertIn("crosses itself", str(told.exception))
        self.assertEqual(made(obj), [])
        for points in ([(0, 0, 0), (1, 0, 0), (2, 0, 0)], [(float("nan"), 0, 0), (1, 0, 0), (0, 1, 0)],
                       [(1e9, 0, 0), (1e9 + 1000, 0, 0), (1e9, 1000, 0)]):
            empty()
            obj = plane(points)
            obj.gable.rules = write_rules("box.cga", "@StartRule\nLot --> extrude(world.y, 5)\n")
            self.assertRaises(RuntimeError, generate)
            self.assertEqual(obj.gable.messages[0].severity, "error")

    def test_bad_rules_keep_what_was_there(self):
        obj = rectangle(12, 9)
        obj.gable.rules = write_rules("changing.cga", HOUSE)
        generate()
        before, count = bounds(made(obj)), blocks()
        write_rules("changing.cga", HOUSE.replace("extrude(world.y", "extrud(world.y"))
        with self.assertRaises(RuntimeError) as told:
            generate()
        self.assertIn("extrud", str(told.exception))
        self.assertEqual((bounds(made(obj)), blocks()), (before, count))
        message = obj.gable.messages[0]
        self.assertTrue(message.file.endswith("changing.cga"))
        self.assertEqual(message.line, 1 + HOUSE[:HOUSE.index("extrude(")].count("\n"))
        self.assertIn("did you mean 'extrude'", message.hint)
        bpy.ops.gable.open(number=0)
        self.assertEqual(bpy.data.texts[0].current_line_index, message.line - 1)

    def test_rules_are_checked_and_read(self):
        obj = rectangle(10, 10)
        obj.gable.rules = write_rules("checked.cga", "@StartRule\nLot --> extrude(world.y, 5)\n")
        for ask in (bpy.ops.gable.check, bpy.ops.gable.load):
            write_rules("checked.cga", "@StartRule\nLot --> extrude(world.y, 5)\n")
            self.assertEqual(ask(), {"FINISHED"})
            self.assertEqual(len(obj.gable.messages), 0)
            write_rules("checked.cga", "@StartRule\nLot --> extrud(world.y, 5)\n")
            with self.assertRaises(RuntimeError) as told:
                ask()
            self.assertIn("checked.cga:2: there is no operation or rule 'extrud'", str(told.exception))
            obj.gable.rules = str(OUT / "missing.cga")
            with self.assertRaises(RuntimeError) as told:
                ask()
            self.assertIn("missing.cga", str(told.exception))
            obj.gable.rules = str(OUT / "checked.cga")

    def test_values_that_are_no_numbers_and_long_names(self):
        obj = rectangle(10, 10)
        obj["height"] = float("nan")
        for name, kind in (("depth", "FLOAT"), ("tint", "FLOAT_COLOR")):
            layer = obj.data.attributes.new(name, kind, "FACE")
            setattr(layer.data[0], "value" if kind == "FLOAT" else "color", float("inf") if kind == "FLOAT" else [float("nan")] * 4)
        long = "\u00e4" * 40
        obj.gable.rules = write_rules("odd.cga", "attr height = 5\nattr depth = 1\nattr tint = \"#ff0000\"\n@StartRule\n"
                                      f'Lot --> report("{long}", height) extrude(world.y, height * depth) color(tint)\n')
        self.assertEqual(generate(), {"FINISHED"})
        self.assertEqual({m.text.split("'")[1] for m in obj.gable.messages}, {"height", "depth", "tint"})
        self.assertEqual(made(obj)[0]["report " + long[:28]], 5)

    def test_a_program_that_goes_away_ends_the_run(self):
        obj = rectangle(10, 10)
        obj.gable.rules = write_rules("box.cga", "@StartRule\nLot --> extrude(world.y, 5)\n")
        run = module("run")
        find, run.find_program = run.find_program, lambda: str(OUT / "gone")
        try:
            obj.gable.attributes.add().name = "a"
            obj.gable.loaded = obj.gable.rules
            with self.assertRaises(RuntimeError) as told:
                generate()
            self.assertIn("cannot be run", str(told.exception))
            self.assertEqual(run.running, {})
        finally:
            run.find_program = find

    def test_regeneration_and_removal_leave_nothing(self):
        obj = rectangle(12, 9)
        obj.gable.rules = write_rules("house.cga", HOUSE)
        nothing = blocks()
        generate()
        one = blocks()
        obj.gable.seed = 3
        generate()
        self.assertEqual(blocks(), one)
        self.assertEqual((obj.display_type, obj.hide_render), ("WIRE", True))
        bpy.ops.gable.clear()
        self.assertEqual(blocks(), nothing)
        self.assertEqual((obj.display_type, obj.hide_render), ("TEXTURED", False))

    def test_undo_leaves_nothing_behind(self):
        obj = rectangle(12, 9)
        obj.gable.rules = write_rules("house.cga", HOUSE)
        bpy.ops.gable.load()
        bpy.ops.ed.undo_push(message="lots")
        nothing = blocks()
        generate()
        self.assertGreater(blocks()["objects"], nothing["objects"])
        bpy.ops.ed.undo()
        self.assertEqual(blocks(), nothing)
        bpy.ops.ed.redo()
        self.assertEqual(len(made(bpy.data.objects["Lots"])), 1)

    def test_variations_stand_side_by_side(self):
        obj = rectangle(10, 10)
        obj.gable.rules = write_rules("any.cga", "@StartRule\nLot --> extrude(world.y, rand(3, 20))\n")
        obj.gable.count = 3
        self.assertEqual(bpy.ops.gable.vary(), {"FINISHED"})
        found = sorted(made(obj), key=lambda c: c["gable_seed"])
        boxes = [bounds([c]) for c in found]
        self.assertEqual([c["gable_seed"] for c in found], [0, 1, 2])
        self.assertEqual([low[0] for low, _ in boxes], [0, 11.5, 23])
        self.assertEqual(len({high[2] for _, high in boxes}), 3)

    def test_live_follows_rules_and_attributes(self):
        look = module("live").look
        obj = rectangle(10, 10)
        obj.gable.rules = write_rules("live.cga", "attr height = 5\n@StartRule\nLot --> extrude(world.y, height)\n")
        generate()
        obj.gable.live = True
        look()
        self.assertEqual(look(), [])
        obj.gable.attributes["height"]["value"] = 7.0
        self.assertEqual(look(), [])
        self.assertEqual(look(), ["Lots"])
        self.assertEqual(bounds(made(obj))[1][2], 7)
        time.sleep(0.02)
        write_rules("live.cga", "attr height = 5\nattr more = 2\n@StartRule\nLot --> extrude(world.y, height + more)\n")
        look()
        self.assertEqual(look(), ["Lots"])
        self.assertEqual((bounds(made(obj))[1][2], "more" in obj.gable.attributes), (9, True))
        self.assertEqual((look(), look()), ([], []))
        obj.data.vertices[2].co.x = 20
        obj.data.update()
        bpy.context.view_layer.update()
        self.assertEqual((look(), look()), (["Lots"], []))
        self.assertEqual(bounds(made(obj))[1][0], 20)

    def test_missing_and_old_programs_are_told(self):
        obj = rectangle(10, 10)
        obj.gable.rules = write_rules("box.cga", "@StartRule\nLot --> extrude(world.y, 5)\n")
        preferences = module("preferences").get()
        old = OUT / "old-gable"
        old.write_text("#!/bin/sh\necho gable 0.0.9\n")
        old.chmod(0o755)
        try:
            for path, words in ((str(OUT / "none"), "there is no file"), (str(old), "0.1.0 or newer")):
                preferences.program = path
                with self.assertRaises(RuntimeError) as told:
                    generate()
                self.assertIn(words, str(told.exception))
                self.assertIn("preferences", obj.gable.messages[0].hint)
        finally:
            preferences.program = str(GABLE)

    def test_cancelled_run_ends_the_program_and_its_folder(self):
        run = module("run")
        obj = rectangle(10, 10)
        obj.gable.rules = write_rules("long.cga", "@StartRule\nLot --> Deep(40)\nDeep(n) --> case n > 0 : "
                                      "[ t(rand(1), 0, 0) Deep(n - 1) ] [ t(rand(1), 0, 0) Deep(n - 1) ] else : X.\n")
        before = blocks()
        work = run.Run(obj)
        self.assertFalse(work.step())
        folder, process = work.job.folder, work.job._process
        time.sleep(0.2)
        bpy.ops.gable.cancel()
        self.assertIsNotNone(process.poll())
        self.assertFalse(os.path.exists(folder))
        self.assertEqual((blocks(), run.running), (before, {}))

    def test_textures(self):
        shutil.copy(ROOT / "docs" / "guide" / "diff.png", OUT / "wall.png")
        obj = rectangle(10, 8)
        obj.gable.rules = write_rules("wall.cga", "@StartRule\nLot --> extrude(world.y, 6) comp(f) { side : Wall }\n"
                                      "Wall --> setupProjection(0, scope.xy, 3, 3) projectUV(0) texture(\"wall.png\")\n")
        self.assertEqual(generate(), {"FINISHED"})
        image = next(i for i in bpy.data.images if i.get("gable_made"))
        self.assertIsNotNone(image.packed_file)
        self.assertGreater(image.size[0], 100)
        mesh = next(o.data for o in made(obj)[0].objects if o.data)
        uvs = np.empty(len(mesh.loops) * 2, np.float32)
        mesh.uv_layers[0].data.foreach_get("uv", uvs)
        self.assertAlmostEqual(float(uvs.max()), 10 / 3, 3)

    def _example(self, name, obj, eye, target, lens):
        start = time.time()
        self.assertEqual(generate(), {"FINISHED"})
        seconds = time.time() - start
        found = made(obj)
        objects = [o for o in found[0].objects if o.data]
        shared = len(objects) - len({o.data for o in objects})
        facts = triangles(found), len(objects), shared, bounds(found)
        print(f"{name}: {facts[0]} triangles in {len(objects)} objects, {shared} of them linked copies, "
              f"{len(bpy.data.materials)} materials, in {seconds:.1f} s")
        path = str(OUT / f"{name}.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path, compress=True)
        bpy.ops.wm.read_homefile(use_empty=True)
        bpy.ops.wm.open_mainfile(filepath=path)
        obj = bpy.data.objects["Lots"]
        found = made(obj)
        objects = [o for o in found[0].objects if o.data]
        self.assertEqual((triangles(found), len(objects), shared, bounds(found)), facts)
        self.assertEqual(obj.gable.loaded, obj.gable.rules)
        render(OUT / f"{name}.png", eye, target, lens)
        mean, spread = brightness(OUT / f"{name}.png")
        self.assertTrue(0.1 < mean < 0.9 and spread > 0.08, (mean, spread))
        return found

    def test_castle(self):
        obj = rectangle(460, 460)
        obj.gable.rules = str(ROOT / "examples" / "castle" / "castle.cga")
        obj.gable.seed = 5
        self._example("castle", obj, (196, 18, 76), (229, 222, 7), 33)

    def test_haussmann(self):
        points, faces, kinds = haussmann_lots()
        obj = plane(points, faces)
        for name in ("setting", "use"):
            layer = obj.data.attributes.new(name, "STRING", "FACE")
            for item, kind in zip(layer.data, kinds):
                item.value = kind.get(name, "")
        obj.gable.rules = str(ROOT / "examples" / "haussmann" / "haussmann.cga")
        found = self._example("haussmann", obj, (88, -62, 38), (2, 4, 9), 49)
        self.assertIn("Dormer", {o.get("gable_rule") for o in found[0].objects})

    def test_zz_leaves_with_the_add_on(self):
        bpy.ops.preferences.addon_disable(module=MODULE)
        self.assertFalse(hasattr(bpy.types.Object, "gable"))
        bpy.ops.preferences.addon_enable(module=MODULE)
        self.assertTrue(addon_utils.check(MODULE)[1])


def haussmann_lots():
    """The lots of the example, in metres about their middle."""
    from math import cos, radians
    with open(ROOT / "examples" / "haussmann" / "buildings.geojson", encoding="utf-8") as file:
        features = json.load(file)["features"]
    rings = [f["geometry"]["coordinates"][0][:-1] for f in features if f["geometry"]["type"] == "Polygon"]
    middle = np.mean([p for ring in rings for p in ring], axis=0)
    scale = np.array([cos(radians(middle[1])), 1]) * 111_195
    points, faces = [], []
    for ring in rings:
        flat = (np.array(ring) - middle) * scale
        faces.append(tuple(range(len(points), len(points) + len(flat))))
        points += [(x, y, 0) for x, y in flat]
    return points, faces, [f["properties"] for f in features]


if __name__ == "__main__":
    OUT.mkdir(parents=True, exist_ok=True)
    module("preferences").get().program = str(GABLE)
    only = sys.argv[sys.argv.index("--") + 4:]
    names = [f"Blender.{n}" for n in only] or None
    suite = unittest.defaultTestLoader.loadTestsFromNames(names or ["Blender"], sys.modules["__main__"])
    result = unittest.TextTestRunner(verbosity=2).run(suite)
    sys.exit(0 if result.wasSuccessful() else 1)
