#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""The tools do what they say."""
import json
import os
import re
import shutil
import struct
import subprocess
import tempfile
import unittest
import zlib
from pathlib import Path

import coverage
import figures
import gen_docs
import glb_bytes
import install_docs
import new_op
import noise
import rule_library
import run_tests
import shrink_png
from checks import ops
from checks.tree import Tree

ROOT = Path(__file__).resolve().parent.parent


class FolderCase(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()


class NewOpTest(FolderCase):
    def testWritesACompleteTripletThatCompiles(self):
        paths = new_op.create(self.root, "build", "roofDome")
        self.assertEqual([p.name for p in paths],
                         ["roof_dome.cpp", "roof_dome.test", "roof_dome.md"])
        self.assertEqual(ops.check(Tree(self.root)), [])
        compiled = subprocess.run([os.environ.get("CXX", "g++"), "-std=c++20", "-fsyntax-only", "-Wall",
                                   "-Wextra", "-Werror", f"-I{ROOT}/src", str(paths[0])],
                                  capture_output=True, text=True, check=False)
        self.assertEqual(compiled.stderr, "")

    def testLeavesAnExistingOperationAlone(self):
        new_op.create(self.root, "build", "roofDome")
        self.assertEqual(new_op.create(self.root, "other", "roofDome"), [])


class FiguresTest(FolderCase):
    def testCountsCyclesAndCopies(self):
        for name, text in {"a.h": '#include "b.h"\n', "b.h": '#include "c.h"\n', "c.h": '#include "b.h"\n'}.items():
            (self.root / "src").mkdir(exist_ok=True)
            (self.root / "src" / name).write_text(text, encoding="utf-8")
        self.assertEqual(figures.cycles(figures.includes(Tree(self.root), ["src/a.h", "src/b.h", "src/c.h"])), 2)
        lines = [f"call({i});" for i in range(figures.COPY)]
        self.assertEqual(figures.copied(["\n".join(lines), "\n".join(lines + ["other();"])]), (16, 17))
        self.assertEqual(figures.copied(["\n".join(lines), "\n".join(lines[1:])]), (0, 15))
        self.assertEqual(figures.spread([3, 1, 2]), (2, 3, 3))


class CoverageTest(FolderCase):
    """The page of what is covered cannot claim what is not there."""
    CASE = "# Reference: extrude\n== rises\nrule:\n  Lot --> extrude(3)\nexpect:\n  leaves 1\n"

    def problems(self, rows, case=CASE, known=("extrude", "taper")):
        for path, text in {"src/ops/extrude.test": case, "src/lang/sema/notes.cpp": "", "tests/cases/a.test": "",
                           coverage.DATA: json.dumps({kind: rows if kind == "operations" else []
                                                      for kind in coverage.TITLES})}.items():
            (self.root / path).parent.mkdir(parents=True, exist_ok=True)
            (self.root / path).write_text(text, encoding="utf-8")
        catalogue = {"operations": [{"name": n} for n in known], "functions": [], "attributes": []}
        made = coverage.Coverage(self.root, catalogue)
        self.page = made.make()
        return "\n".join(made.problems)

    def testNamesTheCaseThatChecks(self):
        self.assertEqual(self.problems([{"name": "extrude"}]), "")
        self.assertIn("| `extrude` | whole | reference numbers: [rises](../../src/ops/extrude.test) |", self.page)

    def testWantsACheckForEachNameThatIsKnown(self):
        self.assertIn("nothing checks taper", self.problems([{"name": "extrude"}, {"name": "taper"}]))
        self.assertEqual(self.problems([{"name": "extrude"}, {"name": "union"}]), "")
        self.assertIn("| `union` | missing |", self.page)

    def testBelievesNoClaimThatIsNotTrue(self):
        extrude = {"name": "extrude"}
        self.assertIn("does not use it", self.problems([extrude], self.CASE.replace("extrude(3)", "taper(3)")))
        self.assertIn("is no name", self.problems([extrude], self.CASE.replace("Reference: extrude", "Reference: grow")))
        self.assertIn("no file", self.problems([extrude | {"checked": [{"by": "own test", "test": "gone.cpp: it"}]}]))
        self.assertIn("has no rose", self.problems([extrude | {"checked": [
            {"by": "own test", "test": "src/ops/extrude.test: rose"}]}]))
        self.assertIn("knows it", self.problems([extrude | {"missing": True}]))
        self.assertIn("does not know it", self.problems([extrude, {"name": "union", "lacks": "holes"}]))
        self.assertIn("belong together", self.problems([extrude | {"readings": ["one", "two"]}]))


class NoiseTest(unittest.TestCase):
    def setUp(self):
        self.flat = [[(100, 100, 100)] * 16 for _ in range(12)]
        self.lines = [[(60 + 80 * (x % 2),) * 3 for x in range(16)] for _ in range(12)]

    def testEqualPicturesAreWithoutError(self):
        self.assertEqual(noise.error(self.lines, self.lines), 0)
        self.assertAlmostEqual(noise.similarity(self.lines, self.lines), 1)

    def testErrorsAreMeasuredInLevels(self):
        self.assertAlmostEqual(noise.error(self.lines, self.flat), 40)
        self.assertAlmostEqual(noise.error([[(1, 2, 4)]], [[(1, 2, 1)]]), 3 ** 0.5)
        self.assertLess(noise.similarity(self.lines, self.flat), 0.1)


class ShrinkTest(FolderCase):
    def write(self, name, width, height, pixel, filtered=0):
        """An RGB picture; every row with one filter, its bytes already filtered."""
        def chunk(kind, body):
            return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
        raw = b"".join(bytes([filtered]) + bytes(v for x in range(width) for v in pixel(x, y))
                       for y in range(height))
        (self.root / name).write_bytes(
            shrink_png.SIGNATURE + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b""))
        return self.root / name

    def testKeepsFewColoursExactly(self):
        path = self.write("a.png", 4, 2, lambda x, y: (x * 10, y * 20, 7))
        width, height, rows = shrink_png.read(path)
        self.assertEqual((width, height, rows[1][3]), (4, 2, (30, 20, 7)))
        data = shrink_png.encode(width, height, rows, 256)
        parts = dict(shrink_png.chunks(data))
        palette, raw = parts[b"PLTE"], zlib.decompress(parts[b"IDAT"])
        color = raw[1 * 5 + 1 + 3] * 3
        self.assertEqual(tuple(palette[color:color + 3]), (30, 20, 7))

    def testHidesTheStepsOfSmoothPlaces(self):
        # A ramp of 200 levels with 20 colours has 19 steps in a row without a pattern.
        path = self.write("a.png", 200, 8, lambda x, y: (x, x, x))
        width, height, rows = shrink_png.read(path)
        parts = dict(shrink_png.chunks(shrink_png.encode(width, height, rows, 20)))
        raw = zlib.decompress(parts[b"IDAT"])
        steps = [sum(raw[y * 201 + x] != raw[y * 201 + x + 1] for x in range(1, 200)) for y in range(8)]
        self.assertGreater(min(steps), 30)

    def testUndoesFilters(self):
        # Filter 1 holds differences to the pixel before: a ramp is a row of ones.
        path = self.write("a.png", 5, 1, lambda x, y: (1, 2, 3), filtered=1)
        self.assertEqual(shrink_png.read(path)[2][0][4], (5, 10, 15))

    def testGivesUpPixelsToMeetTheLimit(self):
        path = self.write("a.png", 64, 64, lambda x, y: (x * 37 % 256, y * 91 % 256, x * y % 256))
        target = self.root / "b.png"
        done = subprocess.run(["python3", str(ROOT / "tools/shrink_png.py"), str(path), str(target), "3000"],
                              capture_output=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertLessEqual(target.stat().st_size, 3000)


class GlbBytesTest(unittest.TestCase):
    def testCountsEveryByteOnce(self):
        # Two primitives of one interleaved vertex buffer: a position, padding, a normal.
        document = {
            "accessors": [
                {"bufferView": 0, "componentType": 5123, "count": 10, "type": "VEC3"},
                {"bufferView": 0, "byteOffset": 8, "componentType": 5120, "count": 10, "type": "VEC3"},
                {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
                {"bufferView": 1, "byteOffset": 12, "componentType": 5123, "count": 3, "type": "SCALAR"}],
            "bufferViews": [{"byteLength": 120, "byteStride": 12}, {"byteLength": 20}, {"byteLength": 100}],
            "images": [{"bufferView": 2}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2},
                                       {"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 3}]}]}
        text = json.dumps(document, separators=(",", ":")).encode()
        data = struct.pack("<IIIII", 0x46546C67, 2, 0, len(text), 0x4E4F534A) + text + bytes(8 + 240)
        counted = glb_bytes.bytes_by_kind(data)
        self.assertEqual([counted[k] for k in ("POSITION", "NORMAL", "indices", "images")], [80, 40, 18, 100])
        self.assertEqual(sum(counted.values()), len(data))


class RunTestsTest(FolderCase):
    def testTellsSkippedFromFailed(self):
        (self.root / "tests.xml").write_text("""<testsuite>
          <testcase name="a" time="0.1" status="run"><system-out>fine</system-out></testcase>
          <testcase name="b" time="0.2" status="fail"><failure message=""/><system-out>bad</system-out></testcase>
          <testcase name="c" time="0" status="notrun"><skipped message="SKIP_RETURN_CODE=77"/></testcase>
          <testcase name="d" time="0" status="notrun"><skipped message="Unable to find executable"/></testcase>
        </testsuite>""")
        states = {name: state for name, state, *_ in run_tests.results(self.root / "tests.xml")}
        self.assertEqual(states, {"a": "passed", "b": "failed", "c": "skipped", "d": "failed"})

    def testARunThatEndsWithoutResultsFails(self):
        self.assertEqual(run_tests.summarise([], 8, ["ctest: no such folder"]), 1)
        self.assertEqual(run_tests.summarise([], 0, []), 1)
        self.assertEqual(run_tests.summarise([("a", "passed", 0.1, "")], 0, []), 0)
        self.assertEqual(run_tests.summarise([("a", "passed", 0.1, "")], 8, ["stopped"]), 1)


class InstallDocsTest(FolderCase):
    def testLinksOfTheInstallationLeadSomewhere(self):
        shutil.copytree(ROOT / "examples", self.root / "examples")
        install_docs.write(self.root)
        links = 0
        for page in self.root.rglob("*.md"):
            for found in install_docs.PARTS.finditer(page.read_text(encoding="utf-8")):
                target = (found[3] or "").split("#")[0]
                if target and not re.match(r"\w+:", target):
                    links += 1
                    self.assertTrue((page.parent / target).exists(), f"{page}: {target}")
        self.assertGreater(links, 500)
        extrude = (self.root / "docs/reference/operations/split.md").read_text(encoding="utf-8")
        self.assertIn("](split.png)", extrude)
        readme = (self.root / "README.md").read_text(encoding="utf-8")
        self.assertIn("](docs/guide/first-rules.md)", readme)
        self.assertNotIn("](docs/dev/architecture.md)", readme)
        self.assertIn("](materials/house.cga)", (self.root / "docs/guide/materials.md").read_text(encoding="utf-8"))


class RuleLibraryTest(FolderCase):
    def testListsWhatIsExplainedOrCalled(self):
        rules = self.root / "examples/rules"
        rules.mkdir(parents=True)
        (rules / "things.cga").write_text(
            '/* Things of\n   a street. */\nattr tone = "#ff0000" // Of the cloth.\n// ---- What hangs ----\n'
            "// As wide as\n// the wall.\n@StartRule\n@Label(\"awning\") Awning(out, tone = 3) --> X.\nHidden --> X.\n@Label(\"x\") Stand --> Hidden\n")
        (self.root / "examples/other.cga").write_text('import t : "/gable/rules/things.cga"\nLot --> t.Stand\n')
        text = rule_library.rule_library(self.root)
        self.assertIn("## things.cga\n\nThings of a street.\n", text)
        self.assertIn('| `tone` | `"#ff0000"` | Of the cloth. |', text)
        self.assertIn("| `Awning(out, [tone])` | As wide as the wall. |\n| `Stand` |  |", text)
        self.assertNotIn("Hidden", text)


class GenDocsTest(unittest.TestCase):
    def testDescribesAnOperation(self):
        entry = {"name": "dome", "summary": "Makes a dome.", "overloads": [
            {"params": [{"name": "r", "type": "float", "doc": "Radius | metres."},
                        {"name": "n", "type": "float", "doc": "Steps.", "default": "8"}]}]}
        text = gen_docs.entry_text(entry, heading=False)
        self.assertIn("dome(r, [n])", text)
        self.assertIn("| `r` | float |  | Radius \\| metres. |", text)
        self.assertIn("| `n` | float | `8` | Steps. |", text)

    def testFindsTheSourceOfEachName(self):
        reference = gen_docs.Reference({})
        self.assertEqual(reference.source_of("ops", "t").stem, "translate_scope")
        self.assertIsNone(reference.source_of("ops", "noSuchOperation"))
        self.assertEqual(len(reference.problems), 1)


if __name__ == "__main__":
    unittest.main()
