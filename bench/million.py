#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Tiles of a made-up land: million.py GABLE FOLDER [--plain] [--runs N] COUNT...

Writes, for each count, a map of so many buildings (GeoJSON, and FlatGeobuf where GDAL is installed), makes compressed
tiles of it with bench/million.cga, in one thread, as a plan, its jobs and their merge, and prints for each step what a building takes of a
core (user time) and the memory at the peak. The first count is made N times (3), between the others too, and the median taken. At the end
it says how far the times of the other counts are from those of the first, and fails where one is more than 10 % above
it, or where a process took 2 GiB. What was stopped goes on, and is then left out of the comparison.

A million take about a quarter of an hour of a core and 4 GB in FOLDER: million.py build/release/gable /tmp/land 10000 100000 1000000

The buildings stand in villages, so that the land is as uneven as a real one; each is a rectangle with storeys and a
turn that depend on its number alone.
"""
import argparse
import json
import math
import os
import shutil
import statistics
import subprocess
import sys
import time
from pathlib import Path

# Buildings of a village, and metres from one village to the next.
VILLAGE, APART = 400, 900
METRE = 1 / 111_320


def mixed(n):
    """A number that looks random, by its place (SplitMix64)."""
    n = (n + 1) * 0x9E3779B97F4A7C15 % 2**64
    n = (n ^ n >> 30) * 0xBF58476D1CE4E5B9 % 2**64
    n = (n ^ n >> 27) * 0x94D049BB133111EB % 2**64
    return n ^ n >> 31


def building(n, count):
    village, house = divmod(n, VILLAGE)
    side = math.ceil(math.sqrt(math.ceil(count / VILLAGE)))
    chance = mixed(n)
    row = math.ceil(math.sqrt(VILLAGE))
    x = village % side * APART + house % row * 30 + chance % 7
    y = village // side * APART + house // row * 30 + chance // 7 % 7
    angle = chance // 64 % 90 * math.pi / 180
    wide, deep = 8 + chance // 4096 % 7, 8 + chance // 32768 % 5
    corners = [(0, 0), (wide, 0), (wide, deep), (0, deep), (0, 0)]
    c, s = math.cos(angle), math.sin(angle)
    ring = [[round(8 + (x + c * a - s * b) * METRE / 0.6, 9), round(50 + (y + s * a + c * b) * METRE, 9)] for a, b in corners]
    return {"type": "Feature", "properties": {"id": n, "levels": 1 + chance // 2**20 % 5},
            "geometry": {"type": "Polygon", "coordinates": [ring]}}


def write_map(path, count):
    with path.open("w") as out:
        out.write('{"type":"FeatureCollection","features":[\n')
        for n in range(count):
            out.write(json.dumps(building(n, count), separators=(",", ":")) + (",\n" if n + 1 < count else "\n"))
        out.write("]}\n")


def source_of(folder, count):
    """The map of a count, made where it is not there."""
    geojson, flat = folder / f"{count}.geojson", folder / f"{count}.fgb"
    if not flat.exists() and not geojson.exists():
        write_map(geojson, count)
        if shutil.which("ogr2ogr"):
            made = folder / f"{count}.made.fgb"
            subprocess.run(["ogr2ogr", "-f", "FlatGeobuf", made, geojson], check=True)
            made.rename(flat)
            geojson.unlink()
    return flat if flat.exists() else geojson


def used(*command):
    """User seconds of a command with its children, and its memory at the peak in bytes."""
    child = subprocess.Popen([str(c) for c in command], stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode:
        sys.exit(f"{command} ends with {child.returncode}")
    return usage.ru_utime, usage.ru_maxrss * 1024


def made(gable, folder, count, plain):
    """One run: user seconds a building by step, memory at the peak by step, and whether all of it was made now."""
    rules = Path(__file__).resolve().parent / "million.cga"
    tiles, stats = folder / str(count), folder / "stats.json"
    if not (tiles / "plan/plan.json").exists():
        shutil.rmtree(tiles, ignore_errors=True)
    begin = time.monotonic()
    steps = {"plan": used(gable, "tiles", "plan", rules, "--shapes", source_of(folder, count), "-o", tiles,
                          *([] if plain else ["--compress"]))}
    jobs = json.loads((tiles / "plan/plan.json").read_text())["jobs"]
    steps["jobs"] = used(gable, "tiles", "job", tiles, f"0-{jobs - 1}", "--threads", "1", "--stats", stats)
    whole = json.loads(stats.read_text()).get("shapesBefore", 0) == 0
    steps["merge"] = used(gable, "tiles", "merge", tiles, "--threads", "1", "--stats", stats)
    seconds, told = time.monotonic() - begin, json.loads(stats.read_text())
    micro = {step: user / count * 1e6 for step, (user, _) in steps.items()}
    print(f"{count:9} buildings in {jobs} jobs: {seconds:6.1f} s; microseconds of a core a building: "
          + ", ".join(f"{step} {v:.1f}" for step, v in micro.items()) + f", all {sum(micro.values()):.1f}; MiB at the peak: "
          + ", ".join(f"{step} {peak / 2**20:.0f}" for step, (_, peak) in steps.items())
          + f"; {told['tiles']} tiles, {told['triangles'] / 1e6:.1f} M triangles, {told['bytes'] / 2**20:.0f} MiB"
          + ("" if whole else "; goes on from an earlier run"), flush=True)
    return micro, max(peak for _, peak in steps.values()), whole


def main(arguments):
    arguments.folder.mkdir(parents=True, exist_ok=True)
    first, *others = arguments.counts
    runs = {count: [] for count in arguments.counts}
    peak = 0
    # The first between the others, as machines change their pace.
    order = [first] + [c for other in others for c in (other, first)]
    order += [first] * (arguments.runs - order.count(first))
    for count in order:
        micro, memory, whole = made(arguments.gable, arguments.folder, count, arguments.plain)
        peak = max(peak, memory)
        if whole:
            runs[count].append(micro)
    rate = {count: {step: statistics.median(r[step] for r in of) for step in of[0]} for count, of in runs.items() if of}
    worst = 0
    for count in others:
        if count not in rate or first not in rate:
            print(f"{count:9}: not made as a whole, so there is no rate")
            continue
        here, there = rate[count], rate[first]
        change = sum(here.values()) / sum(there.values()) - 1
        worst = max(worst, change)
        print(f"{count:9} against {first}: {change:+.1%} ("
              + ", ".join(f"{step} {here[step] / there[step] - 1:+.1%}" for step in here) + ")")
    print(f"memory at the peak {peak / 2**20:.0f} MiB")
    return 1 if worst > 0.10 or peak >= 2 * 2**30 else 0


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("gable")
    parser.add_argument("folder", type=Path)
    parser.add_argument("counts", type=int, nargs="+")
    parser.add_argument("--plain", action="store_true", help="tiles without compression")
    parser.add_argument("--runs", type=int, default=3, help="of the first count (3)")
    sys.exit(main(parser.parse_args()))
