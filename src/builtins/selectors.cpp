// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/selectors.h"

namespace gable {

namespace {

constexpr SelectorSpec kWords[] = {
    {"all", "Every component not selected before."},
    {"front", "Normal nearest to the scope's +z."},
    {"back", "Normal nearest to the scope's -z."},
    {"left", "Normal nearest to the scope's -x."},
    {"right", "Normal nearest to the scope's +x."},
    {"top", "Normal nearest to the scope's +y."},
    {"bottom", "Normal nearest to the scope's -y."},
    {"object.front", "As front, by the axes of the initial shape.",
     kReadsWorld | kReadsInitialShape},
    {"object.back", "As back, by the axes of the initial shape.", kReadsWorld | kReadsInitialShape},
    {"object.left", "As left, by the axes of the initial shape.", kReadsWorld | kReadsInitialShape},
    {"object.right", "As right, by the axes of the initial shape.",
     kReadsWorld | kReadsInitialShape},
    {"object.top", "As top, by the axes of the initial shape.", kReadsWorld | kReadsInitialShape},
    {"object.bottom", "As bottom, by the axes of the initial shape.",
     kReadsWorld | kReadsInitialShape},
    {"object.side", "All but top and bottom, by the axes of the initial shape.",
     kReadsWorld | kReadsInitialShape},
    {"world.south", "Normal nearest to the world's +z.", kReadsWorld},
    {"world.north", "Normal nearest to the world's -z.", kReadsWorld},
    {"world.west", "Normal nearest to the world's -x.", kReadsWorld},
    {"world.east", "Normal nearest to the world's +x.", kReadsWorld},
    {"world.up", "Normal nearest to the world's +y.", kReadsWorld},
    {"world.down", "Normal nearest to the world's -y.", kReadsWorld},
    {"world.side", "All but up and down, by the world's axes.", kReadsWorld},
    {"horizontal", "Normal over 78.75 degrees from the scope's ground plane."},
    {"vertical", "Normal within 11.25 degrees of the scope's ground plane."},
    {"aslant", "Normal between 11.25 and 78.75 degrees above the scope's ground plane."},
    {"nutant", "Normal between 11.25 and 78.75 degrees below the scope's ground plane."},
    {"side", "All but horizontal."},
    {"border", "Edges at one face, or faces that have such an edge."},
    {"inside", "Edges between faces, or faces that have only such edges."},
    {"eave", "Level edges at the foot of a roof."},
    {"hip", "Slanted convex edges of a roof."},
    {"valley", "Slanted concave edges of a roof."},
    {"ridge", "Level edges at the top of a roof."},
    {"street.front", "At a street; as object.front where no street is known.",
     kReadsWorld | kReadsInitialShape},
    {"street.back", "Opposite to the streets; else as object.back.",
     kReadsWorld | kReadsInitialShape},
    {"street.left", "To the left, with the street in front; else as object.left.",
     kReadsWorld | kReadsInitialShape},
    {"street.right", "To the right, with the street in front; else as object.right.",
     kReadsWorld | kReadsInitialShape},
    {"street.side", "As street.left or street.right; else as object.side.",
     kReadsWorld | kReadsInitialShape},
    {"streetSide", "As street.front.", kReadsWorld | kReadsInitialShape},
    {"noStreetSide", "All but street.front.", kReadsWorld | kReadsInitialShape},
    {"uv.left", "Edges at the lower u border of the texture space."},
    {"uv.right", "Edges at the upper u border of the texture space."},
    {"uv.top", "Edges at the upper v border of the texture space."},
    {"uv.bottom", "Edges at the lower v border of the texture space."},
    {"uv.uMin", "Edges at the least u."},
    {"uv.uMax", "Edges at the greatest u."},
    {"uv.vMin", "Edges at the least v."},
    {"uv.vMax", "Edges at the greatest v."},
    {"shape", "The part that the operation makes."},
    {"remainder", "What the operation leaves."},
};

}  // namespace

const std::span<const SelectorSpec> kSelectors = kWords;

}  // namespace gable
