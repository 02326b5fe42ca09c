# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Builds the wheel: `pip install ./python`. Needs what the program needs to be built, pybind11-dev and
python3-dev, and no network. This is the build backend of PEP 517, called by pip.
"""

import base64
import hashlib
import os
import re
import subprocess
import sys
import sysconfig
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
# The same wheel from the same files, whenever it is built.
TIME = (1980, 1, 1, 0, 0, 0)


def version():
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"project\(gable VERSION ([0-9.]+)", text).group(1)


def metadata():
    lines = [
        "Metadata-Version: 2.1",
        "Name: gable",
        f"Version: {version()}",
        "Summary: Gable: the open engine for shape grammars",
        "License: Apache-2.0",
        "Requires-Python: >=3.9",
        "Requires-Dist: numpy",
        "Description-Content-Type: text/markdown",
        "",
        (ROOT / "docs" / "guide" / "python.md").read_text(encoding="utf-8"),
    ]
    return "\n".join(lines)


def built():
    """The folder of the package, with the compiled module in it."""
    folder = Path(os.environ.get("GABLE_PYTHON_BUILD", ROOT / "build" / "python"))
    cmake = [
        "cmake", "-S", str(ROOT), "-B", str(folder), "-G", "Ninja", "-D", "CMAKE_BUILD_TYPE=Release",
        "-D", "GABLE_TESTS=OFF", "-D", f"Python3_EXECUTABLE={sys.executable}",
    ]
    subprocess.run(cmake, check=True)
    subprocess.run(["ninja", "-C", str(folder), "gable_python"], check=True)
    package = folder / "python" / "gable"
    if not list(package.glob("_gable*.so")):
        raise SystemExit("the module was not built: install pybind11-dev and python3-dev")
    return package


def write_wheel(folder, package):
    """Zips a built package; gives the wheel's file name."""
    tag = f"cp{sys.version_info.major}{sys.version_info.minor}"
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    info = f"gable-{version()}.dist-info"
    name = f"gable-{version()}-{tag}-{tag}-{platform}.whl"
    files = {f"gable/{p.name}": p.read_bytes() for p in sorted(package.iterdir()) if p.is_file()}
    rules = ROOT / "examples"
    files |= {f"gable/bundled/{p.relative_to(rules)}": p.read_bytes() for p in sorted(rules.rglob("*.cga"))}
    files[f"{info}/METADATA"] = metadata().encode()
    files[f"{info}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    files[f"{info}/WHEEL"] = (
        f"Wheel-Version: 1.0\nGenerator: gable\nRoot-Is-Purelib: false\nTag: {tag}-{tag}-{platform}\n".encode()
    )
    record = []
    for path, content in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        record.append(f"{path},sha256={digest},{len(content)}")
    record.append(f"{info}/RECORD,,")
    files[f"{info}/RECORD"] = ("\n".join(record) + "\n").encode()
    with zipfile.ZipFile(Path(folder) / name, "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, content in files.items():
            entry = zipfile.ZipInfo(path, TIME)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            wheel.writestr(entry, content)
    return name


# The hooks that pip calls.
def get_requires_for_build_wheel(config_settings=None):
    return []


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    return write_wheel(wheel_directory, built())
