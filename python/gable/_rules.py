# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Rule files."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from gable import _gable
from gable._messages import Message, messages_of, path_text, told

Annotation = tuple[str, dict[str, Any]]


@dataclass(frozen=True)
class Attribute:
    """An attribute that a caller may set."""

    name: str
    type: str
    """"float", "bool", "string", or one of these with "[]"."""
    hidden: bool
    annotations: list[Annotation]
    """Name and arguments: ("Range", {"min": "0", "max": "10"}). Those without a name are a list:
    ("Enum", {"": ["flat", "gable"]})."""

    @property
    def choices(self) -> list[str]:
        """The values of @Enum; empty without it."""
        return [v for name, arguments in self.annotations if name == "Enum" for v in arguments.get("", [])]

    @property
    def range(self) -> tuple[float, float] | None:
        """The least and the largest value of @Range, where it has both."""
        for name, arguments in self.annotations:
            if name != "Range":
                continue
            values = arguments.get("", [])
            low, high = arguments.get("min", values[0] if values else None), arguments.get("max")
            if high is None and len(values) > 1:
                high = values[1]
            try:
                return (float(low), float(high)) if low is not None and high is not None else None
            except ValueError:
                return None
        return None


@dataclass(frozen=True)
class Rule:
    """A rule of the file or of one that it imports."""

    name: str
    parameters: int
    start: bool
    """Marked as one to start with."""
    hidden: bool
    file: str
    line: int
    annotations: list[Annotation]


class Rules:
    """A rule file with all that it imports, compiled: CGA, or another notation that Gable reads."""

    def __init__(self, raw: Any):
        self._raw = told(raw)

    @classmethod
    def load(
        cls,
        path: str | os.PathLike[str],
        *,
        style: str | None = None,
        project: str | os.PathLike[str] | None = None,
        notation: str | None = None,
        workspace: str | os.PathLike[str] | None = None,
        libraries: Iterable[str | os.PathLike[str]] = (),
    ) -> Rules:
        """Reads a rule file (.cga, .park, .gbbg, ...) or a package (.rpk, .zip).

        `project` is the folder that rules may read from; without it the one that the file lies in
        is found as on the command line. Files of other projects are read from `workspace`, a folder
        of projects, and from `libraries`, each a folder or "NAME=FOLDER"; "/gable/rules/trees.cga"
        and its like come with the module. Raises Error with all mistakes of the rules.
        """
        place = _search(project, workspace, libraries)
        return cls(_gable.Rules.load(path_text(path), *place, notation, style))

    @classmethod
    def parse(
        cls,
        text: str,
        path: str | os.PathLike[str] = "rules.cga",
        *,
        style: str | None = None,
        project: str | os.PathLike[str] | None = None,
        notation: str | None = None,
        workspace: str | os.PathLike[str] | None = None,
        libraries: Iterable[str | os.PathLike[str]] = (),
    ) -> Rules:
        """The same for text in memory; `path` names it in messages and places it in the project."""
        place = _search(project, workspace, libraries)
        return cls(_gable.Rules.parse(text, path_text(path), *place, notation, style))

    @property
    def messages(self) -> list[Message]:
        """Warnings and notes. Python's `warnings` have shown the warnings."""
        return messages_of(self._raw.messages())

    @property
    def attributes(self) -> list[Attribute]:
        """Those that a caller may set, of imported files too."""
        return [Attribute(**a) for a in self._raw.attributes()]

    @property
    def rules(self) -> list[Rule]:
        """Those of the file and of all that it imports."""
        return [Rule(**r) for r in self._raw.rules()]

    @property
    def styles(self) -> list[str]:
        """Names for `style`."""
        return self._raw.styles()

    @property
    def start_rule(self) -> str | None:
        """The rule that a derivation starts with unless told otherwise."""
        return self._raw.start_rule()

    def __repr__(self) -> str:
        return f"<gable.Rules, starts with {self.start_rule}>"


def _search(project: Any, workspace: Any, libraries: Iterable[Any]) -> tuple[Any, Any, list[str], Any]:
    """Where rules may read files: the project, the workspace, libraries, and what comes with Gable."""

    def text(folder: Any) -> str | None:
        return None if folder is None else path_text(folder)

    return text(project), text(workspace), [path_text(p) for p in libraries], text(_bundled())


def _bundled() -> Path | None:
    """The rules that come with Gable: beside the module, or in the tree that it was built in."""
    here = Path(__file__).resolve()
    for folder in (here.parent / "bundled", *(p / "examples" for p in list(here.parents)[4:5])):
        if (folder / "rules" / "city.cga").exists():
            return folder
    return None
