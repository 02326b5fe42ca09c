#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""The rules shown in the documents run: documents_test.py GABLE FOLDER.

Every block marked ```cga in a Markdown file is derived on a lot of 30 x 20 metres, or checked where it has no
rule; none may have an error. Files that a block names are not there, which is a warning. A block of shapes (```obj,
```geojson, ```gltf) is what the rules before it are derived on, without a warning about it. Run from the repository's root.
"""
import re
import subprocess
import sys
from pathlib import Path

FENCE = re.compile(r"^```(cga|obj|geojson|gltf)\n(.*?)^```$", re.M | re.S)
SHAPES = re.compile(r"\[(?:shape|geojson|gltf|no-shapes)[a-z-]*\]")


def documents():
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "*.md"], capture_output=True,
                            text=True, check=False).stdout.split()
    found = listed or [p.as_posix() for p in Path(".").rglob("*.md")]
    # Reference pages repeat the prose beside the source.
    return sorted(p for p in found if not p.startswith(("build/", "docs/reference/")) and Path(p).exists())


def main():
    gable, folder = sys.argv[1], Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    count = failures = 0
    for document in documents():
        text = Path(document).read_text(encoding="utf-8")
        rules = None
        for match in FENCE.finditer(text):
            count += 1
            kind, content = match.groups()
            line = text.count("\n", 0, match.start()) + 2
            file = folder / f"{document.replace('/', '-')}-{line}.{kind}"
            file.write_text(content, encoding="utf-8")
            ground = ["--lot", "30x20"]
            if kind == "cga":
                rules = file
            else:
                ground = ["--shapes", str(file)]
            command = [gable, "check", str(rules)]
            if kind != "cga" or "-->" in content:
                command = [gable, "generate", str(rules), *ground, "-o", str(file.with_suffix(".glb"))]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            if done.returncode != 0 or (kind != "cga" and SHAPES.search(done.stderr)):
                failures += 1
                print(f"{document}:{line}: exit status {done.returncode}\n{done.stderr[-2000:]}")
    print(f"{count} examples, {failures} failures")
    return 1 if failures or not count else 0


if __name__ == "__main__":
    sys.exit(main())
