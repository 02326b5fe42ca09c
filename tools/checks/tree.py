# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""The files of a repository, what in a C++ file is code and what comment, and findings about them."""
import os
import re
import subprocess
from dataclasses import dataclass
from pathlib import Path

CPP = (".cpp", ".h", ".hpp", ".cc")
PICTURES = (".png", ".jpg", ".jpeg", ".gif", ".webp")
# What others wrote and we build; what a build makes or fetches.
COPIES = "third_party/"
FOREIGN = ("build/", "out/", "node_modules/", ".git/")


@dataclass(frozen=True)
class Finding:
    """Something a check objects to. `subject` is what an exception has to name."""
    path: str
    line: int
    message: str
    subject: str = ""

    def __str__(self):
        place = f"{self.path}:{self.line}" if self.line else self.path
        return f"{place}: {self.message}"


class Tree:
    """A repository, or a folder that looks like one."""

    def __init__(self, root):
        self.root = Path(root).resolve()
        listed = sorted(p for p in self._listed() if not self._foreign(p))
        self.paths = [p for p in listed if not p.startswith(COPIES)]
        # Few checks ask for these.
        self.copies = [p for p in listed if p.startswith(COPIES)]

    def _foreign(self, path):
        return path.startswith(FOREIGN) or "/node_modules/" in path

    def _listed(self):
        """What git tracks or would track; all files where git does not answer."""
        try:
            answer = subprocess.run(
                ["git", "-c", f"safe.directory={self.root}", "ls-files", "-z", "-co",
                 "--exclude-standard"],
                cwd=self.root, capture_output=True, check=False)
            top = (self.root / ".git").exists()
        except OSError:
            top = False
        if top and answer.returncode == 0:
            names = answer.stdout.decode().split("\0")
            return [n for n in set(names) if n and (self.root / n).is_file()]
        found = []
        for folder, folders, files in os.walk(self.root):
            at = Path(folder).relative_to(self.root)
            folders[:] = [f for f in folders if not self._foreign((at / f).as_posix() + "/")]
            found += [(Path(folder) / f).relative_to(self.root).as_posix() for f in files]
        return found

    def files(self, *suffixes, under=""):
        return [p for p in self.paths if p.endswith(suffixes) and p.startswith(under)]

    def text(self, path):
        return (self.root / path).read_text(encoding="utf-8", errors="surrogateescape")

    def exists(self, path):
        return (self.root / path).exists()

    def size(self, path):
        return (self.root / path).stat().st_size


# Comment, raw string, string, character, in the order in which they have to be tried. A quote between
# digits separates them and opens no character.
_TOKEN = re.compile(
    r"""(?P<comment>//(?:\\\n|[^\n])*|/\*.*?\*/)
      |(?P<raw>\bu?8?[LU]?R"(?P<mark>[^()\\\s]{0,16})\(.*?\)(?P=mark)")
      |(?P<string>"(?:\\.|[^"\\\n])*")
      |(?<![0-9a-fA-F])(?P<char>'(?:\\.|[^'\\\n])+')""", re.S | re.X)


def _blank(text):
    return re.sub(r"[^\n]", " ", text)


def code_of(text):
    """The text with comments and the insides of literals blanked; lines and columns stay."""
    def replace(match):
        whole = match.group(0)
        if match.group("comment"):
            return _blank(whole)
        return whole[0] + _blank(whole[1:-1]) + whole[-1] if len(whole) > 1 else whole
    return _TOKEN.sub(replace, text)


def comments_of(text):
    """(line, comment) of each comment."""
    for match in _TOKEN.finditer(text):
        if match.group("comment"):
            yield text.count("\n", 0, match.start()) + 1, match.group("comment")


def strings_of(text):
    """(offset, inside) of each string literal."""
    for match in _TOKEN.finditer(text):
        if match.group("string"):
            yield match.start(), match.group("string")[1:-1]


def line_at(text, offset):
    return text.count("\n", 0, offset) + 1
