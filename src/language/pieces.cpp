// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The tree of a rule as the parts of a form. A part is taken away without what stands beside it: of
// a piece of a block the bar goes too, comments stay.

#include "language/rule_form.h"
#include "language/words.h"

namespace gable::language {

using lang::kNoNode;
using lang::NodeId;
using lang::NodeKind;
using lang::Tree;

namespace {

bool blank(char c) { return c == ' ' || c == '\t'; }

class Pieces {
 public:
  explicit Pieces(const Parsed& parsed)
      : parsed_(parsed), t_(parsed.tree), text_(parsed.text.content()) {}

  Piece body(NodeId n) {
    Piece out = piece(Piece::Kind::Body, n);
    const NodeId only = t_.children(n).size() == 1 ? t_.child(n, 0) : kNoNode;
    if (t_.kind(n) == NodeKind::Sequence && only != kNoNode && t_.kind(only) == NodeKind::Choice) {
      choice(only, out);
    } else if (t_.kind(n) == NodeKind::Choice) {
      choice(n, out);
    } else {
      out.parts.push_back(branch(Piece::Kind::Plain, n, n));
    }
    return out;
  }

 private:
  Piece piece(Piece::Kind kind, NodeId n) const { return piece(kind, t_[n].begin, t_[n].end); }
  Piece piece(Piece::Kind kind, uint32_t begin, uint32_t end) const {
    Piece out;
    out.kind = kind;
    end = std::min<uint32_t>(end, static_cast<uint32_t>(text_.size()));
    begin = std::min(begin, end);
    out.range = parsed_.text.range(begin, end);
    return out;
  }
  Piece leaf(Piece::Kind kind, uint32_t begin, uint32_t end) const {
    Piece out = piece(kind, begin, end);
    out.text = text_.substr(begin, end > begin ? end - begin : 0);
    return out;
  }

  void choice(NodeId n, Piece& out) {
    const bool drawn = t_.choiceKind(n) == lang::ChoiceKind::Percent;
    uint32_t further = t_[n].end;
    for (const NodeId b : t_.children(n)) {
      const bool otherwise = t_.child(b, 0) == kNoNode;
      Piece::Kind kind = drawn ? Piece::Kind::Chance : Piece::Kind::Case;
      if (otherwise) kind = Piece::Kind::Else;
      if (otherwise && drawn) further = t_[b].begin;
      out.parts.push_back(branch(kind, b, t_.child(b, 1)));
    }
    if (!drawn) return;
    const bool inside = further < t_[n].end;
    out.insertion = Insertion{parsed_.text.position(further), inside ? "" : " ", inside ? " " : ""};
  }

  Piece branch(Piece::Kind kind, NodeId node, NodeId body) {
    Piece out = piece(kind, node);
    if (kind == Piece::Kind::Case || kind == Piece::Kind::Chance) {
      const lang::Node& head = t_[t_.child(node, 0)];
      out.parts.push_back(leaf(Piece::Kind::Head, head.begin, head.end));
    }
    if (body == kNoNode) return out;
    const uint32_t from = t_[body].begin;
    uint32_t last = 0, lastBegin = 0;
    for (const NodeId s : t_.children(body)) {
      lastBegin = t_[s].begin;
      last = t_[s].end;
      out.parts.push_back(successor(s));
    }
    out.insertion = insertion(lastBegin, last, from);
    return out;
  }

  // Behind the last successor, as it stands: on a line of its own, or beside the others.
  Insertion insertion(uint32_t lastBegin, uint32_t last, uint32_t from) const {
    if (last == 0) {
      const size_t written = text_.find_last_not_of(" \t\r\n", from > 0 ? from - 1 : 0);
      // Behind the arrow or the colon; not behind a comment, which would take it in.
      if (written != std::string_view::npos && (text_[written] == '>' || text_[written] == ':')) {
        from = static_cast<uint32_t>(written + 1);
      }
      const bool spaced = from > 0 && blank(text_[from - 1]);
      return {parsed_.text.position(from), spaced ? "" : " ", spaced ? " " : ""};
    }
    const uint32_t line = parsed_.text.lineStart(parsed_.text.lineOf(lastBegin));
    const std::string_view before = text_.substr(line, lastBegin - line);
    const bool alone = before.find_first_not_of(" \t") == std::string_view::npos;
    return {parsed_.text.position(last), alone ? "\n" + std::string(before) : std::string(" "), ""};
  }

  Piece successor(NodeId n) {
    switch (t_.kind(n)) {
      case NodeKind::Choice: {
        Piece out = piece(Piece::Kind::Body, n);
        choice(n, out);
        return out;
      }
      case NodeKind::Push: {
        Piece out = piece(Piece::Kind::Scoped, n);
        out.parts.push_back(body(t_.child(n, 0)));
        out.removal = {removalOf(parsed_.text, t_[n].begin, t_[n].end)};
        return out;
      }
      default: return call(n);
    }
  }

  Piece call(NodeId n) {
    Piece out = piece(Piece::Kind::Call, n);
    const uint32_t begin = t_[n].begin;
    out.text = t_.text(n);
    out.removal = {removalOf(parsed_.text, begin, t_[n].end)};
    const auto nameEnd = begin + static_cast<uint32_t>(out.text.size());
    if (text_.substr(begin, out.text.size()) == out.text) {
      out.parts.push_back(leaf(Piece::Kind::Head, begin, nameEnd));
    }
    for (const NodeId c : t_.children(n)) {
      if (c == kNoNode) continue;
      if (t_.kind(c) == NodeKind::List) {
        for (const NodeId a : t_.children(c)) {
          out.parts.push_back(leaf(Piece::Kind::Argument, t_[a].begin, t_[a].end));
        }
      } else if (t_.kind(c) == NodeKind::Block) {
        out.parts.push_back(block(c));
      }
    }
    return out;
  }

  Piece block(NodeId n) {
    Piece out = piece(Piece::Kind::Block, n);
    out.repeated = t_.has(n, lang::kFlagRepeat);
    const std::span<const NodeId> items = t_.children(n);
    for (size_t i = 0; i < items.size(); ++i) {
      Piece one = t_.kind(items[i]) == NodeKind::Block ? block(items[i]) : part(items[i]);
      one.removal = partRemoval(items, i);
      out.parts.push_back(std::move(one));
    }
    if (items.empty()) {
      out.insertion = Insertion{parsed_.text.position(t_[n].begin + 1), " ", " "};
    } else {
      out.insertion = Insertion{parsed_.text.position(t_[items.back()].end), " | ", ""};
    }
    return out;
  }

  Piece part(NodeId n) {
    Piece out = piece(Piece::Kind::Part, n);
    const NodeId first = t_.child(n, 0), second = t_.child(n, 1), inner = t_.child(n, 2);
    if (first != kNoNode) {
      const uint32_t end = second == kNoNode ? t_[first].end : t_[second].end;
      out.parts.push_back(leaf(Piece::Kind::Head, t_[first].begin, end));
    }
    if (inner != kNoNode && t_.kind(inner) == NodeKind::Sequence) out.parts.push_back(body(inner));
    return out;
  }

  // With the bar to the part before it, or of the first the bar behind it.
  std::vector<Range> partRemoval(std::span<const NodeId> items, size_t i) const {
    const lang::Node& n = t_[items[i]];
    const Text& text = parsed_.text;
    const bool first = i == 0;
    if (first && items.size() == 1) return {text.range(n.begin, n.end)};
    const uint32_t from = first ? n.end : t_[items[i - 1]].end;
    const uint32_t to = first ? t_[items[i + 1]].begin : n.begin;
    uint32_t bar = from;
    // Between the part and its bar.
    bool comment = false;
    for (const Word& w : wordsOf(text_.substr(from, to - from))) {
      const bool here = w.kind == WordKind::Mark && text_[from + w.begin] == '|';
      if (here) bar = from + w.begin;
      if (w.kind == WordKind::Comment && first == (bar == from)) comment = true;
    }
    uint32_t begin = bar, end = bar + 1;
    if (first) {
      while (end < to && blank(text_[end])) ++end;
    } else {
      while (begin > from && blank(text_[begin - 1])) --begin;
    }
    // A comment there is not about the part alone.
    if (comment) return {text.range(n.begin, n.end), text.range(begin, end)};
    return {first ? text.range(n.begin, end) : text.range(begin, n.end)};
  }

  const Parsed& parsed_;
  const Tree& t_;
  std::string_view text_;
};

}  // namespace

Range removalOf(const Text& text, uint32_t begin, uint32_t end) {
  const std::string& s = text.content();
  uint32_t from = begin, to = end;
  while (from > 0 && blank(s[from - 1])) --from;
  while (to < s.size() && blank(s[to])) ++to;
  const bool startsLine = from > 0 && s[from - 1] == '\n';
  const bool endsLine = to == s.size() || s[to] == '\n' || s[to] == '\r';
  if (startsLine && endsLine) return text.range(from - 1, to);
  return text.range(from, end);
}

Piece piecesOf(const Parsed& parsed, NodeId rule) {
  return Pieces(parsed).body(lang::bodyOf(parsed.tree, rule));
}

}  // namespace gable::language
