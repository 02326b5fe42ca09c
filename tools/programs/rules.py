# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Random rule files in Gable's own language, over all operations and functions that `gable ops --json` lists.

Calls have the right number of arguments of the right type, so that most programs derive; the values are hostile."""
import re

from programs.tree import Node, joined, optional

USUAL = ["0.5", "1", "2", "3", "4", "5", "7.5", "10", "30", "45", "90"]
HOSTILE = ["0", "-1", "-3", "-90", "1e308", "-1e308", "1e39", "1e19", "1e15", "1e-12", "1e-300", "(0/0)", "(1/0)",
           "(-1/0)", "89.9999999", "180", "360", "100000", "16777217", "2147483648", "-2147483649", "4294967296"]
TEXTS = ["", "a", "W", "wall", "house.obj", "missing.obj", "tex.png", "missing.png", "#aabbcc", "#zz", "0.5", "1e308",
         "nan", "a;b;c", "*", "/", "..", "\u00e9\U0001f4a5", "x y", "outer", "x" * 400]
# What operations on regions took as texts, and what they refuse.
FIGURES = ['"none"', '"circle(2)"', '"rect(3, 1)"', '"romb(0)"', '"outer"', '"inner"', '"all"', '"average(2)"',
           '"bezier"', '"(3, 4) (9, 4)"', '"0.2, 0.5"', '"[start : 2]"', '"{0.5, 2}"']
ARRAYS = {"float": ["[1, 2, 3]", "floatArray", "[6, 4; 3, 2; 1, 1]", "[0, 0, 9, 0, 9, 9]", "[1e308, -1, (0/0)]"],
          "bool": ["[true, false]", "boolArray"],
          "string": ['["a", "b"]', "stringArray", '["color.r", "0.5"]', '["shininess", "1e308"]']}
LEAVES = ["W.", "X.", "Y.", "Z.", "NIL", ""]
RULES = ["R1", "R2", "R3(n)"]
LOTS = ["30x24", "10x10", "9.5x7", "1000x2", "0.001x0.001", "1e6x1e6"]


class Rules:
    """One program: a rule file and the initial shapes that it is derived on."""

    extension = ".cga"

    def __init__(self, catalogue, random):
        self.catalogue, self.random = catalogue, random
        self.rank = -1
        self.by_result = {}
        for function in catalogue["functions"]:
            for overload in function["overloads"]:
                self.by_result.setdefault(overload["result"], []).append((function["name"], overload))
        for attribute in catalogue["attributes"]:
            self.by_result.setdefault(attribute["type"], []).append((attribute["name"], None))
        self.writable = [a for a in catalogue["attributes"] if a["writable"]]
        self.selectors = [s["name"] for s in catalogue["selectors"]]

    def program(self, number):
        """The program of a number has the operation of that number in it, so that all have their turn."""
        operations = self.catalogue["operations"]
        start = Node([self.sequence(3, operations[number % len(operations)])])
        rules = [Node(["attr h = 5\nattr w = 0.7\nf(x) = x * 0.5 + 1\n@StartRule\nLot -->", start, "\n"])]
        for self.rank, name in enumerate(RULES):
            rules.append(Node([f"{name} -->", self.body(2), "\n"], (f"{name} --> X.\n", "")))
        return Node(rules)

    def subject(self, number):
        """The operation that the program of a number is there for."""
        return self.catalogue["operations"][number % len(self.catalogue["operations"])]["name"]

    def shapes(self):
        return self.random.choice(LOTS[:3] * 3 + LOTS + ["shapes.geojson"] * 6 + ["solid.obj"])

    def chance(self, share):
        return self.random.random() < share

    def callable(self):
        """Mostly the rules below the present one: recursion ends at a limit only."""
        return [name.replace("n", "2") for name in (RULES if self.chance(0.05) else RULES[self.rank + 1:])]

    # --- Successors ---

    def body(self, depth):
        if depth > 0 and self.chance(0.15):
            return self.choice(depth)
        return self.sequence(depth)

    def choice(self, depth):
        branches = []
        weighted = self.chance(0.5)
        for _ in range(self.random.randint(1, 2)):
            head = f" {self.random.choice(['30', '0', '12.5'])}% :" if weighted else None
            condition = Node([head]) if head else Node([" case ", self.value("bool", 2), " :"])
            branches.append(optional(condition, self.sequence(depth - 1)))
        branches.append(Node([" else :", self.sequence(depth - 1)]))
        return Node(branches, (" X.",), "body")

    def sequence(self, depth, first=None):
        steps = [self.step(self.random.choice(self.catalogue["operations"]), depth)
                 for _ in range(self.random.randint(0, 3))]
        if first:
            steps.insert(self.random.randint(0, min(1, len(steps))), self.step(first, depth))
        leaf = self.random.choice([*LEAVES, *self.callable()])
        return Node([*steps, Node([" ", leaf], (" X.", ""))], (" X.",), "body")

    def step(self, operation, depth):
        if depth > 0 and self.chance(0.08):
            return Node([" [", self.body(depth - 1), " ]"], ("",))
        overload = self.random.choice(operation["overloads"])
        parts = [" ", operation["name"]]
        params = overload["params"]
        arguments = self.arguments(operation["name"], overload)
        if params or self.chance(0.7):
            parts += ["(", joined(arguments, ", "), ")"]
        if operation.get("block"):
            parts.append(self.block(operation, depth))
        return Node(parts, ("",))

    def arguments(self, name, overload):
        params = overload["params"]
        if name == "set":
            attribute = self.random.choice(self.writable)
            return [attribute["name"], self.value(attribute["type"], 2)]
        if name == "do":
            return [self.random.choice(self.callable() or ["R3(1)"])]
        if name == "local":
            return [f"h = {self.random.choice(USUAL)}"]
        needed = sum("default" not in p for p in params)
        count = self.random.randint(needed, len(params))
        given = [self.argument(p) for p in params[:count]]
        # Those that are left out between may be named.
        for param in params[count:]:
            if self.chance(0.1):
                given.append(Node([f"{param['name']} = ", self.argument(param)]))
        return given

    def block(self, operation, depth):
        kind = operation["block"]
        words = [p["name"] for p in operation.get("parts", [])]
        if "size" in kind:
            # Where sizes have parts beside them, each has a depth, and a second block takes what remains.
            rest = optional(self.parts(depth, words, False)) if words and self.chance(0.7) else ""
            return Node([self.sizes(depth, bool(words)), rest])
        if "selector" in kind:
            return self.parts(depth, words, operation.get("selectors", False))
        if "A | B" in kind:
            return Node([" { ", joined(["R1", "R2"], " | "), " }"])
        otherwise = [" |", " otherwise :", self.body(depth - 1)] if "otherwise" in kind and self.chance(0.3) else []
        inner = self.body(depth - 1) if depth > 0 else Node([" X."])
        return Node([" {", inner, optional(*otherwise), " }"])

    def parts(self, depth, words, selects):
        others = self.selectors if selects else [*words, "all"]
        items = []
        for _ in range(self.random.randint(1, 3)):
            word = self.random.choice(words) if words and self.chance(0.7) else self.random.choice(others)
            if self.chance(0.1):
                word = f"{word} || {self.random.choice(others)}"
            sign = self.random.choice([":", ":", ":", "="])
            figure = f" circle({self.random.choice(USUAL)})" if word in ("junction", "centre") else ""
            items.append(Node([f" {word} {sign}{figure}", self.body(depth - 1) if depth > 0 else " X."]))
        return Node([" {", joined(items, " |"), " }"])

    def sizes(self, depth, sections=False):
        items = []
        for _ in range(self.random.randint(1, 3)):
            size = Node([self.random.choice(["", "~", "'"]), self.number()], ("~1", "1"))
            deep = Node([" ", self.number(), " :"], (" 1 :",)) if sections else ""
            items.append(Node([" ", size, " :", deep, self.body(depth - 1) if depth > 0 else " X."]))
        if self.chance(0.2):
            size = f"{self.random.choice(USUAL)} :" + (f" {self.random.choice(USUAL)} :" if sections else "")
            items.append(Node([f" {{ {size}", self.body(depth - 1) if depth > 0 else " X.", " }*"]))
        return Node([" {", joined(items, " |"), " }*" if self.chance(0.3) else " }"])

    # --- Values ---

    def number(self):
        text = self.random.choice(USUAL if self.chance(0.8) else HOSTILE)
        return Node([text], ("1", "0"))

    def argument(self, param):
        kind = param["type"]
        # What is written out and out of range is a mistake that ends the run; a sum is not known
        # before.
        if "range" in param and kind == "float[]":
            return Node(["[", self.number(), " + 0 * h, ", self.number(), " + 0 * h]"], ("[1 + 0 * h]",))
        if "range" in param and kind != "selection" and not kind.endswith("[]"):
            return Node(["(", self.number(), " + 0 * h)"], ("(1 + 0 * h)",))
        if param["name"] in ("hexValue", "label", "tint", "group") and kind == "string":
            return '"#aabbcc"'
        if param["name"] == "name" and kind == "string":
            return '"brick.flemish"'
        if "words" in param and kind == "string":
            return f'"{self.random.choice(param["words"].split())}"'
        if "words" in param:
            words = param["words"].split()
            return self.random.choice(words)
        if kind == "selector":
            return self.random.choice(["outer", "inner", "all", "longest", "corner(outer)", "x", *self.selectors])
        if kind == "size":
            return Node([self.random.choice(["", "", "'"]), self.number()], ("1",))
        if kind == "floating size":
            return Node([self.random.choice(["", "~", "'"]), self.number()], ("1",))
        if kind == "drawn":
            return self.drawn()
        if kind == "drawn[]":
            items = [Node([self.random.choice(["", "", "~"]), self.drawn()], ("1",))
                     for _ in range(self.random.randint(1, 3))]
            return self.drawn() if self.chance(0.5) else Node(["[", joined(items, ", "), "]"], ("2",))
        if kind == "selection":
            return self.selection(param, 2)
        if kind == "any":
            return self.random.choice([self.value("float", 1), self.random.choice(FIGURES), "true", "[1, 2]"])
        if kind == "string" and self.chance(0.5):
            return self.random.choice(FIGURES)
        return self.value(kind, 2)

    def drawn(self):
        if self.chance(0.4):
            return Node(["rand(", self.number(), ", ", self.number(), ")"], ("1",))
        return self.calculation(1)

    def selection(self, param, depth):
        """Terms with && || ! - and brackets between them."""
        if depth > 0 and "single" not in param and self.chance(0.35):
            if self.chance(0.3):
                return Node(["!(", self.selection(param, depth - 1), ")"], ("all",))
            sign = self.random.choice([" && ", " || ", " - "])
            return Node(["(", self.selection(param, depth - 1), sign, self.selection(param, depth - 1), ")"])
        if self.chance(0.15):
            return self.random.choice([self.number(), "[5, -5, 15, -5]", "[0, 0; 0, 1; 1, 0]"])
        term = self.random.choice(param["terms"])
        arguments = [self.selection({"terms": p.get("terms", param["terms"])}, 0) if p["type"] == "selection"
                     else self.argument(p) for p in term["params"]]
        return Node([term["name"], "(", joined(arguments, ", "), ")"] if arguments else [term["name"]])

    def value(self, kind, depth):
        if depth > 0 and kind in self.by_result and self.chance(0.3):
            return self.call(kind, depth)
        if kind.endswith("[]"):
            return Node([self.random.choice(ARRAYS.get(kind[:-2], ["[1, 2]"]))])
        if kind == "bool":
            return self.condition(depth)
        if kind == "string":
            text = self.random.choice(TEXTS)
            return Node([f'"{text}"'], ('""',))
        if kind != "float":
            # A type that is new here: what most will take.
            return Node([self.random.choice(["all", "2", '"circle(2)"'])], ("2",))
        return self.calculation(depth)

    def condition(self, depth):
        if depth > 0 and self.chance(0.6):
            left, right = self.value("float", depth - 1), self.value("float", depth - 1)
            return Node(["(", left, self.random.choice([" < ", " > ", " == ", " != "]), right, ")"], ("true", "false"))
        return Node([self.random.choice(["true", "false"])])

    def calculation(self, depth):
        if depth > 0 and self.chance(0.25):
            left, right = self.value("float", depth - 1), self.value("float", depth - 1)
            sign = self.random.choice([" + ", " - ", " * ", " / ", " % "])
            return Node(["(", left, sign, right, ")"], ("1",), "float")
        if self.chance(0.1):
            return Node([self.random.choice(["h", "w", "f(2)", "scope.sx", "scope.sy"])], ("1",))
        return self.number()

    def call(self, kind, depth):
        name, overload = self.random.choice(self.by_result[kind])
        simple = {"float": ("1",), "bool": ("true",), "string": ('""',)}.get(kind, ())
        if overload is None:
            return Node([name], simple)
        if not overload["params"]:
            bare = re.fullmatch(r"geometry\.\w+|rand", name)
            return Node([name if bare else f"{name}()"], simple)
        arguments = [self.argument(p) if depth > 1 else self.simple(p) for p in overload["params"]]
        return Node([name, "(", joined(arguments, ", "), ")"], simple)

    def simple(self, param):
        if param["type"] in ("float", "bool", "string") and "words" not in param:
            return self.value(param["type"], 0)
        return self.argument(param)
