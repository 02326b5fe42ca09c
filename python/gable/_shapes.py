# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Initial shapes: lots, footprints, meshes."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from gable import _gable
from gable._messages import Message, above_zero, checked, messages_of, path_text, told, warn_of

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


class Outline(NamedTuple):
    """A shape in plan."""

    name: str
    ring: NDArray[np.float64]
    """Points of the largest face, (n, 2): x east, y north."""
    area: float
    """Of all its faces."""


class Shapes:
    """The initial shapes of a derivation, in order."""

    def __init__(self, raw: Any, named: frozenset[str] = frozenset()):
        self._raw = checked(raw)
        self._named = named
        """Names that with_attributes was given."""

    @classmethod
    def lot(cls, width: float, depth: float) -> Shapes:
        """A rectangle with a corner at the origin: `width` along +x, `depth` along -z."""
        return cls(_gable.Shapes.lot(above_zero("width", width), above_zero("depth", depth)))

    @classmethod
    def polygon(cls, ring: Iterable[Any], holes: Iterable[Iterable[Any]] = ()) -> Shapes:
        """A polygon in plan (x east, y north), from points or an array of shape (n, 2).

        A first point that is repeated at the end counts once.
        """
        if hasattr(ring, "__geo_interface__"):
            raise TypeError("polygon() takes points; of_geometries() takes polygons of shapely")
        return cls(told(_gable.Shapes.polygon(_ring(ring), [_ring(h) for h in holes])))

    @classmethod
    def mesh(
        cls,
        vertices: Iterable[Any],
        faces: Iterable[Sequence[int]],
        holes: Iterable[Sequence[int]] = (),
    ) -> Shapes:
        """Faces over vertices (n, 3), y up, as one shape.

        `holes` are lists of face numbers: the first is the face that has the others as holes.
        """
        points = [tuple(float(c) for c in v) for v in vertices]
        for number, point in enumerate(points):
            if len(point) != 3:
                raise ValueError(f"a vertex has 3 numbers, and vertex {number} has {len(point)}")
        lists = [list(map(int, f)) for f in faces], [list(map(int, h)) for h in holes]
        return cls(told(_gable.Shapes.mesh(points, *lists)))

    @classmethod
    def load(
        cls, path: str | os.PathLike[str], *, layer: str = "", key: str = "", value: str = ""
    ) -> Shapes:
        """Reads GeoJSON, OpenStreetMap, GeoPackage, FlatGeobuf, shapefiles, OBJ or glTF.

        Of a map, features with the property `key` become shapes, with `value` those that have it.
        """
        return cls(told(_gable.Shapes.load(path_text(path), layer, key, value)))

    @classmethod
    def of_geometries(cls, geometries: Iterable[Any], attributes: Iterable[Mapping[str, Any]] | None = None) -> Shapes:
        """Of polygons of shapely, or of anything with `__geo_interface__`, in metres.

        Each polygon becomes a shape, each part of a multipolygon one of its own. Other geometries
        raise TypeError. `attributes` has a mapping for each geometry, else ValueError is raised.
        """
        all = list(geometries)
        given = list(attributes) if attributes is not None else None
        if given is not None and len(given) != len(all):
            raise ValueError(f"there are {len(all)} geometries, and attributes for {len(given)}")
        shapes: list[Shapes] = []
        values: list[Mapping[str, Any]] = []
        for number, geometry in enumerate(all):
            for ring, holes in _polygons(geometry, number):
                shapes.append(cls.polygon(_plan(ring), [_plan(h) for h in holes]))
                values.append(given[number] if given is not None else {})
        joined = cls.joined(shapes)
        return joined._with(values) if given is not None else joined

    @classmethod
    def of_frame(cls, frame: Any) -> Shapes:
        """Of a GeoDataFrame of geopandas: its columns become attributes.

        A frame in degrees is projected to metres first, by the zone of UTM that it lies in. Shapes
        lie around the origin; the middle of the frame becomes (0, 0). Missing values are left out;
        so are rows without a geometry and columns of values that no rule can have, such as dates,
        and gable.Warning tells of those.
        """
        if not hasattr(frame, "crs"):
            raise TypeError(f"of_frame takes a GeoDataFrame of geopandas, not {type(frame).__name__}")
        if frame.crs is not None and frame.crs.is_geographic:
            frame = frame.to_crs(frame.estimate_utm_crs())
        if len(frame) > 0:
            west, south, east, north = frame.total_bounds
            frame = frame.set_geometry(frame.geometry.translate(-(west + east) / 2, -(south + north) / 2))
        columns = [c for c in frame.columns if c != frame.geometry.name]
        rows = list(frame[columns].itertuples(index=False, name=None))
        usable = [all(_is_missing(row[i]) or _is_value(row[i]) for row in rows) for i in range(len(columns))]
        for column in (c for c, is_usable in zip(columns, usable) if not is_usable):
            _warn("frame-column", f"the column {str(column)!r} is left out: its values are no numbers, texts or bools",
                  f"convert it first, such as by frame[{str(column)!r}].astype(str)")
        geometries, values = [], []
        for number, (geometry, row) in enumerate(zip(frame.geometry, rows)):
            if geometry is None:
                _warn("frame-row", f"row {number} is left out: it has no geometry", "")
                continue
            geometries.append(geometry)
            cells = zip(columns, row, usable)
            values.append({str(c): v for c, v, is_usable in cells if is_usable and not _is_missing(v)})
        return cls.of_geometries(geometries, values)

    @classmethod
    def joined(cls, all: Iterable[Shapes]) -> Shapes:
        """The shapes of all, one after the other."""
        shapes = list(all)
        named = frozenset().union(*(s._named for s in shapes))
        return cls(_gable.Shapes.joined([s._raw for s in shapes]), named)

    def with_attributes(self, by_shape: Iterable[Mapping[str, Any]]) -> Shapes:
        """The same with attributes of rules, a mapping for each shape in order.

        `derive` warns of names that its rules do not have. Raises ValueError where there are more
        mappings than shapes.
        """
        values = [dict(own) for own in by_shape]
        if len(values) > len(self):
            raise ValueError(f"there are {len(self)} shapes, and attributes for {len(values)}")
        return self._with(values, self._named.union(*values))

    def _with(self, values: Iterable[Mapping[str, Any]], named: frozenset[str] = frozenset()) -> Shapes:
        return Shapes(self._raw.with_attributes([dict(own) for own in values]), named)

    def with_nested_cut(self) -> Shapes:
        """The same with footprints cut out of larger ones that they lie in or overlap."""
        return Shapes(self._raw.with_nested_cut(), self._named)

    def __getitem__(self, which: int | slice) -> Shapes:
        """Some of the shapes; what is random about them stays as it is among all."""
        if isinstance(which, slice):
            return Shapes(self._raw.only(list(range(*which.indices(len(self))))), self._named)
        index = which + len(self) if which < 0 else which
        if not 0 <= index < len(self):
            raise IndexError(f"there are {len(self)} shapes, none of number {which}")
        return Shapes(self._raw.only([index]), self._named)

    def __len__(self) -> int:
        return self._raw.size()

    def outline(self, shape: int) -> Outline:
        """A shape in plan, by its number from 0; raises IndexError where there is none."""
        if not 0 <= shape < len(self):
            raise IndexError(f"there are {len(self)} shapes, none of number {shape}")
        return Outline(*self._raw.outline(shape))

    @property
    def messages(self) -> list[Message]:
        """Warnings and notes."""
        return messages_of(self._raw.messages())

    def __repr__(self) -> str:
        return f"<gable.Shapes, {len(self)}>"


def _ring(points: Iterable[Any]) -> list[tuple[float, float]]:
    ring = []
    for number, p in enumerate(points):
        if len(p) != 2:
            raise ValueError(f"a point in plan has 2 numbers, and point {number} has {len(p)}; mesh() takes points of 3")
        ring.append((float(p[0]), float(p[1])))
    if len(set(ring)) < 3:
        raise ValueError(f"a polygon has at least 3 points, not {len(set(ring))}")
    return ring


def _plan(ring: Iterable[Any]) -> list[Any]:
    """Without heights."""
    return [p[:2] for p in ring]


def _polygons(geometry: Any, number: int) -> Iterable[tuple[Any, list[Any]]]:
    plain = getattr(geometry, "__geo_interface__", geometry)
    kind = plain.get("type") if isinstance(plain, Mapping) else None
    if kind == "Polygon":
        parts = [plain["coordinates"]]
    elif kind == "MultiPolygon":
        parts = plain["coordinates"]
    else:
        raise TypeError(f"a shape is made of polygons; geometry {number} is a {kind or type(geometry).__name__}")
    for rings in parts:
        if rings:
            yield rings[0], list(rings[1:])


def _is_missing(value: Any) -> bool:
    try:
        return value is None or bool(value != value)
    except (TypeError, ValueError):
        # pandas.NA says neither; what compares by its items is there.
        return type(value).__name__ == "NAType"


def _is_value(value: Any) -> bool:
    """Whether a rule's attribute can have it; of what has items, its binding tells."""
    kind = getattr(getattr(value, "dtype", None), "kind", None)
    return kind in "bifuU" if kind is not None else isinstance(value, (bool, int, float, str, Sequence))


def _warn(code: str, text: str, hint: str) -> None:
    warn_of([Message("warning", code, text, hint, f"warning[{code}]: {text}\n" + (f"  hint: {hint}\n" if hint else ""))])
