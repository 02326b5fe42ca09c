#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""The command line as scripts meet it: cli_test.py GABLE FOLDER.

What options take and refuse, what is written where there is no room, what a signal leaves behind, and that no format
of models carries a number that is none. Files are made in FOLDER. Run from the repository's root.
"""
import itertools
import json
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "written"))
import model_check  # noqa: E402

GABLE, FOLDER = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
ROOT = Path(__file__).resolve().parents[2]
DONE, WRONG, USAGE, FILE, LIMIT = 0, 1, 2, 3, 4


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = FOLDER / type(self).__name__ / self._testMethodName
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)

    def tearDown(self):
        shutil.rmtree(self.folder, ignore_errors=True)

    def put(self, name, text):
        (self.folder / name).write_text(text)
        return name

    def run_gable(self, *arguments, status=DONE, says="", **options):
        options = {"stdout": subprocess.PIPE, **options}
        done = subprocess.run([str(GABLE), *arguments], cwd=self.folder, stderr=subprocess.PIPE, text=True, timeout=120,
                              check=False, **options)
        told = (done.stdout or "") + done.stderr
        self.assertEqual(done.returncode, status, f"{arguments}\n{told}")
        self.assertIn(says, told, arguments)
        return told


class Options(Case):
    def testNumbersAreReadInOneWay(self):
        self.put("x.cga", "attr h = 9\nattr on = true\nattr word = \"x\"\nLot --> print(h) print(word) extrude(h) X.")
        for option, values in {
            "--set": ["h=1,5", "h=0x10", "h=nan", "h=inf", "h=", "h=1 2", "on=yes", "on=2", "h=[1]", "h", "=1"],
            "--seed": ["nan", "0x10", "1,5", "one"],
            "--max-seconds": ["-1", "nan", "inf", "1,5", "0x10"],
            "--max-shapes": ["-1", "nan", "1.5", "0x10"],
            "--max-steps": ["-1", "nan"], "--max-memory": ["-1", "nan"], "--max-depth": ["-1", "nan", "5000000000"],
            "--jobs": ["-1", "nan", "1.5", "0x2", "1e9"],
            "--lot": ["nanx3", "0x10", "0", "-3", "3x", "3x4x5", "-3x4", "1,5x3", "infx3"],
        }.items():
            for value in values:
                told = self.run_gable("generate", "x.cga", f"{option}={value}", "-o", "a.glb", status=USAGE)
                self.assertIn(option if option != "--set" else "'", told)
        for arguments, says in ((["--set", "h=2.5", "--set", "word=007"], "2.5\n007"), (["--set", "h=+3e0"], "3"),
                                (["--set", "word=1,5"], "1,5"), (["--seed", "-4"], ""), (["--lot", "30X4.5"], ""), (["--lot", "7.5"], "")):
            self.run_gable("generate", "x.cga", *arguments, "-o", "a.glb", says=says)

    def testPicturesTakeWhatCanBeDrawn(self):
        self.put("x.cga", "Lot --> extrude(9) X.")
        for arguments in (["--eye", "nan,0,0", "--target", "0,0,0"], ["--eye", "0,0", "--target", "0,0,0"],
                          ["--target", "0,0,inf", "--eye", "0,0,0"], ["--eye", "0,0,0"], ["--target=1,1,1", "--eye=1,1,1"],
                          ["--fov", "nan"], ["--fov", "0"], ["--fov", "180"], ["--samples", "0"], ["--samples", "nan"],
                          ["--size", "16384x16384"], ["--size", "1.5x2"], ["--size", "0x10"], ["--size", "nanx4"],
                          ["--sun", "nan,0"], ["--ground", "red"]):
            self.run_gable("render", "x.cga", *arguments, "-o", "a.png", status=USAGE, says=arguments[0].split("=")[0])
        self.run_gable("render", "x.cga", "-o", "a.jpg", status=USAGE, says=".png")
        self.run_gable("render", "x.cga", "--eye=1,2,3", "--target=4,5,6", "--fov=60", "--size=16x9", "--samples=1", "-o", "a.png")

    def testWhatTheCommandLineSaysWrongEndsAlike(self):
        # Also where it is found out with the shapes, in each command that draws.
        self.put("x.cga", "Lot --> extrude(9) X.")
        small = ["--size", "16x9", "--samples", "1"]
        noPlace = ["--sun-at", "2024-06-21,12"]
        for command in (["render", "x.cga", *small, *noPlace, "-o", "a.png"],
                        ["render", "x.cga", *small, *noPlace, "-o", "a.png", "--turntable", "2"],
                        ["dataset", "x.cga", *small, *noPlace, "-o", "set", "--count", "1", "--cameras", "1"]):
            self.run_gable(*command, status=USAGE, says="the sun's place is not known")

    def testEachStatusOfTheReferenceIsGiven(self):
        page = (ROOT / "docs/reference/command-line.md").read_text(encoding="utf-8")
        table = page.partition("## Exit status")[2].partition("\n## ")[0]
        self.put("good.cga", "Lot --> extrude(9) X.")
        self.put("other.cga", "Lot --> extrude(8) X.")
        self.put("wrong.cga", "Lot --> extrude(")
        self.put("wrong.test", "== aCase\nrule:\n  Lot --> X.\nexpect:\n  names Y\n")
        self.put("endless.cga", "Lot --> [ X. ] Lot")
        for name in ("good", "other"):
            self.run_gable("generate", f"{name}.cga", "-o", f"{name}.obj")
        given = {DONE: (["check", "good.cga"], ["diff", "good.obj", "good.obj"]),
                 WRONG: (["check", "wrong.cga"], ["generate", "wrong.cga", "-o", "a.obj"], ["test", "wrong.test"],
                         ["diff", "good.obj", "other.obj"]),
                 USAGE: (["generate", "good.cga"], ["check", "good.cga", "--no-such-option"]),
                 FILE: (["check", "absent.cga"], ["generate", "good.cga", "-o", "good.cga/a.obj"]),
                 LIMIT: (["generate", "endless.cga", "-o", "part.obj", "--max-shapes", "100"],)}
        self.assertEqual([int(n) for n in re.findall(r"^\| (\d+) \|", table, re.M)], list(given))
        for status, commands in given.items():
            for command in commands:
                with self.subTest(command=command):
                    self.run_gable(*command, status=status)
        self.assertTrue((self.folder / "part.obj").exists(), "what was made until then is written")

    def testStrictChecksFailWhereThereAreWarnings(self):
        self.put("good.cga", "Lot --> extrude(9) X.")
        self.put("warned.cga", "import walls : \"walls.cga\"\nLot --> extrude(9) Wal")
        self.run_gable("check", "warned.cga", says="0 errors, 2 warnings")
        self.run_gable("check", "warned.cga", "--strict", status=WRONG, says="0 errors, 2 warnings")
        self.run_gable("check", "good.cga", "--strict")

    def testStrictModelsAreWrittenAndFail(self):
        self.put("good.cga", "Lot --> extrude(9) X.")
        self.put("warned.cga", "Lot --> extrude(9) Wal")
        self.run_gable("generate", "good.cga", "-o", "a.obj", "--strict")
        self.run_gable("generate", "warned.cga", "-o", "b.obj")
        self.run_gable("generate", "warned.cga", "-o", "c.obj", "--strict", status=WRONG)
        self.run_gable("generate", "warned.cga", "-o", "c.obj", "--strict", "--quiet", status=WRONG)
        self.assertTrue((self.folder / "c.obj").exists())

    def testAChoiceOfFeaturesThatIsNoneIsTold(self):
        square = [[[0, 0], [9, 0], [9, 9], [0, 9], [0, 0]]]
        crs = {"type": "name", "properties": {"name": "EPSG:25832"}}
        lot = {"type": "Feature", "geometry": {"type": "Polygon", "coordinates": square}, "properties": {"use": "shop"}}
        self.put("lots.geojson", json.dumps({"type": "FeatureCollection", "crs": crs, "features": [lot]}))
        self.put("lot.cga", "Lot --> X.")
        for only, status, says in (("use=zzzz", WRONG, "has the value 'zzzz' for 'use'"), ("use=zzzz", WRONG, "write --only use=shop"),
                                   ("storeys", WRONG, "has the property 'storeys'"), ("=shop", USAGE, "names no property")):
            self.run_gable("generate", "lot.cga", "--shapes", "lots.geojson", "--only", only, "-o", "a.obj", status=status, says=says)

    def testAFaceStandsUpright(self):
        self.put("wall.cga", "Wall --> print(scope.sx) print(scope.sy) print(scope.sz) print(geometry.angle(zenith)) X.")
        told = self.run_gable("generate", "wall.cga", "--face", "12x9", "-o", "a.obj")
        self.assertEqual(told.split(), ["12", "9", "0", "0"])
        self.run_gable("generate", "wall.cga", "--face", "12y9", "-o", "a.obj", status=USAGE, says="width x height")
        self.run_gable("generate", "wall.cga", "--face", "9x9", "--lot", "9x9", "-o", "a.obj", status=USAGE, says="excludes")

    def testRulesOfOneNameAreTold(self):
        self.put("facade.cga", "Window --> extrude(1) Pane.\nDoor --> Leaf.")
        self.put("house.cga", "Window --> extrude(2) Hole.")
        self.put("main.cga", 'import facade : "facade.cga"\nimport house : "house.cga"\nLot --> facade.Window\n')
        told = self.run_gable("generate", "main.cga", "--start", "Window", "-o", "a.obj", says="[ambiguous-start-rule]")
        self.assertIn("'facade.Window' or 'house.Window'", told)
        for start in ("Door", "Lot", "house.Window"):
            told = self.run_gable("generate", "main.cga", "--start", start, "-o", "a.obj")
            self.assertNotIn("ambiguous", told)
        square = [[[0, 0], [9, 0], [9, 9], [0, 9], [0, 0]]]
        lots = [{"type": "Feature", "geometry": {"type": "Polygon", "coordinates": square}, "properties": {"startRule": "Window"}}] * 2
        crs = {"type": "name", "properties": {"name": "EPSG:25832"}}
        self.put("lots.geojson", json.dumps({"type": "FeatureCollection", "crs": crs, "features": lots}))
        told = self.run_gable("generate", "main.cga", "--shapes", "lots.geojson", "-o", "a.obj", says="2 shapes name 'Window'")
        self.assertEqual(told.count("ambiguous-start-rule"), 1)

    def testWhatShapesBringIsAWarning(self):
        self.put("use.cga", '@Enum("house", "shop")\nattr use = "house"\nLot --> extrude(3) Wall.\nShed --> extrude(2) Wall.')
        square = [[[0, 0], [9, 0], [9, 9], [0, 9], [0, 0]]]
        lots = [{"type": "Feature", "geometry": {"type": "Polygon", "coordinates": square}, "properties": p}
                for p in ({"use": "vila"}, {"startRule": "Shed"}, {"startRule": "Shedd"})]
        crs = {"type": "name", "properties": {"name": "EPSG:25832"}}
        self.put("lots.geojson", json.dumps({"type": "FeatureCollection", "crs": crs, "features": lots}))
        told = self.run_gable("generate", "use.cga", "--shapes", "lots.geojson", "-o", "a.obj", says="attribute-value")
        self.assertIn("a shape names 'Shedd' to start with", told)
        self.assertIn("did you mean 'Shed'?", told)
        self.run_gable("generate", "use.cga", "--set", "use=vila", "-o", "a.obj", status=USAGE, says="attribute-value")

    def testTheNotationOfATextIsGuessed(self):
        for name, option in (("gbbg/gbbg.gbbg", "gbbg"), ("park/square.park", "park"), ("progen3d/progen3d.grammar", "progen3d")):
            self.put("x.txt", (ROOT / "examples" / name).read_text())
            for command in (["check", "x.txt"], ["convert", "x.txt"], ["generate", "x.txt", "-o", "a.glb"]):
                told = self.run_gable(*command, status=WRONG, says=f"--dialect {option}")
                self.assertEqual(told.count("error: "), 1, told)
        # What is CGA with a slip stays that, and so does what is nothing.
        for text in ("Lot -> extrude(3) X.", "Lot --> extrude(3 X.\nA --> B.", "words and words", "{", "a\nb\nc\n"):
            self.put("x.txt", text)
            self.assertNotIn("rules-notation", self.run_gable("check", "x.txt", status=WRONG))
        # A name that says CGA is believed while the mistakes are few.
        self.put("x.cga", (ROOT / "examples/gbbg/gbbg.gbbg").read_text())
        self.assertEqual(self.run_gable("check", "x.cga", status=WRONG, says="--dialect gbbg").count("error: "), 1)
        self.put("x.cga", "START -> A(1)\n")
        self.assertNotIn("rules-notation", self.run_gable("check", "x.cga", status=WRONG))
        self.put("x.cga", "Lot --> X.")
        self.run_gable("convert", "x.cga", says="is CGA already")
        # A name may say another notation than the text.
        texts = {"cga": "attr h = 3\nLot --> extrude(h) comp(f) { side : Wall. | top : Roof. }\n"}
        for name, option in (("gbbg/gbbg.gbbg", "gbbg"), ("park/square.park", "park"), ("progen3d/progen3d.grammar", "progen3d")):
            texts[option] = (ROOT / "examples" / name).read_text()
        for ending, own in (("gbbg", "gbbg"), ("park", "park"), ("grammar", "progen3d")):
            for notation, text in texts.items():
                if notation == own:
                    continue
                self.put(f"x.{ending}", text)
                for command in (["check", f"x.{ending}"], ["convert", f"x.{ending}"]):
                    told = self.run_gable(*command, status=WRONG, says=f"--dialect {notation}")
                    self.assertEqual(told.count("error: "), 1, told)
            self.put(f"x.{ending}", texts[own] + "\n} slip {\n")
            # Signs without a meaning are no errors there.
            status = DONE if ending == "grammar" else WRONG
            self.assertNotIn("rules-notation", self.run_gable("check", f"x.{ending}", status=status))

    def testAnEmptyModelIsTold(self):
        self.put("x.cga", "Fence --> NIL\nHouse --> extrude(3) X.\n")
        told = self.run_gable("generate", "x.cga", "-o", "a.glb", says="the start rule 'Fence' made nothing [empty-model]")
        self.assertIn("--start", told)
        self.assertNotIn("empty", self.run_gable("generate", "x.cga", "--start", "House", "-o", "a.glb"))

    def testTheUsualLotIsTold(self):
        self.put("x.cga", "Lot --> X.")
        self.put("generate.args", "# As in the picture.\n--seed 4 --lot 320x300\n")
        told = self.run_gable("generate", "x.cga", "-o", "a.glb", says="[usual-lot]")
        self.assertIn("generate.args has --lot 320x300", told)
        self.assertNotIn("usual-lot", self.run_gable("generate", "x.cga", "--lot", "9x9", "-o", "a.glb"))

    def testAWallIsNamedToRulesThatBeginWithOne(self):
        self.put("x.cga", "Wall --> split(y) { 3 : A. | ~1 : B. }")
        self.run_gable("generate", "x.cga", "-o", "a.glb", says="--face 12x9 gives a wall")
        self.run_gable("render", "x.cga", "--size", "16x9", "--samples", "1", "-o", "a.png", says="--face 12x9 gives a wall")
        self.assertEqual(self.run_gable("generate", "x.cga", "--face", "12x9", "-o", "a.glb"), "")

    def testBrokenFeaturesAreLeftOutAndNamed(self):
        self.put("x.cga", "attr height = 4\nLot --> extrude(height) A.")
        lot = {"type": "Polygon", "coordinates": [[[0, 0], [9, 0], [9, 9], [0, 9], [0, 0]]]}
        bow = {"type": "Polygon", "coordinates": [[[0, 0], [9, 9], [9, 0], [0, 9], [0, 0]]]}
        word = {"type": "Polygon", "coordinates": [[[0, 0], ["x", 0], [9, 9], [0, 9], [0, 0]]]}

        def put(name, *features):
            crs = {"type": "name", "properties": {"name": "EPSG:25832"}}
            rows = [{"type": "Feature", "geometry": g, "properties": {"building": "yes", **p}} for g, p in features]
            self.put(name, json.dumps({"type": "FeatureCollection", "crs": crs, "features": rows}))

        put("some.geojson", (lot, {}), (bow, {"id": "b7"}), (word, {"name": "Hall"}), (lot, {"height": "tall"}), (lot, {"height": "low"}))
        told = self.run_gable("generate", "x.cga", "--shapes", "some.geojson", "-o", "a.glb", "--stats", "s.json")
        self.assertNotIn("error", told)
        for says in ("warning: feature 2 (id b7) of 'some.geojson' is left out: ", "warning: feature 3 'Hall' of 'some.geojson' is left out: ",
                     "warning: 'height' is a number, and 'tall' is none, in feature 4 and one more"):
            self.assertIn(says, told)
        codes = [d["code"] for d in json.loads((self.folder / "s.json").read_text())["diagnostics"]]
        self.assertEqual(codes, ["geojson-crossing", "geojson-coordinates", "attribute-type"])
        self.run_gable("generate", "x.cga", "--shapes", "some.geojson", "-o", "a.glb", "--strict", status=WRONG)
        put("none.geojson", (bow, {}))
        told = self.run_gable("generate", "x.cga", "--shapes", "none.geojson", "-o", "a.glb", status=WRONG, says="[shapes-empty]")
        self.assertIn("feature 1 of 'none.geojson' is left out", told)
        put("many.geojson", *[(bow, {})] * 30, (lot, {}))
        told = self.run_gable("generate", "x.cga", "--shapes", "many.geojson", "-o", "a.glb", says="30 features or parts of them")
        self.assertEqual(told.count("is left out"), 20)

    def testStatsHaveWhatIsToldOfTheRules(self):
        self.put("x.cga", "Lot --> extrude(3) Wal")
        self.run_gable("generate", "x.cga", "-o", "a.glb", "--stats", "s.json")
        codes = [d["code"] for d in json.loads((self.folder / "s.json").read_text())["diagnostics"]]
        self.assertEqual(codes, ["undefined-rule"])

    def testInfoListsTheOwnFirstAndEachOnce(self):
        self.put("lib.cga", "attr w = 2\nDoor --> s(w, 2, 0.1) X.\nInner --> Door")
        self.put("x.cga", 'import a : "lib.cga" (w = 3)\nimport b : "lib.cga"\n@Hidden attr secret = 4\nLot --> Own\nOwn --> [ a.Inner ] b.Inner a(w = secret).Inner')
        told = self.run_gable("info", "x.cga", "--all")
        self.assertEqual(told.count("Inner "), 1)
        self.assertEqual(told.count("Door "), 1)
        self.assertLess(told.index("  Own "), told.index("Inner "))
        self.assertIn("float = 4  @Hidden", told)

    def testSeveralStartRulesAreNoted(self):
        self.put("x.cga", "@StartRule A --> X.\n@StartRule B --> X.")
        self.run_gable("generate", "x.cga", "-o", "a.glb", says="--start B")
        self.assertEqual(self.run_gable("generate", "x.cga", "--start", "A", "-o", "a.glb"), "")

    def testWhatHasNoRoomIsTold(self):
        rules = 'Lot --> [ House ] House\nHouse --> ifFree("house") { A. %s}'
        self.put("x.cga", rules % "")
        self.run_gable("generate", "x.cga", "-o", "a.glb", says="note: 'ifFree': 1 of 2 shapes have no room in 'house' [no-room]")
        # Rules that say what becomes of them need no note.
        self.put("x.cga", rules % "| otherwise : B. ")
        self.assertEqual(self.run_gable("generate", "x.cga", "-o", "a.glb", "--stats", "s.json"), "")
        with open(self.folder / "s.json") as file:
            self.assertEqual(json.load(file)["room"], {"house": {"kept": 1, "dropped": 1}})

    def testWhatHasNoRoomIsToldOnceForAllCallsOfAGroup(self):
        self.put("x.cga", 'Lot --> [ ifFree("house") { A. } ] [ ifFree("house") { A. } ] [ ifFree("house") { A. | otherwise : B. } ] '
                 '[ ifFree("tree") { A. } ] ifFree("tree") { A. }')
        told = self.run_gable("generate", "x.cga", "-o", "a.glb", says="hint: 'otherwise' in the block")
        self.assertIn("'ifFree': 2 of 3 shapes have no room in 'house' [no-room]", told)
        self.assertIn("'ifFree': 1 of 2 shapes have no room in 'tree' [no-room]", told)
        self.assertEqual(told.count("[no-room]"), 2)

    def testRuleFilesOfWindowsAreRead(self):
        (self.folder / "T\u00fcr.txt").write_text("door")
        text = 'Lot --> print(readTextFile("T\u00fcr.txt")) print("5 \u20ac") X.'
        for encoding in ("utf-8", "utf-8-sig", "cp1252", "utf-16"):
            (self.folder / "x.cga").write_bytes(text.encode(encoding))
            self.run_gable("generate", "x.cga", "-o", "a.glb", says="door\n5 \u20ac")
            self.run_gable("check", "x.cga", says="")

    def testTheFormatIsKnownBeforeTheWorkBegins(self):
        self.put("x.cga", "Lot --> Lot")
        self.run_gable("generate", "x.cga", "-o", "a.xyz", status=USAGE, says=".glb")
        self.run_gable("generate", "x.cga", "-o", "a", status=USAGE, says=".glb")

    def testUnknownNamesGetAHint(self):
        self.put("town.cga", "attr height = 9\nLot --> extrude(height) House\nHouse --> X.\nstyle Old\nattr height = 3")
        for arguments, status, says in ((["twon.cga"], FILE, "did you mean 'town.cga'?"),
                                        (["town.glb"], FILE, "'town.glb' is no file of rules"),
                                        (["town.GeoJSON"], FILE, "its shapes with --shapes 'town.GeoJSON'"),
                                        (["town.cga", "--shapes", "town.cgo"], FILE, "did you mean 'town.cga'?"),
                                        (["town.cga", "--style", "old"], WRONG, "did you mean 'Old'?"),
                                        (["town.cga", "--style", "zzzzz"], WRONG, "style"),
                                        (["town.cga", "--start", "Hose"], WRONG, "did you mean 'House'?"),
                                        (["town.cga", "--start", "Q"], WRONG, "Lot, House"),
                                        (["town.cga", "--set", "hight=3"], WRONG, "did you mean 'height'?"),
                                        (["town.cga", "--set", "q=3"], WRONG, "the attributes are height")):
            told = self.run_gable("generate", *arguments, "-o", "a.glb", status=status, says=says)
            self.assertIn("hint: ", told)

    def testAnnotationsHoldForSetAsForForms(self):
        self.put("house.cga", '@Enum("flat", "hip") attr roof = "flat"\n@Range(3, 10) attr height = 5\n'
                 '@Enum("a", "b", restricted=false) attr free = "a"\n@Range(min=0, max=1, restricted=false) attr loose = 0\n'
                 "@Enum(1, 2) attr n = 1\nLot --> extrude(height + loose + n) set(roof, free) A.")
        told = self.run_gable("generate", "house.cga", "--set", "roof=hipp", "-o", "a.glb", status=USAGE,
                              says="'roof' is one of: flat, hip, not hipp")
        self.assertIn("did you mean 'hip'?", told)
        for pair, says in (("height=99", "'height' is meant to be from 3 to 10, not 99"), ("n=7", "'n' is one of: 1, 2, not 7")):
            self.run_gable("generate", "house.cga", "--set", pair, "-o", "a.glb", says=says)
        self.put("paint.cga", '@Color attr tint = "#ffffff"\nLot --> color(tint) A.')
        self.run_gable("generate", "paint.cga", "--set", "tint=red", "-o", "a.glb", says="'tint' is meant to be a colour, not red")
        self.assertNotIn("attribute-", self.run_gable("generate", "paint.cga", "--set", "tint=#ff0000", "-o", "a.glb"))
        for pair in ("roof=hip", "height=10", "free=c", "loose=9", "n=2"):
            told = self.run_gable("generate", "house.cga", "--set", pair, "-o", "a.glb")
            self.assertNotIn("attribute-", told)

    def testAnEmptyFileIsToldByItsName(self):
        for name, text in itertools.product(("e.cga", "e.park", "e.grammar", "e.pg3d", "e.gbbg"), ("", "\n\n")):
            told = self.run_gable("generate", self.put(name, text), "-o", "a.glb", status=WRONG, says=name)
            self.assertIn("hint: ", told)


class Words(Case):
    def testNamesAreFoundWhateverTheirCase(self):
        for name, says in (("Grid", "grid - "), ("Grid", "docs/guide/park.md"), ("grid", "docs/guide/gbbg.md"),
                           ("CubeX", "docs/guide/progen3d.md"), ("EXTRUDE", "extrude - ")):
            self.run_gable("ops", name, says=says)
        self.run_gable("ops", "peel", says="strip  A strip along an edge")
        self.run_gable("ops", says="world.south")
        self.run_gable("ops", "nothing", status=USAGE, says="nothing built in")
        for near, name in (("Grd", "Grid"), ("CubbeX", "CubeX"), ("extrud", "extrude")):
            self.run_gable("ops", near, status=USAGE, says=f"did you mean '{name}'?")
        for name, says in (("street.front", "street.front (selector"), ("attr", "attr (word of the notation)"),
                           ("Else", "else (word"), ("NIL", "NIL")):
            self.run_gable("ops", name, says=says)
        self.run_gable("ops", "street.frnt", status=USAGE, says="did you mean 'street.front'?")
        self.run_gable("ops", "front", "--json", says="\"name\": \"front\"")
        self.run_gable("ops", "Grid", "--json", says="\"name\": \"grid\"")

    def testUnknownCommandsAreNamed(self):
        self.run_gable("genrate", "a.cga", status=USAGE, says="there is no command 'genrate'; did you mean 'generate'?")
        self.run_gable("xyz", status=USAGE, says="'xyz'; there are generate, city, tiles, check")
        self.run_gable(status=USAGE, says="subcommand")

    def testUnknownOptionsAreNamed(self):
        for words, says in ((("generate", "a.cga", "--shpaes", "b.geojson"), "'gable generate' has no option '--shpaes'; did you mean '--shapes'?"),
                            (("tiles", "plan", "a.cga", "--cut-nestd=1"), "'gable tiles plan' has no option '--cut-nestd'; did you mean '--cut-nested'?"),
                            (("check", "--qqqqqq"), "'--qqqqqq'; 'gable check --help' tells those that it has"),
                            (("--versoin",), "'gable' has no option '--versoin'; did you mean '--version'?")):
            self.run_gable(*words, status=USAGE, says=says)
        self.run_gable("generate", "--sead", "--json", status=USAGE, says="did you mean '--seed'?")
        self.run_gable("generate", "a.cga", "-o", "a.glb", "--", "--odd", status=USAGE, says="--odd")

    def testUnknownWordsOfOptionsAreNamed(self):
        for words, says in ((("--look", "blueprnt"), "'--look' does not take 'blueprnt'; did you mean 'blueprint'?"),
                            (("--view=strete",), "'--view' does not take 'strete'; did you mean 'street'?"),
                            (("--look", "sketch"), "'--look' does not take 'sketch'; there are photo, clay, blueprint, ink, section")):
            self.run_gable("render", "a.cga", *words, "-o", "a.png", status=USAGE, says=says)
        rules = self.put("a.cga", "Lot --> extrude(2) A.\n")
        self.run_gable("render", rules, "--style", "sectoin", "-o", "a.png", status=USAGE, says="did you mean 'section'?")

    def testFormatSaysWhatItLeaves(self):
        name, text = "a.cga", 'Lot --> sweep("nonsense text", x) { all : X. }\n'
        for mode in ((), ("--check",), ("--stdout",)):
            self.run_gable("format", *mode, self.put(name, text), says="is left as it is")
        self.assertEqual((self.folder / name).read_text(), text)

    def testFormatWritesTheOtherNotations(self):
        for name, text, canonical in (("a.park", "A -> Grid(2,2)  { LAWN } {} {}\n", "A -> Grid(2, 2) { LAWN } {} {}\n"),
                                      ("a.grammar", "Start->T(1,2,3)  A\n", None)):
            self.run_gable("format", self.put(name, text))
            written = (self.folder / name).read_text()
            self.assertNotEqual(written, text)
            if canonical: self.assertEqual(written, canonical)
            self.run_gable("format", "--check", self.folder / name)

    def testHelpNamesEveryNotation(self):
        for ending in (".grammar", ".pg3d", ".gbbg", ".park"):
            self.run_gable("convert", "--help", says=ending)


class Trace(Case):
    RULES = ("Lot --> extrude(9) comp(f) { side : Wall | top : Roof }\nWall --> split(x) { ~2 : Bay }*\n"
             "Bay --> split(y) { 3 : Floor }*\nFloor --> X.\nRoof --> Y.\n")

    def trace(self, *arguments):
        self.run_gable("trace", self.put("a.cga", self.RULES), *arguments, "-o", "t.json")
        return json.loads((self.folder / "t.json").read_text())

    def names(self, nodes, level=0):
        for node in nodes:
            yield level, node["shape"]
            yield from self.names(node["children"], level + 1)

    def testStdoutAndFileAreTheSame(self):
        self.trace()
        done = subprocess.run([str(GABLE), "trace", "a.cga"], cwd=self.folder, capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout, (self.folder / "t.json").read_text())

    def testFiltersShowTheSubtreesOfTheWhole(self):
        def below(nodes, rule):
            for node in nodes:
                yield from [node] if node["shape"] == rule else below(node["children"], rule)
        whole = self.trace()
        self.assertEqual([n for _, n in self.names(whole)][:2], ["Lot", "Wall"])
        self.assertEqual(self.trace("--rule", "Bay"), list(below(whole, "Bay")))
        self.assertEqual(self.trace("--path", "Lot/Wall/Bay"), list(below(whole, "Bay")))
        self.assertEqual(self.trace("--path", "Lot/Bay"), [])
        self.assertEqual(self.trace("--path", "Lot"), whole)

    def testDepthCutsBelow(self):
        self.assertEqual(list(self.names(self.trace("--depth", "1"))),
                         [(0, "Lot")] + [(1, "Wall")] * 4 + [(1, "Roof")])
        shallow = list(self.names(self.trace("--rule", "Wall", "--depth", "0")))
        self.assertEqual(shallow, [(0, "Wall")] * 4)

    def testUnknownRulesAreReported(self):
        for option in ("--rule", "--path"):
            self.run_gable("trace", self.put("a.cga", self.RULES), option, "Wal", status=WRONG, says="did you mean 'Wall'?")


class Writing(Case):
    def full_disk(self):
        """Files end at 4000 bytes, as under `ulimit -f`; the program is the one to ignore the signal."""
        signal.signal(signal.SIGXFSZ, signal.SIG_DFL)
        resource.setrlimit(resource.RLIMIT_FSIZE, (4000, 4000))

    def names(self):
        return sorted(p.name for p in self.folder.iterdir())

    def testAFullDiskLosesNothing(self):
        rules = "Lot-->split(x){1:X.}*\n" + "".join(f"R{i}-->s(1,1,1) X.\n" for i in range(500))
        grammar = "A -> " + " ".join("I ( Cube ) T ( 1 0 0 )" for _ in range(300))
        cases = [(["format", "x.cga"], "x.cga", rules), (["convert", "x.grammar", "-o", "c.cga"], "c.cga", "mine"),
                 (["trace", "x.cga", "-o", "t.json", "--lot", "90x90"], "t.json", "mine"),
                 (["generate", "x.cga", "-o", "small.glb", "--lot", "1x1", "--stats", "/dev/full"], "x.cga", rules)]
        cases += [(["generate", "x.cga", "-o", f"m.{kind}", "--lot", "90x90"], f"m.{kind}", "mine")
                  for kind in ("glb", "obj", "ply", "stl")]
        for command, file, before in cases:
            for name in self.names():
                (self.folder / name).unlink()
            self.put("x.cga", rules)
            self.put("x.grammar", grammar)
            self.put(file, before)
            told = self.run_gable(*command, status=FILE, preexec_fn=self.full_disk)
            self.assertIn("cannot be written", told)
            self.assertEqual((self.folder / file).read_text(), before, command)
            self.assertFalse([n for n in self.names() if ".part" in n], command)

    def testAFullOutputIsNoSuccess(self):
        self.put("x.cga", "Lot --> print(1) X.")
        for command in (["ops"], ["ops", "--json"], ["check", "x.cga", "--json"], ["format", "--stdout", "x.cga"],
                        ["convert", "x.cga"], ["trace", "x.cga"], ["generate", "x.cga", "-o", "a.glb", "--stats", "-"],
                        ["generate", "x.cga", "-o", "a.glb"], ["--help"]):
            with open("/dev/full", "w", encoding="ascii") as full:
                self.run_gable(*command, status=FILE, says="could not be written", stdout=full)

    def testPermissionsStay(self):
        self.put("x.cga", "Lot-->X.")
        os.chmod(self.folder / "x.cga", 0o640)
        self.run_gable("format", "x.cga")
        self.assertEqual((self.folder / "x.cga").stat().st_mode & 0o777, 0o640)

    def testSignalsLeaveNothingBehind(self):
        rules = "Lot --> split(x) { 0.05 : split(z) { 0.05 : s('1, rand(1, 9), '1) X. }* }*"
        self.put("x.cga", rules)
        for end in (signal.SIGTERM, signal.SIGINT, signal.SIGKILL):
            with subprocess.Popen([str(GABLE), "generate", "x.cga", "-o", "a.obj", "--lot", "30x30"], cwd=self.folder,
                                  stderr=subprocess.DEVNULL) as run:
                deadline = time.monotonic() + 100
                while run.poll() is None and not any(".part" in n for n in self.names()) and time.monotonic() < deadline:
                    time.sleep(0.001)
                # The first interrupt asks for an end, the next one does not wait for it.
                while run.poll() is None:
                    run.send_signal(end)
                    time.sleep(0.02)
            parts = [n for n in self.names() if ".part" in n]
            if end == signal.SIGKILL:
                self.run_gable("generate", "x.cga", "-o", "a.obj", "--lot", "1x1")
                parts = [n for n in self.names() if ".part" in n]
            self.assertEqual(parts, [], end)

    def testOnlyFilesAreRead(self):
        os.mkfifo(self.folder / "p.cga")
        os.mkfifo(self.folder / "p.geojson")
        self.put("x.cga", "Lot --> X.")
        (self.folder / "zero.cga").symlink_to("/dev/zero")
        for command in (["check", "p.cga"], ["format", "p.cga"], ["convert", "p.cga"], ["trace", "p.cga"],
                        ["generate", "p.cga", "-o", "a.glb"], ["format", "--stdout", "zero.cga"],
                        ["generate", "x.cga", "--shapes", "p.geojson", "-o", "a.glb"]):
            self.run_gable(*command, status=FILE, says="not a regular file")
        os.mkfifo(self.folder / "p.glb")
        self.run_gable("generate", "x.cga", "-o", "p.glb", status=FILE)

    def testHiddenFilesAreNoAssets(self):
        (self.folder / ".git").mkdir()
        (self.folder / ".git" / "note.txt").write_text("secret")
        self.put(".note.txt", "secret")
        (self.folder / "link.txt").symlink_to(".note.txt")
        self.put("note.txt", "open")
        files = ("./note.txt", ".note.txt", "/.git/note.txt", "link.txt", ".git/note.txt")
        self.put("x.cga", "Lot --> " + " ".join(f"print(fileExists(\"{f}\"))" for f in files) + " print(fileSearch(\"*.txt\")) X.")
        told = self.run_gable("generate", "x.cga", "--project", ".", "-o", "a.glb")
        self.assertEqual(told.split(), ["true", "false", "false", "false", "false", "/note.txt;"], told)


class Models(Case):
    """No format carries what is not finite, and what is left out is told once."""

    # Operations refuse arguments that no model can hold; what they make in turn has no such bound.
    GROWING = ("\nBig(n) --> case n > 0 : s('1e8, '1, '1) Big(n - 1) else : X."
               "\nFar(n) --> case n > 0 : t('1e8, 0, 0) s('1e8, '1, '1) Far(n - 1) else : Roof"
               "\nRoof --> comp(f) { all : Tile. }")
    RULES = {
        "turn": "Lot --> extrude(5) r(0, 0, 0/0) X.", "place": "Lot --> s(2, 2, 2) [ X ] t(0/0, 0, 0) X\nX --> primitiveSphere(8, 9)",
        "size": "Lot --> extrude(5) s(1e200, 1, 1) X.", "far": "Lot --> extrude(5) t(1e200, 0, 0) X.",
        "thin": "Lot --> extrude(5) s('1, 1e-200, '1) X.", "flat": "Lot --> primitiveSphere(8, 9) s('1, 1e-120, 1e-80) X.",
        "uv": "Lot --> setupProjection(0, scope.xy, 1e-320, 1) projectUV(0) texture(\"builtin:textures/02_brick.png\") X.",
        "look": "Lot --> extrude(5) set(material.roughness, 0/0) set(material.opacity, 0/0) set(material.colormap.su, 1/0) X.",
        "mixed": "Lot --> extrude(5) [ Big(8) ] [ Far(8) ] Y." + GROWING,
        "many": "Lot --> split(x) { 1 : House }*\nHouse --> extrude(9) [ Far(8) ] Y." + GROWING,
    }

    def testInstancingIsChosen(self):
        self.put("x.cga", "Lot --> split(x) { 4 : variants(2) Post }*\n"
                 "Post --> s(1, rand(2, 9), 1) primitiveCylinder(200) split(y) { ~1 : Low. | ~1 : High. }")
        nodes, sizes = {}, {}
        for way in ["auto", "nodes", "gpu", "none"]:
            told = self.run_gable("generate", "x.cga", "--lot", "400x4", "-o", "a.glb", "--instancing", way, "--stats",
                                  "-")
            figures = json.loads(told[told.index("{"):])
            data = (self.folder / "a.glb").read_bytes()
            self.assertEqual(figures["fileBytes"], len(data))
            self.assertEqual(figures["savedBytes"] > 0, way != "none")
            end = 20 + int.from_bytes(data[12:16], "little")
            nodes[way], sizes[way] = len(json.loads(data[20:end])["nodes"]), len(data)
        self.assertEqual((nodes["auto"], nodes["gpu"], nodes["none"]), (101, 3, 1))
        self.assertEqual(nodes["nodes"], nodes["auto"])
        self.assertLess(sizes["gpu"], sizes["nodes"])
        self.assertLess(sizes["nodes"] * 5, sizes["none"])
        self.run_gable("generate", "x.cga", "-o", "a.glb", "--instancing", "both", status=USAGE, says="both")
        self.run_gable("generate", "x.cga", "--lot", "400x4", "-o", "a.glb", "--vertices", "compact")
        self.assertLess((self.folder / "a.glb").stat().st_size, 0.8 * sizes["auto"])
        self.run_gable("generate", "x.cga", "-o", "a.glb", "--vertices", "half", status=USAGE, says="half")

    def testStatisticsOnStdoutAreJsonAndNothingElse(self):
        self.put("x.cga", 'Lot --> print("a line") extrude(2)\n')
        done = subprocess.run([str(GABLE), "generate", "x.cga", "-o", "a.glb", "--lot", "2x2", "--stats", "-"],
                              cwd=self.folder, capture_output=True, text=True, timeout=120, check=True)
        self.assertEqual(json.loads(done.stdout)["prints"], ["a line"])
        self.assertIn("a line", done.stderr)

    def testEveryFormatIsReadBack(self):
        for (name, rules), kind in itertools.product(self.RULES.items(), ("glb", "gltf", "obj", "ply", "stl")):
            self.put("x.cga", rules)
            told = self.run_gable("generate", "x.cga", "-o", f"{name}.{kind}")
            self.assertEqual(model_check.problems(self.folder / f"{name}.{kind}"), [], f"{name}.{kind}")
            self.assertLessEqual(told.count("[model-not-finite]"), 1)
        self.put("x.cga", self.RULES["mixed"])
        told = self.run_gable("generate", "x.cga", "-o", "a.glb", "--stats", "-", says="7 leaves are left out")
        self.assertNotIn("nan", told)

    def testSharedAndFlatSayTheSame(self):
        self.put("x.cga", self.RULES["many"])
        told = [self.run_gable("generate", "x.cga", "-o", f"{i}.stl", *more, says="leaves are left out")
                for i, more in enumerate(([], ["--no-sharing"]))]
        self.assertEqual(told[0].split("leaves")[0], told[1].split("leaves")[0])
        self.assertEqual((self.folder / "0.stl").read_bytes(), (self.folder / "1.stl").read_bytes())

    def testTheCheckFindsWhatIsWrong(self):
        self.put("x.cga", "Lot --> extrude(5) X.")
        for kind in ("glb", "obj", "ply", "stl"):
            self.run_gable("generate", "x.cga", "-o", f"x.{kind}")
            path = self.folder / f"x.{kind}"
            data = bytearray(path.read_bytes())
            if kind == "obj":
                data = data.replace(b"v 0", b"v nan", 1)
            else:
                # The last numbers of the vertices, or of the triangles.
                at = {"glb": data.find(b"BIN\0") + 4, "ply": data.find(b"end_header\n") + 11, "stl": 84}[kind]
                data[at:at + 4] = b"\0\0\xc0\x7f"
            path.write_bytes(data)
            self.assertNotEqual(model_check.problems(path), [], kind)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
