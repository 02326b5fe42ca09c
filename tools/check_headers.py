#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Each header of src/ and include/ compiles alone: tools/check_headers.py BUILD [--compiler CXX].

A header that passed is not compiled again until its text, or the text of a header of ours that it
reaches, changes; BUILD/headers_alone.json remembers.
"""
import argparse
import hashlib
import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from checks.layers import INCLUDE, Layers
from checks.tree import Tree

ROOT = Path(__file__).resolve().parent.parent
FLAGS = ["-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", "-Isrc", "-Iinclude",
         # What test programs are given by the build (cmake/tests.cmake).
         '-DGABLE_SOURCE_DIR=""', '-DGABLE_WRITTEN_DIR=""']


class Headers:
    def __init__(self, tree):
        self.tree = tree
        self.layers = Layers(tree)
        self.own = {}  # header -> digest of its text, and the headers of ours it includes

    def read(self, path):
        if path not in self.own:
            text = self.tree.text(path)
            names = (m.group(1) or m.group(2) for m in INCLUDE.finditer(text))
            targets = [t for t in (self.layers.resolve(path, n) for n in names) if t]
            self.own[path] = (hashlib.sha256(text.encode("utf-8", "surrogateescape")).hexdigest(),
                              targets)
        return self.own[path]

    def digest(self, path):
        """Changes when the text of the header or of one that it reaches changes."""
        reached, open_ = set(), [path]
        while open_:
            here = open_.pop()
            if here not in reached:
                reached.add(here)
                open_ += self.read(here)[1]
        return hashlib.sha256("".join(self.read(p)[0] for p in sorted(reached)).encode()).hexdigest()


def compile_alone(compiler, path):
    # The header is included, not compiled as the main file, so that `#pragma once` says nothing.
    name = path.split("/", 1)[1]
    done = subprocess.run([compiler, *FLAGS, "-x", "c++", "-"], cwd=ROOT, text=True,
                          input=f'#include "{name}"\n', capture_output=True, check=False)
    return path, done.returncode == 0, done.stderr


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=Path)
    parser.add_argument("--compiler", default=os.environ.get("CXX", "g++"))
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    headers = Headers(Tree(ROOT))
    memory = options.build / "headers_alone.json"
    known = json.loads(memory.read_text()) if memory.exists() else {}
    paths = [p for p in headers.tree.files(".h") if p.startswith(("src/", "include/"))]
    digests = {p: headers.digest(p) + options.compiler for p in paths}
    todo = [p for p in paths if known.get(p) != digests[p]]
    failures = 0
    with ThreadPoolExecutor(options.jobs) as pool:
        for path, good, output in pool.map(lambda p: compile_alone(options.compiler, p), todo):
            if good:
                known[path] = digests[path]
            else:
                failures += 1
                print(f"{path} does not compile alone:\n{output}")
    memory.write_text(json.dumps({p: known[p] for p in paths if p in known}, indent=0))
    print(f"{len(paths)} headers, {len(todo)} compiled, {failures} failed")
    return 1 if failures or not paths else 0


if __name__ == "__main__":
    sys.exit(main())
