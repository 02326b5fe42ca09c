# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Links and pictures in Markdown files point to what is there, and pages for users stay out of the source."""
import posixpath
import re
from urllib.parse import unquote

from .tree import Finding, line_at

LINK = re.compile(r"\[(?:[^\[\]]|\[[^\]]*\])*\]\(\s*<?([^()\s<>]+)>?(?:\s+\"[^\"]*\")?\s*\)"
                  r"|<img[^>]*\bsrc=\"([^\"]+)\"|^\[[^\]]+\]:\s*(\S+)", re.M)
# Pages for users, which show pictures from the source but do not send anybody there.
USER = re.compile(r"docs/(guide|reference)/|examples/|README\.md$")
CODE = re.compile(r"^(```|~~~).*?^\1[ \t]*$|`[^`\n]+`", re.M | re.S)


def anchors(text):
    """The names that a heading gets on the usual viewers."""
    found = set()
    for heading in re.findall(r"^#{1,6}[ \t]+(.*?)[ \t#]*$", _outside_code(text, fences_only=True),
                              re.M):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").lower()
        name = re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")
        count = 0
        unique = name
        while unique in found:
            count += 1
            unique = f"{name}-{count}"
        found.add(unique)
    return found


def _outside_code(text, fences_only=False):
    def blank(match):
        if fences_only and not match.group(1):
            return match.group(0)
        return re.sub(r"[^\n]", " ", match.group(0))
    return CODE.sub(blank, text)


def check(tree):
    findings = []
    for path in tree.files(".md"):
        text = _outside_code(tree.text(path))
        for match in LINK.finditer(text):
            link = next(g for g in match.groups() if g)
            if re.match(r"[a-z][a-z0-9+.-]*:", link):
                continue
            line = line_at(text, match.start())
            target, _, anchor = link.partition("#")
            full = posixpath.normpath(posixpath.join(posixpath.dirname(path), unquote(target)))
            if not target:
                full = path
            if full.startswith("..") or not tree.exists(full):
                findings.append(Finding(path, line, f"no file {link}", path))
            elif USER.match(path) and full.startswith("src/") and not full.endswith(".png"):
                findings.append(Finding(path, line, f"{full} is no page for users", path))
            elif anchor and full.endswith(".md") and anchor not in anchors(tree.text(full)):
                findings.append(Finding(path, line, f"no heading #{anchor} in {full}", path))
    return findings
