#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Writes docs/reference from the engine's own declarations: tools/gen_docs.py GABLE [--check].

GABLE is the program; `gable ops --json` lists all operations, functions, shape attributes and selectors.
Each .cpp of src/builtins with its .md becomes a page: signatures and parameters from the declarations,
then the prose. With --check nothing is written; exit status 1 when a page is not what it should be.
"""
import argparse
import json
import re
import subprocess
import sys
from pathlib import Path

from coverage import PAGE as COVERAGE
from coverage import Coverage, table
from rule_library import PAGE as RULE_LIBRARY
from rule_library import rule_library

ROOT = Path(__file__).resolve().parent.parent
BUILTINS = ROOT / "src/builtins"
REFERENCE = "docs/reference"
NOTE = "<!-- Made by tools/gen_docs.py; change the source beside {source} instead. -->\n"
# What only the source tells: which file declares a name. Every declaration is a row {"name", "...", ...}.
ROW = r'\{{\s*"{name}",'
# Names that the source makes otherwise, by how they begin.
FAMILIES = {"material.": BUILTINS / "functions/material.cpp",
            "region.": BUILTINS / "functions/region.cpp"}


class Reference:
    def __init__(self, catalogue):
        self.catalogue = catalogue
        self.pages = {}     # path -> text
        self.problems = []
        self.sources = {p: p.read_text(encoding="utf-8") for kind in ("ops", "functions")
                        for p in sorted((BUILTINS / kind).rglob("*.cpp"))
                        if "/shared/" not in p.as_posix() and not p.stem.endswith("_test")}

    def source_of(self, kind, name):
        """The .cpp below ops/ or functions/ that declares a name."""
        row = re.compile(ROW.format(name=re.escape(name)))
        for path, text in self.sources.items():
            if path.is_relative_to(BUILTINS / kind) and row.search(text):
                return path
        for start, path in FAMILIES.items():
            if kind == "functions" and name.startswith(start):
                return path
        self.problems.append(f"{name}: no file of src/builtins/{kind} has a row for it")
        return None

    def by_source(self, kind, entries):
        """{source: entries}, in the order of the sources."""
        groups = {}
        for entry in entries:
            source = self.source_of(kind, entry["name"])
            if source:
                groups.setdefault(source, []).append(entry)
        return dict(sorted(groups.items()))

    def make(self):
        operations = self.by_source("ops", self.catalogue["operations"])
        functions = self.by_source("functions", self.catalogue["functions"])
        attributes = self.by_source("functions", self.catalogue["attributes"])
        for source, entries in operations.items():
            self.page("operations", source, entries, [])
        for source in sorted({*functions, *attributes}):
            self.page("functions", source, functions.get(source, []), attributes.get(source, []))
        self.index("operations", "Operations", operations, "summary")
        self.index("functions", "Functions", functions, "summary")
        self.index("attributes", "Attributes of the shape", attributes, "doc", folder="functions")
        self.selectors()
        self.pages[RULE_LIBRARY] = rule_library(ROOT)
        self.profiles()
        self.coverage({"operations": operations, "functions": functions, "attributes": attributes})

    def coverage(self, groups):
        folders = {"operations": "operations", "functions": "functions", "attributes": "functions"}
        pages = {(kind, entry["name"]): f"{folders[kind]}/{source.stem}.md"
                 for kind, group in groups.items() for source, entries in group.items() for entry in entries}
        coverage = Coverage(ROOT, self.catalogue, pages)
        self.pages[COVERAGE] = coverage.make()
        self.problems += coverage.problems

    def page(self, folder, source, entries, attributes):
        prose = source.with_suffix(".md")
        names = [e["name"] for e in entries] or [source.stem.replace("_", " ").capitalize()]
        title = ", ".join(names[:6]) + (", ..." if len(names) > 6 else "")
        text = prose.read_text(encoding="utf-8") if prose.exists() else ""
        # Pictures lie beside the prose.
        beside = "../../../" + source.parent.relative_to(ROOT).as_posix() + "/"
        intro, rest = split_prose(re.sub(r"(!\[[^\]]*\]\()([\w-]+\.png\))", rf"\g<1>{beside}\g<2>", text))
        parts = [NOTE.format(source=source.relative_to(ROOT).as_posix()), f"# {title}\n", intro]
        parts += [entry_text(e, heading=len(entries) > 1) for e in entries]
        if attributes:
            parts.append("## Attributes\n\n" + table(
                ("name", "type", "", "meaning"),
                [(f"`{a['name']}`", a["type"], "can be set" if a["writable"] else "", a["doc"])
                 for a in attributes]))
        self.pages[f"{REFERENCE}/{folder}/{source.stem}.md"] = "\n".join(p for p in [*parts, rest] if p)

    def index(self, name, title, groups, meaning, folder=None):
        rows = sorted((entry["name"], source.stem, entry[meaning], entry.get("family", ""))
                      for source, entries in groups.items() for entry in entries)
        text = NOTE.format(source="src/builtins") + f"\n# {title}\n\n"
        families = sorted({row[3] for row in rows})
        for family in families:
            if family:
                text += f"## {family.capitalize()}\n\n"
            text += table(("name", "what it does" if meaning == "summary" else "meaning"),
                          [(f"[`{n}`]({folder or name}/{stem}.md)", doc)
                           for n, stem, doc, f in rows if f == family]) + "\n"
        self.pages[f"{REFERENCE}/{name}.md"] = text.rstrip("\n") + "\n"

    def profiles(self):
        options, profiles = self.catalogue["writeOptions"], self.catalogue["writeProfiles"]
        text = NOTE.format(source="src/engine/writing.cpp") + "\n# Options and profiles of models\n\n"
        text += "`gable generate` and `gable city` take these options for the models that they write, `Model.write` of Python and\n"
        text += "`gable_model_write` of C by the same names. `--for` chooses among them what suits a program; an option that is given holds\n"
        text += "all the same, and a note says so. [Models for game engines](../guide/games.md) tells how to use them.\n\n## Profiles\n\n"
        text += "An empty cell is the default.\n\n"
        used = [o["name"] for o in options if any(o["name"] in p["choices"] for p in profiles)]
        text += table(("", *(f"`--for {p['name']}`" for p in profiles)),
                      [("for", *(p["title"] for p in profiles))] +
                      [(f"`--{name}`", *(f"`{p['choices'][name]}`" if name in p["choices"] else "" for p in profiles))
                       for name in used])
        text += "\n## Options\n\n" + table(
            ("option", "takes", "what it does"),
            [(f"`--{o['name']}`", ", ".join(f"`{w}`" for w in o["words"]) or f"0 to {o['most']}",
              " ".join(o["help"].split()).replace("|", "\\|")) for o in options])
        self.pages[f"{REFERENCE}/profiles.md"] = text

    def selectors(self):
        text = NOTE.format(source="src/builtins") + "\n# Selectors\n\nWords that choose components, in `comp` and "
        text += "where an operation takes one.\n\n"
        text += table(("selector", "chooses"),
                      [(f"`{s['name']}`", s["doc"]) for s in self.catalogue["selectors"]])
        text += "\n## Edges of regions\n\nOperations on regions choose edges by where they come from and where they lie, in "
        text += "selections like\n`outer && !side(west)`: [all words](operations/peel.md#selections).\n"
        self.pages[f"{REFERENCE}/selectors.md"] = text


def split_prose(text):
    """What stands before the first heading, and the rest."""
    match = re.search(r"^## ", text, re.M)
    at = match.start() if match else len(text)
    return tuple(part.strip() + "\n" if part.strip() else "" for part in (text[:at], text[at:]))


def signature(entry, overload):
    """name(a, b, [c]) with the block behind it."""
    if entry.get("bare") and not overload["params"]:
        return entry["name"]
    names = [f"[{p['name']}]" if "default" in p else p["name"] for p in overload["params"]]
    if overload.get("variadic"):
        names.append("...")
    text = f"{entry['name']}({', '.join(names)})"
    if entry.get("block"):
        text += " " + entry["block"]
    if overload.get("result", "null") not in ("null", ""):
        text += " : " + overload["result"]
    return text


def taken(parameter):
    """The numbers that a parameter takes, as a sentence."""
    return f" Takes {parameter['range']}." if parameter.get("range") else ""


def entry_text(entry, heading):
    """Signatures, summary and a table of the parameters; one of a name stands for all overloads."""
    text = f"## {entry['name']}\n\n" if heading else ""
    overloads = entry["overloads"] or [{"params": []}]
    text += "```text\n" + "\n".join(signature(entry, o) for o in overloads) + "\n```\n\n"
    text += entry["summary"] + "\n"
    seen, rows = set(), []
    for overload in overloads:
        for p in overload["params"]:
            key = (p["name"], p["type"], p["doc"])
            if key in seen:
                continue
            seen.add(key)
            words = f" One of `{'`, `'.join(p['words'].split())}`." if p.get("words") else ""
            terms = [t["name"] + ("(" + ", ".join(a["name"] for a in t["params"]) + ")" if t["params"] else "")
                     for t in p.get("terms", [])]
            if 0 < len(terms) <= 10:
                words = f" Terms: `{'`, `'.join(terms)}`."
            rows.append((f"`{p['name']}`", p["type"],
                         f"`{p['default']}`" if "default" in p else "", p["doc"] + taken(p) + words))
    if rows:
        text += "\n" + table(("parameter", "type", "default", "meaning"), rows)
    if entry.get("parts"):
        named = [(f"`{p['name']}`", p["doc"]) for p in entry["parts"]]
        if entry.get("selectors"):
            named.append(("any [selector](../selectors.md)", "Faces or edges."))
        text += "\n" + table(("part of the block", "what it is"), named)
    return text


def stale_pages(pages):
    """Generated files on disk that no page stands for any more."""
    for folder in ("operations", "functions"):
        for path in sorted((ROOT / REFERENCE / folder).glob("*.md")):
            relative = path.relative_to(ROOT).as_posix()
            if relative not in pages:
                yield path, relative


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("gable")
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    answer = subprocess.run([options.gable, "ops", "--json"], capture_output=True, check=True)
    reference = Reference(json.loads(answer.stdout))
    reference.make()
    problems = reference.problems
    for path, text in sorted(reference.pages.items()):
        full = ROOT / path
        if options.check:
            if not full.exists() or full.read_text(encoding="utf-8") != text:
                problems.append(f"{path} is not up to date: run tools/gen_docs.py {options.gable}")
        else:
            full.parent.mkdir(parents=True, exist_ok=True)
            full.write_text(text, encoding="utf-8")
    for full, path in stale_pages(reference.pages):
        if options.check:
            problems.append(f"{path} has no source any more")
        else:
            full.unlink()
    for problem in problems:
        print(problem)
    print(f"{len(reference.pages)} pages, {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
