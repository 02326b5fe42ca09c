# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Tables of the real geopandas and pandas: frames.py BUILD, from the repository's root.

A frame becomes the shapes that its file becomes, in metres and in degrees; its columns become attributes; leaves come
back as a table.
"""
import sys
import warnings
from pathlib import Path

sys.path.insert(0, str(Path(sys.argv[1]).resolve() / "python"))

import geopandas  # noqa: E402
import pandas  # noqa: E402

import gable  # noqa: E402

RULES = gable.Rules.parse("""
attr floors = 2
@StartRule
Lot --> report("site", geometry.area) report("floors", floors) extrude(3 * floors) comp(f) { top : Roof. | all : Wall. }
""")


def near(a, b, within):
    assert abs(a - b) <= within * abs(b), (a, b)


def main():
    warnings.simplefilter("error", gable.Warning)
    metres = geopandas.read_file("docs/notebooks/parcels.gpkg")
    degrees = metres.to_crs(4326)
    wanted = gable.derive(RULES, gable.Shapes.load("docs/notebooks/parcels.gpkg"))
    metres["floors"] = degrees["floors"] = [1 + n % 4 for n in range(len(metres))]
    for frame in (metres, degrees):
        model = gable.derive(RULES, gable.Shapes.of_frame(frame))
        near(model.reports["site"].sum, wanted.reports["site"].sum, 1e-3)
        assert model.reports["floors"].sum == metres["floors"].sum(), model.reports["floors"]
        leaves = model.leaves()
        assert isinstance(leaves, pandas.DataFrame) and len(leaves) == len(model)
        assert set(leaves["name"]) == {"Roof", "Wall"}, leaves["name"]
        heights = leaves[leaves["name"] == "Wall"].groupby("line").size()
        print(f"{frame.crs.to_string()}: {len(frame)} rows, {len(model)} leaves, "
              f"{model.reports['site'].sum:.0f} m2, walls by line {heights.to_dict()}")
    # Polygons in degrees without a frame are told of.
    try:
        gable.Shapes.of_geometries(degrees.geometry)
    except gable.Warning as warning:
        assert "of_frame" in str(warning), warning
    else:
        raise AssertionError("degrees were taken for metres")
    print(f"geopandas {geopandas.__version__}, pandas {pandas.__version__}: passed")


main()
