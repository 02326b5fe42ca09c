# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""The page docs/reference/rule-library.md: the rule files that come with Gable, and what is called from outside.

A rule is listed where a comment stands right above it, where the file's first comment names it, or where another rule file of the
examples calls it; with another number of arguments it is listed once, with those that may be left out. What an attribute means
is its @Description and the comment behind it, and the values that its @Enum or @Range lets it have. tools/gen_docs.py writes
the page.
"""
import re

from coverage import table

PAGE = "docs/reference/rule-library.md"
FOLDER = "examples/rules"
INTRO = """<!-- Made by tools/gen_docs.py of examples/rules; change the comments there instead. -->

# Rule library

Rule files that come with Gable, for your own rules to import. Import a file by its path and call its rules by the name that
you give it:

```
import street : "/gable/rules/street.cga"
Lot --> street.Cafe
```

An attribute is set in the import, as in `import setting : "/gable/rules/setting.cga" (lamps = "#ffffff")`, in
the importing file by an attribute of the same name, or from outside by `--set setting.lamps=...`. An argument in brackets
may be left out. Read [how files use each other](../guide/imports.md).

What stands, such as trees, people and benches, stands along y of the scope. On a face of `comp(f)` y lies in the face: write
`alignScopeToAxes(y)` before the call.
"""
HEADER = re.compile(r"/\*(.*?)\*/", re.S)
ANNOTATIONS = re.compile(r"^(?:@\w+(?:\([^()]*\))?\s*)+")
RULE = re.compile(r"^([A-Z]\w*)(?:\((.*?)\))?\s*-->")
ATTRIBUTE = re.compile(r"^attr\s+(\w+)\s*=\s*(.+)$")
DESCRIPTION = re.compile(r'@Description\("([^"]*)"\)')
CHOICES = re.compile(r"@Enum\(([^()]*)\)")
RANGE = re.compile(r"@Range\(\s*min\s*=\s*([-\d.]+)\s*,\s*max\s*=\s*([-\d.]+)")
IMPORT = re.compile(r'^import\s+(\w+)\s*:\s*"([^"]+)"', re.M)


def comments_above(lines, at):
    """The lines of `//` right above lines[at], annotations between them left out; lines that rule off sections are none."""
    out = []
    while at > 0 and (lines[at - 1].startswith("//") or lines[at - 1] and not ANNOTATIONS.sub("", lines[at - 1])):
        at -= 1
        text = lines[at].removeprefix("//").strip()
        if lines[at].startswith("//") and not text.startswith("---"):
            out.insert(0, text)
    return " ".join(out)


def annotations_of(lines, at):
    """The annotations of the declaration in lines[at]: those before it on its line, and the lines of them above."""
    before = ANNOTATIONS.match(lines[at])
    out = before[0] if before else ""
    while at > 0 and lines[at - 1].startswith("@") and not ANNOTATIONS.sub("", lines[at - 1]):
        at -= 1
        out = lines[at] + " " + out
    return out


def meaning(annotations, comment):
    """What an attribute means: what is written about it, then the values that it may have."""
    described = DESCRIPTION.search(annotations)
    parts = [t for t in (described[1] if described else "", comment) if t]
    if choices := CHOICES.search(annotations):
        parts.append(", ".join(f"`{c.strip()}`" for c in choices[1].split(",") if "=" not in c))
    elif limits := RANGE.search(annotations):
        parts.append(f"{limits[1]} to {limits[2]}")
    return "; ".join(parts)


def parameters(names, always):
    """`a`, `b = 3` as `(a, [b])`; nothing for a rule that takes none. Those from `always` on may be left out."""
    shown = [f"[{n.split('=')[0].strip()}]" if "=" in n or i >= always else n for i, n in enumerate(names)]
    return "(" + ", ".join(shown) + ")" if names else ""


def forms(lines):
    """{rule: (the most parameters that it is declared with, the number of the fewest)}."""
    found = {}
    for line in lines:
        if match := RULE.match(ANNOTATIONS.sub("", line)):
            names = [p.strip() for p in match[2].split(",")] if match[2] else []
            most, few = found.get(match[1], ([], len(names)))
            found[match[1]] = (max(most, names, key=len), min(few, len(names)))
    return found


def calls(files):
    """{file name: rules that other files call}, over all rule files of the examples."""
    called = {}
    for path, text in files.items():
        for name, imported in IMPORT.findall(text):
            target = imported.rpartition("/")[2]
            if target != path.name:
                called.setdefault(target, set()).update(re.findall(rf"\b{name}\.([A-Z]\w*)", text))
    return called


def section(path, text, called):
    """A file's header, attributes and rules."""
    lines = text.split("\n")
    header = HEADER.match(text)
    named = called | set(re.findall(r"`([A-Z]\w*)`", header[1])) if header else called
    declared = forms(lines)
    attributes, rules, seen = [], [], set()
    for at, line in enumerate(lines):
        comment = comments_above(lines, at)
        if match := ATTRIBUTE.match(ANNOTATIONS.sub("", line)):
            annotations = annotations_of(lines, at)
            value, _, beside = match[2].partition("//")
            if "@Hidden" not in annotations:
                attributes.append((f"`{match[1]}`", f"`{value.strip()}`", meaning(annotations, beside.strip())))
        elif (match := RULE.match(ANNOTATIONS.sub("", line))) and match[1] not in seen and (comment or match[1] in named):
            seen.add(match[1])
            rules.append((f"`{match[1]}{parameters(*declared[match[1]])}`", comment))
    out = f"## {path.name}\n\n"
    if header:
        out += " ".join(header[1].split()) + "\n\n"
    if attributes:
        out += table(("attribute", "default", "meaning"), attributes) + "\n"
    if rules:
        out += table(("rule", "what it makes"), rules) + "\n"
    return out


def rule_library(root):
    """The page's text."""
    files = {p: p.read_text(encoding="utf-8") for p in sorted((root / "examples").rglob("*.cga"))}
    called = calls(files)
    parts = [section(p, t, called.get(p.name, set())) for p, t in files.items() if p.parent == root / FOLDER]
    return INTRO + "\n" + "".join(parts).rstrip("\n") + "\n"
