# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Programs as trees of text, so that a failing one can be made small whatever notation it is in."""


class Node:
    """A piece of a program: texts and nodes one after the other, and the texts that may stand in its place."""

    __slots__ = ("parts", "smaller", "sort")

    def __init__(self, parts, smaller=(), sort=None):
        self.parts = list(parts)
        self.smaller = smaller
        # A node may also be replaced by one of the same sort within it.
        self.sort = sort

    def text(self):
        return "".join(p if isinstance(p, str) else p.text() for p in self.parts)

    def nodes(self):
        """All nodes below this one, each with the node and the place that hold it; larger ones first."""
        for place, part in enumerate(self.parts):
            if isinstance(part, Node):
                yield self, place, part
                yield from part.nodes()


def joined(items, separator, smaller=(), sort=None):
    """Items with a text between them; the separator goes with the item behind it."""
    parts = []
    for index, item in enumerate(items):
        parts.append(Node([separator if index else "", item], ("",) if index else ()))
    return Node(parts, smaller, sort)


def optional(*parts):
    return Node(parts, ("",))


def smallest(root, fails, runs):
    """Makes the tree smaller as long as fails(text) holds, with at most that many calls; the number of calls used."""
    used = 0
    progress = True
    while progress:
        progress = False
        for parent, place, node in list(root.nodes()):
            if parent.parts[place] is not node:
                # Its place went with something larger.
                continue
            length = len(node.text())
            candidates = [c for c in node.smaller if len(c) < length]
            if node.sort:
                candidates += [n for _, _, n in node.nodes() if n.sort == node.sort][:6]
            for candidate in candidates:
                if used >= runs:
                    return used
                parent.parts[place] = candidate
                used += 1
                if fails(root.text()):
                    progress = True
                    break
                parent.parts[place] = node
    return used
