#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""A street by a rule file of 4900 lines with 700 cases: street.py GABLE [RUNS].

Writes rules of the kind that street libraries have: attributes with annotations, functions that choose by long lists of
cases, lanes and kerbs by splits along the texture, and furniture that is placed along them. Derives them on a street of
24 pieces of 80 x 20 metres with texture coordinates and writes a GLB. Prints lines, cases and counts, and the seconds of
the whole command for each run. Run from the repository's root.
"""
import json
import random
import sys
import tempfile
from pathlib import Path

from command_times import seconds_of, told

LINES, CASES, PIECES, LENGTH, WIDTH = 4900, 700, 24, 80, 20
KINDS = ("Lamp", "Bench", "Bin", "Sign", "Meter", "Hydrant", "Bollard", "Planter", "Tree", "Rack")
HEAD = """version "2024.0"
@Group("Street", 1) @Range(min=2, max=4) attr laneWidth = 3.2
@Group("Street", 1) @Range(min=1, max=6) attr sidewalk = 3.5
@Group("Street", 1) @Enum("quiet", "busy", "market") attr use = "market"
attr kind = 0
const markWidth = 0.15

@StartRule
Street --> split(v, unitSpace, 0) {
    sidewalk : set(kind, 1) Sidewalk
  | ~1 : Roadway
  | sidewalk : set(kind, 2) Sidewalk }
Roadway --> split(v, unitSpace, 0) { ~laneWidth : Lane }*
Lane --> split(u, unitSpace, 0) { ~4 : color(paint(split.index)) Asphalt. | markWidth : color("#eeeeee") Mark. }*
Sidewalk --> split(v, unitSpace, 0) { 0.3 : Kerb | ~1 : Paving }
Kerb --> split(u, unitSpace, 0) { ~1 : extrude(world.up, 0.15) color("#9a9a94") Stone. }*
Paving --> split(u, unitSpace, 0) { ~1.6 : Slab(split.index) }*
Slab(i) --> [ color(paint(i)) Slab. ] [ case i % 4 == 0 : Furniture(i + kind * 31) else : NIL ]
"""


def rules():
    """The text of the rule file."""
    chance = random.Random(4)
    lines = HEAD.splitlines()
    cases = 1
    # A colour for each number, as tables of colours are written in CGA.
    lines.append("paint(i) = paintOf(i % 60)")
    lines.append("paintOf(i) =")
    for i in range(60):
        lines.append(f'  case i == {i} : "#{chance.randrange(0x505050, 0xa0a0a0):06x}"')
        cases += 1
    lines.append('  else : "#808080"')
    # What stands on each slab, by its number and by the use of the street.
    stands = (CASES - cases) // 3
    lines.append(f"Furniture(i) --> FurnitureOf(i % {stands})")
    lines.append("FurnitureOf(i) -->")
    for i in range(stands):
        lines += [f"  case i == {i} :", f"    s(0, 0, 0) alignScopeToAxes(y) Piece{i}"]
        cases += 1
    lines.append("  else : NIL")
    for i in range(stands):
        kind = KINDS[i % len(KINDS)]
        height, width = chance.uniform(0.6, 5), chance.uniform(0.2, 0.9)
        lines += [f"# {kind} {i}", f'@Hidden attr height{i} = {height:.2f}', f"size{i}(a) = a * {width:.2f}",
                  f"Piece{i} -->", f'  case use == "quiet" : {kind}{i}(1)', f'  case use == "busy" && scope.elevation < 50 : {kind}{i}(2)',
                  f"  else : {kind}{i}(3)", f"{kind}{i}(n) -->",
                  f"  primitiveCube(size{i}(1), height{i}, size{i}(1))", "  split(y) {", f"      {height / 4:.2f} : Foot{i}",
                  f"    | ~1 : Shaft{i}(n)", f"    | {height / 5:.2f} : Top{i} }}",
                  f'Foot{i} --> color(paint({i})) Foot.',
                  f"Shaft{i}(n) --> split(y) {{ ~{height / 6:.2f} : color(paint({i} + split.index)) Shaft. }}*",
                  f"Top{i} --> s('1.2, '1, '1.2) center(xz) color(paint({i * 7 % 60})) Top."]
        cases += 2
    while cases < CASES:
        lines += [f"spare{cases}(a) =", f"  case a > {cases} : a * 2", "  else : a"]
        cases += 1
    while len(lines) < LINES:
        lines.append(f"// {len(lines) + 1}: street furniture is numbered along the kerb, from the first slab to the last")
    return lines, cases


def street(path):
    """Pieces of a straight street that rises a little, with texture coordinates along and across."""
    text = []
    for i in range(PIECES):
        x, y = i * LENGTH, 0.2 * i
        text.append(f"o street{i}")
        for u, v in ((0, 0), (1, 0), (1, 1), (0, 1)):
            text += [f"v {x + u * LENGTH:g} {y + 0.2 * u:g} {-v * WIDTH:g}", f"vt {u} {v}"]
        text.append("f " + " ".join(f"{4 * i + k}/{4 * i + k}" for k in range(1, 5)))
    path.write_text("\n".join(text) + "\n", encoding="utf-8")


def main():
    gable, runs = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 5
    lines, cases = rules()
    with tempfile.TemporaryDirectory() as folder:
        rule, lots, model, stats = (Path(folder) / n for n in ("street.cga", "street.obj", "street.glb", "stats.json"))
        rule.write_text("\n".join(lines) + "\n", encoding="utf-8")
        street(lots)
        seconds = seconds_of([gable, "generate", rule, "--shapes", lots, "--jobs", "2", "-o", model, "--stats", stats], runs)
        counts = json.loads(stats.read_text(encoding="utf-8"))
        print(f"{len(lines)} lines, {cases} cases; {PIECES} pieces of street, {counts['leaves']} leaves, "
              f"{counts['triangles']} triangles, {model.stat().st_size / 1e6:.1f} MB")
    print(told(seconds))


if __name__ == "__main__":
    main()
