#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Places as 3D Tiles on the command line: tiles_test.py GABLE FOLDER.

Tilesets are walked: boxes, errors, triangles and the tables of features are held against each other and against
the one-file model. Files are made in FOLDER. Run from the repository's root.
"""
import json
import os
import re
import resource
import shutil
import signal
import struct
import subprocess
import sys
import time
import unittest
import zlib

from city_test import MAP, feature, heights, square
from cli_test import DONE, FILE, GABLE, USAGE, WRONG, Case

LIMIT = 4

NO_NUMBER = -1


class Tile:
    """The content of a tile, read as the specifications say."""

    def __init__(self, path):
        data = path.read_bytes()
        magic, version, length, json_bytes, kind = struct.unpack_from("<5I", data)
        assert (magic, version, length, kind) == (0x46546C67, 2, len(data), 0x4E4F534A)
        self.json = json.loads(data[20:20 + json_bytes])
        self.buffer = data[28 + json_bytes:]
        self.bytes = len(data)
        assert self.json["buffers"][0]["byteLength"] <= len(self.buffer)

    def view(self, index):
        v = self.json["bufferViews"][index]
        assert v["byteOffset"] % 4 == 0 and v["byteOffset"] + v["byteLength"] <= len(self.buffer)
        return self.buffer[v["byteOffset"]:v["byteOffset"] + v["byteLength"]]

    def accessor(self, index):
        a = self.json["accessors"][index]
        form = {5126: "f", 5120: "b", 5123: "H", 5125: "I"}[a["componentType"]]
        form = "<" + form * {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[a["type"]]
        stride = self.json["bufferViews"][a["bufferView"]].get("byteStride", struct.calcsize(form))
        data = self.view(a["bufferView"])
        return [struct.unpack_from(form, data, a.get("byteOffset", 0) + i * stride) for i in range(a["count"])]

    def primitives(self):
        """Of what is not placed several times."""
        own = [n for n in self.json["nodes"] if "extensions" not in n]
        return self.json["meshes"][own[0]["mesh"]]["primitives"] if own else []

    def instances(self):
        """Of parts that are held once: the primitives, and the places as (translation, rotation, scale, feature)."""
        for n in self.json["nodes"]:
            if "extensions" in n:
                columns = n["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]
                names = ("TRANSLATION", "ROTATION", "SCALE", "_FEATURE_ID_0")
                yield (self.json["meshes"][n["mesh"]]["primitives"], n["translation"],
                       list(zip(*(self.accessor(columns[name]) for name in names))))

    def compressed(self):
        return "EXT_meshopt_compression" in self.json.get("extensionsRequired", [])

    def triangles_of(self, primitives):
        return sum(self.json["accessors"][p["indices"]]["count"] // 3 for p in primitives)

    def triangles(self):
        return self.triangles_of(self.primitives()) + sum(
            self.triangles_of(primitives) * len(places) for primitives, _, places in self.instances())

    def stored(self):
        """Triangles in the file."""
        return sum(self.triangles_of(m["primitives"]) for m in self.json["meshes"])

    def places(self):
        """Positions in the tileset's frame: east, north, up."""
        def corners(primitives, scale, middle):
            for p in primitives:
                # Primitives share vertices that only some of them show.
                positions = self.accessor(p["attributes"]["POSITION"])
                for i in {i for i, in self.accessor(p["indices"])}:
                    yield tuple(a * s + m for a, s, m in zip(positions[i], scale, middle))
        own, node = self.primitives(), self.json["nodes"][0]
        found = list(corners(own, node.get("scale", (1, 1, 1)), node["translation"])) if own else []
        for primitives, middle, places in self.instances():
            part = list(corners(primitives, (1, 1, 1), (0, 0, 0)))
            for translation, rotation, scale, _ in places:
                for at in part:
                    turned = rotated(rotation, [a * s for a, s in zip(at, scale)])
                    found.append(tuple(a + b + m for a, b, m in zip(turned, translation, middle)))
        return [(x, -z, y) for x, y, z in found]

    def table(self):
        table = self.json["extensions"]["EXT_structural_metadata"]["propertyTables"][0]
        columns = {}
        for name, p in table["properties"].items():
            values = self.view(p["values"])
            if "stringOffsets" in p:
                ends = struct.unpack(f"<{table['count'] + 1}I", self.view(p["stringOffsets"]))
                columns[name] = [values[a:b].decode() for a, b in zip(ends, ends[1:])]
            else:
                columns[name] = list(struct.unpack(f"<{table['count']}f", values))
        return [dict(zip(columns, row)) for row in zip(*columns.values())]


def rotated(q, v):
    """A vector turned by the quaternion x, y, z, w."""
    x, y, z, w = q
    a = (y * v[2] - z * v[1] + w * v[0], z * v[0] - x * v[2] + w * v[1], x * v[1] - y * v[0] + w * v[2])
    return (v[0] + 2 * (y * a[2] - z * a[1]), v[1] + 2 * (z * a[0] - x * a[2]), v[2] + 2 * (x * a[1] - y * a[0]))


def sides(node):
    b = node["boundingVolume"]["box"]
    return [(b[i] - b[3 + 4 * i], b[i] + b[3 + 4 * i]) for i in range(3)]


def glb_triangles(path):
    tile = Tile(path)
    meshes = [sum(tile.json["accessors"][p["indices"]]["count"] // 3 for p in m["primitives"]) for m in tile.json["meshes"]]
    return sum(meshes[n["mesh"]] for n in tile.json["nodes"] if "mesh" in n)


class Tiles(Case):
    def setUp(self):
        super().setUp()
        named = json.loads(json.dumps(MAP))
        named["features"][0]["properties"]["name"] = "Villa Běla"
        self.put("map.geojson", json.dumps(named))

    def city(self, *arguments, **expected):
        return self.run_gable("city", *arguments, **expected)

    def tileset(self, folder):
        return json.loads((self.folder / folder / "tileset.json").read_text())

    def walk(self, folder):
        """Every tile with its content and that of the tile above, children after parents."""
        def below(node, parent):
            uri = node.get("content", {}).get("uri")
            yield node, parent, Tile(self.folder / folder / uri) if uri else None
            for child in node.get("children", []):
                yield from below(child, node)
        yield from below(self.tileset(folder)["root"], None)

    def files(self, folder):
        return sorted(p for p in (self.folder / folder).rglob("*") if p.is_file())

    def contents(self, folder):
        return {p.relative_to(self.folder / folder): p.read_bytes() for p in self.files(folder)}

    def testBoxesHoldAndErrorsShrink(self):
        self.city("map.geojson", "-o", "out/", "--tile-triangles", "2000")
        root = self.tileset("out")["root"]
        self.assertEqual((self.tileset("out")["asset"]["version"], root["refine"]), ("1.1", "REPLACE"))
        self.assertEqual(len(root["transform"]), 16)
        self.assertGreaterEqual(self.tileset("out")["geometricError"], root["geometricError"])
        levels = 0
        for node, parent, tile in self.walk("out"):
            for child, around in zip(sides(node), sides(parent or node)):
                self.assertTrue(around[0] - 1e-9 <= child[0] <= child[1] <= around[1] + 1e-9)
            if parent:
                self.assertLess(node["geometricError"], parent["geometricError"])
            if "children" not in node:
                self.assertEqual(node["geometricError"], 0)
            levels += bool(parent)
            box = sides(node)
            for place in tile.places() if tile else ():
                self.assertTrue(all(low <= v <= high for v, (low, high) in zip(place, box)), (place, box))
        self.assertGreater(levels, 4)

    def testTheFinestTilesAreTheModel(self):
        told = self.city("map.geojson", "-o", "out/", "--tile-triangles", "2000", "--stats", "-")
        stats = json.loads(told[told.index("{"):told.rindex("}") + 1])["tiles"]
        self.city("map.geojson", "-o", "one.glb")
        leaves = [t for n, _, t in self.walk("out") if "children" not in n]
        self.assertEqual(sum(t.triangles() for t in leaves), glb_triangles(self.folder / "one.glb"))
        self.assertEqual(stats["triangles"], sum(t.triangles() for t in leaves))
        self.assertEqual(stats["tiles"], sum(p.suffix == ".glb" for p in self.files("out/tiles")))
        self.assertEqual(stats["bytes"], sum(len(b) for b in self.contents("out").values()))
        # Coarse ones about as many: those that would have more are coarser. Of the finest, those have half as many again
        # that are small over what they show, or a tree more, which is not taken apart.
        tree = 3400
        for _, _, t in self.walk("out"):
            self.assertLessEqual(t.stored() if t else 0, 2000 + tree)

    def testAViewerFindsTheBuildings(self):
        self.city("map.geojson", "-o", "out/", "--tile-triangles", "2000")
        found = {}
        for node, _, tile in self.walk("out"):
            rows = tile.table() if tile else []
            for p in tile.primitives() if tile else ():
                ids = {int(i) for i, in tile.accessor(p["attributes"]["_FEATURE_ID_0"])}
                self.assertLess(max(ids), len(rows))
                self.assertEqual(p["extensions"]["EXT_mesh_features"]["featureIds"][0]["featureCount"], len(rows))
                indices = [i for i, in tile.accessor(p["indices"])]
                self.assertLess(max(indices), tile.json["accessors"][p["attributes"]["POSITION"]]["count"])
            if "children" not in node:
                for row in rows:
                    found.setdefault(row["id"], []).append(row)
        villa, = [r for rows in found.values() for r in rows if r["name"] == "Villa Běla" and r["shape"] == "Building"][:1]
        self.assertEqual((villa["type"], villa["levels"]), ("yes", 4))
        self.assertEqual(json.loads(villa["attributes"])["building:levels"], "4")
        heights = [r["height"] for r in found[villa["id"]]]
        self.assertTrue(any(12 < h < 18 for h in heights), heights)
        self.assertTrue(any(r["levels"] == NO_NUMBER for rows in found.values() for r in rows))

    def testFilesAreTheSameWithAnyNumberOfThreads(self):
        for jobs in ("1", "4"):
            self.city("map.geojson", "--jobs", jobs, "--tile-triangles", "1000", "-o", f"{jobs}/")
        self.assertEqual(self.contents("1"), self.contents("4"))

    def testAFolderIsWrittenAgainAndOtherFilesStay(self):
        self.city("map.geojson", "-o", "out/", "--tile-triangles", "500")
        many = len(self.files("out"))
        self.put("out/tiles/mine.txt", "mine")
        self.put("out/notes.txt", "mine")
        self.city("map.geojson", "-o", "out/tileset.json")
        few = self.files("out")
        self.assertLess(len(few), many)
        self.assertTrue((self.folder / "out/notes.txt").exists() and (self.folder / "out/tiles/mine.txt").exists())
        self.city("map.geojson", "-o", "fresh/")
        self.assertEqual({k: v for k, v in self.contents("out").items() if k.suffix != ".txt"}, self.contents("fresh"))

    def testFoldersOfOthersAreLeftAlone(self):
        (self.folder / "theirs").mkdir()
        self.put("theirs/tileset.json", '{"asset": {"version": "1.0", "generator": "other"}}')
        self.city("map.geojson", "-o", "theirs", status=FILE, says="tiles-folder")
        self.assertEqual(len(self.files("theirs")), 1)
        (self.folder / "full/tiles").mkdir(parents=True)
        self.put("full/tiles/a.bin", "x")
        self.city("map.geojson", "-o", "full/", status=FILE, says="tiles-folder")
        self.put("file", "x")
        self.city("map.geojson", "-o", "file/", status=FILE, says="file")
        self.assertEqual((self.folder / "file").read_text(), "x")

    def testWhatCannotBeBuiltIsTold(self):
        (self.folder / "rules").mkdir()
        self.put("rules/city.cga", "@StartRule Ground --> NIL\n")
        self.city("map.geojson", "--rules", "rules", "-o", "none/", status=WRONG, says="tiles-empty")
        self.put("rules/city.cga", "@StartRule Ground --> split(x) { 0.001 : X }* X --> extrude(1) Y.\n")
        self.run_gable("tiles", "rules/city.cga", "--lot", "90x90", "--max-shapes", "100", "-o", "cut/", status=LIMIT)
        self.assertFalse((self.folder / "cut/tileset.json").exists())
        self.city("map.geojson", "--set", "nothing=1", "-o", "set/", status=WRONG, says="unknown-attribute")

    def testRulesOnShapesBecomeTiles(self):
        lots = [feature("Polygon", square(20 * x, 20 * y, 15), id=f"lot {x} {y}") for x in range(12) for y in range(12)]
        self.put("lots.geojson", json.dumps(dict(MAP, features=lots)))
        self.put("boxes.cga", "Lot --> extrude(rand(5, 9)) comp(f) { side : Wall | all : X }\n"
                              "Wall --> X split(x) { { ~1.5 : s('0.5, '0.5, 0) center(xy) t(0, 0, 0.01) X }* }\n")
        self.run_gable("tiles", "boxes.cga", "--shapes", "lots.geojson", "-o", "out", "--tile-triangles", "3000")
        self.run_gable("generate", "boxes.cga", "--shapes", "lots.geojson", "-o", "one.glb")
        tiles = list(self.walk("out"))
        leaves = [t for n, _, t in tiles if "children" not in n]
        self.assertEqual(sum(t.triangles() for t in leaves), glb_triangles(self.folder / "one.glb"))
        self.assertEqual(sum(len(t.table()) for t in leaves), len(lots))
        # Windows go first, walls stay. A tile that would save little is not there: those below are shown.
        shown = {id(node): tile for node, _, tile in tiles}
        def coarsest(node):
            tile = shown[id(node)]
            return tile.triangles() if tile else sum(map(coarsest, node["children"]))
        coarse = coarsest(tiles[0][0])
        self.assertTrue(len(lots) * 4 < coarse < len(lots) * 14, coarse)

    def testPartsThatOccurOftenAreHeldOnce(self):
        lots = [feature("Polygon", square(20 * x, 0, 15), id=f"lot {x}") for x in range(12)]
        self.put("lots.geojson", json.dumps(dict(MAP, features=lots)))
        self.put("balls.cga", "Lot --> [ extrude(2) Wall. ] t(1, 2, 1) rotate(rel, scope, 0, rand(0, 90), 20) set(seedian, 1) Ball\n"
                              "Ball --> s(2, 3, 4) primitiveSphere(16, 12) comp(f) { all : Stone. }\n")
        self.run_gable("generate", "balls.cga", "--shapes", "lots.geojson", "-o", "one.glb")
        for compress in ([], ["--compress"] if self.can_compress() else []):
            folder = "out" + "".join(compress)
            self.run_gable("tiles", "balls.cga", "--shapes", "lots.geojson", "--jobs", "4", "-o", folder, *compress)
            (node, _, tile), = self.walk(folder)
            if compress:
                # What is compressed is read by the tests of the page.
                own, instances = sorted(tile.triangles_of(m["primitives"]) for m in tile.json["meshes"])
                self.assertLess((own, 11 * instances), (instances, 2 * glb_triangles(self.folder / "one.glb")))
                self.assertIn("EXT_mesh_gpu_instancing", tile.json["extensionsRequired"])
                continue
            (primitives, middle, places), = tile.instances()
            self.assertEqual(tile.triangles(), glb_triangles(self.folder / "one.glb"))
            self.assertLess(tile.stored() * 5, tile.triangles())
            self.assertIn("EXT_mesh_gpu_instancing", tile.json["extensionsRequired"])
            self.assertIn("EXT_instance_features", tile.json["extensionsUsed"])
            # Each says of which lot it is, and stands in it.
            self.assertEqual(sorted(int(f) for _, _, _, (f,) in places), list(range(12)))
            for translation, rotation, _, (f,) in places:
                self.assertAlmostEqual(sum(q * q for q in rotation), 1, 5)
                lot = int(tile.table()[int(f)]["id"].rsplit(" ", 1)[-1].split("/")[-1])
                self.assertLess(abs(translation[0] + middle[0] - (20 * lot + 7)), 8)
            self.assertTrue(all("_FEATURE_ID_0" not in p["attributes"] for p in primitives))
            box = sides(node)
            for place in tile.places():
                self.assertTrue(all(low <= v <= high for v, (low, high) in zip(place, box)), (place, box))

    def testInstancesAreShownAsReadersTakeThem(self):
        """By nodes, or not at all, and with vertices that need no extension; the triangles are the same."""
        lots = [feature("Polygon", square(20 * x, 0, 15), id=f"lot {x}") for x in range(6)]
        self.put("lots.geojson", json.dumps(dict(MAP, features=lots)))
        self.put("balls.cga", "Lot --> set(seedian, 1) [ t(1, 0, 1) Ball ] t(8, 0, 1) Ball\n"
                              "Ball --> s(2, 3, 4) primitiveSphere(16, 12) comp(f) { all : Stone. }\n")
        arguments = ("balls.cga", "--shapes", "lots.geojson")
        sizes = {}
        for words in (["gpu"], ["nodes"], ["none"], ["nodes", "--vertices", "float"], ["nodes", "--compress"]):
            if "--compress" in words and not self.can_compress():
                continue
            folder = "".join(words)
            self.run_gable("tiles", *arguments, "-o", folder, "--instancing", *words)
            (node, _, tile), = self.walk(folder)
            sizes[folder] = tile.bytes
            meshes = [tile.triangles_of(m["primitives"]) for m in tile.json["meshes"]]
            if words[0] != "gpu":
                self.assertEqual(sum(meshes[n["mesh"]] for n in tile.json["nodes"]), 12 * 2 * 16 * 11)
                self.assertNotIn("EXT_mesh_gpu_instancing", tile.json["extensionsUsed"])
            used = tile.json.get("extensionsRequired", [])
            self.assertEqual("KHR_mesh_quantization" in used, "float" not in words)
            if words == ["nodes", "--vertices", "float"]:
                self.assertEqual(used, [])
                box = sides(node)
                for n in tile.json["nodes"]:
                    p, = tile.json["meshes"][n["mesh"]]["primitives"]
                    # One feature a mesh: each vertex of it says which lot it is of.
                    lot, = {i for i, in tile.accessor(p["attributes"]["_FEATURE_ID_0"])}
                    middle = 20 * int(tile.table()[int(lot)]["id"].rsplit(" ", 1)[-1].split("/")[-1]) + 7
                    self.assertLess(abs(n["translation"][0] - middle), 9)
                    for at in tile.accessor(p["attributes"]["POSITION"]):
                        x, y, z = (a + b for a, b in zip(rotated(n["rotation"], at), n["translation"]))
                        self.assertTrue(all(low <= v <= high for v, (low, high) in zip((x, -z, y), box)))
        self.assertLess(sizes["gpu"], sizes["nodes"])
        self.assertLess(2 * sizes["nodes"], sizes["none"])
        self.run_gable("tiles", *arguments, "-o", "x", "--instancing", "shapes", status=USAGE)
        self.city("map.geojson", "-o", "x/", "--instancing", "shapes", status=WRONG, says="tiles-form")

    def testTilesSharePictures(self):
        lots = [feature("Polygon", square(40 * x, 40 * y, 30), id=f"{x} {y}") for x in range(4) for y in range(4)]
        self.put("lots.geojson", json.dumps(dict(MAP, features=lots)))
        rows = b"".join(b"\0" + bytes((x * y) % 256 for x in range(3 * 64)) for y in range(64))
        def chunk(kind, data):
            return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        png = (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", 64, 64, 8, 2, 0, 0, 0))
               + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
        (self.folder / "brick.png").write_bytes(png)
        self.put("walls.cga", "Lot --> extrude(rand(5, 9)) comp(f) { all : split(x) { ~1 : split(y) { ~1 : Wall }* }* }\n"
                              "Wall --> setupProjection(0, scope.xy, 2, 2) projectUV(0) texture(\"brick.png\")\n")
        arguments = ("walls.cga", "--shapes", "lots.geojson", "--tile-triangles", "3000")
        told = self.run_gable("tiles", *arguments, "-o", "out", "--stats", "-")
        pictures = [p for p in self.files("out") if p.suffix == ".png"]
        self.assertEqual([p.read_bytes() for p in pictures], [png])
        self.assertEqual(json.loads(told[told.index("{"):told.rindex("}") + 1])["bytes"],
                         sum(len(b) for b in self.contents("out").values()))
        leaves = 0
        for path in (p for p in self.files("out") if p.suffix == ".glb"):
            for image in Tile(path).json.get("images", ()):
                self.assertEqual((path.parent / image["uri"]).resolve(), pictures[0].resolve())
                leaves += 1
        self.assertGreater(leaves, 3)
        # What no tile shows any more goes.
        self.put("walls.cga", "Lot --> extrude(5)\n")
        self.run_gable("tiles", *arguments, "-o", "out")
        self.assertFalse(pictures[0].exists())
        self.put("walls.cga", "Lot --> extrude(5) setupProjection(0, scope.xy, 2, 2) projectUV(0) texture(\"brick.png\")\n")
        self.run_gable("tiles", "plan", *arguments, "-o", "jobs")
        self.run_gable("tiles", "job", "jobs", "0")
        picture, = (p for p in self.files("jobs") if p.suffix == ".png")
        picture.write_bytes(png[:-3])
        self.run_gable("tiles", "merge", "jobs", status=WRONG, says="tiles-unfinished")
        self.run_gable("tiles", "merge", "jobs", "--mend")
        self.assertEqual(picture.read_bytes(), png)

    def can_compress(self):
        told = subprocess.run([str(GABLE), "tiles", "balls.cga", "--lot", "9x9", "--compress", "-o", "try"], cwd=self.folder,
                              check=False, stderr=subprocess.PIPE).stderr
        return b"tiles-compress" not in told

    def testAQuestionAboutOthersIsAnsweredAcrossTiles(self):
        lots = [feature("Polygon", square(15 * x, 0, 15), id=str(x)) for x in range(6)]
        self.put("lots.geojson", json.dumps(dict(MAP, features=lots)))
        self.put("near.cga", "Lot --> extrude(5) label(\"x\") Block\nBlock --> case touches(inter): X. else: NIL\n")
        told = self.run_gable("tiles", "near.cga", "--shapes", "lots.geojson", "-o", "out/")
        self.assertIn("tiles-together", told)
        self.assertEqual([t.triangles() for _, _, t in self.walk("out")], [6 * 12])

    def testManyShapesThatAskAreDividedAsOthersAre(self):
        # More than are divided at a time, far from each other but for every tenth.
        lots = [feature("Polygon", square(30 * (x % 40) + (20 if x % 10 == 0 else 0), 30 * (x // 40), 15), id=str(x)) for x in range(1200)]
        self.put("lots.geojson", json.dumps(dict(MAP, features=lots)))
        ask = "Lot --> extrude(5) label(\"x\") Block\nBlock --> case touches(inter) || overlaps(inter): NIL else: X.\n"
        self.put("near.cga", ask)
        for jobs in ("1", "3"):
            told = self.run_gable("tiles", "near.cga", "--shapes", "lots.geojson", "--jobs", jobs, "--tile-triangles", "1000", "-o",
                                  f"{jobs}/")
            self.assertIn("tiles-together", told)
        full = [t.triangles() for node, _, t in self.walk("1") if not node.get("children")]
        self.run_gable("generate", "near.cga", "--shapes", "lots.geojson", "--stats", "all.json", "-o", "all.glb")
        whole = json.loads((self.folder / "all.json").read_text())["triangles"]
        self.assertLess(whole, 1200 * 12)
        self.assertEqual(sum(full), whole)
        self.assertGreater(len(full), 10)
        self.assertEqual(self.contents("1"), self.contents("3"))

    def testAFullDiskLeavesNoTileset(self):
        def full_disk():
            signal.signal(signal.SIGXFSZ, signal.SIG_DFL)
            resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))
        self.city("map.geojson", "-o", "out/", status=FILE, says="file-unwritable", preexec_fn=full_disk)
        self.assertEqual([p.name for p in self.files("out")], ["unfinished"])
        self.city("map.geojson", "-o", "out/")
        self.assertFalse((self.folder / "out/tiles/unfinished").exists())


BOXES = ("Lot --> extrude(rand(5, 9)) comp(f) { side : Wall | all : X. }\n"
         "Wall --> X. split(x) { { ~5 : s('0.5, '0.5, 0) center(xy) t(0, 0, 0.01) X. }* }\n")


class Jobs(Case):
    """A plan, its jobs in any order and the merge give the bytes of one process, whatever befalls them."""

    COUNT = 72

    def setUp(self):
        super().setUp()
        self.put("boxes.cga", BOXES)
        # More than one unit, and more nodes than one tileset has.
        lots = [feature("Polygon", square(20 * x, 20 * y, 15), id=f"lot {x} {y}", levels=x % 7)
                for x in range(self.COUNT) for y in range(self.COUNT)]
        self.put("lots.geojson", json.dumps(dict(MAP, features=lots)))

    def tiles(self, *arguments, **expected):
        return self.run_gable("tiles", *arguments, **expected)

    def plan(self, folder, *arguments, rules="boxes.cga", **expected):
        return self.tiles("plan", rules, "--shapes", "lots.geojson", "--tile-triangles", "300", "--job-shapes", "100",
                          "-o", folder, *arguments, **expected)

    def contents(self, folder):
        files = (p for p in (self.folder / folder).rglob("*") if p.is_file())
        return {str(p.relative_to(self.folder / folder)): p.read_bytes() for p in files}

    def jobs(self, folder):
        return json.loads((self.folder / folder / "plan/plan.json").read_text())["jobs"]

    def testWhateverHappensTheBytesAreThoseOfOneProcess(self):
        self.tiles("boxes.cga", "--shapes", "lots.geojson", "--tile-triangles", "300", "-o", "one")
        one = self.contents("one")
        self.assertTrue(any(name.startswith("tiles/") and name.endswith(".json") for name in one))
        self.assertFalse([name for name in one if "plan" in name or "unfinished" in name or ".part" in name])
        # Shapes that were in memory, as those of --cut-nested, make the same.
        self.tiles("boxes.cga", "--shapes", "lots.geojson", "--tile-triangles", "300", "--cut-nested", "-o", "whole")
        self.assertEqual(self.contents("whole"), one)

        self.plan("many")
        count = self.jobs("many")
        self.assertGreater(count, 2)
        self.tiles("merge", "many", status=WRONG, says="tiles-unfinished")
        # Killed in the middle, as a node is that fails.
        killed = subprocess.Popen([str(GABLE), "tiles", "job", "many", "0"], cwd=self.folder)
        time.sleep(0.3)
        killed.kill()
        killed.wait()
        for job in reversed(range(count)):
            self.tiles("job", "many", str(job))
        before = self.contents("many")
        told = self.tiles("job", "many", f"0-{count - 1}", "--stats", "-")
        stats = json.loads(told[told.index("{"):told.rindex("}") + 1])
        self.assertEqual((stats["shapesBefore"], stats["shapes"]), (self.COUNT**2, self.COUNT**2))
        self.assertEqual(self.contents("many"), before)

        # A damaged tile, a missing one and a damaged part are found.
        names = sorted(name for name in before if name.endswith(".glb"))
        damaged = bytearray(before[names[0]])
        damaged[-1] ^= 1
        (self.folder / "many" / names[0]).write_bytes(damaged)
        (self.folder / "many" / names[-1]).unlink()
        part = sorted((self.folder / "many/plan/done").iterdir())[1]
        part.write_bytes(part.read_bytes()[:-9])
        self.tiles("merge", "many", status=WRONG, says="tiles-unfinished")
        self.tiles("merge", "many", "--mend")
        self.assertEqual(self.contents("many"), one)
        self.tiles("merge", "many", status=FILE, says="tiles-plan")

    def testWhatWasBegunGoesOn(self):
        self.plan("out")
        self.tiles("job", "out", "1")
        kept = {n: (self.folder / "out" / n).stat().st_mtime_ns for n in self.contents("out") if n.endswith(".glb")}
        whole = ("boxes.cga", "--shapes", "lots.geojson", "--tile-triangles", "300", "-o", "out")
        # Who runs the other jobs would lose them.
        self.tiles(*whole, status=FILE, says="tiles-planned")
        self.tiles(*whole, "--cut-nested", status=FILE, says="tiles-planned")
        self.assertTrue((self.folder / "out/plan/plan.json").exists())
        self.tiles(*whole, "--replace-plan")
        for name, written in kept.items():
            self.assertEqual((self.folder / "out" / name).stat().st_mtime_ns, written)
        self.assertFalse((self.folder / "out/plan").exists())

    def testAFullDiskEndsAJobWhichIsRunAgain(self):
        def full_disk():
            signal.signal(signal.SIGXFSZ, signal.SIG_DFL)
            resource.setrlimit(resource.RLIMIT_FSIZE, (6_000, 6_000))
        self.plan("out")
        self.tiles("job", "out", "0", status=FILE, says="file-unwritable", preexec_fn=full_disk)
        self.tiles("job", "out", f"0-{self.jobs('out') - 1}")
        self.tiles("merge", "out")

    def testPlansThatDoNotFitAreToldWithTheRemedy(self):
        self.tiles("job", "nowhere", "0", status=FILE, says="tiles-plan")
        self.plan("out")
        self.tiles("job", "out", "99", status=USAGE, says="jobs of the plan")
        self.tiles("job", "out", "1-0", status=USAGE, says="jobs of the plan")
        self.put("boxes.cga", BOXES.replace("rand(5, 9)", "7"))
        self.tiles("job", "out", "0", status=WRONG, says="tiles-plan-changed")
        self.put("boxes.cga", BOXES)
        shapes = self.folder / "out/plan/shapes/0.shapes"
        good = shapes.read_bytes()
        shapes.write_bytes(good[:-1] + b"x")
        self.tiles("job", "out", "0", status=FILE, says="is damaged")
        shapes.write_bytes(good)
        plan = self.folder / "out/plan/plan.json"
        text = plan.read_text()
        plan.write_text(text.replace('"format": 5', '"format": 0'))
        self.tiles("job", "out", "0", status=FILE, says="one version on all machines")
        plan.write_text(text[:100])
        self.tiles("merge", "out", status=FILE, says="tiles-plan")
        plan.write_text(re.sub('"jobs": [0-9]+', '"jobs": 0', text))
        self.tiles("merge", "out", status=FILE, says="it has no jobs")
        plan.write_text(re.sub('"shapes": [0-9]+', '"shapes": 3', text))
        self.tiles("merge", "out", says="are not those it was made with", status=FILE)
        plan.write_text(text)
        job = self.folder / "out/plan/jobs/0.json"
        job.write_text(job.read_text().replace('"name": "0', '"name": "../0'))
        self.tiles("job", "out", "0", status=FILE, says="is damaged")
        (self.folder / "theirs/plan").mkdir(parents=True)
        self.put("theirs/plan/mine.txt", "mine")
        self.plan("theirs", status=FILE, says="tiles-folder")

    def testAPlaceIsMadeInJobsAsWell(self):
        """Streets, ground, terrain and all: the plan of gable city, of more than one job."""
        houses = [feature("Polygon", square(12 * x, 12 * y, 9), building="yes", levels=x % 7) for x in range(45) for y in range(45)]
        self.put("town.geojson", json.dumps(dict(MAP, features=MAP["features"][2:5] + houses)))
        (self.folder / "hill.tif").write_bytes(heights(lambda x, y: 100 + 0.06 * x + 0.03 * y, size=32))
        (self.folder / "plain").mkdir()
        self.put("plain/city.cga", "import b : \"block.cga\"\n@StartRule Ground --> Flat.\nBuilding --> b.Block\n")
        self.put("plain/block.cga", "attr levels = 9\nBlock --> extrude(3 + levels + rand(1)) comp(f) { all : Face. }\n")
        arguments = ("town.geojson", "--terrain", "hill.tif", "--rules", "plain", "--tile-triangles", "3000")
        self.run_gable("city", *arguments, "-o", "many.glb", status=USAGE, says="--tile-triangles is for tiles")
        self.run_gable("city", *arguments, "-o", "one/")
        self.run_gable("city", *arguments, "--plan-jobs", "-o", "many.glb", status=USAGE, says="give -o a folder")
        self.run_gable("city", *arguments, "--compress", "-o", "many.glb", status=USAGE, says="--compress is for tiles")
        self.run_gable("city", *arguments, "--atlas", "512", "-o", "many/", status=USAGE, says="'--atlas' says nothing about tiles")
        self.run_gable("city", *arguments, "--plan-jobs", "--job-shapes", "100", "-o", "many/", says="jobs for")
        count = self.jobs("many")
        self.assertGreater(count, 1)
        self.run_gable("city", *arguments, "-o", "many/", status=FILE, says="tiles-planned")
        terrain = self.folder / "many/plan/terrain.bin"
        good = terrain.read_bytes()
        for bad in (good[:-1], good[:-1] + b"x", b""):
            terrain.write_bytes(bad)
            self.tiles("job", "many", "0", status=FILE, says="terrain.bin' is damaged")
        terrain.write_bytes(good)
        killed = subprocess.Popen([str(GABLE), "tiles", "job", "many", "0"], cwd=self.folder)
        time.sleep(0.2)
        killed.kill()
        killed.wait()
        for job in reversed(range(count)):
            self.tiles("job", "many", str(job), "--threads", str(1 + job % 2))
        self.tiles("merge", "many")
        one = self.contents("one")
        self.assertEqual(self.contents("many"), one)
        # What the ground and the levels are reaches the jobs.
        self.run_gable("city", *arguments[:1], *arguments[3:], "-o", "flat/")
        self.assertNotEqual(self.contents("flat"), one)
        self.run_gable("city", *arguments[:5], "-o", "one.obj")
        faces = (self.folder / "one.obj").read_text().count("\nf ")
        self.assertGreater(faces, 10_000)

    def testTheTimeOfAllIsOne(self):
        self.plan("out")
        self.put("boxes.cga", BOXES)
        begin = time.monotonic()
        self.tiles("job", "out", f"0-{self.jobs('out') - 1}", "--max-seconds", "0.2", status=LIMIT)
        self.assertLess(time.monotonic() - begin, 5)

    def testPlacesAreJoined(self):
        self.put("boxes.cga", BOXES)
        for name, east in (("land/a", 8), ("land/b b", 8.1), ("else", 8)):
            lot = feature("Polygon", square(east, 50, 0.0002))
            self.put("lot.geojson", json.dumps({"type": "FeatureCollection", "features": [lot]}))
            self.tiles("boxes.cga", "--shapes", "lot.geojson", "-o", name)
        self.tiles("join", "land/b b", "land/a", "-o", "land")
        land = json.loads((self.folder / "land/tileset.json").read_text())
        children = land["root"]["children"]
        self.assertEqual([c["content"]["uri"] for c in children], ["a/tileset.json", "b%20b/tileset.json"])
        for child, name in zip(children, ("a", "b b")):
            place = json.loads((self.folder / "land" / name / "tileset.json").read_text())
            box, m, got = place["root"]["boundingVolume"]["box"], place["root"]["transform"], child["boundingVolume"]["box"]
            for k in range(4):
                for axis in range(3):
                    turned = sum(m[4 * i + axis] * box[3 * k + i] for i in range(3)) + (m[12 + axis] if k == 0 else 0)
                    self.assertAlmostEqual(got[3 * k + axis], turned, delta=1e-6)
            low, high = zip(*sides(land["root"]))
            for axis in range(3):
                reach = sum(abs(got[3 * k + axis]) for k in (1, 2, 3))
                self.assertLessEqual(low[axis], got[axis] - reach + 1e-6)
                self.assertGreaterEqual(high[axis], got[axis] + reach - 1e-6)
            self.assertLessEqual(child["geometricError"], land["root"]["geometricError"])
        # Again, and with what cannot be joined.
        self.tiles("join", "land/a", "-o", "land")
        self.tiles("join", "land/a", "land/a/", "-o", "land", status=FILE, says="named twice")
        self.tiles("join", "else", "-o", "land", status=FILE, says="does not lie in")
        self.tiles("join", "land/none", "-o", "land", status=FILE, says="land/none")
        self.tiles("join", "land/a", "-o", "else", status=FILE, says="tiles-join")
        self.tiles("boxes.cga", "--shapes", "lots.geojson", "-o", "land/c")
        place = self.folder / "land/c/tileset.json"
        nowhere = json.loads(place.read_text())
        del nowhere["root"]["transform"]
        place.write_text(json.dumps(nowhere))
        self.tiles("join", "land/c", "-o", "land", status=FILE, says="where it lies on the Earth")
        place.write_text("{")
        self.tiles("join", "land/c", "-o", "land", status=FILE, says="is damaged")
        self.put("land/a/tiles.txt", "")
        self.tiles("join", "land/a", "-o", "land/a", status=FILE, says="does not lie in")

    def testAPageIsPutBesideTilesThatAreThere(self):
        self.tiles("viewer", "nowhere", status=FILE, says="no tileset")
        self.tiles("boxes.cga", "--shapes", "lots.geojson", "-o", "out")
        page = self.folder / "out/index.html"
        page.write_text("mine")
        told = subprocess.run([str(GABLE), "tiles", "viewer", "out"], cwd=self.folder, check=False, stderr=subprocess.PIPE,
                              text=True)
        self.assertEqual((told.returncode, page.read_text()), (FILE, "mine"))
        page.unlink()
        told = subprocess.run([str(GABLE), "tiles", "viewer", "out"], cwd=self.folder, check=False, stderr=subprocess.PIPE,
                              text=True)
        if "is not built" in told.stderr:
            self.skipTest("the page is not built")
        self.assertEqual(told.returncode, 0)
        self.assertTrue(page.exists() and (self.folder / "out/viewer.js").exists())

    def testTilesAreMadeWhereThePageIsNotBuilt(self):
        # A program that lies alone has no page beside it.
        alone = self.folder / "gable"
        os.link(GABLE, alone)
        told = subprocess.run([str(alone), "tiles", "boxes.cga", "--shapes", "lots.geojson", "--viewer", "-o", "out"], check=False,
                              cwd=self.folder, stderr=subprocess.PIPE, text=True)
        self.assertEqual(told.returncode, DONE, told.stderr)
        self.assertIn("gable tiles viewer out/ adds it then", told.stderr)
        self.assertTrue((self.folder / "out/tileset.json").exists())
        told = subprocess.run([str(alone), "tiles", "viewer", "out"], check=False, cwd=self.folder, stderr=subprocess.PIPE, text=True)
        self.assertEqual(told.returncode, FILE, told.stderr)

    def testBracesInPathsAreOnesForGnuParallel(self):
        if not shutil.which("parallel"):
            self.skipTest("GNU parallel is not installed")
        self.plan("a {} {#} {= 1 =}")
        self.tiles("submit", "a {} {#} {= 1 =}", "--parallel", "--options", "-j 2")
        self.tiles("boxes.cga", "--shapes", "lots.geojson", "--tile-triangles", "300", "-o", "one")
        self.assertEqual(self.contents("a {} {#} {= 1 =}"), self.contents("one"))

    def testScriptsForClustersAreWritten(self):
        self.plan("out")
        self.tiles("submit", "out", status=USAGE, says="--slurm or --parallel")
        for kind in ("--slurm", "--parallel"):
            script = self.tiles("submit", "out", kind, "--dry-run").strip().splitlines()[-1]
            for name in ("submit.sh", "array.sh", "merge.sh"):
                subprocess.run(["sh", "-n", self.folder / "out/plan" / name], check=True)
            self.assertTrue(script.endswith("out/plan/submit.sh"), script)
            self.assertEqual(self.tiles("submit", "out", kind, "--dry-run", "--quiet").strip(), script)
            self.assertEqual(json.loads(self.tiles("submit", "out", kind, "--dry-run", "--json"))["script"], script)

    def testWhatAClusterSaysIsNotInTheAnswer(self):
        self.plan("out")
        (self.folder / "bin").mkdir()
        self.put("bin/sbatch", "#!/bin/sh\necho 5\n")
        (self.folder / "bin/sbatch").chmod(0o755)
        done = subprocess.run([str(GABLE), "tiles", "submit", "out", "--slurm", "--json"], cwd=self.folder, text=True,
                              capture_output=True, check=True, env={**os.environ, "PATH": f"{self.folder}/bin:{os.environ['PATH']}"})
        self.assertEqual(json.loads(done.stdout)["status"], DONE)
        self.assertIn("jobs 5, merge 5", done.stderr)

    def testCompressedTilesAreSmallAndInPlace(self):
        arguments = ("boxes.cga", "--shapes", "lots.geojson", "--compress", "--tile-triangles", "20000", "-o", "small")
        if b"tiles-compress" in subprocess.run([str(GABLE), "tiles", *arguments], cwd=self.folder, check=False,
                                               stderr=subprocess.PIPE).stderr:
            self.skipTest("built without meshoptimizer")
        self.tiles("boxes.cga", "--shapes", "lots.geojson", "--tile-triangles", "20000", "-o", "plain")
        plain, small = (self.contents(f) for f in ("plain", "small"))
        self.assertEqual(plain.keys(), small.keys())
        self.assertLess(sum(map(len, small.values())) * 2.5, sum(map(len, plain.values())))
        for name in (n for n in small if n.endswith(".glb")):
            a, b = Tile(self.folder / "plain" / name), Tile(self.folder / "small" / name)
            self.assertTrue(b.compressed())
            self.assertEqual(a.triangles(), b.triangles())
            self.assertEqual(a.table(), b.table())
            self.assertEqual(len(b.json["buffers"]), 2)
            for ours, theirs in zip(b.primitives(), a.primitives()):
                def box(tile, p):
                    node, accessor = tile.json["nodes"][0], tile.json["accessors"][p["attributes"]["POSITION"]]
                    scale = node.get("scale", [1, 1, 1])
                    return [node["translation"][i] + scale[i] * accessor[k][i] for k in ("min", "max") for i in range(3)]
                for got, wanted in zip(box(b, ours), box(a, theirs)):
                    self.assertLess(abs(got - wanted), 0.0021)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
