# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""What Gable tells: mistakes of rules, files and requests."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Message:
    """One message, with its place and a remedy."""

    severity: str
    """"error", "warning" or "note"."""
    code: str
    """Stable; listed in the reference of diagnostics."""
    message: str
    """One sentence that names the thing."""
    hint: str
    """The remedy; may be empty."""
    text: str
    """The whole, as a terminal shows it."""
    path: str = ""
    """The rules from the initial shape down to where it happened."""
    file: str | None = None
    line: int | None = None
    """From 1."""
    column: int | None = None
    """From 1, in bytes of UTF-8."""

    def __str__(self) -> str:
        return self.text.rstrip("\n")


class Error(Exception):
    """Something went wrong. `messages` has all that was told, the errors first."""

    def __init__(self, messages: list[Message]):
        self.messages = sorted(messages, key=lambda m: m.severity != "error")
        super().__init__("\n".join(str(m) for m in self.messages if m.severity == "error"))


def messages_of(raw: list[dict[str, Any]]) -> list[Message]:
    return [Message(**m) for m in raw]


def checked(result: Any) -> Any:
    """The result, where it has no errors."""
    if not result.ok():
        raise Error(messages_of(result.messages()))
    return result


def at_least(name: str, value: Any, least: float) -> None:
    """Raises ValueError where a number is too small, or none."""
    if value is not None and not value >= least:
        raise ValueError(f"{name} is {least} or more, not {value!r}")


def above_zero(name: str, value: float) -> float:
    """The number; raises ValueError where it is none above 0."""
    if not 0 < value < float("inf"):
        raise ValueError(f"{name} is a number of metres above 0, not {value!r}")
    return value


def path_text(path: str | os.PathLike[str]) -> str:
    return os.fsdecode(path)
