#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Packs the add-on for Blender: tools/pack_blender.py [OUTPUT], build/gable_blender.zip where none is given.

The same files give the same bytes, on every machine: sorted names, one date, nothing compressed.
"""
import argparse
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
ADDON = ROOT / "blender" / "gable_blender"
DATE = (1980, 1, 1, 0, 0, 0)


def pack(output):
    output.parent.mkdir(parents=True, exist_ok=True)
    files = sorted([*ADDON.glob("*.py"), ADDON / "blender_manifest.toml", ROOT / "LICENSE"], key=lambda p: p.name)
    with zipfile.ZipFile(output, "w", zipfile.ZIP_STORED) as archive:
        for path in files:
            entry = zipfile.ZipInfo(f"{ADDON.name}/{path.name}", DATE)
            entry.create_system = 3
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, path.read_bytes())


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("output", nargs="?", type=Path, default=ROOT / "build" / "gable_blender.zip")
    out = parser.parse_args().output
    pack(out)
    print(out)
