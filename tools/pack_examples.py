#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Packs the examples for the playground into one file: tools/pack_examples.py TO.

A line of JSON, [[path, bytes], ...], and behind it the files one after the other, all of it compressed by gzip: what
studio/playground/worker.ts unpacks. Places from maps are left out, since a page reads no maps, and so are the
pictures that show an example. The same files give the same bytes.
"""
import gzip
import json
import sys
from pathlib import Path

EXAMPLES = Path(__file__).resolve().parent.parent / "examples"
MAPS = (".osm", ".pbf")


def is_place(folder):
    return any(file.suffix in MAPS for file in folder.iterdir())


def belongs(file):
    path = file.relative_to(EXAMPLES)
    folder = EXAMPLES / path.parts[0]
    shows = file.suffix == ".png" and len(path.parts) == 2
    return file.is_file() and len(path.parts) > 1 and not shows and not is_place(folder)


def pack():
    files = [file for file in sorted(EXAMPLES.rglob("*")) if belongs(file)]
    names = [[file.relative_to(EXAMPLES).as_posix(), file.stat().st_size] for file in files]
    return b"".join([json.dumps(names).encode(), b"\n", *(file.read_bytes() for file in files)])


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: tools/pack_examples.py TO")
    Path(sys.argv[1]).write_bytes(gzip.compress(pack(), 9, mtime=0))


if __name__ == "__main__":
    main()
