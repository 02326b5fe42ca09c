#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Reads city models back and tells what no reader should meet: city_check.py FILE-OR-FOLDER...

.city.json and .city.jsonl (CityJSON 2.0.1); a folder stands for the models in it. Looked for: members that the format
asks for, types that it does not know, parents and children that do not know each other, vertices that are not there or
equal ones, rings of fewer than three corners, faces that are not flat within a centimetre, numbers of semantic
surfaces, materials and templates that are not there, and of every Solid: each edge twice, once in each direction, and
faces that look outward. Ends with 1 when a model has any. --table prints what each one holds.
"""
import json
import math
import sys
from collections import Counter
from pathlib import Path

FLAT = 0.01
MOST = 5  # Of each kind.
FIRST_LEVEL = {"Bridge", "Building", "CityFurniture", "LandUse", "OtherConstruction", "PlantCover", "Railway", "Road",
               "SolitaryVegetationObject", "TINRelief", "TransportSquare", "Tunnel", "WaterBody", "Waterway"}
SECOND_LEVEL = {"BuildingPart", "BuildingInstallation", "BuildingConstructiveElement", "BuildingFurniture"}
SURFACES = {"RoofSurface", "GroundSurface", "WallSurface", "ClosureSurface", "OuterCeilingSurface",
            "OuterFloorSurface", "Window", "Door"}
# Lists around the index of a vertex.
DEPTHS = {"MultiSurface": 3, "CompositeSurface": 3, "Solid": 4, "MultiSolid": 5, "CompositeSolid": 5}


class Faults(list):
    def add(self, text):
        if sum(1 for each in self if each.split(":")[0] == text.split(":")[0]) < MOST:
            self.append(text)


def subtract(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def normal_of(points):
    """Twice the area, in the direction that the ring is counter-clockwise about."""
    total = (0.0, 0.0, 0.0)
    for i in range(2, len(points)):
        n = cross(subtract(points[i - 1], points[0]), subtract(points[i], points[0]))
        total = (total[0] + n[0], total[1] + n[1], total[2] + n[2])
    return total


class Model:
    def __init__(self, document, header, faults, name):
        self.faults, self.name = faults, name
        transform = header["transform"]
        scale, shift = transform["scale"], transform["translate"]
        vertices = document["vertices"]
        if not all(isinstance(c, int) for v in vertices for c in v):
            faults.add(f"{name}: a vertex is not three integers")
        if len({tuple(v) for v in vertices}) != len(vertices):
            faults.add(f"{name}: equal vertices")
        # Near the origin, so that areas and volumes are exact.
        base = vertices[0] if vertices else (0, 0, 0)
        self.points = [tuple((c - b) * s for c, b, s in zip(v, base, scale)) for v in vertices]
        self.low = min((v[2] * scale[2] + shift[2] for v in vertices), default=0)
        self.materials = len(document.get("appearance", header.get("appearance", {})).get("materials", []))
        self.templates = document.get("geometry-templates", {"templates": [], "vertices-templates": []})
        self.objects = document["CityObjects"]
        self.counts, self.areas, self.used = Counter(), Counter(), set()

    def check(self):
        for i, template in enumerate(self.templates["templates"]):
            self.geometry(f"template {i}", template, self.templates["vertices-templates"])
        for key, thing in self.objects.items():
            self.counts[thing["type"]] += 1
            if thing["type"] not in FIRST_LEVEL | SECOND_LEVEL:
                self.faults.add(f"{self.name}: '{thing['type']}' is no city object")
            if (thing["type"] in SECOND_LEVEL) != ("parents" in thing):
                self.faults.add(f"{self.name}: {key} has parents where it must not, or none")
            for parent in thing.get("parents", []):
                if key not in self.objects[parent]["children"]:
                    self.faults.add(f"{self.name}: {parent} does not know its child {key}")
            for child in thing.get("children", []):
                if key not in self.objects[child]["parents"]:
                    self.faults.add(f"{self.name}: {child} does not know its parent {key}")
            for value in thing.get("attributes", {}).values():
                if isinstance(value, float) and not math.isfinite(value):
                    self.faults.add(f"{self.name}: an attribute of {key} is no number")
            for one in thing.get("geometry", []):
                self.geometry(key, one, self.points)
        if self.used != set(range(len(self.points))):
            self.faults.add(f"{self.name}: {len(self.points) - len(self.used)} vertices are not used")

    def geometry(self, key, g, points):
        where = f"{self.name} {key} lod {g.get('lod')}"
        if g["type"] == "GeometryInstance":
            matrix = g["transformationMatrix"]
            if not 0 <= g["template"] < len(self.templates["templates"]) or len(g["boundaries"]) != 1:
                self.faults.add(f"template: {where}")
            if len(matrix) != 16 or not all(map(math.isfinite, matrix)):
                self.faults.add(f"matrix: {where}")
            self.used.update(g["boundaries"])
            self.counts["GeometryInstance"] += 1
            return
        self.counts[f"{g['type']} {g['lod']}"] += 1
        depth = DEPTHS[g["type"]] - 3
        shells = self.flat(where, g["boundaries"], depth)
        surfaces = [surface for shell in shells for surface in shell]
        for surface in surfaces:
            self.face(where, surface, points)
        self.numbers(where, g, depth, surfaces, points)
        for shell in shells if depth else []:
            self.solid(where, shell, points)

    def flat(self, where, lists, depth):
        """The lists of a geometry as lists of surfaces, one for each solid: solids have one shell here."""
        if depth < 2:
            return [lists[0]] if depth else [lists]
        if any(len(solid) != 1 for solid in lists):
            self.faults.add(f"shells: {where}")
        return [solid[0] for solid in lists]

    def face(self, where, surface, points):
        if points is self.points:
            self.used.update(i for ring in surface for i in ring)
        rings = []
        for ring in surface:
            if len(ring) < 3 or any(a == b for a, b in zip(ring, ring[1:] + ring[:1])):
                self.faults.add(f"ring: {where}")
                return
            rings.append([points[i] for i in ring])
        n = normal_of(rings[0])
        size = math.sqrt(dot(n, n))
        if not size > 0:
            self.faults.add(f"area: {where}")
            return
        middle = [sum(p[a] for p in rings[0]) / len(rings[0]) for a in range(3)]
        off = max(abs(dot(subtract(p, middle), n)) / size for ring in rings for p in ring)
        if off > FLAT:
            self.faults.add(f"flat: {where}: {off:.3f} m")

    def numbers(self, where, g, depth, surfaces, points):
        semantics, count = g.get("semantics"), len(surfaces)
        if semantics:
            values = [v for shell in self.flat(where, semantics["values"], depth) for v in shell]
            if len(values) != count:
                self.faults.add(f"semantics: {where}: {len(values)} values for {count} surfaces")
            types = [s["type"] for s in semantics["surfaces"]]
            if not set(types) <= SURFACES:
                self.faults.add(f"semantics: {where}: {set(types) - SURFACES}")
            for value, surface in zip(values, surfaces):
                if value is None:
                    continue
                if not 0 <= value < len(types):
                    self.faults.add(f"semantics: {where}: {value}")
                    continue
                n = normal_of([points[i] for i in surface[0]])
                size = math.sqrt(dot(n, n))
                self.areas[f"{types[value]} {g['lod']}"] += size / 2
                if depth:
                    up = n[2] / size if size else 0
                    right = {"RoofSurface": up > 0, "GroundSurface": up < -0.9, "WallSurface": abs(up) < 0.1}
                    if not right.get(types[value], True):
                        self.faults.add(f"looks: {where}: {types[value]} looks {up:.2f} up")
            if set(range(len(types))) - set(values):
                self.faults.add(f"semantics: {where}: one that no surface has")
        for theme in g.get("material", {}).values():
            values = [theme.get("value")]
            if "values" in theme:
                values = [v for shell in self.flat(where, theme["values"], depth) for v in shell]
            if "values" in theme and len(values) != count:
                self.faults.add(f"material: {where}: {len(values)} values for {count} surfaces")
            if not all(v is None or 0 <= v < self.materials for v in values):
                self.faults.add(f"material: {where}")

    def solid(self, where, surfaces, points):
        edges = Counter()
        volume = 0.0
        for surface in surfaces:
            for ring in surface:
                edges.update(zip(ring, ring[1:] + ring[:1]))
                corners = [points[i] for i in ring]
                for i in range(2, len(corners)):
                    volume += dot(corners[0], cross(corners[i - 1], corners[i])) / 6
        if any(n != 1 or edges[(b, a)] != 1 for (a, b), n in list(edges.items())):
            self.faults.add(f"closed: {where}")
        if not volume > 0:
            self.faults.add(f"outward: {where}: {volume:.3f} m3")
        self.areas[f"m3 {where.split()[-1]}"] += volume


def head(document, faults, name):
    if document.get("type") != "CityJSON" or document.get("version") != "2.0":
        faults.add(f"{name}: no CityJSON 2.0")
    if len(document["transform"]["scale"]) != 3 or len(document["transform"]["translate"]) != 3:
        faults.add(f"{name}: transform")


def models(path, faults):
    """What a file holds: one model, or one for each feature."""
    text = path.read_text(encoding="utf-8")
    def refuse(word):
        raise ValueError(f"{word} is no JSON")
    if path.name.endswith(".city.json"):
        document = json.loads(text, parse_constant=refuse)
        head(document, faults, path.name)
        return [Model(document, document, faults, path.name)]
    lines = text.splitlines()
    header = json.loads(lines[0], parse_constant=refuse)
    head(header, faults, path.name)
    if header["CityObjects"] or header["vertices"]:
        faults.add(f"{path.name}: the first line holds objects")
    out = []
    for line in lines[1:]:
        feature = json.loads(line, parse_constant=refuse)
        if feature.get("type") != "CityJSONFeature" or feature["id"] not in feature["CityObjects"]:
            faults.add(f"{path.name}: a line is no feature")
        out.append(Model(feature, header, faults, f"{path.name} {feature['id']}"))
    return out


def problems(path, table=None):
    """What is wrong with a model, a sentence each; counts and areas are added to `table`."""
    faults = Faults()
    try:
        for model in models(path, faults):
            model.check()
            if table is not None:
                table.update(model.counts)
                table.update({k: round(v, 2) for k, v in model.areas.items()})
    except (ValueError, KeyError, IndexError, TypeError, OSError) as e:
        faults.add(f"unreadable: {e!r}")
    return list(faults)


def main():
    failed = count = 0
    for name in [a for a in sys.argv[1:] if a != "--table"]:
        path = Path(name)
        found = [p for p in path.rglob("*") if p.name.endswith((".city.json", ".city.jsonl"))] if path.is_dir() else [path]
        for model in sorted(found):
            count += 1
            table = Counter()
            faults = problems(model, table)
            failed += bool(faults)
            for fault in faults:
                print(f"{model}: {fault}")
            if "--table" in sys.argv:
                print(model, json.dumps(dict(sorted(table.items()))))
    print(f"{count} city models read, {failed} with faults")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
