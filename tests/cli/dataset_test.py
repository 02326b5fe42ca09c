#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""`gable dataset`: the same bytes by any way, labels, lists, mistakes: dataset_test.py GABLE FOLDER. Run from the
repository's root."""
import json
import struct
import subprocess
import sys
import unittest
import zlib
from pathlib import Path

from cli_test import DONE, FILE, GABLE, USAGE, WRONG, Case

RULES = """attr height = 4
@StartRule @Label("house")
Lot --> s('rand(0.5, 0.8), '1, '0.6) extrude(height) comp(f) { top : Roof | side : Wall }
Wall --> color("#e0d8c8") split(x) { ~1 : X | 1 : Window | ~1 : X }
X --> X.
@Label("window")
Window --> color("#405060") split(y) { ~1 : Sill | ~2 : Pane }
Sill --> color("#b0a090")
Pane --> Pane.
Roof --> color("#c04030")
"""
TAGGED = """@StartRule
Lot --> s('0.7, '1, '0.6) extrude(4) comp(f) { top : Roof | side : Wall }
Wall --> tag("Wall.Front") split(x) { ~1 : X. | 1 : tag("Window") Window | ~1 : X. }
Window --> split(y) { ~1 : Sill | ~2 : Pane. }
Sill --> tag("Window.Sill") extrude(0.1) split(x) { ~1 : Stone. }*
Roof --> color("#c04030") Tiles.
"""
SMALL = {"--size": "48x40", "--samples": "1", "--lot": "20x10", "--jobs": "2", "--count": "3", "--cameras": "2"}
LAYERS = ("albedo.png", "depth.pfm", "image.png", "instance.png", "item.json", "normal.png", "semantic.png")


def numbers(path):
    """Of a PNG of three bytes a pixel: red + 256 green + 65536 blue, row after row."""
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height = struct.unpack_from(">II", body)
        if kind == b"IDAT":
            packed += body
        at += 12 + length
    raw, out, above = zlib.decompress(packed), [], bytes(3 * width)
    for y in range(height):
        start = y * (3 * width + 1)
        line = bytearray(raw[start + 1:start + 1 + 3 * width])
        for i in range(3 * width):
            a, b, c = line[i - 3] if i > 2 else 0, above[i], above[i - 3] if i > 2 else 0
            p = a + b - c
            paeth = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
            line[i] = (line[i] + (0, a, b, (a + b) // 2, paeth)[raw[start]]) & 255
        out.append([line[i] + 256 * line[i + 1] + 65536 * line[i + 2] for i in range(0, 3 * width, 3)])
        above = bytes(line)
    return out


class Dataset(Case):
    def setUp(self):
        super().setUp()
        self.put("x.cga", RULES)

    def line(self, folder, *options):
        rest = [part for name, value in SMALL.items() if name not in options for part in (name, value)]
        return ["dataset", "x.cga", *rest, *options, "-o", folder]

    def make(self, folder, *options, status=DONE, says=""):
        return self.run_gable(*self.line(folder, *options), status=status, says=says)

    def files(self, folder):
        place = self.folder / folder
        return {str(p.relative_to(place)): p.read_bytes() for p in sorted(place.rglob("*")) if p.is_file()}

    def testTagsThatNoRuleGivesAreTold(self):
        self.put("x.cga", 'Lot --> extrude(4) comp(f) { side : tag("Window") W. | all : R. }\n')
        for tags, says in (("Windw", "did you mean 'Window'?"), ("Window,Chimney", "rules give")):
            self.make("a", "--labels", "tag", "--tags", tags, status=WRONG, says=says)
        self.assertFalse((self.folder / "a").exists())
        # The option takes one word, so the rule file may follow it.
        self.run_gable("dataset", "--labels", "tag", "--tags", "Window", "x.cga", "--count", "1", "--cameras", "1", "--size", "32x32",
                       "--samples", "1", "-o", "b")

    def testAllFilesAreThere(self):
        self.make("a")
        seeds = [f"00000{seed}" for seed in range(3)]
        wanted = [f"{seed}/0{camera}/{name}" for seed in seeds for camera in range(2) for name in LAYERS]
        wanted += [f"{seed}/model/model.glb" for seed in seeds] + ["coco.json", "dataset.json"]
        files = self.files("a")
        self.assertEqual(sorted(files), sorted(wanted))
        self.assertEqual(len({files[f"{seed}/0{camera}/image.png"] for seed in seeds for camera in range(2)}), 6)
        self.assertFalse((self.folder / "a" / "locks").exists())

    def testAnyNumberOfProcessesMakesTheSameBytes(self):
        self.make("one", "--jobs", "1")
        several = [subprocess.Popen([str(GABLE), *self.line("many")], cwd=self.folder, stderr=subprocess.PIPE, text=True) for _ in range(3)]
        for process in several:
            told = process.communicate(timeout=120)[1]
            self.assertEqual(process.returncode, DONE, told)
        self.assertEqual(self.files("many"), self.files("one"))
        self.make("shards", "--shard", "1/2", says="of 6 items are there")
        self.assertFalse((self.folder / "shards" / "coco.json").exists())
        self.make("shards", "--shard", "0/2")
        self.assertEqual(self.files("shards"), self.files("one"))

    def testAStoppedRunGoesOn(self):
        self.make("whole")
        process = subprocess.Popen([str(GABLE), *self.line("cut")], cwd=self.folder, stderr=subprocess.DEVNULL)
        place = self.folder / "cut"
        while process.poll() is None and not list(place.glob("*/0?")):
            pass
        process.kill()
        process.wait()
        # As a process leaves it that is killed in the middle of an item.
        (place / "000002" / "01.part").mkdir(parents=True, exist_ok=True)
        (place / "000002" / "01.part" / "image.png").write_text("half")
        before = {name: (place / name).stat().st_mtime_ns for name in self.files("cut") if name.endswith("item.json")}
        answer = json.loads(self.make("cut", "--json"))
        self.assertEqual((answer["items"], answer["done"], answer["merged"]), (6, 6, True))
        self.assertEqual(answer["made"], 6 - sum(".part" not in name for name in before))
        self.assertEqual(self.files("cut"), self.files("whole"))
        for name, time in before.items():
            if ".part" not in name:
                self.assertEqual((place / name).stat().st_mtime_ns, time)
        self.assertEqual(json.loads(self.make("cut", "--json"))["made"], 0)

    def testADataSetMayGrow(self):
        self.make("grown", "--count", "2")
        self.make("grown")
        self.make("whole")
        self.assertEqual(self.files("grown"), self.files("whole"))

    def check(self, folder, names):
        """The list says what is in the pictures of instances and of labels; gives the instances by label."""
        place = self.folder / folder
        coco = json.loads((place / "coco.json").read_text())
        categories = {c["id"]: c["name"] for c in coco["categories"]}
        self.assertEqual([categories[i] for i in sorted(categories)], names)
        self.assertEqual([a["id"] for a in coco["annotations"]], list(range(1, len(coco["annotations"]) + 1)))
        count = {}
        for image in coco["images"]:
            item = place / image["file_name"]
            instances, labels = numbers(item.parent / "instance.png"), numbers(item.parent / "semantic.png")
            own = [a for a in coco["annotations"] if a["image_id"] == image["id"]]
            covered = set()
            for a in own:
                pixels, at, inside = set(), 0, False
                for run in a["segmentation"]["counts"]:
                    pixels |= {(i // image["height"], i % image["height"]) for i in range(at, at + run) if inside}
                    at, inside = at + run, not inside
                self.assertEqual(at, image["width"] * image["height"])
                self.assertEqual(a["area"], len(pixels))
                left, top = min(x for x, _ in pixels), min(y for _, y in pixels)
                self.assertEqual(a["bbox"], [left, top, max(x for x, _ in pixels) - left + 1, max(y for _, y in pixels) - top + 1])
                self.assertEqual({instances[y][x] for x, y in pixels}, {a["instance"]})
                self.assertEqual({labels[y][x] for x, y in pixels}, {a["category_id"]})
                covered |= pixels
                count.setdefault(categories[a["category_id"]], set()).add((image["seed"], a["instance"]))
            empty = {(x, y) for y, row in enumerate(labels) for x, v in enumerate(row) if v == 0}
            self.assertEqual(len(covered) + len(empty), image["width"] * image["height"])
            self.assertTrue(empty)
        return count

    def testLabelsByRuleAreThoseOfLeaves(self):
        self.make("a")
        count = self.check("a", ["Lot", "Pane", "Roof", "Sill", "Wall", "Window", "X"])
        self.assertEqual(set(count), {"Pane", "Roof", "Sill", "X"})
        self.assertEqual(len(count["Roof"]), 3)

    def testLabelsByAnnotationAreThoseOfShapes(self):
        self.make("a", "--labels", "label", "--cameras", "6")
        count = self.check("a", ["house", "window"])
        # A house has four walls with a window each, which is sill and pane.
        self.assertEqual(len(count["house"]), 3)
        self.assertEqual(len(count["window"]), 12)

    def testLabelsOfImportedRulesAreTheirOwn(self):
        # Both files have a rule Window: the one of the main file has no label.
        self.put("lib.cga", '@Label("tank") Tank --> s(3, 3, 3) primitiveCube() Skin.\n@Label("pane") Window --> s(1, 2, 1) primitiveCube() Skin.\n')
        self.put("x.cga", 'import lib : "lib.cga"\n@StartRule @Label("house") Lot --> extrude(3) comp(f) { top : Top | side : Wall. }\n'
                          'Top --> [ lib.Tank ] [ t(6, 0, 0) lib.Window ] t(12, 0, 0) Window\nWindow --> s(2, 2, 2) primitiveCube() Skin.\n')
        self.make("a", "--labels", "label", "--cameras", "6", "--count", "1")
        count = self.check("a", ["house", "pane", "tank"])
        self.assertEqual({name: len(instances) for name, instances in count.items()}, {"house": 1, "pane": 1, "tank": 1})

    def testLabelsByTagAreThoseOfTheNearestTaggedShape(self):
        self.put("x.cga", TAGGED)
        self.make("a", "--labels", "tag", "--cameras", "6", "--count", "1")
        count = self.check("a", ["Wall.Front", "Window", "Window.Sill"])
        # What a rule has split into parts keeps what it had tagged all of; roofs have no category.
        self.assertEqual({name: len(instances) for name, instances in count.items()},
                         {"Wall.Front": 4, "Window": 4, "Window.Sill": 4})

    def testNamedTagsCountInTheirOrder(self):
        self.put("x.cga", TAGGED)
        self.make("a", "--labels", "tag", "--tags", "extrude.top,Window,Wall", "--cameras", "6", "--count", "1")
        count = self.check("a", ["extrude.top", "Window", "Wall"])
        # Sills are tagged Window.Sill, which is a Window: part of the one that they are in.
        self.assertEqual({name: len(instances) for name, instances in count.items()}, {"Wall": 4, "Window": 4, "extrude.top": 1})

    def testCamerasProjectWhatTheySee(self):
        self.make("a", "--placing", "sampled", "--format", "json", "--model", "none", "--fov", "50")
        items = json.loads((self.folder / "a" / "items.json").read_text())["items"]
        self.assertEqual(len(items), 6)
        self.assertEqual(len({tuple(i["camera"]["eye"]) for i in items}), 6)
        for item in items:
            matrix, (fx, _, cx), (_, fy, cy) = item["worldToCamera"], *item["intrinsics"][:2]
            camera = item["camera"]
            ahead = [e + 7 * f + 2 * u for e, f, u in zip(camera["eye"], camera["forward"], camera["up"])]
            x, y, z = (sum(m * p for m, p in zip(row, [*ahead, 1])) for row in matrix[:3])
            self.assertAlmostEqual(z, 7)
            self.assertAlmostEqual(fx * x / z + cx, 24)
            self.assertAlmostEqual(fy * y / z + cy, 20 - fx * 2 / 7)
            self.assertLess(item["camera"]["halfWidth"], 0.4664)
            self.assertNotIn("model", item)

    def testAllOfAnExampleWithLabelsHasOne(self):
        rules = Path("examples/haussmann/haussmann.cga").resolve()
        for more in ((), ("--set", "detail=false"), ("--lot", "50x50")):
            told = json.loads(subprocess.run([str(GABLE), "info", str(rules), "--json"], stdout=subprocess.PIPE, check=True).stdout)
            labelled = {r["name"] for r in told["rules"] if any(a["name"] == "Label" for a in r["annotations"])}
            traced = subprocess.run([str(GABLE), "trace", str(rules), "--json", *more], stdout=subprocess.PIPE, check=True).stdout
            open_, without = [(tree, ()) for tree in json.loads(traced)["trees"]], set()
            while open_:
                node, above = open_.pop()
                path = (*above, node["shape"])
                if node.get("leaf") and not labelled & set(path):
                    without.add(" > ".join(path))
                open_ += [(child, path) for child in node["children"]]
            self.assertEqual(without, set(), more)

    def testZoomBringsTheModelNearer(self):
        self.make("a", "--count", "1", "--model", "none")
        self.make("b", "--count", "1", "--model", "none", "--zoom", "2")
        for camera in ("00", "01"):
            items = [json.loads((self.folder / f / "000000" / camera / "item.json").read_text()) for f in ("a", "b")]
            self.assertEqual(items[0]["camera"]["eye"], items[1]["camera"]["eye"])
            self.assertAlmostEqual(2 * items[0]["intrinsics"][0][0], items[1]["intrinsics"][0][0])
            seen = [sum(n > 0 for row in numbers(self.folder / f / "000000" / camera / "semantic.png") for n in row) for f in ("a", "b")]
            self.assertGreater(seen[1], 1.8 * seen[0])
        self.make("b", "--count", "1", "--model", "none", "--zoom", "3", status=USAGE, says="'zoom': 2, and now 3")

    def testOtherSettingsAreRefused(self):
        self.make("a")
        for option, value, says in (("--samples", "2", "'samples': 1, and now 2"), ("--cameras", "3", "'cameras': 2, and now 3"),
                                    ("--pitch", "20", "'pitch': none, and now 20")):
            self.make("a", option, value, status=USAGE, says="another value of " + says)
        self.make("a", "--set", "height=5", status=USAGE, says="'attributes'")
        self.put("x.cga", RULES.replace("c04030", "c04040"))
        self.make("a", status=FILE, says="'rules'")
        (self.folder / "b").mkdir()
        self.put("b/notes.txt", "mine")
        self.make("b", status=FILE, says="[dataset-folder]")
        self.assertEqual(list(self.files("b")), ["notes.txt"])

    def testWrongOptionsAreTold(self):
        for option in (["--count", "0"], ["--count", "nan"], ["--cameras", "0"], ["--placing", "line"], ["--labels", "colour"],
                       ["--format", "yolo"], ["--model", "doc"], ["--shard", "2/2"], ["--shard", "1"], ["--pitch", "91"], ["--zoom", "0"],
                       ["--size", "0x4"], ["--seed", "x"]):
            self.make("a", *option, status=USAGE, says=option[0])
        self.assertFalse((self.folder / "a").exists())
        self.make("a", "--set", "heigth=3", status=WRONG, says="[unknown-attribute]")
        self.make("a", "--sun-at", "2024-06-21,12", status=USAGE, says="[picture-settings]")
        self.assertFalse((self.folder / "a").exists())
        self.put("x.cga", "Lot --> extrude(3) X.")
        self.make("b", "--labels", "label", status=WRONG, says="[dataset-labels]")
        self.make("b", "--labels", "tag", status=WRONG, says="[dataset-labels]")
        self.make("b", "--tags", "a", status=USAGE, says="label by tag")
        self.make("b", "--labels", "tag", "--tags", "a,b,a", status=USAGE, says="named twice")
        self.make("x.cga", status=FILE, says="[dataset-folder]")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
