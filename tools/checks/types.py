# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Two types of one name in one namespace, in two files, are one type to the linker: it keeps one of their constructors
and destructors, and says nothing. Types that one file uses alone belong in an unnamed namespace."""
import re

from .tree import CPP, Finding, code_of, line_at

NAMESPACE = re.compile(r"\b(?:inline\s+)?namespace\b(?:\s+([\w:]+))?\s*$")
TYPE = re.compile(r"^\s*(?:template\s*<[^;{}]*>\s*)?(?:struct|class|union|enum(?:\s+(?:struct|class))?)"
                  r"(?:\s*\[\[[^\]]*\]\]|\s+alignas\s*\([^()]*\))*\s+(\w+)\s*(?:final\s*)?(?::(?!:)[^;{}]*)?$", re.S)
DIRECTIVE = re.compile(r"^[ \t]*#(?:[^\n\\]|\\.|\\\n)*", re.M)


def types_of(text):
    """(qualified name, offset) of each type that is defined in a named namespace."""
    text = DIRECTIVE.sub(lambda match: re.sub(r"[^\n]", " ", match.group(0)), code_of(text))
    # The namespaces that are open; None for any other brace and for unnamed ones, whose insides do not count.
    opened, start = [], 0
    for match in re.finditer(r"[{};]", text):
        sign, head = match.group(0), text[start:match.start()]
        start = match.end()
        if sign == "{":
            space, named = NAMESPACE.search(head), TYPE.match(head)
            if named and None not in opened:
                yield "::".join([*opened, named.group(1)]), match.start()
            opened.append(space.group(1) if space else None)
        elif sign == "}" and opened:
            opened.pop()


def check(tree):
    first, findings = {}, []
    for path in sorted(tree.files(*CPP, under="src/")):
        for name, offset in types_of(tree.text(path)):
            known = first.setdefault(name, path)
            if known != path:
                findings.append(Finding(path, line_at(tree.text(path), offset),
                                        f"'{name}' is a type of {known} as well; name it otherwise, or put it into an "
                                        "unnamed namespace", path))
    return findings
