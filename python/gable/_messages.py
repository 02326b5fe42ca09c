# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""What Gable tells: mistakes of rules, files and requests."""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Iterable
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


class Warning(UserWarning):
    """What Gable tells besides errors, through Python's `warnings`: `message` has all of it.

    Its place is that in the rules, where there is one, so that Python shows each once.
    """

    def __init__(self, message: Message):
        self.message = message
        within = f" (in {message.path})" if message.path else ""
        hint = f"; {message.hint}" if message.hint else ""
        super().__init__(f"{message.message}{within}{hint} [{message.code}]")


_shown: dict[Any, Any] = {}
"""What Python's filters have let through."""


def _caller() -> tuple[str, int]:
    """File and line of what called this package."""
    frame = sys._getframe(1)
    while frame.f_back and frame.f_globals.get("__name__", "").split(".")[0] == "gable":
        frame = frame.f_back
    return frame.f_code.co_filename, frame.f_lineno


def warn_of(messages: Iterable[Message]) -> None:
    """Hands the warnings among the messages to Python's `warnings`."""
    for message in messages:
        if message.severity != "warning":
            continue
        file, line = (message.file, message.line) if message.file and message.line else _caller()
        warnings.warn_explicit(Warning(message), Warning, file, line, module="gable", registry=_shown)


def messages_of(raw: list[dict[str, Any]]) -> list[Message]:
    return [Message(**m) for m in raw]


def checked(result: Any) -> Any:
    """The result, where it has no errors."""
    if not result.ok():
        raise Error(messages_of(result.messages()))
    return result


def told(result: Any) -> Any:
    """The same of what has just been made: its warnings are told."""
    warn_of(messages_of(checked(result).messages()))
    return result


def at_least(name: str, value: Any, least: float) -> None:
    """Raises ValueError where a number is too small, or none."""
    if value is not None and not value >= least:
        raise ValueError(f"{name} is {least} or more, not {value!r}")


def one_of(name: str, word: str, words: Iterable[str]) -> None:
    """Raises ValueError where a word is none of those."""
    if word not in words:
        raise ValueError(f"{name} is one of {', '.join(words)}, not {word!r}")


def above_zero(name: str, value: float) -> float:
    """The number; raises ValueError where it is none above 0."""
    if not 0 < value < float("inf"):
        raise ValueError(f"{name} is a number of metres above 0, not {value!r}")
    return value


def path_text(path: str | os.PathLike[str]) -> str:
    return os.fsdecode(path)
