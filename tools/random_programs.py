#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Makes random programs and runs them.

    tools/random_programs.py BUILD [--notation rules|park|gbbg|progen3d] [--count N] [--seed N] [--seconds N]
                             [--keep FOLDER] [--show N]

Program N of a notation is always the same. BUILD holds `run_programs`, which derives each program in several ways and
compares, and `gable`, which lists the operations. A program that crashes, hangs, or of which something does not hold is
made as small as it will go and printed; with --keep it is also written there. Exit status 1 where any failed.

    tools/random_programs.py build/dev --count 5000 --seconds 3600     an hour by hand
    tools/random_programs.py build/dev --notation park --show 17       the text of one
"""
import argparse
import json
import queue
import random
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import time
import zlib
from pathlib import Path

from programs.gbbg import Gbbg
from programs.park import Park
from programs.progen3d import Progen3d
from programs.rules import Rules
from programs.tree import smallest

NOTATIONS = {"rules": Rules, "park": Park, "gbbg": Gbbg, "progen3d": Progen3d}
# Seconds without an answer after which a program is taken for one that waits for itself; run_programs ends by itself
# what takes too much processor time.
PATIENCE = 600
# Runs that making one program smaller may take, and how many failures are made smaller.
SHRINK_RUNS, MOST_SHRUNK = 300, 5
# What the process that runs programs may take.
MEMORY = 6 << 30
# A generator whose programs are mostly refused finds nothing.
LEAST_DERIVED = 0.5
# After so many programs for each operation some must have been derived.
OFTEN = 5
HERE = Path(__file__).resolve().parent


def limited():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


class Runner:
    """The process that runs programs, started anew when a program has ended it."""

    def __init__(self, program, folder):
        self.program, self.folder = program, folder
        self.process = None

    def start(self):
        self.process = subprocess.Popen([self.program, self.folder], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.DEVNULL, text=True, errors="replace", cwd=self.folder,
                                        preexec_fn=limited)
        self.answers = queue.Queue()
        threading.Thread(target=self.listen, args=(self.process.stdout, self.answers), daemon=True).start()

    @staticmethod
    def listen(stream, answers):
        for line in stream:
            answers.put(line.rstrip("\n"))
        answers.put(None)

    def run(self, path, shapes):
        if self.process is None:
            self.start()
        self.process.stdin.write(f"{path}\t{shapes}\n")
        self.process.stdin.flush()
        try:
            answer = self.answers.get(timeout=PATIENCE)
        except queue.Empty:
            self.stop()
            return f"failed hang: no end within {PATIENCE} s"
        if answer is None:
            status = self.process.wait()
            self.process = None
            name = signal.Signals(-status).name if status < 0 else f"status {status}"
            return f"failed crash: {name}"
        if answer.startswith("failed hang"):
            self.stop()
        return answer

    def stop(self):
        if self.process is not None:
            self.process.kill()
            self.process.wait()
            self.process = None


class Session:
    """The programs of one notation."""

    def __init__(self, options, notation, folder):
        self.options, self.notation, self.folder = options, notation, folder
        self.runner = Runner(str(Path(options.build).resolve() / "run_programs"), folder)
        self.counts = {}
        self.refusals = {}
        self.failures = []
        # How many programs derive, by the operation that they are there for.
        self.subjects = {}

    def made(self, number):
        """The tree of a program, what it is derived on, its extension, and the operation that it is there for."""
        chosen = random.Random(f"{self.notation} {self.options.seed} {number}")
        maker = NOTATIONS[self.notation](self.options.catalogue, chosen)
        shapes = maker.shapes()
        subject = maker.subject(number) if self.notation == "rules" else None
        return maker.program(number), shapes, maker.extension, subject

    def answer(self, text, shapes, extension):
        path = Path(self.folder) / f"program{extension}"
        path.write_text(text)
        return self.runner.run(path.name, shapes)

    def run(self, number):
        tree, shapes, extension, subject = self.made(number)
        answer = self.answer(tree.text(), shapes, extension)
        kind, _, more = answer.partition(" ")
        if subject:
            self.subjects.setdefault(subject, 0)
            self.subjects[subject] += kind != "refused"
        self.counts[kind] = self.counts.get(kind, 0) + 1
        if kind == "refused":
            code = more.split(" ")[0]
            self.refusals[code] = self.refusals.get(code, 0) + 1
        if kind == "failed":
            self.report(number, tree, shapes, extension, more)

    def report(self, number, tree, shapes, extension, what):
        # It must go on failing in the same way.
        kind = what.split(":")[0]
        runs = SHRINK_RUNS if len(self.failures) < MOST_SHRUNK else 0
        if kind in ("hang", "slow"):
            runs = min(runs, 8)
        smallest(tree, lambda text: self.answer(text, shapes, extension).startswith(f"failed {kind}"), runs)
        self.failures.append(number)
        text = tree.text()
        print(f"--- {self.notation} {number}, on {shapes}: {what}\n{text}", flush=True)
        if self.options.keep:
            keep = Path(self.options.keep)
            keep.mkdir(parents=True, exist_ok=True)
            name = f"{self.notation}_{number}_{kind.replace(' ', '_')}{extension}"
            (keep / name).write_text(f"// {what} on {shapes}\n{text}")

    def summary(self):
        total = sum(self.counts.values())
        said = ", ".join(f"{count} {kind}" for kind, count in sorted(self.counts.items()))
        refused = ", ".join(f"{code} {count}" for code, count in sorted(self.refusals.items(), key=lambda r: -r[1])[:6])
        print(f"{self.notation}: {total} programs: {said}" + (f"; refused for {refused}" if refused else ""))
        derived = total - self.counts.get("refused", 0)
        if total >= 50 and derived < LEAST_DERIVED * total:
            print(f"{self.notation}: too few programs derive; the generator does not know the language any more")
            return False
        never = [name for name, count in self.subjects.items() if count == 0]
        if never and total >= OFTEN * len(self.subjects):
            names = ", ".join(never)
            print(f"{self.notation}: no program with {names} derives")
            return False
        return not self.failures


def prepared(folder):
    """A project folder with the assets that programs name."""
    for name in ("shapes.geojson", "house.obj", "solid.obj"):
        shutil.copy(HERE / "programs" / name, folder)
    (folder / "tex.png").write_bytes(png())
    # The built-in textures, which stand in where there is no such folder, take long to write.
    (folder / "textures").mkdir()
    for name in ("a", "b", "c"):
        (folder / "textures" / f"{name}.png").write_bytes(png())


def png():
    """A picture of one pixel."""
    def chunk(name, content):
        return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))
    head = struct.pack(">IIBBBBB", 1, 1, 8, 2, 0, 0, 0)
    pixels = zlib.compress(b"\x00\xc0\x80\x40")
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", pixels) + chunk(b"IEND", b"")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build")
    parser.add_argument("--notation", choices=sorted(NOTATIONS), action="append")
    parser.add_argument("--count", type=int, default=500)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=0, help="stop after that time")
    parser.add_argument("--keep")
    parser.add_argument("--show", type=int)
    options = parser.parse_args()
    listed = subprocess.run([Path(options.build).resolve() / "gable", "ops", "--json"], capture_output=True, check=True)
    options.catalogue = json.loads(listed.stdout)
    begin = time.monotonic()
    right = True
    with tempfile.TemporaryDirectory(prefix="programs.") as folder:
        prepared(Path(folder))
        for notation in options.notation or sorted(NOTATIONS):
            session = Session(options, notation, folder)
            if options.show is not None:
                tree, shapes, *_ = session.made(options.show)
                print(f"{tree.text()}// on {shapes}")
                continue
            for number in range(options.first, options.first + options.count):
                session.run(number)
                if options.seconds and time.monotonic() - begin > options.seconds:
                    break
            session.runner.stop()
            right = session.summary() and right
    return 0 if right else 1


if __name__ == "__main__":
    sys.exit(main())
