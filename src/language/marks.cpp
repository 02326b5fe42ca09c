// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What is shown beside and over the text: the meaning of each word as a colour, the names of
// parameters before arguments, and the edits of the formatter.

#include <algorithm>

#include "dialects/dialect.h"
#include "lang/format.h"
#include "language/forms.h"
#include "language/service.h"
#include "language/words.h"

namespace gable::language {

using lang::kNoNode;
using lang::NodeId;
using lang::NodeKind;
using lang::Token;
using lang::TokenKind;
using lang::Tree;

namespace {

// Positions of offsets that grow: linear in the text for all of them together.
class Walker {
 public:
  explicit Walker(const Text& text) : text_(text) {}
  Position operator()(uint32_t offset) {
    const uint32_t line = text_.lineOf(offset);
    if (line != at_.line || offset < offset_) {
      at_ = {line, 0};
      offset_ = text_.lineStart(line);
    }
    // From the last place on the same line.
    const std::string& s = text_.content();
    while (offset_ < offset) {
      const auto lead = static_cast<unsigned char>(s[offset_]);
      if (lead >= 0x80) return text_.position(offset);
      ++offset_;
      ++at_.character;
    }
    return at_;
  }

 private:
  const Text& text_;
  Position at_;
  uint32_t offset_ = 0;
};

using Kind = Highlight::Kind;

Highlight meaning(const Name& n, const Snapshot& s) {
  Highlight h;
  h.declaration = n.declaration;
  switch (n.space) {
    case Space::Rule: {
      h.kind = Kind::Rule;
      if (n.unit >= s.program.units.size() || n.declaration) return h;
      return h;
    }
    case Space::Value: h.kind = Kind::Attribute; return h;
    case Space::Slot: h.kind = Kind::Parameter; return h;
    case Space::Import:
    case Space::Style: h.kind = Kind::Namespace; return h;
    case Space::Path: h.kind = Kind::String; return h;
    case Space::Operation: h.kind = Kind::Operation; break;
    case Space::Function: h.kind = Kind::Function; break;
    case Space::ShapeAttribute: h.kind = Kind::Attribute; break;
    case Space::Selector: h.kind = Kind::Selector; break;
    case Space::Annotation: h.kind = Kind::Annotation; break;
  }
  h.builtIn = true;
  return h;
}

std::optional<Kind> kindOfToken(const Token& t) {
  switch (t.kind) {
    case TokenKind::Number: return Kind::Number;
    case TokenKind::String: return Kind::String;
    case TokenKind::Name:
      if (t.keyword == lang::Keyword::None) return std::nullopt;
      return Kind::Keyword;
    case TokenKind::Arrow:
    case TokenKind::Tilde:
    case TokenKind::Quote: return Kind::Operator;
    case TokenKind::At: return Kind::Annotation;
    default: return std::nullopt;
  }
}

// Declarations by word, for the modifiers of values and for leaves.
struct Known {
  std::vector<std::pair<std::string_view, NameKind>> words;
  const NameKind* find(std::string_view word) const {
    const auto at = std::lower_bound(words.begin(), words.end(), word,
                                     [](const auto& a, std::string_view w) { return a.first < w; });
    return at != words.end() && at->first == word ? &at->second : nullptr;
  }
};

Known knownIn(const Tree& tree) {
  Known out;
  for (const Declared& d : declaredIn(tree)) out.words.emplace_back(d.word, d.kind);
  std::sort(out.words.begin(), out.words.end());
  return out;
}

Kind kindOfName(NameKind k) {
  switch (k) {
    case NameKind::Attribute:
    case NameKind::Constant: return Kind::Attribute;
    case NameKind::Function: return Kind::Function;
    case NameKind::Import:
    case NameKind::Style: return Kind::Namespace;
    default: return Kind::Rule;
  }
}

// "S ( x y z )" and "Split(axis)" are called, "FromRoot" stands alone, "axiom SYMBOL" begins.
Kind kindOfWord(const DialectWord& w) {
  const std::string_view call = w.call, name = w.name;
  if (w.operation) return Kind::Operation;
  if (!call.starts_with(name) || call.size() == name.size()) return Kind::Selector;
  const size_t next = call.find_first_not_of(' ', name.size());
  return next != std::string_view::npos && call[next] == '(' ? Kind::Operation : Kind::Keyword;
}

// Words of another notation: its own, those that the text declares, and names of leaves.
class DialectMarks {
 public:
  explicit DialectMarks(const Parsed& parsed)
      : parsed_(parsed), text_(parsed.text.content()), known_(knownIn(parsed.tree)) {
    const Tree& t = parsed.tree;
    for (const Declared& d : declaredIn(t)) {
      const uint32_t quote = t[d.node].begin < text_.size() && text_[t[d.node].begin] == '"';
      begins_.push_back(t[d.node].begin + quote);
      for (const NodeId p : t.children(paramsOf(t, d.node))) {
        parameters_.push_back({t.text(p), t[d.node].begin, t[d.node].end});
      }
    }
    std::sort(begins_.begin(), begins_.end());
  }

  std::optional<Highlight> operator()(const Word& w) const {
    Highlight h;
    switch (w.kind) {
      case WordKind::Comment: return h;
      case WordKind::Number: h.kind = Kind::Number; return h;
      case WordKind::Mark: return std::nullopt;
      case WordKind::String:
        // Symbols may stand in quotes.
        if (w.end - w.begin > 2 && declared(w.begin + 1, w.end - 1, h)) return h;
        h.kind = Kind::String;
        return h;
      case WordKind::Name: break;
    }
    if (declared(w.begin, w.end, h)) return h;
    const std::string_view word = text_.substr(w.begin, w.end - w.begin);
    if (parsed_.dialect->words) {
      for (const DialectWord& known : parsed_.dialect->words()) {
        if (word != known.name) continue;
        h.kind = kindOfWord(known);
        h.builtIn = true;
        return h;
      }
    }
    h.kind = Kind::Leaf;
    return h;
  }

 private:
  struct Parameter {
    std::string_view word;
    uint32_t begin, end;
  };

  bool declared(uint32_t begin, uint32_t end, Highlight& h) const {
    const std::string_view word = text_.substr(begin, end - begin);
    for (const Parameter& p : parameters_) {
      if (p.word != word || begin < p.begin || end > p.end) continue;
      h.kind = Kind::Parameter;
      return true;
    }
    const NameKind* kind = known_.find(word);
    if (!kind) return false;
    h.kind = kindOfName(*kind);
    h.declaration = std::binary_search(begins_.begin(), begins_.end(), begin);
    return true;
  }

  const Parsed& parsed_;
  std::string_view text_;
  Known known_;
  std::vector<uint32_t> begins_;
  std::vector<Parameter> parameters_;
};

std::vector<Highlight> dialectMarks(const Parsed& parsed) {
  std::vector<Highlight> out;
  const DialectMarks marks(parsed);
  Walker begins(parsed.text), ends(parsed.text);
  for (const Word& w : wordsOf(parsed.text.content())) {
    std::optional<Highlight> h = marks(w);
    if (!h) continue;
    h->range = {begins(w.begin), ends(w.end)};
    out.push_back(*h);
  }
  return out;
}

}  // namespace

std::vector<Highlight> highlightsOf(const Parsed& parsed, const Snapshot& snapshot,
                                    const Catalogue& catalogue) {
  if (parsed.dialect) return dialectMarks(parsed);
  std::vector<Highlight> out;
  struct Stretch {
    uint32_t begin, end;
    Highlight mark;
  };
  std::vector<Stretch> pieces;
  std::vector<Known> known;
  for (uint32_t u = 0; u < snapshot.program.units.size(); ++u) {
    known.push_back(knownIn(snapshot.tree(u)));
  }
  for (const Name& n : namesOf(snapshot, 0, catalogue)) {
    Stretch p{n.begin, n.end, meaning(n, snapshot)};
    const NameKind* k = n.unit < known.size() ? known[n.unit].find(n.word) : nullptr;
    if (n.space == Space::Rule && !k) p.mark.kind = Kind::Leaf;
    if (n.space == Space::Value && k) {
      p.mark.constant = *k == NameKind::Constant;
      if (*k == NameKind::Function) p.mark.kind = Kind::Function;
    }
    pieces.push_back(p);
  }
  const size_t names = pieces.size();
  const auto taken = [&](uint32_t begin) {
    const auto at =
        std::lower_bound(pieces.begin(), pieces.begin() + static_cast<ptrdiff_t>(names), begin,
                         [](const Stretch& p, uint32_t b) { return p.begin < b; });
    return at != pieces.begin() + static_cast<ptrdiff_t>(names) && at->begin == begin;
  };
  for (const Token& t : parsed.tokens.tokens) {
    const std::optional<Kind> kind = kindOfToken(t);
    if (!kind || t.end <= t.begin || taken(t.begin)) continue;
    Highlight h;
    h.kind = *kind;
    pieces.push_back({t.begin, t.end, h});
  }
  for (const lang::Comment& c : parsed.tokens.comments) pieces.push_back({c.begin, c.end, {}});
  std::sort(pieces.begin(), pieces.end(),
            [](const Stretch& a, const Stretch& b) { return a.begin < b.begin; });
  Walker begins(parsed.text), ends(parsed.text);
  uint32_t last = 0;
  for (Stretch& p : pieces) {
    if (p.begin < last) continue;
    last = p.end;
    p.mark.range = {begins(p.begin), ends(p.end)};
    out.push_back(p.mark);
  }
  return out;
}

// --- The names of parameters ---

namespace {

bool literal(const Tree& t, NodeId n) {
  while (t.kind(n) == NodeKind::Unary || t.kind(n) == NodeKind::Relative ||
         t.kind(n) == NodeKind::Floating) {
    n = t.child(n, 0);
  }
  const NodeKind k = t.kind(n);
  return k == NodeKind::Number || k == NodeKind::String || k == NodeKind::Bool ||
         k == NodeKind::Array;
}

}  // namespace

std::vector<InlayHint> inlayHintsOf(const Parsed& parsed, const Snapshot& snapshot, Range range,
                                    const Catalogue& catalogue) {
  std::vector<InlayHint> out;
  if (parsed.dialect || snapshot.program.modules.empty()) return out;
  const uint32_t from = parsed.text.offset(range.begin), to = parsed.text.offset(range.end);
  const Tree& t = snapshot.tree(0);
  const lang::Module& m = snapshot.program.modules[0];
  for (NodeId n = 1; n < t.size(); ++n) {
    const bool call = t.kind(n) == NodeKind::Apply || t.kind(n) == NodeKind::Call;
    if (!call || t[n].end < from || t[n].begin > to) continue;
    const std::span<const NodeId> args = t.children(t.child(n, 0));
    if (args.size() < 2) continue;
    const lang::Resolution& r = m.at(n);
    std::vector<std::string_view> names;
    if (r.kind == lang::RefKind::Rule || r.kind == lang::RefKind::Function) {
      const bool rule = r.kind == lang::RefKind::Rule;
      const lang::ModuleId owner = rule ? snapshot.program.rules[r.index].module
                                        : snapshot.program.functions[r.index].module;
      const NodeId node =
          rule ? snapshot.program.rules[r.index].node : snapshot.program.functions[r.index].node;
      const Tree& their = snapshot.program.tree(owner);
      for (const NodeId p : their.children(paramsOf(their, node))) names.push_back(their.text(p));
    } else if (r.kind == lang::RefKind::Operation || r.kind == lang::RefKind::BuiltinFunction) {
      const std::optional<Callable> c =
          callableOf(catalogue, t.text(n), r.kind == lang::RefKind::Operation);
      if (!c || r.signature >= c->signatures.size()) continue;
      const Signature& s = c->signatures[r.signature];
      // Of a list that goes on, the names say nothing.
      if (s.variadic) continue;
      for (const ParamSpec& p : s.params) names.push_back(p.name);
      // x, y and z in their order need no words.
      if (names == std::vector<std::string_view>{"x", "y", "z"}) continue;
    }
    for (size_t i = 0; i < args.size() && i < names.size(); ++i) {
      const uint32_t at = t[args[i]].begin;
      if (at < from || at > to || !literal(t, args[i])) continue;
      out.push_back({parsed.text.position(at), std::string(names[i]) + ":"});
    }
  }
  std::sort(out.begin(), out.end(), [](const InlayHint& a, const InlayHint& b) {
    return std::tie(a.at.line, a.at.character) < std::tie(b.at.line, b.at.character);
  });
  return out;
}

std::vector<InlayHint> valueHintsOf(const Parsed& parsed, const Range& range,
                                    const std::map<std::string, std::string>& values) {
  std::vector<InlayHint> out;
  const std::string& text = parsed.text.content();
  const Tree& t = parsed.tree;
  for (const Declared& d : declaredIn(t)) {
    const auto known = values.find(std::string(d.word));
    if (d.kind != NameKind::Attribute || known == values.end()) continue;
    const NodeId value = t.child(d.node, 3);
    if (value == kNoNode || t[value].end > text.size()) continue;
    const uint32_t begin = t[value].begin, end = t[value].end;
    // What is written there already needs no hint.
    const std::string written = text.substr(begin, end - begin);
    if (written == known->second || written == '"' + known->second + '"') continue;
    if (t.kind(value) == NodeKind::Number && numberText(t.number(value)) == known->second) continue;
    const Position at = parsed.text.position(end);
    if (at.line < range.begin.line || at.line > range.end.line) continue;
    out.push_back({at, "= " + known->second, true});
  }
  return out;
}

// --- Layout ---

namespace {

bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

// The layout changes white space alone, so the texts are walked side by side.
std::optional<std::vector<Edit>> spaceEdits(const Text& text, std::string_view after) {
  const std::string_view before = text.content();
  std::vector<Edit> out;
  size_t i = 0, j = 0;
  while (i < before.size() || j < after.size()) {
    size_t a = i, b = j;
    while (a < before.size() && isSpace(before[a])) ++a;
    while (b < after.size() && isSpace(after[b])) ++b;
    if (before.substr(i, a - i) != after.substr(j, b - j)) {
      out.push_back({text.range(static_cast<uint32_t>(i), static_cast<uint32_t>(a)),
                     std::string(after.substr(j, b - j))});
    }
    i = a;
    j = b;
    while (i < before.size() && j < after.size() && !isSpace(before[i]) && before[i] == after[j]) {
      ++i;
      ++j;
    }
    const bool end = i >= before.size() && j >= after.size();
    if (!end && i == a && j == b) return std::nullopt;
  }
  return out;
}

}  // namespace

std::vector<Edit> formatEdits(const Parsed& parsed, const std::string& path) {
  const std::string& text = parsed.text.content();
  Sources sources;
  Diagnostics diagnostics;
  const uint32_t file = sources.add(path, text);
  const auto layout = parsed.dialect ? parsed.dialect->format : lang::format;
  const std::string after = layout(sources, file, diagnostics);
  if (diagnostics.hasErrors() || after == text) return {};
  if (std::optional<std::vector<Edit>> edits = spaceEdits(parsed.text, after)) return *edits;
  return {{parsed.text.range(0, static_cast<uint32_t>(text.size())), after}};
}

}  // namespace gable::language
