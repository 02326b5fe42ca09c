#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""City models and building models: models_test.py GABLE FOLDER. Run from the repository's root.

What is written is checked by tests/written/city_check.py, and compared with what the parsers of others find, where
./test has installed them."""
import json
import shutil
import subprocess
import sys
import unittest
from collections import Counter
from pathlib import Path

from cli_test import DONE, USAGE, WRONG, Case

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests/written"))
import city_check  # noqa: E402

RULES = """attr cityPart = ""
attr cityObject = ""
attr cityStorey = ""
attr floors = 2
attr name = ""

Lot --> split(x) { ~1 : House | 6 : Garden }
House --> s('1, '1, '0.8) report("floor area", geometry.area * floors) extrude(floors * 3) Body
Body --> comp(f) { top : Cap | side : Front | bottom : set(cityPart, "Ground") Base. }
Cap --> roofHip(30) set(cityPart, "Roof") Tiles.
Front --> split(y) { 3 : Storey(split.index) }*
Storey(i) --> set(cityStorey, "Storey " + i) split(x) { ~2 : Brick | 1 : Bay }*
Bay --> split(y) { 1 : Brick | 1.2 : Opening | ~1 : Brick }
Brick --> set(cityPart, "Wall") Masonry.
Opening --> set(cityPart, "Window") split(x) { 0.1 : Wood. | ~1 : Pane. | 0.1 : Wood. }
Garden --> [ Lawn. ] scatter(surface, 5, uniform) { Tree }
Tree --> [ s(0.3, 2, 0.3) primitiveCylinder(6) Trunk. ] t(0, 2, 0) s(2, 2, 2) center(xz) primitiveSphere(6, 4) Crown.
"""
LOTS = {"type": "FeatureCollection", "features": [
    {"type": "Feature", "id": "way/" + name[-1], "properties": {"name": name, "floors": floors, "owner": "O'Neil \"é\""},
     "geometry": {"type": "Polygon", "coordinates": [[[x, 50], [x + 0.0003, 50], [x + 0.0003, 50.0001], [x, 50.0001], [x, 50]]]}}
    for name, floors, x in (("Long Street 1", 2, 14.4), ("Long Street 2", 3, 14.4004))]}


class Models(Case):
    def setUp(self):
        super().setUp()
        self.put("x.cga", RULES)
        self.put("lots.geojson", json.dumps(LOTS))

    def written(self, name, *options):
        self.run_gable("generate", "x.cga", "--shapes", "lots.geojson", "-o", name, "--stats", "stats.json", *options)
        return self.stats()

    def stats(self):
        return json.loads((self.folder / "stats.json").read_text(encoding="utf-8"))

    def sound(self, name):
        table = Counter()
        self.assertEqual(city_check.problems(self.folder / name, table), [])
        return table

    def read_by_others(self, name):
        """What the parsers of other programs find, or None where they are not installed."""
        home = ROOT / "build/validate/node_modules/web-ifc"
        if not home.exists() or not shutil.which("node"):
            self.skipTest("build/validate is not there; ./test installs it")
        done = subprocess.run(["node", ROOT / "tools/validate/figures.mjs", self.folder / name], capture_output=True,
                              text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout)
        self.assertEqual(found["wrong"], [])
        return found

    def testCityJsonHoldsBuildingsWithSemantics(self):
        self.written("a.city.json")
        table = self.sound("a.city.json")
        self.assertEqual(table["Building"], 2)
        self.assertEqual((table["Solid 1.2"], table["Solid 2.2"], table["MultiSurface 2.2"]), (2, 2, 0))
        self.assertGreaterEqual(table["SolitaryVegetationObject"], 2)
        self.assertAlmostEqual(table["m3 1.2"] / table["m3 2.2"], 1, 3)
        # Walls and windows make up the fronts.
        model = json.loads((self.folder / "a.city.json").read_text(encoding="utf-8"))
        self.assertEqual(model["metadata"]["referenceSystem"], "https://www.opengis.net/def/crs/EPSG/0/32633")
        own = model["CityObjects"]["Long Street 1"]["attributes"]
        self.assertEqual((own["floors"], own["owner"]), (2, "O'Neil \"é\""))
        self.assertEqual(own["id"], "way/1")
        self.assertGreater(own["floor area"], 100)
        found = self.read_by_others("a.city.json")
        self.assertEqual(found["objects"]["Building"], 2)
        for surface in ("RoofSurface 2.2", "WallSurface 3", "Window 3", "GroundSurface 1.2"):
            self.assertAlmostEqual(found["areas"][surface], table[surface], 1, surface)

    def testLevelsOfDetailAreChosen(self):
        for lod, kinds in (("1", {"Solid 1.2"}), ("2", {"Solid 2.2"}), ("3", {"MultiSurface 3"})):
            self.written("b.city.json", "--lod", lod)
            table = self.sound("b.city.json")
            self.assertEqual({k for k in table if k.startswith(("Solid ", "MultiSurface "))} - {f"MultiSurface {lod}"},
                             kinds - {f"MultiSurface {lod}"})
        self.run_gable("generate", "x.cga", "--lot", "9x9", "-o", "b.city.json", "--lod", "4", status=USAGE)
        self.run_gable("generate", "x.cga", "--lot", "9x9", "-o", "b.json", status=USAGE, says=".city.json")

    def testThreadsDoNotMatter(self):
        for name in ("city.json", "city.jsonl", "ifc"):
            self.written(f"one.{name}", "--jobs", "1")
            self.written(f"four.{name}", "--jobs", "4")
            self.assertEqual((self.folder / f"one.{name}").read_bytes(),
                             (self.folder / f"four.{name}").read_bytes().replace(b"'four.ifc'", b"'one.ifc'").replace(b"'four'", b"'one'"))

    def testIfcAgreesWithTheModel(self):
        stats = self.written("a.ifc")
        found = self.read_by_others("a.ifc")
        self.assertEqual(found["schema"], "IFC4")
        self.assertEqual(found["triangles"], stats["triangles"])
        self.assertEqual(found["elements"]["IFCBUILDING"], 2)
        self.assertEqual(found["elements"]["IFCROOF"], 2)
        self.assertGreater(found["elements"]["IFCWINDOW"], 10)
        low, high = found["box"]["min"], found["box"]["max"]
        box = stats["bbox"]
        for a in range(3):
            self.assertAlmostEqual(low[a], box["min"][a], 3)
            self.assertAlmostEqual(high[a], box["max"][a], 3)
        text = (self.folder / "a.ifc").read_text(encoding="ascii")
        self.assertIn("IFCPROJECTEDCRS('EPSG:32633'", text)
        self.assertIn("'O''Neil \"\\X2\\00E9\\X0\\\"'", text)
        self.assertIn("$,'Storey 2',$,$", text)

    def testCityModelsAreInitialShapes(self):
        self.written("c.city.json", "--lod", "2")
        self.put("again.cga", 'attr cityType = ""\nattr floors = 0\n'
                 'Lot --> comp(f) { isTagged("RoofSurface") : R(floors) | isTagged("WallSurface") : W. | all : G. }\n'
                 'R(n) --> report("roofs " + cityType, n) Tiles.\n')
        self.run_gable("generate", "again.cga", "--shapes", "c.city.json", "--only", "type=Building", "-o", "c.obj",
                       "--stats", "stats.json")
        self.assertEqual(self.stats()["reports"]["roofs Building"]["sum"] / 4, 2 + 3)
        self.run_gable("generate", "again.cga", "--shapes", "c.city.json", "--only", "type=Bridge", "-o", "c.obj",
                       status=WRONG, says="none has 'type=Bridge'")
        broken = json.loads((self.folder / "c.city.json").read_text(encoding="utf-8"))
        broken["CityObjects"]["Long Street 1"]["geometry"][0]["boundaries"][0][0][0][0] = 10 ** 7
        self.put("d.city.json", json.dumps(broken))
        self.run_gable("generate", "again.cga", "--shapes", "d.city.json", "-o", "c.obj", status=DONE,
                       says="[shape-surface-broken]")

    def testOnlyWhatRulesReadIsWritten(self):
        self.put("r.cga", 'attr floors = 2\nattr lanes = 3\nattr unread = 4\nLot --> extrude(floors * 3) Wall.\n')
        self.run_gable("generate", "r.cga", "--lot", "9x9", "-o", "r.city.json", "--set", "lanes=5")
        model = json.loads((self.folder / "r.city.json").read_text(encoding="utf-8"))
        own = next(iter(model["CityObjects"].values()))["attributes"]
        self.assertEqual((own["floors"], own["lanes"]), (2, 5))
        self.assertNotIn("unread", own)

    def testTheGuidesStoreysAreThree(self):
        guide = (ROOT / "docs/guide/city-models.md").read_text(encoding="utf-8")
        self.put("g.cga", guide.split("```cga\n")[1].split("```")[0])
        self.run_gable("generate", "g.cga", "--lot", "10x8", "-o", "g.ifc")
        storeys = [line.split(",") for line in (self.folder / "g.ifc").read_text(encoding="ascii").splitlines()
                   if "=IFCBUILDINGSTOREY(" in line]
        self.assertEqual([(s[2], s[-1]) for s in storeys],
                         [("'Storey 0'", "0.);"), ("'Storey 1'", "3.);"), ("'Storey 2'", "6.);")])

    def testUsdWithoutInstancesIsWholeInThreeJs(self):
        all_of_it = self.written("a.usda", "--instancing", "none")["triangles"]
        self.assertEqual(self.read_by_others("a.usda")["triangles"], all_of_it)
        # Its loader leaves out what is referred to within the file.
        self.written("shared.usda")
        self.assertLess(self.read_by_others("shared.usda")["triangles"], all_of_it)
        for word in ("gpu", "shapes"):
            self.run_gable("generate", "x.cga", "--shapes", "lots.geojson", "-o", "b.usdz", "--instancing", word,
                           status=USAGE, says=f"has no instancing '{word}'")

    def testAFeatureALineIsReadAsTheModel(self):
        self.put("again.cga", 'Lot --> print(geometry.nFaces) X.\n')
        told = []
        for name in ("a.city.json", "a.city.jsonl"):
            self.written(name)
            told.append(self.run_gable("generate", "again.cga", "--shapes", name, "--start", "Lot", "-o", "again.obj"))
        self.assertGreater(len(told[0]), 20)
        self.assertEqual(told[0], told[1])

    def testALotThatStandsIsABuilding(self):
        self.put("lot.cga", "Lot --> extrude(9)\n")
        self.run_gable("generate", "lot.cga", "-o", "lot.city.json")
        objects = json.loads((self.folder / "lot.city.json").read_text(encoding="utf-8"))["CityObjects"]
        self.assertEqual([o["type"] for o in objects.values()], ["Building"])

    LABELLED = """attr cityPart = ""
Lot --> extrude(6) comp(f) { top : A | side : B }
@Label("roof")
A --> roofHip(30) X.
B --> split(x) { ~1 : tag("wall") C | 1 : D | ~1 : tag("wall") C }
C --> split(x) { ~1 : Y. | ~1 : [ Y. ] [ s('1, 0.2, 0.1) set(cityPart, "Railing") Y. ] }
@Label("front door")
D --> split(y) { 2.1 : split(x) { 0.1 : Y. | ~1 : Z. | 0.1 : Y. } | ~1 : tag("Opening.window") E }
E --> split(x) { ~1 : Z. | 0.1 : Y. | ~1 : Z. }
"""

    def testLabelsAndTagsSayWhatPartsAre(self):
        """Names say nothing here; attributes go before labels, and the nearest label counts."""
        self.put("l.cga", self.LABELLED)
        for options in ([], ["--jobs", "1"], ["--no-sharing"]):
            self.run_gable("generate", "l.cga", "--lot", "12x12", "-o", "l.city.json", *options)
            self.sound("l.city.json")
            objects = json.loads((self.folder / "l.city.json").read_text(encoding="utf-8"))["CityObjects"]
            self.assertEqual(Counter(o["type"] for o in objects.values()), {"Building": 1, "BuildingInstallation": 1})
            full = [g for o in objects.values() if o["type"] == "Building" for g in o["geometry"] if g["lod"] == "3"]
            types = Counter(s["type"] for g in full for s in g["semantics"]["surfaces"])
            self.assertEqual((types["Window"], types["Door"]), (4, 4))
            self.assertEqual(set(types), {"Window", "Door", "RoofSurface", "WallSurface"})
            self.run_gable("generate", "l.cga", "--lot", "12x12", "-o", "l.ifc", *options)
            found = self.read_by_others("l.ifc")["elements"]
            self.assertEqual({k: found.get(k, 0) for k in ("IFCWINDOW", "IFCDOOR", "IFCROOF", "IFCWALL", "IFCRAILING")},
                             {"IFCWINDOW": 4, "IFCDOOR": 4, "IFCROOF": 1, "IFCWALL": 8, "IFCRAILING": 8})
            self.assertNotIn("IFCBUILDINGELEMENTPROXY", found)

    def testLabelsOfShapesThatAskForOthers(self):
        rules = self.LABELLED.replace("Lot --> extrude(6)", "Lot --> case overlaps() : Free. else : Mass\nMass --> extrude(6)")
        self.put("o.cga", rules)
        self.put("lots.geojson", json.dumps(LOTS))
        self.run_gable("generate", "o.cga", "--shapes", "lots.geojson", "--start", "Lot", "-o", "o.ifc")
        found = self.read_by_others("o.ifc")["elements"]
        self.assertEqual((found["IFCBUILDING"], found["IFCWINDOW"], found["IFCDOOR"], found["IFCROOF"]), (2, 8, 8, 2))

    def testSurfacesOfACityModelStayWhatTheyAre(self):
        self.written("c.city.json", "--lod", "2")
        self.put("as.cga", "Lot --> comp(f) { all : X. }\n")
        self.run_gable("generate", "as.cga", "--shapes", "c.city.json", "--only", "type=Building", "--start", "Lot",
                       "-o", "d.ifc")
        found = self.read_by_others("d.ifc")["elements"]
        self.assertGreaterEqual(found["IFCROOF"], 2)
        self.assertGreaterEqual(found["IFCWALL"], 2)
        self.assertNotIn("IFCBUILDINGELEMENTPROXY", found)

    def testWordsThatNameNothingAreTold(self):
        self.put("w.cga", 'attr cityPart = ""\nLot --> extrude(3) set(cityPart, "Widget") Body.\n')
        for name in ("w.city.json", "w.ifc"):
            self.run_gable("generate", "w.cga", "--lot", "9x9", "-o", name, says="'Widget' is no cityPart")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
