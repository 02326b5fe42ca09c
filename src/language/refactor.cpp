// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Where a name is declared and used, over all files that can see it, and giving it another one. A
// new name is tried before it is offered: the texts with the edits in them must mean what they
// meant before, word by word, else the name is refused.

#include <algorithm>
#include <map>
#include <set>

#include "language/service.h"

namespace gable::language {

using lang::kNoNode;
using lang::NodeId;
using lang::NodeKind;

namespace {

/// A name as files know it: the file that it belongs to, and what it is called there.
struct Target {
  std::set<std::string> owners;
  Space space = Space::Rule;
  std::string word;
  /// Of a parameter: where it is declared in its owner.
  std::optional<uint32_t> slotBegin;
};

struct Use {
  std::string path;
  uint32_t begin, end;
  bool declaration;
  bool operator<(const Use& o) const { return std::tie(path, begin) < std::tie(o.path, o.begin); }
};

bool isBuiltIn(Space s) {
  return s == Space::Operation || s == Space::Function || s == Space::ShapeAttribute ||
         s == Space::Selector || s == Space::Annotation || s == Space::Path;
}

std::optional<Target> targetAt(const Snapshot& s, uint32_t offset, const Catalogue& catalogue,
                               Name* found) {
  const std::vector<Name> names = namesOf(s, 0, catalogue);
  const Name* n = nameAt(names, offset);
  if (!n || n->unit >= s.program.units.size()) return std::nullopt;
  if (found) *found = *n;
  Target t{{}, n->space, std::string(n->word), std::nullopt};
  if (n->space == Space::Value) {
    for (const uint32_t u : linkedUnits(s, n->unit, n->word)) t.owners.insert(s.path(u));
  } else {
    t.owners.insert(s.path(n->unit));
  }
  if (n->space == Space::Slot) {
    if (n->slot == kNoNode) return std::nullopt;
    t.slotBegin = s.tree(0)[n->slot].begin;
  }
  return t;
}

bool means(const Snapshot& s, uint32_t unit, const Name& n, const Target& t) {
  if (n.space != t.space || n.word != t.word || n.unit >= s.program.units.size()) return false;
  if (t.owners.count(s.path(n.unit)) == 0) return false;
  if (!t.slotBegin) return true;
  return n.slot != kNoNode && s.tree(unit)[n.slot].begin == *t.slotBegin;
}

std::set<Use> usesOf(Library& library, const std::string& path, const Target& t,
                     const std::vector<std::string>& files) {
  std::set<Use> out;
  // Only a text that has the word, and that imports something, can use it.
  std::set<std::string> candidates(t.owners.begin(), t.owners.end());
  candidates.insert(path);
  if (!t.slotBegin) {
    for (const std::string& f : files) {
      const std::shared_ptr<const Parsed> p = library.parsed(f);
      if (!p || p->text.content().find(t.word) == std::string::npos) continue;
      const auto imports = [&](lang::NodeId d) { return p->tree.kind(d) == NodeKind::Import; };
      const std::span<const NodeId> all = p->tree.children(p->tree.root());
      if (std::any_of(all.begin(), all.end(), imports)) candidates.insert(f);
    }
  }
  for (const std::string& f : candidates) {
    const std::shared_ptr<const Snapshot> s = library.fresh(f);
    if (!s) continue;
    for (const Name& n : namesOf(*s, 0, library.catalogue())) {
      if (means(*s, 0, n, t)) out.insert({f, n.begin, n.end, n.declaration});
    }
  }
  return out;
}

Place placeOf(Library& library, const Use& u) {
  const std::shared_ptr<const Parsed> p = library.parsed(u.path);
  return {u.path, p ? p->text.range(u.begin, u.end) : Range{}};
}

bool isKeyword(std::string_view name) {
  for (const char* word :
       {"attr", "const", "style", "extends", "import", "version", "case", "else", "with", "start",
        "extension", "true", "false", "inline", "union", "subtract", "intersect", "NIL"}) {
    if (name == word) return true;
  }
  return false;
}

bool isIdentifier(std::string_view name) {
  const auto letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  return !name.empty() && letter(name[0]) && std::all_of(name.begin(), name.end(), [&](char c) {
    return letter(c) || (c >= '0' && c <= '9');
  });
}

// A sentence where a name cannot be used.
std::string trouble(Library& library, const Target& t, const std::string& name) {
  if (!isIdentifier(name)) {
    return "A name is letters, digits and _, and begins with no digit.";
  }
  if (isKeyword(name)) return "'" + name + "' is a word of the language.";
  for (const std::string& owner : t.owners) {
    const std::shared_ptr<const Parsed> p = library.parsed(owner);
    if (!p || t.slotBegin) continue;
    for (const Declared& d : declaredIn(p->tree)) {
      if (d.word == name) return "There is already something called " + name + ".";
    }
  }
  return {};
}

/// What each word of a text means, without the words themselves.
std::vector<std::string> meaningsOf(const Snapshot& s, const Catalogue& catalogue,
                                    const std::string& oldName, const std::string& newName) {
  std::vector<std::string> out;
  for (const Name& n : namesOf(s, 0, catalogue)) {
    std::string word(n.word);
    if (word == newName) word = oldName;
    const std::string owner = n.unit < s.program.units.size() ? s.path(n.unit) : "";
    const uint32_t slot = n.slot == kNoNode ? 0 : n.slot;
    out.push_back(std::to_string(static_cast<int>(n.space)) + " " + word + " " + owner + " " +
                  std::to_string(slot) + (n.declaration ? " d" : ""));
  }
  for (const Diagnostics::Entry& d : s.diagnostics.all()) out.push_back(d.code);
  return out;
}

// The texts of all changed files with the new name in them, opened for the time of the object.
class Trial {
 public:
  Trial(Library& library, const std::map<std::string, std::vector<Use>>& uses,
        const std::string& name)
      : library_(library) {
    for (const auto& [path, list] : uses) {
      std::optional<std::string> text = library.content(path);
      if (!text) continue;
      before_[path] = {library.isOpen(path), *text};
      for (size_t i = list.size(); i-- > 0;) {
        text->replace(list[i].begin, list[i].end - list[i].begin, name);
      }
      library.open(path, std::move(*text));
    }
  }
  ~Trial() {
    for (auto& [path, was] : before_) {
      if (was.first) {
        library_.open(path, std::move(was.second));
      } else {
        library_.close(path);
      }
    }
  }
  Trial(const Trial&) = delete;
  Trial& operator=(const Trial&) = delete;

 private:
  Library& library_;
  std::map<std::string, std::pair<bool, std::string>> before_;
};

}  // namespace

std::vector<Place> definitionAt(Library& library, const std::string& path, uint32_t offset) {
  std::vector<Place> out;
  const std::shared_ptr<const Snapshot> s = library.fresh(path);
  if (!s) return out;
  const std::vector<Name> names = namesOf(*s, 0, library.catalogue());
  const Name* n = nameAt(names, offset);
  if (!n || n->unit >= s->program.units.size()) return out;
  if (n->space == Space::Path) return {{s->path(n->unit), {}}};
  if (isBuiltIn(n->space)) return out;
  const std::string& owner = s->path(n->unit);
  for (const Name& d : namesOf(*s, n->unit, library.catalogue())) {
    if (d.declaration && sameName(d, *n))
      out.push_back(placeOf(library, {owner, d.begin, d.end, true}));
  }
  // Of an import the file that it brings.
  if (n->space == Space::Import && out.empty()) {
    const uint32_t unit = importedUnit(*s, n->unit, n->word);
    if (unit != lang::kNone) out.push_back({s->path(unit), {}});
  }
  return out;
}

std::vector<Place> referencesAt(Library& library, const std::string& path, uint32_t offset,
                                bool withDeclaration, const std::vector<std::string>& files) {
  std::vector<Place> out;
  const std::shared_ptr<const Snapshot> s = library.fresh(path);
  if (!s) return out;
  std::optional<Target> t = targetAt(*s, offset, library.catalogue(), nullptr);
  if (!t || t->space == Space::Path) return out;
  if (isBuiltIn(t->space)) {
    // Of what is built in the uses of this text.
    for (const Name& n : namesOf(*s, 0, library.catalogue())) {
      if (n.space == t->space && n.word == t->word) {
        out.push_back(placeOf(library, {path, n.begin, n.end, false}));
      }
    }
    return out;
  }
  for (const Use& u : usesOf(library, path, *t, files)) {
    if (withDeclaration || !u.declaration) out.push_back(placeOf(library, u));
  }
  return out;
}

std::optional<Place> renamableAt(Library& library, const std::string& path, uint32_t offset) {
  const std::shared_ptr<const Snapshot> s = library.fresh(path);
  if (!s) return std::nullopt;
  Name n;
  const std::optional<Target> t = targetAt(*s, offset, library.catalogue(), &n);
  if (!t || isBuiltIn(t->space)) return std::nullopt;
  return placeOf(library, {path, n.begin, n.end, false});
}

Renaming renameAt(Library& library, const std::string& path, uint32_t offset,
                  const std::string& name, const std::vector<std::string>& files) {
  Renaming out;
  const std::shared_ptr<const Snapshot> s = library.fresh(path);
  const std::optional<Target> t =
      s ? targetAt(*s, offset, library.catalogue(), nullptr) : std::nullopt;
  if (!t || isBuiltIn(t->space)) {
    out.trouble = "There is no name here that can be changed.";
    return out;
  }
  out.trouble = name == t->word ? std::string() : trouble(library, *t, name);
  if (!out.trouble.empty()) return out;
  std::map<std::string, std::vector<Use>> uses;
  for (const Use& u : usesOf(library, path, *t, files)) uses[u.path].push_back(u);

  std::map<std::string, std::vector<std::string>> before;
  for (const auto& [file, list] : uses) {
    if (const auto snapshot = library.fresh(file)) {
      before[file] = meaningsOf(*snapshot, library.catalogue(), t->word, name);
    }
    FileEdits edits{file, {}};
    for (const Use& u : list) edits.edits.push_back({placeOf(library, u).range, name});
    out.edits.push_back(std::move(edits));
  }
  {
    const Trial trial(library, uses, name);
    for (const auto& [file, meanings] : before) {
      const auto after = library.fresh(file);
      if (after && meaningsOf(*after, library.catalogue(), t->word, name) == meanings) continue;
      const size_t slash = file.rfind('/');
      out.edits.clear();
      out.trouble = "With the name " + name + " other words of " +
                    file.substr(slash == std::string::npos ? 0 : slash + 1) +
                    " would mean something else.";
      return out;
    }
  }
  out.ok = true;
  return out;
}

// --- Remedies ---

std::vector<Action> actionsOf(const Snapshot& s, const Text& text, uint32_t begin, uint32_t end) {
  std::vector<Action> out;
  if (s.program.units.empty()) return out;
  const uint32_t file = s.program.units[0].file;
  const std::string& path = s.path(0);
  for (const Diagnostics::Entry& d : s.diagnostics.all()) {
    if (d.span.file != file || d.span.end < begin || d.span.begin > end) continue;
    const Range range = text.range(d.span.begin, d.span.end);
    const auto offer = [&](std::string title, uint32_t from, uint32_t to, std::string with,
                           bool preferred) {
      out.push_back({std::move(title),
                     {{path, {{text.range(from, to), std::move(with)}}}},
                     d.code,
                     range,
                     preferred});
    };
    if (d.fix && d.fix->span.file == file) {
      const uint32_t from = d.fix->span.begin, to = d.fix->span.end;
      const std::string was = text.content().substr(from, to - from);
      std::string title = "Write '" + d.fix->text + "'";
      if (d.fix->text.empty()) title = "Remove '" + was + "'";
      if (from == to) {
        const size_t first = d.fix->text.find_first_not_of(' ');
        title = "Add '" + d.fix->text.substr(first == std::string::npos ? 0 : first) + "'";
        while (title.size() > 2 && title[title.size() - 2] == ' ') title.erase(title.size() - 2, 1);
      }
      offer(std::move(title), from, to, d.fix->text, true);
    }
    if (d.code != "undefined-rule" || s.dialect) continue;
    const std::string word = text.content().substr(d.span.begin, d.span.end - d.span.begin);
    if (word.empty() || word.find('.') != std::string::npos) continue;
    // `if (x)` is no leaf to be.
    const size_t next = text.content().find_first_not_of(" \t", d.span.end);
    if (next != std::string::npos && text.content()[next] == '(') continue;
    const auto last = static_cast<uint32_t>(text.content().size());
    const bool line = last == 0 || text.content()[last - 1] == '\n';
    offer("Write the rule " + word, last, last,
          std::string(line ? "\n" : "\n\n") + word + " -->\n  " + word + ".\n", false);
    offer("Make it a leaf: '" + word + ".'", d.span.end, d.span.end, ".", !d.fix);
  }
  return out;
}

}  // namespace gable::language
