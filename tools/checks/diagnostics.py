# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Every code of a diagnostic or a status has a line in docs/reference/diagnostics.md, and the other way round. A hint
that says to raise a limit names an option of the command line that there is."""
import re

from .tree import Finding, line_at

PAGE = "docs/reference/diagnostics.md"
# A code is a kebab-case text that is the first argument of a call, or of a braced value, of such a name.
CODE = re.compile(r'\b(?:\w*(?:[eE]rror|[wW]arn|[wW]arning|[fF]ail|[fF]ailed|[fF]ailure|[nN]ote|Status|refuse|reject|over(?:Limit|Total))'
                  r'\w*\s*[({]+\s*(?:[\w.:]+,\s*)?|code = )"([a-z0-9]+(?:-[a-z0-9]+)+)"')
COMMANDS = "apps/gable/main.cpp"
OPTION = re.compile(r'add_option\("(--max-[a-z]+)"')
# Texts that stand one after the other are one.
JOINT = re.compile(r'"\s*\n\s*"')
RAISE = re.compile(r'raise [^"]*')
ROW = re.compile(r"^\| `([a-z0-9-]+)` \|", re.M)


def limits(tree):
    findings = []
    options = set(OPTION.findall(tree.text(COMMANDS))) if tree.exists(COMMANDS) else set()
    for path in tree.files(".cpp", ".h", under="src/"):
        if path.endswith("_test.cpp"):
            continue
        text = tree.text(path)
        joined = JOINT.sub("", text)
        for match in RAISE.finditer(joined):
            named = re.findall(r"--max-[a-z]+", match.group(0))
            if 'limit' not in match.group(0) and not named:
                continue
            if not named or any(option not in options for option in named):
                findings.append(Finding(path, 0, f"'{match.group(0).strip()[:60]}' names no option of the command line"))
    return findings


def check(tree):
    findings = limits(tree)
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
