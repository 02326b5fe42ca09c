#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Each check objects to what it is there to object to, and to nothing else."""
import tempfile
import unittest
from pathlib import Path

import check
from checks import diagnostics, layers, libm, library, links, op_names, ops, pictures, sizes, types, words
from checks.tree import Tree, code_of, comments_of

HEAD = "// SPDX-License-Identifier: Apache-2.0\n// SPDX-FileCopyrightText: The Gable authors\n"
RULE = """
[layers]
base = []
geom = ["base"]
engine = ["*"]
[tests]
geom = ["engine"]
[test_only]
prefixes = ["gtest/"]
[third_party]
"clipper.hpp" = "src/geom/clip.cpp"
"""


class CheckCase(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = Path(self.folder.name)
        self.write("tools/layers.toml", RULE)
        self.write("src/geom/clip.cpp", HEAD)

    def tearDown(self):
        self.folder.cleanup()

    def write(self, path, text):
        full = self.root / path
        full.parent.mkdir(parents=True, exist_ok=True)
        full.write_text(text, encoding="utf-8")

    def messages(self, module):
        return [str(finding) for finding in module.check(Tree(self.root))]


class TypesTest(CheckCase):
    def testRejectsOneNameForTwoTypes(self):
        self.write("src/base/a.h", "namespace gable {\nstruct Plate { int a; };\nclass Free;\n}\n")
        self.write("src/geom/b.cpp", "namespace gable {\nnamespace {\nint c;\n}\nenum class Plate : int { A };\n}\n")
        self.assertEqual(self.messages(types),
                         ["src/geom/b.cpp:5: 'gable::Plate' is a type of src/base/a.h as well; name it otherwise, or put "
                          "it into an unnamed namespace"])

    def testAcceptsWhatTheLinkerKeepsApart(self):
        self.write("src/base/a.h", "namespace gable {\nstruct Plate { struct Part {}; struct Kept; };\n}\n")
        self.write("src/geom/b.cpp", "namespace gable {\nnamespace {\nstruct Plate {};\n}\n"
                                     "struct Plate::Kept {};\nvoid f() { struct Plate {}; }\nclass Plate;\n}\n"
                                     "namespace gable::rt {\nstruct Plate {};\n}\n")
        self.assertEqual(self.messages(types), [])


class LayersTest(CheckCase):
    def testAcceptsWhatTheTableAllows(self):
        self.write("src/base/a.h", "#include <vector>\n#include <sys/stat.h>\n")
        self.write("src/geom/b.h", '#include "base/a.h"\n')
        self.write("src/geom/clip.cpp", '#include "geom/b.h"\n#include <clipper.hpp>\n')
        self.write("src/engine/c.cpp", '#include "geom/b.h"\n#include "base/a.h"\n')
        self.assertEqual(self.messages(layers), [])

    def testRejectsALayerAbove(self):
        self.write("src/geom/b.h", "")
        self.write("src/base/a.h", '#include <string>\n#include "geom/b.h"\n')
        self.assertEqual(self.messages(layers),
                         ["src/base/a.h:2: base may not include geom (src/geom/b.h)"])

    def testAllowsToTestsOnlyWhatTheTableSays(self):
        self.write("src/engine/e.h", "")
        self.write("src/geom/b_test.cpp", '#include "engine/e.h"\n#include <gtest/gtest.h>\n')
        self.assertEqual(self.messages(layers), [])
        self.write("src/geom/b.cpp", '#include "engine/e.h"\n#include <gtest/gtest.h>\n')
        self.assertEqual(len(self.messages(layers)), 2)

    def testRejectsAThirdPartyHeaderOutsideItsOwner(self):
        self.write("src/geom/other.cpp", "#include <clipper.hpp>\n")
        self.write("src/geom/json.cpp", "#include <nlohmann/json.hpp>\n")
        found = self.messages(layers)
        self.assertIn("src/geom/other.cpp:1: <clipper.hpp> belongs to src/geom/clip.cpp alone", found)
        self.assertIn("src/geom/json.cpp:1: <nlohmann/json.hpp> has no owner in tools/layers.toml",
                      found)

    def testRejectsSourcesMissingFilesAndRings(self):
        self.write("src/geom/a.cpp", "")
        self.write("src/geom/b.cpp", '#include "geom/a.cpp"\n#include "geom/none.h"\n')
        self.write("src/geom/x.h", '#include "geom/y.h"\n')
        self.write("src/geom/y.h", '#include "geom/x.h"\n')
        found = self.messages(layers)
        self.assertIn("src/geom/b.cpp:1: includes the source file src/geom/a.cpp", found)
        self.assertIn('src/geom/b.cpp:2: no file "geom/none.h"', found)
        self.assertIn("src/geom/y.h:1: includes src/geom/x.h, which includes it", found)
        self.assertEqual(len(found), 3)

    def testRejectsAFolderWithoutALine(self):
        self.write("src/base/a.h", "")
        self.write("src/extra/b.h", '#include "base/a.h"\n')
        self.assertEqual(self.messages(layers),
                         ["src/extra/b.h:1: the folder extra has no line in tools/layers.toml"])


class SizesTest(CheckCase):
    def testCountsFunctionsAndFiles(self):
        body = "  x += 1;\n" * 99
        self.write("src/base/a.cpp", "namespace n {\nclass C {\nvoid long_(int a = f({1})) {\n" + body +
                   "}\nint ok() { return '{'; }\n};\n}\n")
        self.assertEqual(self.messages(sizes),
                         ["src/base/a.cpp:3: long_ has 101 lines; 100 is the end"])
        self.write("src/base/a.cpp", "int a;\n" * 801)
        self.assertEqual(self.messages(sizes), ["src/base/a.cpp: 801 lines; 800 is the end"])

    def testKeepsFilesOfThePageShorter(self):
        for path, lines in (("src/a.svelte", 601), ("src/b.ts", 601), ("src/c.ts", 600), ("e2e/d.mjs", 601)):
            self.write("studio/" + path, "x();\n" * lines)
        self.assertEqual(self.messages(sizes), ["studio/src/a.svelte: 601 lines; 600 is the end",
                                                "studio/src/b.ts: 601 lines; 600 is the end"])

    def testKeepsStylesShort(self):
        self.write("examples/tower/tower.cga", "A --> B\n" * 300)
        self.write("examples/town/town.cga", "A --> B\n" * 300)
        self.assertEqual(self.messages(sizes),
                         ["examples/tower/tower.cga: 300 lines; 299 is the end"])

    def testSeesPastInitialisersOfMembers(self):
        body = "  x += 1;\n" * 99
        self.write("src/base/a.cpp", "C::C() : a_{1}, b_(2) {\n" + body + "}\n")
        self.assertEqual(self.messages(sizes),
                         ["src/base/a.cpp:1: C::C has 101 lines; 100 is the end"])

    def testLeavesTablesAndNamespacesAlone(self):
        rows = "  {1, 2},\n" * 120
        self.write("src/base/a.cpp", "namespace {\nconst int kTable[][2] = {\n" + rows +
                   "};\nauto kMade = make({\n" + rows + "});\n}\nint f() { return 1; }\n")
        self.assertEqual(self.messages(sizes), [])

    def testCountsPythonFunctions(self):
        self.write("tools/a.py", "def f():\n" + "    x = 1\n" * 100)
        self.assertEqual(self.messages(sizes), ["tools/a.py:1: f has 101 lines; 100 is the end"])


class WordsTest(CheckCase):
    def testRejectsMissingHeadsAndForbiddenWords(self):
        self.write("src/base/a.cpp", HEAD + "// The caf\u00e9.\nconst char* k = \"caf\u00e9\";\n")
        self.write("src/base/b.cpp", "int b;\n")
        self.write("docs/c.md", "See /home" "/me/x and issue" " #12.\n\nTO" "DO\n")
        self.write("--list/a.glb", "")
        found = self.messages(words)
        self.assertIn("--list/a.glb: a path that reads as an option", found)
        self.assertIn("src/base/a.cpp:3: a comment that is not ASCII", found)
        self.assertIn("src/base/b.cpp:1: the two SPDX lines are missing", found)
        self.assertEqual(len([f for f in found if f.startswith("docs/c.md")]), 3)
        self.assertEqual(len(found), 6)


class LinksTest(CheckCase):
    def testFollowsFilesAndHeadings(self):
        self.write("a.md", "# One two\n[x](b.md) [y](#one-two) [z](https://example.org) `[n](no)`\n"
                           "![p](p.png)\n```\n[n](no.md)\n```\n")
        self.write("b.md", "[back](a.md#one-two)\n")
        self.write("p.png", "")
        self.assertEqual(self.messages(links), [])
        self.write("b.md", "[a](a.md#three)\n[c](c.md)\n[q](../a.md)\n")
        self.assertEqual(self.messages(links), ["b.md:1: no heading #three in a.md",
                                                "b.md:2: no file c.md", "b.md:3: no file ../a.md"])

    def testKeepsUsersOutOfTheSource(self):
        self.write("src/a.png", "")
        self.write("src/a.md", "")
        self.write("docs/dev/page.md", "[x](../../src/a.md)\n")
        self.write("docs/guide/page.md", "![p](../../src/a.png)\n[x](../../src/a.md)\n")
        self.assertEqual(self.messages(links),
                         ["docs/guide/page.md:2: src/a.md is no page for users"])


class PicturesAndOpsTest(CheckCase):
    def testWeighsPictures(self):
        self.write("docs/a.png", "x" * 400_001)
        self.write("docs/b.png", "x" * 400_000)
        self.assertEqual(len(self.messages(pictures)), 1)

    def testWantsAllThreePartsOfAnOperation(self):
        for part in ("cpp", "test", "md"):
            self.write(f"src/builtins/ops/build/roof.{part}", "")
        self.assertEqual(self.messages(ops), [])
        self.write("src/builtins/ops/build/wall.cpp", "")
        self.write("src/builtins/functions/maths/page.md", "")
        self.assertEqual(self.messages(ops),
                         ["src/builtins/ops/build/wall.test: is missing",
                          "src/builtins/ops/build/wall.md: is missing",
                          "src/builtins/functions/maths/page.cpp: is missing",
                          "src/builtins/functions/maths/page.test: is missing"])


class DiagnosticsTest(CheckCase):
    def testHoldsSourcesAgainstThePage(self):
        self.write("docs/reference/diagnostics.md", "| code |\n|---|\n| `bad-arrow` | x |\n| `old-one` | x |\n")
        self.write("src/base/a.cpp", 'void f() { error("bad-arrow", at); d.warning("no-page",\n "x"); }\n')
        self.write("src/base/a_test.cpp", 'void f() { error("in-a-test", at); }\n')
        self.assertEqual(self.messages(diagnostics), [
            "src/base/a.cpp:1: 'no-page' has no line in docs/reference/diagnostics.md",
            "docs/reference/diagnostics.md: no source has the code 'old-one'"])

    def testHintsNameOptionsThatThereAre(self):
        self.write("apps/gable/main.cpp", 'app->add_option("--max-depth", depth, "Deep");\n')
        self.write("src/base/a.cpp", 'x("end it, or "\n  "raise the limit on depth (--max-depth)", "raise the roof");\n')
        self.assertEqual(self.messages(diagnostics), [])
        self.write("src/base/b.cpp", 'x("raise the limit on width"); y("raise --max-height");\n')
        self.assertEqual(self.messages(diagnostics), [
            "src/base/b.cpp: 'raise the limit on width' names no option of the command line",
            "src/base/b.cpp: 'raise --max-height' names no option of the command line"])


class ExceptionsTest(CheckCase):
    def testOverlooksWhatIsNamedAndReportsWhatIsStale(self):
        self.write("src/base/a.cpp", "int a;\n" * 801)
        self.write("tools/exceptions.txt", "sizes src/base/a.cpp a table\n")
        tree = Tree(self.root)
        self.assertEqual(check.run(tree, ["sizes"]), [])
        self.write("tools/exceptions.txt", "sizes src/base/a.cpp a table\nsizes src/b.cpp why\nsizes x\n")
        found = [str(f) for f in check.run(Tree(self.root), ["sizes"])]
        self.assertEqual(found, ["tools/exceptions.txt:3: expected: check, file, reason",
                                 "tools/exceptions.txt:2: src/b.cpp needs no exception any more"])


class TokensTest(unittest.TestCase):
    def testTellsCodeFromCommentsAndLiterals(self):
        text = 'int a = 1\'000; // one {\nauto b = R"x(// no {)x"; char c = \'{\'; /* two */\n'
        self.assertEqual([c for _, c in comments_of(text)], ["// one {", "/* two */"])
        self.assertNotIn("{", code_of(text))
        self.assertEqual(len(code_of(text)), len(text))


class LibmTest(CheckCase):
    def testRejectsFunctionsThatRoundAsTheyLike(self):
        self.write("src/geom/a.cpp", "double f(double x) { return std::sin(x) + pow (x, 2); }\n")
        self.assertEqual(len(self.messages(libm)), 2)
        self.write("src/render/a.cpp", "float f(float x) { return std::sin(x); }\n")
        self.assertEqual(len(self.messages(libm)), 2)

    def testHoldsCopiedLibrariesToIt(self):
        self.write("third_party/clip/a.cpp", "double f(double x) { return std::acos(x); }\n")
        self.assertEqual(len(self.messages(libm)), 1)

    def testAcceptsWhatIsExactAndWhatIsOurs(self):
        self.write("src/geom/a.cpp", "// sin(x) of a comment\ndouble log(int line);\n"
                   "double f(double x) { return std::sqrt(x) + std::fmod(x, 2) + m.exp(x) + sinDeg(x); }\n")
        self.assertEqual(self.messages(libm), [])


class LibraryTest(CheckCase):
    def testHoldsTheEngineToThePlaygroundsLibrary(self):
        self.write("apps/gable_wasm/library/cxx20.h", "namespace std {\nnamespace ranges {\ntemplate <class R>\n"
                   "bool all_of(R&& r) {\n  return std::all_of(r);\n}\nvoid sort(R&& r) {\n}\n}  // namespace ranges\n}\n")
        self.write("src/geom/a.cpp", "bool f() { return std::ranges::all_of(x) && std::any_of(x); std::ranges::sort(x); }\n")
        self.assertEqual(self.messages(library), [])
        self.write("src/geom/a.cpp", "bool f() {\n  return std::ranges::any_of(x);\n}\nauto g = std::views::all(x);\n")
        self.assertEqual(len(self.messages(library)), 2)
        self.write("src/geom/a.cpp", "")
        self.write("src/geom/a_test.cpp", "bool f() { return std::ranges::any_of(x); }\n")
        self.assertEqual(self.messages(library), [])


class OpNamesTest(CheckCase):
    def setUp(self):
        super().setUp()
        self.write("src/builtins/ops/subdivide/comp.cpp",
                   'constexpr OpSpec kSpecs[] = {\n    {"comp", "subdivide", "Divides the shape.", kS, apply}};\n')
        self.write("src/builtins/functions/numbers.cpp",
                   'constexpr FunctionSpec kSpecs[] = {{"sqrt", kFamily,\n    "The square root.", kS}};\n')

    def testRejectsNamesInTheRuntime(self):
        self.write("src/runtime/a.cpp", 'bool b = name == "comp";\nbool c = name == "sqrt";\n')
        self.assertEqual(len(self.messages(op_names)), 2)
        self.write("src/runtime/a.cpp", "auto m = \"'comp' makes too many\";\n")
        self.assertEqual(len(self.messages(op_names)), 1)

    def testAcceptsNamesElsewhereAndInWords(self):
        self.write("src/runtime/a.cpp", '// "comp" of a comment\nauto m = "compare and decompose";\n')
        self.write("src/runtime/a_test.cpp", 'bool b = name == "comp";\n')
        self.write("src/shape/a.cpp", 'bool b = name == "comp";\n')
        self.assertEqual(self.messages(op_names), [])


if __name__ == "__main__":
    unittest.main()
