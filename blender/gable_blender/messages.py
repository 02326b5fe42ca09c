# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""The messages of the program, as it prints them and as its JSON has them. Needs no Blender."""
import os
import re
from dataclasses import dataclass

HEAD = re.compile(r"(?:(?P<file>.+?):(?P<line>\d+):(?P<column>\d+): )?(?P<severity>error|warning): "
                  r"(?P<text>.*?)(?: \[(?P<code>[a-z0-9-]+)\])?$")
USAGE = re.compile(r"gable: (?P<text>.*)$")
# Folders above a rule file in which the files of its messages are looked for.
MOST_PARENTS = 8


@dataclass
class Message:
    severity: str
    text: str
    hint: str = ""
    file: str = ""
    line: int = 0
    code: str = ""

    def place(self):
        return f"{self.file}:{self.line}" if self.file and self.line else self.file

    def sentence(self):
        """What, where and the remedy, in one line."""
        place = self.place()
        return (f"{place}: " if place else "") + self.text + (f" ({self.hint})" if self.hint else "")


def of_text(text):
    """Those in what the program has printed to its standard error."""
    found = []
    for line in text.splitlines():
        head, usage = HEAD.match(line), USAGE.match(line)
        if head:
            found.append(Message(head["severity"], head["text"], "", head["file"] or "",
                                 int(head["line"] or 0), head["code"] or ""))
        elif usage:
            found.append(Message("error", usage["text"]))
        elif line.startswith("  hint: ") and found:
            found[-1].hint = line[len("  hint: "):]
    return found


def of_json(diagnostics):
    """Those of the member `diagnostics` of an answer in JSON."""
    return [Message(d.get("severity", "error"), d.get("message", ""), d.get("hint", ""), d.get("file", ""),
                    int(d.get("line", 0)), d.get("code", "")) for d in diagnostics]


def locate(file, rules):
    """The path of a message's file: messages name files below the project that the rules lie in."""
    if os.path.isabs(file):
        return file
    folder = os.path.dirname(os.path.abspath(rules))
    for _ in range(MOST_PARENTS):
        path = os.path.normpath(os.path.join(folder, file))
        if os.path.isfile(path):
            return path
        folder = os.path.dirname(folder)
    return ""


def ordered(messages):
    """Errors first; each once."""
    kept = {(m.severity, m.text, m.file, m.line): m for m in reversed(messages)}
    return sorted(reversed(list(kept.values())), key=lambda m: m.severity != "error")
