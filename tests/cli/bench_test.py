#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""The bench suite, interrupts and the soak in their short forms: bench_test.py GABLE FOLDER. Run from the repository's root."""
import json
import subprocess
import sys
import unittest
from pathlib import Path

from cli_test import GABLE, Case

ROOT = Path(__file__).resolve().parent.parent.parent
for folder in ("bench", "tools"):
    sys.path.insert(0, str(ROOT / folder))
import suite  # noqa: E402

FIGURES = {"wall": 2.0, "worst": 2.5, "cpu": 1.5, "peak": 2**20, "bytes": 4_000_000, "runs": 3}
RESULT = {"date": "2026-01-02", "commit": "abc", "base": "def",
          "machine": {"processor": "P", "cores": 2, "memory": 2**34, "system": "S", "load": [0.1, 0.2]},
          "scenes": [{"name": "W2 to GLB", "what": "", "by": {"head": FIGURES, "base": FIGURES | {"cpu": 3.0},
                                                              "OpenSCAD": {"note": "stopped after 300 s"}}}],
          "programs": [{"title": "boxes", "who": "head", "lines": ["W1  1.2"]}], "absent": ["Blender: not there", "Blender: not there"]}


class Bench(Case):
    def command(self, *arguments, status=0):
        done = subprocess.run([str(a) for a in arguments], cwd=ROOT, capture_output=True, text=True, check=False, timeout=300)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def run_bench(self, *arguments, status=0):
        files = ("--json", self.folder / "rates.json", "--page", self.folder / "rates.md")
        return self.command(sys.executable, "-B", "bench/run", *files, *arguments, status=status)

    def testTheSuiteRunsAndWritesFiguresAndPage(self):
        build = ("--small", "--runs", "2", "--build", GABLE.parent, "--base-build", GABLE.parent)
        self.run_bench(*build)
        kept = json.loads((self.folder / "rates.json").read_text())
        house = [s for s in kept["scenes"] if s["name"] == "rowhouse to GLB"][0]["by"]
        self.assertEqual(sorted(house), ["base", "head"])
        self.assertEqual(house["head"]["runs"], 2)
        self.assertEqual(house["head"]["bytes"], house["base"]["bytes"])
        self.assertGreaterEqual(house["head"]["worst"], house["head"]["wall"])
        page = (self.folder / "rates.md").read_text()
        self.assertIn("| rowhouse to GLB | head |", page)
        self.run_bench("--write-page")
        self.assertEqual((self.folder / "rates.md").read_text(), page)

    def testOnlyWhatIsNamedRuns(self):
        self.run_bench("--small", "--runs", "1", "--build", GABLE.parent, "--only", "nothing of this name")
        self.assertEqual(json.loads((self.folder / "rates.json").read_text())["scenes"], [])

    def testMistakesAreTold(self):
        self.assertIn("no program `gable`", self.run_bench("--build", self.folder, status=1))
        self.assertIn("--runs", self.run_bench("--runs", "0", status=2))
        with self.assertRaisesRegex(suite.Failed, "'false' ended with 1"):
            suite.command_seconds(["false"], self.folder)
        with self.assertRaisesRegex(TimeoutError, "stopped after 0.1 s"):
            suite.command_seconds(["sleep", "20"], self.folder, 0.1)

    def testThePageSaysWhatWasMeasuredAndWhatWasNot(self):
        page = suite.page(RESULT)
        for line in ("| W2 to GLB | head | 2.000 | 2.500 | 1.500 | 1.00 | 1 | 4.0 |",
                     "| W2 to GLB | base | 2.000 | 2.500 | 3.000 | 2.00 | 1 | 4.0 |",
                     "| W2 to GLB | OpenSCAD | stopped after 300 s | | | | | |", "head: W1  1.2", "compared with def"):
            self.assertIn(line, page)
        self.assertEqual(page.count("Blender: not there"), 1)

    def testExamplesStopSoonAfterAnInterrupt(self):
        # With room for the checks of this build: tools/cancel.py holds the tenth of a second.
        told = self.command(sys.executable, "-B", "tools/cancel.py", GABLE, "rowhouse", "haussmann", "--times", "4", "--kinds",
                            "generate", "render", "--most", "0.15", "--within", "20")
        self.assertIn("worst: ", told)
        # They derive again for their labels, and make ready for many pictures at once.
        told = self.command(sys.executable, "-B", "tools/cancel.py", GABLE, "temple", "--times", "4", "--kinds", "cityjson", "ifc",
                            "dataset", "--most", "0.2", "--within", "8")
        self.assertIn("worst: ", told)

    def testAnswersOfAFullStudioAreTheSame(self):
        done = subprocess.run([sys.executable, "-B", "tools/soak.py", GABLE, "rowhouse", "park/circular", "--minutes", "0.1"],
                              cwd=ROOT, capture_output=True, text=True, check=False, timeout=120)
        if done.returncode == 77:
            self.skipTest(done.stdout)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("compared with themselves", done.stdout)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
