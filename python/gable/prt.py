# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""The classes and functions of PyPRT, by the same names, for scripts that were written for it.

    import gable.prt as pyprt

docs/guide/python.md tells what differs.
"""

from __future__ import annotations

import difflib
import os
import warnings
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import gable
from gable._rules import Annotation

NO_KEY = "#NULL#"
PY_ENCODER = "com.esri.pyprt.PyEncoder"

# What an encoder of PRT writes, by its name.
_EXTENSIONS = {
    "com.esri.prt.codecs.OBJEncoder": ".obj",
    "com.esri.prt.codecs.GLTFEncoder": ".glb",
}
# What encoders are told that is heeded here.
_OPTIONS = ("emitReport", "emitGeometry", "triangulate", "outputPath", "baseName")
_NO_ATTRIBUTES = ("ruleFile", "startRule", "seed", "shapeName", "outputPath")


class InitialShape:
    """A shape to apply rules to: coordinates, faces over them, or the path of a file."""

    def __init__(
        self,
        shape: Sequence[float] | str | os.PathLike[str],
        faceVertIndices: Sequence[int] | None = None,
        faceVertCount: Sequence[int] | None = None,
        holes: Sequence[Sequence[int]] = (),
    ):
        self._path = ""
        self._points: list[tuple[float, ...]] = []
        self._faces: list[list[int]] = []
        if isinstance(shape, (str, os.PathLike)):
            self._path = os.fspath(shape)
            # The second argument is how deep folders are searched for textures, which Gable finds.
            self._shapes = gable.Shapes.load(self._path)
            return
        if hasattr(shape, "ravel"):
            shape = shape.ravel().tolist()
        if len(shape) % 3 != 0:
            raise ValueError(f"coordinates come in threes, and there are {len(shape)}")
        self._points = [tuple(shape[i : i + 3]) for i in range(0, len(shape), 3)]
        if faceVertIndices is None:
            self._faces = [list(range(len(self._points)))]
        else:
            at = 0
            for count in faceVertCount or [len(faceVertIndices)]:
                self._faces.append(list(faceVertIndices[at : at + count]))
                at += count
        self._shapes = gable.Shapes.mesh(self._points, self._faces, holes)

    def get_vertex_count(self) -> int:
        """The number of coordinates: three a vertex."""
        return 3 * len(self._points)

    def get_index_count(self) -> int:
        return sum(len(f) for f in self._faces)

    def get_face_counts_count(self) -> int:
        return len(self._faces)

    def get_path(self) -> str:
        return self._path


class GeneratedModel:
    """What rules made of one initial shape."""

    def __init__(self, index: int, model: gable.Model, options: Mapping[str, Any]):
        self._index = index
        self._model = model
        self._report = _report_of(model) if options.get("emitReport", True) else {}
        self._mesh = model.mesh() if options.get("emitGeometry", True) else None

    def get_initial_shape_index(self) -> int:
        return self._index

    def get_vertices(self) -> list[float]:
        return [] if self._mesh is None else self._mesh.positions.ravel().tolist()

    def get_indices(self) -> list[int]:
        return [] if self._mesh is None else self._mesh.triangles.ravel().tolist()

    def get_faces(self) -> list[int]:
        """The number of indices of each face: 3, since faces are triangles."""
        return [] if self._mesh is None else [3] * len(self._mesh.triangles)

    def get_report(self) -> dict[str, Any]:
        return dict(self._report)

    def get_cga_prints(self) -> str:
        return "".join(text + "\n" for text in self._model.prints)

    def get_cga_errors(self) -> list[str]:
        return [str(m) for m in self._model.messages]

    def get_attributes(self) -> dict[str, Any]:
        return self._model.attributes(0)


class ModelGenerator:
    """Applies rules to initial shapes."""

    def __init__(self, initialShapes: Sequence[InitialShape]):
        self._shapes = list(initialShapes)

    def generate_model(
        self,
        shapeAttributes: Sequence[Mapping[str, Any]],
        rulePackagePath: str | os.PathLike[str],
        geometryEncoderName: str = PY_ENCODER,
        geometryEncoderOptions: Mapping[str, Any] | None = None,
    ) -> list[GeneratedModel]:
        """One mapping of attributes for all shapes, or one each. The rules are a package or a rule
        file. Encoders other than the PyEncoder write files to 'outputPath' and give an empty list.
        """
        options = geometryEncoderOptions or {}
        if len(shapeAttributes) not in (1, len(self._shapes)):
            raise ValueError(
                f"there are {len(self._shapes)} initial shapes and {len(shapeAttributes)} attribute "
                "dictionaries; give one for all, or one each"
            )
        if geometryEncoderName != PY_ENCODER and geometryEncoderName not in _EXTENSIONS:
            known = ", ".join([PY_ENCODER, *_EXTENSIONS])
            raise ValueError(f"there is no encoder {geometryEncoderName!r}; the encoders are {known}")
        for name in options:
            if name not in _OPTIONS:
                warnings.warn(f"the encoder option {name!r} is not heeded{_meant(name, _OPTIONS)}", stacklevel=2)
        rules = gable.Rules.load(rulePackagePath)
        models = []
        for index, shape in enumerate(self._shapes):
            given = shapeAttributes[index if len(shapeAttributes) > 1 else 0]
            model = _derived(rules, shape, given)
            if geometryEncoderName == PY_ENCODER:
                models.append(GeneratedModel(index, model, options))
            else:
                model.write(_path_of(given, options, index, _EXTENSIONS[geometryEncoderName]))
        return models


def get_rpk_attributes_info(rulePackagePath: str | os.PathLike[str]) -> dict[str, Any]:
    """By attribute its type and its annotations; hidden ones are left out."""
    return {
        a.name: {"annotations": [_annotation_of(n) for n in a.annotations], "type": a.type}
        for a in gable.Rules.load(rulePackagePath).attributes
        if not a.hidden
    }


def inspect_rpk(rulePackagePath: str | os.PathLike[str]) -> dict[str, str]:
    """By attribute its type."""
    return {name: info["type"] for name, info in get_rpk_attributes_info(rulePackagePath).items()}


def initialize_prt(*_: Any) -> None:
    """There is nothing to start."""


def shutdown_prt() -> None:
    """There is nothing to stop."""


def is_prt_initialized() -> bool:
    return True


def get_api_version() -> list[int]:
    """Of Gable."""
    return [int(part) for part in gable.__version__.split(".")]


def _meant(name: str, known: Iterable[str]) -> str:
    """The end of a sentence that tells the nearest name; empty where none is near."""
    near = difflib.get_close_matches(name, known, 1)
    return f"; {near[0]!r} may be meant" if near else ""


def _derived(rules: gable.Rules, shape: InitialShape, given: Mapping[str, Any]) -> gable.Model:
    known = {a.name for a in rules.attributes}
    attributes = {}
    for name, value in given.items():
        if name in known:
            attributes[name] = value
        elif name not in _NO_ATTRIBUTES:
            warnings.warn(f"the rules have no attribute {name!r}{_meant(name, known)}", stacklevel=3)
    start = given.get("startRule")
    # PRT names styles and rules as "Default$Lot".
    start_rule = str(start).rpartition("$")[2] if start else None
    return gable.derive(
        rules,
        shape._shapes,
        seed=int(given.get("seed", 0)),
        start_rule=start_rule,
        attributes=attributes,
    )


def _path_of(given: Mapping[str, Any], options: Mapping[str, Any], index: int, extension: str) -> str:
    folder = given.get("outputPath", options.get("outputPath", "."))
    os.makedirs(folder, exist_ok=True)
    name = options.get("baseName") or given.get("shapeName", "InitialShape")
    return os.path.join(folder, f"{name}_{index}{extension}")


def _report_of(model: gable.Model) -> dict[str, Any]:
    out: dict[str, Any] = {}
    for key, report in model.reports.items():
        if report.sum is None:
            out[key] = next(iter(report.values), None)
            continue
        out[f"{key}_n"] = float(report.count)
        out[f"{key}_sum"] = report.sum
        out[f"{key}_avg"] = report.mean
        out[f"{key}_min"] = report.min
        out[f"{key}_max"] = report.max
    return out


def _annotation_of(annotation: Annotation) -> list[Any]:
    name, arguments = annotation
    pairs = [(key, value) for key, value in arguments.items() if key]
    pairs += [(NO_KEY, value) for value in arguments.get("", [])]
    return [f"@{name}", *([key, _value_of(value)] for key, value in pairs)]


def _value_of(text: str) -> Any:
    if text in ("true", "false"):
        return text == "true"
    try:
        return float(text)
    except ValueError:
        return text
