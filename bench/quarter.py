#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""655 buildings with about 300,000 triangles: quarter.py GABLE [RUNS].

Derives bench/quarter/quarter.cga on the 655 footprints of middle size of examples/monaco with two threads and writes a
GLB. Prints the counts, and the seconds of the whole command for each run: reading, deriving and writing. Run from the
repository's root.
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

from command_times import seconds_of, told

COUNT = 655


def area(feature):
    ring = feature["geometry"]["coordinates"]
    while isinstance(ring[0][0], list):
        ring = ring[0]
    return abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, ring[1:])))


def main():
    gable, runs = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 5
    data = json.loads(Path("examples/monaco/buildings.geojson").read_text(encoding="utf-8"))
    features = sorted(data["features"], key=area)
    skipped = (len(features) - COUNT) // 2
    data["features"] = features[skipped:skipped + COUNT]
    with tempfile.TemporaryDirectory() as folder:
        lots, model, stats = (Path(folder) / name for name in ("lots.geojson", "quarter.glb", "stats.json"))
        lots.write_text(json.dumps(data), encoding="utf-8")
        seconds = seconds_of([gable, "generate", "bench/quarter/quarter.cga", "--shapes", lots, "--cut-nested", "--jobs", "2",
                              "-o", model, "--stats", stats], runs, stderr=subprocess.DEVNULL)
        counts = json.loads(stats.read_text(encoding="utf-8"))
        print(f"{int(counts['reports']['buildings']['n'])} buildings, {counts['triangles']} triangles, "
              f"{counts['leaves']} leaves, {model.stat().st_size / 1e6:.1f} MB")
    print(told(seconds))


if __name__ == "__main__":
    main()
