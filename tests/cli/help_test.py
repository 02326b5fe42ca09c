#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""What helps at the command line: help_test.py GABLE FOLDER.

Every example of every command's help runs; shells complete commands, options, words and files; man pages are well
formed. A shell or formatter that is not installed is skipped. Run from the repository's root.
"""
import json
import os
import pty
import re
import select
import shutil
import signal
import subprocess
import time
import unittest
from pathlib import Path

import cli_test
from cli_test import DONE, GABLE, USAGE

ROOT = Path.cwd()
COMMAND = re.compile(r"^  ([a-z]+) {2,}", re.M)


def help_of(*words):
    return subprocess.run([str(GABLE), *words, "--help"], capture_output=True, text=True, check=True).stdout


def commands():
    """Words of each command, those below commands too."""
    found = []
    for name in COMMAND.findall(help_of().partition("Subcommands:")[2].partition("Exit status")[0]):
        found.append([name])
        below = help_of(name).partition("Subcommands:")[2].partition("Examples")[0]
        found += [[name, word] for word in COMMAND.findall(below)]
    return found


def examples(*words):
    return [line.strip() for line in help_of(*words).partition("Examples:\n")[2].splitlines() if line.strip()]


def square(x, y, properties):
    d = 0.0002
    ring = [[x, y], [x + d, y], [x + d, y + d], [x, y + d], [x, y]]
    return {"type": "Feature", "properties": properties, "geometry": {"type": "Polygon", "coordinates": [ring]}}


class Case(cli_test.Case):
    def setUp(self):
        super().setUp()
        (self.folder / "bin").mkdir()
        os.symlink(GABLE, self.folder / "bin/gable")
        self.environment = {**os.environ, "PATH": f"{self.folder}/bin:{os.environ['PATH']}"}

    def shell(self, line, timeout=120):
        return subprocess.run(["bash", "-c", line], cwd=self.folder, env=self.environment, capture_output=True, text=True,
                              timeout=timeout, check=False)


class Examples(Case):
    """In a folder as a user has it: rules, lots, a map, models."""

    def setUp(self):
        super().setUp()
        self.shell("gable new house && mv house/* . && rmdir house && cp rules/house.cga . ")
        self.put("house.gbbg", next((ROOT / "examples/gbbg").glob("*.gbbg")).read_text())
        lots = [square(7.42 + 0.0004 * i, 43.73, {}) for i in range(3)]
        self.put("lots.geojson", json.dumps({"type": "FeatureCollection", "features": lots}))
        houses = [square(7.42 + 0.0004 * i, 43.73, {"building": "house"}) for i in range(3)]
        self.put("map.geojson", json.dumps({"type": "FeatureCollection", "features": houses}))
        (self.folder / "my-folder").mkdir()

    def before(self, words):
        """What the examples of a command begin with."""
        if words[0] == "tiles" and words[1:] in (["job"], ["merge"], ["submit"]):
            return "gable tiles plan house.cga --shapes lots.geojson -o land"
        return {"tiles join": "for p in east west; do gable tiles house.cga --shapes lots.geojson -o country/$p; done",
                "tiles viewer": "gable tiles house.cga --shapes lots.geojson -o tiles",
                "render": "gable generate house.cga --lot 24x18 -o house.glb",
                "asset prepare": "gable generate house.cga --lot 24x18 -o door.glb",
                "diff": "gable generate house.cga --lot 24x18 -o before.glb; cp before.glb after.glb"}.get(" ".join(words), ":")

    def testEveryCommandHasSome(self):
        for words in commands():
            if words != ["asset"]:
                self.assertTrue(examples(*words), f"{words}: add a line to apps/gable/examples.cpp")

    def testEachRuns(self):
        for words in commands():
            self.shell(self.before(words))
            for line in examples(*words):
                if ".png" in line:
                    # Small, for time's sake.
                    line = re.sub(r" --(size|samples) \S+", "", line) + " --size 64x36 --samples 1"
                if words[0] in ("lsp", "studio", "watch"):
                    self.serves(words[0], line)
                    continue
                done = self.shell(line)
                # The page of tiles and the studio's are built apart, which the program tells.
                if "is not built" in done.stderr:
                    continue
                self.assertEqual(done.returncode, DONE, f"{line}\n{done.stdout}{done.stderr}")

    def serves(self, name, line):
        """Those that end when they are told to."""
        with subprocess.Popen(["bash", "-c", "exec " + line], cwd=self.folder, env=self.environment, stdin=subprocess.PIPE,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE) as server:
            try:
                if name == "lsp":
                    server.stdin.close()
                    server.stdin = None
                elif server.stdout.readline():
                    time.sleep(0.3)
                    server.send_signal(signal.SIGINT)
                _, told = server.communicate(timeout=60)
                self.assertIn(server.returncode, (0, 1, 3) if name != "watch" else (0, 4), f"{line}\n{told}")
            finally:
                server.kill()


class Completion(Case):
    EXPECTED = {"gable rend": ("render",), "gable tiles me": ("merge",), "gable render --view f": ("front",),
                "gable render --find": ("--find-by-name",), "gable asset p": ("prepare",),
                "gable generate --output mod": ("model.glb",), "gable check rul": ("rules.cga",),
                "gable pack rules.cga --project fol": ("folder/",)}

    def setUp(self):
        super().setUp()
        for name in ("model.glb", "model.txt", "rules.cga", "rules.txt"):
            self.put(name, "")
        (self.folder / "folder").mkdir()

    def script(self, shell):
        if not shutil.which(shell):
            self.skipTest(f"{shell} is not installed")
        text = self.shell(f"gable completion {shell}").stdout
        self.put(f"complete.{shell}", text)
        self.assertGreater(text.count("\n"), 200)

    def typed(self, command, ready, line, expected):
        """What a shell on a terminal makes of a line and a tabulator; it has some seconds for it."""
        pid, terminal = pty.fork()
        if pid == 0:
            os.chdir(self.folder)
            os.execvpe(command[0], command, {**self.environment, "TERM": "dumb", "PS1": "$ ", "COLUMNS": "200",
                                             "ZDOTDIR": str(self.folder)})
        def read_until(mark, seconds=20):
            shown, end = "", time.monotonic() + seconds
            while mark not in shown and time.monotonic() < end:
                if select.select([terminal], [], [], 0.1)[0]:
                    try:
                        shown += os.read(terminal, 65536).decode(errors="replace")
                    except OSError:
                        break
            return shown
        os.write(terminal, ready.encode() + b"; echo rea''dy\n")
        read_until("ready")
        # The answer is the line itself, as the shell would run it.
        os.write(terminal, b"show() { echo \"<$*>\"; }; echo rea''dy2\n")
        read_until("ready2")
        os.write(terminal, line.encode() + b"\t")
        read_until(expected[len(line.rpartition(" ")[2]):], 8)
        time.sleep(0.2)
        os.write(terminal, b"\x01show \n")
        shown = read_until(">\r\n")
        os.kill(pid, signal.SIGKILL)
        os.waitpid(pid, 0)
        os.close(terminal)
        found = re.findall(r"<([^>\n]*)>\r", shown)
        return found[-1] if found else shown

    def check(self, command, ready):
        for line, words in self.EXPECTED.items():
            start = line.rpartition(" ")[0]
            self.assertEqual(self.typed(command, ready, line, words[0]).rstrip(" /"), f"{start} {words[0]}".rstrip("/"), line)

    def testBash(self):
        self.script("bash")
        self.check(["bash", "--norc", "--noprofile", "-i"], "bind 'set enable-bracketed-paste off'; . ./complete.bash")

    def testZsh(self):
        self.script("zsh")
        (self.folder / "fpath").mkdir()
        shutil.copy(self.folder / "complete.zsh", self.folder / "fpath/_gable")
        self.check(["zsh", "-f", "-i"], "unsetopt zle_bracketed_paste; fpath=($PWD/fpath $fpath); autoload -U compinit; "
                   "compinit -u -D; bindkey -e")

    def testFish(self):
        self.script("fish")
        for line, words in self.EXPECTED.items():
            done = self.shell(f"fish --no-config -c 'source complete.fish; complete -C \"{line}\"'")
            found = [each.split("\t")[0] for each in done.stdout.splitlines()]
            self.assertIn(words[0], found, f"{line}\n{done.stderr}")
            if "mod" not in line and "rul" not in line:
                self.assertEqual(len(found), 1, line)

    def testFilesAreThoseThatFit(self):
        self.script("bash")
        line = ("source ./complete.bash; COMP_WORDS=(gable generate --output mod); COMP_CWORD=3; _gable; "
                "echo ${COMPREPLY[*]}; COMP_WORDS=(gable generate --view = mod)")
        self.assertEqual(self.shell(line).stdout, "model.glb\n")
        (self.folder / " blank .glb").touch()
        (self.folder / " folder ").mkdir()
        line = ("source ./complete.bash; COMP_WORDS=(gable generate --output ' '); COMP_CWORD=3; _gable; "
                "printf '%s|' \"${COMPREPLY[@]}\"")
        self.assertEqual(self.shell(line).stdout, " folder | blank .glb|")
        line = "source ./complete.bash; COMP_WORDS=(gable render --view = f); COMP_CWORD=4; _gable; echo ${COMPREPLY[*]}"
        self.assertEqual(self.shell(line).stdout, "front\n")


class Endings(Case):
    def testHelpNamesAllFormatsOfModels(self):
        known = re.search(r"\(([. a-z]+)\)", self.run_gable("generate", "x.cga", "-o", "x.none", status=USAGE))[1].split()
        self.assertIn(".usdz", known)
        for command in ("generate", "watch", "city"):
            told = self.shell(f"gable {command} --help").stdout
            output = re.search(r"--output .*?(?=\n +-)", told, re.S)[0]
            self.assertEqual([e for e in known if e + " " not in output.replace("\n", " ").replace(";", " ") + " "], [], command)


    def testHelpIsAWordToo(self):
        self.assertEqual(self.run_gable("help"), self.run_gable("--help"))
        self.assertEqual(self.run_gable("help", "tiles", "plan"), self.run_gable("tiles", "plan", "--help"))


class Man(Case):
    def testEveryCommandHasAPage(self):
        self.run_gable("man", "-o", "pages")
        pages = sorted(p.name for p in (self.folder / "pages").iterdir())
        self.assertEqual(pages, sorted(["gable.1", *("gable-" + "-".join(words) + ".1" for words in commands())]))
        for words in commands():
            page = (self.folder / "pages" / ("gable-" + "-".join(words) + ".1")).read_text()
            for option in re.findall(r"^  (?:-\w,)?(--[a-z-]+)", help_of(*words), re.M):
                self.assertIn(option.replace("-", "\\-"), page, words)
            self.assertEqual(self.run_gable("man", *words), page)
        self.run_gable("man", "nothing", status=2, says="no command 'gable nothing'")

    def testTheyAreWellFormed(self):
        if not shutil.which("groff"):
            self.skipTest("groff is not installed")
        self.run_gable("man", "-o", "pages")
        for page in (self.folder / "pages").iterdir():
            done = self.shell(f"groff -man -ww -Tutf8 {page} >/dev/null")
            self.assertEqual((done.returncode, done.stderr), (0, ""), page.name)


if __name__ == "__main__":
    unittest.main(argv=[cli_test.sys.argv[0], *cli_test.sys.argv[3:]])
