#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Places from maps on the command line: city_test.py GABLE FOLDER.

A map of a few features, the same for each test. Files are made in FOLDER. Run from the repository's root.
"""
import json
import struct
import sys
import unittest

from cli_test import FILE, USAGE, WRONG, Case


def feature(kind, coordinates, **tags):
    return {"type": "Feature", "properties": tags, "geometry": {"type": kind, "coordinates": coordinates}}


def square(x, y, size):
    return [[[x, y], [x + size, y], [x + size, y + size], [x, y + size], [x, y]]]


MAP = {
    "type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:25832"}},
    "features": [
        feature("Polygon", square(0, 0, 12), building="yes", **{"building:levels": "4"}),
        feature("Polygon", square(60, 40, 20), building="yes", height="15 m"),
        feature("LineString", [[-10, 25], [40, 25], [100, 25]], highway="residential", lanes="2"),
        feature("LineString", [[40, -10], [40, 25], [40, 80]], highway="residential", oneway="no"),
        feature("Polygon", square(50, 0, 15), leisure="park"),
        feature("LineString", [[5, 5]], highway="residential"),
    ],
}


def heights(at, size=12, step=20):
    """A TIFF file of heights in the map's own metres, from (-40, 200) to the south and the east; `at` gives each."""
    data = b"".join(struct.pack("<f", at(-40 + (c + 0.5) * step, 200 - (r + 0.5) * step))
                    for r in range(size) for c in range(size))
    place = struct.pack("<9d", step, step, 0, 0, 0, 0, -40, 200, 0)
    tags = [(256, 4, 1, size), (257, 4, 1, size), (258, 3, 1, 32), (259, 3, 1, 1), (262, 3, 1, 1), (273, 4, 1, 8), (277, 3, 1, 1),
            (278, 4, 1, size), (279, 4, 1, len(data)), (339, 3, 1, 3), (33550, 12, 3, 8 + len(data)),
            (33922, 12, 6, 32 + len(data))]
    directory = struct.pack("<H", len(tags)) + b"".join(struct.pack("<HHII", *t) for t in tags)
    return b"II*\0" + struct.pack("<I", 8 + len(data) + len(place)) + data + place + directory + bytes(4)


class City(Case):
    def setUp(self):
        super().setUp()
        self.put("map.geojson", json.dumps(MAP))

    def city(self, *arguments, **expected):
        return self.run_gable("city", *arguments, **expected)

    def read(self, name):
        return json.loads((self.folder / name).read_text())

    def testSurfacesAddUpToTheBox(self):
        self.city("map.geojson", "--plan", "plan.geojson", "--stats", "stats.json")
        stats = self.read("stats.json")
        areas = {name: s["area"] for name, s in stats["surfaces"].items()}
        self.assertAlmostEqual(sum(areas.values()) / (80 * 60), 1, delta=1e-3)
        self.assertAlmostEqual(areas["Footprint"], 12 * 12 + 20 * 20, delta=1)
        for name in ("Carriageway", "Sidewalk", "Junction", "Park", "Lot"):
            self.assertGreater(areas[name], 0, name)
        pieces = sum(s["pieces"] for s in stats["surfaces"].values())
        surfaces = [f for f in self.read("plan.geojson")["features"] if f["geometry"]["type"] == "Polygon"]
        self.assertEqual(len(surfaces), pieces)

    def testAModelIsTheSameWithAnyNumberOfThreads(self):
        for jobs in ("1", "2"):
            self.city("map.geojson", "--jobs", jobs, "-o", f"{jobs}.glb", "--stats", "stats.json")
            figures = self.read("stats.json")
            self.assertEqual(figures["fileBytes"], (self.folder / f"{jobs}.glb").stat().st_size)
            self.assertGreater(figures["savedBytes"], 0)
        one, two = ((self.folder / f"{jobs}.glb").read_bytes() for jobs in ("1", "2"))
        self.assertGreater(len(one), 10_000)
        self.assertEqual(one, two)

    def testAPictureIsDrawnFromTheSameDerivation(self):
        self.city("map.geojson", "--picture", "a.png", "--size", "64x36", "--samples", "1", "--eye=0,60,120",
                  "--target=0,0,0")
        picture = (self.folder / "a.png").read_bytes()
        self.assertEqual(picture[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(int.from_bytes(picture[16:20], "big"), 64)
        self.city("map.geojson", "--picture", "a.jpg", status=USAGE, says=".png")
        self.city("map.geojson", "--picture", "a.png", "--eye=0,60,120", status=USAGE, says="--target")
        self.city("map.geojson", "-o", "tiles/", "--picture", "a.png", status=USAGE, says="--picture")

    def testRulesOfTheUserTakeTheirPlace(self):
        (self.folder / "rules").mkdir()
        self.put("rules/city.cga", "@StartRule Ground --> Flat.\nBuilding --> extrude(7) Block.\n")
        self.city("map.geojson", "--rules", "rules", "-o", "own.obj")
        text = (self.folder / "own.obj").read_text()
        self.assertIn("g Block", text)
        self.assertIn("g Flat", text)

    def testNamesOfImportsAreFoundForSet(self):
        for name, meant in (("building_levels", "houses.building_levels"), ("building_level", "houses.building_levels"),
                            ("plantng", "planting")):
            told = self.city("map.geojson", "--set", f"{name}=3", "-o", "a.glb", status=WRONG, says=f"did you mean '{meant}'?")
            self.assertIn("rules/city.cga lists what --set takes", told)
        self.city("map.geojson", "--set", "zzzzzz=3", "-o", "a.glb", status=WRONG, says="gable info --all lists them")
        self.put("lib.cga", "attr depth = 1\nWindow --> X.\n")
        self.put("two.cga", 'import a : "lib.cga"\nimport b : "lib.cga"\nLot --> a.Window\n')
        for option in ("--set", "--start"):
            value, meant = ("depth=2", "depth") if option == "--set" else ("Windw", "Window")
            self.run_gable("generate", "two.cga", option, value, "-o", "a.glb", status=WRONG,
                           says=f"did you mean 'a.{meant}' or 'b.{meant}'?")

    def testRulesThatACityDoesNotCallAreTold(self):
        (self.folder / "own").mkdir()
        self.put("own/city.cga", "@StartRule Ground --> Flat.\nBulding --> extrude(7) Wall\nWall --> X.\nKirb --> X.\nHelper --> X.\n")
        told = self.city("map.geojson", "--rules", "own", "-o", "own.obj")
        self.assertIn("'Bulding', and 2 shapes 'Building' of the map begin with 'Ground' [city-rule]", told)
        self.assertIn("did you mean 'Building'?", told)
        self.assertIn("did you mean 'Kerb'?", told)
        self.assertIn("calls the rule 'Helper' [unused-rule]", told)
        self.assertNotIn("'Wall'", told)
        self.assertRegex(told, r"note: .* begin with 'Ground': Carriageway \(4\), Footprint \(2\), .*\[city-rules\]")
        # As tiles, which are made of some shapes at a time, the same once.
        tiles = self.city("map.geojson", "--rules", "own", "-o", "own/")
        for code in ("[city-rule]", "[unused-rule]", "[city-rules]"):
            self.assertEqual(tiles.count(code), told.count(code))
        # Whose shapes the map has none of: a slip all the same.
        self.put("own/city.cga", "@StartRule Ground --> Flat.\nBuilding --> X.\nStreetLmp --> X.\nTree --> X.\n")
        told = self.city("map.geojson", "--rules", "own", "-o", "own.obj", says="a city calls no rule 'StreetLmp' [city-rule]")
        self.assertNotIn("'Tree'", told)
        # Names that an import has right are slips in the file all the same, and so are attributes.
        self.put("own/city.cga", 'import city : "/gable/rules/city.cga"\nattr building_level = 0\n@StartRule Ground --> X.\n'
                                 "Building --> extrude(building_level) X.\nBulding --> X.\n")
        told = self.city("map.geojson", "--rules", "own", "-o", "own.obj", says="a city calls no rule 'Bulding': it begins with 'Building'")
        self.assertIn("sets the attribute 'building_level': no shape has it [city-attribute]", told)
        self.assertIn("did you mean 'building_levels'?", told)
        # Those that come with Gable have one for everything.
        for place in ("all.obj", "all/"):
            told = self.city("map.geojson", "-o", place)
            for code in ("city-rule", "unused-rule", "city-attribute", "unused-property"):
                self.assertNotIn(code, told)

    def testReportsOfRulesAreTables(self):
        (self.folder / "own").mkdir()
        self.put("own/city.cga", "@StartRule Ground --> NIL\nBuilding --> report(\"area\", geometry.area) Block.\n")
        table = self.city("map.geojson", "--rules", "own", "--reports", "-")
        self.assertIn("key,value,count,sum,average,minimum,maximum\narea,,2,544,272,144,400\n", table)
        self.city("map.geojson", "--rules", "own", "--reports-by-shape", "rows.csv", "-o", "a.glb", "--stats", "stats.json")
        rows = (self.folder / "rows.csv").read_text().splitlines()
        self.assertEqual(rows[1:], ["Building,Building/feature/1,area,,1,144,144,144,144",
                                    "Building,Building/feature/2,area,,1,400,400,400,400"])
        self.assertEqual(self.read("stats.json")["reports"], {"area": {"n": 2, "sum": 544, "avg": 272, "min": 144, "max": 400}})
        self.city("map.geojson", "--rules", "own", "--reports", "-", "-o", "tiles/", status=USAGE, says="--reports is for a model")

    def testAnAttributeOfTheMapIsDeclaredOnce(self):
        (self.folder / "once").mkdir()
        house = 'attr heritage = "none"\nattr roof_colour = ""\nHouse --> print(heritage + roof_colour) Block.\n'
        self.put("once/house.cga", house)
        houses = [feature("Polygon", square(30 * i, 0, 14), building="yes", heritage=h, **{"roof:colour": "red"})
                  for i, h in enumerate(("listed", "old"))]
        self.put("heritage.geojson", json.dumps({**MAP, "features": houses}))
        main = '@StartRule Ground --> NIL\nBuilding --> houses.House\n'
        said = {"": ("listed#ff0000", "old#ff0000"), " (heritage)": ("none#ff0000",), " ()": ("none",),
                ' (heritage = "given")': ("given#ff0000",)}
        for brackets, texts in said.items():
            self.put("once/city.cga", f'import houses : "house.cga"{brackets}\n{main}')
            told = self.city("heritage.geojson", "--rules", "once", "-o", "a.obj")
            for text in texts:
                self.assertIn(text, told, brackets)
        # The importer's own goes before the map's way around it.
        self.put("once/city.cga", f'import houses : "house.cga"\nattr heritage = "mine"\n{main}')
        self.assertIn("listed#ff0000", self.city("heritage.geojson", "--rules", "once", "-o", "a.obj"))
        # Other shapes set attributes of imports by their whole names.
        self.put("once/lot.cga", 'import houses : "house.cga"\nLot --> houses.House\n')
        self.assertIn("none", self.run_gable("generate", "once/lot.cga", "--shapes", "heritage.geojson", "-o", "a.obj"))

    def testAPlaceLiesOnItsTerrain(self):
        (self.folder / "heights.tif").write_bytes(heights(lambda x, y: 200 + 0.3 * x + 0.2 * y))
        for jobs in ("1", "2"):
            self.city("map.geojson", "--terrain", "heights.tif", "--jobs", jobs, "-o", f"{jobs}.glb")
        one, two = ((self.folder / f"{jobs}.glb").read_bytes() for jobs in ("1", "2"))
        self.assertEqual(one, two)
        self.city("map.geojson", "--terrain", "heights.tif", "--stats", "stats.json")
        stats = self.read("stats.json")
        self.assertTrue(195 < stats["lowest"] < 210 and 225 < stats["highest"] < 245, stats["lowest"])
        self.assertGreater(stats["shapes"]["Plinth"], 0)
        self.put("own.cga", "@StartRule Ground --> Flat.\nBuilding --> extrude(7) Block.\nPlinth --> Stone.\n")
        self.city("map.geojson", "--terrain", "heights.tif", "--rules", "own.cga", "-o", "own.obj")
        ys = [float(line.split()[2]) for line in (self.folder / "own.obj").read_text().splitlines() if line.startswith("v ")]
        self.assertTrue(190 < min(ys) and max(ys) < 260)
        for depth, low in (("30", 160), ("0", 190)):
            self.city("map.geojson", "--terrain", "heights.tif", "--soil", depth, "--rules", "own.cga", "-o", "own.obj")
            ys = [float(line.split()[2]) for line in (self.folder / "own.obj").read_text().splitlines() if line.startswith("v ")]
            self.assertTrue(low < min(ys) < low + 20, (depth, min(ys)))

    def testHeightsThatDoNotFitAreErrors(self):
        self.city("map.geojson", "--terrain", "none.tif", "-o", "a.obj", status=FILE, says="none.tif")
        self.put("broken.tif", "II*")
        self.city("map.geojson", "--terrain", "broken.tif", "-o", "a.obj", status=WRONG, says="heights-broken")
        self.put("map.png", "x")
        self.city("map.geojson", "--terrain", "map.png", "-o", "a.obj", status=WRONG, says="GeoTIFF")
        (self.folder / "void.tif").write_bytes(heights(lambda x, y: 200 if x > 20 else float("nan")))
        self.city("map.geojson", "--terrain", "void.tif", "--stats", "s.json", says="filled")

    def testHousesLookAsInTheirCountry(self):
        rules = '@StartRule Ground --> NIL\nattr country = ""\nattr kind = ""\nBuilding --> print(country) print(kind) Block.\n'
        self.put("own.cga", rules)
        self.city("map.geojson", "--rules", "own.cga", "--country", "fr", "-o", "a.obj", says="FR")
        # The map lies at the foot of the Gulf of Guinea's meridian: no country of the table.
        self.city("map.geojson", "--rules", "own.cga", "-o", "a.obj", says="apartments")
        for none in ("France", "XX", "UK"):
            self.city("map.geojson", "--country", none, "-o", "b.glb", status=USAGE, says="--country")

    def testParksKnowWhetherTheMapHasPathsInThem(self):
        park = feature("Polygon", square(14, 12, 44), leisure="park")
        path = feature("LineString", [[10, 30], [36, 28], [60, 32]], highway="footway")
        self.put("own.cga", "@StartRule Ground --> NIL\nattr has_paths = false\nPark --> print(has_paths) Grass.\n")
        for features, said in (([park], "false"), ([park, path], "true")):
            self.put("park.geojson", json.dumps({**MAP, "features": MAP["features"][:2] + features}))
            self.assertIn(said, self.city("park.geojson", "--rules", "own.cga", "-o", "a.obj"))
        # Without paths a park is laid out by the rules of gardens.
        self.put("park.geojson", json.dumps({**MAP, "features": MAP["features"][:2] + [park]}))
        self.city("park.geojson", "-o", "park.obj")
        self.assertIn("Spray", (self.folder / "park.obj").read_text())

    def testAllStylesAndRoofsAreBuilt(self):
        shapes = ("flat", "gabled", "hipped", "pyramidal", "half-hipped", "mansard", "dome", "onion", "skillion",
                  "gambrel", "round", "sawtooth")
        houses = [feature("Polygon", square(30 * i, 0, 14), building="yes", height="12", **{"roof:shape": shape})
                  for i, shape in enumerate(shapes)]
        kinds = ("house", "church", "school", "industrial", "garage", "shed", "retail", "public")
        others = [feature("Polygon", square(30 * i, 40, 14), building=kind) for i, kind in enumerate(kinds)]
        for style in ("block", "riviera", "haussmann", "row", "family", "modern", "tower", "school"):
            # A height of the map is that of the roof, but for what stands on it; steeples are higher.
            for features, most in ((houses, 14.7), (others, 32)):
                self.put("all.geojson", json.dumps({**MAP, "features": features}))
                self.assertEqual(self.city("all.geojson", "--set", f"style={style}", "-o", "all.obj"), "")
                heights = [float(line.split()[2]) for line in (self.folder / "all.obj").read_text().splitlines()
                           if line.startswith("v ")]
                self.assertLess(max(heights), most, style)
                self.assertGreater(max(heights), 11.9, style)

    def testWhatIsMeantOtherwiseIsTold(self):
        houses = [feature("Polygon", square(30 * i, 0, 14), id=f"h{i}", building="yes", height="6 floors", heigth="12")
                  for i in range(7)]
        self.put("slips.geojson", json.dumps({**MAP, "features": houses}))
        told = self.city("slips.geojson", "--stats", "slips.json")
        self.assertEqual(told.count("[map-value]"), 1)
        self.assertEqual(told.count("[map-name]"), 1)
        self.assertIn("7 features", told)
        self.assertIn("h4 ('6 floors'), ..", told)
        self.assertIn("did you mean 'height'", told)
        self.assertNotIn("no building", told)

    def testAMapOfOtherColumnsIsTold(self):
        houses = [feature("Polygon", square(30 * i, 0, 14), podlazi=3, typ="dum") for i in range(3)]
        self.put("other.geojson", json.dumps({**MAP, "features": houses}))
        told = self.city("other.geojson", "--stats", "other.json")
        self.assertIn("has 3 features and no building; their properties are 'podlazi', 'typ' [map-no-buildings]", told)

    def testWhatAnExtractHasInPartIsListed(self):
        node = '<node id="{0}" lat="{1}" lon="{2}" version="1"/>'
        corners = [(1, 0, 0), (2, 0, 0.0002), (3, 0.0002, 0.0002), (4, 0.0002, 0)]
        way = '<way id="{0}" version="1">{1}<tag k="{2}" v="yes"/></way>'
        refs = lambda ids: "".join(f'<nd ref="{i}"/>' for i in ids)
        self.put("part.osm", '<osm version="0.6">' + "".join(node.format(*c) for c in corners)
                 + way.format(10, refs((1, 2, 3, 4, 1)), "building") + way.format(11, refs((1, 99)), "bridge")
                 + '<relation id="12" version="1"><member type="way" ref="98" role="outer"/>'
                 '<tag k="type" v="multipolygon"/><tag k="landuse" v="grass"/></relation></osm>')
        self.city("part.osm", "--stats", "part.json", says="way/11")
        stats = self.read("part.json")
        self.assertEqual(stats["skipped"], 2)
        self.assertEqual([s["feature"] for s in stats["leftOut"]], ["way/11", "relation/12"])
        for skip in stats["leftOut"]:
            self.assertIn("lacks", skip["reason"])

    def testWhatCannotBeReadIsNamed(self):
        self.city("map.geojson", "-o", "a.glb", says="map-row")
        self.city("map.geojson", "-o", "a.glb", "--strict", status=WRONG, says="is left out")
        self.city("none.osm", "-o", "b.glb", status=FILE, says="none.osm")
        self.city("map.geojson", "--box", "1,2,3", "-o", "b.glb", status=USAGE, says="--box")
        self.city("map.geojson", "--box", "100000,50000,100001,50001", "-o", "b.glb", status=WRONG, says="lies in the box")
        self.city("map.geojson", "--box", "35,-5,45,5", "-o", "c.glb", says="its buildings go from 0,0 to 80,60")
        self.put("empty.geojson", '{"type": "FeatureCollection", "features": []}')
        self.city("empty.geojson", "-o", "b.glb", status=WRONG, says="empty.geojson")
        self.assertFalse((self.folder / "b.glb").exists())


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
