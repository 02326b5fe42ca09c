#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""`gable diff`: diff_test.py GABLE FOLDER. Run from the repository's root."""
import json
import sys
import unittest

from cli_test import DONE, FILE, USAGE, WRONG, Case

RULES = """attr height = 4
attr tone = "#ff8000"
Lot --> [ s('0.3, 0, '1) House ] t('0.7, 0, 0) s('0.3, 0, '1) extrude(4) House2
House --> extrude(height) color(tone) Wall.
House2 --> color("#8080ff") Wall.
"""


class Diff(Case):
    def model(self, name, *options):
        self.put("x.cga", RULES)
        self.run_gable("generate", "x.cga", "--lot", "20x10", *options, "-o", name)
        return name

    def compared(self, before, after, status):
        return json.loads(self.run_gable("diff", before, after, "--json", status=status))

    def testEqualModelsAreTheSame(self):
        for kind in ("glb", "gltf", "obj"):
            self.model(f"a.{kind}")
            self.model(f"b.{kind}", "--no-sharing", "--jobs", "1")
            self.run_gable("diff", f"a.{kind}", f"b.{kind}", says="the models are the same")
            c = self.compared(f"a.{kind}", f"b.{kind}", DONE)
            self.assertTrue(c["same"])
            self.assertEqual((c["added"]["faces"], c["removed"]["faces"]), (0, 0))
            self.assertAlmostEqual(c["kept"]["area"], 2 * (2 * 60 + 2 * (6 + 10) * 4), 3)

    def testChangesAreCountedAndPlaced(self):
        before, after = self.model("a.obj"), self.model("b.obj", "--set", "height=6")
        c = self.compared(before, after, WRONG)
        # The floor stays; four walls and the top are others.
        self.assertEqual((c["added"]["faces"], c["removed"]["faces"]), (5, 5))
        self.assertAlmostEqual(c["added"]["area"] - c["removed"]["area"], 2 * (6 + 10) * 2, 3)
        self.assertEqual(c["added"]["min"], [0, 0, -10])
        self.assertEqual(c["added"]["max"], [6, 6, 0])
        self.assertEqual([(m["color"], round(m["area"][1] - m["area"][0], 3)) for m in c["materialAreas"]], [("#ff8000", 64)])
        told = self.run_gable("diff", before, after, status=WRONG)
        for part in ("area", "+64", "added", "from 0 0 -10 to 6 6 0", "material"):
            self.assertIn(part, told)

    def testAnotherColourIsAnotherFace(self):
        before, after = self.model("a.glb"), self.model("b.glb", "--set", "tone=#ff0000")
        c = self.compared(before, after, WRONG)
        self.assertEqual(c["added"]["area"], c["removed"]["area"])
        self.assertEqual(len(c["materialAreas"]), 2)

    def testThePictureShowsWhatDiffers(self):
        before, after = self.model("a.glb"), self.model("b.glb", "--set", "height=6")
        self.run_gable("diff", before, after, "-o", "d.png", "--size", "64x36", "--samples", "2", status=WRONG)
        self.assertEqual((self.folder / "d.png").read_bytes()[:4], b"\x89PNG")

    def testMistakesAreTold(self):
        before = self.model("a.glb")
        self.put("bad.obj", "f 1 2 3\n")
        for arguments, status, says in (([before, "none.glb"], FILE, "none.glb"), ([before, "x.cga"], USAGE, "different formats"), (["x.cga", "x.cga"], USAGE, "no model"),
                                        ([before, "b.obj"], USAGE, "different formats"),
                                        (["bad.obj", "bad.obj"], FILE, "bad.obj"), ([before], USAGE, "after"),
                                        ([before, before, "-o", "d.jpg"], USAGE, ".png"),
                                        ([before, before, "-o", "d.png", "--size", "0x0"], USAGE, "--size")):
            self.run_gable("diff", *arguments, status=status, says=says)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
