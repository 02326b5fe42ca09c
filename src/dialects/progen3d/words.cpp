// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The words of ProGen3d for editors.

#include "dialects/dialect.h"

namespace gable::progen3d {

std::span<const DialectWord> words() {
  static constexpr DialectWord kWords[] = {
      {"S", "S ( x y z )", nullptr,
       "Scales what follows, on top of what was scaled before. Negative mirrors.",
       "S ( ${1:1} 1 1 )"},
      {"T", "T ( x y z )", nullptr, "Moves what follows, in the scaled and turned units.",
       "T ( ${1:0} 0 0 )"},
      {"A", "A ( degrees axis )", nullptr, "Turns what follows about axis 0 (x), 1 (y) or 2 (z).",
       "A ( ${1:90} 1 )"},
      {"D", "D ( x y z )", nullptr, "Tapers: scales the far side of what follows.",
       "D ( ${1:0.5} 1 0.5 )"},
      {"I", "I ( Cube texture turns scale )", "primitiveCube",
       "Draws Cube, CubeX, CubeY, Sphere or Cylinder with a texture of the list.",
       "I ( ${1:Cube} ${2:0} )"},
      {"R", "R name ( least most )", nullptr,
       "A number drawn anew at each call of a rule that lists it.",
       "R ${1:name} ( ${2:1} ${3:2} )"},
      {"Cube", "Cube", nullptr,
       "What I draws. Cube stands on the middle of its base, CubeX on the middle of its left lower "
       "edge, CubeY reaches forward.",
       ""},
      {"CubeX", "CubeX", nullptr,
       "What I draws. Cube stands on the middle of its base, CubeX on the middle of its left lower "
       "edge, CubeY reaches forward.",
       ""},
      {"CubeY", "CubeY", nullptr,
       "What I draws. Cube stands on the middle of its base, CubeX on the middle of its left lower "
       "edge, CubeY reaches forward.",
       ""},
      {"Sphere", "Sphere", nullptr,
       "What I draws. Cube stands on the middle of its base, CubeX on the middle of its left lower "
       "edge, CubeY reaches forward.",
       ""},
      {"Cylinder", "Cylinder", nullptr,
       "What I draws. Cube stands on the middle of its base, CubeX on the middle of its left lower "
       "edge, CubeY reaches forward.",
       ""},
      {"CubeZ", "CubeZ", nullptr,
       "What I draws in the web language: a box that reaches forward; the place moves to its end.",
       ""},
      {"DSX", "DSX ( x y z )", nullptr,
       "Scales the far side of x of the boxes that follow (web language); DSY and DSZ likewise.",
       "DSX ( ${1:1} 1 1 )"},
      {"DTX", "DTX ( x y z )", nullptr,
       "Moves the far side of x of the boxes that follow (web language); DTY and DTZ likewise.",
       "DTX ( ${1:0} 0 0 )"},
      {"GDSX", "GDSX ( x y z )", nullptr,
       "Scales the far side of x of all that follows in the bracket, as one body (web language).",
       "GDSX ( ${1:1} 1 1 )"},
      {"GDTX", "GDTX ( x y z )", nullptr,
       "Moves the far side of x of all that follows in the bracket, as one body (web language).",
       "GDTX ( ${1:0} 0 0 )"},
      {"rand", "rand(min max)", nullptr, "A number between two others (web language).",
       "rand(${1:0} ${2:1})"},
      {"sin", "sin(radians)", nullptr, "Of an angle.", ""},
      {"cos", "cos(radians)", nullptr, "Of an angle.", ""},
  };
  return kWords;
}

}  // namespace gable::progen3d
