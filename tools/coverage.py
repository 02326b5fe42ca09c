# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""The page docs/reference/coverage.md: every name of CGA, how much of it is there, and what checks it.

docs/reference/coverage.json lists the names. What can be known is not written there: whether the program
knows a name comes from `gable ops --json`, and which case checks it from the .test files. A comment
above a case names what the case holds to:

    # Reference: extrude, scope.sy        numbers that the published reference states or that follow from it
    # Real result: roofHip                counts or values that the original gave
    # Reading: geometry.lowerheight       one of two readings; coverage.json tells both

A name may end in `*`: then the names of coverage.json stand for it that the case uses. A row whose check
is no case has "checked" in coverage.json: {"by": "...", "test": "file: name in that file"}.

A row of coverage.json has "name" and may have: "key", what a comment calls it; "lacks", what is missing;
"missing", true where nothing of it is there; "form", a word of the language that the catalogue does not list;
"readings", two of them, the one taken first.
"""
import fnmatch
import json
import re
from pathlib import Path

DATA = "docs/reference/coverage.json"
PAGE = "docs/reference/coverage.md"
KINDS = {"Reference": "reference numbers", "Real result": "real result", "Reading": "two readings",
         "Own": "own test"}
TITLES = {"operations": "Operations", "functions": "Functions", "attributes": "Attributes of shapes",
          "annotations": "Annotations", "language": "Language", "selectors": "Selectors",
          "files": "Files, packages, tools"}
# The tables of the catalogue that tell whether a name is known.
CATALOGUE = {"operations": ("operations",), "functions": ("functions", "operations"),
             "attributes": ("attributes", "functions")}
MARK = re.compile(r"^#\s*(" + "|".join(KINDS) + r"):\s*(.+?)\.?$")
ANNOTATION = re.compile(r'^\s*\{"(\w+)", (?:\[|read)', re.M)
MOST_CASES = 2

INTRO = """<!-- Made by tools/gen_docs.py of docs/reference/coverage.json and the cases. -->

# Coverage of CGA

Every name of the published CGA reference (CityEngine 2025.1), what Gable knows of it, and what checks that.

**State**: *whole* means that every published form works and that no difference is known. *Partial* tells what is
missing. *Missing* names give an error or a leaf with a warning, so that no model is silently wrong.

**Checked by** names a test that `./test` runs:

- *reference numbers*: the test holds numbers that the reference states, or that follow from what it states.
- *real result*: the test holds counts or values that the original was seen to give.
- *two readings*: the reference leaves the meaning open. The row tells both; the first is the one taken, and the test
  holds it.
- *own test*: a tool or a file format of Gable, of which the reference states nothing that could be compared.

Random numbers have the same families and distributions as the original's, but not the same stream: a rule that
draws gives another variant than the original does with the same seed.

"""


class Case:
    """A case of a .test file: its place, its text, and what the comments above it claim."""

    def __init__(self, path, name, claims):
        self.path, self.name, self.claims, self.text = path, name, claims, ""

    def uses(self, name):
        return re.search(r"(?<![\w.])" + re.escape(name) + r"(?![\w.]|\*)", self.text) is not None


def cases_of(path, text):
    """The cases of a file. Comments between two cases belong to the one below them."""
    cases, claims = [], []
    for line in text.splitlines():
        mark = MARK.match(line)
        if mark:
            claims += [(KINDS[mark[1]], name.strip()) for name in mark[2].split(",")]
        elif line.startswith("== "):
            cases.append(Case(path, line[3:].strip(), claims))
            claims = []
        elif cases and not line.startswith("#"):
            cases[-1].text += line + "\n"
    return cases


class Coverage:
    def __init__(self, root, catalogue, pages=None):
        self.root = Path(root)
        self.pages = pages or {}    # (kind, name) -> page below docs/reference
        self.problems = []
        self.rows = json.loads((self.root / DATA).read_text(encoding="utf-8"))
        self.known = {kind: {e["name"] for table in tables for e in catalogue[table]}
                      for kind, tables in CATALOGUE.items()}
        notes = (self.root / "src/lang/sema/notes.cpp").read_text(encoding="utf-8")
        self.known["annotations"] = {"@" + name for name in ANNOTATION.findall(notes)}
        self.cases = [case for folder in ("src", "tests/cases")
                      for path in sorted((self.root / folder).rglob("*.test"))
                      for case in cases_of(path.relative_to(self.root).as_posix(),
                                           path.read_text(encoding="utf-8"))]

    def problem(self, text):
        self.problems.append(f"{DATA}: {text}")

    def make(self):
        """The text of the page."""
        checks = self.checks()
        text = INTRO
        counts, tables = [], ""
        for kind, title in TITLES.items():
            states = [self.state(kind, row) for row in self.rows[kind]]
            counts.append((title, *(str(sum(s.startswith(word) for s in states))
                                    for word in ("whole", "partial", "missing")), str(len(states))))
            tables += f"\n## {title}\n\n" + table(
                ("name", "state", "checked by"),
                [(self.shown(kind, row), state, self.check(row, state, checks.get(key_of(row), [])))
                 for row, state in zip(self.rows[kind], states)])
        return text + table(("", "whole", "partial", "missing", "all"), counts) + tables

    def state(self, kind, row):
        known = self.known.get(kind)
        form = row.get("form")
        if known is not None and not form and row["name"] not in known:
            if row.get("lacks"):
                self.problem(f"{row['name']} lacks something, and the program does not know it at all")
            return "missing"
        if row.get("missing"):
            if known is not None:
                self.problem(f"{row['name']} is said to be missing, but the program knows it")
            return "missing"
        return "partial: " + row["lacks"] if row.get("lacks") else "whole"

    def shown(self, kind, row):
        name = row["name"] if kind in ("language", "selectors", "files") else f"`{row['name']}`"
        page = self.pages.get((kind, row["name"]))
        return f"[{name}]({page})" if page else name

    def check(self, row, state, found):
        """The cell «checked by», and a problem where it would be empty."""
        by_kind = {}
        for by, place in found:
            by_kind.setdefault(by, []).append(place)
        for given in row.get("checked", []):
            by_kind.setdefault(given["by"], []).append(self.named_test(row, given["test"]))
        if ("two readings" in by_kind) != ("readings" in row):
            self.problem(f"{row['name']}: a case with '# Reading: {key_of(row)}' and \"readings\" belong together")
        if not by_kind:
            if state == "missing" and not row.get("missing"):
                return "`gable ops` does not list it"
            self.problem(f"nothing checks {row['name']}: write '# Reference: {key_of(row)}' above the case that "
                         "holds what the reference states")
            return ""
        parts = []
        for by in KINDS.values():
            if by in by_kind:
                more = ", ..." if len(by_kind[by]) > MOST_CASES else ""
                parts.append(f"{by}: " + ", ".join(by_kind[by][:MOST_CASES]) + more)
        if "readings" in row:
            parts.append(f"taken: {row['readings'][0]}; or: {row['readings'][1]}")
        return "; ".join(parts)

    def named_test(self, row, test):
        """A link to a test that is no case; it must be there."""
        path, _, name = test.partition(": ")
        full = self.root / path
        if not full.is_file():
            self.problem(f"{row['name']}: there is no file {path}")
        elif not re.search(rf"\b{re.escape(name)}\b", full.read_text(encoding="utf-8")):
            self.problem(f"{row['name']}: {path} has no {name}")
        return f"`{name}` of `{path}`"

    def checks(self):
        """{key of a row: [(kind of check, link to the case)]}; a problem for each claim that does not hold."""
        named = {}
        for kind, rows in self.rows.items():
            for row in rows:
                if key_of(row) in named:
                    self.problem(f"two rows are called {key_of(row)}")
                named[key_of(row)] = (kind, row)
        found = {}
        for case in self.cases:
            for by, pattern in case.claims:
                wild = pattern.endswith("*")
                keys = [k for k in named if fnmatch.fnmatchcase(k, pattern)] if wild else [pattern]
                if wild:
                    keys = [k for k in keys if case.uses(named[k][1]["name"])]
                if not keys or keys[0] not in named:
                    self.problems.append(f"{case.path}: {case.name} claims to check {pattern}, which is no "
                                         f"name of {DATA}")
                    continue
                for key in keys:
                    kind, row = named[key]
                    if kind in self.known and not row.get("form") and not case.uses(row["name"]):
                        self.problems.append(f"{case.path}: {case.name} claims to check {key}, and does not use it")
                    found.setdefault(key, []).append((by, link(case.path, case.name)))
        return found


def key_of(row):
    return row.get("key", row["name"].strip("`"))


def link(path, name):
    return f"[{name}](../../{path})"


def table(head, rows):
    def cell(text):
        return str(text).replace("|", "\\|").replace("\n", " ")
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(map(cell, row)) + " |" for row in rows]) + "\n"
