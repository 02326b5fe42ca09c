#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Rules of several projects: projects_test.py GABLE FOLDER.

What `--workspace`, `--lib` and `--find-by-name` find, what nothing finds, and what happens then. Files are made in
FOLDER. Run from the repository's root.
"""
import json
import pathlib
import subprocess
import sys
import unittest

import cli_test
from cli_test import DONE, FILE, GABLE, USAGE, WRONG  # noqa: F401

CUBE = "\n".join(["v 0 0 0", "v 1 0 0", "v 1 1 0", "v 0 1 0", "v 0 0 1", "v 1 0 1", "v 1 1 1", "v 0 1 1",
                  "f 4 3 2 1", "f 5 6 7 8", "f 1 2 6 5", "f 2 3 7 6", "f 3 4 8 7", "f 4 1 5 8", ""])


class Case(cli_test.Case):
    def put(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if isinstance(text, bytes):
            path.write_bytes(text)
        else:
            path.write_text(text)
        return name

    def run_gable(self, *arguments, status=DONE):
        done = subprocess.run([str(GABLE), *arguments], cwd=self.folder, capture_output=True, text=True, timeout=120,
                              check=False)
        self.assertEqual(done.returncode, status, f"{arguments}\n{done.stdout}{done.stderr}")
        return done

    def gable(self, *arguments, status=DONE):
        done = self.run_gable(*arguments, status=status)
        return done.stdout + done.stderr

    def out(self, *arguments, status=DONE):
        return self.run_gable(*arguments, status=status).stdout

    def codes(self, *arguments, status=DONE):
        return [d["code"] for d in json.loads(self.out("check", "--json", *arguments, status=status))["diagnostics"]]

    def reports(self, *arguments):
        self.gable("generate", *arguments, "-o", "out.glb", "--stats", "stats.json")
        stats = json.loads((self.folder / "stats.json").read_text())
        return {key: value["sum"] for key, value in stats["reports"].items()}


MAIN = 'import w : "/Other/rules/w.cga"\nLot --> extrude(3) comp(f) { side : w.Wall | top : X. }\n'
WALL = 'Wall --> i("panel.obj") report("walls", 1) report("faces", geometry.nVertices) X.\n'


class Bundled(Case):
    """What comes with Gable: called by its name from any project, and in no other way."""

    def testAPathThatNamesGableFindsRulesAndModels(self):
        self.put("mine/rules/main.cga",
                 'import trees : "/gable/rules/trees.cga"\nLot --> report("there", case fileExists("/gable/park/bench.glb") : 1 else : 0) '
                 'report("loose", case fileExists("bench.glb") : 1 else : 0) report("listed", listSize(fileSearch("*/bench.glb"))) '
                 't(5, 0, 5) trees.Birch(9)\n')
        reports = self.reports("mine/rules/main.cga")
        self.assertEqual(reports["there"], 1)
        self.assertEqual(reports["loose"], 0)
        self.assertEqual(reports["listed"], 0)

    def testASlipInAPathOfGableNamesWhatIsMeant(self):
        # A file of the project with nearly that name is not what such a path means.
        self.put("mine/assets/trees.cga", "A --> X.\n")
        self.put("mine/rules/main.cga", 'import x : "/gable/rules/treez.cga"\nLot --> i("/gable/park/benhc.glb") x.Birch(9)\n')
        told = self.gable("check", "mine/rules/main.cga")
        self.assertIn("did you mean '/gable/rules/trees.cga'?", told)
        self.assertIn("did you mean '/gable/park/bench.glb'?", told)

    def testAFileOfTheProjectComesFirst(self):
        self.put("mine/gable/park/bench.glb", "own")
        self.put("mine/rules/main.cga", 'Lot --> report("bytes", len(readTextFile("/gable/park/bench.glb")))\n')
        self.assertEqual(self.reports("mine/rules/main.cga")["bytes"], 3)

    def testAParkTakesTheModelsThatItHasNot(self):
        self.put("park.park", 'Region -> Place(CENTRE) { Bench }\nBench -> loadModel("bench")\n')
        self.assertNotIn("warning", self.gable("generate", "park.park", "-o", "park.glb"))
        self.put("other.park", 'Region -> Place(CENTRE) { Bench }\nBench -> loadModel("unicorn")\n')
        self.assertIn("unicorn", self.gable("generate", "other.park", "-o", "park.glb"))


class Projects(Case):
    def project(self):
        self.put("town/Mine/rules/main.cga", MAIN)
        self.put("town/Other/rules/w.cga", WALL)
        self.put("town/Other/assets/panel.obj", CUBE)
        return "town/Mine/rules/main.cga"

    def testFilesOfOtherProjectsAreFoundInAWorkspace(self):
        main = self.project()
        self.assertEqual(self.codes(main, "--workspace", "town"), [])
        self.assertEqual(self.reports(main, "--workspace", "town"), {"walls": 4, "faces": 32})

    def testLibrariesAreFoundByTheirFolderOrTheirName(self):
        main = self.project()
        self.assertEqual(self.codes(main, "--lib", "town/Other"), [])
        (self.folder / "town/Other").rename(self.folder / "elsewhere")
        self.assertEqual(self.codes(main, "--lib", "elsewhere"), ["import-not-found"])
        self.assertEqual(self.reports(main, "--lib", "Other=elsewhere"), {"walls": 4, "faces": 32})

    def testRelativePathsAreLookedForInLibrariesLast(self):
        self.put("p/rules/main.cga", 'import w : "w.cga"\nLot --> w.Wall\n')
        self.put("lib/rules/w.cga", 'Wall --> report("lib", 1) X.\n')
        self.assertEqual(self.reports("p/rules/main.cga", "--lib", "lib"), {"lib": 1})
        self.put("p/rules/w.cga", 'Wall --> report("own", 1) X.\n')
        self.assertEqual(self.reports("p/rules/main.cga", "--lib", "lib"), {"own": 1})

    def testPatternsReachOtherProjects(self):
        main = self.project()
        self.put(main, 'Lot --> report("n", listSize(fileSearch("/Other/assets/*.obj"))) X.\n')
        self.assertEqual(self.reports(main, "--workspace", "town"), {"n": 1})
        self.assertEqual(self.reports(main), {"n": 0})

    def testSearchesNameTheProjectOfEveryFileInAWorkspace(self):
        main = self.project()
        for name in ("town/Mine/assets/b.obj", "town/Mine/a.obj", "town/Zoo/assets/c.obj"):
            self.put(name, CUBE)
        rules = 'Lot --> print(filesSearch("*.obj")) print(filesSearch("b*")) {} X.\n'
        self.put(main, rules.format('i(fileRandom("b.obj")) report("n", geometry.nVertices)'))
        own, other = '"/Mine/a.obj","/Mine/assets/b.obj"', '"/Other/assets/panel.obj","/Zoo/assets/c.obj"'
        told = self.gable("generate", main, "--workspace", "town", "-o", "out.glb", "--stats", "stats.json")
        self.assertIn("(4)[" + f"{own},{other}".replace('"', "") + "]", told)
        self.assertIn("(1)[/Mine/assets/b.obj]", told)
        self.assertEqual(json.loads((self.folder / "stats.json").read_text())["reports"]["n"]["sum"], 8)
        # From a file of another project the order is the same.
        self.put("town/Other/rules/w.cga", rules.replace("Lot", "Wall").format(""))
        self.put(main, 'import w : "/Other/rules/w.cga"\nLot --> w.Wall\n')
        told = self.gable("generate", main, "--workspace", "town", "-o", "out.glb")
        self.assertIn("(4)[" + f"{own},{other}".replace('"', "") + "]", told)
        # Without a workspace a file of the project is named by its path in the project.
        self.put(main, rules.format(""))
        self.assertIn("(2)[/a.obj,/assets/b.obj]", self.gable("generate", main, "-o", "out.glb"))

    def testFilesAreFoundByNameWhereThatIsAskedFor(self):
        self.put("p/rules/main.cga", 'import w : "/Gone/rules/Walls.cga"\nLot --> w.Wall i("x/Panel.obj") X.\n')
        self.put("p/rules/old/walls.cga", 'Wall --> report("old", 1) X.\n')
        self.put("p/rules/z/rules/walls.cga", 'Wall --> report("near", 1) X.\n')
        self.put("p/assets/deep/panel.obj", CUBE)
        main = "p/rules/main.cga"
        self.assertEqual(self.codes(main), ["import-not-found", "missing-file"])
        self.assertEqual(self.codes(main, "--find-by-name"), [])
        # Of two files that have the name, the one whose folders are those of the path.
        self.assertEqual(self.reports(main, "--find-by-name"), {"near": 1})

    def testAFileThatIsMissingIsToldOnce(self):
        main = self.put("main.cga", 'Lot --> extrude(3) comp(f) { side : Wall | top : texture("gone.jpg") X. }\n'
                        'Wall --> texture("away" + ".jpg") print(len(readTextFile("gone.txt"))) [ i("gone.obj") ] Y.\n')
        for out in ("out.glb", "out.obj"):
            told = self.gable("generate", main, "-o", out)
            lines = [line for line in told.splitlines() if ": warning: " in line or line.startswith("warning: ")]
            self.assertEqual(len(lines), 4, told)
            for name, place in (("away", "main.cga:2:10"), ("gone.jpg", "main.cga:1:58")):
                places = [line.split(": warning")[0] for line in lines if name in line]
                self.assertEqual([pathlib.Path(p).name for p in places], [place], told)

    def testTheRestIsDerivedWithoutWhatIsMissing(self):
        main = self.put("main.cga", 'import a : "/ESRI.lib/rules/a.cga"\nimport b : "/ESRI.lib/rules/a.cga" (h = 2)\n'
                        'attr h = a.h\nattr k = case a.on : 1 else : 2\n'
                        'Lot --> a.Trees extrude(3) report("k", k) comp(f) { top : b.Roof(a.f(1)) | side : Wall }\n'
                        'Wall --> set(a.h, 2) extrude(h) color(a.tint) report("walls", 1) X.\n')
        told = self.gable("check", main)
        self.assertEqual(told.count("import-not-found"), 1, told)
        self.assertNotIn("error[", told)
        self.assertEqual(self.reports(main)["walls"], 4)

    def testFoldersThatAreNotThereAreTold(self):
        main = self.project()
        self.assertEqual(self.codes(main, "--workspace", "nowhere", status=FILE), ["folder-missing"])
        self.assertEqual(self.codes(main, "--lib", "nowhere", status=FILE), ["folder-missing"])
        self.assertEqual(self.codes(main, "--lib", "X=" + main, status=FILE), ["folder-missing"])

    def testNothingElseIsRead(self):
        main = self.project()
        secret = self.put("secret.cga", "Wall --> X.\n")
        (self.folder / "town/Other/rules/link.cga").symlink_to(self.folder / secret)
        self.put("town/.hidden/rules/h.cga", "Wall --> X.\n")
        for path in ["/Other/../../secret.cga", "/Other/rules/link.cga", "/.hidden/rules/h.cga",
                     str(self.folder / secret), "..\\\\..\\\\..\\\\secret.cga"]:
            self.put(main, f'import w : "{path}"\nLot --> w.Wall\n')
            for options in [["--workspace", "town"], ["--lib", "town/Other"], ["--lib", "town/Other", "--find-by-name"]]:
                self.assertEqual(self.codes(main, *options), ["import-not-found"], path)

    def testCyclesAcrossProjectsAreTold(self):
        main = self.project()
        self.put("town/Other/rules/w.cga", 'import m : "/Mine/rules/main.cga"\nWall --> m.Lot\n')
        self.assertEqual(self.codes(main, "--workspace", "town", status=WRONG), ["import-cycle"])

    def testTheVisualEditorsFilesAreNamed(self):
        main = self.put("main.cga", 'import a : "design.vcga"\nLot --> a.Lot\n')
        self.put("design.vcga", "{}")
        self.assertEqual(self.codes(main), ["visual-cga"])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v", *sys.argv[3:]])
