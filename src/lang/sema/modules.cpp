// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Files to units, units to modules. All files are loaded first, along the imports, which form a
// graph without cycles; then each use of a file becomes a module, from the main file down, so that
// an importer's declarations are known when those of the imported file are bound to them.
//
// Styles: a module sees the declarations of its style, of the style that one extends, and so on to
// Default. For one name (and number of parameters) the first in that chain counts.

#include <algorithm>
#include <set>
#include <utility>

#include "base/work.h"
#include "lang/parser.h"
#include "lang/sema/analysis.h"

namespace gable::lang {

namespace {

std::string joinPath(const std::string& path, std::string_view name) {
  return path.empty() ? std::string(name) : path + "." + std::string(name);
}

std::string prefixOf(std::string_view name) { return std::string(name.substr(0, name.find('.'))); }

}  // namespace

// --- Units ---

// "2019.1"; the part behind a second dot does not count.
void Analysis::readVersion(uint32_t unit, NodeId node) {
  constexpr double kKnown = 2025.1;
  const Tree& t = *program_.units[unit].tree;
  const std::string_view text = t.text(node);
  double year = 0, part = 0;
  size_t dots = 0;
  for (const char c : text) {
    if (c == '.' && ++dots < 2) continue;
    if (c < '0' || c > '9') break;
    (dots == 0 ? year : part) = (dots == 0 ? year : part) * 10 + (c - '0');
  }
  constexpr double kFirst = 2008, kLast = 9999;
  if (year < kFirst || year > kLast || part > 9) {
    warning("bad-version", t.span(node), quote(text) + " is no version of CGA",
            "write a year and a number, such as version \"2025.1\"");
    return;
  }
  units_[unit].version = year + part / 10;
  if (units_[unit].version > kKnown + 0.05) {
    warning(
        "newer-version", t.span(node),
        "the rules are written for CGA " + std::string(text) + ", and what is known here is 2025.1",
        "what is new in it is told where it stands");
  }
}

namespace {

// Which styles lead back to the default one, by their bases; the others extend themselves or a
// style that is not there. Each is passed once.
template <class Index>
std::vector<bool> stylesToDefault(const Index& index) {
  enum class State : uint8_t { Unknown, Open, Reaches, Not };
  std::vector<State> states(index.styles.size(), State::Unknown);
  states[0] = State::Reaches;
  std::vector<size_t> open;
  for (size_t s = 0; s < states.size(); ++s) {
    State end = State::Not;
    for (size_t at = s;;) {
      if (states[at] != State::Unknown) {
        if (states[at] != State::Open) end = states[at];
        break;
      }
      states[at] = State::Open;
      open.push_back(at);
      const auto base = index.styleNumbers.find(index.styles[at].base);
      if (base == index.styleNumbers.end()) break;
      at = base->second;
    }
    for (const size_t o : open) states[o] = end;
    open.clear();
  }
  std::vector<bool> out;
  for (const State s : states) out.push_back(s == State::Reaches);
  return out;
}

}  // namespace

void Analysis::indexUnit(uint32_t unit) {
  const Tree& t = *program_.units[unit].tree;
  UnitIndex& index = units_[unit];
  const auto addStyle = [&](StyleInfo style) {
    index.styleNumbers.emplace(style.name, index.styles.size());
    index.styles.push_back(std::move(style));
  };
  addStyle({std::string(kDefaultStyle), "", ""});
  std::string_view style = kDefaultStyle;
  GroupNote group;
  const auto description = [&](NodeId note) {
    if (t.kind(note) == NodeKind::Annotation && t.text(note) == "RuleFileDescription") {
      index.description = std::string(t.text(t.child(note, 0)));
    }
  };
  for (const NodeId id : t.children(t.root())) {
    description(id);
    if (t.kind(id) == NodeKind::Version) readVersion(unit, id);
    if (t.kind(id) == NodeKind::Annotation || t.kind(id) == NodeKind::Version) continue;
    for (const NodeId note : t.children(annotationsOf(t, id))) description(note);
    const Annotations notes = readAnnotations(t, annotationsOf(t, id), group, &diagnostics_);
    const Declaration declaration{id, style, notes};
    switch (t.kind(id)) {
      case NodeKind::Style: {
        style = t.text(id);
        if (index.styleNumbers.find(style) != index.styleNumbers.end()) {
          error("duplicate-style", nameSpan(t, id),
                "the style " + quote(style) + " is there already, at " +
                    firstPlaceText(t, NodeKind::Style, style),
                "give it another name");
          break;
        }
        const NodeId base = t.child(id, 1);
        addStyle({std::string(style), std::string(base == kNoNode ? kDefaultStyle : t.text(base)),
                  notes.description});
        break;
      }
      case NodeKind::Import:
        if (!index.importNames.insert(t.text(id)).second) {
          error("duplicate-import", nameSpan(t, id),
                quote(t.text(id)) + " is an import already, at " +
                    firstPlaceText(t, NodeKind::Import, t.text(id)),
                "give it another name");
          break;
        }
        index.imports.push_back(declaration);
        break;
      case NodeKind::Attr:
      case NodeKind::Const: index.attributes.push_back(declaration); break;
      case NodeKind::Function: index.functions.push_back(declaration); break;
      case NodeKind::Rule: index.rules.push_back(declaration); break;
      default: break;
    }
  }
  const std::vector<bool> reaching = stylesToDefault(index);
  // Bases may stand behind the styles that extend them.
  for (const NodeId id : t.children(t.root())) {
    const NodeId base = t.kind(id) == NodeKind::Style ? t.child(id, 1) : kNoNode;
    if (base == kNoNode) continue;
    const auto names = [&] {
      std::vector<std::string_view> all;
      for (const StyleInfo& s : index.styles) all.push_back(s.name);
      return all;
    };
    if (index.styleNumbers.find(t.text(base)) == index.styleNumbers.end()) {
      error("unknown-style", t.span(base), "there is no style " + quote(t.text(base)),
            near(t.text(base), names));
    } else if (!reaching[index.styleNumbers.find(t.text(id))->second]) {
      error("style-cycle", t.span(base), "the style " + quote(t.text(id)) + " extends itself",
            "extend another style");
    }
  }
}

std::vector<std::string_view> Analysis::styleChain(uint32_t unit, std::string_view style) const {
  const std::vector<StyleInfo>& styles = units_[unit].styles;
  std::vector<std::string_view> chain;
  while (!style.empty() && chain.size() <= styles.size()) {
    work();
    const auto at = units_[unit].styleNumbers.find(style);
    if (at == units_[unit].styleNumbers.end()) break;
    chain.push_back(styles[at->second].name);
    style = styles[at->second].base;
  }
  // A style that extends itself, or an unknown one, still sees the default.
  if (chain.empty()) chain.push_back(styles[0].name);
  return chain;
}

bool FileLoader::exists(const std::string&, const std::string&) { return true; }

std::vector<std::string> FileLoader::assets(const std::string&) { return {}; }

std::vector<std::string> FileLoader::filesIn(const std::string&, const std::string&) { return {}; }

std::string FileLoader::materialHint(const std::string&) {
  return "'gable asset material' lists them";
}

Status FileLoader::takesTint(const std::string&, const std::string&) { return {}; }

TreeRef FileLoader::parse(const Sources& sources, uint32_t file, Diagnostics& diagnostics) {
  return std::make_shared<const Tree>(lang::parse(sources, file, diagnostics));
}

namespace {
constexpr const char* kNotFound = "import-not-found";
}

Error missingImport(const std::string& path) {
  return {kNotFound, "there is no rule file '" + path + "'",
          "paths count from the project's folder or the importing file's; files of other projects "
          "are found with a workspace or a library"};
}

// Rules often name files of libraries that are not there. What they want of these is left out.
void Analysis::reportImport(const Error& why, const std::string& path, Span from,
                            const std::string& importer) {
  if (why.code != kNotFound) return error(why.code.c_str(), from, why.message, why.hint);
  if (!missingImports_.insert(path).second) return;
  const std::string nearest = nearFile(path, importer);
  warning(kNotFound, from,
          why.message + ": its rules become leaves, its attributes and functions have no value",
          nearest.empty() ? why.hint : "did you mean " + quote(nearest) + "?");
}

// What is no mistake in a file of others is told once, where it stands first.
void Analysis::tellOfImport(const Diagnostics& ofFile) {
  constexpr std::string_view kOnce = "choice-not-first";
  const auto isOnce = [&](const Diagnostics::Entry& d) { return d.code == kOnce; };
  const auto count = std::count_if(ofFile.all().begin(), ofFile.all().end(), isOnce);
  bool told = false;
  for (Diagnostics::Entry d : ofFile.all()) {
    if (isOnce(d) && std::exchange(told, true)) continue;
    if (isOnce(d) && count > 1) {
      d.message += "; it is the first of " + std::to_string(count) + " in this imported file";
    }
    diagnostics_.add(std::move(d));
  }
}

uint32_t Analysis::loadUnit(const std::string& path, Span from, uint32_t importerUnit,
                            std::vector<uint32_t>& open) {
  if (!loader_) {
    error("import-missing", from, "imports cannot be read here", "");
    return kNone;
  }
  if (path.ends_with(".vcga")) {
    if (missingImports_.insert(path).second) {
      warning("visual-cga", from,
              quote(path) +
                  " is a file of the visual editor, which cannot be read: its rules "
                  "become leaves, its attributes have no value",
              "export it as CGA from the editor that wrote it, and import that file");
    }
    return kNone;
  }
  Result<FileLoader::File> file = loader_->load(path, program_.units[importerUnit].path);
  if (!file) {
    reportImport(file.error(), path, from, program_.units[importerUnit].path);
    return kNone;
  }
  const auto known = unitByPath_.find(file->path);
  if (known != unitByPath_.end()) {
    if (std::find(open.begin(), open.end(), known->second) == open.end()) return known->second;
    error("import-cycle", from, "the import of '" + path + "' leads back to this file",
          "move what both need to a third file");
    return kNone;
  }
  if (program_.units.size() >= kMaxUnits) {
    error("too-many-imports", from,
          "more than " + std::to_string(kMaxUnits) + " files are imported", "");
    return kNone;
  }
  const auto unit = static_cast<uint32_t>(program_.units.size());
  const uint32_t id = sources_.add(file->path, std::move(file->text));
  Diagnostics ofFile;
  TreeRef t = loader_->parse(sources_, id, ofFile);
  tellOfImport(ofFile);
  unitByPath_.emplace(file->path, unit);
  program_.units.push_back({file->path, id, std::move(t)});
  units_.emplace_back();
  indexUnit(unit);
  loadImports(unit, open);
  return unit;
}

void Analysis::loadImports(uint32_t unit, std::vector<uint32_t>& open) {
  open.push_back(unit);
  for (size_t i = 0; i < units_[unit].imports.size(); ++i) {
    const NodeId import = units_[unit].imports[i].node;
    const Tree& t = *program_.units[unit].tree;
    const NodeId path = t.child(import, 1);
    if (path == kNoNode) continue;
    const uint32_t target = loadUnit(std::string(t.text(path)), t.span(path), unit, open);
    if (target != kNone) importedUnit_[{unit, import}] = target;
  }
  open.pop_back();
}

// --- Modules ---

ModuleId Analysis::addModule(uint32_t unit, std::string path, std::string style, ModuleId importer,
                             NodeId importNode, bool dynamic) {
  const auto id = static_cast<ModuleId>(program_.modules.size());
  Module m;
  m.id = id;
  m.unit = unit;
  m.path = std::move(path);
  m.style = std::move(style);
  m.importer = importer;
  m.importNode = importNode;
  m.dynamic = dynamic;
  m.original = id;
  const size_t nodes = program_.units[unit].tree->size();
  nodes_ += nodes;
  m.resolutions.resize(nodes);
  m.types.resize(nodes, ValueType::Null);
  program_.modules.push_back(std::move(m));
  scopes_.emplace_back();
  declareAll(id);
  return id;
}

void Analysis::declareAll(ModuleId module) {
  work();
  const Module& m = program_.modules[module];
  const StyleRanks ranks(styleChain(m.unit, m.style));
  const auto first = [](const auto& all) { return static_cast<uint32_t>(all.size()); };
  const RuleId rule = first(program_.rules);
  const FunctionId function = first(program_.functions);
  const AttributeId attribute = first(program_.attributes);
  declareAttributes(module, ranks);
  declareFunctions(module, ranks);
  declareRules(module, ranks);
  Module& made = program_.modules[module];
  made.firstRule = rule;
  made.firstFunction = function;
  made.firstAttribute = attribute;
  made.ruleCount = first(program_.rules) - rule;
  made.functionCount = first(program_.functions) - function;
  made.attributeCount = first(program_.attributes) - attribute;
}

RuleId Analysis::addRule(ModuleId owner, NodeId node, std::string name, const Annotations& notes) {
  const Tree& t = program_.tree(owner);
  RuleInfo r;
  r.id = static_cast<RuleId>(program_.rules.size());
  r.module = owner;
  r.node = node;
  r.qualifiedName = joinPath(program_.modules[owner].path, name);
  r.name = std::move(name);
  r.paramCount = static_cast<uint32_t>(t.children(paramsOf(t, node)).size());
  r.paramTypes.resize(r.paramCount, ValueType::Null);
  r.slotCount = r.paramCount + static_cast<uint32_t>(t.children(localsOf(t, node)).size());
  r.start = t.has(node, kFlagStart);
  r.extension = t.has(node, kFlagExtension);
  r.annotations = notes;
  program_.rules.push_back(std::move(r));
  return program_.rules.back().id;
}

void Analysis::declareRules(ModuleId module, const StyleRanks& ranks) {
  const uint32_t unit = program_.modules[module].unit;
  const Tree& t = *program_.units[unit].tree;
  std::map<std::pair<std::string_view, size_t>, size_t> best;
  const auto keyOf = [&](const Declaration& d) {
    return std::pair(t.text(d.node), t.children(paramsOf(t, d.node)).size());
  };
  for (const Declaration& d : units_[unit].rules) {
    const auto [at, isNew] = best.emplace(keyOf(d), ranks.of(d.style));
    if (!isNew) at->second = std::min(at->second, ranks.of(d.style));
  }
  Scope& scope = scopes_[module];
  // A start rule that a style redefines is the start rule still.
  std::set<std::pair<std::string_view, size_t>> starts;
  for (const Declaration& d : units_[unit].rules) {
    if (t.has(d.node, kFlagStart)) starts.insert(keyOf(d));
  }
  for (const Declaration& d : units_[unit].rules) {
    const std::string_view name = t.text(d.node);
    const size_t rank = ranks.of(d.style);
    const bool inDefault = d.style == kDefaultStyle;
    if (!inDefault && (t.has(d.node, kFlagStart) || t.has(d.node, kFlagExtension))) {
      error("keyword-in-style", nameSpan(t, d.node),
            quote(name) + " is a start or extension rule, which only the default style can have",
            "move it before the first style");
    }
    if (isImport(module, name)) {
      if (!inDefault || name.find('.', name.find('.') + 1) != std::string_view::npos) {
        error("bad-redefinition", nameSpan(t, d.node),
              quote(name) + " cannot redefine a rule of an import here",
              "redefine 'import.Rule' in the default style, with one prefix");
        continue;
      }
    }
    if (rank == ranks.none() || rank > best[keyOf(d)]) continue;
    const RuleId id = addRule(module, d.node, std::string(name), d.annotations);
    scope.rules[name].push_back(id);
    if (starts.count(keyOf(d)) != 0) {
      program_.rules[id].start = true;
      scope.startRules.push_back(id);
    }
    const std::vector<RuleId>& same = scope.rules[name];
    if (t.has(d.node, kFlagExtension) && same.size() > 1) {
      error("duplicate-rule", nameSpan(t, d.node),
            "an extension rule cannot have overloads, and " + quote(name) + " has one at " +
                placeText(nameSpan(t, program_.rules[same.front()].node)),
            "give them other names");
    }
  }
  warnOfStyles(t, units_[unit].rules, ranks);
}

// A style holds all that stands between its line and the next style.
void Analysis::warnOfStyles(const Tree& t, const std::vector<Declaration>& rules,
                            const StyleRanks& ranks) {
  const auto isInStyle = [](const Declaration& d) { return d.style != kDefaultStyle; };
  const bool isDefault = ranks.of(kDefaultStyle) == 0;
  if (!isDefault || rules.empty() || !std::all_of(rules.begin(), rules.end(), isInStyle)) return;
  const std::string style(rules.front().style);
  warning("rules-in-style", nameSpan(t, rules.front().node),
          "all rules stand in styles that are not in use; this one is of " + quote(style),
          "move what all styles share before the first 'style', or choose one: --style " + style);
}

void Analysis::declareFunctions(ModuleId module, const StyleRanks& ranks) {
  const uint32_t unit = program_.modules[module].unit;
  const Tree& t = *program_.units[unit].tree;
  std::map<std::pair<std::string_view, size_t>, size_t> best;
  const auto keyOf = [&](const Declaration& d) {
    return std::pair(t.text(d.node), t.children(paramsOf(t, d.node)).size());
  };
  for (const Declaration& d : units_[unit].functions) {
    const auto [at, isNew] = best.emplace(keyOf(d), ranks.of(d.style));
    if (!isNew) at->second = std::min(at->second, ranks.of(d.style));
  }
  Scope& scope = scopes_[module];
  for (const Declaration& d : units_[unit].functions) {
    const size_t rank = ranks.of(d.style);
    if (rank == ranks.none() || rank > best[keyOf(d)]) continue;
    const std::string_view name = t.text(d.node);
    FunctionInfo f;
    f.id = static_cast<FunctionId>(program_.functions.size());
    f.module = module;
    f.node = d.node;
    f.name = std::string(name);
    f.qualifiedName = joinPath(program_.modules[module].path, name);
    f.paramCount = static_cast<uint32_t>(keyOf(d).second);
    f.paramTypes.resize(f.paramCount, ValueType::Null);
    f.slotCount = f.paramCount + static_cast<uint32_t>(t.children(localsOf(t, d.node)).size());
    scope.functions[name].push_back(f.id);
    if (f.paramCount == 0 && scope.attributes.count(name) != 0) {
      error("duplicate-name", nameSpan(t, d.node),
            quote(name) + " is an attribute or constant already, at " +
                placeText(nameSpan(t, program_.attributes[scope.attributes.at(name)].node)),
            "rename one of the two");
    }
    program_.functions.push_back(std::move(f));
  }
}

void Analysis::declareAttributes(ModuleId module, const StyleRanks& ranks) {
  const uint32_t unit = program_.modules[module].unit;
  const Tree& t = *program_.units[unit].tree;
  // The declarations of each name, those of the nearest style first.
  std::unordered_map<std::string_view, RankedDeclarations> known;
  for (const Declaration& d : units_[unit].attributes) {
    const size_t rank = ranks.of(d.style);
    if (rank != ranks.none()) known[t.text(d.node)].emplace_back(rank, &d);
  }
  for (auto& [name, all] : known) {
    std::stable_sort(all.begin(), all.end(),
                     [](const auto& x, const auto& y) { return x.first < y.first; });
  }
  Scope& scope = scopes_[module];
  for (const Declaration& d : units_[unit].attributes) {
    const std::string_view name = t.text(d.node);
    const size_t rank = ranks.of(d.style);
    if (rank == ranks.none() || rank > known[name].front().first) continue;
    if (scope.attributes.count(name) != 0) {
      error("duplicate-name", nameSpan(t, d.node),
            quote(name) + " is declared already, at " +
                placeText(nameSpan(t, program_.attributes[scope.attributes.at(name)].node)),
            "rename one of the two");
      continue;
    }
    AttributeInfo a;
    a.id = static_cast<AttributeId>(program_.attributes.size());
    a.module = a.valueModule = module;
    a.node = d.node;
    a.valueNode = bodyOf(t, d.node);
    a.name = std::string(name);
    a.qualifiedName = joinPath(program_.modules[module].path, name);
    a.constant = t.kind(d.node) == NodeKind::Const;
    const size_t params = t.children(paramsOf(t, d.node)).size();
    a.edgeMap = params == 1 && !a.constant;
    if (params > 1 || (params == 1 && a.constant)) {
      error("bad-parameters", nameSpan(t, d.node),
            quote(name) + " is evaluated once and cannot take parameters",
            "remove the word before the name to make it a function");
    }
    a.slotCount = static_cast<uint32_t>(params + t.children(localsOf(t, d.node)).size());
    a.annotations = d.annotations;
    inheritAnnotations(a, t, known[name]);
    scope.attributes[name] = a.id;
    program_.attributes.push_back(std::move(a));
  }
}

// What the style at hand does not say of an attribute that it gives another value, the styles that
// it extends say: the nearest first.
void Analysis::inheritAnnotations(AttributeInfo& a, const Tree& t,
                                  const RankedDeclarations& declarations) {
  const auto saysGroup = [&](NodeId declaration) {
    const auto notes = t.children(annotationsOf(t, declaration));
    return std::any_of(notes.begin(), notes.end(), [&](NodeId n) { return t.text(n) == "Group"; });
  };
  // The group in force where the style begins is none of the attribute's.
  bool grouped = saysGroup(a.node);
  for (const auto& [rank, base] : declarations) {
    if (rank == declarations.front().first) continue;
    const bool last = base == declarations.back().second;
    addInherited(base->annotations, !grouped && (last || saysGroup(base->node)), a.annotations);
    grouped = grouped || saysGroup(base->node);
  }
}

// The style that was chosen for the import, else the first that it lists.
std::string Analysis::styleOfImport(ModuleId importer, NodeId import, uint32_t unit) {
  const Tree& t = program_.tree(importer);
  std::string first(kDefaultStyle);
  bool isFirst = true;
  std::vector<std::string_view> offered;
  for (const NodeId s : t.children(t.child(import, 2))) {
    std::vector<std::string_view> names;
    for (const StyleInfo& style : units_[unit].styles) names.push_back(style.name);
    if (std::find(names.begin(), names.end(), t.text(s)) == names.end()) {
      error("unknown-style", t.span(s), "the imported file has no style " + quote(t.text(s)),
            near(t.text(s), [&] { return names; }));
      continue;
    }
    offered.push_back(t.text(s));
    if (isFirst) first = std::string(t.text(s));
    isFirst = false;
  }
  const auto chosen = importStyles_.find(joinPath(program_.modules[importer].path, t.text(import)));
  if (chosen == importStyles_.end()) return first;
  chosen->second.taken = true;
  if (offered.empty()) {
    for (const StyleInfo& style : units_[unit].styles) offered.push_back(style.name);
  }
  const std::string& wanted = chosen->second.style;
  if (std::find(offered.begin(), offered.end(), wanted) != offered.end()) return wanted;
  error("unknown-style", nameSpan(t, import),
        "the import " + quote(chosen->first) + " has no style " + quote(wanted),
        near(wanted, [&] { return offered; }));
  return first;
}

bool Analysis::tooManyModules(uint32_t unit) const {
  return program_.modules.size() >= kMaxModules ||
         nodes_ + program_.units[unit].tree->size() > kMaxModuleNodes;
}

// Whoever declares 'trees.season' wants to set the attribute of the import, and gets one more.
void Analysis::warnOfNamesOfImports(ModuleId module) {
  if (program_.modules[module].original != module) return;
  const Tree& t = program_.tree(module);
  for (const Declaration& d : units_[program_.modules[module].unit].attributes) {
    const std::string_view name = t.text(d.node);
    const size_t dot = name.find('.');
    if (dot == std::string_view::npos) continue;
    const auto import = scopes_[module].imports.find(name.substr(0, dot));
    if (import == scopes_[module].imports.end()) continue;
    const std::string own(name.substr(dot + 1));
    std::vector<std::string_view> theirs;
    for (const auto& [known, id] : scopes_[import->second].attributes) theirs.push_back(known);
    std::sort(theirs.begin(), theirs.end());
    const bool isTheirs = std::binary_search(theirs.begin(), theirs.end(), own);
    warning("name-of-import", nameSpan(t, d.node),
            quote(name) + " is one more attribute of this file: the import " +
                quote(import->first) + (isTheirs ? " keeps its " : " has no ") + quote(own),
            isTheirs ? "write 'attr " + own + "', which goes to imports as well, or (" + own +
                           " = ...) behind the import"
                     : didYouMean(own, theirs));
  }
}

void Analysis::addImports(ModuleId module) {
  const uint32_t unit = program_.modules[module].unit;
  for (size_t i = 0; i < units_[unit].imports.size(); ++i) {
    const NodeId import = units_[unit].imports[i].node;
    const auto target = importedUnit_.find({unit, import});
    if (target == importedUnit_.end()) continue;
    const Tree& t = program_.tree(module);
    if (tooManyModules(target->second)) {
      tooManyAt_ = tooManyAt_.value_or(nameSpan(t, import));
      return;
    }
    const std::string_view name = t.text(import);
    const ModuleId child = addModule(target->second, joinPath(program_.modules[module].path, name),
                                     styleOfImport(module, import, target->second), module, import,
                                     program_.modules[module].dynamic);
    scopes_[module].imports[name] = child;
    const NodeId overrides = program_.tree(module).child(import, 3);
    checkOverrides(child, overrides);
    bindOverrides(child, overrides, false);
    propagateAttributes(child, overrides);
    addImports(child);
  }
  chooseOriginal(module);
  warnOfNamesOfImports(module);
}

void Analysis::bindRuleOverride(ModuleId module, NodeId rule, ModuleId owner) {
  const Tree& t = program_.tree(owner);
  const std::string_view name = t.text(rule);
  const auto own = scopes_[module].rules.find(name);
  const bool isExtension =
      own != scopes_[module].rules.end() && program_.rules[own->second[0]].extension;
  if (!isExtension) {
    std::vector<std::string_view> names;
    for (const auto& [n, ids] : scopes_[module].rules) {
      if (program_.rules[ids[0]].extension) names.push_back(n);
    }
    std::sort(names.begin(), names.end());
    error("not-an-extension", nameSpan(t, rule),
          "the imported file has no extension rule " + quote(name),
          names.empty() ? "write 'extension' before the rule in the imported file"
                        : near(name, [&] { return names; }));
  }
  const std::string prefix = program_.modules[module].path;
  const std::string local = prefix.substr(prefix.rfind('.') + 1);
  const RuleId id = addRule(owner, rule, joinPath(local, name), {});
  auto& list = scopes_[module].replaced[name];
  list.insert(list.begin(), id);
}

// What the list behind an import's path, or in the brackets of a call, names in vain.
void Analysis::checkOverrides(ModuleId module, NodeId overrides) {
  const ModuleId owner = program_.modules[module].importer;
  const Tree& t = program_.tree(owner);
  std::unordered_set<std::string_view> seen;
  for (const NodeId item : t.children(overrides)) {
    const bool isValue = t.kind(item) == NodeKind::NamedArg;
    // What else stands in the brackets of a call has been told.
    if (!isValue && (t.kind(item) != NodeKind::Name || program_.modules[module].dynamic)) continue;
    const std::string_view name = t.text(item);
    if (!isOpenAttribute(module, name)) {
      reportNoAttribute(module, nameSpan(t, item), name);
    } else if (!seen.insert(name).second) {
      error("duplicate-override", nameSpan(t, item), quote(name) + " stands here twice",
            "remove one of the two");
    }
  }
}

bool Analysis::isOpenAttribute(ModuleId module, std::string_view name) const {
  const auto at = scopes_[module].attributes.find(name);
  return at != scopes_[module].attributes.end() && !program_.attributes[at->second].constant;
}

void Analysis::reportNoAttribute(ModuleId module, Span span, std::string_view name) {
  constexpr double kOverridesChecked = 2023.0;
  std::string message = "the imported file has no attribute " + quote(name);
  constexpr size_t kFewNames = 8;
  std::vector<std::string_view> names;
  for (const auto& [n, id] : scopes_[module].attributes) {
    if (!program_.attributes[id].constant) names.push_back(n);
  }
  std::sort(names.begin(), names.end());
  std::string hint = near(name, [&] { return names; });
  if (hint.empty() && names.size() <= kFewNames) {
    for (const std::string_view n : names) hint += (hint.empty() ? "it has " : ", ") + quote(n);
  }
  if (isBefore(kOverridesChecked, program_.modules[module].importer)) {
    warning("unknown-attribute", span, std::move(message), std::move(hint));
  } else {
    error("unknown-attribute", span, std::move(message), std::move(hint));
  }
}

// The list behind an import's path, or the arguments of a dynamic import. Of an attribute that
// stands there twice the first value counts.
void Analysis::bindOverrides(ModuleId module, NodeId overrides, bool dynamic) {
  const ModuleId owner = program_.modules[module].importer;
  const Tree& t = program_.tree(owner);
  // Rules of the importer named `import.Rule` come first.
  const std::string path = program_.modules[module].path;
  const std::string local = path.substr(path.rfind('.') + 1);
  for (const auto& [name, ids] : scopes_[owner].rules) {
    if (name.size() > local.size() + 1 && prefixOf(name) == local) {
      auto& list = scopes_[module].replaced[name.substr(local.size() + 1)];
      if (list.empty()) list = ids;
    }
  }
  std::unordered_set<std::string_view> seen;
  for (const NodeId item : t.children(overrides)) {
    const std::string_view name = t.text(item);
    if (t.kind(item) == NodeKind::Rule) {
      bindRuleOverride(module, item, owner);
      continue;
    }
    if (t.kind(item) != NodeKind::NamedArg) continue;
    if (!isOpenAttribute(module, name) || !seen.insert(name).second) continue;
    AttributeInfo& a = program_.attributes[scopes_[module].attributes.at(name)];
    a.source = dynamic ? ValueSource::Given : ValueSource::Override;
    a.valueModule = owner;
    a.valueNode = t.child(item, 0);
    a.from = kNone;
  }
}

// Attributes that are neither protected nor overridden take the value of the importer's attribute
// of the same name.
void Analysis::propagateAttributes(ModuleId module, NodeId overrides) {
  const Module& m = program_.modules[module];
  const Tree& t = program_.tree(m.importer);
  if (overrides != kNoNode && t.children(overrides).empty()) return;
  std::unordered_set<std::string_view> isProtected;
  for (const NodeId item : t.children(overrides)) {
    if (t.kind(item) == NodeKind::Name) isProtected.insert(t.text(item));
  }
  const std::vector<Declaration>& declared = units_[m.unit].attributes;
  for (const Declaration& d : declared) {
    const std::string_view name = program_.tree(module).text(d.node);
    const auto at = scopes_[module].attributes.find(name);
    if (at == scopes_[module].attributes.end() || isProtected.count(name) != 0) continue;
    AttributeInfo& a = program_.attributes[at->second];
    if (a.node != d.node || d.style != kDefaultStyle || a.constant ||
        a.source != ValueSource::Own) {
      continue;
    }
    const auto from = scopes_[m.importer].attributes.find(name);
    if (from == scopes_[m.importer].attributes.end()) continue;
    if (program_.attributes[from->second].constant) continue;
    a.source = ValueSource::Propagated;
    a.from = from->second;
  }
}

// The module of `imp(a = e).Rule` at `node`, made at its first visit.
ModuleId Analysis::dynamicModule(ModuleId module, NodeId node) {
  const auto known = dynamicModules_.find({module, node});
  if (known != dynamicModules_.end()) return known->second;
  const Tree& t = program_.tree(module);
  const std::string_view name = t.text(t.child(node, 0));
  const auto fixed = scopes_[module].imports.find(name);
  ModuleId made = kNone;
  if (fixed != scopes_[module].imports.end() &&
      tooManyModules(program_.modules[fixed->second].unit)) {
    tooManyAt_ = tooManyAt_.value_or(nameSpan(t, node));
  } else if (fixed != scopes_[module].imports.end()) {
    const Module& origin = program_.modules[fixed->second];
    const NodeId overrides = t.child(origin.importNode, 3);
    made = addModule(origin.unit, origin.path, origin.style, module, node, true);
    bindOverrides(made, overrides, false);
    propagateAttributes(made, overrides);
    bindOverrides(made, t.child(node, 1), true);
    addImports(made);
    DynamicImport d;
    d.module = module;
    d.node = node;
    d.target = made;
    for (const NodeId item : t.children(t.child(node, 1))) {
      if (t.kind(item) != NodeKind::NamedArg) continue;
      const auto at = scopes_[made].attributes.find(t.text(item));
      if (at != scopes_[made].attributes.end()) d.given.push_back({at->second, t.child(item, 0)});
    }
    program_.dynamicImports.push_back(std::move(d));
  }
  dynamicModules_[{module, node}] = made;
  return made;
}

}  // namespace gable::lang
