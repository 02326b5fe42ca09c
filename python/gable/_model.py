# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""What a derivation made."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypedDict

from gable import _gable
from gable._messages import Error, Message, checked, messages_of, one_of, path_text, warn_of

if TYPE_CHECKING:
    import numpy as np
    import pandas
    from numpy.typing import NDArray

LIGHTING = ("paths", "direct")
_WORDS = {
    "view": ("iso", "top", "front", "street"),
    "style": ("photo", "clay", "blueprint", "ink", "section"),
    "lighting": LIGHTING,
}
_MOST_LEAVES = 1 << 40


@dataclass(frozen=True)
class Material:
    name: str
    color: str
    """"#rrggbb", sRGB."""
    opacity: float
    roughness: float
    metallic: float
    emissive: str | None
    textures: dict[str, str]
    """Path by layer: "colormap", "normalmap", ..."""


@dataclass(frozen=True)
class Mesh:
    """The whole model as triangles in the world. All but `materials` are arrays of numpy."""

    positions: NDArray[np.float64]
    """(n, 3), float64: metres."""
    normals: NDArray[np.float32]
    """(n, 3), float32."""
    uvs: NDArray[np.float32]
    """(n, 2), float32; zeros where a surface has none."""
    triangles: NDArray[np.uint32]
    """(m, 3), uint32: counter-clockwise from outside."""
    material: NDArray[np.uint32]
    """(m,), uint32: index into materials."""
    leaf: NDArray[np.uint32]
    """(m,), uint32: the number of the leaf that a triangle belongs to."""
    materials: list[Material]


class PartMesh(TypedDict):
    """A mesh of Parts, in its own frame."""

    positions: NDArray[np.float64]
    """(n, 3), float64."""
    normals: NDArray[np.float32]
    """(n, 3), float32."""
    uvs: NDArray[np.float32]
    """(n, 2), float32; (0, 2) where there are none."""
    triangles: NDArray[np.uint32]
    """(m, 3), uint32."""
    slot: NDArray[np.uint32]
    """(m,), uint32: which of the leaf's materials a triangle has."""


@dataclass(frozen=True)
class Parts:
    """The model with what it shares: meshes, and where each leaf puts one of them."""

    meshes: list[PartMesh]
    materials: list[Material]
    names: list[str]
    mesh: NDArray[np.uint32]
    """By leaf, (k,), uint32: index into meshes."""
    name: NDArray[np.uint32]
    """By leaf, (k,), uint32: index into names."""
    material: NDArray[np.uint32]
    """By leaf, (k,), uint32: index into materials, of its first surface."""
    transform: NDArray[np.float64]
    """By leaf, (k, 12), float64: a point p of the mesh lies at origin + x p.x + y p.y + z p.z."""


@dataclass(frozen=True)
class Leaf:
    """A shape that stays in the model."""

    name: str
    rule: str | None
    file: str | None
    line: int | None
    faces: int
    vertices: int
    color: str
    material: str
    size: tuple[float, float, float]
    attributes: dict[str, Any]

    def __post_init__(self) -> None:
        object.__setattr__(self, "size", tuple(self.size))


@dataclass(frozen=True)
class Report:
    """All values that rules reported under one key."""

    count: int
    values: dict[str, int]
    """Texts and bools, and how often each was reported."""
    sum: float | None = None
    min: float | None = None
    max: float | None = None
    mean: float | None = field(default=None)


@dataclass(frozen=True)
class ShapeReports:
    """What the rules of one initial shape reported."""

    name: str
    id: str
    """What its file calls it; empty where it does not."""
    reports: dict[str, Report]
    """By key."""


class Model:
    """A model: derived by rules, or read from a file."""

    def __init__(self, raw: Any, shapes: int = 0, told: Sequence[Message] = ()):
        self._raw = checked(raw)
        self._shapes = shapes
        self._told = list(told)
        warn_of(self.messages)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Model:
        """Reads a model file as it is: OBJ, glTF, GLB, and FBX and COLLADA where they can be read."""
        return cls(_gable.Model.load(path_text(path)))

    @property
    def messages(self) -> list[Message]:
        """Warnings and notes. Python's `warnings` have shown the warnings."""
        return messages_of(self._raw.messages()) + self._told

    @property
    def is_whole(self) -> bool:
        """False when a limit ended the derivation; the messages tell which."""
        return self._raw.end() == "done"

    @property
    def statistics(self) -> dict[str, Any]:
        """shapes, leaves, faces, vertices, triangles, instances, prototypes, materials, seconds of
        the derivation, and bounds as (least, largest) or None. Instances are expanded."""
        return self._raw.statistics()

    @property
    def reports(self) -> dict[str, Report]:
        """What rules reported, by key."""
        return {key: Report(**r) for key, r in self._raw.reports().items()}

    @property
    def reports_by_shape(self) -> list[ShapeReports]:
        """The same for each initial shape, in their order: the floor area of a parcel."""
        return [
            ShapeReports(name, id, {key: Report(**r) for key, r in reports.items()})
            for name, id, reports in self._raw.reports_by_shape()
        ]

    @property
    def prints(self) -> list[str]:
        """What rules printed, line by line."""
        return self._raw.prints()

    def attributes(self, shape: int = 0) -> dict[str, Any]:
        """The attributes of an initial shape, as its rules found them. Raises IndexError where the
        model was made of fewer shapes; one that was read from a file was made of none."""
        if not 0 <= shape < self._shapes:
            raise IndexError(f"the model was made of {self._shapes} shapes, none of number {shape}")
        return self._raw.attributes(shape)

    def mesh(self, most_leaves: int = _MOST_LEAVES) -> Mesh:
        """Triangles of the first leaves in the world. The arrays own their memory: no copy is made
        when they are handed over."""
        arrays = self._raw.flat(most_leaves)
        arrays["materials"] = [Material(**m) for m in arrays["materials"]]
        return Mesh(**arrays)

    def parts(self, most_leaves: int = _MOST_LEAVES) -> Parts:
        """Meshes once each, with their places: for programs that can draw instances."""
        arrays = self._raw.parts(most_leaves)
        arrays["materials"] = [Material(**m) for m in arrays["materials"]]
        return Parts(**arrays)

    def leaf(self, number: int) -> Leaf:
        """A leaf by its number, as Mesh.leaf has it."""
        raw = self._raw.leaf(number) if number >= 0 else None
        if raw is None:
            raise IndexError(f"there are {self._raw.leaf_count()} leaves, none of number {number}")
        return Leaf(**raw)

    def __len__(self) -> int:
        """The number of leaves."""
        return self._raw.leaf_count()

    def leaves(self, most: int = 1_000_000) -> pandas.DataFrame:
        """The first leaves as a table of pandas: name, rule, file, line, faces, vertices, color,
        material, width, height, depth, and a column for each attribute."""
        import pandas

        rows = []
        for number in range(min(most, len(self))):
            leaf = self._raw.leaf(number)
            width, height, depth = leaf.pop("size")
            attributes = leaf.pop("attributes")
            rows.append({**leaf, "width": width, "height": height, "depth": depth, **attributes})
        return pandas.DataFrame(rows)

    def write(
        self, path: str | os.PathLike[str], *, profile: str = "", **options: str | int
    ) -> int:
        """Writes .glb, .gltf, .obj, .usda, .ply, .stl or another model, and gives the bytes written.

        `profile` is the program that opens it: "blender", "cesium", "godot", "unity" or "unreal".
        `options` are those of `gable generate` for models, with _ for -, such as
        instancing="nodes", collision="hull", lods=2 or texture_size=1024; they hold over the
        profile.
        """
        return _written(self._raw.write(path_text(path), profile, _choices(options)))

    def encode(self, format: str, *, profile: str = "", **options: str | int) -> bytes:
        """The bytes of a file: "glb", "ply", "stl" or "png"; the rest as for write()."""
        return _written(self._raw.encode(format, profile, _choices(options)))

    def picture(
        self,
        path: str | os.PathLike[str],
        *,
        view: str = "iso",
        width: int = 1600,
        height: int = 900,
        samples: int = 48,
        sun: tuple[float, float] | None = None,
        camera: tuple[tuple[float, float, float], tuple[float, float, float]] | None = None,
        field_of_view: float | None = None,
        style: str = "photo",
        lighting: str = "paths",
        progress: Callable[[int, int], None] | None = None,
    ) -> None:
        """Draws a .png from "iso", "top", "front" or "street", or from a camera (eye, target).

        `sun` is its elevation above the horizon and its azimuth clockwise from north. `style` is
        "photo", "clay", "blueprint", "ink" or "section"; `lighting` is by "paths" or "direct", which
        is many times faster. `progress` is called with the thousandths that are done, and 1000.
        Ctrl-C and what it raises end the drawing; no picture is written then.
        """
        if not path_text(path).lower().endswith(".png"):
            raise ValueError(f"a picture is a .png, not {path_text(path)!r}")
        words = {"view": view, "style": style, "lighting": lighting}
        for name, word in words.items():
            one_of(name, word, _WORDS[name])
        _written(
            self._raw.picture(
                path_text(path), *words.values(), width, height, samples, sun, camera, field_of_view, progress
            )
        )

    def __repr__(self) -> str:
        return f"<gable.Model, {len(self)} leaves>"


def _choices(options: dict[str, str | int]) -> list[tuple[str, str]]:
    if "for_" in options:
        raise TypeError("the program that opens a file is given as profile, not as for_")
    return [(name.replace("_", "-"), str(value)) for name, value in options.items()]


def _written(result: tuple[bool, list[dict[str, Any]], Any]) -> Any:
    ok, messages, what = result
    if not ok:
        raise Error(messages_of(messages))
    warn_of(messages_of(messages))
    return what
