#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Begins an operation: tools/new_op.py FAMILY NAME, for example `tools/new_op.py build roofDome`.

Writes src/builtins/ops/FAMILY/NAME.cpp with its specification and an empty body, a .test whose case
fails until the body does something, and the .md page for users. Then: write the case first, make it
pass, write the page. CONTRIBUTING.md tells the rest.
"""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
OPS = "src/builtins/ops"

SOURCE = """// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// How {name} works, and on what paper where there is one.

#include "builtins/lists.h"
#include "shape/op_call.h"

namespace gable {{

namespace {{

// A field for each parameter; its type is the type of the parameter (program/arguments.h): a Size
// may be written as a share of the scope, '0.5.
struct Arguments {{
  double distance;
}};

// Changes call.shape(), or fails and leaves it as it was. A loop whose length depends on the
// arguments or the shape calls work() (base/work.h). Draws come from call.randomAddress(k).
Status apply(OpCall& call, const Arguments& args) {{
  (void)call;
  (void)args.distance;
  return {{}};
}}

constexpr ParamSpec kParams[] = {{
    param<&Arguments::distance>("distance", "What the number means, in metres."),
}};
constexpr Signature kSignatures[] = {{{{kParams}}}};

// kPure: the result depends on the shape and the arguments alone. Declare what else it looks at:
// kRandom, kReadsWorld, kReadsPivot, ... (docs/dev/effects.md); tests stop at what is not declared.
// An operation with braces says which kind. withLight() adds a short way for boxes and rectangles.
constexpr OpSpec kSpecs[] = {{
    {{"{name}", "{family}", "One sentence that says what it does to the shape.", kSignatures,
     typed<apply>, BlockKind::None, kPure}},
}};

}}  // namespace

extern const OpList kOps_{stem};
const OpList kOps_{stem} = kSpecs;

}}  // namespace gable
"""

CASE = """== {name}DoesWhatItsNameSays
rule:
  Lot --> {name}(1) Done
shape: lot 4x5
expect:
  leaves Done 1
  area Done 0
  diagnostics none
"""

PAGE = """What {name} is for, in one or two sentences a rule author understands.

## Example

```cga
Lot --> {name}(1) Done
```

## Notes

What happens at the limits: a distance of zero, a shape with holes, a shape that is not flat.
"""


def snake(name):
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()


def create(root, family, name):
    """Writes the three files below `root`; returns their paths, none where the stem is taken."""
    stem = snake(name)
    if any((root / OPS).glob(f"*/{stem}.cpp")):
        return []
    folder = root / OPS / family
    folder.mkdir(parents=True, exist_ok=True)
    paths = []
    for suffix, text in (("cpp", SOURCE), ("test", CASE), ("md", PAGE)):
        paths.append(folder / f"{stem}.{suffix}")
        paths[-1].write_text(text.format(name=name, family=family, stem=stem), encoding="utf-8")
    return paths


def main():
    if len(sys.argv) != 3 or not re.fullmatch(r"[a-z_]+", sys.argv[1]) or not re.fullmatch(
            r"[a-z][A-Za-z0-9]*", sys.argv[2]):
        print(__doc__, file=sys.stderr)
        return 2
    family, name = sys.argv[1:]
    paths = create(ROOT, family, name)
    if not paths:
        print(f"{snake(name)}.cpp is there already", file=sys.stderr)
        return 1
    for path in paths:
        print(path.relative_to(ROOT))
    print(f"Next: write the case in {snake(name)}.test, then ./test case.{snake(name)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
