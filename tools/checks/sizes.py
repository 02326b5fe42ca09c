# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Files of at most 800 lines, those of the page of 600; functions of at most 100; styles of under 300."""
import ast
import re

from .tree import CPP, Finding, code_of, line_at

FILE_LINES = 800
FUNCTION_LINES = 100
# The styles among the examples are to be read whole.
STYLES = ("haussmann", "monaco", "rowhouse", "suburb_house", "tower")
STYLE_LINES = 299
# The page's files; eslint holds their functions and columns to 100.
PAGE, PAGE_LINES = "studio/src/", 600
SCRIPTS = (".py", ".sh", ".cmake", ".mjs", ".ts", ".svelte")
# What opens a brace without being a function.
_SCOPE = re.compile(r"\b(namespace|class|struct|union|enum|extern)\b")
_NAME = re.compile(r"([~\w:]+|operator\s*\S{1,3}|operator\(\))\s*\($")


def function_spans(text):
    """(name, first line, last line) of the functions in a C++ file, by matching braces: a function is
    an outermost brace, under namespaces and classes only, whose head has a parameter list."""
    code = code_of(text)
    code = re.sub(r"^[ \t]*#(?:\\\n|[^\n])*", lambda m: re.sub(r"[^\n]", " ", m.group(0)), code,
                  flags=re.M)
    stack = []  # of "scope" (namespaces and classes), "inner" (braces within a head) and "body"
    head_start = 0
    opened = None
    for match in re.finditer(r"[{};]", code):
        at, mark = match.start(), match.group(0)
        in_body = "body" in stack
        if mark == "{":
            head = code[head_start:at]
            kind = "body" if in_body else _kind(head)
            if kind == "body" and not in_body:
                opened = _function_name(head), head_start + len(head) - len(head.lstrip())
            stack.append(kind)
        elif mark == "}" and stack:
            if stack.pop() == "inner" and not in_body:
                continue
            if opened and "body" not in stack:
                if opened[0]:
                    yield opened[0], line_at(code, opened[1]), line_at(code, at)
                opened = None
        if "body" not in stack and "inner" not in stack:
            head_start = at + 1


def _kind(head):
    """What a brace after `head` opens."""
    if head.count("(") != head.count(")"):
        return "inner"
    # A member's initialiser in the list of a constructor.
    if re.search(r"\)\s*(?:noexcept\s*)?:(?!:)", head) and re.search(r"[\w>]\s*$", head):
        return "inner"
    return "scope" if _SCOPE.search(_without_templates(head)) else "body"


def _without_templates(head):
    return re.sub(r"template\s*<[^{};]*?>\s*(?=\w)", "", head) if "(" in head else head


def _function_name(head):
    """The name before the first parenthesis, or None where the brace initialises a variable."""
    if "(" not in head or re.search(r"(^|[^=!<>])=\s*$", head):
        return None
    match = _NAME.search(head[:head.index("(") + 1])
    return match.group(1) if match else None


def python_spans(text):
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            yield node.name, node.lineno, node.end_lineno


def check(tree):
    findings = []
    for path in tree.files(*CPP, *SCRIPTS) + [p for p in ("run", "test") if tree.exists(p)]:
        text = tree.text(path)
        lines = text.count("\n")
        most = PAGE_LINES if path.startswith(PAGE) else FILE_LINES
        if lines > most:
            findings.append(Finding(path, 0, f"{lines} lines; {most} is the end", path))
        spans = (function_spans(text) if path.endswith(CPP)
                 else python_spans(text) if path.endswith(".py") else ())
        for name, first, last in spans:
            if last - first + 1 > FUNCTION_LINES:
                findings.append(Finding(path, first, f"{name} has {last - first + 1} lines; "
                                        f"{FUNCTION_LINES} is the end", f"{path}:{name}"))
    for path in (f"examples/{name}/{name}.cga" for name in STYLES):
        lines = tree.text(path).count("\n") if tree.exists(path) else 0
        if lines > STYLE_LINES:
            findings.append(Finding(path, 0, f"{lines} lines; {STYLE_LINES} is the end", path))
    return findings
