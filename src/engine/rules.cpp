// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Text to program: parse, analyse, compile. Each stage adds its diagnostics; a program exists only
// when no stage found an error.

#include <algorithm>
#include <cctype>
#include <iterator>
#include <optional>
#include <set>

#include "base/encoding.h"
#include "base/files.h"
#include "builtins/catalogue.h"
#include "dialects/dialect.h"
#include "dialects/remarks.h"
#include "engine/builtin_files.h"
#include "engine/guard.h"
#include "engine/impl.h"
#include "engine/other_notation.h"
#include "gable/files.h"
#include "lang/compile/compile.h"
#include "lang/format.h"
#include "lang/old_regions.h"
#include "lang/parser.h"
#include "lang/print.h"
#include "lang/sema/analyse.h"
#include "material/library.h"

namespace gable {

namespace {

/// A rule file larger than this is no rule file.
constexpr uint64_t kLargestRuleFile = 256u << 20;
/// Texts that share tables before new ones are begun.
constexpr uint32_t kGenerations = 256;

lang::Tree parseAs(const Dialect* dialect, const Sources& sources, uint32_t file,
                   lang::FileLoader& loader, Diagnostics& diagnostics) {
  if (!dialect) return lang::parse(sources, file, diagnostics);
  return dialect->parse({sources, file, builtinCatalogue(), &loader}, diagnostics);
}

// The tree of the same text at the same place among the rules before; null where there is none.
lang::TreeRef knownTree(const Rules::Impl* before, const Sources& sources, uint32_t file) {
  if (!before || file >= before->trees.size() || !before->trees[file]) return nullptr;
  const bool isSame = before->sources.path(file) == sources.path(file) &&
                      before->sources.text(file) == sources.text(file);
  return isSame ? before->trees[file] : nullptr;
}

class ProjectLoader final : public lang::FileLoader {
 public:
  ProjectLoader(const Project& project, const LoadSettings& settings)
      : project_(project),
        settings_(settings),
        before_(settings.before ? settings.before->shared().get() : nullptr) {}

  Result<File> load(const std::string& path, const std::string& importer) override {
    std::string file = project_.locate(path, importer);
    if (file.empty()) file = project_.locate("rules/" + path, importer);
    if (file.empty()) {
      return lang::missingImport(path);
    }
    std::string name = project_.projectPath(file);
    for (const auto& [edited, content] : settings_.overlay) {
      if (edited == name) return File{std::move(name), content};
    }
    Result<std::string> text = project_.where().read(file, kLargestRuleFile);
    if (!text.ok()) return text.error();
    return File{std::move(name), utf8Of(std::move(text.value()))};
  }

  bool exists(const std::string& path, const std::string& importer) override {
    if (path.starts_with("builtin:")) return isBuiltinFile(path);
    const std::string file = project_.locate(path, importer);
    AssetUse use{path, importer, file.empty() ? file : project_.projectPath(file)};
    if (known_.insert(path + '\0' + importer).second) assets_.push_back(std::move(use));
    return !file.empty();
  }

  std::string materialHint(const std::string& name) override { return gable::materialHint(name); }

  Status takesTint(const std::string& material, const std::string& tint) override {
    Vec3 rgb;
    double opacity = 1;
    return parseColor(tint, rgb, opacity) ? gable::takesTint(material, rgb) : Status();
  }

  std::vector<AssetUse> takeAssets() { return std::move(assets_); }

  std::vector<std::string> assets(const std::string&) override { return project_.assets(); }

  std::vector<std::string> filesIn(const std::string& folder, const std::string&) override {
    return project_.filesIn(folder);
  }

  lang::TreeRef parse(const Sources& sources, uint32_t file, Diagnostics& diagnostics) override {
    return parse(dialectOfPath(sources.path(file)), sources, file, diagnostics);
  }

  /// Trees of Gable's own language are kept where nothing was told of their text.
  lang::TreeRef parse(const Dialect* dialect, const Sources& sources, uint32_t file,
                      Diagnostics& diagnostics) {
    lang::TreeRef tree = dialect ? nullptr : knownTree(before_, sources, file);
    if (!tree) {
      const size_t told = diagnostics.all().size();
      tree =
          std::make_shared<const lang::Tree>(parseAs(dialect, sources, file, *this, diagnostics));
      if (dialect || diagnostics.all().size() != told) return tree;
    }
    trees_.resize(std::max<size_t>(trees_.size(), file + size_t{1}));
    trees_[file] = tree;
    return tree;
  }

  std::vector<lang::TreeRef> takeTrees() { return std::move(trees_); }

 private:
  const Project& project_;
  const LoadSettings& settings_;
  const Rules::Impl* const before_;
  std::vector<lang::TreeRef> trees_;
  std::vector<AssetUse> assets_;
  std::set<std::string> known_;
};

/// The notation of a file: null for Gable's own language. Error when there is none of that name.
Result<const Dialect*> dialectFor(const std::optional<std::string>& name, const std::string& path) {
  if (!name) return dialectOfPath(path);
  if (*name == "cga") return static_cast<const Dialect*>(nullptr);
  if (const Dialect* d = dialectNamed(*name)) return d;
  std::string names = "cga";
  for (const Dialect* d : dialects()) names += std::string(", ") + d->name;
  return Error{"unknown-dialect", "there is no notation '" + *name + "'",
               "the notations are " + names};
}

/// Where a rule file lies: on disk, or in a package.
struct Home {
  std::string path;
  std::shared_ptr<const Package> package;
};

Result<Home> homeOf(const std::string& path) {
  const Package::Place place = Package::placeOf(path);
  if (place.package.empty()) return Home{path, nullptr};
  const Result<std::shared_ptr<const Package>> opened = Package::open(place.package);
  if (!opened.ok()) return opened.error();
  const std::shared_ptr<const Package> package = opened.value();
  if (!place.inner.empty()) return Home{package->path() + "/" + place.inner, package};
  const Result<std::string> main = package->mainFile();
  if (!main.ok()) return main.error();
  return Home{package->path() + "/" + main.value(), package};
}

std::string rootOf(const LoadSettings& settings, const Home& home) {
  if (settings.project) return *settings.project;
  if (!home.package) return FileSearch::rootFor(home.path, settings.search);
  const std::string& top = home.package->path();
  const std::string inner = FileSearch::rootFor(*home.package, home.path.substr(top.size() + 1));
  return inner.empty() ? top : top + "/" + inner;
}

// The project and its tables: those of the rules before where they are of the same project.
void takeTables(Rules::Impl& to, const Home& home, const LoadSettings& settings) {
  const Rules::Impl* before = settings.before ? settings.before->shared().get() : nullptr;
  to.project = std::make_shared<Project>(rootOf(settings, home), settings.search, home.package);
  if (before && before->project && before->project->root() == to.project->root() &&
      before->project->where().settings() == settings.search && !home.package) {
    to.project = before->project;
    if (before->generation < kGenerations && !before->tables->full) {
      to.pool = before->pool;
      to.tables = before->tables;
      to.generation = before->generation + 1;
      return;
    }
  }
  to.pool = std::make_shared<ValuePool>();
  to.tables = std::make_shared<Environment>(to.pool, *to.project);
}

std::vector<AttributeInfo::Annotation> annotationsOf(const std::vector<AnnotationInfo>& from,
                                                     const ValuePool& pool) {
  std::vector<AttributeInfo::Annotation> out;
  for (const AnnotationInfo& n : from) {
    AttributeInfo::Annotation annotation{n.name, {}};
    for (const auto& argument : n.arguments) {
      annotation.arguments.emplace_back(argument.key, pool.str(argument.value));
    }
    out.push_back(std::move(annotation));
  }
  return out;
}

// Whether an import hands a name down from the main file to a module: no import on the way has
// empty brackets or the name in them.
bool isHandedDown(const lang::ResolvedProgram& from, lang::ModuleId module, std::string_view name) {
  constexpr size_t kOverrides = 3;
  while (from.modules[module].importer != lang::kNone) {
    const lang::Module& m = from.modules[module];
    const lang::Tree& t = from.tree(m.importer);
    const lang::NodeId list = t.kind(m.importNode) == lang::NodeKind::Import
                                  ? t.child(m.importNode, kOverrides)
                                  : lang::kNoNode;
    if (list != lang::kNoNode) {
      const auto& items = t.children(list);
      const bool named = std::any_of(items.begin(), items.end(),
                                     [&](lang::NodeId item) { return t.text(item) == name; });
      if (items.empty() || named) return false;
    }
    module = m.importer;
  }
  return true;
}

// What the program does not hold, since nothing runs it.
void describe(Rules::Impl& to, const lang::ResolvedProgram& from) {
  for (const lang::Module& m : from.modules) {
    if (m.dynamic) continue;
    const lang::Tree& t = *from.units[m.unit].tree;
    for (const lang::NodeId id : t.children(t.root())) {
      if (t.kind(id) != lang::NodeKind::Import || t.child(id, 1) == lang::kNoNode) continue;
      std::string name(t.text(id));
      const auto made = std::find_if(from.modules.begin(), from.modules.end(), [&](const auto& x) {
        return x.importer == m.id && x.importNode == id && !x.dynamic;
      });
      to.imports.push_back({m.path.empty() ? name : m.path + "." + name,
                            std::string(t.text(t.child(id, 1))),
                            made == from.modules.end() ? "" : from.units[made->unit].path});
    }
  }
  for (const lang::AttributeInfo& a : from.attributes) {
    const lang::Module& m = from.modules[a.module];
    if (a.constant || a.source != lang::ValueSource::Own || m.importer == lang::kNone) continue;
    if (!m.dynamic && isHandedDown(from, a.module, a.name))
      to.open.emplace(a.name, a.qualifiedName);
  }
  for (const lang::RuleInfo& r : from.rules) {
    lang::Annotations own = r.annotations;
    // The group in force is that of attributes.
    own.group = {};
    to.ruleAnnotations.push_back(annotationsOf(lang::listed(own, *to.pool), *to.pool));
  }
  to.description = from.description;
  for (const lang::StyleInfo& s : from.styles) to.styles.push_back(s.name);
}

std::shared_ptr<Rules::Impl> failed(const Error& e) {
  auto impl = std::make_shared<Rules::Impl>();
  impl->found = false;
  impl->diagnostics.push_back(diagnosticOf(e));
  return impl;
}

// Models, maps and pictures would be mistakes from the first letter on; what to do with one of
// them. Any other file may hold rules.
std::optional<Error> asOtherFile(const std::string& path) {
  constexpr std::string_view kMaps[] = {"geojson", "json", "jsonl", "osm", "pbf",
                                        "gpkg",    "fgb",  "shp",   "kml", "dxf"};
  constexpr std::string_view kOthers[] = {"fbx", "dae", "png", "jpg", "tif"};
  std::string extension = path.substr(std::min(path.rfind('.') + 1, path.size()));
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto isOf = [&](const auto& list) {
    return std::find(std::begin(list), std::end(list), extension) != std::end(list);
  };
  const std::string what = "'" + path + "' is no file of rules";
  if (isOf(kMaps)) {
    return Error{"rules-format", what,
                 "give rules, and its shapes with --shapes '" + path +
                     "'; 'gable city' makes the place of a whole map; to see a city model, write "
                     "it as .glb too"};
  }
  if (!isOf(modelExtensions()) && !isOf(kOthers)) return std::nullopt;
  return Error{"rules-format", what,
               "give a file such as .cga, .gbbg, .grammar or .park; 'gable render' draws "
               "models in .glb, .gltf and .obj"};
}

std::shared_ptr<const Rules::Impl> parsed(const std::string& text, const Home& home,
                                          const LoadSettings& settings, bool everything = false);

std::function<std::shared_ptr<const Rules::Impl>(const Rules::Impl&)> wholeReader(
    const Home& home, LoadSettings settings) {
  settings.before = nullptr;
  settings.limits.cancel = nullptr;
  return [home, settings](const Rules::Impl& reached) {
    LoadSettings again = settings;
    again.overlay.clear();
    for (uint32_t f = 1; f < reached.sources.size(); ++f) {
      again.overlay.emplace_back(reached.sources.path(f), reached.sources.text(f));
    }
    const Rules before(std::shared_ptr<const Rules::Impl>(std::shared_ptr<void>(), &reached));
    again.before = &before;
    return parsed(std::string(reached.sources.text(0)), home, again, true);
  };
}

std::shared_ptr<const Rules::Impl> parsed(const std::string& text, const Home& home,
                                          const LoadSettings& settings, bool everything) {
  const std::string& path = home.path;
  const double begin = now();
  auto impl = std::make_shared<Rules::Impl>();
  const Result<const Dialect*> dialect = dialectFor(settings.dialect, path);
  if (!dialect.ok()) return failed(dialect.error());
  if (const auto missing = FileSearch::missingFolder(settings.search)) return failed(*missing);
  takeTables(*impl, home, settings);
  impl->dialect = dialect.value();
  Diagnostics diagnostics;
  const std::string name = impl->project->projectPath(path);
  const uint32_t file = impl->sources.add(name, text);
  ProjectLoader loader(*impl->project, settings);
  lang::TreeRef tree = loader.parse(dialect.value(), impl->sources, file, diagnostics);
  if (!settings.dialect) {
    if (const auto other =
            asOtherNotation(path, dialect.value(), impl->sources, file, loader, diagnostics)) {
      impl->diagnostics.push_back(diagnosticOf(*other));
      return impl;
    }
  }
  lang::AnalysisInput input{std::move(tree), name, settings.style.value_or(std::string()),
                            everything};
  const lang::ResolvedProgram resolved = lang::analyse(
      std::move(input), builtinCatalogue(), *impl->pool, &loader, impl->sources, diagnostics);
  diagnostics = inWordsOf(impl->dialect, file, diagnostics, impl->sources, builtinCatalogue());
  describe(*impl, resolved);
  impl->assets = loader.takeAssets();
  impl->trees = loader.takeTrees();
  if (!diagnostics.hasErrors()) {
    impl->program =
        lang::compile(resolved, builtinCatalogue(), impl->pool, impl->sources, diagnostics);
    impl->ok = !diagnostics.hasErrors();
    if (!everything) impl->readWhole = wholeReader(home, settings);
  }
  diagnostics.sortByPlace();
  impl->diagnostics = listOf(diagnostics, impl->sources);
  impl->seconds = now() - begin;
  return impl;
}

Task readingRules(const std::string& path, const LoadSettings& settings) {
  return Task("analysing", path, settings.limits);
}

}  // namespace

std::shared_ptr<const Rules::Impl> Rules::Impl::whole() const {
  const std::lock_guard lock(wholeMutex);
  if (!wholeMade) wholeMade = readWhole(*this);
  return wholeMade;
}

RuleText readRuleText(const std::string& path) {
  return guardedResult<RuleText>([&]() -> RuleText {
    Result<std::string> text = readFile(path, kLargestRuleFile);
    if (!text.ok()) return {false, {}, {diagnosticOf(text.error())}};
    return {true, utf8Of(std::move(text.value())), {}};
  });
}

WriteResult writeTextFile(const std::string& path, const std::string& text) {
  return guardedResult<WriteResult>([&]() -> WriteResult {
    const Result<uint64_t> written = writeFile(path, text);
    if (!written.ok()) return {false, 0, 0, {diagnosticOf(written.error())}};
    return {true, 0, written.value(), {}};
  });
}

WriteResult writeTextFile(const std::string& path,
                          const std::function<void(const TextSink& sink)>& write) {
  return guardedResult<WriteResult>([&]() -> WriteResult {
    FileWriter file(path);
    write([&](std::string_view text) { file.append(text); });
    const Result<uint64_t> written = file.finish();
    if (!written.ok()) return {false, 0, 0, {diagnosticOf(written.error())}};
    return {true, 0, written.value(), {}};
  });
}

Rules Rules::load(const std::string& path, const LoadSettings& settings) {
  return Rules(guarded<Impl>(readingRules(path, settings), [&]() -> std::shared_ptr<const Impl> {
    Result<Home> home = homeOf(path);
    if (!home.ok()) return failed(home.error());
    if (!settings.dialect) {
      if (const auto other = asOtherFile(home.value().path)) return failed(*other);
    }
    const FileSearch files({}, {}, home.value().package);
    Result<std::string> text = files.read(home.value().path, kLargestRuleFile);
    if (!text.ok()) return failed(text.error());
    return parsed(utf8Of(std::move(text.value())), home.value(), settings);
  }));
}

Rules Rules::parse(const std::string& text, const std::string& path, const LoadSettings& settings) {
  return Rules(guarded<Impl>(readingRules(path, settings), [&] {
    return parsed(text, {path, nullptr}, settings);
  }));
}

bool Rules::ok() const { return impl_->ok; }
bool Rules::found() const { return impl_->found; }
const DiagnosticList& Rules::diagnostics() const { return impl_->diagnostics; }
double Rules::parseSeconds() const { return impl_->seconds; }

std::string Rules::disassembly() const {
  return guardedValue<std::string>(
      [&] { return impl_->ok ? disassemble(impl_->program) : std::string(); });
}

std::vector<AttributeInfo> Rules::attributes() const {
  return guardedValue<std::vector<AttributeInfo>>([&] {
    std::vector<AttributeInfo> out;
    // Those of a call of an import's rule have the names of the import's own.
    std::set<std::string_view> known;
    for (const AttributeCode& a : impl_->program.attributes) {
      if (a.constant || a.propagatesFrom >= 0 || !known.insert(a.name).second) continue;
      out.push_back(
          {a.name, typeName(a.type), a.hidden, annotationsOf(a.annotations, *impl_->pool)});
    }
    return out;
  });
}

std::vector<RuleInfo> Rules::rules() const {
  return guardedValue<std::vector<RuleInfo>>([&] {
    std::vector<RuleInfo> out;
    for (size_t i = 0; i < impl_->program.rules.size(); ++i) {
      const RuleCode& r = impl_->program.rules[i];
      out.push_back({r.qualifiedName, r.parameters.size(), r.startRule,
                     impl_->program.files[r.file],
                     impl_->sources.locate(r.span.file, r.span.begin).line, r.hidden,
                     impl_->ruleAnnotations[i]});
    }
    return out;
  });
}

std::vector<ImportInfo> Rules::imports() const { return impl_->imports; }
const std::vector<AssetUse>& Rules::assets() const { return impl_->assets; }
const std::string& Rules::description() const { return impl_->description; }
const std::vector<std::string>& Rules::styles() const { return impl_->styles; }

std::optional<std::string> Rules::startRule() const {
  const int32_t rule = impl_->program.startRule;
  if (rule < 0) return std::nullopt;
  return impl_->program.rules[static_cast<size_t>(rule)].qualifiedName;
}

Converted convert(const std::string& text, const std::string& path, const LoadSettings& settings) {
  return guardedResult<Converted>(Task("converting", path, settings.limits), [&] {
    Converted out;
    const Result<const Dialect*> dialect = dialectFor(settings.dialect, path);
    if (!dialect.ok()) {
      out.diagnostics.push_back(diagnosticOf(dialect.error()));
      return out;
    }
    Sources sources;
    Diagnostics diagnostics;
    const Project project(rootOf(settings, {path, nullptr}), settings.search);
    const uint32_t file = sources.add(project.projectPath(path), text);
    ProjectLoader loader(project, settings);
    if (!dialect.value()) {
      out.text = lang::format(sources, file, diagnostics);
    } else {
      const lang::Tree tree = parseAs(dialect.value(), sources, file, loader, diagnostics);
      const std::vector<lang::Remark> remarks = remarksOf(sources.text(file));
      const uint32_t printed = sources.add("converted.cga", lang::print(tree, remarks));
      if (!diagnostics.hasErrors()) out.text = lang::format(sources, printed, diagnostics);
    }
    const auto other = settings.dialect ? std::nullopt
                                        : asOtherNotation(path, dialect.value(), sources, file,
                                                          loader, diagnostics);
    if (other) {
      out.text.clear();
      out.diagnostics.push_back(diagnosticOf(*other));
      return out;
    }
    diagnostics.sortByPlace();
    out.diagnostics = listOf(diagnostics, sources);
    // What cannot be derived is not converted either: its mistakes would be told of other lines.
    if (dialect.value() && !diagnostics.hasErrors()) {
      const std::shared_ptr<const Rules::Impl> checked = parsed(text, {path, nullptr}, settings);
      for (const Diagnostic& d : checked->diagnostics) {
        if (d.severity == Diagnostic::Severity::Error) out.diagnostics.push_back(d);
      }
    }
    if (hasErrors(out.diagnostics)) out.text.clear();
    return out;
  });
}

namespace {

// The file, or its text with operations on regions as they are written today.
uint32_t modernised(Sources& sources, uint32_t file, Diagnostics& diagnostics) {
  // Calls within calls, outermost first.
  constexpr int kPasses = 16;
  for (int pass = 0;; ++pass) {
    Diagnostics unheard;
    const lang::Tree tree = lang::parse(sources, file, unheard);
    if (unheard.hasErrors()) return file;
    const std::string text(sources.text(file));
    lang::ModernText now = lang::withModernRegions(tree, text);
    if (now.again && now.text != text && pass < kPasses) {
      file = sources.add(std::string(sources.path(file)), std::move(now.text));
      continue;
    }
    for (const lang::NodeId call : now.left) {
      diagnostics.warning("text-selection", tree.span(call),
                          "this call of '" + std::string(tree.text(call)) +
                              "' takes texts, and is left as it is: they cannot be rewritten here",
                          "write selections, figures and options as expressions by hand");
    }
    return now.text == text ? file : sources.add(std::string(sources.path(file)), now.text);
  }
}

}  // namespace

Formatted format(const std::string& text, const std::string& path, const FileLimits& limits) {
  return guardedResult<Formatted>(Task("formatting", path, limits), [&] {
    Sources sources;
    Diagnostics diagnostics;
    const uint32_t file = sources.add(path, text);
    Formatted out;
    const Dialect* dialect = dialectOfPath(path);
    const auto layout = dialect ? dialect->format : lang::format;
    const uint32_t layoutOf = dialect ? file : modernised(sources, file, diagnostics);
    out.text = layout(sources, layoutOf, diagnostics);
    diagnostics.sortByPlace();
    out.diagnostics = listOf(diagnostics, sources);
    if (diagnostics.hasErrors()) out.text = text;
    return out;
  });
}

}  // namespace gable
