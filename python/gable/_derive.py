# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""From rules and shapes to a model."""

from __future__ import annotations

import difflib
from collections.abc import Callable, Mapping
from typing import Any

from gable import _gable
from gable._messages import Message, at_least
from gable._model import Model
from gable._rules import Rules
from gable._shapes import Shapes


def derive(
    rules: Rules,
    shapes: Shapes,
    *,
    seed: float = 0,
    start_rule: str | None = None,
    attributes: Mapping[str, Any] | None = None,
    jobs: int | None = None,
    seconds: float | None = None,
    memory: int | None = None,
    progress: Callable[[int, int], None] | None = None,
    **more: Any,
) -> Model:
    """Derives rules on shapes.

    Attributes of the rules are given by name, as keywords or in `attributes`; they go before those
    of the shapes. The same rules, shapes, attributes and seed give the same model, with any number
    of `jobs` (threads; all processors by default). `seconds` and `memory` (bytes) are limits: what
    was made until one is reached is kept, and `is_whole` of the model is False.

    `progress` is called with the number of shapes that are done, and of all. Ctrl-C and what it
    raises end the derivation. Other threads of Python run meanwhile.

    Warnings are in `messages` of the model, and Python's `warnings` show each once as gable.Warning.
    """
    for name, value, kind in (("rules", rules, Rules), ("shapes", shapes, Shapes)):
        if not isinstance(value, kind):
            raise TypeError(f"{name} is a gable.{kind.__name__}, not {type(value).__name__}")
    at_least("jobs", jobs, 1)
    at_least("seconds", seconds, 0)
    at_least("memory", memory, 0)
    refuse_near(derive, rules, more)
    values = {**(attributes or {}), **more}
    return Model(
        _gable.derive(
            rules._raw,
            shapes._raw,
            attributes=values,
            seed=float(seed),
            start_rule=start_rule,
            jobs=jobs,
            seconds=seconds,
            memory=memory,
            progress=progress,
        ),
        len(shapes),
        _unknown(rules, shapes),
    )


def refuse_near(function: Callable[..., Any], rules: Rules, more: Mapping[str, Any]) -> None:
    """Raises TypeError for a keyword that is near to an option of a function, where the rules have no such attribute."""
    known = {attribute.name for attribute in rules.attributes}
    for name in more:
        near = difflib.get_close_matches(name, function.__kwdefaults__ or {}, 1)
        if near and name not in known and not difflib.get_close_matches(name, known, 1):
            raise TypeError(f"{function.__name__} has no {name!r}, and the rules have no such attribute; {near[0]!r} may be meant")


def _unknown(rules: Rules, shapes: Shapes) -> list[Message]:
    """A warning for names of attributes that shapes were given and the rules do not have."""
    known = [attribute.name for attribute in rules.attributes]
    names = sorted(shapes._named.difference(known, _OF_SHAPES))
    names = [name for name in names if not name.startswith("/edgeattr/")]
    if not names:
        return []
    near = {name: difflib.get_close_matches(name, known, 1) for name in names}
    meant = [f"{name} may be meant as {others[0]}" for name, others in near.items() if others]
    hint = "; ".join(meant) or f"the rules have {', '.join(known) or 'none'}"
    text = f"the rules have no attribute {', '.join(names)}, which shapes were given"
    return [Message("warning", "unknown-attribute", text, hint, f"warning[unknown-attribute]: {text}\n  hint: {hint}")]


_OF_SHAPES = ("startRule", "name", "id", "streetWidth", "cityPart", "cityObject", "cityStorey")
"""Names that mean something to every derivation."""
