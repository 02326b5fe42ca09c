#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Writes a large project of rules: tools/large_rules.py FOLDER [--lines 5000] [--imports 40] [--seed 1].

FOLDER/rules/main.cga has the given number of lines and imports FOLDER/rules/part_NN.cga, each of some 120
lines; the last ones import each other. The rules are of the kind that people write: attributes with
annotations, functions, splits, components, choices by case and chance. The same options give the same bytes.
"""
import argparse
import random
import sys
from pathlib import Path

COLORS = ("#c8646c", "#e0a458", "#7fa8c9", "#88a36f", "#d9cfc1")
PART_LINES = 120


class Writer:
    """One rule file that grows declaration by declaration."""

    def __init__(self, chance, imports, prefix):
        self.chance = chance
        self.imports = imports     # names of the imports
        self.prefix = prefix
        self.attributes = []
        self.functions = []
        self.rules = []
        self.lines = []

    def number(self):
        return f"{self.chance.uniform(0.2, 12):.2f}"

    def value(self):
        kinds = [self.number, self.number]
        if self.attributes:
            kinds += [lambda: self.chance.choice(self.attributes),
                      lambda: f"{self.chance.choice(self.attributes)} * {self.number()}",
                      lambda: f"max({self.chance.choice(self.attributes)}, scope.sx / 4)"]
        if self.functions:
            kinds.append(lambda: f"{self.chance.choice(self.functions)}({self.number()}, scope.sy)")
        if self.imports:
            kinds.append(lambda: f"{self.chance.choice(self.imports)}.{self.prefix}Height")
        return self.chance.choice(kinds)()

    def successor(self):
        kinds = [lambda: f'color("{self.chance.choice(COLORS)}") Wall.', lambda: "NIL",
                 lambda: f"t(0, {self.value()}, 0) s('1, {self.value()}, '1) Block."]
        if self.rules:
            kinds += [lambda: self.chance.choice(self.rules)] * 3
        if self.imports:
            kinds.append(lambda: f"{self.chance.choice(self.imports)}.{self.prefix}Detail({self.value()})")
        return self.chance.choice(kinds)()

    def attribute(self):
        name = f"{self.prefix}Size{len(self.attributes)}"
        self.lines += [f"@Group(\"Sizes\") @Range(min=0, max={self.chance.randint(5, 40)})",
                       f"attr {name} = {self.number()}  // metres"]
        self.attributes.append(name)

    def function(self):
        name = f"{self.prefix}share{len(self.functions)}"
        self.lines.append(f"{name}(width, height) = case width > {self.number()} : width / 2 else : "
                          f"height * {self.value()}")
        self.functions.append(name)

    def rule(self):
        name = f"{self.prefix}Part{len(self.rules)}"
        kind = self.chance.randrange(5)
        if kind == 0:
            self.lines += [f"{name} -->", f"  split(y) {{ {self.value()} : {self.successor()}",
                           f"           | {{ ~{self.value()} : {self.successor()} }}*",
                           f"           | '0.1 : {self.successor()} }}"]
        elif kind == 1:
            self.lines += [f"{name} --> extrude(world.up, {self.value()})",
                           f"  comp(f) {{ side : {self.successor()} | top : {self.successor()} }}"]
        elif kind == 2:
            self.lines += [f"{name} -->", f"  30% : {self.successor()}", f"  45% : {self.successor()}",
                           f"  else : {self.successor()}"]
        elif kind == 3:
            self.lines += [f"{name} -->", f"  case scope.sy > {self.value()} :",
                           f"    set({self.chance.choice(self.attributes)}, {self.value()})",
                           f"    [ offset(-{self.number()}) {self.successor()} ] {self.successor()}",
                           f"  else : {self.successor()}"]
        else:
            self.lines.append(f"{name} --> setback({self.number()}) {{ front : {self.successor()} "
                              f"| remainder : {self.successor()} }}")
        self.lines.append("")
        self.rules.append(name)

    def fill(self, count):
        for _ in range(4):
            self.attribute()
        self.function()
        while len(self.lines) < count - 1:
            roll = self.chance.random()
            (self.attribute if roll < 0.06 else self.function if roll < 0.1 else self.rule)()
        self.lines = self.lines[:count] if count < PART_LINES else self.lines
        return "\n".join(self.lines) + "\n"


def part(chance, prefix, imports):
    """A file that others import: it offers <prefix>Height and <prefix>Detail."""
    writer = Writer(chance, [], prefix)
    head = "".join(f'import {name} : "rules/{file}"\n' for name, file in imports)
    writer.lines += [f"attr {prefix}Height = {writer.number()}",
                     f"{prefix}Detail(depth) --> extrude(depth) color(\"{chance.choice(COLORS)}\") Piece.", ""]
    return head + writer.fill(PART_LINES)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=Path)
    parser.add_argument("--lines", type=int, default=5000)
    parser.add_argument("--imports", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    chance = random.Random(options.seed)
    folder = options.folder / "rules"
    folder.mkdir(parents=True, exist_ok=True)
    names = [f"p{i}" for i in range(options.imports)]
    for i in range(options.imports):
        deeper = [("below", f"part_{i + 1:02}.cga")] if i % 4 == 0 and i + 1 < options.imports else []
        (folder / f"part_{i:02}.cga").write_text(part(chance, "x", deeper), encoding="utf-8")
    head = "".join(f'import {name} : "rules/part_{i:02}.cga"\n' for i, name in enumerate(names))
    writer = Writer(chance, names, "x")
    writer.lines += ["", "@StartRule", "Lot --> extrude(9) comp(f) { side : xPart0 | top : xPart1 }", ""]
    text = head + writer.fill(options.lines - options.imports)
    (folder / "main.cga").write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
