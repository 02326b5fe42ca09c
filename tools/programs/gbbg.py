# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Random GBBG grammars."""
from programs.tree import Node, joined, optional

NUMBERS = ["1", "2", "3", "0.5", "4.5", "10", "30"]
HOSTILE = ["0", "-1", "1e308", "-1e308", "1e39", "1e-12", "90", "180", "1000000"]
SYMBOLS = ["A", "B", "C", "D", "Wall", "Slab", "EMPTY"]
STARTS = ["axiom START size (12, 10, 9)\n", "axiom START at (1, 2, 3) rotate (0, 30, 0) size (8, 8, 8)\n",
          "axiom START on footprint height 12\n", ""]
FACES = {"AllFaces": 3, "Sides": 1, "Top": 1, "Bottom": 1, "SidesPlusTop": 2, "SidesPlusBottom": 2, "TopPlusBottom": 2}


class Gbbg:
    extension = ".gbbg"

    def __init__(self, _, random):
        self.random = random
        self.rank = 0

    def shapes(self):
        return self.random.choice(["20x20", "30x24", "shapes.geojson"])

    def chance(self, share):
        return self.random.random() < share

    def number(self, hostile=0.08):
        return Node([self.random.choice(HOSTILE if self.chance(hostile) else NUMBERS)], ("1",))

    def program(self, number):
        start = self.random.choice(STARTS)
        lines = [Node([start], ("",)), "terminal Wall 2D [3, 3, 0], Slab\n",
                 Node([f"shape A [0, {self.random.choice(NUMBERS)}, 0], B [2, 2, 0]\n"], ("",)),
                 optional(self.random.choice(["select random\n", "select weighted\n", ""]))]
        if self.chance(0.3):
            fit = self.random.choice([" fit bounds", ""])
            lines.append(optional(f'postprocess {{\n  Slab : "house.obj"{fit}\n}}\n'))
        forms = [self.scope, self.split, self.repeat, self.grid, self.margin, self.component]
        for index, symbol in enumerate(["START", "A", "B", "C", "D", self.random.choice("ABCD")]):
            self.rank = min(index, 4)
            form = forms[number % len(forms)] if index == 0 else self.random.choice(forms)
            weight = self.random.choice(["", "", " weight 2", " weight 0"])
            lines.append(Node([f"{symbol} -> ", form(), weight, "\n"], ("",) if index else ()))
        return Node(lines)

    def axis(self):
        return self.random.choice("XYZ")

    def slots(self, count):
        return Node([" {", *(Node([" | " if k else "", self.slot()]) for k in range(count)), "}"])

    def slot(self):
        if self.chance(0.75):
            # Mostly a symbol below this one: recursion ends at a limit only.
            return self.random.choice(SYMBOLS if self.chance(0.05) else SYMBOLS[self.rank:])
        # Chances that lie far apart, and such as do not fit into a number together.
        chances = ["1", "2", "0", "0.3", "1e-300", "1e308"] if self.chance(0.2) else ["1", "2", "3", "0.5"]
        some = [f"{s} {self.random.choice(chances)}" for s in self.random.sample(SYMBOLS, self.random.randint(2, 3))]
        return joined(some, ", ", ("Wall",))

    def change(self, word):
        numbers = joined([self.number(), self.number(), self.number()], ", ")
        last = self.random.choice(["Absolute", "Relative"] if word == "S" else ["World", "Local"])
        return Node([f"{word}(", numbers, f", {self.random.choice(['Add', 'Set'])}, {last})"])

    def scope(self):
        changes = [self.change(w) for w in "TRS" if self.chance(0.6)] or [self.change("T")]
        return Node(["Scope(", joined(changes, ", "), ")", self.slots(1)])

    def split(self):
        points = [self.number() for _ in range(self.random.randint(1, 3))]
        direction = self.random.choice(["FromRoot", "ToRoot"])
        return Node([f"Split({self.axis()}, {{", *(Node([", " if k else "", p]) for k, p in enumerate(points)),
                     f"}}, {direction})", self.slots(len(points) + 1)])

    def repeat(self):
        return Node([f"Repeat({self.axis()})", self.slots(1)])

    def grid(self):
        return Node([f"Grid({self.axis()})", self.slots(1)])

    def margin(self):
        facing = self.random.choice([", FacingOut", ", FacingIn", ""])
        options = self.random.choice(["", ", Relative"]) + facing
        center = self.chance(0.7)
        return Node([f"Margin({self.axis()}, ", self.number(), options, "" if center else ", NoCenter", ")",
                     self.slots(3 if center else 2)])

    def component(self):
        faces = self.random.choice(sorted(FACES))
        return Node([f"Component({self.axis()}, {faces})", self.slots(FACES[faces])])
