#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""How the program speaks: terminal_test.py GABLE FOLDER.

Colours, quiet and verbose runs, the bar on a terminal, the one form of answers in JSON, the exit statuses and their
page. Run from the repository's root.
"""
import json
import os
import pty
import re
import select
import subprocess
import time
import unittest
from pathlib import Path

import cli_test
from cli_test import DONE, FILE, GABLE, USAGE, WRONG

ROOT = Path.cwd()
PAGE = (ROOT / "docs/reference/command-line.md").read_text(encoding="utf-8")
BAD = "Lot --> extrud(3) X.\nB --> Foo\n"
GOOD = 'Lot --> print("hi") report("n", 1) extrude(9) comp(f) { all : X. }\n'
SLOW = "Lot --> split(x) { 0.7 : split(z) { 0.7 : s('1, rand(1, 9), '1) roofHip(30) X. }* }*"


def on_terminal(command, folder, seconds=60, **environment):
    """What a command shows on a terminal of 100 columns, until it ends."""
    pid, terminal = pty.fork()
    if pid == 0:
        os.chdir(folder)
        os.execvpe(command[0], command, {**os.environ, "TERM": "xterm", "COLUMNS": "100", **environment})
    shown, end = b"", time.monotonic() + seconds
    while time.monotonic() < end:
        if select.select([terminal], [], [], 0.2)[0]:
            try:
                more = os.read(terminal, 65536)
            except OSError:
                more = b""
            if not more:
                break
            shown += more
    status = os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
    os.close(terminal)
    return status, shown.decode(errors="replace")


class Case(cli_test.Case):
    def setUp(self):
        super().setUp()
        self.put("good.cga", GOOD)
        self.put("bad.cga", BAD)

    def ran(self, *arguments, status=DONE, **environment):
        clean = {k: v for k, v in os.environ.items() if k not in ("NO_COLOR", "CLICOLOR", "CLICOLOR_FORCE")}
        done = subprocess.run([str(GABLE), *arguments], cwd=self.folder, capture_output=True, text=True, timeout=120,
                              check=False, env={**clean, **environment})
        self.assertEqual(done.returncode, status, f"{arguments}\n{done.stdout}{done.stderr}")
        return done

    def answer(self, *arguments, status=DONE):
        done = self.ran(*arguments, "--json", status=status)
        told = json.loads(done.stdout)
        self.assertEqual(list(told)[:4], ["command", "status", "files", "diagnostics"])
        self.assertEqual(told["status"], status)
        json.loads(done.stdout, object_pairs_hook=self.unique)
        return told

    def unique(self, pairs):
        self.assertEqual(len({name for name, _ in pairs}), len(pairs), "a name twice in an object")
        return dict(pairs)


class Colours(Case):
    def testTheyFollowTheConventions(self):
        def coloured(*arguments, **environment):
            done = self.ran("check", "bad.cga", *arguments, status=WRONG, **environment)
            return "\033[" in done.stdout + done.stderr
        self.assertFalse(coloured())
        self.assertTrue(coloured("--color=always"))
        self.assertTrue(coloured("--color=always", NO_COLOR="1"))
        self.assertTrue(coloured(CLICOLOR_FORCE="1"))
        self.assertFalse(coloured(CLICOLOR_FORCE="0"))
        self.assertFalse(coloured("--color=never", CLICOLOR_FORCE="1"))
        self.assertFalse(coloured(CLICOLOR_FORCE="1", NO_COLOR="1"))
        self.assertTrue(coloured(CLICOLOR_FORCE="1", NO_COLOR=""))
        self.ran("check", "bad.cga", "--color=blue", status=USAGE)

    def testATerminalHasThem(self):
        command = [str(GABLE), "check", "bad.cga"]
        for environment, expected in (({}, True), ({"NO_COLOR": "1"}, False), ({"CLICOLOR": "0"}, False),
                                      ({"TERM": "dumb"}, False)):
            status, shown = on_terminal(command, self.folder, **environment)
            self.assertEqual((status, "\033[" in shown), (WRONG, expected), environment)

    def testTheWordsAreTheSame(self):
        plain = self.ran("check", "bad.cga", status=WRONG).stdout
        painted = self.ran("check", "bad.cga", "--color=always", status=WRONG).stdout
        self.assertEqual(re.sub(r"\033\[[0-9;]*m", "", painted), plain)


class Words(Case):
    def testQuietLeavesTheErrors(self):
        self.assertIn("warning", self.ran("check", "bad.cga", status=WRONG).stdout)
        quiet = self.ran("check", "-q", "bad.cga", status=WRONG).stdout
        self.assertIn("'extrud'", quiet)
        self.assertNotIn("warning", quiet)
        self.put("warns.cga", "Lot --> Foo")
        done = self.ran("generate", "-q", "warns.cga", "-o", "a.glb")
        self.assertEqual(done.stdout + done.stderr, "")
        done = self.ran("pack", "good.cga", "-o", "a.zip", "--quiet")
        self.assertEqual(done.stdout + done.stderr, "")

    def testVerboseTellsTheSteps(self):
        told = self.ran("generate", "-v", "good.cga", "-o", "a.glb")
        self.assertEqual(re.sub(r"[\d.]+ s", "T", told.stderr), "reading good.cga: T\nderiving: T\nwriting a.glb: T\n")
        self.assertEqual(told.stdout, "hi\n")
        told = self.ran("render", "-v", "good.cga", "--size", "16x9", "--samples", "1", "-o", "a.png")
        self.assertRegex(told.stderr, r"^reading good.cga: [\d.]+ s\nderiving: [\d.]+ s\n  drawing textures: ")
        self.ran("generate", "-q", "-v", "good.cga", "-o", "a.glb", status=USAGE)

    def testTheVersionTellsWhatItWasBuiltWith(self):
        lines = self.ran("--version").stdout.splitlines()
        self.assertRegex(lines[0], r"^gable \d+\.\d+\.\d+$")
        self.assertRegex(lines[1], r"^built by .*\d.* with ")
        self.assertIn("gable-maps", "\n".join(lines))


class Bar(Case):
    def testItIsOnATerminalAlone(self):
        self.put("still.cga", "Lot --> extrude(9) X.")
        command = [str(GABLE), "render", "still.cga", "--size", "320x240", "--samples", "64", "-o", "a.png"]
        status, shown = on_terminal(command, self.folder)
        self.assertEqual(status, DONE, shown)
        self.assertRegex(shown, r"drawing  \[#*-*\] +\d+ %  [\d.]+ pixels/s  .* left")
        # What was written is told where the bar was.
        self.assertRegex(shown, r"\r\x1b\[Ka\.png  [\d.]+ kB\r?\n$")
        for line in re.split(r"[\r\n]", shown):
            self.assertLess(len(re.sub(r"\x1b\[[0-9;]*[mK]", "", line)), 100)
        status, shown = on_terminal([*command, "-q"], self.folder)
        self.assertEqual((status, shown), (DONE, ""))
        done = self.ran(*command[1:])
        self.assertEqual(done.stdout + done.stderr, "")

    def testACheckSaysThatAllIsWell(self):
        self.put("other.cga", "Lot --> extrude(9) X.")
        status, shown = on_terminal([str(GABLE), "check", "good.cga"], self.folder)
        self.assertEqual((status, shown), (DONE, "good.cga: no mistakes\r\n"))
        status, shown = on_terminal([str(GABLE), "check", "good.cga", "other.cga"], self.folder)
        self.assertEqual((status, shown), (DONE, "2 files: no mistakes\r\n"))
        status, shown = on_terminal([str(GABLE), "check", "-q", "good.cga"], self.folder)
        self.assertEqual((status, shown), (DONE, ""))
        done = self.ran("check", "good.cga")
        self.assertEqual(done.stdout + done.stderr, "")

    def testShapesHaveARate(self):
        square = [[[0, 0], [0.0003, 0], [0.0003, 0.0003], [0, 0.0003], [0, 0]]]
        lots = [{"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates":
                 [[[x + 0.001 * i, y] for x, y in square[0]]]}} for i in range(60)]
        self.put("lots.geojson", json.dumps({"type": "FeatureCollection", "features": lots}))
        self.put("slow.cga", SLOW)
        status, shown = on_terminal([str(GABLE), "generate", "slow.cga", "--shapes", "lots.geojson", "--jobs", "1",
                                     "--no-sharing", "-o", "a.glb", "--seed", "1"], self.folder)
        self.assertEqual(status, DONE, shown[-500:])
        self.assertRegex(shown, r"deriving  \[#*-*\] +\d+ %  [\d.]+ shapes/s  .* left")


    def testWhatRulesPrintStandsApartFromIt(self):
        lots = [{"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [
            [[x + 0.001 * i, y] for x, y in ((0, 0), (0.0003, 0), (0.0003, 0.0003), (0, 0.0003), (0, 0))]]}} for i in range(60)]
        self.put("lots.geojson", json.dumps({"type": "FeatureCollection", "features": lots}))
        self.put("slow.cga", SLOW.replace("--> ", '--> print("a line") ', 1))
        self.ran("tiles", "plan", "slow.cga", "--shapes", "lots.geojson", "--job-shapes", "1", "-o", "t", "--no-sharing")
        jobs = self.answer("tiles", "submit", "t", "--parallel", "--dry-run")["script"]
        last = int(re.search(r"seq 0 (\d+)", (self.folder / jobs).read_text())[1])
        status, shown = on_terminal([str(GABLE), "tiles", "job", "t", f"0-{last}", "--threads", "1"], self.folder)
        self.assertEqual(status, DONE, shown[-500:])
        self.assertIn("writing tiles  [", shown)
        told = [line for line in re.split(r"[\r\n]|\x1b\[K", shown) if "a line" in line]
        self.assertEqual(set(told), {"a line"})


class Answers(Case):
    def testEveryCommandAnswersInOneForm(self):
        self.put("a.test", "== one\nrules: good.cga\nexpect:\n  leaves 6\n")
        self.put("g.gbbg", next((ROOT / "examples").glob("gbbg/*.gbbg")).read_text())
        told = self.answer("generate", "good.cga", "-o", "a.glb")
        self.assertEqual((told["command"], told["files"], told["prints"]), ("generate", ["a.glb"], ["hi"]))
        self.assertEqual(told["leaves"], 6)
        self.assertEqual(self.answer("pack", "good.cga", "-o", "a.zip")["files"], ["a.zip"])
        self.assertEqual(self.answer("new", "fresh")["command"], "new")
        self.assertEqual(self.answer("render", "a.glb", "--size", "16x9", "--samples", "1", "-o", "a.png")["files"], ["a.png"])
        self.assertTrue(self.answer("diff", "a.glb", "a.glb")["same"])
        self.assertEqual(self.answer("info", "good.cga")["startRule"], "Lot")
        self.assertEqual(self.answer("ops", "extrude")["name"], "extrude")
        self.assertIn("operations", self.answer("ops"))
        self.put("dense.cga", "Lot-->X.")
        self.assertEqual(self.answer("format", "--check", "dense.cga", status=WRONG)["changed"], ["dense.cga"])
        self.assertEqual(self.answer("trace", "good.cga")["trees"][0]["shape"], "Lot")
        self.assertEqual(self.answer("trace", "good.cga", "-o", "t.json")["files"], ["t.json"])
        self.assertIn("-->", self.answer("convert", "g.gbbg")["text"])
        told = self.answer("test", "a.test")
        self.assertEqual((told["passed"], told["failed"], told["cases"][0]["name"]), (1, 0, "one"))
        self.assertEqual(self.answer("asset", "prepare", "a.glb", "-o", "b.glb")["command"], "asset prepare")
        self.put("lots.geojson", json.dumps({"type": "Polygon", "coordinates": [[[0, 0], [0.0002, 0], [0.0002, 0.0002], [0, 0]]]}))
        told = self.answer("tiles", "good.cga", "--shapes", "lots.geojson", "-o", "t")
        self.assertEqual((told["files"], told["shapes"]), (["t/"], 1))

    def testEachMemberIsThereOnce(self):
        self.put("other.cga", "Lot-->X.")
        told = self.answer("generate", "good.cga", "-o", "a.obj", "--stats", "-", "--reports", "-")
        self.assertEqual((told["leaves"], told["reports"]["n"]["sum"]), (6, 1))
        self.assertIn("n,,1,1", told["table"])
        told = self.answer("check", "good.cga", "other.cga", "--disassemble")["disassembly"]
        self.assertEqual([one["file"] for one in told], ["good.cga", "other.cga"])
        self.assertIn("extrude", told[0]["text"])
        # With all kinds of instructions.
        town = str(ROOT / "examples/town/town.cga")
        self.assertIn("component-values", self.run_gable("check", town, "--disassemble"))
        told = self.answer("format", "good.cga", "other.cga", "--stdout")
        self.assertEqual([one["file"] for one in told["texts"]], ["good.cga", "other.cga"])
        self.assertEqual((told["texts"][1]["text"], told["changed"]), ("Lot --> X.\n", []))
        house = {"type": "Polygon", "coordinates": [[[7, 43], [7.0002, 43], [7.0002, 43.0002], [7, 43]]]}
        self.put("map.geojson", json.dumps({"type": "Feature", "properties": {"building": "house"}, "geometry": house}))
        told = self.answer("city", "map.geojson", "--plan", "-", "--stats", "-")
        self.assertEqual(json.loads(told["plan"])["type"], "FeatureCollection")

    def testMaterialsOfTheLibrary(self):
        listed = self.answer("asset", "material")["materials"]
        self.assertEqual(sorted(listed[0]), ["color", "doc", "height", "name", "width"])
        lines = self.ran("asset", "material").stdout.splitlines()
        self.assertEqual([line.split()[0] for line in lines], [m["name"] for m in listed])
        told = self.answer("asset", "material", "brick.flemish", "-o", "bricks")
        self.assertEqual(told["files"], ["bricks"])
        self.assertEqual(told["bytes"], sum(p.stat().st_size for p in (self.folder / "bricks").iterdir()))
        done = self.ran("asset", "material", "brick.flemish", "-o", "bricks", "--quiet")
        self.assertEqual(done.stdout + done.stderr, "")
        # A name that is none leaves no folder; a folder that cannot be made is told.
        told = self.answer("asset", "material", "brik", "-o", "none", status=USAGE)
        self.assertEqual([d["code"] for d in told["diagnostics"]], ["unknown-material"])
        self.assertFalse((self.folder / "none").exists())
        done = self.ran("asset", "material", "brick.flemish", "-o", "good.cga/bricks", status=FILE)
        self.assertIn("good.cga/bricks", done.stderr)

    def testWhatIsWrongIsPartOfIt(self):
        told = self.answer("check", "bad.cga", status=WRONG)
        self.assertEqual([d["code"] for d in told["diagnostics"]], ["unknown-operation", "undefined-rule"])
        told = self.answer("generate", "nothing.cga", "-o", "a.glb", status=FILE)
        self.assertEqual(told["files"], [])
        self.assertEqual([d["code"] for d in self.answer("genrate", status=USAGE)["diagnostics"]], ["command-line"])
        self.assertEqual(self.answer("generate", status=USAGE)["command"], "generate")
        self.assertIn("--lot", self.answer("generate", "good.cga", "--lot", "x", "-o", "a.glb", status=USAGE)
                      ["diagnostics"][0]["message"])

    def testThePageHasTheMembers(self):
        for arguments in (("generate", "good.cga", "-o", "a.glb"), ("info", "good.cga"), ("pack", "good.cga", "-o", "a.zip"),
                          ("format", "good.cga"), ("ops",)):
            for member in self.answer(*arguments):
                self.assertIn(f"`{member}`", PAGE, arguments)


class ExitStatus(Case):
    def testThePageHasWhatTheProgramSays(self):
        told = dict(re.findall(r"^  (\d)  (.*)$", self.ran("--help").stdout, re.M))
        rows = dict(re.findall(r"^\| (\d) \| ([^|]*) \|", PAGE, re.M))
        self.assertEqual(rows, told)
        self.assertEqual(sorted(told), ["0", "1", "2", "3", "4"])

    def testThePageHasTheOptionsOfEveryCommand(self):
        help_text = self.ran("pack", "--help").stdout
        for option in re.findall(r"--[a-z]+", help_text[help_text.index("What it says"):help_text.index("Examples")]):
            self.assertIn(option, PAGE)

    def testEachOccurs(self):
        self.ran("generate", "good.cga", "-o", "a.glb", status=0)
        self.ran("check", "bad.cga", status=1)
        self.ran("check", status=2)
        self.ran("check", "nothing.cga", status=3)
        self.ran("generate", "good.cga", "-o", "a.glb", "--max-steps", "1", status=4)


if __name__ == "__main__":
    unittest.main(argv=[cli_test.sys.argv[0], *cli_test.sys.argv[3:]])
