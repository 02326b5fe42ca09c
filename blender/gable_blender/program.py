# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Finds the program `gable`: the one of the preferences, on the PATH, or beside the add-on. Needs no Blender."""
import os
import re
import shutil
import subprocess

# The first version whose commands and JSON this add-on knows.
OLDEST = (0, 1, 0)
SECONDS = 20


class Unusable(Exception):
    """Says what is wrong and what helps."""

    def __init__(self, text, hint):
        super().__init__(text)
        self.text, self.hint = text, hint


def candidates(preferred, folder, path=None):
    """Paths to look at, in this order."""
    name = "gable.exe" if os.name == "nt" else "gable"
    if preferred:
        return [os.path.abspath(os.path.expanduser(preferred))]
    found = shutil.which(name, path=path)
    beside = [os.path.join(folder, name), os.path.join(folder, "bin", name)]
    return ([found] if found else []) + [p for p in beside if os.path.isfile(p)]


def version_of(program):
    """(0, 1, 0); raises Unusable where it is no gable."""
    try:
        done = subprocess.run([program, "--version"], capture_output=True, text=True, errors="replace",
                              timeout=SECONDS, stdin=subprocess.DEVNULL)
    except (OSError, subprocess.SubprocessError) as error:
        raise Unusable(f"'{program}' cannot be run: {error}", "choose the program gable in the add-on's preferences") from error
    match = re.match(r"gable (\d+)\.(\d+)\.(\d+)", done.stdout)
    if done.returncode != 0 or not match:
        raise Unusable(f"'{program}' is not the program gable: it does not tell its version",
                       "choose the program gable in the add-on's preferences")
    return tuple(int(n) for n in match.groups())


def find(preferred, folder, path=None):
    """(program, version)."""
    found = candidates(preferred, folder, path)
    if not found:
        raise Unusable("the program gable is not found on the PATH nor beside the add-on",
                       "install Gable, or choose its program in the add-on's preferences")
    program = found[0]
    if not os.path.isfile(program):
        raise Unusable(f"there is no file '{program}'", "choose the program gable in the add-on's preferences")
    version = version_of(program)
    if version < OLDEST:
        text = ".".join(str(n) for n in version)
        oldest = ".".join(str(n) for n in OLDEST)
        raise Unusable(f"'{program}' is version {text}, and this add-on needs {oldest} or newer",
                       "install a newer Gable, or choose another program in the add-on's preferences")
    return program, version
