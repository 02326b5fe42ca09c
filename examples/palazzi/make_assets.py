#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Makes the models of examples/palazzi: an ogee arch with a trefoil in it, a quatrefoil, a gondola.

make_assets.py [FOLDER]. Each arch fills a box of one metre: x along the wall, y up, z out of it; rules stretch it.
"""
import math
import sys
from pathlib import Path


class Model:
    """Vertices and polygons of an OBJ file; equal vertices are one."""

    def __init__(self):
        self.points, self.faces = {}, []

    def face(self, *corners):
        self.faces.append([self.points.setdefault(tuple(round(v, 5) for v in p), len(self.points) + 1)
                           for p in corners])

    def write(self, path):
        lines = ["# SPDX-License-Identifier: Apache-2.0", "# Made by make_assets.py."]
        lines += [f"v {x:g} {y:g} {z:g}" for x, y, z in self.points]
        lines += ["f " + " ".join(map(str, face)) for face in self.faces]
        path.write_text("\n".join(lines) + "\n")


def ogee(u):
    """Height of an ogee arch, 0 to 1, at the share u of the way from its side to its point."""
    # Two arcs that meet at the point of inflection: the lower one bulges, the upper one is hollow.
    if u < 0.62:
        return 0.68 * math.sqrt(max(0.0, 1 - (1 - u / 0.62 * 0.8) ** 2)) / math.sqrt(1 - 0.2 ** 2)
    t = (u - 0.62) / 0.38
    return 0.68 + 0.32 * t ** 2.1


def trefoil(u):
    """Height of the opening under it: a small lobe, a cusp, and half of the middle lobe."""
    if u < 0.4:
        return 0.42 * math.sqrt(max(0.0, 1 - ((u - 0.2) / 0.2) ** 2)) * (1 - 0.1 * u)
    t = (u - 0.4) / 0.6
    return max(0.2 * (1 - t), 0.92 * ogee(0.35 + 0.65 * t) * min(1.0, 0.42 + 1.6 * math.sqrt(t)))


def arch(path, side=0.07, steps=36):
    """A plate over the springing line, the trefoil cut out of it, a moulding along the ogee, a flower on its point."""
    model = Model()
    xs = [0, side] + [side + (1 - 2 * side) * i / steps for i in range(1, steps)] + [1 - side, 1]

    def share(x):
        return max(0.0, min(1.0, 1 - abs(x - 0.5) / (0.5 - side)))

    low = [0.86 * trefoil(share(x)) if side < x < 1 - side else 0.0 for x in xs]
    for a, b, fa, fb in zip(xs, xs[1:], low, low[1:]):
        model.face((a, fa, 0.7), (b, fb, 0.7), (b, 1, 0.7), (a, 1, 0.7))
        if side <= a and b <= 1 - side:
            model.face((a, fa, 0), (b, fb, 0), (b, fb, 0.7), (a, fa, 0.7))
    ys = [0.86 * ogee(share(x)) if side < x < 1 - side else 0.0 for x in xs]
    out = [min(1.0, y + 0.075 + 0.03 * share(x)) for x, y in zip(xs, ys)]
    for a, b, fa, fb, ga, gb in zip(xs, xs[1:], ys, ys[1:], out, out[1:]):
        model.face((a, fa, 1), (b, fb, 1), (b, gb, 1), (a, ga, 1))
        model.face((a, ga, 1), (b, gb, 1), (b, gb, 0.7), (a, ga, 0.7))
        model.face((b, fb, 1), (a, fa, 1), (a, fa, 0.7), (b, fb, 0.7))
    model.write(path)


def quatrefoil(path, steps=48):
    """A square plate with four lobes cut out of it."""
    model = Model()

    def inner(t):
        x, y = abs(math.cos(t)), abs(math.sin(t))
        # Circles of radius 0.2 whose centres lie 0.2 from the middle.
        d, r = 0.2, 0.19
        c = max(x, y)
        rest = d * d * (c * c - 1) + r * r
        return d * c + math.sqrt(max(0.0, rest))

    def square(t):
        return 0.5 / max(abs(math.cos(t)), abs(math.sin(t)))

    ts = [2 * math.pi * i / steps for i in range(steps + 1)]
    for a, b in zip(ts, ts[1:]):
        def at(t, r, z):
            return (0.5 + r * math.cos(t), 0.5 + r * math.sin(t), z)
        model.face(at(a, inner(a), 1), at(a, square(a), 1), at(b, square(b), 1), at(b, inner(b), 1))
        model.face(at(b, inner(b), 0), at(b, inner(b), 1), at(a, inner(a), 1), at(a, inner(a), 0))
    model.write(path)


def gondola(path, steps=28):
    """Eleven metres from stern to bow along x, its ends raised; the origin lies on the water, amidships."""
    model = Model()

    def section(t):
        x = 5.5 * t
        half = 0.7 * max(0.0, 1 - abs(t) ** 2.4) + 0.03
        top = 0.42 + 1.05 * abs(t) ** 3.2
        keel = -0.15 + 1.25 * abs(t) ** 3.6
        return [(x, keel, 0), (x, (keel + top) / 2, 0.8 * half), (x, top, half)]

    cuts = [section(-1 + 2 * i / steps) for i in range(steps + 1)]
    for a, b in zip(cuts, cuts[1:]):
        for i in range(2):
            model.face(a[i], b[i], b[i + 1], a[i + 1])
            model.face(*[(x, y, -z) for x, y, z in (a[i + 1], b[i + 1], b[i], a[i])])
        # A deck at the ends, an open well amidships.
        drop = 0.0 if abs(a[0][0]) > 2.6 or abs(b[0][0]) > 2.6 else 0.32
        left = [(x, y - drop, z * (1 if drop == 0 else 0.85)) for x, y, z in (a[2], b[2])]
        right = [(x, y, -z) for x, y, z in left]
        model.face(left[0], left[1], right[1], right[0])
        if drop:
            model.face(a[2], b[2], left[1], left[0])
            model.face(right[0], right[1], (b[2][0], b[2][1], -b[2][2]), (a[2][0], a[2][1], -a[2][2]))
    # The iron at the bow: a blade with six teeth.
    for low, high, reach in [(0.2, 1.75, 0.12)] + [(0.5 + 0.16 * i, 0.6 + 0.16 * i, 0.34) for i in range(6)]:
        for z in (-0.015, 0.015):
            corners = [(5.45, low, z), (5.45 + reach, low, z), (5.45 + reach, high, z), (5.45, high, z)]
            model.face(*(corners if z > 0 else corners[::-1]))
    model.write(path)


def main():
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent)
    folder.mkdir(parents=True, exist_ok=True)
    arch(folder / "ogee.obj")
    quatrefoil(folder / "quatrefoil.obj")
    gondola(folder / "gondola.obj")


if __name__ == "__main__":
    main()
