#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Makes the models of examples/temple: a fluted shaft with entasis, a Corinthian and an Ionic capital.

make_columns.py [FOLDER]. The shaft and the capitals fill a box of one metre; rules give them their proportions.
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

    def turned(self, profile, sides, radius=lambda angle, r: r):
        """A body of revolution about y: rows of (radius, height) from below."""
        for (r0, y0), (r1, y1) in zip(profile, profile[1:]):
            for i in range(sides):
                a, b = (2 * math.pi * (i + k) / sides for k in (0, 1))
                def at(t, r, y):
                    r = radius(t, r)
                    return (r * math.sin(t), y, r * math.cos(t))
                self.face(at(a, r0, y0), at(b, r0, y0), at(b, r1, y1), at(a, r1, y1))

    def write(self, path):
        lines = ["# SPDX-License-Identifier: Apache-2.0", "# Made by make_columns.py."]
        lines += [f"v {x:g} {y:g} {z:g}" for x, y, z in self.points]
        lines += ["f " + " ".join(map(str, face)) for face in self.faces]
        path.write_text("\n".join(lines) + "\n")


def shaft(path, flutes=20, levels=8):
    """As thick below as the box; a seventh thinner above, on a curve that leaves the vertical slowly."""
    model = Model()

    def fluted(angle, r):
        step = angle * flutes / (2 * math.pi)
        return r * (1 - 0.075 * abs(math.sin(math.pi * step)))

    profile = [(0.5 * (1 - 0.14 * (i / levels) ** 1.8), i / levels) for i in range(levels + 1)]
    model.turned(profile, flutes * 4, fluted)
    model.write(path)


def abacus(model, low, high, reach, hollow):
    """A plate with hollow sides and cut corners."""
    ring = []
    for side in range(4):
        for i in range(9):
            u = -0.92 + 1.84 * i / 8
            x, z = u * reach, reach * (1 - hollow * (1 - u * u))
            turn = side * math.pi / 2
            ring.append((x * math.cos(turn) + z * math.sin(turn), z * math.cos(turn) - x * math.sin(turn)))
    for (x0, z0), (x1, z1) in zip(ring, ring[1:] + ring[:1]):
        model.face((x0, low, z0), (x1, low, z1), (x1, high, z1), (x0, high, z0))
        model.face((0, low, 0), (x1, low, z1), (x0, low, z0))
        model.face((0, high, 0), (x0, high, z0), (x1, high, z1))


def leaf(model, angle, foot, tip, width, r0, curl):
    """A leaf before the bell that bends outward at its tip."""
    rows = []
    for i in range(7):
        t = i / 6
        r = r0 + 0.02 + curl * t ** 3.2
        y = foot + (tip - foot) * (t if t < 0.84 else 0.84 - 0.5 * (t - 0.84))
        w = width * (1 - 0.25 * t) * (1 if i < 6 else 0.35)
        rows.append((r, y, w))
    for (r0_, y0, w0), (r1, y1, w1) in zip(rows, rows[1:]):
        for s in (-1, 1):
            def at(r, y, across):
                x, z = across, r - 0.03 * abs(across) / width
                return (x * math.cos(angle) + z * math.sin(angle), y, z * math.cos(angle) - x * math.sin(angle))
            corners = [at(r0_ + 0.015, y0, 0), at(r0_, y0, s * w0), at(r1, y1, s * w1), at(r1 + 0.015, y1, 0)]
            model.face(*(corners if s > 0 else corners[::-1]))


def corinthian(path):
    """A bell between two rows of eight leaves and four volutes under a hollow abacus."""
    model = Model()
    model.turned([(0.31, 0), (0.31, 0.5), (0.34, 0.75), (0.41, 0.87)], 24)
    for i in range(8):
        leaf(model, 2 * math.pi * (i + 0.5) / 8, 0, 0.42, 0.12, 0.31, 0.1)
        leaf(model, 2 * math.pi * i / 8, 0.05, 0.72, 0.12, 0.315, 0.12)
    for i in range(4):
        leaf(model, math.pi * (2 * i + 1) / 4, 0.45, 1.0, 0.06, 0.33, 0.26)
    abacus(model, 0.87, 1.0, 0.5, 0.16)
    model.write(path)


def ionic(path):
    """An echinus, four volutes as drums, and a flat abacus."""
    model = Model()
    model.turned([(0.36, 0), (0.4, 0.3), (0.44, 0.55), (0.44, 0.75)], 24)
    for sx in (-1, 1):
        for sz in (-1, 1):
            for r, z0, z1 in ((0.17, 0.3, 0.44), (0.1, 0.44, 0.47), (0.045, 0.47, 0.5)):
                ring = [(0.33 * sx + r * math.cos(t), 0.5 + 1.9 * r * math.sin(t)) for t in
                        (2 * math.pi * i / 16 for i in range(16))]
                for (x0, y0), (x1, y1) in zip(ring, ring[1:] + ring[:1]):
                    side = [(x0, y0, sz * z0), (x1, y1, sz * z0), (x1, y1, sz * z1), (x0, y0, sz * z1)]
                    cap = [(x0, y0, sz * z1), (x1, y1, sz * z1), (0.33 * sx, 0.5, sz * z1)]
                    model.face(*(side if sz < 0 else side[::-1]))
                    model.face(*(cap if sz > 0 else cap[::-1]))
        # The bolsters that join the volutes of one side.
        ring = [(0.33 * sx + 0.13 * math.cos(t), 0.5 + 0.25 * math.sin(t)) for t in (2 * math.pi * i / 16 for i in range(16))]
        for (x0, y0), (x1, y1) in zip(ring, ring[1:] + ring[:1]):
            model.face((x0, y0, -0.3), (x0, y0, 0.3), (x1, y1, 0.3), (x1, y1, -0.3))
    abacus(model, 0.82, 1.0, 0.47, 0)
    model.write(path)


def main():
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent)
    shaft(folder / "shaft.obj")
    corinthian(folder / "corinthian.obj")
    ionic(folder / "ionic.obj")


if __name__ == "__main__":
    main()
