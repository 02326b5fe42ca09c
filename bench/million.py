#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Tiles of a made-up land: million.py GABLE FOLDER COUNT...

Writes, for each count, a map of so many buildings (GeoJSON, and FlatGeobuf where GDAL is installed), makes tiles of
it with bench/million.cga, and prints time, rate and memory at the peak. On a busy machine the rate of a core counts. The buildings stand in villages, so that the
land is as uneven as a real one; each is a rectangle with storeys and a turn that depend on its number alone.
"""
import json
import math
import resource
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


def main(gable, folder, counts):
    folder.mkdir(parents=True, exist_ok=True)
    rules = Path(__file__).resolve().parent / "million.cga"
    for count in counts:
        geojson, flat = folder / f"{count}.geojson", folder / f"{count}.fgb"
        if not flat.exists() and not geojson.exists():
            write_map(geojson, count)
            if subprocess.run(["ogr2ogr", "-f", "FlatGeobuf", flat, geojson], check=False).returncode == 0:
                geojson.unlink()
        source = flat if flat.exists() else geojson
        begin, before = time.monotonic(), resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([gable, "tiles", rules, "--shapes", source, "-o", folder / str(count), "--stats", folder / "stats.json"],
                       check=True)
        seconds, after = time.monotonic() - begin, resource.getrusage(resource.RUSAGE_CHILDREN)
        busy = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        stats = json.loads((folder / "stats.json").read_text())
        spent = stats["seconds"]
        print(f"{count:9} buildings: {seconds:7.1f} s, {count / seconds:6.0f} a second, {count / busy:6.0f} a second of a core (plan {spent['parse']:.1f} s, "
              f"derive {spent['derive']:.1f} s, write {spent['write']:.1f} s), {stats['peakBytes'] / 2**20:5.0f} MiB, "
              f"{stats['tiles']} tiles, {stats['triangles'] / 1e6:.1f} M triangles, {stats['bytes'] / 2**20:.0f} MiB", flush=True)


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]), [int(c) for c in sys.argv[3:]])
