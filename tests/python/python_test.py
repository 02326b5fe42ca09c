# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""The Python module, as a script uses it.

    python_test.py BUILD

BUILD holds python/gable. The examples of docs/guide/python.md are run one after the other, too.
"""
import datetime
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import typing
import unittest
import warnings
import zipfile
from pathlib import Path

from interpreter import SKIP, with_numpy

ROOT = Path(__file__).resolve().parents[2]


if __name__ == "__main__":
    with_numpy()
    BUILD = Path(sys.argv.pop(1)).resolve()
    sys.path.insert(0, str(BUILD / "python"))

import numpy as np  # noqa: E402
import numpy.typing  # noqa: E402

import gable  # noqa: E402
import gable.prt as pyprt  # noqa: E402

BOX = '@StartRule\nLot --> extrude(height) report("kind", "box") report("h", height) comp(f) { all : Face }\nattr height = 4\n'
# Some hundred million shapes, none like another.
LONG = "@StartRule\nLot --> split(x) { ~1 : A(0) }*\nA(n) --> case n > 26 : B else : split(x) { ~rand(1, 2) : A(n + 1) | ~1 : A(n + 1) }\n"


class Square:
    __geo_interface__ = {
        "type": "MultiPolygon",
        "coordinates": [
            [[(0, 0), (10, 0), (10, 10), (0, 10), (0, 0)], [(2, 2), (2, 4), (4, 4), (4, 2), (2, 2)]],
            [[(20, 0), (30, 0), (30, 10), (20, 0)]],
        ],
    }


class Rules(unittest.TestCase):
    def test_what_is_in_rules(self):
        rules = gable.Rules.parse("@Range(min=1, max=9)\nattr h = 3\nattr names = [\"a\"]\n@StartRule\nLot --> extrude(h)\n")
        self.assertEqual([(a.name, a.type, a.range) for a in rules.attributes],
                         [("h", "float", (1.0, 9.0)), ("names", "string[]", None)])
        season = gable.Rules.parse('@Enum("spring", "autumn", restricted=true)\nattr season = "spring"\nLot --> X.\n')
        self.assertEqual(season.attributes[0].choices, ["spring", "autumn"])
        self.assertEqual(rules.attributes[0].choices, [])
        self.assertEqual(rules.start_rule, "Lot")
        self.assertEqual([(r.name, r.start, r.line) for r in rules.rules], [("Lot", True, 5)])
        self.assertEqual(rules.styles, ["Default"])

    def test_all_mistakes_are_told(self):
        with self.assertRaises(gable.Error) as raised:
            gable.Rules.parse("Lot --> extrud(3)\nB --> t(0, 0)\n", "a.cga")
        places = [(m.code, m.file, m.line) for m in raised.exception.messages if m.severity == "error"]
        self.assertEqual(places[0], ("unknown-operation", "a.cga", 1))
        self.assertIn("a.cga:2", str(raised.exception))

    def test_rules_that_come_with_gable_and_other_projects(self):
        rules = gable.Rules.parse('import trees : "/gable/rules/trees.cga"\n@StartRule\nLot --> trees.Plant("oak", 9)\n')
        self.assertFalse([m for m in rules.messages if m.severity == "warning"], rules.messages)
        self.assertGreater(len(gable.derive(rules, gable.Shapes.lot(9, 9))), 1)
        with tempfile.TemporaryDirectory() as folder:
            for name in ("one", "two"):
                (Path(folder) / name / "rules").mkdir(parents=True)
            (Path(folder) / "two/rules/roof.cga").write_text("Top --> Two.\n", encoding="utf-8")
            main = Path(folder) / "one/rules/a.cga"
            main.write_text('import roof : "/two/rules/roof.cga"\n@StartRule\nLot --> roof.Top\n', encoding="utf-8")
            for where in ({"workspace": folder}, {"libraries": [Path(folder) / "two"]}):
                model = gable.derive(gable.Rules.load(main, **where), gable.Shapes.lot(9, 9))
                self.assertEqual(model.leaf(0).name, "Two")
            self.assertIn("import-not-found", [m.code for m in gable.Rules.load(main).messages])

    def test_a_file_that_is_not_there(self):
        with self.assertRaisesRegex(gable.Error, "nowhere.cga"):
            gable.Rules.load(Path("nowhere.cga"))


class BadInput(unittest.TestCase):
    def test_is_named(self):
        rules, lot = gable.Rules.parse(BOX), gable.Shapes.lot(9, 9)
        for kind, words, call in (
            (TypeError, "shapes is a gable.Shapes, not list", lambda: gable.derive(rules, [1, 2])),
            (TypeError, "rules is a gable.Rules, not str", lambda: gable.derive("a.cga", lot)),
            (ValueError, "jobs is 1 or more, not 0", lambda: gable.derive(rules, lot, jobs=0)),
            (ValueError, "seconds is 0 or more, not -1", lambda: gable.derive(rules, lot, seconds=-1)),
            (ValueError, "width is a number of metres above 0, not -1", lambda: gable.Shapes.lot(-1, 2)),
            (ValueError, "depth is a number of metres above 0, not nan", lambda: gable.Shapes.lot(1, float("nan"))),
            (ValueError, "at least 3 points, not 2", lambda: gable.Shapes.polygon([(0, 0), (1, 1)])),
            (ValueError, "a picture is a .png, not 'x.xyz'", lambda: gable.derive(rules, lot).picture("x.xyz")),
            (ValueError, "style is one of photo, clay, blueprint, ink, section, not 'oil'",
             lambda: gable.derive(rules, lot).picture("x.png", style="oil")),
            (TypeError, "'start_rule' may be meant", lambda: gable.derive(rules, lot, start="Lot")),
            (TypeError, "given as profile", lambda: gable.derive(rules, lot).write("x.glb", for_="godot")),
            (TypeError, "of_geometries() takes polygons of shapely", lambda: gable.Shapes.polygon(Square())),
            (TypeError, "a GeoDataFrame of geopandas, not dict", lambda: gable.Shapes.of_frame({})),
            (ValueError, "point 0 has 3; mesh()", lambda: gable.Shapes.polygon([(0, 0, 1), (1, 0, 1), (1, 1, 1)])),
            (ValueError, "vertex 1 has 2", lambda: gable.Shapes.mesh([(0, 0, 0), (1, 1)], [])),
            (ValueError, "2 geometries, and attributes for 1", lambda: gable.Shapes.of_geometries([Square()] * 2, [{"height": 1}])),
        ):
            with self.subTest(words), self.assertRaisesRegex(kind, re.escape(words)):
                call()
        for words, ring in (("crosses itself", [(0, 0), (9, 9), (9, 0), (0, 9)]), ("has no area", [(0, 0), (5, 0), (9, 0)])):
            self.assertIn(words, gable.Shapes.polygon(ring).messages[0].message)
        self.assertEqual(lot.messages, [])


class Warned(unittest.TestCase):
    """Warnings reach Python's `warnings`, each once, and `messages`."""

    def told(self, call, times=1):
        """What is told of by default, as text, with its places."""
        gable._messages._shown.clear()
        with warnings.catch_warnings(record=True) as all:
            warnings.simplefilter("default")
            for _ in range(times):
                result = call()
        self.assertTrue(all and {w.category for w in all} == {gable.Warning}, all)
        return result, all

    def test_a_derivation_tells_place_and_hint_once(self):
        rules = gable.Rules.parse('attr picture = "nowhere.png"\n@StartRule\nLot --> extrude(4) texture(picture) X.\n', "house.cga")
        model, all = self.told(lambda: gable.derive(rules, gable.Shapes.lot(9, 9)), times=3)
        self.assertEqual(len(all), 1, [str(w.message) for w in all])
        told = all[0].message.message
        self.assertIn(told, model.messages)
        self.assertIn("nowhere.png", told.message)
        self.assertTrue(told.hint and told.hint in str(all[0].message))
        self.assertEqual((all[0].filename, all[0].lineno), (told.file, told.line))
        self.assertEqual((told.file, told.line), ("house.cga", 3))

    def test_an_operation_without_a_meaning_for_its_shape(self):
        rules = gable.Rules.parse("@StartRule\nLot --> extrude(4) comp(e) { all : roofHip(30) X. }\n", "edges.cga")
        model, all = self.told(lambda: gable.derive(rules, gable.Shapes.lot(9, 9)), times=2)
        self.assertEqual([w.message.message for w in all], [m for m in model.messages if m.severity == "warning"])
        self.assertEqual(len({str(w.message) for w in all}), len(all))

    def test_rules_shapes_and_files(self):
        _, all = self.told(lambda: gable.Rules.parse("@StartRule\nLot --> Facade\n", "leaf.cga"))
        self.assertEqual((all[0].filename, all[0].lineno), ("leaf.cga", 2))
        # Where no rule is to blame the place is that of the caller.
        _, all = self.told(lambda: gable.Shapes.polygon([(0, 0), (9, 9), (9, 0), (0, 9)]), times=2)
        self.assertEqual((len(all), all[0].filename), (1, __file__))

    def test_they_can_be_errors_and_silent(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error", gable.Warning)
            with self.assertRaisesRegex(gable.Warning, "crosses itself"):
                gable.Shapes.polygon([(0, 0), (9, 9), (9, 0), (0, 9)])
            warnings.simplefilter("ignore", gable.Warning)
            gable.Shapes.polygon([(0, 0), (9, 9), (9, 0), (0, 9)])

    def test_degrees_in_the_place_of_metres(self):
        paris = [(2.3501, 48.8501), (2.3503, 48.8501), (2.3503, 48.8503), (2.3501, 48.8503)]
        shapes, all = self.told(lambda: gable.Shapes.polygon(paris))
        self.assertEqual([m.code for m in shapes.messages], ["shape-degrees"])
        self.assertIn("Shapes.of_frame", str(all[0].message))
        square = {"type": "Polygon", "coordinates": [paris]}
        _, all = self.told(lambda: gable.Shapes.of_geometries([square, square]))
        self.assertEqual(len(all), 1)
        for metres in ([(0, 0), (0.2, 0), (0.2, 0.2)], [(500, 100), (500.01, 100), (500, 100.01)]):
            self.assertEqual(gable.Shapes.polygon(metres).messages, [])
        self.assertEqual(gable.Shapes.lot(0.05, 0.05).messages, [])

    def test_names_that_the_rules_do_not_have(self):
        rules = gable.Rules.parse(BOX)
        lots = gable.Shapes.joined([gable.Shapes.lot(9, 9)] * 2)
        named = lots.with_attributes([{"heigth": 3, "height": 4, "cityPart": "Building"}, {"colour": "red"}])
        model, all = self.told(lambda: gable.derive(rules, named[1:]))
        self.assertEqual([m.code for m in model.messages if m.severity == "warning"], ["unknown-attribute"])
        self.assertIn("colour, heigth", str(all[0].message))
        self.assertIn("heigth may be meant as height", str(all[0].message))
        self.assertEqual([m for m in gable.derive(rules, lots.with_attributes([{"height": 4}])).messages
                          if m.severity == "warning"], [])
        # The columns of a table are not all for the rules.
        table = gable.Shapes.of_geometries([Square()], [{"height": 7, "owner": "x"}])
        self.assertNotIn("unknown-attribute", [m.code for m in gable.derive(rules, table).messages])
        with self.assertRaisesRegex(ValueError, "2 shapes, and attributes for 3"):
            lots.with_attributes([{}] * 3)


class Typed(unittest.TestCase):
    def test_arrays_are_what_their_types_say(self):
        names = {"np": np, "NDArray": np.typing.NDArray}
        model = gable.derive(gable.Rules.parse(BOX.replace("Face }", "Face. }")), gable.Shapes.lot(2, 3))
        mesh, parts = model.mesh(), model.parts()
        found = [(gable.Mesh, vars(mesh)), (gable.Parts, vars(parts)), (gable.PartMesh, parts.meshes[0]),
                 (gable.Outline, gable.Shapes.lot(2, 3).outline(0)._asdict())]
        seen = 0
        for kind, values in found:
            hints = typing.get_type_hints(kind, localns={**names, **vars(gable)})
            self.assertEqual(set(hints), set(values))
            for name, hint in hints.items():
                if typing.get_origin(hint) is np.ndarray:
                    wanted = typing.get_args(typing.get_args(hint)[1])[0]
                    self.assertEqual(values[name].dtype, wanted, f"{kind.__name__}.{name}")
                    seen += 1
        self.assertEqual(seen, 6 + 4 + 5 + 1)
        self.assertTrue((BUILD / "python/gable/py.typed").exists())


class Numbers(unittest.TestCase):
    def test_of_no_shape_are_told(self):
        lot = gable.Shapes.lot(9, 9)
        model = gable.derive(gable.Rules.parse(BOX), lot)
        self.assertEqual(len(model.attributes(0)), len(gable.Rules.parse(BOX).attributes))
        for number in (1, 7, -1):
            with self.assertRaisesRegex(IndexError, f"made of 1 shapes, none of number {number}"):
                model.attributes(number)
            with self.assertRaisesRegex(IndexError, f"there are 1 shapes, none of number {number}"):
                lot.outline(number)


class Documented(unittest.TestCase):
    def test_all_that_is_public_has_a_docstring(self):
        for name in gable.__all__:
            value = getattr(gable, name)
            self.assertTrue(value.__doc__, name)
            for member, each in vars(value).items() if isinstance(value, type) else ():
                if not member.startswith("_") and (callable(each) or isinstance(each, (property, classmethod))):
                    self.assertTrue(each.__doc__, f"{name}.{member}")


class Shapes(unittest.TestCase):
    def test_reports_by_shape(self):
        lots = gable.Shapes.joined([gable.Shapes.lot(9, 9), gable.Shapes.lot(4, 4)]).with_attributes([{"height": 3}, {"height": 5}])
        model = gable.derive(gable.Rules.parse(BOX), lots)
        self.assertEqual([s.reports["h"].sum for s in model.reports_by_shape], [3, 5])
        self.assertEqual(model.reports["h"].sum, 8)

    def test_of_geometries(self):
        shapes = gable.Shapes.of_geometries([Square()], [{"height": 7}])
        self.assertEqual(len(shapes), 2)
        self.assertAlmostEqual(shapes.outline(0).area, 96)
        self.assertEqual(shapes.outline(1).ring.shape, (3, 2))
        model = gable.derive(gable.Rules.parse(BOX), shapes)
        self.assertEqual(model.attributes(1)["height"], 7)

    def test_of_a_frame(self):
        class Column(list):
            name = "geometry"
            def translate(self, x, y):
                return self
        class Frame:
            crs = None
            geometry = Column([Square()])
            columns = ["geometry", "height", "other"]
            total_bounds = (0, 0, 30, 10)
            def set_geometry(self, geometry):
                return self
            def __len__(self):
                return 1
            def __getitem__(self, columns):
                assert columns == ["height", "other"]
                return self
            def itertuples(self, index, name):
                return iter([(8.0, float("nan"))])
        model = gable.derive(gable.Rules.parse(BOX), gable.Shapes.of_frame(Frame()))
        self.assertEqual(model.attributes(0)["height"], 8)

    def test_what_a_frame_has_that_no_rule_can_have(self):
        class Missing:
            def __eq__(self, other):
                return self
            __ne__ = __eq__
            __hash__ = None
            def __bool__(self):
                raise TypeError("boolean value of NA is ambiguous")
        Missing.__name__ = "NAType"
        class Column(list):
            name = "geometry"
            def translate(self, x, y):
                return self
        class Frame(list):
            crs = None
            geometry = Column([Square(), None, Square()])
            columns = ["height", "built", "geometry"]
            total_bounds = (0, 0, 30, 10)
            def set_geometry(self, geometry):
                return self
            def __getitem__(self, columns):
                return self
            def itertuples(self, index, name):
                return iter(self)
        day = datetime.date(1900, 1, 1)
        with warnings.catch_warnings(record=True) as all:
            warnings.simplefilter("always")
            gable._messages._shown.clear()
            shapes = gable.Shapes.of_frame(Frame([(Missing(), day), (3, day), (np.int64(7), None)]))
        told = [str(w.message) for w in all if w.category is gable.Warning]
        self.assertIn("the column 'built' is left out", told[0])
        self.assertIn("row 1 is left out: it has no geometry", told[1])
        self.assertEqual(len(shapes), 4)
        model = gable.derive(gable.Rules.parse(BOX), shapes)
        self.assertEqual([model.attributes(i)["height"] == 7 for i in range(4)], [False, False, True, True])

    def test_a_ring_may_repeat_its_first_point(self):
        square, hole = [(0, 0), (12, 0), (12, 10), (0, 10)], [(2, 2), (4, 2), (4, 4)]
        rules = gable.Rules.parse("@StartRule\nLot --> roofGable(30) X.\n")
        closed = gable.Shapes.polygon(square + square[:1], [hole + hole[:1]])
        self.assertEqual(closed.messages, [])
        models = [gable.derive(rules, s) for s in (gable.Shapes.polygon(square, [hole]), closed)]
        self.assertEqual(*[m.encode("glb") for m in models])

    def test_other_geometries_are_refused(self):
        with self.assertRaisesRegex(TypeError, "Point"):
            gable.Shapes.of_geometries([{"type": "Point", "coordinates": (0, 0)}])

    def test_arrays(self):
        ring = np.array([[0, 0], [10, 0], [10, 10]], dtype=np.float32)
        self.assertAlmostEqual(gable.Shapes.polygon(ring).outline(0).area, 50)
        cube = gable.Shapes.mesh(np.eye(3), np.array([[0, 1, 2]]))
        self.assertEqual(len(cube), 1)
        with self.assertRaisesRegex(gable.Error, "vertex 7"):
            gable.Shapes.mesh(np.eye(3), [[0, 1, 7]])

    def test_some_of_them(self):
        lots = gable.Shapes.joined([gable.Shapes.lot(w, 1) for w in (1, 2, 3)])
        self.assertEqual([round(lots[i].outline(0).area) for i in (0, -1)], [1, 3])
        self.assertEqual(len(lots[1:]), 2)
        with self.assertRaisesRegex(IndexError, "3 shapes"):
            lots[3]

    def test_hostile_values(self):
        lot = gable.Shapes.lot(1, 1)
        for value in (object(), None, [1, object()], [[1, 2], [3]], {"a": 1}):
            with self.assertRaises(TypeError, msg=repr(value)):
                lot.with_attributes([{"height": value}])
        with self.assertRaisesRegex(gable.Error, "height"):
            lot.with_attributes([{"height": [1, "a"]}])
        for ring in ([(float("nan"), 0), (1, 0), (1, 1)], [(1e300, 0), (1, 0), (1, 1)]):
            with self.assertRaises(gable.Error):
                gable.Shapes.polygon(ring)


class Derivation(unittest.TestCase):
    def setUp(self):
        self.rules = gable.Rules.parse(BOX)

    def test_attributes_of_every_kind(self):
        rules = gable.Rules.parse(
            "attr n = 1\nattr b = false\nattr s = \"\"\nattr l = [1]\nattr m = [1]\nattr t = [\"\"]\n@StartRule\n"
            "Lot --> print(n) print(b) print(s) print(l) print(m) print(t)\n")
        model = gable.derive(rules, gable.Shapes.lot(1, 1), n=np.float32(2), b=np.True_, s="12", l=[1, 2],
                             attributes={"m": np.arange(4).reshape(2, 2), "t": ["x", "y"]})
        self.assertEqual(model.attributes(0), {"n": 2, "b": True, "s": "12", "l": [1, 2], "m": [[0, 1], [2, 3]],
                                               "t": ["x", "y"]})
        with self.assertRaisesRegex(gable.Error, "height"):
            gable.derive(self.rules, gable.Shapes.lot(1, 1), height="high")

    def test_the_mesh_is_the_box(self):
        mesh = gable.derive(self.rules, gable.Shapes.lot(2, 3), height=5).mesh()
        self.assertEqual(mesh.positions.dtype, np.float64)
        self.assertEqual(mesh.triangles.shape, (12, 3))
        corners = mesh.positions[mesh.triangles]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        self.assertAlmostEqual(np.einsum("ij,ij->", corners[:, 0], normals) / 6, 30)
        unit = normals / np.linalg.norm(normals, axis=1)[:, None]
        np.testing.assert_allclose(unit, mesh.normals[mesh.triangles[:, 0]], atol=1e-6)
        self.assertEqual(sorted(set(mesh.leaf.tolist())), list(range(6)))

    def test_parts_are_the_same_model(self):
        rules = gable.Rules.parse("@StartRule\nLot --> extrude(4) split(x) { ~1 : B }*\nB --> s('0.5, '1, '1) rotateScope(0, 30, 0) i(\"builtin:cube\")\n")
        model = gable.derive(rules, gable.Shapes.lot(6, 3))
        mesh, parts = model.mesh(), model.parts()
        self.assertEqual(len(parts.mesh), len(model))
        at = 0
        for number, which in enumerate(parts.mesh):
            own = parts.meshes[which]["positions"]
            t = parts.transform[number]
            world = t[:3] + own @ t[3:].reshape(3, 3)
            np.testing.assert_allclose(world, mesh.positions[at : at + len(own)], atol=1e-9)
            at += len(own)
        self.assertEqual(at, len(mesh.positions))

    def test_reports_leaves_files(self):
        model = gable.derive(self.rules, gable.Shapes.lot(2, 3), height=5)
        self.assertEqual(model.reports["h"].mean, 5)
        self.assertEqual(model.reports["kind"].values, {"box": 1})
        leaf = model.leaf(0)
        self.assertEqual((leaf.name, leaf.rule, leaf.line), ("Face", "Lot", 2))
        with self.assertRaises(IndexError):
            model.leaf(6)
        with self.assertRaises(IndexError):
            model.leaf(-1)
        self.assertEqual(model.encode("glb")[:4], b"glTF")
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "a.obj"
            self.assertEqual(model.write(path), path.stat().st_size + (Path(folder) / "a.mtl").stat().st_size)
            self.assertEqual(len(gable.Model.load(path).mesh().triangles), 12)
            with self.assertRaisesRegex(gable.Error, "a.xyz"):
                model.write(Path(folder) / "a.xyz")
        with self.assertRaisesRegex(ValueError, "instancing"):
            model.write("a.glb", instancing="some")
        with self.assertRaisesRegex(ValueError, "did you mean 'godot'"):
            model.write("a.glb", profile="godt")
        with self.assertRaisesRegex(ValueError, "from 0 to 3"):
            model.write("a.glb", lods=4)
        with self.assertRaisesRegex(gable.Error, "a.obj"):
            model.write("a.obj", collision="box")

    def test_a_profile_is_that_of_the_command_line(self):
        model = gable.derive(self.rules, gable.Shapes.lot(2, 3), height=5)
        for profile, collision in (("godot", b"-colonly"), ("unreal", b"UCX_")):
            self.assertIn(collision, model.encode("glb", profile=profile, lods=0))
        self.assertIn(b"-convcolonly", model.encode("glb", profile="godot", collision="hull"))
        self.assertNotIn(b"collision", model.encode("glb", profile="blender"))

    def test_the_same_for_any_number_of_threads(self):
        lots = gable.Shapes.joined([gable.Shapes.lot(w, 5) for w in range(1, 20)])
        one, four = (gable.derive(self.rules, lots, jobs=jobs).encode("glb") for jobs in (1, 4))
        self.assertEqual(one, four)

    def test_limits_keep_what_was_made(self):
        model = gable.derive(gable.Rules.parse(LONG), gable.Shapes.lot(10, 10), seconds=0.2)
        self.assertFalse(model.is_whole)
        self.assertTrue(model.messages)

    def test_progress_and_what_it_raises(self):
        lots = gable.Shapes.joined([gable.Shapes.lot(w, 5) for w in range(1, 50)])
        told = []
        gable.derive(self.rules, lots, progress=lambda done, total: told.append((done, total)))
        self.assertEqual(told[-1], (49, 49))
        class Enough(Exception):
            pass
        def stop(done, total):
            raise Enough
        with self.assertRaises(Enough):
            gable.derive(self.rules, lots, progress=stop)

    def test_other_threads_run_meanwhile(self):
        counted = []
        over = threading.Event()
        def count():
            while not over.is_set():
                counted.append(1)
                time.sleep(0.01)
        thread = threading.Thread(target=count)
        thread.start()
        gable.derive(gable.Rules.parse(LONG), gable.Shapes.lot(10, 10), seconds=0.5)
        over.set()
        thread.join()
        self.assertGreater(len(counted), 5)

    def test_interrupt(self):
        script = ("import sys, gable\nprint('ready', flush=True)\ntry:\n"
                  f"    gable.derive(gable.Rules.parse({LONG!r}), gable.Shapes.lot(10, 10))\n"
                  "except KeyboardInterrupt:\n    print('stopped')\n")
        with subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True,
                              env={**os.environ, "PYTHONPATH": str(BUILD / "python")}) as process:
            self.assertEqual(process.stdout.readline(), "ready\n")
            time.sleep(0.3)
            process.send_signal(signal.SIGINT)
            self.assertEqual(process.communicate(timeout=60)[0], "stopped\n")


    def test_a_picture_ends_by_what_its_progress_raises(self):
        class Enough(Exception):
            pass
        def stop(done, total):
            raise Enough
        model = gable.derive(self.rules, gable.Shapes.lot(9, 9))
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "a.png"
            with self.assertRaises(Enough):
                model.picture(path, width=800, height=600, samples=4000, progress=stop)
            self.assertFalse(path.exists())
            model.picture(path, width=64, height=48, style="ink")
            ink = path.read_bytes()
            model.picture(path, width=64, height=48, samples=2, lighting="direct")
            self.assertNotEqual(path.read_bytes(), ink)


class OfPyPrt(unittest.TestCase):
    def test_names_that_are_not_heeded(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "a.cga"
            path.write_text(BOX, encoding="utf-8")
            square = np.array([[0, 0, 0], [0, 0, 10], [10, 0, 10], [10, 0, 0]])
            with warnings.catch_warnings(record=True) as all:
                warnings.simplefilter("always")
                pyprt.ModelGenerator([pyprt.InitialShape(square)]).generate_model(
                    [{"heigth": 3}], path, pyprt.PY_ENCODER, {"emitReports": True})
            told = [str(w.message) for w in all]
            self.assertTrue(any("'emitReports' is not heeded; 'emitReport'" in t for t in told), told)
            self.assertTrue(any("'heigth'; 'height'" in t for t in told), told)

    def test_one_set_of_attributes_for_all(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "a.cga"
            path.write_text(BOX + "@Hidden\nattr secret = 1\n", encoding="utf-8")
            square = [0, 0, 0, 0, 0, 10, 10, 0, 10, 10, 0, 0]
            shapes = [pyprt.InitialShape(square), pyprt.InitialShape(square, [0, 1, 2, 3], [4])]
            self.assertEqual((shapes[1].get_vertex_count(), shapes[1].get_index_count()), (12, 4))
            models = pyprt.ModelGenerator(shapes).generate_model([{"height": 3.0}], path, pyprt.PY_ENCODER, {})
            self.assertEqual([m.get_initial_shape_index() for m in models], [0, 1])
            self.assertEqual(models[1].get_attributes()["height"], 3)
            self.assertEqual(models[0].get_report(), {"kind": "box", "h_n": 1, "h_sum": 3, "h_avg": 3, "h_min": 3,
                                                      "h_max": 3})
            self.assertEqual(sum(models[0].get_faces()), len(models[0].get_indices()))
            self.assertEqual(pyprt.inspect_rpk(path), {"height": "float"})
            obj = "com.esri.prt.codecs.OBJEncoder"
            out = pyprt.ModelGenerator(shapes).generate_model(
                [{"outputPath": folder, "shapeName": n} for n in "ab"], path, obj, {})
            self.assertEqual(out, [])
            self.assertTrue((Path(folder) / "a_0.obj").exists() and (Path(folder) / "b_1.obj").exists())
            with self.assertWarnsRegex(UserWarning, "heigth"):
                pyprt.ModelGenerator(shapes).generate_model([{"heigth": 3.0}], path)
            with self.assertRaisesRegex(ValueError, "3 attribute"):
                pyprt.ModelGenerator(shapes).generate_model([{}] * 3, path)
            with self.assertRaisesRegex(ValueError, "no encoder"):
                pyprt.ModelGenerator(shapes).generate_model([{}], path, "other", {})


class Datasets(unittest.TestCase):
    rules = gable.Rules.parse(BOX.replace("Lot -->", '@Label("box")\nLot -->'))
    small = {"count": 2, "cameras": 2, "size": (24, 20), "samples": 1, "height": 6}

    def files(self, folder):
        return {p.relative_to(folder): p.read_bytes() for p in Path(folder).rglob("*") if p.is_file()}

    def test_the_same_in_one_go_and_in_parts(self):
        with tempfile.TemporaryDirectory() as folder:
            whole, parts = Path(folder) / "whole", Path(folder) / "parts"
            told = []
            made = gable.dataset(self.rules, gable.Shapes.lot(9, 5), whole, labels="label", jobs=2,
                                 progress=lambda done, total: told.append((done, total)), **self.small)
            self.assertEqual((made.items, made.made, made.done, made.is_whole, told[-1]), (4, 4, 4, True, (4, 4)))
            first = gable.dataset(self.rules, gable.Shapes.lot(9, 5), parts, labels="label", shard=(1, 2), **self.small)
            self.assertEqual((first.made, first.is_whole), (2, False))
            rest = gable.dataset(self.rules, gable.Shapes.lot(9, 5), parts, labels="label", jobs=1, **self.small)
            self.assertEqual((rest.made, rest.is_whole), (2, True))
            self.assertEqual(self.files(whole), self.files(parts))
            coco = json.loads((whole / "coco.json").read_text())
            self.assertEqual([c["name"] for c in coco["categories"]], ["box"])
            self.assertEqual(len(coco["annotations"]), 4)

    def test_labels_by_tag_in_direct_light(self):
        rules = gable.Rules.parse('@StartRule\nLot --> tag("ground") X\nX --> extrude(4) comp(f) { top : tag("roof") Y. | all : Z. }')
        with tempfile.TemporaryDirectory() as folder:
            small = {name: value for name, value in self.small.items() if name != "height"}
            gable.dataset(rules, gable.Shapes.lot(9, 5), folder, labels="tag", tags=["roof", "ground"], lighting="direct", **small)
            coco = json.loads((Path(folder) / "coco.json").read_text())
            self.assertEqual([c["name"] for c in coco["categories"]], ["roof", "ground"])
            self.assertEqual({a["category_id"] for a in coco["annotations"]}, {1, 2})

    def test_mistakes(self):
        lot = gable.Shapes.lot(9, 5)
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaisesRegex(TypeError, "'labels' may be meant"):
                gable.dataset(self.rules, lot, folder, lables="tag")
            with self.assertRaisesRegex(ValueError, "labels"):
                gable.dataset(self.rules, lot, folder, labels="colour")
            with self.assertRaisesRegex(ValueError, "count"):
                gable.dataset(self.rules, lot, folder, count=0)
            for wrong, code in (({"model": "doc"}, "dataset-settings"), ({"shard": (2, 2)}, "dataset-settings"),
                                ({"size": (0, 4)}, "picture-size"), ({"attributes": {"heigth": 3}}, "unknown-attribute")):
                with self.assertRaises(gable.Error) as raised:
                    gable.dataset(self.rules, lot, Path(folder) / "x", **{**self.small, **wrong})
                self.assertEqual(raised.exception.messages[0].code, code)

    def test_progress_and_what_it_raises(self):
        class Enough(Exception):
            pass
        def stop(done, total):
            raise Enough
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaises(Enough):
                gable.dataset(self.rules, gable.Shapes.lot(9, 5), folder, progress=stop, **{**self.small, "count": 50})
            self.assertFalse((Path(folder) / "coco.json").exists())


class Package(unittest.TestCase):
    def test_every_example_of_the_guide(self):
        page = (ROOT / "docs/guide/python.md").read_text(encoding="utf-8")
        blocks = re.findall(r"```python\n(.*?)```", page, re.S)
        self.assertGreater(len(blocks), 5)
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                names = {}
                for block in blocks:
                    exec(compile(block, "python.md", "exec"), names)
                self.assertTrue(Path("house.png").exists())
            finally:
                os.chdir(before)

    def test_the_wheel(self):
        sys.path.insert(0, str(ROOT / "python"))
        import build_wheel
        with tempfile.TemporaryDirectory() as folder:
            name = build_wheel.write_wheel(folder, BUILD / "python" / "gable")
            with zipfile.ZipFile(Path(folder) / name) as wheel:
                names = wheel.namelist()
                self.assertIn("gable/__init__.py", names)
                self.assertTrue(any(n.startswith("gable/_gable") and n.endswith(".so") for n in names))
                wheel.extractall(Path(folder) / "installed")
            script = "import gable; print(len(gable.derive(gable.Rules.parse('@StartRule\\nLot --> extrude(1)'), gable.Shapes.lot(1, 1))))"
            out = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True,
                                 env={**os.environ, "PYTHONPATH": str(Path(folder) / "installed")})
            self.assertEqual(out.stdout, "1\n")

    def test_all_that_is_public_is_told(self):
        for name in gable.__all__:
            self.assertTrue(getattr(gable, name).__doc__, name)


if __name__ == "__main__":
    unittest.main()
