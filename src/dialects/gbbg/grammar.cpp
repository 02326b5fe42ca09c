// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "dialects/gbbg/grammar.h"

namespace gable::gbbg {

bool hasSides(Faces f) {
  return f != Faces::Top && f != Faces::Bottom && f != Faces::TopPlusBottom;
}

bool hasTop(Faces f) {
  return f == Faces::AllFaces || f == Faces::Top || f == Faces::SidesPlusTop ||
         f == Faces::TopPlusBottom;
}

bool hasBottom(Faces f) {
  return f == Faces::AllFaces || f == Faces::Bottom || f == Faces::SidesPlusBottom ||
         f == Faces::TopPlusBottom;
}

size_t slotCount(const Rule& rule) {
  switch (rule.op) {
    case Operator::Split: return rule.points.size() + 1;
    case Operator::Margin: return rule.center ? 3 : 2;
    case Operator::Component:
      return size_t{hasSides(rule.faces)} + hasTop(rule.faces) + hasBottom(rule.faces);
    default: return 1;
  }
}

std::string slotNames(const Rule& rule) {
  std::string names;
  const auto add = [&](bool there, const char* name) {
    if (there) names += (names.empty() ? "" : " | ") + std::string(name);
  };
  switch (rule.op) {
    case Operator::Split:
      for (size_t i = 0; i < slotCount(rule); ++i) {
        add(i < 8, i < 7 ? ("Q" + std::to_string(i + 1)).c_str() : "...");
      }
      break;
    case Operator::Margin:
      add(true, "corner");
      add(true, "edge");
      add(rule.center, "center");
      break;
    case Operator::Component:
      add(hasSides(rule.faces), "sides");
      add(hasTop(rule.faces), "top");
      add(hasBottom(rule.faces), "bottom");
      break;
    default: add(true, "Q"); break;
  }
  return names;
}

const char* operatorName(Operator op) {
  static constexpr const char* kNames[] = {"Scope", "Split",  "Repeat",
                                           "Grid",  "Margin", "Component"};
  return kNames[static_cast<size_t>(op)];
}

const char* facesName(Faces f) {
  static constexpr const char* kNames[] = {
      "AllFaces", "Sides", "Top", "Bottom", "SidesPlusTop", "SidesPlusBottom", "TopPlusBottom"};
  return kNames[static_cast<size_t>(f)];
}

}  // namespace gable::gbbg
