// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Text to program: parse, analyse, compile. Each stage adds its diagnostics; a program exists only
// when no stage found an error.

#include "base/files.h"
#include "builtins/catalogue.h"
#include "dialects/dialect.h"
#include "dialects/remarks.h"
#include "engine/guard.h"
#include "engine/impl.h"
#include "gable/files.h"
#include "lang/compile/compile.h"
#include "lang/format.h"
#include "lang/old_regions.h"
#include "lang/parser.h"
#include "lang/print.h"
#include "lang/sema/analyse.h"

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

class ProjectLoader final : public lang::FileLoader {
 public:
  ProjectLoader(const Project& project, const LoadSettings& settings)
      : project_(project), settings_(settings) {}

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
    Result<std::string> text = readFile(file, kLargestRuleFile);
    if (!text.ok()) return text.error();
    return File{std::move(name), std::move(text.value())};
  }

  bool exists(const std::string& path, const std::string& importer) override {
    return path.starts_with("builtin:") || !project_.locate(path, importer).empty();
  }

  std::vector<std::string> assets(const std::string&) override { return project_.assets(); }

  lang::Tree parse(const Sources& sources, uint32_t file, Diagnostics& diagnostics) override {
    return parseAs(dialectOfPath(sources.path(file)), sources, file, *this, diagnostics);
  }

 private:
  const Project& project_;
  const LoadSettings& settings_;
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

std::string rootOf(const LoadSettings& settings, const std::string& path) {
  return settings.project ? *settings.project : FileSearch::rootFor(path, settings.search);
}

// The project and its tables: those of the rules before where they are of the same project.
void takeTables(Rules::Impl& to, const std::string& root, const SearchSettings& search,
                const Rules::Impl* before) {
  to.project = std::make_shared<Project>(root, search);
  if (before && before->project && before->project->root() == to.project->root() &&
      before->project->where().settings() == search) {
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

std::shared_ptr<Rules::Impl> failed(const Error& e) {
  auto impl = std::make_shared<Rules::Impl>();
  impl->found = false;
  impl->diagnostics.push_back(diagnosticOf(e));
  return impl;
}

std::shared_ptr<const Rules::Impl> parsed(const std::string& text, const std::string& path,
                                          const LoadSettings& settings) {
  const double begin = now();
  auto impl = std::make_shared<Rules::Impl>();
  const Result<const Dialect*> dialect = dialectFor(settings.dialect, path);
  if (!dialect.ok()) return failed(dialect.error());
  if (const auto missing = FileSearch::missingFolder(settings.search)) return failed(*missing);
  takeTables(*impl, rootOf(settings, path), settings.search,
             settings.before ? settings.before->shared().get() : nullptr);
  impl->dialect = dialect.value();
  Diagnostics diagnostics;
  const std::string name = impl->project->projectPath(path);
  const uint32_t file = impl->sources.add(name, text);
  ProjectLoader loader(*impl->project, settings);
  lang::AnalysisInput input{parseAs(dialect.value(), impl->sources, file, loader, diagnostics),
                            name, settings.style.value_or(std::string())};
  const lang::ResolvedProgram resolved = lang::analyse(
      std::move(input), builtinCatalogue(), *impl->pool, &loader, impl->sources, diagnostics);
  if (!diagnostics.hasErrors()) {
    impl->program =
        lang::compile(resolved, builtinCatalogue(), impl->pool, impl->sources, diagnostics);
    impl->ok = !diagnostics.hasErrors();
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

RuleText readRuleText(const std::string& path) {
  return guardedResult<RuleText>([&]() -> RuleText {
    Result<std::string> text = readFile(path, kLargestRuleFile);
    if (!text.ok()) return {false, {}, {diagnosticOf(text.error())}};
    return {true, std::move(text.value()), {}};
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
    Result<std::string> text = readFile(path, kLargestRuleFile);
    if (!text.ok()) return failed(text.error());
    return parsed(text.value(), path, settings);
  }));
}

Rules Rules::parse(const std::string& text, const std::string& path, const LoadSettings& settings) {
  return Rules(
      guarded<Impl>(readingRules(path, settings), [&] { return parsed(text, path, settings); }));
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
    for (const AttributeCode& a : impl_->program.attributes) {
      if (a.constant || a.propagatesFrom >= 0) continue;
      AttributeInfo info{a.name, typeName(a.type), a.hidden, {}};
      for (const AnnotationInfo& n : a.annotations) {
        AttributeInfo::Annotation annotation{n.name, {}};
        for (const auto& argument : n.arguments) {
          annotation.arguments.emplace_back(argument.key, impl_->pool->str(argument.value));
        }
        info.annotations.push_back(std::move(annotation));
      }
      out.push_back(std::move(info));
    }
    return out;
  });
}

std::vector<RuleInfo> Rules::rules() const {
  return guardedValue<std::vector<RuleInfo>>([&] {
    std::vector<RuleInfo> out;
    for (const RuleCode& r : impl_->program.rules) {
      out.push_back({r.qualifiedName, r.parameters.size(), r.startRule,
                     impl_->program.files[r.file],
                     impl_->sources.locate(r.span.file, r.span.begin).line});
    }
    return out;
  });
}

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
    const Project project(rootOf(settings, path), settings.search);
    const uint32_t file = sources.add(project.projectPath(path), text);
    if (!dialect.value()) {
      out.text = lang::format(sources, file, diagnostics);
    } else {
      ProjectLoader loader(project, settings);
      const lang::Tree tree = parseAs(dialect.value(), sources, file, loader, diagnostics);
      const std::vector<lang::Remark> remarks = remarksOf(*dialect.value(), sources.text(file));
      const uint32_t printed = sources.add("converted.cga", lang::print(tree, remarks));
      if (!diagnostics.hasErrors()) out.text = lang::format(sources, printed, diagnostics);
    }
    diagnostics.sortByPlace();
    out.diagnostics = listOf(diagnostics, sources);
    if (diagnostics.hasErrors()) out.text.clear();
    return out;
  });
}

namespace {

// The file, or its text with operations on regions as they are written today.
uint32_t modernised(Sources& sources, uint32_t file, Diagnostics& diagnostics) {
  Diagnostics unheard;
  const lang::Tree tree = lang::parse(sources, file, unheard);
  if (unheard.hasErrors()) return file;
  const std::string text(sources.text(file));
  const lang::ModernText now = lang::withModernRegions(tree, text);
  for (const lang::NodeId call : now.left) {
    diagnostics.warning("text-selection", tree.span(call),
                        "this call of '" + std::string(tree.text(call)) +
                            "' takes texts, and is left as it is: they cannot be rewritten here",
                        "write selections, figures and options as expressions by hand");
  }
  return now.text == text ? file : sources.add(std::string(sources.path(file)), now.text);
}

void noteThatNothingIsDone(const Dialect& dialect, const std::string& path,
                           Diagnostics& diagnostics) {
  Diagnostics::Entry d;
  d.severity = Severity::Note;
  d.code = "no-canonical-form";
  d.message =
      std::string(dialect.title) + " has no canonical form: '" + path + "' is left as it is";
  d.hint = "'gable convert' writes it in Gable's own language";
  diagnostics.add(std::move(d));
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
    if (!layout) noteThatNothingIsDone(*dialect, path, diagnostics);
    out.text = layout ? layout(sources, layoutOf, diagnostics) : text;
    diagnostics.sortByPlace();
    out.diagnostics = listOf(diagnostics, sources);
    if (diagnostics.hasErrors()) out.text = text;
    return out;
  });
}

}  // namespace gable
