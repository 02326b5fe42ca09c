#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Assets and seeds as users give them on the command line: asset_cli_test.py GABLE FOLDER."""
import json
import re
import subprocess
import sys
import unittest
from pathlib import Path

GABLE, FOLDER = sys.argv[1], Path(sys.argv[2])
MODEL = "".join(f"v {8 * (i & 1)} {9 * (i >> 1 & 1)} {8 * (i >> 2 & 1)}\n" for i in range(8))
MODEL += "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n"
GRAMMAR = """axiom Corner size (7, 7, 7), Row at (20, 0, 0) size (40, 1, 1)
terminal Corner, A [1, 0, 0], B [1, 0, 0]
Row -> Repeat(X) {A, B}
postprocess { Corner : "corner.glb" }
"""


def gable(*arguments):
    return subprocess.run([GABLE, *map(str, arguments)], capture_output=True, text=True, check=False)


class AssetTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        FOLDER.mkdir(parents=True, exist_ok=True)
        (FOLDER / "model.obj").write_text(MODEL, encoding="utf-8")
        (FOLDER / "rules.gbbg").write_text(GRAMMAR, encoding="utf-8")

    def prepare(self, *arguments):
        return gable("asset", "prepare", FOLDER / "model.obj", "-o", FOLDER / "corner.glb", *arguments)

    def testAPreparedAssetIsUsedAtOnce(self):
        done = self.prepare("--pivot", "0,0,0", "--size", "8,9,8", "--name", "RoofCorner")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(b"RoofCorner", (FOLDER / "corner.glb").read_bytes())
        done = gable("generate", FOLDER / "rules.gbbg", "-o", FOLDER / "out.glb", "--stats", "-")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        box = json.loads(done.stdout)["bbox"]
        for got, expected in zip(box["min"] + box["max"], [0, 0, -7, 60, 7, 0]):
            self.assertAlmostEqual(got, expected, places=4)

    def testWrongArgumentsAreRefused(self):
        self.assertEqual(self.prepare("--size", "8,9").returncode, 2)
        self.assertEqual(self.prepare("--pivot", "left").returncode, 2)
        self.assertEqual(self.prepare("--size", "8,0,8").returncode, 1)
        self.assertEqual(gable("asset", "prepare", FOLDER / "none.obj", "-o", FOLDER / "x.glb").returncode, 3)
        self.assertEqual(gable("asset").returncode, 2)

    def testARandomSeedIsToldAndCanBeGivenAgain(self):
        self.prepare()
        first = gable("generate", FOLDER / "rules.gbbg", "-o", FOLDER / "first.glb", "--seed", "random")
        seed = re.search(r"^seed (-?\d+)$", first.stderr, re.M)
        self.assertTrue(seed, first.stderr)
        self.assertTrue(-2**31 <= int(seed[1]) < 2**31)
        gable("generate", FOLDER / "rules.gbbg", "-o", FOLDER / "second.glb", "--seed", seed[1])
        self.assertEqual((FOLDER / "first.glb").read_bytes(), (FOLDER / "second.glb").read_bytes())
        for seed in ("-2147483648", "2147483647"):
            done = gable("generate", FOLDER / "rules.gbbg", "-o", FOLDER / "first.glb", "--seed", seed)
            self.assertEqual(done.returncode, 0, done.stderr)
        done = gable("generate", FOLDER / "rules.gbbg", "-o", FOLDER / "first.glb", "--seed", "often")
        self.assertEqual(done.returncode, 2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
