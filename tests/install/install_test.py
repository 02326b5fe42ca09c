#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""What `cmake --install` puts in place can be used: install_test.py BUILD FOLDER.

The programs of docs/guide/embedding.md are built against the installed tree, moved to another place, with
find_package and with pkg-config, against the shared and the static library, and print what the page says. The shared
library shows the public interface and nothing else. The installed program finds its page and its examples.
"""
import os
import re
import shutil
import subprocess
import sys
import unittest
import urllib.request
from pathlib import Path

BUILD, FOLDER = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
ROOT = Path(__file__).resolve().parents[2]
TREE = FOLDER / "moved"
PAGE = ROOT / "docs/guide/embedding.md"
PUBLIC = re.compile(r"gable::(Rules|Shapes|Model|LanguageServer|language::Workspace)::(?!Impl)|"
                    r"gable::language::(referencePage|search)(\[abi:cxx11\])?\(|gable::(derive|compare|convert|format|hasErrors|render|version|builtins|"
                    r"readRuleText|writeTextFile|modelExtensions|removeUnfinishedFiles|runLanguageServer|runStudio|"
                    r"runCases|caseFiles|tapText|junitText)"
                    r"(\[abi:cxx11\])?\(|gable_\w+$")
CONSUMER = """cmake_minimum_required(VERSION 3.25)
project(consumer C CXX)
find_package(gable 0.1 REQUIRED)
foreach(kind shared static)
  add_executable(cpp_${kind} town.cpp)
  add_executable(c_${kind} town.c)
  # Whoever links a C++ library statically links with the C++ compiler.
  set_target_properties(c_${kind} PROPERTIES LINKER_LANGUAGE CXX)
  target_link_libraries(cpp_${kind} PRIVATE gable::${kind})
  target_link_libraries(c_${kind} PRIVATE gable::${kind})
endforeach()
"""


def run(*command, **options):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False, **options)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, command))}\n{done.stdout}\n{done.stderr}")
    return done.stdout


def cached(name):
    text = (BUILD / "CMakeCache.txt").read_text(encoding="utf-8")
    return re.search(rf"^{name}:\w+=(.*)$", text, re.M).group(1)


def programs():
    """{language: (source, what it prints)} of the page."""
    blocks = re.findall(r"^```(\w*)\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.M | re.S)
    found = {}
    for (language, source), (after, printed) in zip(blocks, blocks[1:]):
        if language in ("cpp", "c") and after == "text":
            found[language] = (source, printed)
    return found


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(FOLDER, ignore_errors=True)
        first = FOLDER / "first"
        run("cmake", "--install", BUILD, "--prefix", first)
        first.rename(TREE)
        cls.lib = next(TREE.glob("lib*/**/libgable.so")).parent
        cls.programs = programs()
        cls.folder = FOLDER / "consumer"
        cls.folder.mkdir()
        for language, (source, _) in cls.programs.items():
            (cls.folder / f"town.{language}").write_text(source, encoding="utf-8")
        (cls.folder / "CMakeLists.txt").write_text(CONSUMER, encoding="utf-8")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(FOLDER, ignore_errors=True)

    def check(self, program, language):
        place = FOLDER / "run"
        place.mkdir(exist_ok=True)
        printed = run(program, cwd=place, env={**os.environ, "LD_LIBRARY_PATH": str(self.lib)})
        self.assertEqual(printed, self.programs[language][1])
        self.assertEqual((place / "house.glb").read_bytes()[:4], b"glTF")
        shutil.rmtree(place)

    def test_everything_is_in_place(self):
        self.assertEqual(sorted(self.programs), ["c", "cpp"])
        for name in ("bin/gable", "include/gable/gable.h", "include/gable/c.h", "share/gable/examples/README.md",
                     "share/gable/README.md", "share/gable/docs/guide/first-rules.md", "share/gable/docs/reference/README.md",
                     "share/doc/gable/LICENSE"):
            self.assertTrue((TREE / name).is_file(), name)
        for name in ("libgable.a", "pkgconfig/gable.pc", "cmake/gable/gableConfig.cmake",
                     "cmake/gable/gableConfigVersion.cmake"):
            self.assertTrue((self.lib / name).is_file(), name)
        # The tree can be moved, so nothing in it names a folder of this machine.
        for path in [*self.lib.glob("cmake/gable/*.cmake"), self.lib / "pkgconfig/gable.pc"]:
            text = path.read_text(encoding="utf-8")
            self.assertNotIn(str(FOLDER), text, path.name)
            self.assertNotIn(str(ROOT), text, path.name)

    def test_find_package(self):
        build = FOLDER / "cmake"
        run("cmake", "-S", self.folder, "-B", build, "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={TREE}",
            f"-DCMAKE_CXX_COMPILER={cached('CMAKE_CXX_COMPILER')}", f"-DCMAKE_C_COMPILER={cached('CMAKE_C_COMPILER')}")
        run("cmake", "--build", build)
        for kind in ("shared", "static"):
            self.check(build / f"cpp_{kind}", "cpp")
            self.check(build / f"c_{kind}", "c")

    @unittest.skipUnless(shutil.which("pkg-config"), "there is no pkg-config")
    def test_pkg_config(self):
        env = {**os.environ, "PKG_CONFIG_PATH": str(self.lib / "pkgconfig")}
        cpp, c = cached("CMAKE_CXX_COMPILER"), cached("CMAKE_C_COMPILER")
        flags = run("pkg-config", "--cflags", "--libs", "gable", env=env).split()
        static = run("pkg-config", "--static", "--cflags", "--libs", "gable", env=env).split()
        static = ["-l:libgable.a" if f == "-lgable" else f for f in static]
        for kind, options in (("shared", flags), ("static", static)):
            program = FOLDER / f"pc_{kind}"
            run(cpp, "-std=c++20", self.folder / "town.cpp", "-o", program, *options)
            self.check(program, "cpp")
            run(c, "-std=c99", "-Wall", "-Wextra", "-Werror", "-Wno-missing-field-initializers",
                self.folder / "town.c", "-o", program, *options)
            self.check(program, "c")

    def test_only_the_public_interface_is_exported(self):
        lines = run("nm", "-D", "--defined-only", "-C", self.lib / "libgable.so").splitlines()
        names = [line.split(" ", 2)[2] for line in lines if line.split(" ", 2)[1] != "A"]
        self.assertEqual([n for n in names if not PUBLIC.match(n)], [])
        header = (TREE / "include/gable/c.h").read_text(encoding="utf-8")
        declared = set(re.findall(r"^(?:gable_status|void|uint32_t|const char\*) (gable_\w+)\(", header, re.M))
        self.assertGreater(len(declared), 50)
        self.assertEqual(declared - set(names), set())
        self.assertEqual({n for n in names if n.startswith("gable_")} - declared, set())
        for name in ("derive", "convert", "format", "hasErrors", "render", "version", "builtins"):
            shown = re.compile(rf"gable::{name}(\[abi:cxx11\])?\(")
            self.assertTrue(any(shown.match(n) for n in names), name)

    def test_the_program_finds_its_page_and_examples(self):
        # A tree without a built page has one here, so that the place is tested.
        page = TREE / "share/gable/studio"
        page.mkdir(parents=True, exist_ok=True)
        if not (page / "index.html").exists():
            (page / "index.html").write_text("<!doctype html><title>Gable</title>\n", encoding="utf-8")
        project = FOLDER / "project"
        project.mkdir(exist_ok=True)
        server = subprocess.Popen([TREE / "bin/gable", "studio", project], stdout=subprocess.PIPE, text=True)
        try:
            url = server.stdout.readline().strip()
            base, token = url.split("/?token=")
            ask = urllib.request.build_opener()
            ask.addheaders = [("X-Gable-Token", token)]
            self.assertIn("<title>", ask.open(url, timeout=20).read().decode().lower())
            self.assertIn("monaco", ask.open(f"{base}/api/examples", timeout=20).read().decode())
        finally:
            server.terminate()
            server.wait(20)
            server.stdout.close()


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
