#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Beginning a project, and working on it: `gable new`, and commands that run again: begin_test.py GABLE FOLDER."""
import json
import subprocess
import sys
import time
import unittest

from cli_test import DONE, FILE, GABLE, USAGE, WRONG, Case

RULES = "Lot --> extrude(3)\n"


class New(Case):
    def testAProjectHoldsWhatItSays(self):
        self.run_gable("new", "my-house", says="gable studio")
        home = self.folder / "my-house"
        self.assertEqual(sorted(p.name for p in home.iterdir()), ["README.md", "assets", "rules", "tests"])
        told = self.run_gable("check", "my-house/rules/my-house.cga")
        self.assertEqual(told, "")
        self.run_gable("format", "--check", "my-house/rules/my-house.cga")
        self.run_gable("test", "my-house", says="1 passed, 0 failed")
        # A lot that is no rectangle, and every height.
        for height in ("3", "60"):
            self.run_gable("generate", "my-house/rules/my-house.cga", "--lot", "13x31", "--set", f"height={height}",
                           "-o", "out.glb")
        self.assertNotIn("NAME", (home / "README.md").read_text() + (home / "tests/my-house.test").read_text())

    def testNothingIsOverwritten(self):
        (self.folder / "full").mkdir()
        self.put("full/a.txt", "mine")
        self.run_gable("new", "full", status=USAGE, says="there already")
        self.assertEqual([p.name for p in (self.folder / "full").iterdir()], ["a.txt"])
        self.put("file", "mine")
        self.run_gable("new", "file", status=USAGE, says="no empty folder")
        self.run_gable("new", "file/below", status=FILE, says="cannot be made")
        (self.folder / "empty").mkdir()
        self.run_gable("new", "empty/", status=DONE)
        self.run_gable("new", "two words/house", status=DONE, says="cd 'two words/house'")

    def testNamesThatAreNone(self):
        for name in ("a b", "-x", "ä", "/", ".."):
            self.run_gable("new", "--", name, status=USAGE)
        self.run_gable("new", status=USAGE, says="folder")


class Watch(Case):
    def watching(self, *arguments):
        return subprocess.Popen([str(GABLE), *arguments, "--watch"], cwd=self.folder, stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, text=True)

    def testAModelIsMadeAgain(self):
        (self.folder / "rules").mkdir()
        self.put("rules/tower.cga", 'import part : "part.cga"\nLot --> part.Lot\n')
        self.put("rules/part.cga", RULES)
        with self.watching("generate", "rules/tower.cga", "-o", "rules/out.obj") as watching:
            try:
                self.assertEqual(watching.stdout.readline(), "rules/out.obj\n")
                time.sleep(1)
                self.put("rules/part.cga", RULES.replace("3", "7"))
                self.assertEqual(watching.stdout.readline(), "\n")
                self.assertEqual(watching.stdout.readline(), f"{self.folder}/rules/part.cga has changed\n")
                self.assertEqual(watching.stdout.readline(), "rules/out.obj\n")
                self.assertIn(" 7 ", (self.folder / "rules/out.obj").read_text())
                # A mistake is told, and the model of before stays.
                time.sleep(1)
                self.put("rules/part.cga", "Lot --> extrud(3)\n")
                told = ""
                while "did you mean" not in told and (line := watching.stdout.readline()):
                    told += line
                self.assertIn("part.cga:1", told)
                self.assertIn(" 7 ", (self.folder / "rules/out.obj").read_text())
                time.sleep(1)
                watching.send_signal(2)
                self.assertEqual(watching.wait(timeout=10), WRONG)
            finally:
                watching.kill()

    def testEachRunHasAnAnswer(self):
        self.put("tower.cga", RULES)
        with self.watching("generate", "tower.cga", "-o", "out.obj", "--json") as watching:
            try:
                told = self.answer_of(watching)
                time.sleep(1)
                self.put("tower.cga", "Lot --> extrud(3)\n")
                told += self.answer_of(watching)
                watching.send_signal(2)
                told += watching.communicate(timeout=10)[0]
                self.assertEqual(watching.returncode, WRONG)
            finally:
                watching.kill()
        answers = [json.loads(text + "}") for text in told.split("\n}\n") if text]
        self.assertEqual([(a["status"], a["files"]) for a in answers], [(DONE, ["out.obj"]), (WRONG, [])])

    def testWhatNoSaveMendsEndsAWatch(self):
        self.put("tower.cga", "Lot --> extrude(9)\n")
        for arguments in (["watch", "tower.cga", "-o", "a.xyz"], ["watch", "tower.cga", "--lot", "nine", "-o", "a.glb"],
                          ["generate", "tower.cga", "-o", "a.obj", "--instancing", "gpu", "--watch"]):
            with self.subTest(arguments=arguments):
                done = subprocess.run([str(GABLE), *arguments], cwd=self.folder, capture_output=True, text=True,
                                      timeout=60, check=False)
                self.assertEqual(done.returncode, USAGE, done.stderr)

    def answer_of(self, watching):
        told = ""
        while not told.endswith("\n}\n") and (line := watching.stdout.readline()):
            told += line
        return told

    def testAFileThatWasMissingMayCome(self):
        with self.watching("render", "tower.cga", "-o", "out.png", "--size", "64x64", "--samples", "1") as watching:
            try:
                self.assertIn("tower.cga", watching.stdout.readline())
                time.sleep(1)
                self.put("tower.cga", RULES)
                told = ""
                while "out.png" not in told and (line := watching.stdout.readline()):
                    told += line
                self.assertTrue((self.folder / "out.png").exists())
            finally:
                watching.kill()


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
