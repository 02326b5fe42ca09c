#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Debian packages of a build have what they should: packages_test.py BUILD FOLDER.

Without compression, for time's sake; tools/packages.sh installs and uses them.
"""
import re
import shutil
import subprocess
import sys
from pathlib import Path

BUILD, FOLDER = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
DOC = ("usr/share/doc/{}/copyright", "usr/share/doc/{}/changelog.gz")
HOLDS = {
    "gable": ["usr/bin/gable", "usr/bin/gable-convert", "usr/share/man/man1/gable.1.gz", "usr/share/man/man1/gable-tiles-plan.1.gz",
              "usr/share/bash-completion/completions/gable", "usr/share/zsh/vendor-completions/_gable",
              "usr/share/fish/vendor_completions.d/gable.fish", "usr/share/gable/examples/rules/city.cga"],
    "libgable0.1": ["usr/lib/libgable.so.0.1"],
    "libgable-dev": ["usr/lib/libgable.so", "usr/lib/libgable.a", "usr/include/gable/c.h", "usr/lib/pkgconfig/gable.pc",
                     "usr/lib/cmake/gable/gableConfig.cmake"],
    "python3-gable": ["usr/lib/python3/dist-packages/gable/__init__.py", "usr/lib/python3/dist-packages/gable/py.typed"],
}
NEEDS = {"gable": ["libc6", "libpng16-16", "libstdc++6"], "libgable0.1": ["libc6", "libpng16-16"],
         "libgable-dev": ["libgable0.1 (= "], "python3-gable": ["python3 (>= 3.", "python3-numpy", "libc6"]}


def run(*command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, command))}\n{done.stdout}\n{done.stderr}")
    return done.stdout


def main():
    for tool in ("cpack", "dpkg-deb", "dpkg-shlibdeps", "gzip", "strip"):
        if not shutil.which(tool):
            print(f"skipped: {tool} is not installed")
            return 77
    shutil.rmtree(FOLDER, ignore_errors=True)
    run("cpack", "--config", BUILD / "CPackConfig.cmake", "-G", "DEB", "-B", FOLDER, "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=none")
    packages = {path.name.split("_")[0]: path for path in FOLDER.glob("*.deb")}
    expected = set(HOLDS) if list((BUILD / "python/gable").glob("_gable*.so")) else set(HOLDS) - {"python3-gable"}
    wrong = [] if set(packages) == expected else [f"packages: {sorted(packages)}"]
    for name, path in packages.items():
        files = {line.split(None, 5)[5].split(" -> ")[0].removeprefix("./") for line in run("dpkg-deb", "-c", path).splitlines()}
        for file in [*HOLDS[name], *(d.format(name) for d in DOC)]:
            if file not in files:
                wrong.append(f"{name}: {file} is missing")
        wrong += [f"{name}: {f} has no place in it" for f in files if re.search(r"__pycache__|usr/local|/LICENSE$", f)]
        depends = run("dpkg-deb", "-f", path, "Depends")
        wrong += [f"{name}: depends on {depends.strip()}, not on {need}" for need in NEEDS[name] if need not in depends]
    print("\n".join(wrong) or f"{len(packages)} packages have what they should")
    shutil.rmtree(FOLDER, ignore_errors=True)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
