#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Runs checks over the text of the repository: tools/check.py [--root DIR] [NAME...]

Names: layers, sizes, words, links, pictures, ops, op_names, diagnostics, libm, library, types; all where none is
given. Exit status 1 where a check objects to something that tools/exceptions.txt does not name.
"""
import argparse
import sys
from pathlib import Path

from checks import diagnostics, layers, libm, library, links, op_names, ops, pictures, sizes, types, words
from checks.tree import Finding, Tree

CHECKS = {"layers": layers.check, "sizes": sizes.check, "words": words.check,
          "links": links.check, "pictures": pictures.check, "ops": ops.check,
          "op_names": op_names.check, "diagnostics": diagnostics.check, "libm": libm.check,
          "library": library.check, "types": types.check}


def exceptions(tree):
    """{(check, subject): line number} from tools/exceptions.txt, and findings about that file."""
    path = "tools/exceptions.txt"
    found, wrong = {}, []
    for number, line in enumerate(tree.text(path).splitlines() if tree.exists(path) else [], 1):
        words_of_line = line.split(None, 2)
        if not words_of_line or line.startswith("#"):
            continue
        if len(words_of_line) < 3 or words_of_line[0] not in CHECKS:
            wrong.append(Finding(path, number, "expected: check, file, reason"))
        else:
            found[tuple(words_of_line[:2])] = number
    return found, wrong


def run(tree, names):
    """The findings of the named checks after exceptions."""
    known, findings = exceptions(tree)
    for name in names:
        used = set()
        for finding in CHECKS[name](tree):
            if (name, finding.subject) in known:
                used.add(finding.subject)
            else:
                findings.append(finding)
        findings += [Finding("tools/exceptions.txt", line, f"{subject} needs no exception any more")
                     for (check, subject), line in known.items()
                     if check == name and subject not in used]
    return findings


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--root", default=Path(__file__).resolve().parent.parent)
    parser.add_argument("names", nargs="*", choices=[*CHECKS, []])
    options = parser.parse_args()
    tree = Tree(options.root)
    findings = run(tree, options.names or list(CHECKS))
    for finding in findings:
        print(finding)
    print(f"{len(tree.paths)} files, {len(findings)} findings")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
