// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What a word means, in words: signatures while a call is written, the page of the reference or the
// author's own declaration under the pointer.

#include <algorithm>

#include "base/text.h"
#include "language/forms.h"
#include "language/service.h"
#include "language/words.h"

namespace gable::language {

using lang::kNoNode;
using lang::NodeId;
using lang::NodeKind;
using lang::Tree;

namespace {

constexpr size_t kShownLines = 8;

// The comment lines right above a place, without their signs.
std::string commentAbove(std::string_view text, uint32_t begin) {
  std::vector<std::string_view> lines;
  size_t lineStart = text.rfind('\n', begin > 0 ? begin - 1 : 0);
  lineStart = lineStart == std::string_view::npos ? 0 : lineStart + 1;
  while (lineStart > 0 && lines.size() < 20) {
    const size_t end = lineStart - 1;
    size_t from = end == 0 ? std::string_view::npos : text.rfind('\n', end - 1);
    from = from == std::string_view::npos ? 0 : from + 1;
    std::string_view line = text.substr(from, end - from);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (!line.starts_with("//") && !line.starts_with("#")) break;
    line.remove_prefix(std::min(line.find_first_not_of("/# \t"), line.size()));
    lines.push_back(line);
    lineStart = from;
  }
  std::string out;
  for (auto at = lines.rbegin(); at != lines.rend(); ++at) out += std::string(*at) + "  \n";
  return out;
}

std::string quoted(std::string text) {
  // A fence in a comment would end the block.
  for (size_t at = text.find("```"); at != std::string::npos; at = text.find("```", at)) {
    text.replace(at, 3, "'''");
  }
  return "```cga\n" + text + "\n```\n";
}

std::string firstLines(std::string_view text) {
  size_t end = 0;
  for (size_t n = 0; n < kShownLines && end < text.size(); ++n) {
    end = std::min(text.find('\n', end), text.size());
    if (n + 1 < kShownLines && end < text.size()) ++end;
  }
  std::string out(text.substr(0, end));
  while (!out.empty() && (out.back() == '\n' || out.back() == '\r')) out.pop_back();
  return end < text.size() ? out + "\n..." : out;
}

const char* kindText(NodeKind kind) {
  switch (kind) {
    case NodeKind::Rule: return "rule";
    case NodeKind::Attr: return "attribute";
    case NodeKind::Const: return "constant";
    case NodeKind::Function: return "function";
    case NodeKind::Import: return "import";
    case NodeKind::Style: return "style";
    case NodeKind::Param: return "parameter";
    case NodeKind::Local: return "local variable";
    default: break;
  }
  return "name";
}

// The author's own declaration, as it is written.
std::string declarationCard(const Snapshot& s, uint32_t unit, NodeId d) {
  const Tree& t = s.tree(unit);
  const std::string_view text = s.text(unit);
  if (d >= t.size() || t[d].end > text.size()) return {};
  if (t.kind(d) == NodeKind::Param || t.kind(d) == NodeKind::Local) {
    return quoted(std::string(text.substr(t[d].begin, t[d].end - t[d].begin))) +
           kindText(t.kind(d));
  }
  uint32_t begin = t[d].begin;
  const size_t line = text.rfind('\n', begin);
  if (begin - (line == std::string_view::npos ? 0 : line) < 20) {
    begin = line == std::string_view::npos ? 0 : static_cast<uint32_t>(line) + 1;
  }
  uint32_t lead = begin;
  const NodeId notes = annotationsOf(t, d);
  if (notes != kNoNode && t.kind(notes) == NodeKind::List) lead = std::min(lead, t[notes].begin);
  std::string out = quoted(firstLines(text.substr(begin, t[d].end - begin)));
  out += kindText(t.kind(d));
  for (const lang::AttributeInfo& a : s.program.attributes) {
    if (s.program.modules[a.module].unit != unit || a.node != d) continue;
    if (a.type != ValueType::Null) out += std::string(", ") + typeName(a.type);
    if (!a.annotations.description.empty()) out += "\n\n" + a.annotations.description;
    break;
  }
  const size_t slash = s.path(unit).rfind('/');
  out += " of " + s.path(unit).substr(slash == std::string::npos ? 0 : slash + 1);
  const std::string comment = commentAbove(text, lead);
  return comment.empty() ? out : out + "\n\n" + comment;
}

std::string builtInCard(const Catalogue& catalogue, const Name& n) {
  if (n.space == Space::Selector) {
    for (const SelectorSpec& s : catalogue.selectors) {
      if (n.word == s.name) return "`" + std::string(s.name) + "` (selector)\n\n" + s.doc;
    }
    return {};
  }
  return pageOf(n.word);
}

// Where a name of the snapshot is declared: its unit and node.
std::optional<std::pair<uint32_t, NodeId>> declarationOfName(const Snapshot& s, const Name& n) {
  if (n.space == Space::Slot) {
    if (n.slot == kNoNode) return std::nullopt;
    return std::pair(n.unit, n.slot);
  }
  if (n.unit >= s.program.units.size()) return std::nullopt;
  const Tree& t = s.tree(n.unit);
  for (const Declared& d : declaredIn(t)) {
    if (d.word != n.word) continue;
    const bool fits = n.space == Space::Rule ? d.kind == NameKind::Rule
                      : n.space == Space::Value
                          ? d.kind == NameKind::Attribute || d.kind == NameKind::Constant ||
                                d.kind == NameKind::Function
                      : n.space == Space::Import ? d.kind == NameKind::Import
                      : n.space == Space::Style  ? d.kind == NameKind::Style
                                                 : false;
    if (fits) return std::pair(n.unit, d.node);
  }
  return std::nullopt;
}

// The author's own rule or function of a name, as a signature.
void ownSignatures(const Snapshot& s, uint32_t unit, std::string_view word, SignatureHelp& out) {
  const Tree& t = s.tree(unit);
  for (const Declared& d : declaredIn(t)) {
    if (d.word != word || (d.kind != NameKind::Rule && d.kind != NameKind::Function)) continue;
    const NodeId params = paramsOf(t, d.node);
    SignatureHelp::Signature sig;
    sig.label = std::string(word) + "(";
    for (const NodeId p : t.children(params)) {
      if (!sig.parameters.empty()) sig.label += ", ";
      const auto begin = static_cast<uint32_t>(sig.label.size());
      sig.label += t.text(p);
      sig.parameters.push_back({begin, static_cast<uint32_t>(sig.label.size()), ""});
    }
    sig.label += ")";
    sig.doc = commentAbove(s.text(unit), t[d.node].begin);
    out.signatures.push_back(std::move(sig));
  }
}

// The word of another notation under a name; parks do not mind capitals.
const DialectWord* dialectWord(const Dialect& dialect, std::string_view name) {
  if (!dialect.words) return nullptr;
  const DialectWord* near = nullptr;
  for (const DialectWord& w : dialect.words()) {
    if (name == w.name) return &w;
    if (!near && equalButForCase(name, w.name)) near = &w;
  }
  return near;
}

SignatureHelp dialectSignature(const Lexed& lexed, uint32_t offset, const Catalogue& catalogue) {
  const std::string_view text = lexed.text.content();
  // Behind each bracket that is open, the word before it.
  std::vector<std::string_view> open;
  std::string_view last;
  for (const Word& w : wordsOf(text)) {
    if (w.begin >= offset) break;
    const std::string_view word = text.substr(w.begin, w.end - w.begin);
    if (word == "(") open.push_back(last);
    if (word == ")" && !open.empty()) open.pop_back();
    last = w.kind == WordKind::Name ? word : std::string_view();
  }
  SignatureHelp out;
  for (auto at = open.rbegin(); at != open.rend() && out.signatures.empty(); ++at) {
    const DialectWord* w = at->empty() ? nullptr : dialectWord(*lexed.dialect, *at);
    if (w) out.signatures.push_back({w->call, wordText(*w, catalogue), {}});
  }
  return out;
}

std::optional<Hover> dialectHover(const Parsed& parsed, uint32_t offset,
                                  const Catalogue& catalogue) {
  const std::string_view text = parsed.text.content();
  for (const Word& w : wordsOf(text)) {
    if (w.begin > offset) break;
    if (w.kind != WordKind::Name || offset > w.end) continue;
    const DialectWord* word = dialectWord(*parsed.dialect, text.substr(w.begin, w.end - w.begin));
    if (!word) continue;
    const std::string card =
        "```text\n" + std::string(word->call) + "\n```\n" + wordText(*word, catalogue);
    return Hover{parsed.text.range(w.begin, w.end), card};
  }
  return std::nullopt;
}

}  // namespace

std::string wordText(const DialectWord& word, const Catalogue& catalogue) {
  std::string out = word.text;
  const OpSpec* op = word.operation ? catalogue.operation(word.operation) : nullptr;
  if (!op) return out;
  if (out.empty()) out = op->summary;
  return out + " Done by " + op->name + ".";
}

SignatureHelp signatureHelpAt(Library& library, const std::string& path, const Lexed& lexed,
                              uint32_t offset) {
  SignatureHelp out;
  if (lexed.dialect) return dialectSignature(lexed, offset, library.catalogue());
  const Cursor cursor = cursorAt(lexed, offset, library.catalogue());
  if (!cursor.inCall) return out;
  const Call& call = cursor.call;
  if (const std::shared_ptr<const Snapshot> s = library.latest(path)) {
    std::string_view word = call.callee;
    uint32_t unit = 0;
    for (size_t dot = word.find('.'); dot != std::string_view::npos && unit != lang::kNone;
         dot = word.find('.')) {
      const uint32_t next = importedUnit(*s, unit, word.substr(0, dot));
      if (next == lang::kNone) break;
      unit = next;
      word.remove_prefix(dot + 1);
    }
    ownSignatures(*s, unit, word, out);
  }
  if (out.signatures.empty()) {
    const std::optional<Callable> c = callableOf(library.catalogue(), call.callee, call.successor);
    if (!c) return out;
    for (const Signature& s : c->signatures) {
      SignatureHelp::Signature sig;
      sig.label = label(c->name, s, &sig.parameters);
      sig.doc = c->summary;
      out.signatures.push_back(std::move(sig));
    }
    out.activeSignature = signatureFor(*c, call);
  }
  out.activeParameter = call.argument;
  if (out.activeSignature < out.signatures.size()) {
    const std::vector<SignatureHelp::Parameter>& all =
        out.signatures[out.activeSignature].parameters;
    const std::string& text = out.signatures[out.activeSignature].label;
    for (uint32_t i = 0; i < all.size() && !call.named.empty(); ++i) {
      if (text.substr(all[i].begin, all[i].end - all[i].begin) == call.named) {
        out.activeParameter = i;
      }
    }
  }
  return out;
}

std::optional<Hover> hoverAt(Library& library, const std::string& path, const Parsed& parsed,
                             uint32_t offset) {
  const std::shared_ptr<const Snapshot> s = library.fresh(path);
  if (!s) return std::nullopt;
  const std::vector<Name> names = namesOf(*s, 0, library.catalogue());
  const Name* n = nameAt(names, offset);
  if (!n && parsed.dialect) return dialectHover(parsed, offset, library.catalogue());
  if (!n || n->space == Space::Path) return std::nullopt;
  std::string text;
  if (const auto declared = declarationOfName(*s, *n)) {
    text = declarationCard(*s, declared->first, declared->second);
  } else if (parsed.dialect) {
    // What is no rule is explained by the line that declares it.
    const auto first = std::find_if(names.begin(), names.end(), [&](const Name& d) {
      return d.declaration && d.word == n->word;
    });
    if (first == names.end()) return std::nullopt;
    const std::string_view all = parsed.text.content();
    const size_t begin = parsed.text.lineStart(parsed.text.lineOf(first->begin));
    text = quoted(firstLines(all.substr(begin, all.find_first_of("\r\n", begin) - begin)));
  } else if (n->space == Space::Rule) {
    text = "`" + std::string(n->word) + "`: a leaf. No rule has this name.";
  } else {
    text = builtInCard(library.catalogue(), *n);
  }
  if (text.empty()) return std::nullopt;
  return Hover{parsed.text.range(n->begin, n->end), std::move(text)};
}

}  // namespace gable::language
