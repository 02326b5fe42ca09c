#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Writes the pages for users as they stand in an installation: tools/install_docs.py FOLDER.

FOLDER gets README.md, docs/guide, docs/reference and the pages of the examples; the rest of the examples is beside
them, as `cmake --install` puts it. Pictures and what else lies in docs come along. A link to what an installation does
not have, such as a source, becomes plain text.
"""
import argparse
import re
import shutil
from os.path import normpath, relpath
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
DOCS, EXAMPLES = ROOT / "docs", ROOT / "examples"
FOLDERS = (DOCS / "guide", DOCS / "reference", EXAMPLES)
PICTURES = (".png", ".jpg", ".svg", ".gif")
# Code is found first, so that what looks like a link in it stays.
PARTS = re.compile(r"^```.*?^```$|(!?)\[((?:[^\[\]]|\[[^\[\]]*\])*)\]\(([^()\s]+)\)|`[^`\n]+`", re.M | re.S)


def pages():
    return {ROOT / "README.md", *(page for folder in FOLDERS for page in folder.rglob("*.md"))}


def installed_page(source, installed):
    """The text of a page, and what it shows or links to: {place: the file}."""
    files = {}

    def link(found):
        sign, text, target = found.groups()
        if target is None or target.startswith("#") or re.match(r"\w+:", target):
            return found.group(0)
        name, *anchor = target.split("#")
        path = Path(normpath(source.parent / name))
        if path in installed or EXAMPLES in path.parents:
            return found.group(0)
        is_of_docs = DOCS in path.parents and path.suffix != ".md"
        if not path.is_file() or not (is_of_docs or path.suffix in PICTURES):
            return text
        place = path if is_of_docs else source.parent / path.name
        files[place] = path
        return f"{sign}[{text}]({'#'.join([Path(relpath(place, source.parent)).as_posix(), *anchor])})"

    return PARTS.sub(link, source.read_text(encoding="utf-8")), files


def write(folder):
    installed = pages()
    for source in sorted(installed):
        text, files = installed_page(source, installed)
        out = folder / source.relative_to(ROOT)
        out.parent.mkdir(parents=True, exist_ok=True)
        out.write_text(text, encoding="utf-8")
        for place, file in files.items():
            to = folder / place.relative_to(ROOT)
            to.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(file, to)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    write(parser.parse_args().folder)
