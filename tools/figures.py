#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Prints the sizes of files and functions, cycles of includes, copied code, tests to source: tools/figures.py [ROOT]

The table of docs/dev/architecture.md is made of it.
"""
import re
import sys
from pathlib import Path

from checks.sizes import function_spans
from checks.tree import CPP, Tree

# So many lines that are equal but for layout, braces and includes apart, are a copy.
COPY = 8
FOLDERS = ("src/", "apps/", "include/")
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.M)


def is_test(path):
    return bool(re.search(r"_test\.\w+$|/testing/|\.test(\.ts)?$|^tests/|^studio/e2e/", path))


def spread(values):
    """Median, 90th percentile and the largest."""
    ordered = sorted(values) or [0]
    return ordered[len(ordered) // 2], ordered[len(ordered) * 9 // 10], ordered[-1]


def cycles(edges):
    """How many files take part in a cycle: those that reach themselves."""
    found = 0
    for start in edges:
        seen, open_ = set(), list(edges[start])
        while open_:
            at = open_.pop()
            if at in seen:
                continue
            seen.add(at)
            open_ += edges.get(at, ())
        found += start in seen
    return found


def includes(tree, paths):
    known = set(paths)
    edges = {}
    for path in paths:
        names = INCLUDE.findall(tree.text(path))
        ways = [[f"src/{n}", f"include/{n}", str(Path(path).parent / n)] for n in names]
        edges[path] = {w for way in ways for w in way if w in known}
    return edges


def copied(texts):
    """(lines that stand in a copy, lines) of texts."""
    places, total, marked = {}, 0, set()
    for number, text in enumerate(texts):
        lines = [re.sub(r"\s+", "", line) for line in text.splitlines()]
        lines = [line for line in lines if len(line) > 3 and not line.startswith(("//", "#", "*", "import"))]
        total += len(lines)
        for at in range(len(lines) - COPY + 1):
            places.setdefault(hash(tuple(lines[at:at + COPY])), []).append((number, at))
    for same in places.values():
        if len(same) > 1:
            marked.update((number, at + i) for number, at in same for i in range(COPY))
    return len(marked), total


def figures(root):
    """[(name, value)] of a repository."""
    tree = Tree(root)
    lines = {p: tree.text(p).count("\n") for p in tree.files(*CPP, ".ts", ".svelte", ".mjs", ".test", ".py")}
    code = [p for p in tree.files(*CPP) if p.startswith(FOLDERS) and not is_test(p)]
    page = [p for p in tree.files(".ts", ".svelte") if p.startswith("studio/src/") and not is_test(p)]
    tests = [p for p in lines if is_test(p)]
    functions = [last - first + 1 for p in code for _, first, last in function_spans(tree.text(p))]
    shape = "{} median, {} at 90 %, {} at most".format
    total = sum(lines[p] for p in code + page)
    twice, all_lines = copied([tree.text(p) for p in code + page])
    return [
        ("lines of a C++ file", f"{shape(*spread(lines[p] for p in code))}, of {len(code)}"),
        ("lines of a C++ function", f"{shape(*spread(functions))}, of {len(functions)}"),
        ("lines of a file of the page", f"{shape(*spread(lines[p] for p in page))}, of {len(page)}"),
        ("files in cycles of includes", str(cycles(includes(tree, code)))),
        (f"lines in copies of {COPY} lines and more", f"{100 * twice / max(all_lines, 1):.2f} % ({twice})"),
        ("lines of tests to lines of source", f"{sum(lines[p] for p in tests) / max(total, 1):.2f} "
                                              f"({sum(lines[p] for p in tests)} to {total})"),
    ]


def main():
    root = sys.argv[1] if len(sys.argv) > 1 else Path(__file__).resolve().parent.parent
    for name, value in figures(root):
        print(f"| {name} | {value} |")


if __name__ == "__main__":
    main()
