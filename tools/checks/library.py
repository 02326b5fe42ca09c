# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""The engine also runs in a page, where the C++ library lacks algorithms of ranges: what the engine calls of them
is in a header of ours, which is read before each file. A build for the page takes an hour; this finds it at once."""
import re

from .tree import CPP, Finding, code_of, line_at

HEADER = "apps/gable_wasm/library/cxx20.h"
DEFINED = re.compile(r"^\w+ (\w+)\(", re.M)
USED = re.compile(r"\bstd::(ranges|views)::(\w+)")


def check(tree):
    if not tree.exists(HEADER):
        return []
    known = set(DEFINED.findall(code_of(tree.text(HEADER)).partition("namespace ranges {")[2]))
    findings = []
    for path in tree.files(*CPP, under="src/"):
        if path.endswith("_test.cpp") or "/testing" in path:
            continue
        text = code_of(tree.text(path))
        for match in USED.finditer(text):
            space, name = match.groups()
            if space == "views" or name not in known:
                findings.append(Finding(path, line_at(text, match.start()),
                                        f"std::{space}::{name} is missing in the playground's library; take the algorithm "
                                        f"with iterators, or add it to {HEADER}", path))
    return findings
