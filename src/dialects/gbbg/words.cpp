// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The words of GBBG for editors.

#include "dialects/dialect.h"

namespace gable::gbbg {

std::span<const DialectWord> words() {
  static constexpr DialectWord kWords[] = {
      {"Scope", "Scope(T(x, y, z), R(x, y, z), S(x, y, z)) {Q}", nullptr,
       "The box moved, turned and resized; what is left out is off.",
       "Scope(T(${1:0}, 0, 0), S(0, 0, 0)) {${2:Q}}"},
      {"Split", "Split(axis, {widths}, FromRoot | ToRoot) {A | B | ..}", "split",
       "Pieces of given widths along an axis; the last one is the rest.",
       "Split(${1:Y}, {${2:1}}) {${3:A} | ${4:B}}"},
      {"Repeat", "Repeat(axis) {Q}", "splitRepeat",
       "Equal pieces along an axis, as near to the preferred size of Q as they can be.",
       "Repeat(${1:X}) {${2:Q}}"},
      {"Grid", "Grid(axis) {Q}", "splitGrid", "Equal pieces along the two other axes.",
       "Grid(${1:Y}) {${2:Q}}"},
      {"Margin", "Margin(axis, width, Default | FacingOut | FacingIn) {Corner | Edge | Center}",
       "margin", "Four corners, four edges and a centre; NoCenter leaves a ring.",
       "Margin(${1:Y}, ${2:1}, FacingOut) {${3:Corner} | ${4:Edge} | ${5:Center}}"},
      {"Component", "Component(axis, faces) {Side | Top | Bottom}", "comp",
       "Faces of the box as 2D shapes: AllFaces, Sides, Top, Bottom, SidesPlusTop, "
       "SidesPlusBottom, TopPlusBottom.",
       "Component(${1:Y}, ${2:Sides}) {${3:Side}}"},
      {"T", "T(x, y, z, Add | Set, Local | World)", nullptr, "Moves the box, in metres.", ""},
      {"R", "R(x, y, z, Add | Set, Local | World)", nullptr,
       "Turns the box, in degrees, in the order z, x, y.", ""},
      {"S", "S(x, y, z, Add | Set, Absolute | Relative)", nullptr,
       "Resizes the box. With Set a size of 0 makes a face, -1 leaves an axis as it is.", ""},
      {"axiom", "axiom SYMBOL at (x, y, z) rotate (x, y, z) size (w, h, d)", nullptr,
       "What the derivation begins with.", "axiom ${1:START} size (${2:10}, 10, 10)"},
      {"shape", "shape Symbol 3D | 2D | Empty [x, y, z]", nullptr,
       "Declares a symbol; in brackets the size that it prefers, 0 for any.",
       "shape ${1:Symbol} [0, ${2:3}, 0]"},
      {"terminal", "terminal Symbol 3D | 2D | Empty [x, y, z]", nullptr,
       "Declares a symbol that is not rewritten.", "terminal ${1:Symbol}"},
      {"select", "select first | random | weighted", nullptr,
       "Which of several rules of one symbol counts.", ""},
      {"use", "use \"common.gbbg\"", nullptr, "Takes the rules of another grammar.",
       "use \"${1:common.gbbg}\""},
      {"postprocess", "postprocess { Symbol : \"asset.glb\" }", nullptr,
       "Models that take the place of terminal shapes.",
       "postprocess {\n  ${1:Symbol} : \"${2:assets/model.glb}\"\n}"},
      {"X", "X", nullptr, "The x axis of the box.", ""},
      {"Y", "Y", nullptr, "The y axis of the box.", ""},
      {"Z", "Z", nullptr, "The z axis of the box.", ""},
      {"FromRoot", "FromRoot", nullptr,
       "Where pieces are counted from: the least corner, or the far end.", ""},
      {"ToRoot", "ToRoot", nullptr,
       "Where pieces are counted from: the least corner, or the far end.", ""},
      {"Default", "Default", nullptr, "How the pieces of a margin are turned.", ""},
      {"FacingOut", "FacingOut", nullptr, "How the pieces of a margin are turned.", ""},
      {"FacingIn", "FacingIn", nullptr, "How the pieces of a margin are turned.", ""},
      {"Center", "Center", nullptr, "Whether a margin has a piece in the middle.", ""},
      {"NoCenter", "NoCenter", nullptr, "Whether a margin has a piece in the middle.", ""},
      {"AllFaces", "AllFaces", nullptr, "Faces that Component takes.", ""},
      {"Sides", "Sides", nullptr, "Faces that Component takes.", ""},
      {"Top", "Top", nullptr, "Faces that Component takes.", ""},
      {"Bottom", "Bottom", nullptr, "Faces that Component takes.", ""},
      {"SidesPlusTop", "SidesPlusTop", nullptr, "Faces that Component takes.", ""},
      {"SidesPlusBottom", "SidesPlusBottom", nullptr, "Faces that Component takes.", ""},
      {"TopPlusBottom", "TopPlusBottom", nullptr, "Faces that Component takes.", ""},
      {"Add", "Add", nullptr, "How T, R or S is meant.", ""},
      {"Set", "Set", nullptr, "How T, R or S is meant.", ""},
      {"Local", "Local", nullptr, "How T, R or S is meant.", ""},
      {"World", "World", nullptr, "How T, R or S is meant.", ""},
      {"Absolute", "Absolute", nullptr, "How T, R or S is meant.", ""},
      {"Relative", "Relative", nullptr, "How T, R or S is meant.", ""},
      {"On", "On", nullptr, "How T, R or S is meant.", ""},
      {"Off", "Off", nullptr, "How T, R or S is meant.", ""},
      {"EMPTY", "EMPTY", nullptr, "Nothing.", ""},
  };
  return kWords;
}

}  // namespace gable::gbbg
