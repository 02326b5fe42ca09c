# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Pictures in docs/ and examples/ stay small, and so does every file."""
from .tree import PICTURES, Finding

PICTURE_BYTES = 400_000
FILE_BYTES = 2_000_000


def check(tree):
    findings = []
    for path in tree.paths:
        size = tree.size(path)
        if path.lower().endswith(PICTURES) and size > PICTURE_BYTES:
            findings.append(Finding(path, 0, f"{size} bytes; a picture has at most {PICTURE_BYTES}",
                                    path))
        elif size > FILE_BYTES:
            findings.append(Finding(path, 0, f"{size} bytes; a file has at most {FILE_BYTES}", path))
    return findings
