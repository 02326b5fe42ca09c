# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""No function of the C library that rounds as it likes decides what a derivation makes: base/elementary.h and
math/trig.h have functions that give the same bits everywhere. Square roots, remainders and roundings are exact."""
import re

from .tree import CPP, Finding, code_of, line_at

# Pictures are no part of the promise.
FREE = ("src/render/", "src/studio/", "src/json/", "src/c/")
NAMES = ("sin cos tan asin acos atan atan2 sinh cosh tanh asinh acosh atanh sincos exp exp2 exp10 expm1 log log2 log10 "
         "log1p pow cbrt hypot erf erfc tgamma lgamma cyl_bessel_j").split()
CALL = re.compile(r"(?:\bstd::|(?<![\w:.>]))(" + "|".join(n + "[fl]?" for n in NAMES) + r")\s*\(")


def check(tree):
    findings = []
    copies = [path for path in tree.copies if path.endswith(CPP)]
    for path in tree.files(*CPP, under="src/") + copies:
        if path.startswith(FREE) or path.endswith("_test.cpp") or "/testing" in path:
            continue
        text = code_of(tree.text(path))
        for match in CALL.finditer(text):
            before = text[max(0, match.start() - 40):match.start()]
            if not match.group(0).startswith("std::"):
                word = re.search(r"(\w+)\s+$", before)
                if word and word.group(1) not in ("return", "else", "case"):
                    continue
            findings.append(Finding(path, line_at(text, match.start()),
                                    f"'{match.group(1)}' rounds differently from one C library to the next; "
                                    "take base/elementary.h or math/trig.h", path))
    return findings
