# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Gable: rules and footprints in, places out.

    import gable

    rules = gable.Rules.load("town.cga")
    lots = gable.Shapes.load("lots.geojson")
    town = gable.derive(rules, lots, seed=3, height=12)
    town.write("town.glb")

Lengths are metres, angles degrees. The frame is right-handed with y up: +x is east, -z is north.
Rules, Shapes and Model never change once they are made. What goes wrong is raised as gable.Error,
with the messages; what is only a warning stands in `messages` of the result, and Python's
`warnings` show each once as gable.Warning.
"""

from gable._dataset import Dataset, dataset
from gable._derive import derive
from gable._gable import version as __version__
from gable._messages import Error, Message, Warning
from gable._model import Leaf, Material, Mesh, Model, PartMesh, Parts, Report, ShapeReports
from gable._rules import Attribute, Rule, Rules
from gable._shapes import Outline, Shapes

__all__ = [
    "Attribute",
    "Dataset",
    "Error",
    "Leaf",
    "Material",
    "Mesh",
    "Message",
    "Model",
    "Outline",
    "PartMesh",
    "Parts",
    "Report",
    "Rule",
    "Rules",
    "ShapeReports",
    "Shapes",
    "Warning",
    "dataset",
    "derive",
]
