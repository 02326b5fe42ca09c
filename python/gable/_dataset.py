# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Data sets for learning."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from gable import _gable
from gable._derive import refuse_near
from gable._messages import Error, Message, messages_of, one_of, path_text, warn_of
from gable._model import LIGHTING
from gable._rules import Rules
from gable._shapes import Shapes

_WORDS = {"placing": ("orbit", "sampled"), "labels": ("rule", "label", "tag"), "format": ("coco", "json"),
          "lighting": LIGHTING}


@dataclass(frozen=True)
class Dataset:
    """What `dataset` has made."""

    folder: str
    items: int
    """All that were asked for."""
    made: int
    """Those that this call has made."""
    done: int
    """Those that are there now."""
    is_whole: bool
    """All are there, and the list of them."""
    messages: list[Message]


def dataset(
    rules: Rules,
    shapes: Shapes,
    folder: str | os.PathLike[str],
    *,
    count: int = 1,
    cameras: int = 4,
    seed: float = 0,
    placing: str = "orbit",
    zoom: float = 1,
    labels: str = "rule",
    tags: Sequence[str] = (),
    format: str = "coco",
    model: str | None = "glb",
    size: tuple[int, int] = (512, 512),
    samples: int = 16,
    lighting: str = "paths",
    sun: tuple[float, float] | None = None,
    field_of_view: float | None = None,
    pitch: float | None = None,
    start_rule: str | None = None,
    attributes: Mapping[str, Any] | None = None,
    shard: tuple[int, int] | None = None,
    jobs: int | None = None,
    seconds: float | None = None,
    progress: Callable[[int, int], None] | None = None,
    **more: Any,
) -> Dataset:
    """Makes labelled pictures of `count` seeds, from `seed` on, by `cameras` cameras each.

    `placing` of cameras is "orbit" or "sampled"; `zoom` 2 shows half of what 1 does; `labels` are by "rule", "label" (@Label) or
    "tag", of which `tags` names those that count, the first ones first; the `format` of the list is
    "coco" or "json"; `model` is the extension of the mesh of each seed, or
    None; `lighting` is by "paths" or "direct", which is many times faster. What is in the folder already is kept, so that a call that was stopped goes on, and other
    processes may work on the folder at the same time. `shard` (i, n) makes every n-th seed alone.

    Attributes of the rules, `jobs`, `progress` and Ctrl-C are as in `derive`.
    """
    refuse_near(dataset, rules, more)
    words = {"placing": placing, "labels": labels, "format": format, "lighting": lighting}
    for name, word in words.items():
        one_of(name, word, _WORDS[name])
    for name, number in (("count", count), ("cameras", cameras)):
        if number < 1:
            raise ValueError(f"{name} is 1 or more, not {number!r}")
    options = {
        **words,
        "tags": list(tags),
        "count": count,
        "cameras": cameras,
        "zoom": float(zoom),
        "seed": float(seed),
        "model": model,
        "width": size[0],
        "height": size[1],
        "samples": samples,
        "sun": sun,
        "field_of_view": field_of_view,
        "pitch": pitch,
        "start_rule": start_rule,
        "attributes": {**(attributes or {}), **more},
        "shard": shard,
        "jobs": jobs,
        "seconds": seconds,
    }
    result = _gable.dataset(rules._raw, shapes._raw, path_text(folder), options, progress)
    messages = messages_of(result.pop("messages"))
    if not result.pop("ok"):
        raise Error(messages)
    warn_of(messages)
    return Dataset(folder=path_text(folder), messages=messages, **result)
