#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""How far pictures of few paths are from one of many: tools/noise.py GABLE [--size 128x72] [--paths 24,400] ARGUMENT...

The arguments are those of `gable render` without -o. The picture of 4096 paths without smoothing is drawn first
(--reference says of how many), then those of --paths with smoothing and without. A line each: the root of the mean
square error in levels of 255, and SSIM (Wang et al. 2004) of luminance, in windows of 8 x 8. The exposure is fixed.
"""
import argparse
import subprocess
import tempfile
from pathlib import Path

import shrink_png


def error(rows, reference):
    """Root of the mean square over pixels and channels."""
    squares = [(a - b) ** 2 for line, other in zip(rows, reference) for p, q in zip(line, other) for a, b in zip(p, q)]
    return (sum(squares) / len(squares)) ** 0.5


def window_similarity(a, b):
    n = len(a)
    mean_a, mean_b = sum(a) / n, sum(b) / n
    var_a, var_b = sum(x * x for x in a) / n - mean_a ** 2, sum(y * y for y in b) / n - mean_b ** 2
    both = sum(x * y for x, y in zip(a, b)) / n - mean_a * mean_b
    c1, c2 = (0.01 * 255) ** 2, (0.03 * 255) ** 2
    return (2 * mean_a * mean_b + c1) * (2 * both + c2) / ((mean_a ** 2 + mean_b ** 2 + c1) * (var_a + var_b + c2))


def similarity(rows, reference, side=8):
    """The mean SSIM of windows that overlap by half."""
    grey = [[[0.2126 * r + 0.7152 * g + 0.0722 * b for r, g, b in line] for line in picture]
            for picture in (rows, reference)]
    side = min(side, len(rows), len(rows[0]))
    step, found = max(1, side // 2), []
    for y in range(0, len(rows) - side + 1, step):
        for x in range(0, len(rows[0]) - side + 1, step):
            found.append(window_similarity(*([v for line in g[y:y + side] for v in line[x:x + side]] for g in grey)))
    return sum(found) / len(found)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("gable")
    parser.add_argument("--size", default="128x72")
    parser.add_argument("--paths", default="24,400")
    parser.add_argument("--reference", type=int, default=4096)
    options, arguments = parser.parse_known_args()
    with tempfile.TemporaryDirectory() as folder:
        def drawn(paths, *more):
            path = Path(folder) / "a.png"
            subprocess.run([options.gable, "render", *arguments, "--size", options.size, "--exposure", "0",
                            "--samples", str(paths), *more, "-o", path], check=True, stdout=subprocess.DEVNULL)
            return shrink_png.read(path)[2]

        reference = drawn(options.reference, "--no-denoise")
        for paths in map(int, options.paths.split(",")):
            for name, more in (("smoothed", ()), ("as traced", ("--no-denoise",))):
                rows = drawn(paths, *more)
                print(f"{paths:5} paths, {name:9}: error {error(rows, reference):5.2f}, "
                      f"SSIM {similarity(rows, reference):.4f}", flush=True)


if __name__ == "__main__":
    main()
