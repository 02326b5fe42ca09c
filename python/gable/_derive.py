# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""From rules and shapes to a model."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from gable import _gable
from gable._messages import at_least
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
    """
    for name, value, kind in (("rules", rules, Rules), ("shapes", shapes, Shapes)):
        if not isinstance(value, kind):
            raise TypeError(f"{name} is a gable.{kind.__name__}, not {type(value).__name__}")
    at_least("jobs", jobs, 1)
    at_least("seconds", seconds, 0)
    at_least("memory", memory, 0)
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
    )
