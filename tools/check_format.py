#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Names the C++ files that .clang-format would change: tools/check_format.py [--fix].

Only clang-format 14 counts, Debian 12's: other versions format differently. Where it is missing there is
nothing to say. Exit status 1 where a file would change.
"""
import subprocess
import sys
from pathlib import Path

from checks.tree import CPP, Tree

ROOT = Path(__file__).resolve().parent.parent


def usable(program):
    try:
        version = subprocess.run([program, "--version"], capture_output=True, text=True, check=False)
    except OSError:
        return False
    return "version 14." in version.stdout


def main():
    program = next((p for p in ("clang-format-14", "clang-format") if usable(p)), None)
    paths = Tree(ROOT).files(*CPP)
    if not program or not paths:
        return 0
    fix = "--fix" in sys.argv[1:]
    done = subprocess.run([program, *(["-i"] if fix else ["--dry-run"]), *paths], cwd=ROOT, text=True,
                          capture_output=True, check=False)
    changed = sorted({line.split(":", 1)[0] for line in done.stderr.splitlines()
                      if "-Wclang-format-violations" in line})
    if changed:
        print(f"not formatted ({len(changed)} files; tools/check_format.py --fix mends them): "
              + " ".join(changed[:8]) + (" ..." if len(changed) > 8 else ""))
    return 1 if changed else 0


if __name__ == "__main__":
    sys.exit(main())
