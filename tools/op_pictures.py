#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Makes the pictures of the operations' pages anew: tools/op_pictures.py GABLE [PICTURE...].

A page beside an operation shows a picture as ![what is seen](name.png); the first block of rules below it is what is
drawn, on a lot of 30 x 20 metres, and the picture lies beside the page. Look at them before committing them.
"""
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BUILTINS = ROOT / "src/builtins"
SHOWN = re.compile(r"^!\[[^\]]*\]\(([\w-]+\.png)\)\n\n```cga\n(.*?)^```$", re.M | re.S)
DRAWN = ["--lot", "30x20", "--size", "760x420", "--samples", "64"]


def pictures():
    """(picture, rules) of all pages."""
    for page in sorted(BUILTINS.rglob("*.md")):
        for name, rules in SHOWN.findall(page.read_text(encoding="utf-8")):
            yield page.parent / name, rules


def draw(gable, picture, rules):
    work = ROOT / "build/pictures"
    work.mkdir(parents=True, exist_ok=True)
    source, raw = work / f"{picture.stem}.cga", work / picture.name
    source.write_text(rules, encoding="utf-8")
    subprocess.run([gable, "render", source, *DRAWN, "-o", raw], check=True)
    subprocess.run([sys.executable, "-B", ROOT / "tools/shrink_png.py", raw, picture], check=True)


def main():
    if len(sys.argv) < 2:
        print(__doc__, file=sys.stderr)
        return 2
    wanted = set(sys.argv[2:])
    for picture, rules in pictures():
        if not wanted or picture.name in wanted or picture.stem in wanted:
            draw(sys.argv[1], picture, rules)
    return 0


if __name__ == "__main__":
    sys.exit(main())
