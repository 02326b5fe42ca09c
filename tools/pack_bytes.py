#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Packs a file for the playground: tools/pack_bytes.py FROM TO.

A .lzma file as xz and 7-Zip know it, with the size of what is in it: what studio/playground/lzma.ts unpacks. Modules of
WebAssembly and texts come out a quarter smaller than by gzip. The same bytes give the same bytes.
"""
import lzma
import struct
import sys
from pathlib import Path

# Places within words of several bytes tell nothing here: neither modules nor texts have such words.
FILTER = {"id": lzma.FILTER_LZMA1, "preset": 9 | lzma.PRESET_EXTREME, "lc": 4, "lp": 0, "pb": 0}
# A byte of settings and four of the dictionary's size; the size of the content follows.
SIZE_AT = 5


def packed(content):
    own = {**FILTER, "dict_size": max(4096, len(content))}
    alone = lzma.compress(content, format=lzma.FORMAT_ALONE, filters=[own])
    return alone[:SIZE_AT] + struct.pack("<Q", len(content)) + alone[SIZE_AT + 8 :]


def main():
    if len(sys.argv) != 3:
        sys.exit("usage: tools/pack_bytes.py FROM TO")
    Path(sys.argv[2]).write_bytes(packed(Path(sys.argv[1]).read_bytes()))


if __name__ == "__main__":
    main()
