// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What a text declares, what can be folded in it, its colours.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>

#include "language/service.h"
#include "language/words.h"

namespace gable::language {

using lang::kNoNode;
using lang::NodeId;
using lang::NodeKind;
using lang::Tree;

namespace {

std::optional<NameKind> kindOf(const Tree& tree, NodeId d) {
  switch (tree.kind(d)) {
    case NodeKind::Rule: return NameKind::Rule;
    case NodeKind::Attr: return NameKind::Attribute;
    case NodeKind::Const: return NameKind::Constant;
    case NodeKind::Function: return NameKind::Function;
    case NodeKind::Import: return NameKind::Import;
    case NodeKind::Style: return NameKind::Style;
    default: return std::nullopt;
  }
}

// Where the word of a declaration is written; none for what a parser has made up.
std::optional<uint32_t> writtenAt(std::string_view text, const Tree& tree, NodeId d) {
  const uint32_t begin = tree[d].begin;
  const std::string_view word = tree.text(d);
  if (begin >= text.size() || word.empty()) return std::nullopt;
  const uint32_t quote = text[begin] == '"' ? 1 : 0;
  if (text.substr(begin + quote, word.size()) != word) return std::nullopt;
  return begin + quote;
}

// The beginning of a declaration with its annotations and the keyword before its name.
uint32_t leadOf(std::string_view text, const Tree& tree, NodeId d) {
  const NodeId notes = tree.child(d, 0);
  if (notes != kNoNode && tree.kind(notes) == NodeKind::List) {
    return std::min(tree[notes].begin, tree[d].begin);
  }
  uint32_t at = tree[d].begin;
  while (at > 0 && (text[at - 1] == ' ' || text[at - 1] == '\t')) --at;
  for (const std::string_view word : {"attr", "const", "import", "style", "start", "extension"}) {
    if (at >= word.size() && text.substr(at - word.size(), word.size()) == word) {
      return at - static_cast<uint32_t>(word.size());
    }
  }
  return tree[d].begin;
}

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

// "#rrggbb" or "#rrggbbaa".
std::optional<Color> hexColor(std::string_view text) {
  if ((text.size() != 7 && text.size() != 9) || text[0] != '#') return std::nullopt;
  std::array<double, 4> parts{0, 0, 0, 1};
  for (size_t i = 1; i < text.size(); i += 2) {
    const int high = hexDigit(text[i]), low = hexDigit(text[i + 1]);
    if (high < 0 || low < 0) return std::nullopt;
    parts[(i - 1) / 2] = (high * 16 + low) / 255.0;
  }
  return Color{{}, parts[0], parts[1], parts[2], parts[3]};
}

// color(r, g, b) with numbers from 0 to 1: the three arguments.
std::optional<Color> numberColor(const Parsed& parsed, NodeId apply) {
  const Tree& t = parsed.tree;
  const NodeId list = t.child(apply, 0);
  if (t.text(apply) != "color" || t.children(list).size() != 3) return std::nullopt;
  std::array<double, 3> parts{};
  for (size_t i = 0; i < 3; ++i) {
    const NodeId a = t.children(list)[i];
    if (t.kind(a) != NodeKind::Number || !(t.number(a) >= 0 && t.number(a) <= 1)) {
      return std::nullopt;
    }
    parts[i] = t.number(a);
  }
  const Range range = parsed.text.range(t[t.children(list)[0]].begin, t[t.children(list)[2]].end);
  return Color{range, parts[0], parts[1], parts[2], 1};
}

}  // namespace

std::vector<Declared> declaredIn(const Tree& tree) {
  std::vector<Declared> out;
  for (const NodeId d : tree.children(tree.root())) {
    const std::optional<NameKind> kind = kindOf(tree, d);
    if (kind && !tree.text(d).empty()) out.push_back({*kind, tree.text(d), d});
  }
  return out;
}

std::string headText(const Tree& tree, NodeId declaration) {
  std::string out(tree.text(declaration));
  const NodeId params = paramsOf(tree, declaration);
  if (params == kNoNode || tree.kind(declaration) == NodeKind::Import) return out;
  out += "(";
  bool first = true;
  for (const NodeId p : tree.children(params)) {
    out += (first ? "" : ", ") + std::string(tree.text(p));
    first = false;
  }
  return out + ")";
}

std::vector<Symbol> symbolsOf(const Parsed& parsed, const std::string& path) {
  const std::string_view text = parsed.text.content();
  std::vector<Symbol> out;
  for (const Declared& d : declaredIn(parsed.tree)) {
    const std::optional<uint32_t> at = writtenAt(text, parsed.tree, d.node);
    if (!at) continue;
    const lang::Node& node = parsed.tree[d.node];
    const uint32_t nameEnd = *at + static_cast<uint32_t>(d.word.size());
    uint32_t end = std::max(nameEnd, std::min<uint32_t>(node.end, text.size()));
    Symbol s{std::string(d.word), "", d.kind, path, {}, {}};
    const std::string head = headText(parsed.tree, d.node);
    s.detail = head.substr(d.word.size());
    s.range = parsed.text.range(std::min(leadOf(text, parsed.tree, d.node), *at), end);
    s.nameRange = parsed.text.range(*at, nameEnd);
    out.push_back(std::move(s));
  }
  return out;
}

std::vector<Color> colorsOf(const Parsed& parsed) {
  const std::string_view text = parsed.text.content();
  std::vector<Color> out;
  for (const Word& w : wordsOf(text)) {
    if (w.kind != WordKind::String || w.end - w.begin < 9) continue;
    std::optional<Color> c = hexColor(text.substr(w.begin + 1, w.end - w.begin - 2));
    if (!c) continue;
    c->range = parsed.text.range(w.begin + 1, w.end - 1);
    out.push_back(*c);
  }
  if (!parsed.dialect) {
    for (NodeId n = 1; n < parsed.tree.size(); ++n) {
      if (parsed.tree.kind(n) != NodeKind::Apply) continue;
      if (std::optional<Color> c = numberColor(parsed, n)) out.push_back(*c);
    }
  }
  return out;
}

std::vector<std::string> colorTextsOf(const Parsed& parsed, const Color& color) {
  const auto byte = [](double v) {
    return static_cast<int>(std::lround(std::min(1.0, std::max(0.0, v >= 0 ? v : 0.0)) * 255));
  };
  char text[16];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", byte(color.red), byte(color.green),
                byte(color.blue));
  std::string hex = text;
  if (byte(color.alpha) < 255) {
    std::snprintf(text, sizeof text, "%02x", byte(color.alpha));
    hex += text;
  }
  const uint32_t at = parsed.text.offset(color.range.begin);
  const std::string& content = parsed.text.content();
  if (at < content.size() && content[at] == '#') return {hex};
  // Three numbers, or the text that stands for them.
  const auto number = [&](double v) {
    return numberText(static_cast<double>(std::lround(byte(v) / 0.255)) / 1000);
  };
  return {number(color.red) + ", " + number(color.green) + ", " + number(color.blue),
          "\"" + hex + "\""};
}

namespace {

// Trees of other notations know where a declaration begins. It goes on to the last word before the
// next one.
void foldDeclarations(const Parsed& parsed, std::vector<Fold>& out) {
  const std::string_view text = parsed.text.content();
  std::set<uint32_t> begins;
  for (const Declared& d : declaredIn(parsed.tree)) {
    if (writtenAt(text, parsed.tree, d.node)) begins.insert(parsed.tree[d.node].begin);
  }
  std::optional<uint32_t> first;
  uint32_t last = 0;
  const auto put = [&] {
    if (first && parsed.text.lineOf(last) > *first) {
      out.push_back({*first, parsed.text.lineOf(last), Fold::Kind::Code});
    }
  };
  for (const Word& w : wordsOf(text)) {
    if (w.kind == WordKind::Comment) continue;
    if (begins.count(w.begin) != 0) {
      put();
      first = parsed.text.lineOf(w.begin);
    }
    last = w.end;
  }
  put();
}

}  // namespace

std::vector<Fold> foldsOf(const Parsed& parsed) {
  const std::string_view text = parsed.text.content();
  std::vector<Fold> out;
  const auto put = [&](uint32_t begin, uint32_t end, Fold::Kind kind) {
    const uint32_t from = parsed.text.lineOf(begin), to = parsed.text.lineOf(end);
    if (to > from) out.push_back({from, to, kind});
  };
  std::vector<uint32_t> braces;
  uint32_t commentBegin = 0, commentEnd = 0;
  bool run = false;
  const auto endRun = [&] {
    if (run) put(commentBegin, commentEnd, Fold::Kind::Comment);
    run = false;
  };
  for (const Word& w : wordsOf(text)) {
    if (w.kind == WordKind::Comment) {
      const uint32_t line = parsed.text.lineOf(w.begin);
      const bool alone =
          text.substr(parsed.text.lineStart(line), w.begin - parsed.text.lineStart(line))
              .find_first_not_of(" \t") == std::string_view::npos;
      if (!run || !alone || line > parsed.text.lineOf(commentEnd) + 1) {
        endRun();
        commentBegin = w.begin;
      }
      commentEnd = w.end;
      run = alone;
      if (!alone) put(w.begin, w.end, Fold::Kind::Comment);
      continue;
    }
    endRun();
    const char c = text[w.begin];
    if (w.kind != WordKind::Mark) continue;
    if (c == '{') braces.push_back(w.begin);
    if (c == '}' && !braces.empty()) {
      put(braces.back(), w.begin, Fold::Kind::Code);
      braces.pop_back();
    }
  }
  endRun();
  if (parsed.dialect) foldDeclarations(parsed, out);
  std::optional<uint32_t> firstImport;
  uint32_t lastImport = 0;
  for (const Declared& d : declaredIn(parsed.tree)) {
    const lang::Node& n = parsed.tree[d.node];
    const auto end = std::min<uint32_t>(n.end, static_cast<uint32_t>(text.size()));
    if (!writtenAt(text, parsed.tree, d.node)) continue;
    if (d.kind == NameKind::Import) {
      if (!firstImport) firstImport = n.begin;
      lastImport = end;
    } else if (end > n.begin) {
      put(n.begin, end, Fold::Kind::Code);
    }
  }
  if (firstImport) put(*firstImport, lastImport, Fold::Kind::Imports);
  std::sort(out.begin(), out.end(), [](const Fold& a, const Fold& b) {
    return std::tie(a.beginLine, b.endLine) < std::tie(b.beginLine, a.endLine);
  });
  // One fold a line: the outer one.
  out.erase(std::unique(out.begin(), out.end(),
                        [](const Fold& a, const Fold& b) { return a.beginLine == b.beginLine; }),
            out.end());
  return out;
}

}  // namespace gable::language
