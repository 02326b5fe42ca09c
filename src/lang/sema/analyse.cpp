// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The analysis as a whole: load, declare, infer, report. Types of parameters, functions and
// attributes depend on each other in circles, so bodies are walked in silent rounds until nothing
// changes: all of them once, and then those that have looked up what has changed since. Types only
// ever become known or are left open, which bounds the rounds. One more round walks
// those that have something to report, and reports.
//
// Of the modules of one file that share their types, one is walked in these rounds, which tells of
// mistakes as well; of the others only what the rules of the main file come to, once.

#include "lang/sema/analyse.h"

#include <algorithm>
#include <array>
#include <unordered_set>
#include <utility>

#include "base/text.h"
#include "lang/sema/analysis.h"

namespace gable::lang {

Analysis::Analysis(const Catalogue& catalogue, ValuePool& values, FileLoader* loader,
                   Sources& sources, Diagnostics& diagnostics)
    : catalogue_(catalogue),
      values_(values),
      loader_(loader),
      sources_(sources),
      diagnostics_(diagnostics) {
  for (const SelectorSpec& s : catalogue.selectors) selectors_.insert(s.name);
}

// Beyond kMostDiagnostics of a kind a reader needs no more, and memory stays bounded.
void Analysis::error(const char* code, Span span, std::string message, std::string hint) {
  const Meant meant = std::exchange(meant_, {});
  const bool mute = isMute();
  reported_ = !mute && ++errors_ <= kMostDiagnostics;
  if (mute) return;
  if (reported_) {
    diagnostics_.error(code, span, std::move(message), std::move(hint));
    if (!meant.nearest.empty()) fix(placeOf(meant.name, span), meant.nearest);
  } else if (errors_ == kMostDiagnostics + 1) {
    diagnostics_.error("too-many-errors", span, "mistakes from here on are not shown",
                       "correct those above first");
  }
}

void Analysis::warning(const char* code, Span span, std::string message, std::string hint) {
  const Meant meant = std::exchange(meant_, {});
  reported_ = !isMute() && ++warnings_ <= kMostDiagnostics;
  if (!reported_) return;
  diagnostics_.warning(code, span, std::move(message), std::move(hint));
  if (!meant.nearest.empty()) fix(placeOf(meant.name, span), meant.nearest);
}

void Analysis::fix(Span span, std::string text) {
  if (reported_ && span.valid()) diagnostics_.fixLast(span, std::move(text));
}

Span Analysis::placeOf(std::string_view name, Span span) const {
  if (!span.valid() || name.empty()) return {};
  const std::string_view source = sources_.text(span.file);
  const auto writtenAt = [&](size_t at) {
    return at <= source.size() && source.substr(at, name.size()) == name;
  };
  size_t at = span.begin;
  if (!writtenAt(at)) {
    // "imp.Name": the rest of a name with prefixes.
    constexpr std::string_view kEnds = " \t\r\n(){}[],:|\"";
    const size_t end = std::min(source.find_first_of(kEnds, at + 1), source.size());
    const std::string_view word = source.substr(at, end - at);
    at += word.size() > name.size() && word.ends_with(name) ? word.size() - name.size() : 1;
  }
  if (!writtenAt(at)) return {};
  const auto begin = static_cast<uint32_t>(at);
  return {span.file, begin, begin + static_cast<uint32_t>(name.size())};
}

// --- Definitions ---

void Analysis::openFrame(size_t unit, ModuleId module, NodeId declaration,
                         const std::vector<ValueType>& paramTypes, const std::vector<bool>& open) {
  body_ = {};
  body_.unit = unit;
  body_.module = module;
  body_.types = paramTypes;
  body_.open = open;
  const std::span<const NodeId> params = tree().children(paramsOf(tree(), declaration));
  // Looking through a few is faster than a set of them.
  constexpr size_t kFew = 16;
  std::unordered_set<std::string_view> seen;
  for (const NodeId p : params) {
    const bool twice = params.size() > kFew ? !seen.insert(text(p)).second
                                            : std::find(body_.slots.begin(), body_.slots.end(),
                                                        text(p)) != body_.slots.end();
    if (twice) {
      errorAt("duplicate-parameter", p, quote(text(p)) + " stands here twice",
              "rename one of the two");
    }
    body_.slots.push_back(text(p));
  }
  body_.paramCount = body_.slots.size();
  body_.types.resize(body_.paramCount, ValueType::Null);
  body_.open.resize(body_.paramCount, false);
}

// Local variables see the parameters and the local variables before them.
void Analysis::walkLocals(NodeId declaration) {
  for (const NodeId local : tree().children(localsOf(tree(), declaration))) {
    const ValueType type = visit(tree().child(local, 0));
    body_.slots.push_back(text(local));
    body_.types.push_back(type);
  }
}

void Analysis::walkRule(RuleId id) {
  const RuleInfo& r = program_.rules[id];
  const NodeId node = r.node;
  const RuleId from = originalId(UnitKind::Rule, id);
  openFrame(beginWalk(UnitKind::Rule, id), r.module, node, r.paramTypes, openRules_[from]);
  body_.rule = id;
  walkLocals(node);
  visitSequence(bodyOf(tree(), node));
  if (!runsInPlace()) reportUnused(bodyOf(tree(), node));
  openRules_[from] = body_.open;
  body_.types.resize(body_.paramCount);
  program_.rules[id].paramTypes = body_.types;
}

void Analysis::walkFunction(FunctionId id) {
  const FunctionInfo& f = program_.functions[id];
  const NodeId node = f.node;
  const FunctionId from = originalId(UnitKind::Function, id);
  openFrame(beginWalk(UnitKind::Function, id), f.module, node, f.paramTypes, openFunctions_[from]);
  walkLocals(node);
  const NodeId value = bodyOf(tree(), node);
  const ValueType type = visit(value, f.result);
  openFunctions_[from] = body_.open;
  body_.types.resize(body_.paramCount);
  FunctionInfo& after = program_.functions[id];
  after.paramTypes = body_.types;
  if (after.result == ValueType::Null && type != ValueType::Null) {
    after.result = type;
    settle();
  }
}

void Analysis::walkAttribute(AttributeId id) {
  const NodeId node = program_.attributes[id].node;
  const size_t unit = beginWalk(UnitKind::Attribute, id);
  openFrame(unit, program_.attributes[id].module, node, {}, {});
  body_.attribute = id;
  walkLocals(node);
  const ValueType type = visit(bodyOf(tree(), node));
  AttributeInfo& a = program_.attributes[id];
  if (a.type == ValueType::Null && type != ValueType::Null) {
    a.type = type;
    settle();
  }
  if (a.source != ValueSource::Override) return;
  const NodeId value = a.valueNode;
  const ValueType wanted = a.type;
  body_ = {};
  body_.module = a.valueModule;
  body_.attribute = id;
  body_.unit = unit;
  const std::string what = "the value of " + quote(program_.attributes[id].name);
  expectType(value, visit(value, wanted), wanted, what.c_str());
}

// A type of a parameter, a function or an attribute has become known, or is left open.
void Analysis::settle() {
  changed_ = true;
  walked_[body_.unit].changedAt = ++steps_;
}

size_t Analysis::beginWalk(UnitKind kind, uint32_t id) {
  const size_t unit = unitOf(kind, id);
  if (walked_.size() <= unit) walked_.resize(unit + 1);
  walked_[unit].at = ++steps_;
  walked_[unit].speaks = false;
  walked_[unit].looked.clear();
  return unit;
}

// Whether a walk may find more than the last one: what it has looked up has changed since, or types
// of its own have while it was under way.
bool Analysis::isDue(size_t unit) const {
  if (!isWalked(unit)) return true;
  const Walk& last = walked_[unit];
  const auto isNew = [&](size_t u) { return u < walked_.size() && walked_[u].changedAt > last.at; };
  return isNew(unit) || std::any_of(last.looked.begin(), last.looked.end(),
                                    [&](size_t u) { return isNew(originalOf(u)); });
}

void Analysis::walk(size_t unit) {
  const auto id = static_cast<uint32_t>(unit / kUnitKinds);
  switch (static_cast<UnitKind>(unit % kUnitKinds)) {
    case UnitKind::Rule: walkRule(id); break;
    case UnitKind::Function: walkFunction(id); break;
    case UnitKind::Attribute: walkAttribute(id); break;
  }
  if (mute_ && walked_[unit].changedAt > walked_[unit].at) spread(unit);
}

// A round over all that types come from.
void Analysis::walkOriginals() {
  const auto walkOne = [&](UnitKind kind, uint32_t id) {
    const size_t unit = unitOf(kind, id);
    if (originalOf(unit) == unit && isDue(unit)) walk(unit);
  };
  // By index: dynamic imports append to all three while they are walked.
  for (AttributeId i = 0; i < program_.attributes.size(); ++i) walkOne(UnitKind::Attribute, i);
  for (FunctionId i = 0; i < program_.functions.size(); ++i) walkOne(UnitKind::Function, i);
  for (RuleId i = 0; i < program_.rules.size(); ++i) walkOne(UnitKind::Rule, i);
}

// Walks what the rules of the main file come to, and what its calls of imports add meanwhile. All
// attributes have values, so they are reached.
void Analysis::reach(ModuleId main) {
  std::vector<bool> seen;
  std::vector<size_t> open;
  const auto find = [&](size_t unit) {
    if (seen.size() <= unit) seen.resize(unit + kUnitKinds);
    if (seen[unit]) return;
    seen[unit] = true;
    open.push_back(unit);
  };
  const auto visit = [&](size_t root) {
    find(root);
    while (!open.empty()) {
      const size_t unit = open.back();
      open.pop_back();
      const auto id = static_cast<uint32_t>(unit / kUnitKinds);
      const auto kind = static_cast<UnitKind>(unit % kUnitKinds);
      if (kind == UnitKind::Rule) program_.rules[id].reached = true;
      if (kind == UnitKind::Function) program_.functions[id].reached = true;
      if (!isWalked(unit)) walk(unit);
      for (const size_t next : walked_[unit].looked) find(next);
    }
  };
  for (RuleId i = 0; i < program_.rules.size(); ++i) {
    if (everything_ || program_.rules[i].module == main) visit(unitOf(UnitKind::Rule, i));
  }
  for (FunctionId i = 0; everything_ && i < program_.functions.size(); ++i) {
    visit(unitOf(UnitKind::Function, i));
  }
  for (AttributeId i = 0; i < program_.attributes.size(); ++i) {
    visit(unitOf(UnitKind::Attribute, i));
  }
}

// Walks what has something to report once more; copies have what their originals have.
void Analysis::speak() {
  const auto visitOne = [&](UnitKind kind, uint32_t id) {
    const size_t unit = unitOf(kind, id);
    if (originalOf(unit) == unit && isWalked(unit) && walked_[unit].speaks) walk(unit);
  };
  for (AttributeId i = 0; i < program_.attributes.size(); ++i) visitOne(UnitKind::Attribute, i);
  for (FunctionId i = 0; i < program_.functions.size(); ++i) visitOne(UnitKind::Function, i);
  for (RuleId i = 0; i < program_.rules.size(); ++i) visitOne(UnitKind::Rule, i);
}

void Analysis::infer(ModuleId main) {
  // Each round that goes on settles at least one type; real programs need three or four.
  constexpr int kRounds = 20;
  mute_ = true;
  walked_.clear();
  const auto sizes = [&] {
    return std::array{program_.attributes.size(), program_.functions.size(), program_.rules.size()};
  };
  for (int i = 0; i < kRounds; ++i) {
    const auto before = sizes();
    changed_ = false;
    walkOriginals();
    if (!changed_) reach(main);
    if (!changed_ && sizes() == before) break;
  }
  // The last round may have been one too few, for what is made to be misleading.
  reach(main);
  mute_ = false;
  speak();
  if (!tooManyAt_) return;
  error("too-many-imports", *tooManyAt_, "the imports unfold to too many uses of files",
        "import less, or less often");
  tooManyAt_.reset();
}

// --- Duplicates, which types decide ---

std::string Analysis::placeText(Span at) const {
  const LineColumn begin = sources_.locate(at.file, at.begin);
  return sources_.path(at.file) + ':' + std::to_string(begin.line) + ':' +
         std::to_string(begin.column);
}

std::string Analysis::firstPlaceText(const Tree& t, NodeKind kind, std::string_view name) const {
  for (const NodeId id : t.children(t.root())) {
    if (t.kind(id) == kind && t.text(id) == name) return placeText(nameSpan(t, id));
  }
  return {};
}

template <class Info>
void Analysis::reportOverloads(const std::vector<std::vector<uint32_t>>& sets,
                               const std::vector<Info>& infos, const char* code) {
  const auto differ = [](const Info& a, const Info& b) {
    for (size_t i = 0; i < a.paramTypes.size(); ++i) {
      const bool known = a.paramTypes[i] != ValueType::Null && b.paramTypes[i] != ValueType::Null;
      if (known && a.paramTypes[i] != b.paramTypes[i]) return true;
    }
    return false;
  };
  for (const std::vector<uint32_t>& set : sets) {
    for (size_t i = 0; i < set.size(); ++i) {
      for (size_t j = 0; j < i; ++j) {
        const Info& a = infos[set[j]];
        const Info& b = infos[set[i]];
        if (a.paramCount != b.paramCount || differ(a, b)) continue;
        error(code, nameSpan(program_.tree(b.module), b.node),
              quote(b.name) + " is defined already with " + std::to_string(b.paramCount) +
                  (b.paramCount == 1 ? " parameter" : " parameters") + ", at " +
                  placeText(nameSpan(program_.tree(a.module), a.node)),
              "rename one of the two");
        break;
      }
    }
  }
}

void Analysis::reportDuplicates(ModuleId firstModule) {
  for (ModuleId m = firstModule; m < scopes_.size(); ++m) {
    std::vector<std::vector<uint32_t>> rules, functions;
    for (const auto& [name, ids] : scopes_[m].rules) rules.push_back(ids);
    for (const auto& [name, ids] : scopes_[m].functions) functions.push_back(ids);
    // The maps have no order; reports shall.
    std::sort(rules.begin(), rules.end());
    std::sort(functions.begin(), functions.end());
    reportOverloads(rules, program_.rules, "duplicate-rule");
    reportOverloads(functions, program_.functions, "duplicate-name");
  }
}

// An importer's attribute of another type has only the name in common with the imported one.
void Analysis::reportOverrideTypes() {
  for (AttributeInfo& a : program_.attributes) {
    if (a.source != ValueSource::Propagated) continue;
    const AttributeInfo& from = program_.attributes[a.from];
    if (from.type == a.type || from.type == ValueType::Null || a.type == ValueType::Null) continue;
    warning("propagation-type", nameSpan(program_.tree(from.module), from.node),
            quote(from.name) + " is a " + typeName(from.type) + ", but " + quote(a.qualifiedName) +
                " is a " + typeName(a.type) + " and keeps its own value",
            "rename one, or protect it: import ... (" + a.name + ")");
    a.source = ValueSource::Own;
    a.from = kNone;
  }
}

void Analysis::chooseStartRule() {
  RuleId first = kNone;
  for (const RuleInfo& r : program_.rules) {
    if (r.module != 0 || r.paramCount != 0 || isImport(0, r.name)) continue;
    if (first == kNone) first = r.id;
    if (!r.annotations.startRule && !r.start) continue;
    program_.startRule = r.id;
    return;
  }
  program_.startRule = first;
}

// Styles that are not derived now are checked all the same; what is made for them is dropped.
void Analysis::checkOtherStyles() {
  // Each style is a reading of the whole file; styles by the thousand are made by programs.
  constexpr size_t kMostNodes = 16'000'000;
  const std::string active = program_.modules[0].style;
  const size_t before = nodes_, count = units_[0].styles.size();
  size_t read = 0, left = 0;
  for (const StyleInfo& style : std::vector<StyleInfo>(units_[0].styles)) {
    if (style.name == active) continue;
    if (read > kMostNodes) {
      ++left;
      continue;
    }
    const size_t modules = program_.modules.size();
    const size_t rules = program_.rules.size();
    const size_t functions = program_.functions.size();
    const size_t attributes = program_.attributes.size();
    const size_t dynamics = program_.dynamicImports.size();
    const ModuleId main = addModule(0, "", style.name, kNone, kNoNode, false);
    addImports(main);
    infer(main);
    reportDuplicates(main);
    checkWrittenValues(main);
    checkEndlessRules(main);
    checkDefaults(main);
    program_.modules.resize(modules);
    scopes_.resize(modules);
    program_.rules.resize(rules);
    program_.functions.resize(functions);
    program_.attributes.resize(attributes);
    program_.dynamicImports.resize(dynamics);
    const auto drop = [](auto& map, auto isNew) {
      for (auto at = map.begin(); at != map.end();) at = isNew(*at) ? map.erase(at) : std::next(at);
    };
    drop(dynamicModules_, [&](const auto& e) { return e.first.first >= modules; });
    drop(ownValues_, [&](const auto& e) { return e.first >= attributes; });
    drop(originals_, [&](const auto& e) { return e.second >= modules; });
    drop(copies_, [&](const auto& e) { return e.first >= modules; });
    for (auto& [original, copies] : copies_) {
      std::erase_if(copies, [&](ModuleId m) { return m >= modules; });
    }
    drop(openRules_, [&](const auto& e) { return e.first >= rules; });
    drop(openFunctions_, [&](const auto& e) { return e.first >= functions; });
    // A style may extend all the others.
    read += nodes_ - before + count;
    nodes_ = before;
  }
  if (left == 0) return;
  warning("unchecked-styles", {},
          std::to_string(left) + " of " + std::to_string(count) +
              " styles of the rule file are not checked, because that would take long",
          "derive with one of them to check it: --style NAME");
}

// "Modern, roofs.Slate": a style of the file, and those of imports by their paths.
std::string Analysis::chooseStyles(std::string_view text) {
  std::string own(kDefaultStyle);
  while (!text.empty()) {
    const size_t end = std::min(text.find(','), text.size());
    std::string_view one = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    while (one.starts_with(' ')) one.remove_prefix(1);
    while (one.ends_with(' ')) one.remove_suffix(1);
    const size_t dot = one.rfind('.');
    if (dot != std::string_view::npos) {
      importStyles_[std::string(one.substr(0, dot))] = {std::string(one.substr(dot + 1)), false};
    } else if (!one.empty()) {
      own = one;
    }
  }
  return own;
}

void Analysis::reportUnusedStyles() {
  for (const auto& [path, chosen] : importStyles_) {
    if (chosen.taken) continue;
    std::vector<std::string_view> paths;
    for (const Module& m : program_.modules) {
      if (!m.dynamic && !m.path.empty()) paths.push_back(m.path);
    }
    std::string hint = didYouMean(path, paths);
    if (hint.empty() && !paths.empty()) hint = "it has the import " + quote(paths[0]);
    error("unknown-style", {}, "the rule file has no import " + quote(path) + " with a style",
          std::move(hint));
  }
}

// The styles that imports offer, as chooseStyles() takes them.
void Analysis::addImportedStyles() {
  for (const Module& m : program_.modules) {
    if (m.dynamic || m.importer == kNone) continue;
    const Tree& t = program_.tree(m.importer);
    const std::span<const NodeId> listed = t.children(t.child(m.importNode, 2));
    for (const StyleInfo& s : units_[m.unit].styles) {
      const bool offered =
          std::any_of(listed.begin(), listed.end(), [&](NodeId n) { return t.text(n) == s.name; });
      if (units_[m.unit].styles.size() < 2 || (!listed.empty() && !offered)) continue;
      program_.styles.push_back({m.path + "." + s.name, "", s.description});
    }
  }
}

ResolvedProgram Analysis::run(AnalysisInput input) {
  const uint32_t file = input.tree->file();
  unitByPath_.emplace(input.path, 0);
  program_.units.push_back({std::move(input.path), file, std::move(input.tree)});
  units_.emplace_back();
  indexUnit(0);
  std::vector<uint32_t> open;
  loadImports(0, open);

  everything_ = input.everything;
  std::string style = chooseStyles(input.style);
  const std::vector<StyleInfo>& styles = units_[0].styles;
  if (std::none_of(styles.begin(), styles.end(),
                   [&](const StyleInfo& s) { return s.name == style; })) {
    std::vector<std::string_view> names;
    for (const StyleInfo& s : styles) names.push_back(s.name);
    std::string hint = didYouMean(style, names);
    for (size_t i = 0; hint.empty() && i < names.size(); ++i) {
      hint = "it has the style " + quote(std::string(names[i]));
    }
    if (hint.empty()) hint = "it declares none; write 'style " + style + "' before its attributes";
    error("unknown-style", {}, "the rule file has no style " + quote(style), hint);
    style = "Default";
  }
  addModule(0, "", style, kNone, kNoNode, false);
  addImports(0);
  infer(0);
  reportDuplicates(0);
  reportOverrideTypes();
  orderAttributes();
  checkWrittenValues(0);
  checkEndlessRules(0);
  reportEmptyFile();
  checkDefaults(0);
  checkOtherStyles();
  chooseStartRule();
  reportUnusedStyles();
  program_.styles = units_[0].styles;
  addImportedStyles();
  program_.description = units_[0].description;
  return std::move(program_);
}

ResolvedProgram analyse(AnalysisInput input, const Catalogue& catalogue, ValuePool& values,
                        FileLoader* loader, Sources& sources, Diagnostics& diagnostics) {
  return Analysis(catalogue, values, loader, sources, diagnostics).run(std::move(input));
}

}  // namespace gable::lang
