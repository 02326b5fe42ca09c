#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Makes a PNG small enough for the repository: tools/shrink_png.py FROM TO [BYTES].

The picture gets a palette (median cut, Heckbert 1982, then k-means, Lloyd 1982): 256 colours, and where that leaves it larger than
BYTES (400000), fewer colours, then fewer pixels. A pattern hides the steps of a sky. Reads 8-bit RGB and RGBA without interlacing, which is what
Gable writes; alpha is dropped.
"""
import struct
import sys
import zlib
from pathlib import Path

SIGNATURE = b"\x89PNG\r\n\x1a\n"
LIMIT = 400_000
# Of k-means; more of them are not seen.
ROUNDS = 4
# Neighbours that differ by so few levels are a smooth place.
SMOOTH = 2
# By row and column, levels.
DITHER = [(-3, 1, -2, 2), (3, -1, 2, -1), (-2, 2, -3, 1), (2, 0, 3, -1)]
# Tried in this order: colours of the palette, and the share of the pixels along each side.
STEPS = [(256, 1.0), (192, 1.0), (128, 1.0), (256, 0.75), (128, 0.75), (128, 0.5), (64, 0.5)]


def chunks(data):
    at = len(SIGNATURE)
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        yield kind, data[at + 8:at + 8 + size]
        at += 12 + size


def unfilter(raw, width, height, channels):
    """The rows of a picture as bytes, filters undone (PNG specification, section 9)."""
    stride = width * channels
    previous, rows = bytearray(stride), []
    for y in range(height):
        kind = raw[y * (stride + 1)]
        row = bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        if kind == 1:
            for i in range(channels, stride):
                row[i] = (row[i] + row[i - channels]) & 255
        elif kind == 2:
            row = bytearray((a + b) & 255 for a, b in zip(row, previous))
        elif kind == 3:
            for i in range(stride):
                left = row[i - channels] if i >= channels else 0
                row[i] = (row[i] + (left + previous[i]) // 2) & 255
        elif kind == 4:
            for i in range(stride):
                a = row[i - channels] if i >= channels else 0
                b, c = previous[i], previous[i - channels] if i >= channels else 0
                pa, pb, pc = abs(b - c), abs(a - c), abs(a + b - 2 * c)
                row[i] = (row[i] + (a if pa <= pb and pa <= pc else b if pb <= pc else c)) & 255
        rows.append(row)
        previous = row
    return rows


def read(path):
    """Width, height and rows of (r, g, b)."""
    data = Path(path).read_bytes()
    parts = list(chunks(data))
    width, height, depth, color, _, _, interlace = struct.unpack(">IIBBBBB", dict(parts)[b"IHDR"])
    if data[:8] != SIGNATURE or depth != 8 or color not in (2, 6) or interlace:
        raise ValueError(f"{path}: only 8-bit RGB or RGBA without interlacing")
    channels = 3 if color == 2 else 4
    raw = zlib.decompress(b"".join(body for kind, body in parts if kind == b"IDAT"))
    rows = unfilter(raw, width, height, channels)
    return width, height, [list(zip(r[0::channels], r[1::channels], r[2::channels])) for r in rows]


def scaled(width, height, rows, share):
    """Averages over the pixels that fall into one of the smaller picture."""
    w, h = max(1, round(width * share)), max(1, round(height * share))
    result = []
    for y in range(h):
        span = rows[y * height // h:max(y * height // h + 1, (y + 1) * height // h)]
        line = []
        for x in range(w):
            a, b = x * width // w, max(x * width // w + 1, (x + 1) * width // w)
            pixels = [p for row in span for p in row[a:b]]
            line.append(tuple(sum(c) // len(pixels) for c in zip(*pixels)))
        result.append(line)
    return w, h, result


def boxes_of(counts, colors):
    """Median cut: the box with the most pixels times extent is halved until there are enough. Gives the boxes' means."""
    boxes = [list(counts)]
    def spread(box):
        return max((max(c[i] for c in box) - min(c[i] for c in box), i) for i in range(3))
    weights = [(spread(boxes[0])[0] * sum(counts.values()), 0)]
    while len(boxes) < colors:
        weight, at = max(weights)
        if weight == 0:
            break
        axis = spread(boxes[at])[1]
        box = sorted(boxes[at], key=lambda c: c[axis])
        half, passed = sum(counts[c] for c in box) / 2, 0
        for cut, color in enumerate(box):
            passed += counts[color]
            if passed >= half:
                break
        cut = min(max(cut + 1, 1), len(box) - 1)
        boxes[at], new = box[:cut], box[cut:]
        boxes.append(new)
        weights[at] = (spread(boxes[at])[0] * sum(counts[c] for c in boxes[at]), at)
        weights.append((spread(new)[0] * sum(counts[c] for c in new), len(boxes) - 1))
    return [mean_of(box, counts) for box in boxes]


def mean_of(colors, counts):
    total = sum(counts[c] for c in colors)
    return tuple(sum(c[i] * counts[c] for c in colors) / total for i in range(3))


def distance(a, b):
    return (a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2 + (a[2] - b[2]) ** 2


def nearest(colors, means):
    """{colour: number of the nearest mean}. Those of one cell of eight steps share the few means that can be it."""
    near, index = {}, {}
    for color in colors:
        cell = (color[0] >> 3, color[1] >> 3, color[2] >> 3)
        if cell not in near:
            middle = tuple(8 * v + 3.5 for v in cell)
            far = sorted((distance(middle, m) ** 0.5, number) for number, m in enumerate(means))
            # From the middle to a corner are 6.1 steps, so what is 12.2 steps farther than the nearest is it nowhere.
            near[cell] = [number for d, number in far if d <= far[0][0] + 12.2]
        candidates = near[cell]
        index[color] = candidates[0] if len(candidates) == 1 else min(candidates, key=lambda n: distance(color, means[n]))
    return index


def palette_of(counts, colors):
    """The palette, and {colour: its number in it}."""
    means = boxes_of(counts, colors)
    for _ in range(ROUNDS):
        members = [[] for _ in means]
        for color, number in nearest(counts, means).items():
            members[number].append(color)
        means = [mean_of(of, counts) if of else mean for of, mean in zip(members, means)]
    palette = [tuple(round(v) for v in mean) for mean in means]
    return palette, nearest(counts, palette)


def dithered(rows, exact):
    """The rows with a pattern on smooth places that hides the steps of a palette there (ordered dither, Bayer 1973). What the
    palette has as it is, `exact`, stays."""
    result, above = [], rows[0]
    for y, row in enumerate(rows):
        line, left = [], row[0]
        pattern = DITHER[y % len(DITHER)]
        for x, (color, over) in enumerate(zip(row, above)):
            smooth = all(abs(a - b) <= SMOOTH and abs(a - c) <= SMOOTH for a, b, c in zip(color, left, over))
            by = pattern[x % len(pattern)] if smooth and color not in exact else 0
            line.append(tuple(min(255, max(0, v + by)) for v in color) if by else color)
            left = color
        result.append(line)
        above = row
    return result


def encode(width, height, rows, colors):
    counts = {}
    for row in rows:
        for color in row:
            counts[color] = counts.get(color, 0) + 1
    palette, index = palette_of(counts, colors)
    rows = dithered(rows, set(palette))
    index.update(nearest({color for row in rows for color in row}.difference(index), palette))
    raw = b"".join(b"\0" + bytes(index[c] for c in row) for row in rows)

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    return (SIGNATURE + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0))
            + chunk(b"PLTE", bytes(v for color in palette for v in color))
            + chunk(b"IDAT", zlib.compress(raw, 9)) + chunk(b"IEND", b""))


def main():
    if len(sys.argv) not in (3, 4):
        print(__doc__, file=sys.stderr)
        return 2
    limit = int(sys.argv[3]) if len(sys.argv) == 4 else LIMIT
    width, height, rows = read(sys.argv[1])
    for colors, share in STEPS:
        picture = (width, height, rows) if share == 1.0 else scaled(width, height, rows, share)
        data = encode(*picture, colors)
        if len(data) <= limit:
            Path(sys.argv[2]).write_bytes(data)
            print(f"{sys.argv[2]}: {picture[0]}x{picture[1]}, {colors} colours, {len(data)} bytes")
            return 0
    print(f"{sys.argv[1]} cannot be brought under {limit} bytes", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
