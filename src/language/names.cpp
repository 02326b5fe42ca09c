// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "language/names.h"

#include <algorithm>
#include <map>
#include <set>
#include <unordered_set>

#include "language/words.h"

namespace gable::language {

using lang::kNoNode;
using lang::NodeId;
using lang::NodeKind;
using lang::RefKind;
using lang::Tree;

uint32_t importedUnit(const Snapshot& snapshot, uint32_t unit, std::string_view import) {
  const Tree& t = snapshot.tree(unit);
  for (const lang::Module& m : snapshot.program.modules) {
    if (m.importer == lang::kNone || m.dynamic) continue;
    if (snapshot.program.modules[m.importer].unit != unit) continue;
    if (t.kind(m.importNode) == NodeKind::Import && t.text(m.importNode) == import) return m.unit;
  }
  return lang::kNone;
}

std::vector<uint32_t> linkedUnits(const Snapshot& snapshot, uint32_t unit, std::string_view word) {
  std::vector<uint32_t> out{unit};
  const lang::ResolvedProgram& p = snapshot.program;
  // Each round goes one import further; there are few.
  for (size_t i = 0; i < out.size(); ++i) {
    const auto add = [&](uint32_t u) {
      if (std::find(out.begin(), out.end(), u) == out.end()) out.push_back(u);
    };
    for (const lang::AttributeInfo& a : p.attributes) {
      if (a.source != lang::ValueSource::Propagated || a.name != word) continue;
      const uint32_t to = p.modules[a.module].unit;
      const uint32_t from = p.modules[p.attributes[a.from].module].unit;
      if (to == out[i]) add(from);
      if (from == out[i]) add(to);
    }
  }
  return out;
}

NodeId declarationOf(const Tree& tree, NodeId node) {
  // Nodes are made bottom up, so those of a declaration lie between it and the one before.
  for (const NodeId d : tree.children(tree.root())) {
    if (node <= d) return d;
  }
  return kNoNode;
}

bool sameName(const Name& a, const Name& b) {
  return a.space == b.space && a.unit == b.unit && a.slot == b.slot && a.word == b.word;
}

const Name* nameAt(const std::vector<Name>& names, uint32_t offset) {
  const auto after = std::upper_bound(names.begin(), names.end(), offset,
                                      [](uint32_t at, const Name& n) { return at < n.begin; });
  // The word that begins here before the one that ends here.
  for (auto at = after; at != names.begin() && after - at < 3;) {
    --at;
    if (at->begin <= offset && offset <= at->end) return &*at;
  }
  return nullptr;
}

namespace {

class Collector {
 public:
  Collector(const Snapshot& snapshot, uint32_t unit, const Catalogue& catalogue)
      : s_(snapshot),
        unit_(unit),
        catalogue_(catalogue),
        t_(snapshot.tree(unit)),
        text_(snapshot.text(unit)) {
    for (const lang::Module& m : s_.program.modules) {
      if (m.unit == unit) modules_.push_back(m.id);
    }
    for (const NodeId d : t_.children(t_.root())) {
      switch (t_.kind(d)) {
        case NodeKind::Import:
          imports_.emplace(t_.text(d), importedUnit(s_, unit, t_.text(d)));
          break;
        case NodeKind::Attr:
        case NodeKind::Const:
        case NodeKind::Function: values_.insert(t_.text(d)); break;
        default: break;
      }
    }
  }

  std::vector<Name> run() {
    NodeId before = kNoNode;
    for (const NodeId d : t_.children(t_.root())) {
      declaration(d);
      for (NodeId n = before + 1; n <= d; ++n) {
        if (n != d) part(n, d);
      }
      before = d;
    }
    std::sort(out_.begin(), out_.end(), [](const Name& a, const Name& b) {
      return std::tie(a.begin, a.end) < std::tie(b.begin, b.end);
    });
    const auto same = [](const Name& a, const Name& b) { return a.begin == b.begin; };
    out_.erase(std::unique(out_.begin(), out_.end(), same), out_.end());
    return std::move(out_);
  }

 private:
  /// A word counts where the text has it: what parsers make up has no place.
  Name* put(uint32_t begin, std::string_view word, Space space, uint32_t unit, NodeId node) {
    if (word.empty() || text_.substr(std::min<size_t>(begin, text_.size()), word.size()) != word) {
      return nullptr;
    }
    out_.push_back({begin, begin + static_cast<uint32_t>(word.size()), space, false, unit, kNoNode,
                    node, word});
    return &out_.back();
  }

  // "a.b.Name": imports a and b, then a name of the file that b is.
  Name* dotted(uint32_t begin, std::string_view word, Space space, NodeId node) {
    uint32_t unit = unit_;
    const std::map<std::string_view, uint32_t>* imports = &imports_;
    for (size_t dot = word.find('.'); dot != std::string_view::npos; dot = word.find('.')) {
      const std::string_view head = word.substr(0, dot);
      uint32_t next = lang::kNone;
      if (imports) {
        const auto at = imports->find(head);
        if (at == imports->end()) break;
        next = at->second;
      } else {
        next = importedUnit(s_, unit, head);
        if (next == lang::kNone) break;
      }
      put(begin, head, Space::Import, unit, node);
      begin += static_cast<uint32_t>(dot) + 1;
      word.remove_prefix(dot + 1);
      unit = next;
      imports = nullptr;
      if (unit == lang::kNone) return nullptr;
    }
    return put(begin, word, space, unit, node);
  }

  void declaration(NodeId d) {
    const uint32_t begin = t_[d].begin;
    Name* made = nullptr;
    switch (t_.kind(d)) {
      case NodeKind::Import: return import(d);
      case NodeKind::Style:
        made = put(begin, t_.text(d), Space::Style, unit_, d);
        if (made) made->declaration = true;
        if (const NodeId base = t_.child(d, 1); base != kNoNode) {
          put(t_[base].begin, t_.text(base), Space::Style, unit_, base);
        }
        return;
      case NodeKind::Attr:
      case NodeKind::Const:
      case NodeKind::Function: made = put(begin, t_.text(d), Space::Value, unit_, d); break;
      case NodeKind::Rule: made = dotted(begin, t_.text(d), Space::Rule, d); break;
      default: return;
    }
    if (made) made->declaration = true;
  }

  void import(NodeId d) {
    if (Name* n = put(t_[d].begin, t_.text(d), Space::Import, unit_, d)) n->declaration = true;
    const auto at = imports_.find(t_.text(d));
    const uint32_t target = at == imports_.end() ? lang::kNone : at->second;
    if (const NodeId path = t_.child(d, 1); path != kNoNode) {
      out_.push_back(
          {t_[path].begin, t_[path].end, Space::Path, false, target, kNoNode, path, t_.text(path)});
    }
    if (target == lang::kNone) return;
    for (const NodeId s : t_.children(t_.child(d, 2))) {
      put(t_[s].begin, t_.text(s), Space::Style, target, s);
    }
    overrides(t_.child(d, 3), target);
  }

  void overrides(NodeId list, uint32_t target) {
    for (const NodeId item : t_.children(list)) {
      const Space space = t_.kind(item) == NodeKind::Rule ? Space::Rule : Space::Value;
      put(t_[item].begin, t_.text(item), space, target, item);
    }
  }

  const lang::Resolution* meaning(NodeId node) const {
    for (const lang::ModuleId m : modules_) {
      const lang::Resolution& r = s_.program.modules[m].at(node);
      if (r.kind != RefKind::None) return &r;
    }
    return nullptr;
  }

  // A part of the declaration `d`.
  void part(NodeId n, NodeId d) {
    const lang::Node& node = t_[n];
    switch (t_.kind(n)) {
      case NodeKind::Param:
      case NodeKind::Local:
        if (Name* made = put(node.begin, t_.text(n), Space::Slot, unit_, n)) {
          made->declaration = true;
          made->slot = n;
        }
        return;
      case NodeKind::Annotation: return annotation(n);
      case NodeKind::ImportApply:
      case NodeKind::ImportCall: return importCall(n);
      case NodeKind::NamedArg:
        if (const lang::Resolution* r = meaning(n); r && r->kind == RefKind::Attribute) {
          dotted(node.begin, t_.text(n), Space::Value, n);
        }
        return;
      case NodeKind::Apply:
      case NodeKind::Call:
      case NodeKind::Name: return reference(n, d);
      default: return;
    }
  }

  void annotation(NodeId n) {
    put(t_[n].begin + 1, t_.text(n), Space::Annotation, unit_, n);
    for (const NodeId a : t_.children(n)) {
      if (t_.kind(a) != NodeKind::NamedArg) continue;
      const NodeId value = t_.child(a, 0);
      const bool isValue = t_.text(a) == "valuesAttr", isShape = t_.text(a) == "shape";
      if (!isValue && !isShape) continue;
      const uint32_t quote = t_.kind(value) == NodeKind::String ? 1 : 0;
      if (quote == 0 && t_.kind(value) != NodeKind::Name) continue;
      dotted(t_[value].begin + quote, t_.text(value), isValue ? Space::Value : Space::Rule, value);
    }
  }

  // imp(a = 1).Rule(args): the name of the rule stands behind the overrides.
  void importCall(NodeId n) {
    const NodeId import = t_.child(n, 0);
    put(t_[import].begin, t_.text(import), Space::Import, unit_, import);
    const auto at = imports_.find(t_.text(import));
    if (at == imports_.end() || at->second == lang::kNone) return;
    overrides(t_.child(n, 1), at->second);
    const NodeId list = t_.child(n, 1);
    const size_t from = list == kNoNode ? t_[import].end : t_[list].end;
    const size_t dot = text_.find('.', from);
    if (dot == std::string_view::npos || dot >= t_[n].end) return;
    const size_t begin = text_.find_first_not_of(" \t\r\n", dot + 1);
    if (begin == std::string_view::npos) return;
    put(static_cast<uint32_t>(begin), t_.text(n), Space::Rule, at->second, n);
  }

  // The parameter or local variable that a name means in `d`: the last one above it.
  NodeId slotOf(NodeId n, NodeId d) const {
    NodeId found = kNoNode;
    for (const NodeId list : {paramsOf(t_, d), localsOf(t_, d)}) {
      for (const NodeId s : t_.children(list)) {
        if (t_.text(s) == t_.text(n) && t_[s].end <= t_[n].begin) found = s;
      }
    }
    return found;
  }

  void reference(NodeId n, NodeId d) {
    const lang::Resolution* r = meaning(n);
    const RefKind kind = r ? r->kind : guess(n, d);
    const uint32_t begin = t_[n].begin;
    const std::string_view word = t_.text(n);
    switch (kind) {
      case RefKind::None: return;
      case RefKind::Rule:
      case RefKind::Leaf: dotted(begin, word, Space::Rule, n); return;
      case RefKind::Function:
      case RefKind::Attribute: dotted(begin, word, Space::Value, n); return;
      case RefKind::Operation: put(begin, word, Space::Operation, unit_, n); return;
      case RefKind::BuiltinFunction: put(begin, word, Space::Function, unit_, n); return;
      case RefKind::ShapeAttribute: put(begin, word, Space::ShapeAttribute, unit_, n); return;
      case RefKind::Selector: put(begin, word, Space::Selector, unit_, n); return;
      case RefKind::Slot:
        if (Name* made = put(begin, word, Space::Slot, unit_, n)) made->slot = slotOf(n, d);
        return;
    }
  }

  // For what the analysis has not looked at.
  RefKind guess(NodeId n, NodeId d) const {
    const NodeKind in = t_.kind(d);
    if (in != NodeKind::Rule && in != NodeKind::Attr && in != NodeKind::Const &&
        in != NodeKind::Function) {
      return RefKind::None;
    }
    // Names within annotations and lists of parameters mean something else.
    if (t_[n].begin < t_[d].begin) return RefKind::None;
    const std::string_view word = t_.text(n);
    if (t_.kind(n) == NodeKind::Apply) {
      return catalogue_.operation(word) ? RefKind::Operation : RefKind::Rule;
    }
    if (slotOf(n, d) != kNoNode) return RefKind::Slot;
    if (values_.count(word) != 0) return RefKind::Attribute;
    if (catalogue_.function(word)) return RefKind::BuiltinFunction;
    if (catalogue_.attribute(word)) return RefKind::ShapeAttribute;
    if (catalogue_.isSelector(word)) return RefKind::Selector;
    return word.find('.') != std::string_view::npos ? RefKind::Attribute : RefKind::None;
  }

  const Snapshot& s_;
  uint32_t unit_;
  const Catalogue& catalogue_;
  const Tree& t_;
  std::string_view text_;
  std::vector<lang::ModuleId> modules_;
  std::map<std::string_view, uint32_t> imports_;
  std::unordered_set<std::string_view> values_;
  std::vector<Name> out_;
};

bool isOneOf(std::span<const char* const> words, std::string_view word) {
  return std::any_of(words.begin(), words.end(), [&](const char* w) { return word == w; });
}

// Another notation: what the tree declares by a word of the text or what stands behind a word that
// declares, and that word wherever it stands.
std::vector<Name> namesOfDialect(const Snapshot& snapshot, uint32_t unit, const Dialect& dialect) {
  const Tree& t = snapshot.tree(unit);
  const std::string_view text = snapshot.text(unit);
  std::map<std::string_view, std::set<uint32_t>> declared;
  for (const NodeId d : t.children(t.root())) {
    const uint32_t begin = t[d].begin;
    const std::string_view word = t.text(d);
    if (word.empty() || begin > text.size()) continue;
    // A symbol in quotes.
    const uint32_t quote = begin < text.size() && text[begin] == '"' ? 1 : 0;
    if (text.substr(begin + quote, word.size()) == word) declared[word].insert(begin + quote);
  }
  const std::vector<Word> words = wordsOf(text);
  std::map<std::string_view, std::set<uint32_t>> besides;
  bool declaring = false;
  for (const Word& w : words) {
    const std::string_view word = text.substr(w.begin, w.end - w.begin);
    const bool name = w.kind == WordKind::Name;
    if (declaring && name && declared.count(word) == 0) besides[word].insert(w.begin);
    declaring = (name && !declaring && isOneOf(dialect.declaring, word)) ||
                (declaring && (w.kind == WordKind::Comment || word == "*"));
  }
  declared.merge(besides);
  std::vector<Name> out;
  for (const Word& w : words) {
    if (w.kind != WordKind::Name && w.kind != WordKind::String) continue;
    const uint32_t quote = w.kind == WordKind::String ? 1 : 0;
    if (w.end - w.begin <= 2 * quote) continue;
    const std::string_view word = text.substr(w.begin + quote, w.end - w.begin - 2 * quote);
    const auto at = declared.find(word);
    if (at == declared.end()) continue;
    Name n{w.begin + quote, w.end - quote, Space::Rule, false, unit, kNoNode, kNoNode, at->first};
    n.declaration = at->second.count(n.begin) != 0;
    out.push_back(n);
  }
  return out;
}

}  // namespace

std::vector<Name> namesOf(const Snapshot& snapshot, uint32_t unit, const Catalogue& catalogue) {
  if (const Dialect* d = dialectOfPath(snapshot.path(unit))) {
    return namesOfDialect(snapshot, unit, *d);
  }
  return Collector(snapshot, unit, catalogue).run();
}

}  // namespace gable::language
