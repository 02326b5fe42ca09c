// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Predecessor -> Operator(Parameters) {Successor}. Parameters that are words may come in any order.

#include <cmath>

#include "base/text.h"
#include "dialects/gbbg/parser_impl.h"

namespace gable::gbbg {

bool Parser::rule(Rule& out) {
  if (current().kind == TokenKind::Text && ahead(1).kind != TokenKind::Arrow) {
    out.title = current().text;
    advance();
  }
  if (!expectSymbol(out.predecessor, "the symbol of a shape")) return false;
  if (current().kind != TokenKind::Arrow) return unexpected("'->'");
  advance();
  if (!operation(out) || !slots(out)) return false;
  if (acceptWord("weight")) {
    const Span span = spanOf(current());
    if (!expectNumber(out.weight, "a weight")) return false;
    if (!(out.weight >= 0)) {
      return error("gbbg-chance", span, "a weight is not negative",
                   "write a weight of zero or more");
    }
  }
  return true;
}

bool Parser::operation(Rule& out) {
  static constexpr Operator kAll[] = {Operator::Scope, Operator::Split,  Operator::Repeat,
                                      Operator::Grid,  Operator::Margin, Operator::Component};
  std::vector<std::string_view> names;
  for (const Operator op : kAll) {
    names.emplace_back(operatorName(op));
    if (!isWord(names.back())) continue;
    out.op = op;
    out.opSpan = spanOf(current());
    advance();
    if (!expect('(', "after the operator")) return false;
    switch (op) {
      case Operator::Scope: return scope(out);
      case Operator::Split: return split(out);
      case Operator::Margin: return margin(out);
      case Operator::Component: return component(out);
      default: return axis(out.axis) && expect(')', "after the axis");
    }
  }
  return unknownWord("an operator", names);
}

bool Parser::axis(Axis& out) {
  if (acceptWord("X")) {
    out = Axis::X;
  } else if (acceptWord("Y")) {
    out = Axis::Y;
  } else if (acceptWord("Z")) {
    out = Axis::Z;
  } else {
    return unknownWord("an axis", {"X", "Y", "Z"});
  }
  return true;
}

// --- Scope: T(x, y, z, words), R(..), S(..), each once or not at all ---

bool Parser::scope(Rule& out) {
  while (!isSign(')')) {
    if (!change(out)) return false;
    if (!accept(',')) break;
  }
  return expect(')', "after the changes of the scope");
}

bool Parser::change(Rule& out) {
  struct Kind {
    std::string_view word, longWord;
    Change* change;
  };
  const Kind kinds[] = {
      {"T", "Translate", &out.translate}, {"R", "Rotate", &out.rotate}, {"S", "Scale", &out.scale}};
  for (const Kind& k : kinds) {
    if (!isWord(k.word) && !isWord(k.longWord)) continue;
    if (k.change->written) {
      return error("gbbg-word", spanOf(current()), "this change stands here twice",
                   "a Scope rule has T, R and S at most once each");
    }
    k.change->written = true;
    advance();
    if (!expect('(', "after T, R or S")) return false;
    for (size_t i = 0; i < 3; ++i) {
      if (i > 0 && !expect(',', "between the numbers of x, y and z")) return false;
      if (!expectNumber(k.change->value[i], "a number")) return false;
    }
    const bool isScale = k.change == &out.scale;
    while (accept(',')) {
      Change& c = *k.change;
      if (acceptWord("Add")) {
        c.set = false;
      } else if (acceptWord("Set")) {
        c.set = true;
      } else if (!isScale && acceptWord("Local")) {
        c.world = false;
      } else if (!isScale && acceptWord("World")) {
        c.world = true;
      } else if (isScale && acceptWord("Absolute")) {
        c.relative = false;
      } else if (isScale && acceptWord("Relative")) {
        c.relative = true;
      } else if (acceptWord("On")) {
        c.on = true;
      } else if (acceptWord("Off")) {
        c.on = false;
      } else if (isScale) {
        return unknownWord("a mode", {"Add", "Set", "Absolute", "Relative", "On", "Off"});
      } else {
        return unknownWord("a mode", {"Add", "Set", "Local", "World", "On", "Off"});
      }
    }
    return expect(')', "after a change");
  }
  return unknownWord("a change of the scope", {"T", "R", "S"});
}

// --- Split: axis, {widths}, direction ---

bool Parser::split(Rule& out) {
  if (!axis(out.axis) || !expect(',', "after the axis") || !splitPoints(out)) return false;
  if (accept(',')) {
    if (acceptWord("ToRoot")) {
      out.toRoot = true;
    } else if (!acceptWord("FromRoot")) {
      return unknownWord("a direction", {"FromRoot", "ToRoot"});
    }
  }
  return expect(')', "after the split points");
}

bool Parser::splitPoints(Rule& out) {
  if (!expect('{', "before the split points")) return false;
  while (!isSign('}')) {
    const Span span = spanOf(current());
    double width = 0;
    if (!expectNumber(width, "the width of a piece")) return false;
    if (!(width >= 0)) {
      return error("gbbg-size", span, "a piece cannot have a negative width",
                   "a split point is the width of its piece");
    }
    out.points.push_back(width);
    if (!accept(',')) break;
  }
  return expect('}', "after the split points");
}

// --- Margin: axis, then type, width, orientation and centre in any order ---

bool Parser::margin(Rule& out) {
  if (!axis(out.axis)) return false;
  const Span all = spanOf(current());
  bool numbered = false;
  while (accept(',')) {
    const Span span = spanOf(current());
    if (current().kind != TokenKind::Number) {
      if (!marginWord(out)) return false;
      continue;
    }
    if (numbered) return error("gbbg-word", span, "a margin has one width", "remove one of them");
    numbered = true;
    out.margin = current().number;
    advance();
    if (out.margin < 0) {
      return error("gbbg-size", span, "a margin is not negative",
                   "0 takes the preferred size of the corner");
    }
  }
  if (out.relativeMargin && out.margin > 0.5) {
    diagnostics_.warning("gbbg-size", all, "a relative margin is between 0 and 0.5",
                         "it ends at half of the shape");
  }
  return expect(')', "after the parameters");
}

bool Parser::marginWord(Rule& out) {
  if (acceptWord("Absolute")) {
    out.relativeMargin = false;
  } else if (acceptWord("Relative")) {
    out.relativeMargin = true;
  } else if (acceptWord("Default")) {
    out.orientation = Orientation::Default;
  } else if (acceptWord("FacingOut") || acceptWord("FaceOut")) {
    out.orientation = Orientation::FacingOut;
  } else if (acceptWord("FacingIn") || acceptWord("FaceIn")) {
    out.orientation = Orientation::FacingIn;
  } else if (acceptWord("Center") || acceptWord("Centre")) {
    out.center = true;
  } else if (acceptWord("NoCenter") || acceptWord("NoCentre")) {
    out.center = false;
  } else {
    return unknownWord("a width or a mode", {"Absolute", "Relative", "Default", "FacingOut",
                                             "FacingIn", "Center", "NoCenter"});
  }
  return true;
}

// --- Component: axis, faces ---

bool Parser::component(Rule& out) {
  if (!axis(out.axis) || !expect(',', "after the axis")) return false;
  static constexpr Faces kAll[] = {Faces::AllFaces,     Faces::Sides,        Faces::Top,
                                   Faces::Bottom,       Faces::SidesPlusTop, Faces::SidesPlusBottom,
                                   Faces::TopPlusBottom};
  std::vector<std::string_view> names;
  for (const Faces f : kAll) {
    names.emplace_back(facesName(f));
    if (!acceptWord(names.back())) continue;
    out.faces = f;
    return expect(')', "after the mode");
  }
  return unknownWord("a mode of division", names);
}

// --- Successors ---

bool Parser::slots(Rule& out) {
  const uint32_t begin = current().begin;
  if (!expect('{', "before the successors")) return false;
  do {
    Slot one;
    if (!slot(one)) return false;
    out.slots.push_back(std::move(one));
  } while (accept('|'));
  if (!expect('}', "after the successors")) return false;
  const size_t wanted = slotCount(out);
  if (out.slots.size() == wanted) return true;
  const std::string op = operatorName(out.op);
  std::string hint = "write {" + slotNames(out) + "}";
  if (out.op == Operator::Split) {
    hint = "a Split has one width less than successors: the last one takes the rest";
  }
  return error("gbbg-successor-count", {file_, begin, last().end},
               "this " + op + " needs " + std::to_string(wanted) +
                   (wanted == 1 ? " successor" : " successors") + ", not " +
                   std::to_string(out.slots.size()),
               hint);
}

bool Parser::slot(Slot& out) {
  const uint32_t begin = current().begin;
  double most = 0;
  do {
    Possibility p;
    if (!expectSymbol(p.symbol, "the symbol of a successor")) return false;
    if (current().kind == TokenKind::Number) {
      p.chance = current().number;
      p.chanceWritten = true;
      if (p.chance < 0) {
        return error("gbbg-chance", spanOf(current()), "a chance is not negative",
                     "chances count in proportion to each other");
      }
      if (p.chance == 0) {
        diagnostics_.warning("gbbg-chance", spanOf(current()), "a chance of 0 never happens",
                             "remove it, or give it a chance");
      }
      advance();
    }
    most = std::max(most, p.chance);
    out.possibilities.push_back(std::move(p));
  } while (accept(','));
  out.span = {file_, begin, last().end};
  if (most > 0) return true;
  return error("gbbg-chance", out.span, "these chances add up to nothing",
               "give at least one of them a chance above 0");
}

}  // namespace gable::gbbg
