// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The public class: paths to their one name, places to offsets, and the questions handed on.

#include "language/workspace.h"

#include <algorithm>
#include <set>

#include "base/text.h"
#include "language/rule_form.h"
#include "language/service.h"

namespace gable::language {

namespace {

/// More than an editor shows; the rest is found by typing more.
constexpr size_t kMostSymbols = 1000;

// All letters of the query, in their order.
bool hasLetters(std::string_view name, std::string_view query) {
  size_t at = 0;
  for (const char c : name) at += at < query.size() && lowerCase(c) == lowerCase(query[at]) ? 1 : 0;
  return at == query.size();
}

gable::Diagnostic::Severity severityOf(Severity s) {
  switch (s) {
    case Severity::Note: return gable::Diagnostic::Severity::Note;
    case Severity::Warning: return gable::Diagnostic::Severity::Warning;
    case Severity::Error: break;
  }
  return gable::Diagnostic::Severity::Error;
}

Diagnostic diagnosticOf(const Diagnostics::Entry& d, const Text& text, bool placed) {
  Diagnostic out{severityOf(d.severity), d.code, {}, d.message, d.hint};
  if (placed) out.range = text.range(d.span.begin, d.span.end);
  return out;
}

}  // namespace

std::string Workspace::Impl::key(const std::string& path) {
  const auto at = keys.find(path);
  return at != keys.end() ? at->second : library.files().canonical(path);
}

std::string Workspace::Impl::shown(const std::string& key) const {
  const auto at = names.find(key);
  return at != names.end() ? at->second : key;
}

std::vector<std::string> Workspace::Impl::filesFor(const std::string& key) {
  std::set<std::string> out;
  std::vector<std::string> roots = folders;
  roots.push_back(library.files().root(key));
  for (const std::string& root : roots) {
    if (root.empty()) continue;
    const std::vector<std::string> files = library.files().ruleFiles(root);
    out.insert(files.begin(), files.end());
  }
  for (const std::string& open : library.openTexts()) out.insert(open);
  return {out.begin(), out.end()};
}

Workspace::~Workspace() = default;
Workspace::Workspace(Workspace&&) noexcept = default;
Workspace& Workspace::operator=(Workspace&&) noexcept = default;

// --- Texts ---

void Workspace::open(const std::string& path, std::string text) {
  const std::string key = impl_->library.files().canonical(path);
  impl_->keys[path] = key;
  impl_->names[key] = path;
  impl_->library.open(key, std::move(text));
}

bool Workspace::change(const std::string& path, const std::vector<Change>& changes) {
  return impl_->library.change(impl_->key(path), changes);
}

void Workspace::close(const std::string& path) {
  const std::string key = impl_->key(path);
  impl_->library.close(key);
  impl_->values.erase(key);
  impl_->keys.erase(path);
  impl_->names.erase(key);
}

bool Workspace::isOpen(const std::string& path) const {
  return impl_->library.isOpen(impl_->key(path));
}

std::vector<std::string> Workspace::openTexts() const {
  std::vector<std::string> out;
  for (const std::string& key : impl_->library.openTexts()) out.push_back(impl_->shown(key));
  return out;
}

std::string Workspace::text(const std::string& path) const {
  return impl_->library.content(impl_->key(path)).value_or(std::string());
}

void Workspace::setFolders(std::vector<std::string> folders) {
  for (std::string& f : folders) f = impl_->library.files().canonical(f);
  impl_->folders = std::move(folders);
  refresh();
}

const std::vector<std::string>& Workspace::folders() const { return impl_->folders; }

void Workspace::refresh() { impl_->library.files().refresh(); }

// --- The whole text ---

std::vector<FileDiagnostics> Workspace::diagnostics(const std::string& path) {
  std::vector<FileDiagnostics> out{{path, {}}};
  Library& library = impl_->library;
  const std::string key = impl_->key(path);
  const std::shared_ptr<const Snapshot> s = library.fresh(key);
  if (!s) {
    if (const std::optional<Error>& why = library.trouble()) {
      out[0].diagnostics.push_back(
          {gable::Diagnostic::Severity::Error, why->code, {}, why->message, why->hint});
    }
    return out;
  }
  const uint32_t main = s->program.units[0].file;
  std::shared_ptr<const Parsed> parsed;
  uint32_t file = Span::kNoFile;
  for (const Diagnostics::Entry& d : s->diagnostics.all()) {
    const bool placed = d.span.valid();
    const uint32_t wanted = placed ? d.span.file : main;
    if (wanted != file) {
      file = wanted;
      parsed = library.parsed(s->sources.path(file));
    }
    // A dialect may bring files that are no units; their places are not known here.
    if (!parsed || parsed->text.content() != s->sources.text(file)) continue;
    const std::string name = file == main ? path : impl_->shown(s->sources.path(file));
    auto at = std::find_if(out.begin(), out.end(),
                           [&](const FileDiagnostics& f) { return f.path == name; });
    if (at == out.end()) at = out.insert(out.end(), {name, {}});
    at->diagnostics.push_back(diagnosticOf(d, parsed->text, placed));
  }
  return out;
}

std::vector<Symbol> Workspace::symbols(const std::string& path) {
  const auto parsed = impl_->library.parsed(impl_->key(path));
  return parsed ? symbolsOf(*parsed, path) : std::vector<Symbol>();
}

std::vector<Highlight> Workspace::highlights(const std::string& path) {
  const std::string key = impl_->key(path);
  const auto parsed = impl_->library.parsed(key);
  const auto s = parsed ? impl_->library.fresh(key) : nullptr;
  return s ? highlightsOf(*parsed, *s, impl_->library.catalogue()) : std::vector<Highlight>();
}

std::vector<Color> Workspace::colors(const std::string& path) {
  const auto parsed = impl_->library.parsed(impl_->key(path));
  return parsed ? colorsOf(*parsed) : std::vector<Color>();
}

std::vector<std::string> Workspace::colorTexts(const std::string& path, const Color& color) {
  const auto parsed = impl_->library.parsed(impl_->key(path));
  if (!parsed) return {};
  return colorTextsOf(*parsed, color);
}

std::vector<Fold> Workspace::folds(const std::string& path) {
  const auto parsed = impl_->library.parsed(impl_->key(path));
  return parsed ? foldsOf(*parsed) : std::vector<Fold>();
}

std::vector<InlayHint> Workspace::inlayHints(const std::string& path, const Range& range) {
  const std::string key = impl_->key(path);
  const auto parsed = impl_->library.parsed(key);
  const auto s = parsed ? impl_->library.fresh(key) : nullptr;
  if (!s) return {};
  std::vector<InlayHint> out = inlayHintsOf(*parsed, *s, range, impl_->library.catalogue());
  const auto known = impl_->values.find(key);
  if (known == impl_->values.end()) return out;
  std::vector<InlayHint> values = valueHintsOf(*parsed, range, known->second);
  out.insert(out.end(), values.begin(), values.end());
  return out;
}

void Workspace::setValues(const std::string& path, std::map<std::string, std::string> values) {
  impl_->values[impl_->key(path)] = std::move(values);
}

std::vector<Edit> Workspace::format(const std::string& path) {
  const auto parsed = impl_->library.parsed(impl_->key(path));
  return parsed ? formatEdits(*parsed, path) : std::vector<Edit>();
}

// --- A place in it ---

Completions Workspace::complete(const std::string& path, Position at) {
  const std::string key = impl_->key(path);
  const auto lexed = impl_->library.lexed(key);
  if (!lexed) return {};
  return completionsAt(impl_->library, key, *lexed, lexed->text.offset(at));
}

SignatureHelp Workspace::signatureHelp(const std::string& path, Position at) {
  const std::string key = impl_->key(path);
  const auto lexed = impl_->library.lexed(key);
  if (!lexed) return {};
  return signatureHelpAt(impl_->library, key, *lexed, lexed->text.offset(at));
}

std::optional<Hover> Workspace::hover(const std::string& path, Position at) {
  const std::string key = impl_->key(path);
  const auto parsed = impl_->library.parsed(key);
  if (!parsed) return std::nullopt;
  return hoverAt(impl_->library, key, *parsed, parsed->text.offset(at));
}

std::vector<Place> Workspace::definition(const std::string& path, Position at) {
  const std::string key = impl_->key(path);
  const auto parsed = impl_->library.parsed(key);
  if (!parsed) return {};
  std::vector<Place> out = definitionAt(impl_->library, key, parsed->text.offset(at));
  for (Place& p : out) p.path = impl_->shown(p.path);
  return out;
}

std::vector<Place> Workspace::references(const std::string& path, Position at,
                                         bool withDeclaration) {
  const std::string key = impl_->key(path);
  const auto parsed = impl_->library.parsed(key);
  if (!parsed) return {};
  std::vector<Place> out = referencesAt(impl_->library, key, parsed->text.offset(at),
                                        withDeclaration, impl_->filesFor(key));
  for (Place& p : out) p.path = impl_->shown(p.path);
  return out;
}

std::optional<Place> Workspace::attributeValue(const std::string& path, const std::string& name) {
  const auto s = impl_->library.fresh(impl_->key(path));
  if (!s) return std::nullopt;
  uint32_t unit = 0;
  std::string_view rest = name;
  for (size_t dot = rest.find('.'); dot != std::string_view::npos; dot = rest.find('.')) {
    unit = importedUnit(*s, unit, rest.substr(0, dot));
    if (unit == lang::kNone) return std::nullopt;
    rest.remove_prefix(dot + 1);
  }
  const auto parsed = impl_->library.parsed(s->path(unit));
  if (!parsed) return std::nullopt;
  const lang::Tree& t = parsed->tree;
  for (const Declared& d : declaredIn(t)) {
    if (d.kind != NameKind::Attribute || d.word != rest) continue;
    const lang::NodeId value = lang::bodyOf(t, d.node);
    if (value == lang::kNoNode || t.kind(value) == lang::NodeKind::Missing) continue;
    return Place{impl_->shown(s->path(unit)), parsed->text.range(t[value].begin, t[value].end)};
  }
  return std::nullopt;
}

std::vector<Range> Workspace::occurrences(const std::string& path, Position at) {
  const std::string key = impl_->key(path);
  const auto parsed = impl_->library.parsed(key);
  const auto s = impl_->library.fresh(key);
  if (!parsed || !s) return {};
  const std::vector<Name> names = namesOf(*s, 0, impl_->library.catalogue());
  const Name* name = nameAt(names, parsed->text.offset(at));
  std::vector<Range> out;
  for (const Name& n : names) {
    if (name && sameName(n, *name)) out.push_back(parsed->text.range(n.begin, n.end));
  }
  return out;
}

std::optional<Place> Workspace::renamable(const std::string& path, Position at) {
  const std::string key = impl_->key(path);
  const auto parsed = impl_->library.parsed(key);
  if (!parsed) return std::nullopt;
  std::optional<Place> out = renamableAt(impl_->library, key, parsed->text.offset(at));
  if (out) out->path = path;
  return out;
}

Renaming Workspace::rename(const std::string& path, Position at, const std::string& name) {
  const std::string key = impl_->key(path);
  const auto parsed = impl_->library.parsed(key);
  if (!parsed) return {};
  Renaming out = renameAt(impl_->library, key, parsed->text.offset(at), name, impl_->filesFor(key));
  for (FileEdits& e : out.edits) e.path = impl_->shown(e.path);
  return out;
}

// --- Rules as forms ---

TextForm Workspace::form(const std::string& path, const std::string& rule) {
  const auto parsed = impl_->library.parsed(impl_->key(path));
  return parsed ? formOf(*parsed, rule) : TextForm();
}

std::optional<std::vector<Edit>> Workspace::formEdits(const std::string& path,
                                                      const std::string& rule, const BoxRule& box) {
  const auto parsed = impl_->library.parsed(impl_->key(path));
  return parsed ? boxEdits(parsed->text, rule, box) : std::nullopt;
}

std::vector<Action> Workspace::actions(const std::string& path, const Range& range) {
  const std::string key = impl_->key(path);
  const auto parsed = impl_->library.parsed(key);
  const auto s = impl_->library.fresh(key);
  if (!parsed || !s) return {};
  std::vector<Action> out =
      actionsOf(*s, parsed->text, parsed->text.offset(range.begin), parsed->text.offset(range.end));
  for (Action& a : out) {
    for (FileEdits& e : a.edits) e.path = impl_->shown(e.path);
  }
  return out;
}

// --- The project ---

std::vector<Symbol> Workspace::projectSymbols(const std::string& query) {
  std::vector<Symbol> out;
  std::set<std::string> files;
  for (const std::string& folder : impl_->folders) {
    for (const std::string& f : impl_->library.files().ruleFiles(folder)) files.insert(f);
  }
  for (const std::string& open : impl_->library.openTexts()) files.insert(open);
  for (const std::string& f : files) {
    const auto parsed = impl_->library.parsed(f);
    if (!parsed) continue;
    for (Symbol& s : symbolsOf(*parsed, impl_->shown(f))) {
      if (s.kind == NameKind::Import || !hasLetters(s.name, query)) continue;
      out.push_back(std::move(s));
      if (out.size() >= kMostSymbols) return out;
    }
  }
  return out;
}

std::vector<Entry> searchIn(const Catalogue& catalogue, const std::string& words) {
  struct Ranked {
    int rank;
    Entry entry;
  };
  std::vector<Ranked> found;
  std::vector<std::string> parts;
  std::string query = lowerCase(words);
  for (size_t at = 0; at < query.size();) {
    const size_t end = std::min(query.find(' ', at), query.size());
    // "floors" finds what says "floor".
    std::string word = query.substr(at, end - at);
    if (!word.empty()) parts.push_back(std::move(word));
    at = end + 1;
  }
  if (parts.empty()) return {};
  const auto consider = [&](const char* name, NameKind kind, const char* summary) {
    const std::string low = lowerCase(name), text = lowerCase(summary);
    int rank = 0;
    for (const std::string& part : parts) {
      const bool alias = std::any_of(aliases().begin(), aliases().end(), [&](const Alias& a) {
        return std::string_view(a.name) == name &&
               (std::string_view(a.word).starts_with(part) ||
                (part.size() > 3 && std::string_view(part).starts_with(a.word)));
      });
      int best = 0;
      if (low == part)
        best = 40;
      else if (alias)
        best = 30;
      else if (low.starts_with(part))
        best = 20;
      else if (low.find(part) != std::string::npos)
        best = 10;
      else if (part.size() > 2 && text.find(part) != std::string::npos)
        best = 5;
      rank += best;
    }
    if (rank > 0) found.push_back({rank, {name, kind, summary}});
  };
  for (const OpSpec* op : catalogue.operations)
    consider(op->name, NameKind::Operation, op->summary);
  for (const FunctionSpec* f : catalogue.functions) {
    consider(f->name, NameKind::BuiltinFunction, f->summary);
  }
  for (const AttributeSpec* a : catalogue.attributes) {
    consider(a->name, NameKind::ShapeAttribute, a->doc);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Ranked& a, const Ranked& b) { return a.rank > b.rank; });
  std::vector<Entry> out;
  for (Ranked& r : found) out.push_back(std::move(r.entry));
  return out;
}

}  // namespace gable::language
