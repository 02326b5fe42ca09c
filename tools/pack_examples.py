#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Packs the examples for the playground into one file: tools/pack_examples.py TO.

A line of JSON, {"parts": [bytes, ...], "files": [[path, part, ...], ...]}, and behind it the parts one after the other,
all of it packed by pack_bytes.py: what studio/playground/worker.ts unpacks. A file is its parts; models have the
pictures within them as parts of their own, since many have the same. Places from maps are left out, since a page reads
no maps, and so are the pictures that show an example. The same files give the same bytes.
"""
import json
import struct
import sys
from pathlib import Path

from pack_bytes import packed

EXAMPLES = Path(__file__).resolve().parent.parent / "examples"
MAPS = (".osm", ".pbf")


def is_place(folder):
    return any(file.suffix in MAPS for file in folder.iterdir())


def belongs(file):
    path = file.relative_to(EXAMPLES)
    folder = EXAMPLES / path.parts[0]
    shows = file.suffix == ".png" and len(path.parts) == 2
    return file.is_file() and len(path.parts) > 1 and not shows and not is_place(folder)


def pictures(model):
    """Where the pictures within a .glb begin and end, in their order."""
    length = struct.unpack_from("<I", model, 12)[0]
    description, data = json.loads(model[20 : 20 + length]), 28 + length
    views = description.get("bufferViews", [])
    own = [views[image["bufferView"]] for image in description.get("images", []) if "bufferView" in image]
    starts = [(data + view.get("byteOffset", 0), view["byteLength"]) for view in own]
    return sorted((start, start + size) for start, size in starts)


def parts(file):
    content, at = file.read_bytes(), 0
    for start, end in pictures(content) if file.suffix == ".glb" else []:
        yield content[at:start]
        yield content[start:end]
        at = end
    yield content[at:]


def pack():
    numbers, files = {}, []
    for file in sorted(EXAMPLES.rglob("*")):
        if belongs(file):
            of = [numbers.setdefault(part, len(numbers)) for part in parts(file)]
            files.append([file.relative_to(EXAMPLES).as_posix(), *of])
    head = {"parts": [len(part) for part in numbers], "files": files}
    return b"".join([json.dumps(head, separators=(",", ":")).encode(), b"\n", *numbers])


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: tools/pack_examples.py TO")
    Path(sys.argv[1]).write_bytes(packed(pack()))


if __name__ == "__main__":
    main()
