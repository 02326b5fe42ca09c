#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Pictures of the studio's journeys: tools/journey_pictures.py FOLDER.

FOLDER holds what `GABLE_SHOTS=FOLDER node e2e/journeys.mjs` has kept, run in studio/ on a page and a program that
are built: the end of each journey as NAME.png. Each goes to docs/studio/journeys, made small, and
docs/studio/README.md shows them all. Look at them before committing them.
"""
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
JOURNEYS = ROOT / "studio/e2e"
TARGET = ROOT / "docs/studio"
# A journey's picture only has to show what the page looks like.
LIMIT = 70_000
ROW = re.compile(r"([A-Z]\d+)_")


def journeys(text):
    """The names of the functions of a file's journeys, in order."""
    return re.findall(r"^  async (\w+)\(", text, re.MULTILINE)


def sentence(name):
    """`G4_scopesMoveTurn` as "G4: Scopes move turn"."""
    row = ROW.match(name)
    words = re.sub(r"([A-Z])", r" \1", ROW.sub("", name, count=1)).strip().lower()
    words = words[0].upper() + words[1:]
    return f"{row.group(1)}: {words}" if row else words


def page(names):
    lines = ["# The studio in pictures", "",
             "How the page looks at the end of each of its journeys: browser tests that do what a person does, at 1280 by 720 on a "
             "renderer in software. `tools/journey_pictures.py` makes this page. [The guide](../guide/studio.md) tells how to "
             "do these things.", ""]
    for title, found in names:
        lines += [f"## {title}", ""]
        for name in found:
            lines += [f"![{sentence(name)}](journeys/{name}.png)", "", f"*{sentence(name)}.*", ""]
    return "\n".join(lines)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    shots = Path(sys.argv[1])
    files = [("First steps", JOURNEYS / "journeys.mjs")]
    files += [(f.stem.capitalize(), f) for f in sorted((JOURNEYS / "journeys").glob("*.mjs"))]
    (TARGET / "journeys").mkdir(exist_ok=True)
    listed = []
    for title, file in files:
        # Journeys that were not run keep the picture that they have.
        names = [n for n in journeys(file.read_text(encoding="utf-8"))
                 if (shots / f"{n}.png").exists() or (TARGET / f"journeys/{n}.png").exists()]
        for name in names:
            if not (shots / f"{name}.png").exists():
                continue
            subprocess.run([sys.executable, "-B", str(ROOT / "tools/shrink_png.py"), str(shots / f"{name}.png"),
                            str(TARGET / f"journeys/{name}.png"), str(LIMIT)], check=True)
        if names:
            listed.append(("GBBG" if title == "Gbbg" else title, names))
    (TARGET / "README.md").write_text(page(listed), encoding="utf-8")


if __name__ == "__main__":
    main()
