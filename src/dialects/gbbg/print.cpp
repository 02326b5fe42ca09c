// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "dialects/gbbg/print.h"

#include "base/number.h"

namespace gable::gbbg {

namespace {

constexpr size_t kLine = 100;

bool isPlain(const std::string& symbol) {
  if (symbol.empty() || (symbol[0] >= '0' && symbol[0] <= '9')) return false;
  for (const char c : symbol) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    if (!letter && !(c >= '0' && c <= '9') && static_cast<unsigned char>(c) < 0x80) return false;
  }
  return true;
}

std::string quoted(const std::string& text) { return "\"" + text + "\""; }
std::string symbolText(const Symbol& s) { return isPlain(s.text) ? s.text : quoted(s.text); }

std::string numbers(const double* from, size_t count) {
  std::string out;
  for (size_t i = 0; i < count; ++i) out += (i > 0 ? ", " : "") + shortestText(from[i]);
  return out;
}
std::string triple(const Triple& t) { return numbers(t.data(), 3); }
bool isZero(const Triple& t) { return t == Triple{}; }

std::string axisText(Axis a) { return a == Axis::X ? "X" : a == Axis::Y ? "Y" : "Z"; }

void addChange(std::string& out, const char* name, const Change& c, bool isScale) {
  if (!c.written) return;
  if (!out.empty()) out += ", ";
  out += name + ("(" + triple(c.value)) + (c.set ? ", Set" : ", Add");
  if (isScale) out += c.relative ? ", Relative" : ", Absolute";
  if (!isScale) out += c.world ? ", World" : ", Local";
  out += c.on ? ")" : ", Off)";
}

std::string parameters(const Rule& r) {
  std::string out;
  switch (r.op) {
    case Operator::Scope:
      addChange(out, "T", r.translate, false);
      addChange(out, "R", r.rotate, false);
      addChange(out, "S", r.scale, true);
      return out;
    case Operator::Split:
      return axisText(r.axis) + ", {" + numbers(r.points.data(), r.points.size()) + "}, " +
             (r.toRoot ? "ToRoot" : "FromRoot");
    case Operator::Margin: {
      static constexpr const char* kOrientations[] = {"Default", "FacingOut", "FacingIn"};
      return axisText(r.axis) + (r.relativeMargin ? ", Relative, " : ", Absolute, ") +
             shortestText(r.margin) + ", " + kOrientations[static_cast<size_t>(r.orientation)] +
             (r.center ? ", Center" : ", NoCenter");
    }
    case Operator::Component: return axisText(r.axis) + ", " + facesName(r.faces);
    default: return axisText(r.axis);
  }
}

std::string successors(const Rule& r) {
  std::string out = "{";
  for (size_t i = 0; i < r.slots.size(); ++i) {
    if (i > 0) out += " | ";
    const auto& list = r.slots[i].possibilities;
    for (size_t k = 0; k < list.size(); ++k) {
      if (k > 0) out += ", ";
      out += symbolText(list[k].symbol);
      if (list[k].chanceWritten) out += " " + shortestText(list[k].chance);
    }
  }
  return out + "}";
}

std::string head(const Rule& r) {
  const std::string title = r.title.empty() ? "" : quoted(r.title) + " ";
  return title + symbolText(r.predecessor) + " -> " + operatorName(r.op) + "(" + parameters(r) +
         ")";
}

std::string weightText(const Rule& r) {
  return r.weight == 1 ? std::string() : " weight " + shortestText(r.weight);
}

std::string startText(const Start& s) {
  std::string out = symbolText(s.symbol);
  if (s.onFootprint) {
    out += " on footprint";
    if (s.heightWritten) out += " height " + shortestText(s.height);
    return out;
  }
  if (!isZero(s.at)) out += " at (" + triple(s.at) + ")";
  if (!isZero(s.rotate)) out += " rotate (" + triple(s.rotate) + ")";
  return out + " size (" + triple(s.size) + ")";
}

std::string shapeText(const ShapeLine& s) {
  std::string out = symbolText(s.symbol);
  if (s.dimensions == Dimensions::Two) out += " 2D";
  if (s.dimensions == Dimensions::Empty) out += " Empty";
  if (!isZero(s.preferred)) out += " [" + triple(s.preferred) + "]";
  return out;
}

// A list that is broken at its commas where it does not fit on a line.
template <class Items, class Text>
std::string listText(const std::string& keyword, const Items& items, Text text) {
  std::string out = keyword;
  size_t column = keyword.size();
  for (size_t i = 0; i < items.size(); ++i) {
    const std::string one = text(items[i]);
    if (i > 0) out += ",";
    if (i > 0 && column + one.size() + 2 > kLine) {
      out += "\n   ";
      column = 3;
    }
    out += " " + one;
    column += one.size() + 2;
  }
  return out;
}

std::string tableText(const Statement& s) {
  size_t width = 0;
  for (const AssetLine& a : s.assets) width = std::max(width, symbolText(a.symbol).size());
  std::string out = "postprocess {\n";
  for (const AssetLine& a : s.assets) {
    for (const std::string& c : a.comments) out += "  " + c + "\n";
    const std::string symbol = symbolText(a.symbol);
    out += "  " + symbol + std::string(width - symbol.size(), ' ') + " : " + quoted(a.path) +
           (a.fitBounds ? " fit bounds\n" : "\n");
  }
  for (const std::string& c : s.lastComments) out += "  " + c + "\n";
  return out + "}";
}

std::string ruleText(const Rule& r) {
  const std::string line = printRule(r);
  if (line.size() <= kLine) return line;
  return head(r) + "\n    " + successors(r) + weightText(r);
}

std::string statementText(const Statement& s) {
  switch (s.kind) {
    case StatementKind::Axiom: return listText("axiom", s.starts, startText);
    case StatementKind::Shapes:
      return listText(s.shapes[0].terminal ? "terminal" : "shape", s.shapes, shapeText);
    case StatementKind::Select: {
      static constexpr const char* kNames[] = {"first", "random", "weighted"};
      return std::string("select ") + kNames[static_cast<size_t>(s.selection)];
    }
    case StatementKind::Use: return "use " + quoted(s.path);
    case StatementKind::PostProcess: return tableText(s);
    case StatementKind::Rule: return ruleText(s.rule);
  }
  return {};
}

}  // namespace

std::string printRule(const Rule& r) { return head(r) + " " + successors(r) + weightText(r); }

std::string print(const Grammar& grammar) {
  std::string out;
  for (const Statement& s : grammar.statements) {
    if (s.apart && !out.empty()) out += "\n";
    for (const std::string& c : s.comments) out += c + "\n";
    out += statementText(s);
    if (!s.trailing.empty()) out += "  " + s.trailing;
    out += "\n";
  }
  if (!grammar.lastComments.empty() && !out.empty()) out += "\n";
  for (const std::string& c : grammar.lastComments) out += c + "\n";
  return out;
}

}  // namespace gable::gbbg
