#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Rule tests as users run them, with `gable test`: cases_test.py GABLE FOLDER. Run from the repository's root."""
import os
import re
import subprocess
import sys
import time
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from cli_test import DONE, FILE, GABLE, USAGE, WRONG, Case

RULES = """attr height = 12
Lot --> extrude(height) comp(f) { top : Tiles. | side : Wall }
Wall --> report("area", geometry.area) Glass.
Twins --> split(x) { ~1 : extrude(4) House. | ~1 : extrude(4) House. }
Overlapping --> [ s('0.6, 1, '1) extrude(4) House. ] t('0.4, 0, 0) s('0.6, 1, '1) extrude(4) House.
Stacked --> [ extrude(4) House. ] t(0, 4, 0) extrude(4) House.
Outside --> t(0.01, 0, 0) extrude(4) House.
"""
LIMIT = 4
GUIDE = Path("docs/guide/rule-tests.md")


def case(name, *expect, rules="rules: ../rules/tower.cga", shape="lot 20x10", start="Lot", more=""):
    lines = "".join(f"  {line}\n" for line in expect)
    return f"== {name}\n{rules}\nshape: {shape}\nstart: {start}\n{more}expect:\n{lines}\n"


class Cases(Case):
    def setUp(self):
        super().setUp()
        for name in ("rules", "tests"):
            (self.folder / name).mkdir()
        self.put("rules/tower.cga", RULES)

    def cases(self, *cases, name="tests/tower.test"):
        return self.put(name, "".join(cases))

    def testCasesOfAProjectRun(self):
        self.cases(case("one", "leaves Glass 4", "area Tiles 200", "within lot", "diagnostics none"),
                   case("imports", "leaves Glass 4", rules='rule:\n  import t : "rules/tower.cga"\n  Lot --> t.Lot'),
                   case("higher", 'report area sum 900', more="set:\n  height = 15\n"))
        self.run_gable("test", says="3 passed, 0 failed")
        self.run_gable("test", "tests", "--filter", "hi", "--jobs", "1", says="1 passed, 0 failed")
        self.run_gable("test", "tests/tower.test", "tests", says="3 passed")

    def testFailuresNameFileLineAndCase(self):
        self.cases(case("wrong", "leaves Glass 5"))
        told = self.run_gable("test", status=WRONG, says="0 passed, 1 failed")
        self.assertIn("tests/tower.test:6: wrong: leaves Glass 5: found 4", told)
        self.run_gable("test", "--filter", "nothing", status=USAGE, says="no case has 'nothing'")
        self.run_gable("test", "rules", status=USAGE, says="no .test file")
        self.run_gable("test", "none.test", status=FILE, says="none.test")
        self.run_gable("test", "--format", "html", status=USAGE, says="--format")

    def testACaseHoldsWithEachOfItsSeeds(self):
        rules = "rule: Lot --> 90% : A. else : B."
        self.cases(case("some", "leaves 1", rules=rules, more="seed: 0..19\n"))
        self.run_gable("test", says="1 passed, 0 failed")
        self.cases(case("all", "leaves A 1", rules=rules, more="seed: 0..59\n"))
        told = self.run_gable("test", status=WRONG, says="0 passed, 1 failed")
        found = re.search(r"all: with seed (\d+) and (\d+) more: leaves A 1: found 0", told)
        self.assertIsNotNone(found, told)
        # Each statement has its own count.
        self.cases(case("each", "leaves 2", "leaves A 1", rules=rules, more="seed: 0..59\n"))
        told = self.run_gable("test", status=WRONG)
        self.assertIn("each: with seed 0 and 59 more: leaves 2: found 1", told)
        self.assertIn(f"each: with seed {found[1]} and {found[2]} more: leaves A 1: found 0", told)
        self.cases(case("one", "leaves A 1", rules=rules, more=f"seed: {found[1]}\n"))
        self.run_gable("test", status=WRONG, says="one: leaves A 1: found 0")

    def testMistakesOfAFileFailIt(self):
        for text, says in (("== a\nrulez: x\n", ":2: a: expected a section"), ("== a\nseeds: 3\n", "did you mean 'seed'?"),
                           ("", "no case"),
                           ("Lot --> A.\n", "begins with '== name'"),
                           ("== a\nrule: Lot --> A.\n", "'expect'"),
                           (case("a", "leaves 1", rules="rules: ../rules/none.cga"), "none.cga"),
                           (case("a", "leaves 1", rules="rules: ../rules/tower.cga\nrule: Lot --> A."), "no place"),
                           (case("a", "leaves 1", shape="lot 3x"), ":3: a: the shape is not understood"),
                           (case("a", "leaves 1", shape="load none.obj"), "none.obj"),
                           (case("a", "leaves 1", more="seed: x\n"), "'x' is neither a number nor a range"),
                           (case("a", "leaves 1", more="seed: 9..3\n"), "neither a number nor a range"),
                           (case("a", "leaves 1", "dump", more="seed: 0..3\n"), "dump is of one model"),
                           (case("a", "leaves 1", more="limits:\n  depth -1\n"), "limit is not understood"),
                           (case("a", "leaves 1", rules="rule: Lot --> A.\nfile ../b.cga: B --> C."), "own folder"),
                           (case("a", "leafs 1"), "did you mean 'leaves'?"), (case("a", "within town"), "expected: within lot"),
                           (case("a"), "it expects nothing"),
                           (case("a", "scene none.scene"), "--update"), (case("a", "picture"), "expected: picture"),
                           (case("a", "picture none.jpg 9x0"), "expected: picture")):
            self.cases(text)
            self.run_gable("test", status=WRONG, says=says)
        self.assertFalse((self.folder / "b.cga").exists())

    def testAWrongSectionIsOfItsCaseAlone(self):
        self.cases(case("good", "leaves 1", rules="rule: Lot --> A.") + "\n"
                   + case("bad", "leaves 1", rules="rule: Lot --> A.", more="seeds:\n  3\n") + "\n"
                   + case("wrong", "leaves 2", rules="rule: Lot --> A."))
        told = self.run_gable("test", status=WRONG, says="1 passed, 2 failed")
        self.assertIn("bad: expected a section of a case, not 'seeds:'; did you mean 'seed'?", told)
        self.assertEqual(told.count("bad:"), 1, told)
        self.assertIn("wrong: leaves 2: found 1", told)

    def testWhatACaseSetsIsToldAtItsLine(self):
        rules = "rule:\n  attr height = 3\n  Lot --> extrude(height) A."
        for more, line, says in (("set:\n  height = 4\n  nothing\n", 3, "expected name = value, not 'nothing'"),
                                 ("set:\n  height = 4\n\n  hight = 5\n", 4, "did you mean 'height'?"),
                                 ("set:\n  height = tall\n", 2, "height")):
            text = case("a", "leaves 1", rules=rules, more=more)
            self.cases(text)
            first = text.splitlines().index(more.splitlines()[0])
            told = self.run_gable("test", status=WRONG, says=says)
            self.assertIn(f":{first + line}: a: ", told, more)
        for start, line in (("Lott", 6), ("\n  Lott", 7)):
            self.cases(case("a", "leaves 1", rules=rules, start=start))
            self.assertIn(f":{line}: a: ", self.run_gable("test", status=WRONG, says="did you mean 'Lot'?"))

    def testAnUprightFaceIsAShape(self):
        self.cases(case("a", "leaves Pane 8", "size Pane 3 3 0", "bounds 0 0 0  12 6 0", shape="face 12x6",
                        start="Wall",
                        rules="rule: Wall --> split(y) { 3 : split(x) { 3 : Pane. }* }*"))
        self.run_gable("test", says="1 passed, 0 failed")

    def testLeavesAreApartAndWithinTheLot(self):
        concave = "polygon 0,0 20,0 20,10 12,10 12,5 8,5 8,10 0,10"
        hole = "polygon 0,0 20,0 20,20 0,20 | 8,8 8,12 12,12 12,8"
        span = "rule: Lot --> s(20, 4, 1) i(\"builtin:cube\") House."
        for start, says in (("Twins", ""), ("Stacked", ""), ("Overlapping", "apart House: House and House share 40 square")):
            self.cases(case("apart", "apart House", start=start))
            self.run_gable("test", status=WRONG if says else DONE, says=says or "1 passed")
        for shape, rules, start, says in (
                ("lot 20x10", None, "Twins", ""), (concave, None, "Lot", ""), (hole, None, "Lot", ""),
                ("lot 20x10", None, "Outside", "House reaches 0.01 m beyond the lot"),
                (concave, span, "Lot", "beyond the lot"),
                (hole, 'rule: Lot --> i("builtin:cube") s(20, 4, 20) House.', "Lot", "covers a hole")):
            self.cases(case("within", "within lot", shape=shape, start=start, **({"rules": rules} if rules else {})))
            self.run_gable("test", status=WRONG if says else DONE, says=says or "1 passed")
        self.cases(case("none", "within lot Roof"), case("nor", "apart Roof"))
        self.run_gable("test", status=WRONG, says="there is no such leaf")

    def testExpectedFilesAreWrittenAndCompared(self):
        self.cases(case("files", "scene tower.scene", "picture tower.png front 96x64", "leaves 5", "dump"))
        self.run_gable("test", status=WRONG, says="'gable test --update' writes it")
        told = self.run_gable("test", "--update", says="1 passed, 0 failed")
        for name in ("tower.scene", "tower.png", "tower.test"):
            self.assertIn(f"wrote tests/{name}", told)
        self.assertNotIn("wrote", self.run_gable("test", "--update", says="1 passed"))
        self.run_gable("test", says="1 passed, 0 failed")
        self.put("rules/tower.cga", RULES.replace("height = 12", "height = 5"))
        told = self.run_gable("test", status=WRONG)
        self.assertRegex(told, r"scene tower.scene: line \d+ is '.*', expected '.*'")
        self.assertRegex(told, r"picture tower.png front 96x64: [\d.]+ % of the pixels differ, see tests/tower.found.png")
        self.assertTrue((self.folder / "tests/tower.found.png").exists())
        self.run_gable("test", says="1 passed", env={**os.environ, "GABLE_UPDATE": "1"})

    def testBuildServersReadTheResults(self):
        self.cases(case("good", "leaves Glass 4"), case("bad & <worse>", "leaves Glass 5"))
        self.put("tests/broken.test", "text\n")
        tap = self.run_gable("test", "--format", "tap", status=WRONG).splitlines()
        self.assertEqual(tap[:2], ["TAP version 13", "1..3"])
        self.assertEqual([line.split(" - ")[0] for line in tap[2:] if not line.startswith("#")],
                         ["not ok 1", "ok 2", "not ok 3"])
        self.run_gable("test", "--format", "junit", "-o", "r.xml", status=WRONG)
        suites = ElementTree.parse(self.folder / "r.xml").getroot()
        self.assertEqual([(s.get("tests"), s.get("failures")) for s in suites], [("1", "1"), ("2", "1")])
        self.assertEqual(suites[1][1].get("name"), "bad & <worse>")
        self.assertIn("found 4", suites[1][1][0].text)

    def testWatchingRunsAgainWhereAFileChanges(self):
        self.cases(case("watched", "leaves Glass 4"))
        with subprocess.Popen([str(GABLE), "test", "tests", "--watch"], cwd=self.folder, stdout=subprocess.PIPE,
                              text=True) as watching:
            try:
                self.assertEqual(watching.stdout.readline(), "1 passed, 0 failed\n")
                time.sleep(1)
                self.put("rules/tower.cga", RULES.replace("side : Wall", "side : Wal."))
                self.assertEqual(watching.stdout.readline(), "\n")
                self.assertEqual(watching.stdout.readline(), f"{self.folder}/rules/tower.cga has changed\n")
                self.assertIn("found 0", watching.stdout.readline())
                self.assertEqual(watching.stdout.readline(), "0 passed, 1 failed\n")
                watching.send_signal(2)
                self.assertEqual(watching.wait(timeout=10), WRONG)
            finally:
                watching.kill()

    def watching(self, *options):
        return subprocess.Popen([str(GABLE), "test", "tests", *options], cwd=self.folder, stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, text=True)

    def slow(self, part):
        """A rule file that leaves nothing: parts of 0.05 m take seconds, of 0.001 m longer than any test waits."""
        rules = f"Lot --> split(x) {{ ~0.001 : A }}*\nA --> split(z) {{ ~{part} : extrude(rand) NIL }}*\n"
        self.put("rules/slow.cga", rules)

    def testWatchingSeesAnEditDuringARun(self):
        self.slow(0.05)
        self.put("rules/tower.cga", RULES)
        self.cases(case("slow", "leaves 0", rules="rules: ../rules/slow.cga"))
        with self.watching("--watch", "--jobs", "1") as watching:
            try:
                time.sleep(1.5)
                self.put("rules/tower.cga", RULES + "// edited\n")
                told = ""
                while "has changed" not in told and (line := watching.stdout.readline()):
                    told += line
                self.assertIn(f"{self.folder}/rules/tower.cga has changed\n", told)
                # The run that follows is stopped in the middle of a derivation.
                time.sleep(0.5)
                begin = time.monotonic()
                watching.send_signal(2)
                self.assertEqual(watching.wait(timeout=10), LIMIT)
                self.assertLess(time.monotonic() - begin, 2)
            finally:
                watching.kill()

    def testAStoppedRunUpdatesNothing(self):
        self.slow(0.001)
        self.cases(case("slow", "scene slow.scene", rules="rules: ../rules/slow.cga"), case("next", "leaves Glass 4"))
        with self.watching("--update", "--jobs", "1") as running:
            time.sleep(1)
            running.send_signal(2)
            told = running.communicate(timeout=5)[0]
        self.assertEqual(running.returncode, LIMIT)
        self.assertIn("slow: stopped before its end", told)
        self.assertIn("0 passed, 2 failed", told)
        self.assertFalse((self.folder / "tests/slow.scene").exists())

    def testWhatARunWritesStartsNoOther(self):
        self.cases(case("golden", "scene tower.scene"))
        with self.watching("--watch", "--update", "-o", "tests/told.txt") as watching:
            time.sleep(2.5)
            watching.send_signal(2)
            self.assertNotIn("has changed", watching.communicate(timeout=10)[0])
        self.assertTrue((self.folder / "tests/tower.scene").exists())

    def testTheGuideIsTrue(self):
        text = (Path(__file__).resolve().parents[2] / GUIDE).read_text()
        rules, test = re.search(r"```cga\n(.*?)```", text, re.S), re.search(r"```test\n(== .*?)```", text, re.S)
        self.put("rules/tower.cga", rules.group(1))
        self.cases(test.group(1))
        self.run_gable("test", says="1 passed, 0 failed")
        self.cases(test.group(1).replace("n 20", "n 21"))
        told = self.run_gable("test", status=WRONG)
        self.assertIn(f"\n{told.splitlines()[0]}\n", text)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
