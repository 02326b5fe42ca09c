# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Every code of a diagnostic or a status has a line in docs/reference/diagnostics.md, and the other way round."""
import re

from .tree import Finding, line_at

PAGE = "docs/reference/diagnostics.md"
# A code is a kebab-case text that is the first argument of a call, or of a braced value, of such a name.
CODE = re.compile(r'\b(?:\w*(?:[eE]rror|[wW]arn|[wW]arning|[fF]ail|[fF]ailed|[fF]ailure|[nN]ote|Status|refuse|reject|over(?:Limit|Total))'
                  r'\w*\s*[({]+\s*(?:[\w.:]+,\s*)?|code = )"([a-z0-9]+(?:-[a-z0-9]+)+)"')
ROW = re.compile(r"^\| `([a-z0-9-]+)` \|", re.M)


def check(tree):
    findings = []
    documented = set(ROW.findall(tree.text(PAGE))) if tree.exists(PAGE) else set()
    used = {}
    everything = ""
    for path in tree.files(".cpp", ".h", under="src/"):
        if path.endswith("_test.cpp") or "/testing" in path:
            continue
        text = tree.text(path)
        everything += text
        for match in CODE.finditer(text):
            used.setdefault(match.group(1), (path, line_at(text, match.start())))
    for code, (path, line) in sorted(used.items()):
        if code not in documented:
            findings.append(Finding(path, line, f"'{code}' has no line in {PAGE}", code))
    for code in sorted(documented):
        if f'"{code}"' not in everything:
            findings.append(Finding(PAGE, 0, f"no source has the code '{code}'", code))
    return findings
