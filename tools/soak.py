#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Random examples at full load for an hour: tools/soak.py GABLE [NAME...] [--minutes N].

Starts `gable studio` on a copy of the examples, so that one process does all and what leaks shows. As many pages as there
are processors ask for random examples with one of a few seeds, break off some requests half-way, and write some models as
GLB. Each example with a seed must always give the bytes that it gave first, whatever was derived before it and is
taken over from there. Prints memory each minute, and ends with 1 where an answer differs or fails, the process dies, or
its memory grows: where the median of the last third is more than a quarter and 128 MiB above that of the middle third,
or one moment is above `--memory`. Status 77: the studio's page is not built.
"""
import argparse
import hashlib
import http.client
import json
import os
import random
import shutil
import statistics
import struct
import subprocess
import sys
import tempfile
import threading
import time
import urllib.parse
from pathlib import Path

import example_commands
from example_commands import ROOT

SEEDS = 3
BROKEN_OFF, EXPORTED = 0.2, 0.1
# What may differ between two answers with the same model.
TIMES = ("derivation", "seconds", "recalled")


class Studio:
    def __init__(self, gable, folder):
        self.process = subprocess.Popen([gable, "studio", folder, "--port", "0"], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                        text=True)
        line = self.process.stdout.readline().strip()
        if not line:
            raise RuntimeError(self.process.stderr.read().strip())
        address = urllib.parse.urlparse(line)
        self.port, self.token = address.port, urllib.parse.parse_qs(address.query)["token"][0]

    def stop(self):
        self.process.terminate()
        return self.process.wait()

    def memory(self):
        """Resident bytes."""
        return int(Path(f"/proc/{self.process.pid}/statm").read_text(encoding="ascii").split()[1]) * os.sysconf("SC_PAGE_SIZE")

    def ask(self, method, path, body=None, patience=None):
        """Status and bytes; None where the patience ended first."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=patience or 900)
        try:
            connection.request(method, path, body, {"X-Gable-Token": self.token})
            answer = connection.getresponse()
            return answer.status, answer.read()
        except TimeoutError:
            if patience is None:
                raise
            return None
        finally:
            connection.close()


def requests(names):
    """What a page asks for to see each example."""
    out = []
    for name in names:
        arguments = example_commands.said('derive_arguments "$1"', name)
        if not arguments:
            continue
        rules = Path(arguments[0]).relative_to("examples")
        shapes = {"lot": [20, 20]}
        for option, value in zip(arguments, arguments[1:]):
            if option == "--lot":
                shapes = {"lot": [float(v) for v in value.split("x")]}
            elif option == "--shapes":
                shapes = {"file": str(Path(value).relative_to("examples"))}
        text = (ROOT / "examples" / rules).read_text(encoding="utf-8")
        out.append((name, {"file": str(rules), "text": text, "overlay": {}, "start": "", "attributes": {}, "shapes": shapes,
                           "limits": {"seconds": 600, "shapes": 50e6}}))
    return out


def plain(value):
    """A JSON value without what may differ."""
    if isinstance(value, dict):
        return {key: plain(v) for key, v in value.items() if key not in TIMES}
    return [plain(v) for v in value] if isinstance(value, list) else value


class Soak:
    def __init__(self, studio, scenes, end, seed):
        self.studio, self.scenes, self.end, self.seed = studio, scenes, end, seed
        self.lock = threading.Lock()
        self.known, self.faults = {}, []
        self.done = self.broken = 0

    def compare(self, what, content):
        digest = hashlib.sha256(content).hexdigest()
        with self.lock:
            if self.known.setdefault(what, digest) != digest:
                self.faults.append(f"{what}: other bytes than before")

    def one(self, chance, page):
        name, request = chance.choice(self.scenes)
        seed = chance.randrange(SEEDS)
        body = json.dumps(request | {"seed": seed, "page": page})
        patience = chance.uniform(0.05, 2) if chance.random() < BROKEN_OFF else None
        answer = self.studio.ask("POST", "/api/derive", body, patience)
        if answer is None:
            with self.lock:
                self.broken += 1
            return
        status, content = answer
        if status != 200:
            raise RuntimeError(f"{name}, seed {seed}: the studio answered {status}: {content[:200]!r}")
        length, = struct.unpack_from("<I", content, 4)
        head = json.loads(content[8:8 + length])
        if head["end"] != "done":
            raise RuntimeError(f"{name}, seed {seed}: ended '{head['end']}'")
        self.compare(f"{name}, seed {seed}", json.dumps(plain(head)).encode() + content[8 + length:])
        if chance.random() < EXPORTED:
            status, model = self.studio.ask("GET", f"/api/export?derivation={head['derivation']}&format=glb&page={page}")
            # Other pages may have pushed the derivation out.
            if status == 200:
                self.compare(f"{name}, seed {seed}, GLB", model)
        with self.lock:
            self.done += 1

    def work(self, number):
        chance = random.Random(f"{self.seed} {number}")
        while time.monotonic() < self.end and not self.faults:
            try:
                self.one(chance, f"soak-{number}")
            except (RuntimeError, OSError, http.client.HTTPException) as fault:
                with self.lock:
                    self.faults.append(str(fault) or repr(fault))

    def run(self, pages):
        """Resident bytes, as often as they were looked at."""
        threads = [threading.Thread(target=self.work, args=(n,)) for n in range(pages)]
        for thread in threads:
            thread.start()
        memory, told = [], time.monotonic()
        while any(thread.is_alive() for thread in threads):
            time.sleep(0.2)
            if self.studio.process.poll() is not None:
                self.faults.append(f"the studio ended with {self.studio.process.returncode}")
                break
            memory.append(self.studio.memory())
            if time.monotonic() - told >= 60:
                told += 60
                print(f"{self.done} models, {self.broken} broken off, {len(self.known)} compared; "
                      f"{memory[-1] / 2**20:.0f} MiB, at most {max(memory) / 2**20:.0f}", flush=True)
        for thread in threads:
            thread.join()
        return memory


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("gable", type=Path)
    parser.add_argument("names", nargs="*", metavar="NAME", help="examples; without, all that have rules")
    parser.add_argument("--minutes", type=float, default=60)
    parser.add_argument("--memory", type=float, default=8192, metavar="MIB", help="the most that it may take (default 8192)")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    scenes = requests(options.names or example_commands.names())
    if not scenes:
        parser.error("there is no such example; './run example' lists them")
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place) / "examples"
        shutil.copytree(ROOT / "examples", folder, ignore=shutil.ignore_patterns("*.png", "*.pbf"))
        try:
            studio = Studio(options.gable.resolve(), folder)
        except RuntimeError as why:
            print(f"skipped: {why}")
            return 77
        try:
            soak = Soak(studio, scenes, time.monotonic() + options.minutes * 60, options.seed)
            memory = soak.run(os.cpu_count() or 1)
        finally:
            studio.stop()
    third = len(memory) // 3
    middle, last = (statistics.median(part or [0]) for part in (memory[third:2 * third], memory[2 * third:]))
    if last > 1.25 * middle + 128 * 2**20:
        soak.faults.append(f"memory grows: {middle / 2**20:.0f} MiB in the middle third, {last / 2**20:.0f} in the last")
    if max(memory, default=0) > options.memory * 2**20:
        soak.faults.append(f"more than {options.memory:.0f} MiB")
    print(f"{soak.done} models, {soak.broken} broken off, {len(soak.known)} compared with themselves; medians of memory "
          f"{middle / 2**20:.0f} and {last / 2**20:.0f} MiB, at most {max(memory, default=0) / 2**20:.0f}")
    for fault in soak.faults:
        print(f"FAULT: {fault}")
    return 1 if soak.faults else 0


if __name__ == "__main__":
    sys.exit(main())
