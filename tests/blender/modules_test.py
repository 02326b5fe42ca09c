# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""The add-on for Blender, as far as it needs no Blender: attributes, lots, models, messages, command lines.

    modules_test.py GABLE

tests/blender/blender_test.py tests the rest in Blender itself.
"""
import math
import os
import subprocess
import sys
import tempfile
import time
import unittest
import unittest.mock
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SKIP = 77


def with_numpy():
    """Runs this again under Debian's interpreter, where this one has no numpy: Blender has it."""
    try:
        import numpy  # noqa: F401
        return
    except ImportError:
        pass
    other = "/usr/bin/python3"
    if os.path.exists(other) and subprocess.run([other, "-c", "import numpy"], capture_output=True).returncode == 0:
        os.execv(other, [other, "-B", *sys.argv])
    print("skipped: numpy is not installed (Debian's python3-numpy)")
    sys.exit(SKIP)


if __name__ == "__main__":
    with_numpy()
    GABLE = str(Path(sys.argv.pop(1)).resolve())
    sys.path[:0] = [str(ROOT / "blender"), str(ROOT / "tools")]

import numpy as np  # noqa: E402
import pack_blender  # noqa: E402
from gable_blender import attributes, command, glb, job, lots, messages, program  # noqa: E402


def info(*rows, values=None):
    """(name, type, {annotation: arguments}) as `gable info --json` gives them."""
    return {"values": values or {}, "attributes": [
        {"name": name, "type": kind, "hidden": "Hidden" in notes,
         "annotations": [{"name": n, "arguments": a} for n, a in notes.items()]} for name, kind, notes in rows]}


def lot(points, *outlines, triangles=None):
    outlines = [list(o) for o in outlines] or [list(range(len(points)))]
    fans = triangles or [(o[0], o[i], o[i + 1]) for o in outlines for i in range(1, len(o) - 1)]
    return lots.Lot("lot 1", np.array(points, float), np.array(fans), outlines)


SQUARE = [(0, 0, 0), (10, 0, 0), (10, 10, 0), (0, 10, 0)]
YARD = [*SQUARE, (3, 3, 0), (7, 3, 0), (7, 7, 0), (3, 7, 0)]
AROUND = [(0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]


class Attributes(unittest.TestCase):
    def test_kinds_and_ranges(self):
        found = {c.name: c for c in attributes.controls(info(
            ("a", "float", {"Range": [["min", "1"], ["max", "3"], ["stepsize", "1"]]}),
            ("b", "float", {"Range": [["", "0.5"], ["", "2"]]}),
            ("c", "string", {"Color": []}), ("d", "string", {"Enum": [["", "x"], ["", "y"], ["restricted", "true"]]}),
            ("e", "string", {"File": []}), ("f", "string", {"Directory": []}), ("g", "bool", {}),
            ("h", "float[]", {}), ("i", "string", {"Color": []}), ("j", "float", {"Range": [["min", "9"], ["max", "1"]]}),
            values={"a": 2, "b": 1.5, "c": "#a0B0c0", "i": "reddish"}))}
        self.assertEqual({n: c.kind for n, c in found.items()},
                         {"a": "whole", "b": "number", "c": "color", "d": "choice", "e": "file", "f": "folder",
                          "g": "flag", "h": "text", "i": "text", "j": "number"})
        self.assertEqual((found["a"].minimum, found["a"].maximum, found["a"].bounded), (1, 3, True))
        self.assertEqual((found["b"].minimum, found["b"].maximum), (0.5, 2))
        self.assertEqual(found["d"].choices, ["x", "y"])
        self.assertFalse(found["j"].bounded)
        self.assertIsNone(found["d"].default)

    def test_order_and_groups(self):
        found = attributes.controls(info(
            ("z", "float", {}), ("b", "float", {"Group": [["", "B"], ["order", "2"]], "Order": [["", "2"]]}),
            ("c", "float", {"Group": [["", "B"], ["order", "2"]], "Order": [["", "1"]]}), ("h", "float", {"Hidden": []}),
            ("a", "float", {"Group": [["", "A"], ["", "Inner"], ["order", "1"]]}), ("towers.wallHeight", "float", {})))
        self.assertEqual([(c.name, c.group) for c in found],
                         [("a", "A / Inner"), ("c", "B"), ("b", "B"), ("z", ""), ("towers.wallHeight", "Towers")])
        self.assertEqual(found[-1].label, "towers: Wall height")

    def test_values_as_texts(self):
        self.assertEqual([attributes.text_of(v) for v in (True, 3.0, 2.5, 0.1 + 0.2, "x", [1, 2])],
                         ["true", "3", "2.5", "0.3", "x", "[1, 2]"])
        self.assertEqual(attributes.hex_of(attributes.color_of("#a08060")), "#a08060")
        self.assertEqual(attributes.color_of("none"), (1, 1, 1))
        for odd in (math.nan, math.inf, -math.inf):
            self.assertTrue(math.isnan(attributes.value_of_color((0, odd, 1))))
        self.assertEqual(attributes.value_of_color((0, 2, 1, math.nan)), "#00ffff")

    def test_start_rules(self):
        rules = [{"name": n, "parameters": p, "hidden": h, "start": s} for n, p, h, s in
                 (("A", 0, False, False), ("Lot", 0, False, True), ("B", 1, False, False), ("C", 0, True, False),
                  ("in.D", 0, False, False))]
        self.assertEqual(attributes.start_rules({"startRule": "Lot", "rules": rules}), ["Lot", "A"])


class Messages(unittest.TestCase):
    def test_what_the_program_prints(self):
        found = messages.of_text("a b.cga:3:9: error: there is no 'extrud' [unknown-operation]\n  Lot --> extrud\n"
                                 "          ^^^\n  hint: did you mean 'extrude'?\nwarning: it is empty [empty-model]\n"
                                 "gable: --seed takes a number\nsomething else\n")
        self.assertEqual([(m.severity, m.file, m.line, m.code) for m in found],
                         [("error", "a b.cga", 3, "unknown-operation"), ("warning", "", 0, "empty-model"), ("error", "", 0, "")])
        self.assertEqual(found[0].sentence(), "a b.cga:3: there is no 'extrud' (did you mean 'extrude'?)")

    def test_errors_come_first_and_once(self):
        warning, error = messages.Message("warning", "w"), messages.Message("error", "e")
        self.assertEqual(messages.ordered([warning, error, warning]), [error, warning])

    def test_files_below_the_project(self):
        with tempfile.TemporaryDirectory() as folder:
            rules = Path(folder, "project", "rules", "main.cga")
            rules.parent.mkdir(parents=True)
            rules.write_text("")
            self.assertEqual(messages.locate("rules/main.cga", str(rules)), str(rules))
            self.assertEqual(messages.locate("none.cga", str(rules)), "")


class Lots(unittest.TestCase):
    def test_faults(self):
        bow = [(0, 0, 0), (10, 0, 0), (0, 10, 0), (10, 10, 0)]
        for points, words in ((SQUARE, ""), (bow, "crosses itself"), ([(0, 0, 0), (1, 0, 0), (2, 0, 0)], "no area"),
                              ([(0, 0, float("inf")), *SQUARE], "not a number"), ([(1e8, 0, 0), *SQUARE], "km from")):
            self.assertIn(words, lots.fault_of(lot(points)) or "")
            self.assertEqual(bool(words), bool(lots.fault_of(lot(points))))

    def test_caveats(self):
        good, faults, caveats = lots.sort_out([lot([*SQUARE][::-1]), lot([*SQUARE[:3], (0, 10, 3)]), lot(SQUARE[:2] * 2)])
        self.assertEqual((len(good), len(faults)), (2, 1))
        self.assertIn("turned up", caveats[0])
        self.assertIn("bent", caveats[1])
        self.assertEqual(good[0].triangles[0].tolist(), [2, 1, 0])

    def test_values_that_are_no_numbers_are_left_out(self):
        three = [lot(SQUARE) for _ in range(3)]
        for each, attribute in zip(three, (math.nan, 4.5, math.inf)):
            each.attributes = {"height": attribute, "kind": "a", "flag": True, "count": 3}
        self.assertRaises(ValueError, lots.to_glb, three)
        self.assertEqual(lots.leave_out_values(three),
                         ["the attribute 'height' of lot 1 and 1 more is infinite or not a number"])
        self.assertEqual([each.attributes.get("height") for each in three], [None, 4.5, None])
        self.assertEqual(three[0].attributes, {"kind": "a", "flag": True, "count": 3})
        self.assertEqual(lots.leave_out_values(three), [])
        self.assertNotIn(b"NaN", lots.to_glb(three))

    def test_islands(self):
        self.assertEqual(lots.islands([[0, 1, 2], [10, 11, 12], [2, 1, 3], [3, 4, 5]]), [[0, 2], [1], [3]])


class Runs(unittest.TestCase):
    """With the program itself."""

    def run_rules(self, text, all_lots, **wishes):
        with tempfile.TemporaryDirectory() as folder:
            rules = os.path.join(folder, "rules.cga")
            Path(rules).write_text(text)
            work = job.Job(GABLE, command.Wishes(rules, **wishes), lots.to_glb(all_lots))
            try:
                while (outcome := work.poll()) is None:
                    time.sleep(0.01)
                model = glb.read(Path(outcome.model).read_bytes()) if outcome.ok else None
            finally:
                work.close()
            self.assertFalse(os.path.exists(work.folder))
            return outcome, model

    def test_faces_around_a_hole_are_one_lot(self):
        outcome, model = self.run_rules('@StartRule\nLot --> report("area", geometry.area) extrude(world.y, 2)\n',
                                        [lot(YARD, *AROUND)])
        self.assertEqual(outcome.statistics["reports"]["area"]["sum"], 84)
        mesh = model.meshes[0]
        self.assertEqual((len(mesh.positions), len(mesh.triangles), mesh.smooth.any()), (16, 32, False))
        self.assertEqual((mesh.positions.min(axis=0).tolist(), mesh.positions.max(axis=0).tolist()), ([0, 0, 0], [10, 10, 2]))

    def test_attributes_and_places_of_lots(self):
        first, second = lot(SQUARE), lot(np.array(SQUARE) + [500_000.25, 20, 3])
        first.name, first.attributes, second.attributes = "first lot", {"height": 4, "kind": "a"}, {"height": 7.5}
        _, model = self.run_rules('attr height = 1\nattr kind = "b"\n@StartRule\nLot --> extrude(world.y, height)\n'
                                  '  color(case kind == "a" : "#ff0000" else : "#0000ff")\n', [first, second])
        self.assertEqual([n.name for n in model.nodes], ["first lot", "lot 1"])
        tops = [(n.matrix @ [*model.meshes[n.mesh].positions.max(axis=0), 1])[:3].round(3).tolist() for n in model.nodes]
        self.assertEqual(tops, [[10, 10, 4], [500_010.25, 30, 10.5]])
        self.assertEqual({m["name"] for m in model.materials}, {"#ff0000", "#0000ff"})

    def test_turned_instances(self):
        _, model = self.run_rules("@StartRule\nLot --> split(x) { ~1 : Post }* \n"
                                  "Post --> [ r(0, 30, 10) primitiveCylinder(16, 1, 3) softenNormals(80) ]\n", [lot(SQUARE)])
        shared = [n for n in model.nodes if n.mesh is not None]
        low = min((n.matrix @ [0, 0, 0, 1])[2] for n in shared)
        self.assertAlmostEqual(low, 0, 6)
        for mesh in model.meshes:
            np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=2), 1, atol=1e-5)

    def test_wrong_rules_have_no_model(self):
        outcome, model = self.run_rules("@StartRule\nLot --> extrud(3)\n", [lot(SQUARE)])
        self.assertFalse(outcome.ok)
        self.assertEqual((outcome.messages[0].line, outcome.messages[0].hint), (2, "did you mean 'extrude'?"))

    def test_answers_have_their_messages(self):
        with tempfile.TemporaryDirectory() as folder:
            wrong, right, missing = (os.path.join(folder, name) for name in ("wrong.cga", "right.cga", "missing.cga"))
            Path(wrong).write_text("@StartRule\nLot --> extrud(3)\n")
            Path(right).write_text("@StartRule\nLot --> extrude(3)\n")
            shapes = Path(folder, "lots.glb")
            shapes.write_bytes(lots.to_glb([lot(SQUARE)]))
            for line in (lambda rules: command.info(GABLE, command.Wishes(rules), shapes),
                         lambda rules: command.check(GABLE, command.Wishes(rules))):
                answer, found = job.ask(line(right), 20)
                self.assertEqual((answer["status"], found), (0, []))
                _, found = job.ask(line(wrong), 20)
                self.assertEqual([(m.severity, m.line, m.code, m.hint) for m in found],
                                 [("error", 2, "unknown-operation", "did you mean 'extrude'?")])
                _, found = job.ask(line(missing), 20)
                self.assertEqual([(m.severity, m.code) for m in found], [("error", "file-missing")])
                self.assertIn("missing.cga", found[0].text)

    def test_messages_have_no_colors(self):
        with unittest.mock.patch.dict(os.environ, {"CLICOLOR_FORCE": "1"}):
            os.environ.pop("NO_COLOR", None)
            outcome, _ = self.run_rules("@StartRule\nLot --> extrud(3)\n", [lot(SQUARE)])
        self.assertEqual([(m.severity, m.line, m.code) for m in outcome.messages], [("error", 2, "unknown-operation")])

    def test_programs_that_do_not_answer(self):
        for said in ("", "[]", "words"):
            answer, found = job.ask([sys.executable, "-c", f"print({said!r})"], 20)
            self.assertIsNone(answer)
            self.assertIn("no answer", found[0].text)

    def test_values_of_a_person_go_first(self):
        rules = "attr height = 3\nattr name = \"x\"\n@StartRule\nLot --> extrude(world.y, height) print(name)\n"
        outcome, model = self.run_rules(rules, [lot(SQUARE)], attributes={"height": "6", "name": "a=b --c"})
        self.assertEqual(model.meshes[0].positions.max(axis=0)[2], 6)
        self.assertEqual(outcome.statistics["prints"], ["a=b --c"])

    def test_names_of_reports_fit_into_blender(self):
        # Two and four bytes a letter; 56 bytes are left behind "report ".
        for letter, most in (("a", 56), ("\u00e4", 28), ("\U0001f3e0", 14)):
            outcome, _ = self.run_rules(f'@StartRule\nLot --> report("{letter * 60}", 2) extrude(world.y, 2)\n', [lot(SQUARE)])
            self.assertEqual(outcome.report_sums(), {"report " + letter * most: 2})
        self.assertEqual(job.property_name("x" + "\u00e4" * 40), "x" + "\u00e4" * 31)
        self.assertEqual(job.property_name("x\udcff"), "x?")

    def test_broken_models_are_told(self):
        for data in (b"", b"glTF" + bytes(40), b"x" * 100, lots.to_glb([lot(SQUARE)])[:-8]):
            self.assertRaises(glb.BrokenModel, glb.read, data)

    def test_work_that_fails_is_cancelled(self):
        class Work:
            steps = cancelled = 0

            def __init__(self, program, most=9):
                self.program, self.most = program, most

            def step(self):
                self.steps += 1
                if self.steps == 2:
                    job.Job(self.program, command.Wishes("none.cga"), b"").close()
                return self.steps == self.most

            def cancel(self):
                self.cancelled += 1

        work = Work("/none/gable")
        self.assertRaises(OSError, job.complete, work)
        self.assertEqual((work.steps, work.cancelled), (2, 1))
        work = Work(GABLE, 3)
        job.complete(work)
        self.assertEqual((work.steps, work.cancelled), (3, 0))

    def test_programs(self):
        self.assertEqual(program.find(GABLE, "/none")[0], GABLE)
        with tempfile.TemporaryDirectory() as folder:
            self.assertRaises(program.Unusable, program.find, "", folder, folder)
            beside = Path(folder, "gable")
            for text, words in (("echo gable 0.0.1", "is version 0.0.1"), ("echo hello", "is not the program"), ("exit 3", "is not")):
                beside.write_text(f"#!/bin/sh\n{text}\n")
                beside.chmod(0o755)
                with self.assertRaises(program.Unusable) as told:
                    program.find("", folder, "/none")
                self.assertIn(words, told.exception.text)
                self.assertTrue(told.exception.hint)


class Package(unittest.TestCase):
    def test_same_bytes_and_both_forms(self):
        with tempfile.TemporaryDirectory() as folder:
            first, second = Path(folder, "a.zip"), Path(folder, "b.zip")
            pack_blender.pack(first)
            pack_blender.pack(second)
            self.assertEqual(first.read_bytes(), second.read_bytes())
            names = zipfile.ZipFile(first).namelist()
        self.assertIn("gable_blender/__init__.py", names)
        self.assertIn("gable_blender/blender_manifest.toml", names)
        version = ".".join(str(n) for n in __import__("gable_blender").bl_info["version"])
        self.assertIn(f'version = "{version}"', (ROOT / "blender/gable_blender/blender_manifest.toml").read_text())


if __name__ == "__main__":
    unittest.main()
