# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""The runtime knows no operation and no function by its name: what it must know of one is declared in its
specification (src/program/spec.h). So no literal there is such a name, or has one in quotes."""
import re

from .tree import CPP, Finding, line_at, strings_of

RUNTIME = "src/runtime/"
FOLDERS = ("src/builtins/ops/", "src/builtins/functions/")
# {"comp", "subdivide", "Divides the shape ...": a name, a family, a sentence.
SPEC = re.compile(r'\{\s*"([\w.]+)",\s*(?:"\w+"|k\w+),\s*"[A-Z]')
QUOTED = re.compile(r"'(\w+)'")


def names_of(tree):
    """The names of all operations and functions."""
    return {match.group(1) for folder in FOLDERS for path in tree.files(".cpp", under=folder)
            if not path.endswith("_test.cpp") for match in SPEC.finditer(tree.text(path))}


def check(tree):
    names = names_of(tree)
    findings = []
    for path in tree.files(*CPP, under=RUNTIME):
        if path.endswith("_test.cpp"):
            continue
        text = tree.text(path)
        for offset, literal in strings_of(text):
            for name in sorted(names & {literal, *QUOTED.findall(literal)}):
                findings.append(Finding(path, line_at(text, offset),
                                        f"names the operation '{name}'; declare in its specification what the "
                                        "runtime has to know of it", path))
    return findings
