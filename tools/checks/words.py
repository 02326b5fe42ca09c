# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""SPDX heads, comments in ASCII, and names and words that have no place in the files."""
import re

from .tree import CPP, Finding, comments_of

HEAD = ("SPDX-License-Identifier: Apache-2.0", "SPDX-FileCopyrightText: The Gable authors")
WITH_HEAD = (*CPP, ".py", ".sh", ".mjs", ".ts")
TEXT = (*CPP, ".py", ".sh", ".mjs", ".ts", ".svelte", ".cmake", ".txt", ".md", ".toml", ".json",
        ".cga", ".test", ".yml", ".yaml")
# (what, why): a path of one machine means nothing on another; a note to oneself is not finished work;
# a number of a ticket says nothing to a reader.
FORBIDDEN = [
    (re.compile(r"(?<![\w./$}])/(?:work|home|Users)/\w"), "a path of one machine"),
    (re.compile(r"\b(?:TO" r"DO|FIX" r"ME|XX" r"X|HA" r"CK)\b"), "a note to oneself"),
    (re.compile(r"\b(?:issue|ticket|task) #?\d+\b", re.I), "the number of a ticket"),
    (re.compile(r"^(?:<{7}|>{7}|={7})(?: |$)", re.M), "a mark of an unfinished merge"),
]


def scripts(tree):
    """Files without a suffix that are scripts, by their first line."""
    return [p for p in tree.paths if "." not in p.rsplit("/", 1)[-1]
            and (tree.root / p).open("rb").read(2) == b"#!"]


def check(tree):
    findings = []
    # A program that takes its first argument for a folder makes such a path of an option.
    findings += [Finding(path, 0, "a path that reads as an option", path)
                 for path in tree.paths if any(part.startswith("-") for part in path.split("/"))]
    shell = scripts(tree)
    for path in tree.files(*WITH_HEAD) + shell:
        first = tree.text(path).split("\n", 4)[:3]
        if not all(any(line.endswith(h) for line in first) for h in HEAD):
            findings.append(Finding(path, 1, "the two SPDX lines are missing", path))
    for path in tree.files(*CPP):
        for line, comment in comments_of(tree.text(path)):
            if not comment.isascii():
                findings.append(Finding(path, line, "a comment that is not ASCII", path))
    for path in tree.files(*TEXT) + shell:
        text = tree.text(path)
        for pattern, why in FORBIDDEN:
            for match in pattern.finditer(text):
                line = text.count("\n", 0, match.start()) + 1
                findings.append(Finding(path, line, f"'{match.group(0)}' is {why}", path))
    return findings
