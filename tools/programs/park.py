# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Random park grammars."""
from programs.tree import Node, joined, optional

NUMBERS = ["1", "2", "3", "1.5", "0.25", "4", "W2", "8", "0.5"]
# W2 is 3, and can be set, so these are not known before the rules run.
HOSTILE = ["(W2 - 3)", "(W2 - 4)", "1e308", "1e-9", "1000000", "(W2 / 0)", "(W2 - 3.5)"]
SELECTIONS = ["outer", "inner", "OUTER", "W", "N & outer", "side(E)", "longest", "len > 3", "nth(2)", "random(0.5)",
              "!side(S)", "outer(strict)", "0", "[0.4, 2.9]", "PEELED_BASE", "facing(world.N)", "grow(W, E; 30)"]
PLACES = ["CENTRE", "CORNER(OUTER)", "(0.2, 0.5), (0.8, 0.5)", "Points((3, 4), (9, 4))"]
COLOURS = ["LAWN", "GREEN_GRASS", "BLUE_GRASS", "RED", "STONE"]
RULES = ["A", "B", "C", "D(1)"]
CONDITIONS = ["w > 8", "h < 10", "w == 5", "area > 20", "ix == 1", "border", "!border", "ix + iy < 2", "bx == 0",
              "nx > 2"]
JUNCTIONS = [" { Romb(1) P }", " { Circle(2) Plaza }", " { Choose { Romb(1) P, Circle(1) Q } }",
             " { 30%: Square(1) P | Q }", " { P }"]
OUTLINES = ["", ", profile=box", ", profile=dome", ", joins=round", ", ends=round"]


class Park:
    extension = ".park"

    def __init__(self, _, random):
        self.random = random
        self.rank = -1

    def shapes(self):
        return self.random.choice(["20x20", "30x24", "60x50", "5x5", "12x40", "shapes.geojson", "shapes.geojson"])

    def program(self, number):
        rules = [optional(f"PathWidth = {self.random.choice(['2', '1', '3'])}\n"), "W2 = 2 * 1.5\n",
                 Node(["Region ->", self.steps(2, number), "\n"])]
        for self.rank, head in enumerate(("A", "B", "C", "D(d)")):
            rules.append(Node([f"{head} ->", self.rule(head), "\n"], (f"{head} -> LAWN\n",)))
        rules.append(optional("Sites -> ScatterCircles(4 {1.5})\n"))
        rules.append(optional("fun Edge(d) -> Parametrise([0.1, 0.9] _) { Contract(d) }\n"))
        return Node(rules)

    def chance(self, share):
        return self.random.random() < share

    def number(self):
        return Node([self.random.choice(NUMBERS if self.chance(0.9) else HOSTILE)], ("1",))

    def call(self):
        # Mostly a rule below this one: recursion ends at a limit only.
        return self.random.choice(RULES if self.chance(0.05) else RULES[self.rank + 1:] or ["Bed"])

    def rule(self, head):
        if self.chance(0.3):
            condition = Node(["(", joined(self.random.sample(CONDITIONS, self.random.randint(1, 2)), " && "), ")"])
            return Node([" case ", condition, ":", self.steps(1), " else:", self.steps(1)], (" LAWN",))
        return self.steps(1, None if head != "D(d)" else -1)

    def steps(self, depth, number=None):
        # Those that give the region away come last.
        last = [self.grid, self.voronoi, self.rays, self.peel, self.choose, self.joined_shapes, self.inner, self.select,
                self.quad_map]
        before = [self.contract, self.insert, self.figure, self.place, self.distribute, self.scatter, self.sweep,
                  lambda depth: " NoHoles", lambda depth: Node([" Extrude(", self.number(), ")"]),
                  lambda depth: f" {self.random.choice(COLOURS)}"]
        some = [Node([self.random.choice(before)(depth)], ("",)) for _ in range(self.random.randint(0, 2))]
        if number is not None and number >= 0:
            every = last + before
            some.insert(0, Node([every[number % len(every)](depth)], ("",)))
            if number % len(every) < len(last):
                return Node(some[:1])
        if depth > 0 and self.chance(0.6):
            some.append(Node([self.random.choice(last)(depth)], ("",)))
        elif not some or self.chance(0.4):
            some.append(Node([f" {self.call()}"], (" LAWN",)))
        return Node(some, (" LAWN",), "steps")

    def block(self, depth):
        return Node([" {", self.steps(depth - 1) if depth > 0 else f" {self.call()}", " }"], (" { A }", " {}"))

    def otherwise(self, depth):
        return optional(" else", self.block(depth)) if self.chance(0.25) else ""

    def shape(self):
        return Node([self.random.choice(["Circle", "Romb", "Square"]), "(", self.number(), ")"])

    def grid(self, depth):
        size = self.random.choice(["3", "2", "2 {5, 7}", "3 {[2, 6]a[-10, 10]}", "4"])
        parts = [f" Grid({size}, {self.random.choice(['2', '3', '3 {4}'])})", self.block(depth)]
        if self.chance(0.6):
            parts.append(optional(self.random.choice([" { Way }", " {}"])))
            parts.append(optional(self.random.choice(JUNCTIONS)))
        return Node([*parts, self.otherwise(depth)])

    def voronoi(self, depth):
        sites = self.random.choice(["Sites", "5", "4 {2}", "ScatterCircles(3 {2})"])
        options = self.random.choice(["", ", smooth=2", ", bezier", ", jitter(0.2)"])
        return Node([f" VoronoiRegions({sites}{options})", self.block(depth), optional(" { Way }"),
                     self.otherwise(depth)])

    def rays(self, depth):
        targets = self.random.choice(["Corners(Region)", "3", "Directions(0, 90)", "Entrances([0.5, 2.5])"])
        size = self.random.choice(["[2]", "[Circle(1)]", ""])
        return Node([f" CastRays(CENTRE {size}, {targets})", self.block(depth), optional(self.block(depth)),
                     self.otherwise(depth)])

    def peel(self, depth):
        sizes = self.random.choice(["{W: 1, N: 2}", "OUTER, 1", "OUTER", "N & outer, 0.5", "all, 1"])
        if sizes == "OUTER":
            return Node([" Peel(OUTER) { ", self.number(), ": A | B }", self.otherwise(depth)])
        return Node([f" Peel({sizes})", self.block(depth), self.otherwise(depth)])

    def choose(self, depth):
        parts = [Node([self.random.choice(["", " 30%:", " 12.5%:"]), self.steps(depth - 1) if depth > 0 else " A"])
                 for _ in range(2)]
        return Node([" Choose {", joined(parts, ","), " }"])

    def joined_shapes(self, depth):
        return Node([" joined {", self.random.choice([" Rect(4, 2) Circle(2) A", " A B", " Romb(2) P"]), " }"])

    def inner(self, depth):
        return Node([" InnerRect { shape:", self.steps(depth - 1) if depth > 0 else " A", " | remainder: B }"])

    def select(self, depth):
        some = [Node([f" {s} :", self.steps(depth - 1) if depth > 0 else " A"])
                for s in self.random.sample(SELECTIONS, 2)]
        return Node([" Select {", joined(some, " |"), " }", optional(" else", self.block(depth))])

    def quad_map(self, depth):
        return Node([f" QuadMap({self.random.choice(['3, 2', '2, 2', '1, 4'])}) {{ A | B }}", self.otherwise(depth)])

    def contract(self, depth):
        return Node([" Contract(", self.number(), self.random.choice(["", ", centre"]), ")", self.otherwise(depth)])

    def insert(self, depth):
        return Node([" Insert(", self.number(), ")", optional(self.block(depth))])

    def figure(self, depth):
        return Node([" ", self.shape(), self.otherwise(depth)])

    def place(self, depth):
        head = optional(" ", self.shape()) if self.chance(0.6) else ""
        return Node([f" Place({self.random.choice(PLACES)}) {{", head, f" {self.call()} }}"])

    def distribute(self, depth):
        inset = self.random.choice(["", " : 0.5", " : 0.375"])
        spacing = Node([self.random.choice([", 2", ", 4", ", [0.2, 0.3]", ", [start : 3]"])])
        return Node([f" Distribute({self.random.choice(SELECTIONS)}{inset}", spacing, ") { ",
                     optional(self.shape(), " "), "Tree }"])

    def scatter(self, depth):
        return Node([f" Scatter({self.random.choice(['3', '5'])} {{", self.number(), "}) { Pond }"])

    def sweep(self, depth):
        line = self.random.choice([*SELECTIONS[:6], "Edge(0.5)"])
        return Node([f" Sweep({line}, width=", self.number(), ", height=", self.number(),
                     self.random.choice(OUTLINES), ") { Hedge }"])
