# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Command lines of the program `gable`. Needs no Blender."""
from dataclasses import dataclass, field


@dataclass
class Wishes:
    """What a derivation is asked for; empty words leave the choice to the rules."""
    rules: str
    start: str = ""
    style: str = ""
    seed: int = 0
    # {name: text}; the values that a person chose, not those of the rules.
    attributes: dict = field(default_factory=dict)
    seconds: int = 600
    megabytes: int = 4096


# Whatever the environment asks for: messages are read line by line.
PLAIN = "--color=never"


def _common(wishes, shapes):
    line = [PLAIN, f"--shapes={shapes}", f"--seed={wishes.seed}", f"--max-seconds={wishes.seconds}",
            f"--max-memory={wishes.megabytes}"]
    if wishes.start:
        line.append(f"--start={wishes.start}")
    if wishes.style:
        line.append(f"--style={wishes.style}")
    return line + [f"--set={name}={value}" for name, value in wishes.attributes.items()]


def generate(program, wishes, shapes, model, statistics):
    # Large files round what a vertex says by default; what is edited further keeps its exact places.
    return [program, "generate", *_common(wishes, shapes), "--vertices=float", f"--output={model}",
            f"--stats={statistics}", "--", wishes.rules]


def info(program, wishes, shapes):
    return [program, "info", "--json", *_common(wishes, shapes), "--", wishes.rules]


def check(program, wishes):
    return [program, "check", "--json", PLAIN, f"--max-seconds={wishes.seconds}",
            f"--max-memory={wishes.megabytes}", "--", wishes.rules]
