// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
#include "dialects/park/expression.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <string>

#include "base/number.h"

namespace gable::park {

namespace {

using lang::BinaryOp;
using lang::NodeId;

constexpr int kDeepest = 100;

struct Known {
  std::string_view name;
  const char* attribute;
};
constexpr Known kKnown[] = {
    {"w", "region.w"},           {"h", "region.h"},           {"ix", "region.ix"},
    {"iy", "region.iy"},         {"nx", "region.nx"},         {"ny", "region.ny"},
    {"bx", "region.bx"},         {"by", "region.by"},         {"mx", "region.mx"},
    {"my", "region.my"},         {"border", "region.border"}, {"piece", "region.piece"},
    {"choice", "region.choice"}, {"depth", "region.depth"},   {"orphan", "region.orphan"}};

struct Sign {
  std::string_view text;
  BinaryOp op;
  int level;
};
// Longer signs before those that they begin with.
constexpr Sign kSigns[] = {{"||", BinaryOp::Or, 0},        {"&&", BinaryOp::And, 1},
                           {"==", BinaryOp::Equal, 2},     {"!=", BinaryOp::NotEqual, 2},
                           {"<=", BinaryOp::LessEqual, 2}, {">=", BinaryOp::GreaterEqual, 2},
                           {"<", BinaryOp::Less, 2},       {">", BinaryOp::Greater, 2},
                           {"+", BinaryOp::Add, 3},        {"-", BinaryOp::Subtract, 3},
                           {"*", BinaryOp::Multiply, 4},   {"/", BinaryOp::Divide, 4}};
constexpr int kLevels = 5;

class Reader {
 public:
  Reader(const Grammar& g, const std::vector<std::string>& parameters, std::string_view text,
         Span span, gbbg::TreeBuilder& b, Diagnostics& diagnostics)
      : g_(g),
        parameters_(parameters),
        text_(text),
        span_(span),
        b_(b),
        diagnostics_(diagnostics) {}

  NodeId run() {
    const Span before = b_.span();
    const NodeId e = level(0, 0);
    if (ok_ && !atEnd()) {
      word_ = at_;
      fail("this does not belong to the expression");
    }
    b_.at(before);
    return e;
  }

 private:
  bool atEnd() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    return at_ >= text_.size();
  }
  bool accept(std::string_view sign) {
    if (atEnd() || !text_.substr(at_).starts_with(sign)) return false;
    at_ += sign.size();
    return true;
  }
  // The word or sign that is read, where the span is that of the text.
  Span here() const {
    if (span_.end - span_.begin != text_.size() || word_ >= text_.size()) return span_;
    const size_t end = std::min(std::max(at_, word_ + 1), text_.size());
    return {span_.file, span_.begin + static_cast<uint32_t>(word_),
            span_.begin + static_cast<uint32_t>(end)};
  }
  NodeId fail(const std::string& message) {
    if (ok_) {
      diagnostics_.error("bad-expression", here(), "'" + std::string(text_) + "': " + message,
                         kExpressionHint);
    }
    ok_ = false;
    return b_.number(0);
  }

  NodeId level(int l, int depth) {
    if (depth > kDeepest) return fail("it is nested too deep");
    if (l == kLevels) return unary(depth);
    NodeId left = level(l + 1, depth);
    while (ok_) {
      const Sign* found = nullptr;
      for (const Sign& s : kSigns) {
        if (s.level == l && accept(s.text)) {
          found = &s;
          break;
        }
      }
      if (!found) return left;
      const NodeId right = level(l + 1, depth);
      if (!ok_) return left;
      left = compared(found->op, left, right);
      if (++nodes_ > kDeepest) return fail("it is too long");
    }
    return left;
  }

  // Counts of cells are exact.
  bool isWhole(NodeId node) {
    static constexpr std::string_view kCounts[] = {"region.ix",    "region.iy",   "region.nx",
                                                   "region.ny",    "region.bx",   "region.by",
                                                   "region.piece", "region.depth"};
    const lang::Tree& t = b_.tree();
    if (t.kind(node) == lang::NodeKind::Number) return t.number(node) == std::floor(t.number(node));
    return t.kind(node) == lang::NodeKind::Name &&
           std::find(std::begin(kCounts), std::end(kCounts), t.text(node)) != std::end(kCounts);
  }

  // Sizes are what a grid made of lengths: equal means to the tenth of a millimetre.
  NodeId compared(BinaryOp op, NodeId left, NodeId right) {
    const bool equality = op == BinaryOp::Equal || op == BinaryOp::NotEqual;
    if (!equality || (isWhole(left) && isWhole(right))) return b_.binary(op, left, right);
    const NodeId away = b_.call("abs", {b_.binary(BinaryOp::Subtract, left, right)});
    return b_.binary(op == BinaryOp::Equal ? BinaryOp::Less : BinaryOp::GreaterEqual, away,
                     b_.number(1e-4));
  }

  NodeId unary(int depth) {
    if (accept("!")) return b_.unary(lang::UnaryOp::Not, level(kLevels, depth + 1));
    if (accept("-")) return b_.unary(lang::UnaryOp::Minus, level(kLevels, depth + 1));
    if (accept("(")) {
      const NodeId inner = level(0, depth + 1);
      if (ok_ && !accept(")")) return fail("')' is missing");
      return inner;
    }
    const bool ends = atEnd();
    word_ = at_;
    if (ends) return fail("something is missing at its end");
    double v = 0;
    const char* begin = text_.data() + at_;
    const char* after = readNumber(begin, text_.data() + text_.size(), v);
    if (after != begin) {
      at_ += static_cast<size_t>(after - begin);
      b_.at(here());
      return b_.number(v);
    }
    size_t end = at_;
    while (end < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[end])) || text_[end] == '_')) {
      ++end;
    }
    const std::string name(text_.substr(at_, end - at_));
    if (name.empty()) return fail("this was not expected");
    at_ = end;
    b_.at(here());
    if (std::find(parameters_.begin(), parameters_.end(), name) != parameters_.end()) {
      return b_.word(name);
    }
    if (g_.constants.count(name) != 0) return b_.word(name);
    if (name == "area") return b_.call("geometry.area", {});
    if (const char* attribute = attributeOf(name)) return b_.word(attribute);
    return fail("'" + name + "' is no constant and nothing that a region knows");
  }

  const Grammar& g_;
  const std::vector<std::string>& parameters_;
  std::string_view text_;
  Span span_;
  gbbg::TreeBuilder& b_;
  Diagnostics& diagnostics_;
  size_t at_ = 0, word_ = 0;
  int nodes_ = 0;
  bool ok_ = true;
};

}  // namespace

const char* attributeOf(std::string_view name) {
  if (name == "area") return "geometry.area";
  for (const Known& k : kKnown) {
    if (k.name == name) return k.attribute;
  }
  return nullptr;
}

lang::NodeId expression(const Grammar& g, const std::vector<std::string>& parameters,
                        std::string_view text, Span span, gbbg::TreeBuilder& builder,
                        Diagnostics& diagnostics) {
  return Reader(g, parameters, text, span, builder, diagnostics).run();
}

}  // namespace gable::park
