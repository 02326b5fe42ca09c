#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Packages, and what is told of rules: packages_test.py GABLE FOLDER.

Files are made in FOLDER. Run from the repository's root.
"""
import csv
import io
import json
import os
import struct
import sys
import unittest
import zipfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from projects_test import CUBE, DONE, FILE, MAIN, USAGE, WALL, WRONG, Case  # noqa: E402

PNG = bytes.fromhex("89504e470d0a1a0a0000000d4948445200000001000000010806000000" "1f15c489"
                    "0000000d49444154789c6360f8cfc0f01f00050001ffa5a7d2e20000000049454e44ae426082")


class Packages(Case):
    def zip(self, name, files, **options):
        with zipfile.ZipFile(self.folder / name, "w", zipfile.ZIP_DEFLATED) as archive:
            for path, text in files.items():
                archive.writestr(path, text, **options)
        return name

    def code(self, *arguments, status=FILE):
        codes = self.codes(*arguments, status=status)
        self.assertEqual(len(codes), 1, codes)
        return codes[0]

    def testAreReadAsFolders(self):
        self.zip("x.zip", {"rules/main.cga": 'import w : "/rules/w.cga"\nLot --> extrude(3) comp(f) { side : w.Wall }\n',
                           "rules/w.cga": WALL, "assets/panel.obj": CUBE})
        self.assertEqual(self.codes("x.zip"), [])
        self.assertEqual(self.reports("x.zip"), {"walls": 4, "faces": 32})
        self.assertEqual(self.reports("x.zip/rules/main.cga"), {"walls": 4, "faces": 32})
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["out.glb", "stats.json", "x.zip"])

    def testComeBackAsTheyWerePacked(self):
        self.put("town/Mine/rules/main.cga", MAIN)
        self.put("town/Mine/assets/roof.png", PNG)
        self.put("town/Other/rules/w.cga", WALL)
        self.put("town/Other/assets/panel.obj", CUBE)
        self.put("town/Other/rules/unused.cga", "Lot --> X.\n")
        for kind in ["rpk", "zip"]:
            package = f"w.{kind}"
            self.gable("pack", "town/Mine/rules/main.cga", "--workspace", "town", "-o", package)
            first = (self.folder / package).read_bytes()
            os.utime(self.folder / "town/Other/assets/panel.obj", (1, 1))
            self.gable("pack", "town/Mine/rules/main.cga", "--workspace", "town", "-o", package)
            self.assertEqual((self.folder / package).read_bytes(), first, kind)
            self.assertEqual(self.reports(package), {"walls": 4, "faces": 32}, kind)
        with zipfile.ZipFile(self.folder / "w.zip") as archive:
            self.assertEqual(sorted(archive.namelist()),
                             ["Mine/assets/roof.png", "Mine/rules/main.cga", "Other/assets/panel.obj",
                              "Other/rules/w.cga"])
        self.assertEqual((self.folder / "w.rpk").read_bytes()[:6], b"7z\xbc\xaf\x27\x1c")

    def testOfOneProjectHaveItsFolders(self):
        self.put("p/rules/main.cga", 'Lot --> i("beside.obj") texture("a/roof.png") X.\n')
        self.put("p/rules/beside.obj", CUBE)
        self.put("p/rules/beside.mtl", "newmtl a\n")
        self.put("p/assets/a/roof.png", PNG)
        self.gable("pack", "p/rules/main.cga", "-o", "p.zip")
        with zipfile.ZipFile(self.folder / "p.zip") as archive:
            self.assertEqual(sorted(archive.namelist()), ["assets/a/roof.png", "rules/beside.mtl", "rules/beside.obj",
                                                          "rules/main.cga"])
        self.assertEqual(self.codes("p.zip"), [])

    def testOfCompiledRulesAreTold(self):
        self.zip("x.rpk", {"bin/rules/a.cgb": "?", "assets/a.txt": "?"})
        told = self.gable("check", "x.rpk", status=FILE)
        self.assertIn("package-compiled", told)
        self.assertIn("bin/rules/a.cgb", told)

    def testWithSeveralRuleFilesNameTheOneThatIsMeant(self):
        files = {"rules/a.cga": "Lot --> X.\n", "rules/b.cga": "Lot --> Y.\n"}
        self.assertEqual(self.code(self.zip("x.zip", files)), "package-ambiguous")
        self.assertEqual(self.codes("x.zip/rules/b.cga"), [])
        self.assertEqual(self.codes(self.zip("b.zip", files)), [])
        self.assertEqual(self.codes(self.zip("y.zip", {**files, "bin/a.cgb": ""})), [])
        self.assertEqual(self.code("x.zip/rules/c.cga"), "file-missing")
        self.assertEqual(self.code(self.zip("z.zip", {"a.txt": ""})), "package-empty")

    def testOfStrangersAreRefused(self):
        rule = {"rules/a.cga": "Lot --> X.\n"}
        for path in ["../evil.cga", "/etc/evil.cga", "rules/../../evil", "C:\\evil"]:
            self.assertEqual(self.code(self.zip("x.zip", {**rule, path: "x"})), "archive-path", path)
        link = zipfile.ZipInfo("rules/link.cga")
        link.create_system, link.external_attr = 3, 0o120777 << 16
        self.zip("x.zip", {**rule, link: "/etc/passwd"})
        self.assertEqual(self.code("x.zip"), "archive-path")
        self.zip("x.zip", {**rule, "assets/zeros": bytes(200 << 20)})
        self.assertEqual(self.code("x.zip"), "archive-too-large")
        self.zip("x.zip", {**rule, **{f"a/{i}": "" for i in range(100001)}})
        self.assertEqual(self.code("x.zip"), "archive-too-large")

    def testThatAreBrokenOffAreTold(self):
        self.put("p/rules/main.cga", "Lot --> X.\n")
        for kind in ["rpk", "zip"]:
            self.gable("pack", "p/rules/main.cga", "-o", f"x.{kind}")
            whole = (self.folder / f"x.{kind}").read_bytes()
            for length in [0, 10, len(whole) // 2, len(whole) - 1]:
                self.put(f"x.{kind}", whole[:length])
                self.assertEqual(self.code(f"x.{kind}"), "archive-unreadable", (kind, length))

    def testThatAreEncryptedAreTold(self):
        self.zip("x.zip", {"rules/a.cga": "Lot --> X.\n"})
        data = bytearray((self.folder / "x.zip").read_bytes())
        for mark, at in [(b"PK\3\4", 6), (b"PK\1\2", 8)]:
            flags = data.find(mark) + at
            struct.pack_into("<H", data, flags, struct.unpack_from("<H", data, flags)[0] | 1)
        self.put("x.zip", bytes(data))
        self.assertEqual(self.code("x.zip"), "archive-encrypted")

    def testAreNotMadeOfWhatIsWrong(self):
        self.put("p/rules/main.cga", "Lot --> extrude(\n")
        self.gable("pack", "p/rules/main.cga", "-o", "x.rpk", status=WRONG)
        self.gable("pack", "gone.cga", "-o", "x.rpk", status=FILE)
        self.gable("pack", "p/rules/main.cga", "-o", "x.tar", status=USAGE)
        self.put("p/rules/main.cga", "Lot --> X.\n")
        self.gable("pack", "p/rules/main.cga", "-o", "nowhere/x.rpk", status=FILE)
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["p"])


RULES = """@RuleFileDescription("A house.")
import w : "w.cga"
import gone : "/Gone/gone.cga"
@Group("Size", 2) @Order(1) @Range(min=3, max=30) @Distance
@Handle(shape=Lot, axis=y, reference=edges, align=right, slip={inside, h}, translate={0, -1.5, 0})
attr height = 3 * 3
@Enum("a", "b")
attr kind = "a"
@Handle(type=toggle, shape=Roof^2) @Handle(shape=Lot)
attr on = true
@StartRule @InPolygon @Out(granularity=separatedShapes)
Lot --> extrude(height) i("there.obj") i("gone.obj") report("area", 2) report("kind", "a,\\"b\\"") w.Wall
@Hidden @StartRule
Other --> X.
style Red
Lot --> X.
"""


ANNOTATED = """@RuleFileDescription("All annotations.")
version "2025.0"
@Angle
attr turn = 180
@Color
attr tint = "#000000"
@Description("The building width")
attr width = 40
@Directory
attr folder = "/assets/lod1"
@DisplayName("Building height")
attr height = 20
@Distance
attr distance = 1852
@Enum("low", "mid", "high")
attr lod = "low"
@Enum(10, 20, 30, restricted = false)
attr step = 20
@Enum(valuesAttr = lods)
attr chosen = "mid"
@Hidden
attr lods = ["low", "mid", "high"]
@File("tif", "tiff")
attr image = "tex0.tiff"
@File
attr anyFile = "x.obj"
@Group("First", "Second", "Third", 1)
attr grouped = 0
@Group
@Handle(shape=Solid, align=right)
attr dimension = 40
@MaterialFile
attr mat = "myMaterial.cgamat"
@Order(13)
attr third = 0
@Percent
attr inflation = 0.012
@Range(min=0, max=45, stepsize=15, restricted=false)
attr angle = 30
@Range(min=2.5, max=7)
attr floors = [4, 5.5, 5.5]
@StartRule @InMesh @Out(granularity=separatedShapes)
Start --> NIL
@StartRule @InPolygon
Poly --> NIL
@StartRule @InLine
Line --> NIL
@StartRule @InPoint
Point --> NIL
@StartRule @InPointCloud
Cloud --> NIL
"""


class Info(Case):
    def setUp(self):
        super().setUp()
        self.put("p/rules/main.cga", RULES)
        self.put("p/rules/w.cga", 'attr width = 2\nWall --> i("there.obj") X.\n')
        self.put("p/assets/there.obj", CUBE)

    def testTellsAllAsJson(self):
        told = json.loads(self.out("info", "p/rules/main.cga", "--json"))
        self.assertEqual(told["description"], "A house.")
        self.assertEqual(told["styles"], ["Default", "Red"])
        self.assertEqual(told["startRule"], "Lot")
        rules = {r["name"]: r for r in told["rules"]}
        self.assertEqual([a["name"] for a in rules["Lot"]["annotations"]], ["StartRule", "InPolygon", "Out"])
        self.assertTrue(rules["Other"]["hidden"])
        attributes = {a["name"]: a for a in told["attributes"]}
        height = {a["name"]: a["arguments"] for a in attributes["height"]["annotations"]}
        self.assertEqual(height["Range"], [["min", "3"], ["max", "30"], ["restricted", "true"]])
        self.assertEqual(height["Group"], [["", "Size"], ["order", "2"]])
        self.assertEqual(height["Handle"], [["shape", "Lot"], ["axis", "y"], ["reference", "edges"], ["align", "right"],
                                            ["slip", "{inside,h}"], ["translate", "{0,-1.5,0}"]])
        self.assertEqual([a["name"] for a in attributes["on"]["annotations"]].count("Handle"), 2)
        self.assertEqual(told["values"], {"height": 9, "kind": "a", "on": True, "w.width": 2})
        self.assertEqual([(i["name"], i["found"]) for i in told["imports"]], [("w", True), ("gone", False)])
        self.assertEqual([(a["path"], a["from"], a["found"]) for a in told["assets"]],
                         [("there.obj", "rules/main.cga", True), ("gone.obj", "rules/main.cga", False),
                          ("there.obj", "rules/w.cga", True)])

    def testTellsEveryAnnotationOfTheReference(self):
        self.put("p/rules/all.cga", ANNOTATED)
        told = json.loads(self.out("info", "p/rules/all.cga", "--json"))
        self.assertEqual(told["diagnostics"], [])
        self.assertEqual(told["description"], "All annotations.")
        of = {a["name"]: {n["name"]: [x[-1] for x in n["arguments"]] for n in a["annotations"]}
              for a in [*told["attributes"], *told["rules"]]}
        self.assertEqual([name for name, notes in of.items() if len(notes) > 2], ["Start"])
        self.assertEqual(of["lod"], {"Enum": ["low", "mid", "high", "true"]})
        self.assertEqual(of["step"], {"Enum": ["10", "20", "30", "false"]})
        self.assertEqual(of["chosen"], {"Enum": ["lods", "true"]})
        self.assertEqual(of["angle"], {"Range": ["0", "45", "15", "false"]})
        self.assertEqual(of["floors"], {"Range": ["2.5", "7", "true"]})
        self.assertEqual(of["grouped"], {"Group": ["First", "Second", "Third", "1"]})
        self.assertEqual(of["dimension"], {"Handle": ["Solid", "right"]})
        self.assertEqual(of["third"], {"Order": ["13"]})
        self.assertEqual(of["image"], {"File": ["tif", "tiff"]})
        self.assertEqual(of["width"], {"Description": ["The building width"]})
        self.assertEqual(of["height"], {"DisplayName": ["Building height"]})
        for name, note in {"turn": "Angle", "tint": "Color", "folder": "Directory", "distance": "Distance",
                           "lods": "Hidden", "anyFile": "File", "mat": "MaterialFile", "inflation": "Percent"}.items():
            self.assertEqual(of[name], {note: []})
        for name, note in {"Poly": "InPolygon", "Line": "InLine", "Point": "InPoint", "Cloud": "InPointCloud"}.items():
            self.assertEqual(of[name], {"StartRule": [], note: []})
        self.assertEqual(of["Start"], {"StartRule": [], "InMesh": [], "Out": ["separatedShapes"]})
        # What is hidden is not there to be set, but others choose from it.
        self.assertEqual(told["values"]["lods"], ["low", "mid", "high"])
        self.assertEqual(told["values"]["inflation"], 0.012)

    def testTellsTheSameInWords(self):
        told = self.gable("info", "p/rules/main.cga")
        for part in ["A house.", "Lot *", "height", "float = 9", "@Range(min=3, max=30, restricted=true)", "@InPolygon",
                     "missing: /Gone/gone.cga", "and 1 of imported files, which --all lists", "Red"]:
            self.assertIn(part, told)
        self.assertNotIn("w.width", told)
        everything = self.gable("info", "p/rules/main.cga", "--all")
        self.assertIn("w.width", everything)
        self.assertNotIn("of imported files", everything)

    def testFailsForRulesThatCannotBeRead(self):
        self.gable("info", "gone.cga", status=FILE)
        self.put("p/rules/main.cga", "Lot --> extrude(\n")
        self.gable("info", "p/rules/main.cga", status=WRONG)

    def testReportsAreATable(self):
        self.gable("generate", "p/rules/main.cga", "-o", "x.glb", "--reports", "x.csv")
        rows = list(csv.DictReader(io.StringIO((self.folder / "x.csv").read_text())))
        self.assertEqual(rows, [
            {"key": "area", "value": "", "count": "1", "sum": "2", "average": "2", "minimum": "2", "maximum": "2"},
            {"key": "kind", "value": 'a,"b"', "count": "1", "sum": "", "average": "", "minimum": "", "maximum": ""}])
        self.gable("generate", "p/rules/main.cga", "-o", "x.glb", "--reports", "nowhere/x.csv", status=FILE)

    TWO = ('{"type":"FeatureCollection","features":['
           '{"type":"Feature","id":"A1","properties":{"n":2},"geometry":{"type":"Polygon","coordinates":'
           '[[[7.4200,43.7350],[7.4203,43.7350],[7.4203,43.7352],[7.4200,43.7350]]]}},'
           '{"type":"Feature","properties":{"n":5,"name":"b,c"},"geometry":{"type":"Polygon","coordinates":'
           '[[[7.4300,43.7350],[7.4303,43.7350],[7.4303,43.7352],[7.4300,43.7350]]]}}]}')
    RULE = 'attr n = 0\nLot --> report("n", n) report("n", 1) report("kind", case n > 3 : "big" else : "small") X.\n'

    def testReportsOfEachShapeAreATable(self):
        self.put("two.geojson", self.TWO)
        self.put("n.cga", self.RULE)
        self.gable("generate", "n.cga", "--shapes", "two.geojson", "-o", "x.glb", "--reports-by-shape", "x.csv")
        rows = list(csv.reader(io.StringIO((self.folder / "x.csv").read_text())))
        self.assertEqual(rows, [
            ["shape", "id", "key", "value", "count", "sum", "average", "minimum", "maximum"],
            ["A1", "A1", "kind", "small", "1", "", "", "", ""],
            ["A1", "A1", "n", "", "2", "3", "1.5", "1", "2"],
            ["b,c", "", "kind", "big", "1", "", "", "", ""],
            ["b,c", "", "n", "", "2", "6", "3", "1", "5"]])

    def testReportsAreARowForEachShape(self):
        self.put("two.geojson", self.TWO)
        self.put("n.cga", self.RULE.replace("Lot -->", 'Lot --> report("area", n * 1.1) report("tiny", n * 1e-9)'))
        self.gable("generate", "n.cga", "--shapes", "two.geojson", "-o", "x.glb", "--report-rows", "x.csv", "--reports-by-shape", "-")
        rows = list(csv.reader(io.StringIO((self.folder / "x.csv").read_text())))
        self.assertEqual(rows, [["shape", "id", "area", "kind", "n", "tiny"],
                                ["A1", "A1", "2.2", "small", "3", "2e-09"],
                                ["b,c", "", "5.5", "big", "6", "5e-09"]])
        told = json.loads(self.gable("generate", "n.cga", "--shapes", "two.geojson", "-o", "x.glb", "--report-rows", "-", "--json"))
        self.assertEqual(told["tableOfRows"], (self.folder / "x.csv").read_text())

    def testABoxTakesThePartOfAMap(self):
        self.put("two.geojson", self.TWO)
        self.put("n.cga", self.RULE)
        shapes = ("generate", "n.cga", "--shapes", "two.geojson", "-o", "x.glb", "--reports", "x.csv")
        self.gable(*shapes, "--box", "7.429,43.73,7.44,43.74")
        self.assertIn("n,,2,6,3,1,5", (self.folder / "x.csv").read_text())
        told = self.gable(*shapes, "--box", "8,43,9,44", status=WRONG)
        self.assertIn("none of the 2 shapes lies in the box 8,43,9,44 [box-empty]", told)
        self.assertIn("the middles of all lie in 7.42", told)
        self.assertIn("west,south,east,north", self.gable(*shapes, "--box", "8,43,9", status=USAGE))

    def testNumbersAndTextsUnderOneKeyAreCollectedByThemselves(self):
        self.put("mixed.cga", 'Lot --> report("k", "t") report("k", 2) report("k", true) report("k", 6) X.\n')
        self.gable("generate", "mixed.cga", "-o", "x.glb", "--reports", "x.csv", "--stats", "x.json")
        rows = [r.split(",") for r in (self.folder / "x.csv").read_text().splitlines()[1:]]
        self.assertEqual(rows, [["k", "t", "1", "", "", "", ""], ["k", "true", "1", "", "", "", ""],
                                ["k", "", "2", "8", "4", "2", "6"]])
        self.assertEqual(json.loads((self.folder / "x.json").read_text())["reports"]["k"],
                         {"n": 4, "sum": 8, "avg": 4, "min": 2, "max": 6, "values": {"t": 1, "true": 1}})


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v", *sys.argv[3:]])
