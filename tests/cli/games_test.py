#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Models for game engines: games_test.py GABLE FOLDER. Run from the repository's root.

A reader of its own looks at nodes, meshes and triangles of what is written."""
import json
import math
import struct
import sys
import unittest
from pathlib import Path

from cli_test import ROOT, USAGE, Case

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "written"))
import model_check  # noqa: E402

# Two houses, a court, and a lawn without height; the first of the names means something to Godot.
RULES = """attr height = 9
House --> extrude(height) comp(f) { side : Facade | top : Top }
Top --> roofHip(30) Tiles.
Facade --> split(y) { ~3 : split(x) { ~2 : Tile }* }*
Tile --> split(x) { ~1 : Wall. | 1 : split(y) { 1 : Wall. | 1.2 : Window | ~1 : Wall. } | ~1 : Wall. }
Window --> color("#335577") extrude(0.1) Pane.
Court --> extrude(6) comp(f) { side : Wall. }
Lawn --> color("#338833") Grass.
Lot --> case startRule == "Court" : Court case startRule == "Lawn" : Lawn else : House
attr startRule = "House"
"""
# A shop with a flat above: windows in reveals with sills, nothing behind them, and awnings.
SHOP = """Lot --> extrude(6.4) comp(f) { front : Front | right : Front | side : Wall | top : roofGable(38, 0.35, 0.25) Tiles. }
Front --> split(y) { 3.6 : Shop | ~1 : split(x) { ~0.8 : Wall | { ~2.2 : Bay | ~0.8 : Wall }* } }
Shop --> split(y) { ~1 : Ground | 0.7 : extrude(0.12) color("#6b3f1d") Sign. }
Ground --> split(x) { 0.3 : Pier. | ~1 : ShopWindow | 1.3 : t(0, 0, -0.15) color("#3c5a46") Door. | 0.3 : Pier. }
ShopWindow -->
  [ t(0, scope.sy - 0.3, 0) s('1, 0.6, 1.1) primitiveCube() color("#a83232") Cloth. ]
  split(y) { 0.5 : Stall. | ~1 : t(0, 0, -0.1) split(x) { 0.06 : Frame | { ~1.4 : Pane | 0.06 : Frame }* } }
Bay --> split(x) { ~1 : Wall | 1.1 : Column | ~1 : Wall }
Column --> split(y) { 0.8 : Wall | 0.1 : Sill | 1.4 : t(0, 0, -0.12) setback(0.07) { all : Frame | remainder : Pane } | ~1 : Wall }
Sill --> s('1.1, '1, '1) center(x) extrude(0.15) Sill.
Frame --> extrude(0.06) Frame.
Pane --> color("#54707c") Pane.
Wall --> color("#a9674d") Wall.
"""
# A house of brick whose windows have cream frames and dark panes: of each frame, reveal and sill most is hidden.
ROW = """Lot --> extrude(9) comp(f) { front : Front | side : Wall | top : roofGable(45) Tiles. }
Front --> split(y) { { ~3 : split(x) { { ~0.5 : Wall | ~1.4 : Bay | ~0.5 : Wall }* } }* }
Bay --> split(y) { 0.6 : Wall | ~1 : Window | 0.3 : Wall }
Window --> t(0, 0, -0.09) split(x) { 0.1 : Frame | ~1 : split(y) { 0.1 : Frame | ~1 : Sash | 0.1 : Frame } | 0.1 : Frame }
Sash --> [ color("#2b3338") Pane. ] split(x) { { ~0.4 : NIL | 0.03 : Frame }* | ~0.4 : NIL }
Frame --> [ t(0, 0, -0.2) s('1, '1, 0.15) color("#efe9d8") primitiveCube() Frame. ] color("#efe9d8") extrude(0.07) Frame.
Wall --> color("#7a4636") Wall.
"""
LOTS = (("House-col 1", "House", 0, 0, 20, 10), ("House-col 1", "House", 40, 0, 20, 10), ("Yard", "Court", 80, 0, 30, 30),
        ("Lawn", "Lawn", 120, 0, 10, 10))

METRES = {"type": "name", "properties": {"name": "EPSG:3857"}}


def lots():
    features = []
    for name, rule, x, y, w, h in LOTS:
        ring = [[x, y], [x + w, y], [x + w, y + h], [x, y + h], [x, y]]
        features.append({"type": "Feature", "properties": {"name": name, "startRule": rule},
                         "geometry": {"type": "Polygon", "coordinates": [ring]}})
    return json.dumps({"type": "FeatureCollection", "crs": METRES, "features": features})


class Glb:
    def __init__(self, path):
        data = path.read_bytes()
        size, = struct.unpack_from("<I", data, 12)
        self.json, self.buffer = json.loads(data[20:20 + size]), data[28 + size:]
        self.top = [self.json["nodes"][n] for n in self.json["scenes"][0]["nodes"]]

    def names(self):
        return [n.get("name", "") for n in self.top]

    def node(self, name):
        found = [n for n in self.json["nodes"] if n.get("name") == name]
        assert len(found) == 1, (name, self.names())
        return found[0]

    def mesh_name(self, node):
        return self.json["meshes"][node["mesh"]]["name"]

    def triangles(self, node):
        """Triples of points in the frame of the node; turned nodes are not met."""
        out = []
        at = node.get("translation", [0, 0, 0])
        for p in self.json["meshes"][node["mesh"]]["primitives"]:
            points, _ = model_check.read_accessor(self.json, self.buffer, self.json["accessors"][p["attributes"]["POSITION"]])
            corners, _ = model_check.read_accessor(self.json, self.buffer, self.json["accessors"][p["indices"]])
            corner = [tuple(points[3 * c + k] + at[k] for k in range(3)) for c in corners]
            out += [tuple(corner[i:i + 3]) for i in range(0, len(corner), 3)]
        return out

    def colours(self, node):
        """Linear light, by triangle."""
        out = []
        for p in self.json["meshes"][node["mesh"]]["primitives"]:
            light = self.json["materials"][p["material"]]["pbrMetallicRoughness"].get("baseColorFactor", [1, 1, 1, 1])[:3]
            out += [light] * (self.json["accessors"][p["indices"]]["count"] // 3)
        return out

    def box(self, node):
        points = [p for t in self.triangles(node) for p in t]
        return [min(p[k] for p in points) for k in range(3)], [max(p[k] for p in points) for k in range(3)]

    def volume(self, node):
        """What closed triangles enclose."""
        return sum(a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                   a[2] * (b[0] * c[1] - b[1] * c[0]) for a, b, c in self.triangles(node)) / 6


def seen(triangles, axes, low, step, width, height):
    """What is seen along the last of the axes, by cell: the depth, 1 for a front, -1 for a back, 0 for nothing, and which triangle."""
    depth, side, which = [-1e9] * (width * height), [0] * (width * height), [-1] * (width * height)
    edge = 1e-4
    for number, triangle in enumerate(triangles):
        at = [[sum(p[k] * a[k] for k in range(3)) for a in axes] for p in triangle]
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = [((x - low[0]) / step - 0.5, (y - low[1]) / step - 0.5, z) for x, y, z in at]
        whole = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        if abs(whole) < 1e-9:
            continue
        for y in range(max(0, math.ceil(min(ay, by, cy) - edge)), min(height - 1, math.floor(max(ay, by, cy) + edge)) + 1):
            for x in range(max(0, math.ceil(min(ax, bx, cx) - edge)), min(width - 1, math.floor(max(ax, bx, cx) + edge)) + 1):
                a = ((cx - bx) * (y - by) - (cy - by) * (x - bx)) / whole
                b = ((ax - cx) * (y - cy) - (ay - cy) * (x - cx)) / whole
                z, i = a * az + b * bz + (1 - a - b) * cz, y * width + x
                if min(a, b, 1 - a - b) >= -edge and z > depth[i] + (edge if whole < 0 else -edge):
                    depth[i], side[i], which[i] = z, 1 if whole > 0 else -1, number
    return depth, side, which


def views(full):
    """From six sides: the axes, where the image begins, and its size, 120 cells over the diagonal of the model."""
    points = {p for t in full for p in t}
    low, high = ([f(p[k] for p in points) for k in range(3)] for f in (min, max))
    step = math.dist(low, high) / 120
    for turn, up in ((0, 0), (90, 0), (180, 0), (270, 0), (40, 0.5), (220, 0.5)):
        sine, cosine = math.sin(math.radians(turn)), math.cos(math.radians(turn))
        u, w = (cosine, 0, -sine), (sine * math.cos(up), math.sin(up), cosine * math.cos(up))
        v = (w[1] * u[2] - w[2] * u[1], w[2] * u[0] - w[0] * u[2], w[0] * u[1] - w[1] * u[0])
        flat = [[sum(p[k] * a[k] for k in range(3)) for p in points] for a in (u, v)]
        yield (u, v, w), [min(f) for f in flat], step, *(int((max(f) - min(f)) / step) + 1 for f in flat)


def holes(full, level, tolerance):
    """The share of points of the full model behind which one looks into the level, or through it, in holes wider than a quarter of
    the tolerance."""
    found = fronts = 0
    for axes, low, step, width, height in views(full):
        depth, side, _ = seen(full, axes, low, step, width, height)
        coarse, coarse_side, _ = seen(level, axes, low, step, width, height)
        reach, slit = math.ceil(tolerance / step), max(1, round(tolerance / 8 / step))

        def around(i, by):
            x, y = i % width, i // width
            return [(y + v) * width + x + u for v in range(-by, by + 1) for u in range(-by, by + 1)
                    if 0 <= x + u < width and 0 <= y + v < height]

        open_ = set()
        for i in (i for i in range(width * height) if side[i] > 0):
            fronts += 1
            if coarse_side[i] < 0:
                is_open = coarse[i] < depth[i] - tolerance
            else:
                # At its sides a level may be narrower by the tolerance.
                near = around(i, reach) if coarse_side[i] == 0 else []
                is_open = len(near) == (2 * reach + 1) ** 2 and all(side[n] > 0 for n in near)
            if is_open:
                open_.add(i)
        found += sum(all(n in open_ for n in around(i, slit)) for i in open_)
    return found / fronts


def srgb(light):
    return [255 * (12.92 * c if c <= 0.0031308 else 1.055 * c ** (1 / 2.4) - 0.055) for c in light]


def mean_colours(full, *models):
    """By view, the mean colour of what is seen of each model: triangles, and the light of each."""
    for view in views(full):
        means = []
        for triangles, lights in models:
            shown = [lights[i] for i in seen(triangles, *view)[2] if i >= 0]
            means.append(srgb([sum(c) / len(shown) for c in zip(*shown)]))
        yield means


class Games(Case):
    def setUp(self):
        super().setUp()
        self.put("x.cga", RULES)
        self.put("lots.geojson", lots())

    def made(self, *options, name="a.glb", says=""):
        told = self.run_gable("generate", "x.cga", "--shapes", "lots.geojson", "-o", name, *options, says=says)
        self.assertEqual(model_check.problems(self.folder / name), [])
        return Glb(self.folder / name), told

    def testShapesAreOneMeshEach(self):
        glb, _ = self.made("--instancing", "shapes")
        self.assertEqual(len(glb.json["nodes"]), 4)
        self.assertEqual(len(glb.json["meshes"]), 4)
        split, _ = self.made("--instancing", "nodes")
        self.assertGreater(len(split.json["nodes"]), 10)

    def testGodotFindsItsCollisionNodes(self):
        glb, _ = self.made("--for", "godot")
        shapes = ["House_col_1_part", "House_col_1_part_2", "Yard", "Lawn"]
        self.assertEqual(sorted(glb.names()), sorted([*shapes, *(f"{s}-colonly" for s in shapes)]))
        yard = glb.node("Yard-colonly")
        # A court stays open: its four walls are there, and nothing between them.
        self.assertEqual(len(glb.triangles(yard)), 8)
        self.assertNotIn("extensionsRequired", glb.json)
        hull, told = self.made("--for", "godot", "--collision", "hull")
        self.assertIn("'--collision hull' holds in place of 'mesh', the choice for godot [profile-overridden]", told)
        self.assertIn("Yard-convcolonly", hull.names())
        self.assertAlmostEqual(hull.volume(hull.node("Yard-convcolonly")), 30 * 30 * 6, 1)

    def testWhatStandsInForAShapeIsNotDrawn(self):
        self.made("--for", "godot", "--lods", "1", "--lod-form", "names")
        self.run_gable("render", "a.glb", "-o", "a.png", "--size", "64x48", "--samples", "2",
                       says="collision shapes and coarser levels of detail, 8 in all, are left out")

    def testCollisionShapesEncloseTheirShape(self):
        for kind in ("box", "hull"):
            glb, _ = self.made("--names", "unique", "--instancing", "shapes", "--collision", kind)
            for shape in ("House_col_1_part", "Yard", "Lawn"):
                inner, outer = glb.box(glb.node(shape)), glb.box(glb.node(shape + "_collision"))
                for k in range(3):
                    self.assertLessEqual(outer[0][k], inner[0][k] + 1e-3, (kind, shape))
                    self.assertGreaterEqual(outer[1][k], inner[1][k] - 1e-3, (kind, shape))
            house = glb.node("House_col_1_part_collision")
            low, high = glb.box(house)
            around = (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2])
            ratio = glb.volume(house) / around
            self.assertAlmostEqual(ratio, 1, 2) if kind == "box" else self.assertLess(ratio, 0.97)
            # What is flat gets a body, below its surface.
            low, high = glb.box(glb.node("Lawn_collision"))
            self.assertAlmostEqual(high[1], 0, 3)
            self.assertAlmostEqual(low[1], -0.1, 3)

    def testUnrealFindsMeshesByName(self):
        glb, _ = self.made("--for", "unreal")
        for node in glb.top:
            if not node["name"].startswith("UCX_"):
                hull = glb.node(f"UCX_{node['name']}_00")
                self.assertEqual(glb.mesh_name(hull), f"UCX_{glb.mesh_name(node)}_00")
                self.assertEqual(hull.get("translation"), node.get("translation"))
        for level in (1, 2):
            coarse = Glb(self.folder / f"a_LOD{level}.glb")
            self.assertEqual({coarse.mesh_name(n) for n in coarse.top} - {"Lawn"},
                             {glb.mesh_name(n) for n in glb.top if "UCX_" not in n["name"]} - {"Lawn"})
        answer = json.loads(self.run_gable("generate", "x.cga", "--lot", "9x9", "-o", "b.glb", "--for", "unreal", "--json"))
        self.assertEqual(answer["files"], ["b.glb", "b_LOD1.glb", "b_LOD2.glb"])

    def testLeavesAreCutOut(self):
        self.put("l.cga", 'Lot --> primitiveQuad() color("#7c9a45") texture("builtin:leaves/lime.png")\n'
                          '        set(material.opacitymap.mode, "mask") Foliage.\n')
        for name in ("l.glb", "l.usda", "l.obj"):
            self.run_gable("generate", "l.cga", "--lot", "4x4", "-o", name)
        self.assertEqual([m.get("alphaMode") for m in Glb(self.folder / "l.glb").json["materials"]], ["MASK"])
        self.assertIn("inputs:opacityThreshold = 0.5", (self.folder / "l.usda").read_text())
        self.assertIn("map_d", (self.folder / "l.mtl").read_text())

    def testLevelsAreCoarser(self):
        glb, _ = self.made("--for", "unity")
        counts = [len(glb.triangles(glb.node(f"House_col_1_part_LOD{n}"))) for n in range(3)]
        self.assertGreater(counts[0], 1.5 * counts[1])
        self.assertGreaterEqual(counts[1], counts[2])
        full, coarse = (glb.box(glb.node(f"House_col_1_part_LOD{n}")) for n in (0, 2))
        for k in range(3):
            self.assertAlmostEqual(full[0][k], coarse[0][k], delta=2)
            self.assertAlmostEqual(full[1][k], coarse[1][k], delta=2)
        # What saves nothing is the finer level once more.
        self.assertEqual(glb.node("Yard_LOD1")["mesh"], glb.node("Yard_LOD0")["mesh"])

    def testLevelsHaveNoHoles(self):
        self.put("shop.cga", SHOP)
        examples = ROOT / "examples"
        # Leaves stand beyond the outline of a hedge, and one may look through between them.
        bare = ("--set", "frontEdge=open", "--set", "sideEdge=boards")
        for rules, lot, *more in ((self.folder / "shop.cga", "12x10"), (examples / "rowhouse/rowhouse.cga", "8x14"),
                                  (examples / "halftimber/halftimber.cga", "10x20"),
                                  (examples / "suburb_house/suburb_house.cga", "22x30", *bare)):
            self.run_gable("generate", str(rules), "--lot", lot, *more, "-o", "h.glb", "--names", "unique", "--lods", "2", "--lod-form", "files",
                           "--instancing", "shapes")
            full, *levels = ([t for n in glb.top for t in glb.triangles(n)]
                             for glb in (Glb(self.folder / f"h{end}.glb") for end in ("", "_LOD1", "_LOD2")))
            size = math.dist(*([f(p[k] for t in full for p in t) for k in range(3)] for f in (min, max)))
            for level, fineness in zip(levels, (50, 20)):
                self.assertLess(holes(full, level, size / fineness), 1 / 5000, (rules.name, fineness))

    def testLevelsHaveTheColoursThatOneSees(self):
        self.put("shop.cga", SHOP)
        self.put("row.cga", ROW)
        for rules, lot in (("shop.cga", "12x10"), ("row.cga", "8x12")):
            self.run_gable("generate", rules, "--lot", lot, "-o", "h.glb", "--names", "unique", "--lods", "3", "--lod-form", "files",
                           "--instancing", "shapes")
            models = []
            for end in ("", "_LOD1", "_LOD2", "_LOD3"):
                glb = Glb(self.folder / f"h{end}.glb")
                models.append(([t for n in glb.top for t in glb.triangles(n)], [c for n in glb.top for c in glb.colours(n)]))
            for number, (full, *levels) in enumerate(mean_colours(models[0][0], *models)):
                for fineness, level in zip((50, 20, 8), levels):
                    self.assertLess(max(abs(a - b) for a, b in zip(full, level)), 10, (rules, number, fineness, full, level))

    def testMsftLodNamesNodesOutsideTheScene(self):
        glb, _ = self.made("--lods", "2", "--lod-form", "msft", "--instancing", "shapes")
        self.assertEqual(glb.json["extensionsUsed"], ["MSFT_lod"])
        self.assertEqual(len(glb.top), 4)
        seen = set(glb.json["scenes"][0]["nodes"])
        for node in glb.top[:3]:
            ids = node["extensions"]["MSFT_lod"]["ids"]
            self.assertEqual(len(ids), 2)
            self.assertFalse(seen & set(ids))
            coverage = node["extras"]["MSFT_screencoverage"]
            self.assertEqual(len(coverage), 3)
            self.assertEqual(coverage, sorted(coverage, reverse=True))
            sizes = [len(glb.triangles(n)) for n in (node, *(glb.json["nodes"][i] for i in ids))]
            self.assertEqual(sizes, sorted(sizes, reverse=True))

    def testPicturesAreMadeSmaller(self):
        self.put("t.cga", 'Lot --> setupProjection(0, scope.xz, 1, 1) projectUV(0) texture("builtin:textures/02_brick.png") X.')
        for size, most in ((0, 1 << 14), (64, 64), (100, 100)):
            self.run_gable("generate", "t.cga", "--lot", "9x9", "-o", "t.glb", "--texture-size", str(size))
            glb = Glb(self.folder / "t.glb")
            view = glb.json["bufferViews"][glb.json["images"][0]["bufferView"]]
            width, height = struct.unpack_from(">II", glb.buffer, view.get("byteOffset", 0) + 16)
            self.assertLessEqual(max(width, height), most)
            self.assertGreater(min(width, height), 30)

    def testPlainColoursAreOneMaterial(self):
        glb, _ = self.made("--instancing", "shapes")
        self.assertEqual(len(glb.json["materials"]), 3)
        told = json.loads(self.run_gable("generate", "x.cga", "--shapes", "lots.geojson", "-o", "atlas.glb", "--instancing", "shapes",
                                         "--atlas", "512", "--stats", "-"))
        self.assertEqual(told["atlas"], {"merged": 3, "into": 1, "repeating": 0, "special": 0, "large": 0})
        for side in ("1", "7", "63"):
            self.run_gable("generate", "x.cga", "-o", "small.glb", "--atlas", side, status=USAGE,
                           says="it takes 0, or a whole number from 64 to 8192")
        glb = Glb(self.folder / "atlas.glb")
        self.assertEqual([m["name"] for m in glb.json["materials"]], ["atlas"])
        self.assertEqual(sum(len(m["primitives"]) for m in glb.json["meshes"]), len(glb.json["meshes"]))
        # Levels of detail have colours of their own, in the same picture.
        glb, _ = self.made("--for", "unity")
        self.assertEqual([m["name"] for m in glb.json["materials"] if m["name"].startswith("atlas")], ["atlas"])

    def testThreadsDoNotMatter(self):
        for profile in ("blender", "cesium", "godot", "unity", "unreal"):
            self.made("--for", profile, "--jobs", "1", name="one.glb")
            self.made("--for", profile, "--jobs", "4", name="four.glb")
            self.assertEqual((self.folder / "one.glb").read_bytes(), (self.folder / "four.glb").read_bytes())

    def testWhatCannotBeIsTold(self):
        for options, says in ((["--for", "godt"], "godot"), (["--collision", "hul"], "hull"), (["--lods", "4"], "--lods"),
                              (["--lods", "1.5"], "--lods"), (["--texture-size", "-1"], "--texture-size"),
                              (["--collision", "box", "--instancing", "none"], "use the instancing 'shapes'"),
                              (["--names", "unreal", "--collision", "mesh"], "convex")):
            self.run_gable("generate", "x.cga", "--lot", "9x9", "-o", "a.glb", *options, status=USAGE, says=says)
        self.run_gable("generate", "x.cga", "--lot", "9x9", "-o", "a.obj", "--for", "godot", status=USAGE, says="a.obj")
        self.run_gable("generate", "x.cga", "--lot", "9x9", "-o", "a.obj", "--uv", "baked", status=USAGE, says="'--uv' says nothing about 'a.obj'")
        self.run_gable("generate", "x.cga", "--lot", "9x9", "-o", "a.obj", "--lods", "1", status=USAGE,
                       says="[write-options-clash]")
        self.assertFalse((self.folder / "a.glb").exists())
        self.put("empty.cga", "Lot --> NIL")
        self.run_gable("generate", "empty.cga", "--lot", "9x9", "-o", "a.glb", "--for", "unreal", says="empty-model")

    def testPlacesAreShapesToo(self):
        self.put("city.cga", 'attr height = 0\nBuilding --> extrude(7) X.\nLot --> X.\n')
        house = {"type": "Feature", "properties": {"building": "house"},
                 "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [20, 0], [20, 10], [0, 10], [0, 0]]]}}
        self.put("map.geojson", json.dumps({"type": "FeatureCollection", "crs": METRES, "features": [house]}))
        self.run_gable("city", "map.geojson", "--rules", "city.cga", "-o", "c.glb", "--for", "godot")
        self.assertTrue(any("-colonly" in n for n in Glb(self.folder / "c.glb").names()))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
