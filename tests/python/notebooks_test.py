# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""The notebooks of docs/notebooks do what they show.

    notebooks_test.py BUILD

Runs the code of each notebook from its beginning, and compares what a cell prints, or what its last line
is worth, with what stands below it. Pictures are not compared. A notebook that needs a package that is not
there is skipped; tools/partners.sh runs them all in Jupyter.
"""
import ast
import contextlib
import io
import json
import os
import sys
from pathlib import Path

from interpreter import SKIP, with_numpy

FOLDER = Path(__file__).resolve().parents[2] / "docs" / "notebooks"


def imports(source):
    """The packages that a cell imports, but for those within `try`."""
    tree = ast.parse(source)
    guarded = {node for attempt in ast.walk(tree) if isinstance(attempt, ast.Try)
               for node in ast.walk(attempt)}
    for node in ast.walk(tree):
        if node in guarded:
            continue
        if isinstance(node, ast.Import):
            yield from (name.name.split(".")[0] for name in node.names)
        if isinstance(node, ast.ImportFrom):
            yield node.module.split(".")[0]


def run(source, names):
    """What the cell prints, and its last line's value as text."""
    tree = ast.parse(source)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(tree, "cell", "exec"), names)
        value = eval(compile(ast.Expression(last.value), "cell", "eval"), names) if last else None
    return printed.getvalue(), None if value is None else repr(value)


def shown(cell):
    """The same as it stands in the notebook; no text where the cell shows pictures."""
    text, value = "", None
    for output in cell["outputs"]:
        if output["output_type"] == "display_data":
            return None, None
        if output["output_type"] == "stream":
            text += "".join(output["text"])
        if output["output_type"] == "execute_result":
            value = "".join(output["data"]["text/plain"])
    return text, value


def check(path):
    cells = [c for c in json.loads(path.read_text(encoding="utf-8"))["cells"] if c["cell_type"] == "code"]
    sources = ["".join(cell["source"]) for cell in cells]
    for name in sorted({name for source in sources for name in imports(source)}):
        try:
            __import__(name)
        except ImportError:
            print(f"skipped: {path.name} needs the package {name}")
            return None
    names = {"__name__": "notebook"}
    for number, (cell, source) in enumerate(zip(cells, sources), 1):
        printed, value = run(source, names)
        wanted, worth = shown(cell)
        if wanted is not None and (printed, value) != (wanted, worth):
            print(f"{path.name}, code cell {number} shows\n{wanted}{worth}\nand is\n{printed}{value}")
            return False
    return True


def main():
    sys.path.insert(0, str(Path(sys.argv[1]).resolve() / "python"))
    os.environ.setdefault("MPLBACKEND", "Agg")
    os.chdir(FOLDER)
    results = [check(path) for path in sorted(FOLDER.glob("*.ipynb"))]
    if False in results or not results:
        return 1
    return 0 if True in results else SKIP


if __name__ == "__main__":
    with_numpy()
    sys.exit(main())
