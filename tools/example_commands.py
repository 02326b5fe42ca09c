# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""The examples as commands of gable, by the functions of tools/examples.sh."""
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def said(text, *arguments):
    """The lines that functions of tools/examples.sh print."""
    done = subprocess.run(["bash", "-c", f". tools/examples.sh; {text}", "bash", *arguments], cwd=ROOT, capture_output=True,
                          text=True, check=True)
    return done.stdout.splitlines()


def names():
    return said("example_names; park_names; place_names")


def commands(gable, name, out, kinds):
    """Commands that make the example: (kind, arguments). What they write lies in the folder `out`."""
    if found := said('example_map "$1"', name):
        more = said('words "examples/$1/generate.args"', name)
        made = {"generate": [gable, "city", *found, *more, "-o", out / "out.glb"],
                "tiles": [gable, "city", *found, *more, "-o", f"{out}/tiles/"]}
    else:
        arguments = said('derive_arguments "$1"', name)
        view = said('words "examples/$1/picture.args"', name)
        made = {"generate": [gable, "generate", *arguments, "-o", out / "out.glb"],
                "render": [gable, "render", *arguments, *view, "-o", out / "out.png"]}
        # Tiles have no lots: a lot is one shape.
        if "--lot" not in arguments and "--shapes" in arguments:
            made["tiles"] = [gable, "tiles", *arguments, "-o", out / "tiles"]
    return [(kind, [str(a) for a in made[kind]]) for kind in kinds if kind in made]
