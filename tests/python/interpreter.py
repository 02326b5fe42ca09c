# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Which Python the tests of the module run under."""
import os
import subprocess
import sys

SKIP = 77


def with_numpy():
    """Runs this again under an interpreter of the same version that has numpy, where there is one."""
    try:
        import numpy  # noqa: F401
        return
    except ImportError:
        pass
    other = "/usr/bin/python3"
    same = f"import sys, numpy; sys.exit(sys.version_info[:2] != {sys.version_info[:2]})"
    if os.path.exists(other) and subprocess.run([other, "-c", same], capture_output=True).returncode == 0:
        os.execv(other, [other, "-B", *sys.argv])
    print("skipped: numpy is not installed for this Python (Debian's python3-numpy)")
    sys.exit(SKIP)
