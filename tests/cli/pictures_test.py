#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""`gable render`: light, looks, layers, frames: pictures_test.py GABLE FOLDER. Run from the repository's root."""
import json
import os
import shutil
import struct
import sys
import unittest

from cli_test import DONE, FILE, USAGE, Case

RULES = """Lot --> [ s('0.4, 0, '1) extrude(4) color("#c04030") Brick ] t('0.6, 0, 0) s('0.4, 0, '1) extrude(4) House
House --> comp(f) { top : color("#505860") Roof | side : color("#e0d8c8") Wall }
"""
SMALL = ("--size", "48x27", "--samples", "1", "--lot", "20x10")


class Pictures(Case):
    def setUp(self):
        super().setUp()
        self.put("x.cga", RULES)

    def draw(self, name, *options, status=DONE, says=""):
        self.run_gable("render", "x.cga", *SMALL, *options, "-o", name, status=status, says=says)
        path = self.folder / name
        return path.read_bytes() if path.exists() else b""

    def testWrongOptionsAreTold(self):
        for option in (["--look", "oil"], ["--sun-at", "48,2"], ["--sun-at", "91,0,2024-06-21,12"],
                       ["--sun-at", "48,2,2024-13-01,12"], ["--sun-at", "48,2,2024-06-21,25"], ["--sun-at", "48,2,2024-06-21,12:61"],
                       ["--exposure", "bright"], ["--exposure", "99"], ["--cut", "w=3"], ["--cut", "x"], ["--cut", "x=nan"],
                       ["--haze", "-1"], ["--mist", "nan"], ["--aperture", "0"], ["--focus", "0"], ["--lit", "2"],
                       ["--lamps", "-1"], ["--bounces", "99"], ["--turntable", "0"], ["--fps", "0"]):
            self.draw("a.png", "=".join(option), status=USAGE, says=option[0])
        self.draw("a.webm", status=USAGE, says=".png")
        self.draw("a.png", "--turntable", "2", "--walk", "w.json", status=USAGE, says="--walk")
        self.draw("a.png", "--turntable", "2", "--aov", "layers", status=USAGE, says="--aov")
        self.draw("a.png", "--sun", "40,135", "--sun-at", "48,2,2024-06-21,12", status=USAGE, says="--sun")

    def testTheNumberOfPathsGoesByTheSize(self):
        def drawn(size, *options):
            self.run_gable("render", "x.cga", "--lot", "20x10", "--size", size, "--lighting", "direct", *options, "-o", "a.png")
            return (self.folder / "a.png").read_bytes()

        for size, paths in (("48x27", 48), ("1280x720", 24)):
            usual = drawn(size)
            self.assertEqual(usual, drawn(size, "--samples", str(paths)), size)
            self.assertNotEqual(usual, drawn(size, "--samples", str(paths - 1)), size)

    def testSeveralSeedsHavePicturesOfTheirOwn(self):
        self.put("x.cga", "Lot --> extrude(rand(3, 9)) House.\n")
        self.draw("a.png", "--count", "2", "--seed", "9")
        many = [(self.folder / f"a-{seed}.png").read_bytes() for seed in ("09", "10")]
        self.assertNotEqual(*many)
        self.assertEqual(many[0], self.draw("one.png", "--seed", "9"))
        self.assertFalse((self.folder / "a.png").exists())
        self.run_gable("generate", "x.cga", "--count", "2", "--seed=-1", "--reports", "r.csv", "-o", "a.city.json")
        for name in ("a--1.city.json", "a-0.city.json", "r--1.csv", "r-0.csv"):
            self.assertTrue((self.folder / name).exists(), name)
        answers = self.run_gable("generate", "x.cga", "--count", "2", "--json", "-o", "b.glb")
        self.assertEqual(answers.count('"command"'), 2)
        for wrong in ("--seed=0.5", "--seed=1e300", "--count=0", "--count=1.5", "--watch"):
            says = "--watch" if wrong == "--watch" else wrong.split("=")[0]
            self.draw("a.png", "--count", "2", wrong, status=USAGE, says=says)

    def testAModelThatEndsAtItsBordersIsFramed(self):
        rules = self.put("roof.cga", "@StartRule\nLot --> roofGable(30, 0.4, 0.3) comp(f) { aslant : X. | all : NIL }\n")
        for view in ("iso", "front", "street", "top"):
            self.run_gable("render", rules, "--lot", "10x8", "--view", view, "--size", "64x36", "--samples", "1", "-o", "a.png")

    def testTheSunOfAPlaceNeedsAPlace(self):
        self.draw("a.png", "--sun-at", "2024-06-21,12", status=USAGE, says="[picture-settings]")
        self.draw("a.png", "--sun-at", "116.4,39.9,2024-06-21,12", status=USAGE, says="the latitude first: 39.9,116.4,2024-06-21,12,")
        noon = self.draw("noon.png", "--sun-at", "48.86,2.35,2024-06-21,13:50+02:00")
        self.assertEqual(noon, self.draw("same.png", "--sun-at", "48.86,2.35,2024-06-21,11:50Z"))
        self.assertNotEqual(noon, self.draw("night.png", "--sun-at", "48.86,2.35,2024-06-21,01:00"))

    def testLitRoomsNeedPanes(self):
        night = ("--sun=-14,0", "--view", "front", "--exposure", "0")
        self.draw("a.png", *night, "--lit", "1", says="[no-panes]")
        self.draw("a.png", *night, "--lit", "1", "--turntable", "2", says="[no-panes]")
        for pane in ('material("glass")', 'color("#54707c") set(material.roughness, 0.05)'):
            self.put("x.cga", RULES.replace('color("#e0d8c8")', pane))
            for look in ("photo", "section"):
                out = self.run_gable("render", "x.cga", *SMALL, *night, "--lit", "1", "--look", look, "-o", "lit.png")
                self.assertNotIn("no-panes", str(out))
            self.assertNotEqual(self.draw("lit.png", *night, "--lit", "1"), self.draw("dark.png", *night, "--lit", "0"))

    def testLooksDifferAndStyleTakesTheirWords(self):
        pictures = {look: self.draw(f"{look}.png", "--look", look) for look in ("photo", "clay", "blueprint", "ink", "section")}
        self.assertEqual(len(set(pictures.values())), 5)
        self.assertEqual(self.draw("style.png", "--style", "ink"), pictures["ink"])
        self.assertNotEqual(self.draw("cut.png", "--cut", "y=2"), pictures["photo"])
        self.assertEqual(self.draw("cut.png", "--cut", "y=200"), pictures["photo"])

    def testStylesOfTheRulesComeFirst(self):
        self.put("x.cga", RULES + "attr tone = 1\n@Description(\"dark\") style clay\nattr tone = 2\n")
        self.assertEqual(self.draw("a.png", "--style", "clay"), self.draw("b.png"))

    def testAnUnknownStyleIsStillTold(self):
        self.draw("a.png", "--style", "Baroque", status=USAGE, says="Baroque")

    def testLayersAreFiles(self):
        self.draw("a.png", "--aov", "layers", "--view", "front")
        folder = self.folder / "layers"
        self.assertEqual(sorted(p.name for p in folder.iterdir()),
                         ["albedo.png", "depth.pfm", "depth.png", "instance.png", "layers.json", "material.png",
                          "normal.png", "object.png", "rule.png"])
        names = json.loads((folder / "layers.json").read_text())
        self.assertEqual(sorted(names["rules"]), ["House", "Lot"])
        self.assertIn("#c04030", names["materials"])
        head, values = (folder / "depth.pfm").read_bytes().split(b"-1.0\n", 1)
        self.assertEqual(head, b"Pf\n48 27\n")
        depths = struct.unpack("<1296f", values)
        # Sky above, the front in the middle; level rays never meet the ground below.
        self.assertEqual(depths[-1], 0)
        self.assertGreater(depths[13 * 48 + 14], 0)
        self.assertEqual(depths[24], 0)

    def testATurntableIsNumberedAndGoesAround(self):
        self.draw("t.png", "--turntable", "3")
        frames = [(self.folder / f"t-00{k}.png").read_bytes() for k in (1, 2, 3)]
        self.assertEqual(len(set(frames)), 3)
        self.assertFalse((self.folder / "t-004.png").exists())
        self.assertEqual(frames[0], self.draw("one.png"))

    def testAWalkFollowsItsPath(self):
        path = {"fps": 2, "stops": [{"eye": [10, 2, 30], "target": [10, 2, 0], "time": 0},
                                    {"eye": [20, 2, 30], "target": [10, 2, 0], "time": 1}]}
        (self.folder / "w.json").write_text(json.dumps(path))
        self.draw("w.png", "--walk", "w.json")
        self.assertEqual((self.folder / "w-001.png").read_bytes(),
                         self.draw("one.png", "--eye=10,2,30", "--target=10,2,0"))
        self.assertEqual((self.folder / "w-003.png").read_bytes(),
                         self.draw("one.png", "--eye=20,2,30", "--target=10,2,0"))
        self.assertFalse((self.folder / "w-004.png").exists())

    def testWrongPathsAreTold(self):
        for text, says in (("{}", "stops"), ("[", "json-syntax"), ('{"stops": [{"eye": [1, 2]}]}', "stop 1"),
                           ('{"fps": 0, "stops": []}', "fps"),
                           ('{"stops": [{"eye": [0,0,0], "target": [1,0,0], "time": 1},'
                            '{"eye": [0,0,0], "target": [1,0,0], "time": 1}]}', "time")):
            (self.folder / "w.json").write_text(text)
            self.draw("w.png", "--walk", "w.json", status=FILE, says=says)

    def testFilmsNeedFfmpeg(self):
        if shutil.which("ffmpeg"):
            self.draw("t.webm", "--turntable", "2")
            self.assertTrue((self.folder / "t.webm").exists())
            self.assertFalse((self.folder / "t-frames").exists())
            return
        self.draw("t.webm", "--turntable", "2", status=FILE, says="ffmpeg")
        self.assertFalse(os.path.exists(self.folder / "t-frames"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
