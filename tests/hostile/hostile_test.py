#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""What strangers may hand in: hostile_test.py GABLE FOLDER CLASS [--short] [--sanitized].

Every case ends with one of the exit statuses of the command line and names its mistake by code, within a limit on
processor time and, where the program is not built with sanitizers, on address space; a signal, a message longer than a
person reads and a control character on the terminal are failures. The files are made in FOLDER. With --short the texts
of 100 megabytes have 2, and what grows is stopped sooner: the same cases in a minute. With --sanitized time is measured
twentyfold. Run from the repository's root.
"""
import json
import os
import random
import re
import resource
import shutil
import struct
import subprocess
import sys
import unittest
from pathlib import Path

GABLE, FOLDER = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
SANITIZED = "--sanitized" in sys.argv
SHORT = SANITIZED or "--short" in sys.argv
HUGE = 2_000_000 if SHORT else 100_000_000
FEW, DEPTH, MANY_STEPS = ("20000", "8", "150000") if SHORT else ("200000", "1024", "3000000")
DEEP = 100_000
CODE = re.compile(r"\[([a-z0-9]+(?:-[a-z0-9]+)+)\]$", re.M)


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = FOLDER / type(self).__name__ / self._testMethodName
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)

    def tearDown(self):
        shutil.rmtree(self.folder, ignore_errors=True)

    def put(self, name, content):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def run_gable(self, *arguments, status=(0,), codes=(), seconds=15, megabytes=2500):
        """The errors' text of one run that kept its limits."""
        if isinstance(status, int):
            status = (status,)
        allowed = seconds * (20 if SANITIZED else 1)

        def limit():
            resource.setrlimit(resource.RLIMIT_CPU, (allowed, allowed + 1))
            if not SANITIZED:
                resource.setrlimit(resource.RLIMIT_AS, (megabytes << 20, megabytes << 20))

        command = [str(GABLE), *map(str, arguments)]
        done = subprocess.run(command, capture_output=True, check=False, preexec_fn=limit, cwd=self.folder)
        said = (done.stderr + (done.stdout if arguments[0] == "check" else b"")).decode(errors="replace")
        self.assertIn(done.returncode, status, f"{command}\n{said[-3000:]}")
        self.assertLess(len(said), 2_000_000, said[:1000])
        self.assertIsNone(re.search(r"[\x00-\x08\x0b-\x1f\x7f]", said), f"control characters in {said[:300]!r}")
        for code in codes:
            self.assertIn(code, CODE.findall(said), f"{command}\n{said[-3000:]}")
        if done.returncode == 1:
            self.assertIn("error", said)
        return said

    def draw(self, content, **expected):
        return self.run_gable("render", self.put("a.cga", content), "--size", "160x90", "--samples", "2", "-o", "a.png",
                              **expected)

    def check(self, content, **expected):
        return self.run_gable("check", self.put("a.cga", content), **expected)

    def generate(self, content, *arguments, out="a.glb", **expected):
        rules = self.put("a.cga", content)
        return self.run_gable("generate", rules, "--jobs", "1", "-o", out, *arguments, **expected)

    def shapes(self, name, content, **expected):
        rules = self.put("rules.cga", "Lot --> extrude(3) comp(f) { all : F. }")
        return self.run_gable("generate", rules, "--shapes", self.put(name, content), "-o", "a.glb", **expected)


class RuleText(Case):
    def testDeepNestingIsReported(self):
        for opening in ("(", "[", "{", "f(", "a[", "-", "!", "~", "'", "comp(f){all:", "split(x){1:", "case a:",
                        "else:", "{{", "50%:", "imp(A-->", "inline "):
            for head in ("A --> ", "x = ", "@Handle("):
                # A bad annotation is a warning.
                self.check(head + opening * DEEP, status=(0, 1) if head[0] == "@" else 1)

    def testBalancedNestingIsReported(self):
        for opening, closing in (("(", ")"), ("[", "]"), ("f(", ")"), ("comp(f){all:", "}"), ("split(x){1:", "}*")):
            text = f"A --> s({opening * DEEP}1{closing * DEEP},1,1) B.\nC --> D."
            if opening[0] in "[cs":
                text = f"A --> {opening * DEEP} B. {closing * DEEP}\nC --> D."
            self.check(text, status=1, codes=["nesting-too-deep"])

    def testHugeLinesAreReadOrRefused(self):
        for piece in ("s(1,1,1) ", "B ", "(", "{1:", "1", "x", "\"", "\t", "/", "comp(f) { all : X } ", "1+", "[1,2],",
                      "case a:", "\0"):
            text = "A --> " + piece * (HUGE // len(piece))
            self.check(text, status=(0, 1))

    def testHugeTextsAndCommentsAreRead(self):
        self.check("A --> print(\"" + "x" * HUGE + "\") B.", status=(0, 1))
        self.check("/*" + "x" * HUGE + "*/ A --> B.", status=0)
        self.check("/*" + "x" * HUGE, status=1, codes=["unterminated-comment"])
        self.check("# " + "x" * HUGE + "\nA --> B.", status=0)

    def testHugeFilesOfRulesAreRefused(self):
        count = HUGE // 24
        text = "".join(f"R{i} --> s(1,1,1) R{i + 1}\n" for i in range(count))
        self.check(text, status=(0, 1) if SHORT else 1)
        self.check("attr a = 1\n" * (HUGE // 11), status=1)

    def testEmptyAndBlankFilesAreRead(self):
        for content in ("", " \n\t\n", "\ufeff", "\r\r\r", "#", "/**/"):
            self.check(content, status=1, codes=["empty-file"])
            self.generate(content, status=1, codes=["empty-file"])

    def testBinaryGarbageIsReported(self):
        dice = random.Random(1)
        for size in (1, 100, 10_000, 1_000_000):
            self.check(dice.randbytes(size), status=(0, 1))
        self.check(bytes(100_000), status=1)
        self.check("A --> B.".encode("utf-16-le"), status=1)
        self.check("A --> B.".encode("utf-16"), status=0)
        self.check(b"\xff\xfe" + b"\xd8" * 99, status=1)
        self.check(b"A --> \x1b[31m B\x07 \x9b", status=1)

    def testFormattingTakesTheSame(self):
        for content in ("(" * DEEP, "A --> " + "[" * DEEP, "A --> " + "x" * (HUGE // 10), bytes(1000)):
            self.run_gable("format", "--stdout", self.put("a.cga", content), status=(0, 1))

    def testCyclicImportsAreReported(self):
        self.put("b.cga", "import c : \"c.cga\"\nB --> X.")
        self.put("c.cga", "import a : \"a.cga\"\nC --> X.")
        self.check("import b : \"b.cga\"\nA --> b.B", status=1, codes=["import-cycle"])
        self.check("import a : \"a.cga\"\nA --> a.A", status=1, codes=["import-cycle"])

    def testImportsThatMultiplyAreReported(self):
        for i in range(40):
            self.put(f"f{i}.cga", f"import l : \"f{i + 1}.cga\"\nimport r : \"f{i + 1}.cga\"\nA --> l.A r.A")
        self.put("f40.cga", "A --> X.")
        self.check("import l : \"f0.cga\"\nA --> l.A", status=1, codes=["too-many-imports"])

    def testOtherThanFilesAreRefused(self):
        self.run_gable("check", self.folder, status=3)
        self.run_gable("check", self.folder / "none.cga", status=3)
        self.run_gable("check", self.put("a.cga", "") / "b.cga", status=3)


class Derivations(Case):
    def testEndlessRulesEnd(self):
        for text in ("A --> A", "A --> t(1,0,0) A A", "A --> B(0)\nB(x) --> s(x,1,1) B(x+1) B(x+2)",
                     "A --> [ A ] A", "A --> comp(f) { all : A }",
                     "A --> extrude(1) comp(f) { all : A }", "A --> 50% : A else : A A",
                     "A --> roofHip(30) [ s('0.5,1,1) A ] A"):
            for more in ([], ["--no-sharing"]):
                self.generate(text, "--max-shapes", FEW, "--max-depth", DEPTH, *more, status=4, seconds=90)
        # Pieces become too small to be pieces; without sharing there are too many before.
        for more in ([], ["--no-sharing"]):
            self.generate("A --> split(x) { ~1 : A | ~1 : A }", "--max-shapes", FEW, "--max-depth", DEPTH, *more, status=(0, 4))

    def testEndlessFunctionsEnd(self):
        for text in ("f(x) = f(x+1)", "f(x) = f(f(x))", "f(x) = g(x)+1\ng(x) = f(x)",
                     "f(x) = case x == 0 : 1 else : f(x+1)*f(x-1)"):
            self.generate(text + "\nA --> s(f(1),1,1) B.", status=4, codes=["function-too-deep"])

    def testManyCallsEndByStepsAndByTime(self):
        text = "f(x) = case x < 2 : 1 else : f(x-1)+f(x-2)\nA --> s(f(60),1,1) B."
        self.generate(text, "--max-steps", "2000000", status=4, codes=["too-many-steps"])
        self.generate(text, "--max-seconds", "0.5", status=4, codes=["out-of-time"])

    def testShapesThatMultiplyEnd(self):
        text = "A --> B(60)\nB(n) --> case n > 0 : B(n-1) t(1,0,0) B(n-1) else : X."
        self.generate(text, status=3, codes=["model-too-large"])
        self.generate(text, "--no-sharing", "--max-shapes", "1000000", status=4, codes=["too-many-shapes"])
        self.generate("A --> B(40)\nB(n) --> case n > 0 : B(n-1) t(1,0,0) B(n-1) else : print(1) X.",
                      "--stats", "stats.json", status=(3, 4), codes=["too-many-reports"], megabytes=6000, seconds=60)

    def testSplitsByNothingAreReported(self):
        for sizes, code in (("0 : B.", "split-endless"), ("0 : B. | 0 : C.", "split-endless"),
                            ("0-1 : B.", "split-endless"), ("{ 0 : B. }* | 1 : C.", "split-endless"),
                            ("0/0 : B.", "split-size-number"), ("~(0/0) : B.", "split-size-number"),
                            ("1/0 : B.", "split-size-number"), ("'(-1/0) : B.", "split-size-number"),
                            ("1e-300 : B.", "split-too-many"), ("0.00002 : B.", "split-too-many")):
            for axis in "xzu":
                uv = "setupProjection(0, scope.xz, 1, 1) projectUV(0) " if axis == "u" else ""
                unit = ", unitSpace, 0" if axis == "u" else ""
                self.generate(f"A --> {uv}split({axis}{unit}) {{ {sizes} }}*", codes=[code])
        self.generate("A --> split(x) { 0-5 : B. | 3 : C. | 0-1 : D. | 1e300 : E. }")
        self.generate("A --> split(x) { -1 : B. }", codes=["bad-argument"])
        self.generate("A --> split(y) { 1 : B. }", codes=["split-flat"])

    def testAMillionPiecesAreMade(self):
        self.generate("A --> split(x) { 0.02 : split(z) { 0.02 : B. }* }*", "--stats", "-", seconds=30)

    def testTextsAndArraysThatGrowEnd(self):
        self.generate("f(s,n) = case n == 0 : s else : f(s+s, n-1)\nA --> print(len(f(\"x\",60))) B.",
                      codes=["text-too-long"])
        self.generate("f(s,n) = case n == 0 : s else : f([s,s], n-1)\nA --> print(size(f([1,2],60))) B.",
                      codes=["array-too-large"])
        self.generate("f(s,n) = case n == 0 : s else : f(replace(s,\"x\",s), n-1)\nA --> print(len(f(\"xxx\",60))) B.",
                      codes=["text-too-long"])
        self.generate("f(s,n) = case n == 0 : s else : f(listAdd(s,s), n-1)\nA --> print(len(f(\"x;\",60))) B.",
                      codes=["text-too-long"])
        self.generate("attr x = \"a\"\nA --> B(0)\nB(n) --> case n < 60 : set(x, x+x) B(n+1) else : print(len(x)) X.",
                      codes=["text-too-long"])
        for value in ("[0:1:1e18]", "[0:1e-300:1]", "[1e308:-1e-308:-1e308]"):
            self.generate(f"A --> print(size({value})) B.", codes=["array-too-large"])

    def testMemoryIsLimited(self):
        limit = ["--max-memory", "500"]
        self.generate("A --> split(x) { 0.001 : primitiveSphere(100+split.index%400,500) X. }*", *limit,
                      status=4, seconds=60)
        self.generate("A --> B(0,\"\")\nB(n,s) --> print(s) case n < 1000 : B(n+1, f(str(n),14)) else : X.\n"
                      "f(s,n) = case n == 0 : s else : f(s+s, n-1)", *limit, status=(0, 4), seconds=60)
        self.generate("A --> B(0)\nB(n) --> t(n,0,0) case n < 1000 : B(n+1) B(n+2) else : X.",
                      "--no-sharing", *limit, status=4, seconds=60)

    def testSingleOperationsEndByTimeAndByMemory(self):
        for body in ("crenellate(1e-7, 1e-7, 1e-7) { merlon : X. }", "crenellate(1e-12, 1e-12, 1e-12) { merlon : X. }",
                     "crenellate(0.1, 0.1, 0.05) { merlon : X. }", "parcels(box, 1e-5, 1e-5, 1e-5) { lot : X. }",
                     "parcels(box, 1e-4, 1e-4, 1e-4, 1e-4) { lot : X. }", "parcels(skeleton, 0.01, 0.01) { lot : X. }",
                     "streets(grid, 8, 2, 1, 1e-4, 30) { block : X. }", "streets(field, 30, 11, 0.1, 1e-3) { block : X. }",
                     "roughenOutline(0.3, 1e-5) X.", "roughenOutline(3, 0.01) X.",
                     "s(20, '1, 20) scatterSpaced(0.07, poisson, 0.01) { X. }", "quadMap(95, 95) { region : X. }",
                     "grid(150, 150, 0.1) { region : X. }", "scatterCircles(0, 1) { X. }", "ring(0, 1e12, 0, round) X.",
                     "primitiveSphere(700, 700) split(x) { 0.01 : X. }*"):
            with self.subTest(body=body):
                self.generate(f"Lot --> {body}", "--lot", "1000x1000", "--max-seconds", "0.5", "--max-memory", "300",
                              status=(0, 4), seconds=2, megabytes=1200)

    def testNumbersBeyondAnyModelEndNothing(self):
        for body in ("ring(1, 1e308, 1, miter) X.", "ring(-1e308, 1, 0) X.", "crenellate(1, 1, 1e308) { merlon : X. }",
                     "curve(polyline, [0, 0; 5, 0; 5, 5]) ribbon(1e308) X.", "extrude(1e308) X.", "scatterSpaced(1e308, poisson) { X. }",
                     "ring(1e14, 1e15, 1) X.", "s(1e20, '1, 1e20) offset(1e19) X.", "streets(grid, 1e300, 1e299) { block : X. }",
                     "setback(1e308) { all : X. | remainder : Y. }", "roofHip(30, 1e308) X.", "arrange([1e308, 1e308], 1) { placed : X. }"):
            with self.subTest(body=body):
                self.generate(f"Lot --> {body}", status=(0, 1), seconds=5)

    def testAttributesOfLeavesTakeBoundedMemory(self):
        self.generate("attr a = [0:1:2]\nLot --> split(x) { 0.01 : set(a, [split.index:1:split.index+20000]) X. }*", "--lot", "10x10",
                      "--max-memory", "400", status=4, codes=["out-of-memory"], seconds=20, megabytes=2500)

    def testGeometryThatGrowsEnds(self):
        for operation in ("extrude(1)", "extrude(world.up, 1)", "roofHip(30)", "roofGable(30)", "roofShed(30)",
                          "roofPyramid(30)", "offset(1)", "mirror(true, false, false)", "convexify()", "taper(1)",
                          "setback(0.001) { all : B(n+1) | remainder : B(n+1) }", "innerRect",
                          "innerRectangle(scope) { shape : B(n+1) | remainder : B(n+1) }",
                          "shapeO(0.1,0.1,0.1,0.1) { shape : B(n+1) | remainder : B(n+1) }",
                          "comp(f) { all : extrude(1) B(n+1) }", "comp(e) { all : B(n+1) }"):
            self.generate(f"A --> B(0)\nB(n) --> case n < 200 : {operation} B(n+1) else : X.", "--max-steps", MANY_STEPS,
                          "--max-memory", "1500", status=(0, 3, 4), seconds=60, megabytes=6000)

    def testNumbersWithoutMeaningDoNoHarm(self):
        numbers = ("0/0", "1/0", "-1/0", "1e308", "-1e308", "1e-308", "0")
        operations = ("s({0},{0},{0})", "s('{0},1,1)", "t({0},{0},{0})", "r({0},{0},{0})", "extrude({0})",
                      "taper({0})", "offset({0})", "roofHip({0})", "roofGable({0},{0})", "roofShed({0})",
                      "setback({0}) {{ all : X. | remainder : Y. }}", "shapeL({0},{0})", "shapeU({0},{0},{0})",
                      "primitiveSphere({0},{0})", "primitiveCylinder({0})", "primitiveCone({0},{0},{0})",
                      "primitiveDisk({0},{0})", "scatter(surface,{0},uniform) {{ X. }}", "center(xyz) s({0},{0},{0})",
                      "setupProjection(0,scope.xz,{0},{0}) projectUV(0)", "tileUV(0,{0},{0})", "scaleUV(0,{0},{0})",
                      "set(material.opacity,{0}) set(material.shininess,{0})", "report(\"a\",{0})", "print({0})",
                      "set(trim.vertical, {0} > 1)", "cleanupGeometry(all,{0})", "rotateScope({0},{0},{0})",
                      "translate(rel,world,{0},{0},{0})", "innerRectangle(edge)", "alignScopeToAxes(y)",
                      "reduceGeometry({0})", "color({0},{0},{0})", "print(str([{0},{0}][{0}]))",
                      "print(substring(\"abc\",{0},{0}))", "print(listItem(\"a;b\",{0}))", "print(rint({0}))",
                      "print(rand({0},{0}))", "print([{0}:{0}:{0}])", "print({0} % {0})")
        for n in numbers:
            body = " ".join(f"[ {o.format(n)} X. ]" for o in operations)
            solid = " ".join(f"[ extrude(2) {o.format(n)} comp(f) {{ all : X. }} ]" for o in operations)
            self.generate(f"A --> {body}\nB --> {solid}", "--start", "A", "--stats", "-", status=(0, 1))
            self.generate(f"A --> {body}\nB --> {solid}", "--start", "B", "--stats", "-", status=(0, 1))

    def testWriterTakesNumbersWithoutMeaning(self):
        text = ("A --> extrude(5) [ s(0/0,1/0,1e308) X. ] [ t(1e308,0,0) t(1e308,0,0) Y. ] [ s(1e300,1e300,1e300) Z. ]"
                " [ r(1e300,0,0) W. ] V.")
        for kind in ("glb", "gltf", "obj", "ply", "stl"):
            self.generate(text, out=f"a.{kind}", seconds=60)
        self.draw(text, seconds=60)
        home = Path(os.environ.get("GABLE_VALIDATOR", "build/validate"))
        if shutil.which("node") and (home / "node_modules").exists():
            self.generate(text)
            done = subprocess.run(["node", "tools/validate/validate.mjs", str(self.folder / "a.glb")],
                                  capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def testLotsWithoutMeaningAreRefused(self):
        for lot in ("0x0", "-1x3", "nanx1", "infx1", "1e300x1", "x", "1x", "1x2x3", ""):
            self.generate("A --> X.", "--lot", lot, status=(0, 2) if lot == "" else 2)
        self.generate("A --> extrude(1) roofHip(30) X.", "--lot", "1e6x1e-6")
        self.generate("A --> extrude(1) roofHip(30) X.", "--lot", "1e-300x1e-300", status=(0, 1))

    def testOptionsWithoutMeaningAreRefused(self):
        for option in (["--seed", "x"], ["--jobs", "1e9"], ["--set", "=1"], ["--set", "a"], ["--max-shapes", "-1"],
                       ["--nothing"]):
            self.generate("A --> X.", *option, status=2)
        self.generate("A --> X.", "--jobs", "1000000", status=(0, 2))
        self.generate("A --> X.", "--jobs", "-5", status=(0, 2))
        self.generate("A --> X.", "--set", "b=1", status=1, codes=["unknown-attribute"])
        self.generate("attr a = 1\nA --> X.", "--set", "a=" + "[" * 100_000, status=2, codes=["attribute-value"])

    def testRegularExpressionsTakeBoundedTime(self):
        for pattern in ("(a+)+$", "(a*)*b", "(?=.*x)a", "((((a?){100}){100}){100}){100}", "(" * 10000, "[", "a{1000}{1000}"):
            self.generate(f"f(s,n) = case n == 0 : s else : f(s+s, n-1)\n"
                          f"A --> print(size(splitString(f(\"a\",20), \"${pattern}\"))) X.", seconds=60)


def gltf(nodes=None, **more):
    import json
    base = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
            "nodes": nodes or [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                           "min": [0, 0, 0], "max": [1, 1, 1]}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}],
            "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64," + "A" * 48}]}
    base.update(more)
    return json.dumps(base)


def glb(text, binary=b""):
    data = text.encode() + b" " * (-len(text) % 4)
    binary += bytes(-len(binary) % 4)
    chunks = struct.pack("<II", len(data), 0x4E4F534A) + data
    if binary:
        chunks += struct.pack("<II", len(binary), 0x004E4942) + binary
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


POLYGON = '{"type":"Feature","properties":%s,"geometry":{"type":"Polygon","coordinates":%s}}'


class ShapeFiles(Case):
    def testEmptyFilesAndGarbageAreRefused(self):
        dice = random.Random(2)
        for name in ("a.geojson", "a.obj", "a.gltf", "a.glb"):
            for content in (b"", b"\0", b" ", dice.randbytes(1000), dice.randbytes(1_000_000), bytes(1_000_000),
                            b"\xff\xfe" + "{}".encode("utf-16-le"), b"glTF", b"null", b"[]", b"{}", b"\"x\""):
                self.shapes(name, content, status=1)
        self.shapes("a.xyz", b"", status=(1, 3))

    def testDeepDocumentsAreRefused(self):
        for name, code in (("a.geojson", "shapes-broken"), ("a.gltf", "asset-broken")):
            for opening in ("[", "{\"a\":", "[{\"a\":", "{\"type\":\"GeometryCollection\",\"geometries\":["):
                self.shapes(name, opening * DEEP, status=1, codes=[code])
        nested = '{"type":"Polygon","coordinates":' + "[" * DEEP + "1" + "]" * DEEP + "}"
        self.shapes("a.geojson", nested, status=1, codes=["shapes-broken"])

    def testHugeDocumentsAreReadOrRefused(self):
        count = HUGE // 20
        ring = ",".join(f"[{i % 1000 / 1e5},{i // 1000 / 1e5}]" for i in range(min(count, 1_000_000)))
        self.shapes("a.geojson", POLYGON % ("{}", "[[" + ring + "]]"), status=(0, 1), seconds=60, megabytes=4000)
        self.shapes("a.geojson", "[" + "0," * (HUGE // 2) + "0]", status=1, megabytes=4000)
        self.shapes("a.geojson", "\"" + "x" * HUGE + "\"", status=1, megabytes=4000)
        self.shapes("a.geojson", " " * HUGE, status=1)
        self.shapes("a.obj", "v 0 0 0\n" * (HUGE // 8), status=1, megabytes=4000)
        self.shapes("a.obj", "v 0 0 0\nv 1 0 0\nv 1 0 1\nf" + " 1 2 3" * (HUGE // 60), status=(0, 1, 4), megabytes=4000)
        self.shapes("a.obj", "x" * HUGE, status=1)

    def testManyMaterialsAndFilesEndSoon(self):
        count = 20_000 if SHORT else 100_000
        triangle = "v 0 0 0\nv 1 0 0\nv 1 0 1\n"
        self.put("a.mtl", "newmtl m\nKd 1 0 0\n" * 1000)
        uses = triangle + "".join(f"usemtl m{i}\nf 1 2 3\n" for i in range(count))
        for text in (uses, triangle + "mtllib a.mtl\n" * count + "f 1 2 3\n",
                     triangle + "".join(f"mtllib {i}.mtl\n" for i in range(count)) + "f 1 2 3\n",
                     triangle + "".join(f"g g{i}\no o{i}\nf 1 2 3\n" for i in range(count))):
            self.put("a.obj", text)
            self.generate("Lot --> i(\"a.obj\") print(len(str(geometry.materials))) comp(m) { all : X. }", seconds=10)
            # So many files are refused, and faces of so many materials more than one shape divides into.
            self.shapes("b.obj", text, status=(0, 1, 4), seconds=10)
        self.put("a.obj", "".join(uses.splitlines(keepends=True)[:3 + 2 * 65_534]))
        self.generate("Lot --> i(\"a.obj\") comp(m) { all : X. }", seconds=10)

    def testManyHolesAndFeaturesEndSoon(self):
        def square(x, y, d):
            return f"[[{x},{y}],[{x + d},{y}],[{x + d},{y + d}],[{x},{y + d}],[{x},{y}]]"
        same = ",".join([square(0, 0, .001)] + [square(.0002, .0003, .0003)] * 400)
        self.shapes("a.geojson", POLYGON % ("{}", f"[{same}]"), codes=["geojson-holes"], seconds=30)
        apart = ",".join([square(0, 0, .04)] + [square(i % 60 * 5e-4 + 1e-4, i // 60 * 5e-4 + 1e-4, 2e-4)
                                                for i in range(3000)])
        self.shapes("a.geojson", POLYGON % ("{}", f"[{apart}]"), seconds=30)
        wide = ",".join(f"\"a{i}\":{i}" for i in range(100_000))
        self.shapes("a.geojson", POLYGON % ("{" + wide + "}", f"[{square(0, 0, .001)}]"), seconds=30)

    def testMetresAreNotTakenForDegrees(self):
        self.shapes("a.geojson", POLYGON % ("{}", "[[[0,0],[30,0],[30,40],[0,40],[0,0]]]"), status=1,
                    codes=["geojson-metres"])

    def testCoordinatesWithoutMeaningAreReported(self):
        for c in ("1e308", "-1e400", "1e17", "null", "\"1\"", "[]", "91"):
            self.shapes("a.geojson", POLYGON % ("{}", f"[[[0,0],[{c},0],[0,{c}],[0,0]]]"), status=(0, 1))
        for rings in ("[]", "[[]]", "[[[0,0]]]", "[[[0,0],[0,0],[0,0],[0,0]]]", "[[[0,0],[1,0],[2,0],[0,0]]]",
                      "[[[0,0],[1,1],[1,0],[0,1],[0,0]]]", "{}", "0"):
            self.shapes("a.geojson", POLYGON % ("{}", rings), status=1)
        for v in ("nan nan nan", "inf 0 0", "1e308 1e308 1e308", "1e999 0 0", "", "x y z", "0x10 0 0"):
            self.shapes("a.obj", f"v {v}\nv 1 0 0\nv 1 0 1\nf 1 2 3\n", status=(0, 1))

    def testAttributesWithoutMeaningAreTaken(self):
        deep = "[" * 150 + "]" * 150
        names = ",".join(f'"p{i}":{i}' for i in range(10_000))
        for properties in ("null", "[]", deep.join(('{"a":', "}")), "{" + names + "}", '{"":1,"\\u0000":"\\u0000"}',
                           '{"a":"' + "x" * 1_000_000 + '"}', '{"a":1e999}'):
            self.shapes("a.geojson", POLYGON % (properties, "[[[0,0],[0.001,0],[0.001,0.001],[0,0]]]"), status=(0, 1))

    def testIndicesWithoutMeaningAreReported(self):
        head = "v 0 0 0\nv 4 0 0\nv 4 0 -4\n"
        for index in ("0", "-5", "4", "99999999999", "-99999999999", "9223372036854775808", "18446744073709551617", "1.5",
                      "x", "1/9/9", "1//-7", "1/2/3/4", "//"):
            self.shapes("a.obj", head + f"f 1 2 {index}\n", status=(0, 1))
        self.shapes("a.obj", head + "f 1\nf 1 1 1\nf 1 2\nf\n", status=1)

    def testModelsWithoutMeaningAreReported(self):
        good = {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}
        broken = [
            gltf(accessors=[{**good, "count": 4_000_000_000}]), gltf(accessors=[{**good, "count": -1}]),
            gltf(accessors=[{**good, "byteOffset": 2 ** 63}]), gltf(accessors=[{**good, "bufferView": 7}]),
            gltf(accessors=[{**good, "count": 2 ** 53, "bufferView": None}]),
            gltf(accessors=[{**good, "componentType": 1}]), gltf(accessors=[{**good, "type": "MAT9"}]), gltf(accessors=[]),
            gltf(bufferViews=[{"buffer": 0, "byteLength": 2 ** 62, "byteOffset": 2 ** 62}]),
            gltf(bufferViews=[{"buffer": 0, "byteLength": 36, "byteStride": 2 ** 31}]),
            gltf(buffers=[{"byteLength": 2 ** 40}]), gltf(buffers=[{"byteLength": 2 ** 40, "uri": "data:,"}]),
            gltf(buffers=[{"byteLength": 36, "uri": "../../../etc/passwd"}]),
            gltf(buffers=[{"byteLength": 36, "uri": "/etc/passwd"}]),
            gltf(buffers=[{"byteLength": 36, "uri": "file:///etc/passwd"}]),
            gltf(buffers=[{"byteLength": 36, "uri": "/dev/zero"}]),
            gltf(nodes=[{"children": [0]}]), gltf(nodes=[{"children": [1]}, {"children": [0]}]),
            gltf(nodes=[{"mesh": 0, "scale": [1e308, 1e308, 1e308]}]), gltf(nodes=[{"mesh": 99}]),
            gltf(nodes=[{"mesh": 0, "matrix": [0] * 16}]), gltf(scenes=[{"nodes": [-1, 5, 1e9]}]), gltf(scene=9),
            gltf(meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "mode": 99}]}]),
            gltf(meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "indices": 0}]}]),
            gltf(meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "material": 1e9}]}]),
        ]
        # Doubling nodes stand for 2^40 meshes; a chain of them is as deep as a document may be long.
        doubling = [{"children": [i + 1, i + 1]} for i in range(40)] + [{"mesh": 0}]
        broken.append(gltf(nodes=doubling))
        broken.append(gltf(nodes=[{"children": [i + 1]} for i in range(DEEP)] + [{"mesh": 0}]))
        for text in broken:
            self.shapes("a.gltf", text, status=(0, 1), megabytes=4000)
            self.shapes("a.glb", glb(text), status=(0, 1), megabytes=4000)

    def testBrokenContainersAreReported(self):
        good = glb(gltf(), bytes(36))
        for cut in range(0, len(good), 7):
            self.shapes("a.glb", good[:cut], status=1)
        for at, value in ((4, 9), (8, 0), (8, 0xFFFFFFFF), (12, 0xFFFFFFFF), (12, 3), (16, 0)):
            self.shapes("a.glb", good[:at] + struct.pack("<I", value) + good[at + 4:], status=(0, 1))

    def testHolesOnHolesAreCutOut(self):
        def square(x, d):
            return [[x, x], [x + d, x], [x + d, x + d], [x, x + d], [x, x]]

        rings = [square(0, .001)] + [square(.0002, .0003)] * 320
        path = self.put("holes.geojson", json.dumps({"type": "Feature", "properties": {}, "geometry":
                                                     {"type": "Polygon", "coordinates": rings}}))
        rules = self.put("a.cga", "Lot --> X.")
        self.run_gable("generate", rules, "--shapes", path, "-o", "a.glb", codes=["geojson-holes"], seconds=10)

    def testCentresOfRaysMayLieOverHoles(self):
        rings = [[[7.4, 43.7], [7.4005, 43.7], [7.4005, 43.70027027], [7.4, 43.70027027], [7.4, 43.7]],
                 [[7.400125, 43.700072072], [7.400125, 43.70018018], [7.4003125, 43.70018018],
                  [7.4003125, 43.700072072], [7.400125, 43.700072072]],
                 [[7.400375, 43.70009009], [7.400375, 43.700108108], [7.4004125, 43.700108108], [7.400375, 43.70009009]]]
        path = self.put("holes.geojson", json.dumps({"type": "Feature", "properties": {"name": "hole"}, "geometry":
                                                     {"type": "Polygon", "coordinates": rings}}))
        rules = self.put("a.cga", 'Lot --> castRays(centre, corners, 1) { region : X. | path : P. | centre : circle(12) C. }')
        self.run_gable("generate", rules, "--shapes", path, "-o", "a.glb")

    def testPolygonsOfManyCrossingsAreTaken(self):
        import math
        n = 301 if SHORT else 2001
        star = "".join(f"v {math.cos(i * (n // 2) * 2 * math.pi / n):.9f} 0 {math.sin(i * (n // 2) * 2 * math.pi / n):.9f}\n"
                       for i in range(n)) + "f " + " ".join(str(i + 1) for i in range(n)) + "\n"
        path = self.put("star.obj", star)
        for body in ("extrude(1) X.", "roofHip(30) X.", "offset(-0.01) X.", "setback(0.01) { all : X. | remainder : Y. }",
                     "innerRectangle(scope) { shape : X. | remainder : Y. }", "split(x) { 0.1 : X. }*", "convexify() X.",
                     "cleanupGeometry(all, 0.1) X."):
            rules = self.put("star.cga", f"Lot --> {body}")
            self.run_gable("generate", rules, "--shapes", path, "-o", "a.glb", seconds=120, megabytes=4000)


class FileLimits(Case):
    """What is read, analysed, written or drawn ends at the limits of the command, and its file is named."""

    def ends(self, *arguments, name, code="out-of-time", limits=("--max-seconds", "0.01"), **expected):
        said = self.run_gable(*arguments, *limits, status=4, codes=[code], **expected)
        self.assertIn(f"'{name}'" if name else "takes", said.replace(str(self.folder) + "/", ""))
        self.assertIn(limits[0], said)

    def files(self):
        """Large ones of each kind, and one that a small file makes large."""
        many = 300_000
        triangle = "v 0 0 0\nv 1 0 0\nv 1 0 1\n"
        square = "[[%f,0],[%f,0],[%f,0.0001],[%f,0.0001]]"
        feature = '{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[%s]}}'
        features = ",".join(feature % (square % (i * 1e-5, i * 1e-5 + 1e-6, i * 1e-5 + 1e-6, i * 1e-5)) for i in range(20_000))
        yield "a.obj", triangle + "f 1 2 3\n" * many
        yield "m.obj", triangle + "usemtl a\nf 1 2 3\nusemtl b\n" * (many // 3)
        yield "a.geojson", '{"type":"FeatureCollection","features":[' + features + "]}"
        yield "j.geojson", "[" + "0," * many + "0]"
        yield "a.gltf", gltf(nodes=[{"mesh": 0}] * 100_000, scenes=[{"nodes": list(range(100_000))}])
        yield "k.gltf", gltf(**{f"x{i}": 0 for i in range(10_000)}, nodes=[{"mesh": 0}] * 20_000,
                             scenes=[{"nodes": list(range(20_000))}])

    def testReadingShapes(self):
        rules = self.put("rules.cga", "Lot --> X.")
        for name, content in self.files():
            self.ends("generate", rules, "--shapes", self.put(name, content), "-o", "a.glb", name=name)

    def testReadingModels(self):
        for name, content in self.files():
            if not name.endswith(".geojson"):
                self.ends("render", self.put(name, content), "-o", "a.png", name=name)
                self.ends("asset", "prepare", self.folder / name, "-o", "b.glb", name=name)

    def testAssetsOfADerivation(self):
        for name, content in self.files():
            if not name.endswith(".geojson"):
                self.put(name, content)
                self.run_gable("generate", self.put("a.cga", f'Lot --> i("{name}") X.'), "-o", "a.glb", "--max-seconds", "0.01",
                               status=4, codes=["out-of-time"])

    def testAnalysingRules(self):
        park = "A -> Grid(2, 2) { LAWN } {} {}\n" + "".join(f"B{i} -> Grid(2, 2) {{ LAWN }} {{}} {{}}\n" for i in range(20_000))
        for name, content in (("a.cga", "A --> s(1, 1, 1) X.\n" + "".join(f"R{i} --> s(1, 1, 1) t(1, 1, 1) X.\n" for i in range(50_000))),
                              ("s.cga", "attr a = 1\nstyle S0\nattr a = 0\n" + "".join(
                                  f"style S{i + 1} extends S{i}\nattr a = {i}\n" for i in range(3000)) + "Lot --> X."),
                              ("n.cga", "Lot --> " + " ".join(f"Uknown{i}" for i in range(3000)) + "\n" + "".join(
                                  f"Unknown{i} --> X.\n" for i in range(3000))), ("a.park", park)):
            path = self.put(name, content)
            self.ends("check", path, name=name)
            self.ends("generate", path, "-o", "a.glb", name=name)
            if name == "a.park":
                self.ends("convert", path, name=name)

    def testWritingModels(self):
        # Few prototypes stand for millions of leaves, which formats without instances write one by one.
        rules = self.put("a.cga", "Lot --> s(4096, 0, 4096) A\nA --> split(x) { '0.125 : B }*\nB --> split(z) { '0.125 : C }*\n"
                         "C --> split(x) { '0.125 : D }*\nD --> split(z) { '0.125 : E }*\nE --> split(x) { '0.125 : F }*\n"
                         "F --> split(z) { '0.125 : G }*\nG --> split(x) { '0.125 : H }*\nH --> split(z) { '0.125 : X. }*\n")
        for out in ("a.obj", "a.ply", "a.stl"):
            self.ends("generate", rules, "-o", out, name=out, limits=("--max-seconds", "0.5"))
            self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["a.cga"])

    def testDrawing(self):
        rules = self.put("a.cga", "Lot --> extrude(3) X.")
        said = self.run_gable("render", rules, "-o", "a.png", "--size", "640x360", "--samples", "2000", "--max-seconds", "0.5",
                              status=4, codes=["out-of-time"], seconds=60)
        self.assertIn("'a.png'", said)
        # As far as it came.
        self.assertTrue((self.folder / "a.png").exists())

    def testPicturesOfPixels(self):
        import zlib

        def chunk(kind, data):
            return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        n = 8_000
        packer = zlib.compressobj(9)
        data = b"".join(packer.compress(bytes(1 + 4 * n)) for _ in range(n)) + packer.flush()
        self.put("assets/bomb.png", b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", n, n, 8, 6, 0, 0, 0))
                 + chunk(b"IDAT", data) + chunk(b"IEND", b""))
        rules = self.put("rules/a.cga", "A --> setupProjection(0, scope.xz, 1, 1) projectUV(0) texture(\"bomb.png\") X.")
        self.ends("render", rules, "-o", "a.png", "--size", "160x90", "--samples", "2", name="a.png", code="out-of-memory",
                  limits=("--max-memory", "200"))

    def testManyHolesAreTriangulatedSoon(self):
        def square(x, y, d):
            return f"[[{x},{y}],[{x + d},{y}],[{x + d},{y + d}],[{x},{y + d}],[{x},{y}]]"
        rings = ",".join([square(0, 0, .08)] + [square(i % 75 * 1e-3 + 1e-4, i // 75 * 1e-3 + 1e-4, 4e-4) for i in range(5000)])
        self.shapes("a.geojson", POLYGON % ("{}", f"[{rings}]"), seconds=10)


class Project(Case):
    def setUp(self):
        super().setUp()
        self.put("secret/secret.cga", "S --> print(\"SECRET\") X.")
        self.put("secret/secret.obj", "v 0 0 0\nv 1 0 0\nv 1 0 1\nf 1 2 3\n")
        self.put("secret/secret.txt", "SECRET")
        self.put("project/assets/own.txt", "own")
        (self.folder / "project/assets/link.txt").symlink_to(self.folder / "secret/secret.txt")
        (self.folder / "project/assets/folder").symlink_to(self.folder / "secret")
        os.mkfifo(self.folder / "project/assets/pipe.txt")

    def rules(self, text, *arguments, **expected):
        path = self.put("project/rules/a.cga", text)
        command = [str(GABLE), "generate", str(path), "-o", "a.glb", "--stats", "-"]
        done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=self.folder, timeout=300)
        self.assertNotIn("SECRET", done.stdout + done.stderr)
        self.assertGreaterEqual(done.returncode, 0)
        return done

    PATHS = ("../../secret/secret.", "../secret/secret.", "/../secret/secret.", "assets/../../secret/secret.",
             "..\\\\..\\\\secret\\\\secret.", "folder/secret.", "/assets/folder/secret.", "{absolute}/secret/secret.",
             "file://{absolute}/secret/secret.", "./../../secret/secret.", "....//....//secret/secret.")

    def paths(self, ending):
        return [p.replace("{absolute}", str(self.folder)) + ending for p in self.PATHS]

    def testTextOutsideIsNotRead(self):
        self.assertIn("own", self.rules("A --> print(readTextFile(\"own.txt\")) X.").stdout)
        for path in self.paths("txt") + ["link.txt", "/etc/passwd", "/proc/self/environ", "/dev/stdin", "pipe.txt", "", ".", "/"]:
            done = self.rules(f"A --> print(readTextFile(\"{path}\")) print(fileExists(\"{path}\")) X.")
            self.assertNotIn("root:", done.stdout)
            self.assertNotIn("true", done.stdout.split("{")[0], path)

    def testRulesOutsideAreNotImported(self):
        for path in self.paths("cga"):
            done = self.rules(f"import s : \"{path}\"\nA --> s.S")
            self.assertEqual(done.returncode, 0, path)
            self.assertIn("import-not-found", done.stderr, path)


    def testModelsAndPicturesOutsideAreNotRead(self):
        for path in self.paths("obj"):
            done = self.rules(f"A --> i(\"{path}\") texture(\"{path}\") X.")
            self.assertRegex(done.stderr, "missing-(asset|file)", path)

    def testSearchesStayInside(self):
        for pattern in ("*", "../*", "/*", "*secret*", "../../secret/*", "*" * 10000, "$" * 10000):
            done = self.rules(f"A --> print(fileSearch(\"{pattern}\")) X.")
            self.assertNotIn("secret", done.stdout.split('"prints"')[0])

    def testFilesThatModelsNameStayInside(self):
        self.put("project/assets/m.obj", "mtllib ../../secret/secret.txt\nv 0 0 0\nv 1 0 0\nv 1 0 1\nf 1 2 3\n")
        self.put("project/assets/t.obj", "mtllib t.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 1 0 1\nf 1 2 3\n")
        self.put("project/assets/t.mtl", "newmtl m\nmap_Kd ../../secret/secret.txt\n")
        self.put("project/assets/u.gltf", gltf(buffers=[{"byteLength": 36, "uri": "../../secret/secret.txt"}]))
        for name in ("m.obj", "t.obj", "u.gltf"):
            self.rules(f"A --> i(\"{name}\") X.")

    def testGroundOfNoColourIsRefused(self):
        rules = self.put("project/rules/a.cga", "A --> X.")
        small = ("--size", "160x90", "--samples", "2", "-o", "a.png")
        for ground in ("red", "#12", "#12345g", "#1234567", "1234567", ""):
            wrong = ground != ""
            said = self.run_gable("render", rules, "--ground", ground, *small, status=2 if wrong else 0)
            self.assertEqual("#77766a" in said, wrong, said)
        self.run_gable("render", rules, "--ground", "#7D8c52", *small)

    def testPictureBombsAreRefused(self):
        import zlib

        def chunk(kind, data):
            return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        header = struct.pack(">IIBBBBB", 60_000, 60_000, 8, 6, 0, 0, 0)
        bomb = (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(bytes(10_000_000)))
                + chunk(b"IEND", b""))
        self.put("project/assets/bomb.png", bomb)
        rules = self.put("project/rules/a.cga",
                         "A --> setupProjection(0, scope.xz, 1, 1) projectUV(0) texture(\"bomb.png\") X.")
        small = ("--size", "160x90", "--samples", "2")
        for command, out, more in (("generate", "a.glb", ()), ("render", "a.png", small)):
            self.run_gable(command, rules, "-o", out, *more, status=(0, 1, 3), seconds=60, megabytes=4000)


class Attack(Case):
    """Random programs that once ended the program, had no end, or wrote numbers that are none, in today's notation;
    `zero` keeps a number that no operation takes from the analysis. The number of a file says how it is run."""

    def testWhatOnceBrokeItEnds(self):
        programs = sorted((Path(__file__).parent / "attack").glob("*.cga"))
        self.assertEqual(len(programs), 36)
        shutil.copytree(programs[0].parent, self.folder / "rules")
        for program in programs:
            number = int(program.stem)
            rules = f"rules/{program.name}"
            self.run_gable("check", rules)
            shapes = ("--lot", "30x24") if number % 2 == 0 else ("--shapes", "rules/shapes.geojson")
            shared = ("--no-sharing",) if number % 5 == 0 else ()
            model = f"models/{number}.{'obj' if number % 3 == 0 else 'glb'}"
            (self.folder / "models").mkdir(exist_ok=True)
            # 4: a limit was met, and said so.
            self.run_gable("generate", rules, *shapes, *shared, "--max-seconds", "3", "--max-memory", "1200",
                           "--max-shapes", "100000", "--jobs", "2", "-o", model, status=(0, 4))
        checker = Path(__file__).parents[1] / "written" / "model_check.py"
        done = subprocess.run([sys.executable, "-B", checker, self.folder / "models"], capture_output=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout.decode(errors="replace")[:3000])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]] + sys.argv[3:4], verbosity=1)
