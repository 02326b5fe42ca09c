// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// From rules and shapes to a model.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string_view>
#include <utility>

#include "base/allowance.h"
#include "base/dispose.h"
#include "base/most_diagnostics.h"
#include "base/parallel.h"
#include "base/text.h"
#include "builtins/catalogue.h"
#include "city/drape.h"
#include "city/plan.h"
#include "engine/city_rules.h"
#include "engine/footprint.h"
#include "engine/outside_values.h"
#include "engine/told_once.h"
#include "engine/unused_properties.h"
#include "shape/edge_attributes.h"

namespace gable {

namespace {

bool takesList(const Program& program, const std::string& name) {
  const int32_t found = program.findAttribute(name);
  if (found < 0) return false;
  const ValueType type = program.attributes[static_cast<size_t>(found)].type;
  return type == ValueType::FloatArray || type == ValueType::BoolArray ||
         type == ValueType::StringArray;
}

// Ends early when the caller has cancelled: the derivation ends then as well.
std::vector<InitialShape> initialShapes(const Shapes::Impl& shapes, const Rules::Impl& r,
                                        const std::atomic<bool>* cancel) {
  const Program& program = r.program;
  ValuePool& pool = *r.pool;
  std::vector<InitialShape> out;
  out.reserve(shapes.footprints.size());
  for (const ShapeFootprint& f : shapes.footprints) {
    if (cancel && cancel->load()) break;
    InitialShape s;
    s.name = f.name;
    s.mesh = f.mesh;
    s.origin = f.origin;
    s.identity = f.id;
    s.feature = f.feature;
    s.faceTags = f.faceTags;
    s.streetWidths = f.streetWidths;
    s.materials = f.materials;
    s.groups = f.groups;
    s.index = f.index;
    s.upright = f.upright;
    for (const AttributeValue& a : f.attributes) {
      if (namesStartRule(a)) {
        const std::string& name = a.values[0].text;
        if (!name.empty() && program.findRule(name) >= 0) s.startRule = name;
      }
      const Value value = valueOfAttribute(a, pool);
      if (EdgeAttributes::isNamed(a.name, value.isArray()) && value.isArray()) {
        s.edgeAttributes.emplace_back(edgeAttributeName(a.name), value);
      }
      if (!EdgeAttributes::isNamed(a.name, value.isArray()) || takesList(program, a.name)) {
        s.attributes.emplace_back(identifierOf(a.name), value);
      }
      if (!f.reachesImports) continue;
      const auto [begin, end] = r.open.equal_range(identifierOf(a.name));
      for (auto at = begin; at != end; ++at) s.attributes.emplace_back(at->second, value);
    }
    out.push_back(std::move(s));
  }
  return out;
}

std::string_view lastPart(std::string_view name) { return name.substr(name.rfind('.') + 1); }

// What is called alike in imported files, where names have the import's before them.
std::string hintOfImports(const std::string& name, const std::vector<std::string_view>& names) {
  constexpr size_t kShown = 3;
  std::vector<std::string_view> last;
  for (const std::string_view n : names) last.push_back(lastPart(n));
  const std::string asked(lastPart(name));
  const bool known = std::find(last.begin(), last.end(), asked) != last.end();
  const std::string meant = known ? asked : nearestName(asked, last);
  std::string hint;
  size_t found = 0;
  for (size_t i = 0; i < names.size() && !meant.empty(); ++i) {
    // Two files may import a third under one name.
    const auto here = names.begin() + static_cast<std::ptrdiff_t>(i);
    if (last[i] != meant || std::find(names.begin(), here, *here) != here) continue;
    if (found++ >= kShown) continue;
    hint += (hint.empty() ? "did you mean '" : "' or '") + std::string(names[i]);
  }
  return hint.empty() ? hint
                      : hint + "'?" + (found > kShown ? " There are more of that name." : "");
}

// The same or the nearest of the names, else the first few of them and where all are listed.
std::string hintFor(const std::string& name, const std::vector<std::string_view>& names,
                    const char* what) {
  constexpr size_t kShown = 8;
  std::string hint = didYouMean(name, names);
  const bool imported = std::any_of(names.begin(), names.end(),
                                    [&](std::string_view n) { return lastPart(n) == name; });
  if (imported || hint.empty()) {
    const std::string ofImports = hintOfImports(name, names);
    if (!ofImports.empty()) hint = ofImports;
  }
  if (!hint.empty()) return hint;
  if (names.empty()) return std::string("there are no ") + what;
  hint = std::string("the ") + what + " are ";
  for (size_t i = 0; i < names.size() && i < kShown; ++i) {
    hint += (i ? ", " : "") + std::string(names[i]);
  }
  if (names.size() <= kShown) return hint;
  return hint + ", ...; gable info --all lists them";
}

std::string placeOf(const Scene& scene, const Leaf& leaf) {
  if (leaf.source >= scene.sources.size()) return {};
  const SourcePlace& s = scene.sources[leaf.source];
  std::string text = s.rule.empty() ? std::string() : ", made by rule '" + s.rule + "'";
  if (!s.file.empty()) text += " (" + s.file + ":" + std::to_string(s.line) + ")";
  return text;
}

void checkTraceFilter(const Program& program, const TraceFilter& filter, DiagnosticList& wrong) {
  std::vector<std::string> asked = filter.path;
  if (filter.rule) asked.push_back(*filter.rule);
  std::vector<std::string_view> names;
  for (const RuleCode& rule : program.rules) names.push_back(rule.qualifiedName);
  for (const std::string& name : asked) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    wrong.push_back(
        diagnosticOf(Error{"unknown-traced-rule", "the rules have no rule '" + name + "' to trace",
                           hintFor(name, names, "rules")}));
  }
}

std::vector<std::string_view> startNames(const Program& program) {
  std::vector<std::string_view> names;
  for (const RuleCode& rule : program.rules) {
    if (rule.parameters.empty()) names.push_back(rule.qualifiedName);
  }
  return names;
}

// Of a name that leaves out the import's, where rules of several imports have it. The first of them
// is taken, as ever.
std::optional<Diagnostic> ambiguousStart(const Program& program, const std::string& name,
                                         const std::string& who) {
  constexpr size_t kShown = 5;
  std::vector<std::string> names;
  for (const uint32_t rule : program.rulesAlike(name)) {
    const std::string& one = program.rules[rule].qualifiedName;
    if (one == name) return std::nullopt;
    // Calls that give an import values of their own have rules of the same name.
    if (std::find(names.begin(), names.end(), one) == names.end()) names.push_back(one);
  }
  if (names.size() < 2) return std::nullopt;
  std::string list;
  for (size_t i = 0; i < names.size() && i < kShown; ++i) {
    list += (i == 0 ? "'" : i + 1 == names.size() ? " or '" : ", '") + names[i] + "'";
  }
  if (names.size() > kShown) list += " or " + std::to_string(names.size() - kShown) + " more";
  return diagnosticOf({Severity::Warning,
                       "ambiguous-start-rule",
                       Span{},
                       who + " '" + name + "' to start with, which may be " + list + "; '" +
                           names[0] + "' is taken",
                       "write the name of the import before it, as '" + names[1] + "'",
                       {},
                       {}},
                      Sources{});
}

// The attributes and the start rule that the caller names, by their numbers in the program.
void bindSettings(const Rules::Impl& rules, const DeriveSettings& settings, DeriveOptions& options,
                  DiagnosticList& wrong) {
  const Program& program = rules.program;
  const auto complain = [&](Error e) { wrong.push_back(diagnosticOf(e)); };
  for (const auto& [name, text] : settings.attributes) {
    const int32_t found = program.findAttribute(name);
    if (EdgeAttributes::isNamed(name, text.starts_with('['))) {
      const Value list = valueOfText(text, *rules.pool);
      if (list.isArray()) {
        options.edgeAttributes.emplace_back(edgeAttributeName(name), list);
      } else {
        complain({"attribute-value", "'" + name + "' is no list of values for edges",
                  "write a value for each edge, all of one kind: [7, 0, 0, 0]"});
      }
      if (!takesList(program, name)) continue;
    }
    if (found < 0) {
      std::vector<std::string_view> names;
      for (const AttributeCode& a : program.attributes) {
        if (!a.constant) names.push_back(a.name);
      }
      complain({"unknown-attribute", "the rules have no attribute '" + name + "' to set",
                hintFor(name, names, "attributes")});
      continue;
    }
    if (rules.dialect && rules.dialect->hiddenReason &&
        program.attributes[static_cast<size_t>(found)].hidden) {
      complain({"not-settable", "'" + name + "' " + rules.dialect->hiddenReason,
                "change its range in the grammar"});
      continue;
    }
    Result<Value> value =
        settingOf(name, text, program.attributes[static_cast<size_t>(found)].type, *rules.pool);
    if (!value.ok()) {
      complain(value.error());
      continue;
    }
    const auto outside =
        outsideOf(program.attributes[static_cast<size_t>(found)], value.value(), *rules.pool);
    if (outside) wrong.push_back(diagnosticOf(*outside, Sources{}));
    options.attributes.emplace_back(name, value.value());
  }
  checkTraceFilter(program, settings.traceFilter, wrong);
  if (settings.startRule) {
    options.startRule = program.findRule(*settings.startRule);
    if (options.startRule >= 0) {
      const auto told = ambiguousStart(program, *settings.startRule, "the settings name");
      if (told) wrong.push_back(*told);
      return;
    }
    complain(
        {"unknown-start-rule",
         "the rules have no rule '" + *settings.startRule + "' without parameters to start with",
         hintFor(*settings.startRule, startNames(program), "rules without parameters")});
  } else if (program.startRule < 0) {
    const std::string file = program.files.empty() ? std::string() : program.files[0];
    const bool blank = program.rules.empty();
    complain(
        {"no-start-rule", "'" + file + "' has no rule to start with",
         blank
             ? "it holds no rule at all, or none outside of styles; the folder of examples has some"
             : "write a rule without parameters, or name another file"});
  }
}

// How many shapes name each rule to start with.
std::map<std::string, size_t> namedStarts(const Shapes::Impl& shapes) {
  std::map<std::string, size_t> counts;
  for (const ShapeFootprint& f : shapes.footprints) {
    for (const AttributeValue& a : f.attributes) {
      if (namesStartRule(a) && !a.values[0].text.empty()) ++counts[a.values[0].text];
    }
  }
  return counts;
}

// Those that there are none of, or several. What stands on a map was not written for these rules.
DiagnosticList unclearStarts(const std::map<std::string, size_t>& starts, bool ofMap,
                             const Program& program) {
  DiagnosticList out;
  if (ofMap) return out;
  for (const auto& [name, count] : starts) {
    if (out.size() >= kMostDiagnostics) break;
    const std::string who = count == 1 ? "a shape names" : std::to_string(count) + " shapes name";
    if (program.findRule(name) >= 0) {
      if (const auto told = ambiguousStart(program, name, who)) out.push_back(*told);
      continue;
    }
    out.push_back(diagnosticOf(
        {Severity::Warning,
         "unknown-start-rule",
         Span{},
         who + " '" + name + "' to start with, and the rules have no such rule without parameters",
         hintFor(name, startNames(program), "rules without parameters"),
         {},
         {}},
        Sources{}));
  }
  return out;
}

// Several rules of the file begin, and nobody has said which: the first does.
DiagnosticList severalStarts(const Rules::Impl& rules, const DeriveSettings& settings,
                             const std::map<std::string, size_t>& starts, bool ofMap) {
  if (settings.startRule || ofMap || !starts.empty()) return {};
  std::vector<const RuleCode*> marked;
  for (const RuleCode& r : rules.program.rules) {
    const bool own = r.qualifiedName.find('.') == std::string::npos;
    if (r.startRule && own && r.parameters.empty()) marked.push_back(&r);
  }
  if (marked.size() < 2) return {};
  return {diagnosticOf({Severity::Note,
                        "several-start-rules",
                        marked[1]->span,
                        std::to_string(marked.size()) + " rules have @StartRule; the first is '" +
                            marked[0]->qualifiedName + "', which begins",
                        "--start " + marked[1]->qualifiedName + " begins with this one",
                        {},
                        {}},
                       rules.sources)};
}

void checkWholeSeeds(const DeriveSettings& settings, DiagnosticList& wrong) {
  std::vector<double> seeds = {settings.seed};
  for (const auto& [index, seed] : settings.shapeSeeds) seeds.push_back(seed);
  for (const double seed : seeds) {
    const bool whole = seed >= INT32_MIN && seed <= INT32_MAX && seed == std::trunc(seed);
    if (whole) continue;
    wrong.push_back(diagnosticOf(
        Error{"bad-seed", "the seed of a GBBG grammar is a signed whole number of 32 bits",
              "write a whole number from -2147483648 to 2147483647"}));
    return;
  }
}

DeriveOptions optionsOf(const DeriveSettings& settings, const Rules::Impl& rules,
                        DiagnosticList& wrong) {
  DeriveOptions options;
  options.remember = settings.remember || settings.before;
  if (settings.before) options.before = &settings.before->impl().result;
  options.seed = settings.seed;
  options.sharing = settings.sharing;
  options.trace = settings.trace;
  options.traceFilter = settings.traceFilter;
  options.traceShapes = settings.trace && settings.traceShapes;
  options.importedAttributes = settings.importedAttributes;
  options.jobs = settings.jobs.value_or(0);
  options.limits = settings.limits;
  options.progress = settings.progress;
  options.cancel = settings.cancel;
  options.sources = &rules.sources;
  bindSettings(rules, settings, options, wrong);
  if (rules.dialect && rules.dialect->wholeSeeds) checkWholeSeeds(settings, wrong);
  return options;
}

}  // namespace

Model::Impl::~Impl() {
  if (result.recall && rules && result.recall->tables == rules->tables.get()) {
    rules->tables->spare.keep(blocksOf(result));
  }
}

void Model::Impl::makeSound(unsigned jobs) {
  sound = soundOf(result.scene, jobs);
  if (!sound.scene) return;
  std::string text;
  if (sound.leavesLeftOut > 0) {
    text = std::to_string(sound.leavesLeftOut) +
           (sound.leavesLeftOut == 1 ? " leaf is" : " leaves are") +
           " left out: the place or the size is not a number, or too large";
    if (sound.firstLeft < result.scene.leaves.size()) {
      const Leaf& first = result.scene.leaves[sound.firstLeft];
      text += "; the first is '" +
              (first.name < result.scene.names.size() ? result.scene.names[first.name] : "") + "'" +
              placeOf(result.scene, first);
    }
  }
  if (sound.valuesReplaced > 0) {
    text += text.empty() ? "" : "; ";
    text += std::to_string(sound.valuesReplaced) +
            " normals, texture coordinates or numbers of materials are replaced: they are not "
            "numbers, or too large";
  }
  diagnostics.push_back(
      diagnosticOf({Severity::Warning,
                    "model-not-finite",
                    Span{},
                    text,
                    "look for a division by zero, the root of a negative number, or a "
                    "size that grows from rule to rule",
                    {},
                    {}},
                   Sources{}));
}

namespace {

// However long that takes, unless the user has stopped it: then there is no model.
void makeSound(Model::Impl& model, const DeriveOptions& options) {
  Allowance allowance({{}, {}, options.cancel});
  const WorkScope scope(allowance);
  const Status status = guarded([&] {
    model.makeSound(options.jobs > 0 ? static_cast<unsigned>(options.jobs) : defaultJobs());
    return Status();
  });
  if (status.ok()) return;
  if (!allowance.reached()) throw Unwinding(status);
  disposeLater(std::exchange(model.result, {}));
  model.result.end = End::Cancelled;
}

// Within what the derivation has left of its limits.
void layOnTerrain(Model::Impl& model, const TerrainSurface& terrain, const DeriveOptions& options,
                  double spent) {
  Allowance::Most most{options.limits.seconds, options.limits.bytes, options.cancel};
  if (most.seconds) most.seconds = std::max(0.0, std::ceil((*most.seconds - spent) * 100) / 100);
  Allowance allowance(most);
  const WorkScope scope(allowance);
  const Status status = guarded([&] {
    model.sound.scene = draped(model.scene(), terrain, liesOnGround);
    return Status();
  });
  if (status.ok()) return;
  model.diagnostics.push_back(
      allowance.reached() ? diagnosticOf(allowance.reason("laying the place on its terrain"))
                          : diagnosticOf(Error{status.code(), status.message(), status.hint()}));
}

std::shared_ptr<const DerivedFrom> fromOf(const Shapes& shapes, DeriveSettings settings) {
  settings.remember = false;
  settings.before = nullptr;
  settings.progress = {};
  settings.cancel = nullptr;
  return std::make_shared<DerivedFrom>(DerivedFrom{shapes, std::move(settings)});
}

}  // namespace

namespace {

bool isReached(const Program& program, const std::string& start) {
  const int32_t rule = program.findRule(start);
  return rule < 0 || program.rules[static_cast<size_t>(rule)].reached;
}

// The rules, or those with more, where what they are to start with is not reached in them.
std::shared_ptr<const Rules::Impl> startedBy(const Rules& rules,
                                             const std::map<std::string, size_t>& starts,
                                             const DeriveSettings& settings) {
  const Program& program = rules.impl().program;
  const auto isMissed = [&](const auto& named) { return !isReached(program, named.first); };
  const bool missed = (settings.startRule && !isReached(program, *settings.startRule)) ||
                      std::any_of(starts.begin(), starts.end(), isMissed);
  return missed ? rules.impl().whole() : rules.shared();
}

}  // namespace

std::shared_ptr<Model::Impl> derived(const Rules& rules, const Shapes& shapes,
                                     const DeriveSettings& settings) {
  const double begin = now();
  auto impl = std::make_shared<Model::Impl>();
  if (!rules.impl().ok) return impl;
  const std::map<std::string, size_t> starts = namedStarts(shapes.impl());
  impl->rules = startedBy(rules, starts, settings);
  const Rules::Impl& r = *impl->rules;
  impl->project = r.project;
  if (!r.ok) {
    impl->diagnostics = r.diagnostics;
    return impl;
  }
  impl->from = fromOf(shapes, settings);
  DeriveOptions options = optionsOf(settings, r, impl->diagnostics);
  if (hasErrors(impl->diagnostics)) return impl;
  options.geo = shapes.impl().geo.get();
  std::vector<InitialShape> initial = initialShapes(shapes.impl(), r, settings.cancel);
  if (r.project) r.project->addTextures(shapes.impl().textures);
  for (const auto& [index, seed] : settings.shapeSeeds) {
    if (index < initial.size()) initial[index].seed = seed;
  }
  if (!r.tables->full) impl->result = gable::derive(r.program, initial, *r.tables, options);
  if (r.tables->full) {
    // Tables grow with each derivation; now this one has its own. Nothing can be taken over from
    // it.
    impl->result = {};
    Environment own(r.pool, *r.project);
    options.remember = false;
    options.before = nullptr;
    impl->result = gable::derive(r.program, initial, own, options);
  }
  if (impl->result.end == End::Cancelled) {
    // Nobody reads what else there is to say.
    disposeLater(std::move(initial));
    return impl;
  }
  impl->result.scene.geoOrigin = shapes.impl().geoOrigin;
  for (const ShapeFootprint& f : shapes.impl().footprints) {
    for (const Vec3& p : f.mesh.positions) impl->result.scene.place.include(f.origin.point(p));
  }
  impl->geo = shapes.impl().geo;
  impl->startRule = options.startRule >= 0 ? options.startRule : r.program.startRule;
  for (const auto& [name, value] : options.attributes) impl->setAttributes.insert(name);
  for (const ShapeFootprint& f : shapes.impl().footprints) {
    std::vector<AttributeValue>& known = impl->shapeAttributes.emplace_back(f.attributes);
    if (!f.id.empty()) known.push_back({"id", {{PlainValue::Kind::Text, 0, f.id}}, 0, 0});
  }
  ToldOnce told;
  told.add(r.diagnostics);
  const DiagnosticList made = told.without(
      listOf(inWordsOf(r.dialect, impl->result.diagnostics, builtinCatalogue()), r.sources));
  impl->diagnostics.insert(impl->diagnostics.end(), made.begin(), made.end());
  for (const DiagnosticList& some :
       {outsideValues(initial, r), unusedProperties(shapes.impl(), r),
        cityRuleNotes(shapes.impl(), r), unclearStarts(starts, shapes.impl().ofMap, r.program),
        severalStarts(r, settings, starts, shapes.impl().ofMap)}) {
    impl->diagnostics.insert(impl->diagnostics.end(), some.begin(), some.end());
  }
  makeSound(*impl, options);
  if (shapes.impl().terrain) layOnTerrain(*impl, *shapes.impl().terrain, options, now() - begin);
  impl->seconds = now() - begin;
  return impl;
}

}  // namespace gable
