# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Who may include whom. The rule is tools/layers.toml; here is only how it is held against the files."""
import posixpath
import re
import tomllib

from .tree import CPP, Finding

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*(?:"([^"\n]+)"|<([^>\n]+)>)', re.M)
# Standard and system headers have no suffix, or are C's and POSIX's own.
PLAIN = re.compile(r"^[a-z_0-9]+$|^(sys|netinet|arpa|emscripten|linux)/[a-z_0-9/]+\.h$")


class Layers:
    def __init__(self, tree):
        self.tree = tree
        rule = tomllib.loads(tree.text("tools/layers.toml"))
        self.may = {name: set(names) for name, names in rule["layers"].items()}
        self.tests_may = {name: set(names) for name, names in rule.get("tests", {}).items()}
        self.test_only = tuple(rule.get("test_only", {}).get("prefixes", []))
        self.system = set(rule.get("system", {}).get("headers", []))
        self.owners = {h: [o] if isinstance(o, str) else o
                       for h, o in rule.get("third_party", {}).items()}
        self.sources = set(tree.files(*CPP))
        self.includes = {}  # file -> [(line, included file of ours)]

    def layer(self, path):
        """The layer a file belongs to; None for folders that are under no rule."""
        parts = path.split("/")
        if parts[0] == "src" and len(parts) > 2:
            return parts[1]
        if parts[0] in ("apps", "python"):
            return parts[0]
        if parts[0] == "include":
            return "include"
        return None

    def is_test(self, path):
        return (path.endswith("_test.cpp") or "/testing/" in path
                or path.startswith(("tests/", "fuzz/", "bench/")))

    def resolve(self, path, name):
        """The file of ours that an include means, or None."""
        beside = posixpath.normpath(posixpath.join(posixpath.dirname(path), name))
        for candidate in (beside, "src/" + name, "include/" + name):
            if candidate in self.sources:
                return candidate
        return None

    def check_own(self, path, line, target):
        if target.endswith(".cpp"):
            yield Finding(path, line, f"includes the source file {target}", path)
        here, there = self.layer(path), self.layer(target)
        if here is None or there is None or here == there:
            return
        allowed = self.may.get(here)
        if allowed is None:
            yield Finding(path, line, f"the folder {here} has no line in tools/layers.toml", path)
            return
        if self.is_test(path):
            allowed = allowed | self.tests_may.get(here, set())
        if there not in allowed and "*" not in allowed:
            yield Finding(path, line, f"{here} may not include {there} ({target})", path)

    def check_foreign(self, path, line, name):
        if PLAIN.match(name) or name in self.system:
            return
        if name.startswith(self.test_only):
            if not self.is_test(path):
                yield Finding(path, line, f"<{name}> is for tests only", path)
            return
        known = next((h for h in self.owners
                      if name == h or (h.endswith("/") and name.startswith(h))), None)
        if known is None:
            yield Finding(path, line, f"<{name}> has no owner in tools/layers.toml", path)
        elif path not in self.owners[known] and not self.is_test(path):
            owners = ", ".join(self.owners[known])
            yield Finding(path, line, f"<{name}> belongs to {owners} alone", path)

    def check_file(self, path):
        text = self.tree.text(path)
        self.includes[path] = []
        for match in INCLUDE.finditer(text):
            line = text.count("\n", 0, match.start()) + 1
            name = match.group(1) or match.group(2)
            target = self.resolve(path, name)
            if target:
                self.includes[path].append((line, target))
                yield from self.check_own(path, line, target)
            elif match.group(1) and not name.startswith(tuple(self.owners)):
                # Generated headers are written with angle brackets or end in .inc.
                if not name.endswith(".inc"):
                    yield Finding(path, line, f'no file "{name}"', path)
            else:
                yield from self.check_foreign(path, line, name)

    def check_cycles(self):
        """Files that include each other in a ring."""
        state = {}
        for start in sorted(self.includes):
            stack = [(start, iter(self.includes[start]))]
            if state.setdefault(start, "open") == "done":
                continue
            while stack:
                path, edges = stack[-1]
                line, target = next(edges, (0, None))
                if target is None:
                    state[path] = "done"
                    stack.pop()
                elif state.get(target) == "open":
                    yield Finding(path, line, f"includes {target}, which includes it", path)
                elif target not in state:
                    state[target] = "open"
                    stack.append((target, iter(self.includes.get(target, []))))


def check(tree):
    layers = Layers(tree)
    findings = []
    for path in sorted(layers.sources):
        findings += layers.check_file(path)
    findings += layers.check_cycles()
    for header, owners in layers.owners.items():
        for owner in owners:
            if owner.startswith("src/") and not tree.exists(posixpath.dirname(owner)):
                findings.append(Finding("tools/layers.toml", 0,
                                        f"the folder of {owner}, owner of <{header}>, is not there"))
    return findings
