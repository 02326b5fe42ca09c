# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Random ProGen3d grammars."""
from programs.tree import Node, joined, optional

NUMBERS = ["1", "2", "0.5", "-1", "0.25", "1.1", "h", "w", "n", "1/3", "( h + 1 )", "sin ( h )", "Q_count", "&h", "2^2"]
HOSTILE = ["0", "1e308", "-1e308", "1e-12", "1/0", "1000000", "-h^h"]
RULES = ["P", "Q", "V", "W1"]
BODIES = ["Cube", "CubeX", "CubeY", "Sphere", "Cylinder"]


class Progen3d:
    extension = ".grammar"

    def __init__(self, _, random):
        self.random = random
        self.rank = 0

    def shapes(self):
        return self.random.choice(["10x10", "30x24", "shapes.geojson"])

    def chance(self, share):
        return self.random.random() < share

    def number(self):
        return Node([self.random.choice(HOSTILE if self.chance(0.04) else NUMBERS)], ("1",))

    def program(self, number):
        lines = ["X -> R h ( 0.5 2 ) R* n ( 1 3 ) R w ( 1 1 ) P Q\n"]
        for self.rank, name in enumerate(RULES):
            lines.append(Node([name, self.head(), " ->", self.sections(number if name == "P" else None), "\n"],
                              (f"{name} -> I ( Cube )\n",)))
        return Node(lines)

    def head(self):
        repeat = optional(" ", self.random.choice(["2", "3", "n", "n + 1", "0", "2.9"]),
                          optional(self.random.choice(["", " h", " h n", " w"])))
        probability = optional(self.random.choice(["", " ; 0.5", " ; 0.2", " ; 1"]))
        return Node([repeat if self.chance(0.6) else "", probability])

    def sections(self, number):
        count = self.random.choice([1, 1, 1, 2, 3])
        some = [Node([self.steps(2, number if k == 0 else None)]) for k in range(count)]
        alternate = optional(" ->", self.steps(1)) if self.chance(0.25) else ""
        return Node([*(Node([" |" if k else "", s]) for k, s in enumerate(some)), alternate])

    def steps(self, depth, number=None):
        forms = [self.scale, self.move, self.turn, self.taper, self.front, self.top, self.insert, self.insert,
                 self.insert, self.call, self.push]
        if self.chance(0.85):
            # With these the pivots of the whole grammar change.
            forms = [f for f in forms if f not in (self.front, self.top)]
        some = [self.random.choice(forms)(depth) for _ in range(self.random.randint(1, 4))]
        if number is not None:
            some.insert(0, forms[number % len(forms)](depth))
        return Node([Node([" ", s], ("",)) for s in some], (" I ( Cube )",), "steps")

    def three(self, word):
        return Node([f"{word} ( ", joined([self.number(), self.number(), self.number()], " "), " )"])

    def scale(self, _):
        return self.three("S")

    def move(self, _):
        return self.three("T")

    def taper(self, _):
        return self.three("D")

    def front(self, _):
        return self.three("DS")

    def top(self, _):
        return self.three("DT")

    def turn(self, _):
        return Node(["A ( ", self.number(), f" * 30 {self.random.choice('012')} )"])

    def insert(self, _):
        more = joined([self.number() for _ in range(self.random.randint(0, 3))], " ", ("",))
        return Node([f"I ( {self.random.choice(BODIES)} ", more, " )"])

    def call(self, _):
        # Mostly a rule below this one: recursion ends at a limit only.
        return self.random.choice(RULES if self.chance(0.05) else RULES[self.rank + 1:] or ["I ( Cube 1 )"])

    def push(self, depth):
        return Node(["[", self.steps(depth - 1) if depth > 0 else " I ( Cube 2 )", " ]"])
