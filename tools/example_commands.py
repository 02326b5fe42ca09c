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


# Endings of model files by the kind of the command that writes them.
MODELS = {"generate": "glb", "obj": "obj", "usd": "usdz", "cityjson": "city.json", "ifc": "ifc"}
KINDS = (*MODELS, "render", "tiles", "dataset", "test")


def rule_test(name, arguments, out):
    """A rule test that derives the example, in a file beside `out`; None where its shapes are no lot."""
    options = dict(zip(arguments, arguments[1:]))
    if "--shapes" in options:
        return None
    text = (f"== {name.replace('/', '_')}\nrules: {ROOT / arguments[0]}\nshape: lot {options.get('--lot', '20x20')}\n"
            f"seed: {options.get('--seed', '0')}\nexpect:\n  leaves 1..1000000000\n  coplanar 0..1000000000\n")
    file = out.parent / "example.test"
    file.write_text(text, encoding="utf-8")
    return file


def commands(gable, name, out, kinds):
    """Commands that make the example: (kind, arguments). What they write lies in the folder `out`."""
    if found := said('example_map "$1"', name):
        more = said('words "examples/$1/generate.args"', name)
        made = {kind: [gable, "city", *found, *more, "-o", out / f"out.{ending}"] for kind, ending in MODELS.items()}
        made["render"] = [gable, "city", *found, *more, "--picture", out / "out.png"]
        made["tiles"] = [gable, "city", *found, *more, "-o", f"{out}/tiles/"]
    else:
        arguments = said('derive_arguments "$1"', name)
        view = said('words "examples/$1/picture.args"', name)
        made = {kind: [gable, "generate", *arguments, "-o", out / f"out.{ending}"] for kind, ending in MODELS.items()}
        made["render"] = [gable, "render", *arguments, *view, "-o", out / "out.png"]
        made["dataset"] = [gable, "dataset", *arguments, "--count", "2", "-o", out / "dataset"]
        if test := "test" in kinds and rule_test(name, arguments, out):
            made["test"] = [gable, "test", test]
        # Tiles have no lots: a lot is one shape.
        if "--lot" not in arguments and "--shapes" in arguments:
            made["tiles"] = [gable, "tiles", *arguments, "-o", out / "tiles"]
    return [(kind, [str(a) for a in made[kind]]) for kind in kinds if kind in made]
