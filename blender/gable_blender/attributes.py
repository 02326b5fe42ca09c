# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""The attributes of rules as controls of a panel, from what `gable info --json` tells. Needs no Blender."""
import json
import math
import re
from dataclasses import dataclass, field

# Kinds of controls.
NUMBER, WHOLE, FLAG, TEXT, COLOR, CHOICE, FILE, FOLDER = (
    "number", "whole", "flag", "text", "color", "choice", "file", "folder")
# Past all that have an order.
LAST = 1e9
# What a slider of Blender takes.
WIDEST = 1e9
HEX = re.compile(r"#[0-9a-fA-F]{6}([0-9a-fA-F]{2})?$")


@dataclass
class Control:
    name: str
    label: str
    kind: str
    group: str = ""
    description: str = ""
    minimum: float = -WIDEST
    maximum: float = WIDEST
    # Whether it has both ends, which a slider needs.
    bounded: bool = False
    step: float = 0.0
    choices: list = field(default_factory=list)
    # What the rules say for the first lot; None where that is not known before they run.
    default: object = None


def label_of(name):
    """"Wall height" of "wallHeight"; the import stays in front: "towers: Sides"."""
    *places, last = name.split(".")
    words = re.sub(r"(?<=[a-z0-9])(?=[A-Z])|_+", " ", last).strip()
    label = (words[:1].upper() + words[1:].lower()) if words else name
    return ": ".join([*places, label])


def _number(text):
    try:
        value = float(text)
    except (TypeError, ValueError):
        return None
    return value if abs(value) <= WIDEST else None


def _annotations(attribute):
    """{name: (unnamed arguments, named arguments)}; of several of one name the last."""
    found = {}
    for annotation in attribute.get("annotations", []):
        unnamed = [value for key, value in annotation["arguments"] if not key]
        found[annotation["name"]] = (unnamed, {k: v for k, v in annotation["arguments"] if k})
    return found


def _kind(attribute, annotations, default):
    kind = attribute["type"]
    if kind.endswith("]"):
        return TEXT
    if "Enum" in annotations and annotations["Enum"][0]:
        return CHOICE
    if kind == "bool":
        return FLAG
    if kind == "float":
        step = _number(annotations.get("Range", ([], {}))[1].get("stepsize"))
        whole = step is not None and step >= 1 and step == int(step)
        return WHOLE if whole and (default is None or float(default).is_integer()) else NUMBER
    if "Color" in annotations:
        return COLOR if default is None or HEX.match(str(default)) else TEXT
    if "File" in annotations:
        return FILE
    return FOLDER if "Directory" in annotations else TEXT


def _set_range(control, annotation):
    unnamed, named = annotation
    low, high, step = (_number(named.get(key, unnamed[i] if i < len(unnamed) else None))
                       for i, key in enumerate(("min", "max", "stepsize")))
    if low is not None and high is not None and low > high:
        return
    control.minimum = control.minimum if low is None else low
    control.maximum = control.maximum if high is None else high
    control.bounded = low is not None and high is not None
    control.step = step or 0.0


def _place(annotations):
    """What controls are ordered by, before their place in the file; and the group's name."""
    names, named = annotations.get("Group", ([], {}))
    group_order = _number(named.get("order"))
    order = _number((annotations.get("Order", ([], {}))[0] or [None])[0])
    return (LAST if group_order is None else group_order, LAST if order is None else order), " / ".join(names)


def controls(info):
    """Those of all attributes that are not hidden, in the order in which a panel shows them."""
    found = []
    values = info.get("values", {})
    for number, attribute in enumerate(info.get("attributes", [])):
        if attribute.get("hidden"):
            continue
        annotations = _annotations(attribute)
        name = attribute["name"]
        default = values.get(name)
        control = Control(name, label_of(name), _kind(attribute, annotations, default), default=default)
        control.choices = list(dict.fromkeys(annotations.get("Enum", ([], {}))[0]))
        control.description = " ".join(annotations.get("Description", ([], {}))[0])
        if "Range" in annotations:
            _set_range(control, annotations["Range"])
        (group_order, order), control.group = _place(annotations)
        # Without a group, an import's attributes stand together.
        if not control.group and "." in name:
            control.group = label_of(name.rpartition(".")[0])
        found.append(((group_order, control.group if group_order < LAST else "", order, number), control))
    ordered = [control for _, control in sorted(found, key=lambda pair: pair[0])]
    # A group stands where its first attribute does, and is shown once.
    places = {}
    for control in ordered:
        places.setdefault(control.group, len(places))
    return sorted(ordered, key=lambda control: places[control.group])


def text_of(value):
    """A value as `--set NAME=VALUE` and choices have it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(int(value)) if float(value).is_integer() else repr(round(float(value), 6))
    return value if isinstance(value, str) else json.dumps(value)


def color_of(text):
    """(red, green, blue) from 0 to 1 of "#rrggbb"; white where it is none."""
    if not HEX.match(text or ""):
        return (1.0, 1.0, 1.0)
    return tuple(int(text[i:i + 2], 16) / 255 for i in (1, 3, 5))


def hex_of(color):
    return "#" + "".join(f"{min(255, max(0, round(c * 255))):02x}" for c in color[:3])


def value_of_color(color):
    """"#rrggbb" of (red, green, blue) from 0 to 1; NaN where one of them is infinite or no number."""
    return hex_of(color) if all(map(math.isfinite, color[:3])) else math.nan


def start_rules(info):
    """The names of rules to start with, the one that the rules prefer first."""
    first = info.get("startRule", "")
    others = [rule["name"] for rule in info.get("rules", [])
              if rule["parameters"] == 0 and not rule["hidden"] and (rule["start"] or "." not in rule["name"])]
    return list(dict.fromkeys(([first] if first else []) + others))
