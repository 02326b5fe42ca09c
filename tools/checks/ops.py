# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Each operation and each family of functions is a .cpp with its .test and its .md beside it.
Folders named `shared` hold helpers."""
from .tree import Finding

FOLDERS = ("src/builtins/ops/", "src/builtins/functions/")
PARTS = (".cpp", ".test", ".md")


def check(tree):
    findings = []
    for folder in FOLDERS:
        stems = {}
        for path in tree.files(*PARTS, under=folder):
            stem, _, suffix = path.rpartition(".")
            if "/shared/" in path or stem.endswith(("_test", "/README")):
                continue
            stems.setdefault(stem, set()).add("." + suffix)
        for stem, parts in sorted(stems.items()):
            for part in PARTS:
                if part not in parts:
                    findings.append(Finding(stem + part, 0, "is missing", stem))
    return findings
