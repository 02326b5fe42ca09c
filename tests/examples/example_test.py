#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""One example, generated as a user would: example_test.py GABLE FOLDER NAME.

1. With 1 and with 2 threads the model and the statistics are the same, byte for byte.
2. No error, and something was made.
3. The Khronos validator, where node is there, finds no error and no warning.
4. The rules are formatted, and fewer than 300 lines.
What is made stays in FOLDER. Run from the repository's root.
"""
import json
import os
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

GABLE, FOLDER, NAME = sys.argv[1], Path(sys.argv[2]), sys.argv[3]
# What may differ from run to run.
TIMES = ("seconds", "peakBytes")


def generate(label, *arguments):
    """Model file and statistics of one run, by the same function that ./run uses."""
    model, stats = FOLDER / f"{NAME}-{label}.glb", FOLDER / f"{NAME}-{label}.json"
    command = ('. tools/examples.sh; generate_example "$@"', "bash", GABLE, NAME, str(model),
               "--stats", str(stats), *arguments)
    done = subprocess.run(["bash", "-c", *command], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise AssertionError(f"gable generate ended with {done.returncode}:\n{done.stderr[-4000:]}")
    found = json.loads(stats.read_text())
    return model, {key: value for key, value in found.items() if key not in TIMES}


class ExampleTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        FOLDER.mkdir(parents=True, exist_ok=True)
        cls.model, cls.stats = generate("1", "--jobs", "1")

    def testThreadsChangeNothing(self):
        model, stats = generate("2", "--jobs", "2")
        self.assertEqual(stats, self.stats)
        self.assertTrue(model.read_bytes() == self.model.read_bytes(), "the models differ")

    def testMakesSomethingWithoutErrors(self):
        # A place has no statistics of its leaves.
        self.assertGreater(self.stats.get("leaves", self.stats.get("triangles", 0)), 0)
        errors = [d for d in self.stats.get("diagnostics", []) if "error" in json.dumps(d)]
        self.assertEqual(errors, [])

    def testPassesTheValidator(self):
        home = Path(os.environ.get("GABLE_VALIDATOR", "build/validate"))
        if not shutil.which("node") or not (home / "node_modules").exists():
            self.skipTest("the validator is not installed; ./test installs it")
        done = subprocess.run(["node", "tools/validate/validate.mjs", str(self.model)],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def testIsFormattedAndShort(self):
        known = (Path(f"examples/{NAME}/{NAME}.{e}") for e in ("cga", "gbbg", "grammar", "pg3d", "park"))
        files = [*(path for path in known if path.exists()), *Path("examples/rules").glob("*.cga")]
        done = subprocess.run([GABLE, "format", "--check", *map(str, files)], capture_output=True,
                              text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        for rules in files:
            self.assertLess(len(rules.read_text().splitlines()), 300, rules)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
