// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <algorithm>
#include <chrono>
#include <map>
#include <new>
#include <stdexcept>

#include "engine/guard.h"
#include "engine/impl.h"
#include "engine/told_once.h"
#include "gable/names.h"

namespace gable {

namespace {

std::optional<TextRange> rangeOf(const Span& span, const Sources& sources) {
  if (!span.valid() || span.file >= sources.size()) return std::nullopt;
  const LineColumn from = sources.locate(span.file, span.begin);
  const LineColumn to = sources.locate(span.file, span.end);
  return TextRange{sources.path(span.file), from.line, from.column, to.line, to.column};
}

}  // namespace

double now() {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

bool hasErrors(const DiagnosticList& diagnostics) {
  return std::any_of(diagnostics.begin(), diagnostics.end(),
                     [](const Diagnostic& d) { return d.isError(); });
}

namespace {

// The name in the first quotes of a message; empty without one.
std::string quotedName(const std::string& message) {
  const size_t from = message.find('\'');
  const size_t to = from == std::string::npos ? from : message.find('\'', from + 1);
  return to == std::string::npos ? std::string() : message.substr(from + 1, to - from - 1);
}

constexpr std::string_view kAboutMissingFiles[] = {"missing-file", "missing-texture", "missing-asset",
                                               "shape-texture-missing", "unknown-material"};

// The file that such a message is about; of a material its name, which stands last.
std::string missingName(const Diagnostic& d) {
  if (d.code != "unknown-material") return quotedName(d.message);
  const size_t to = d.message.rfind('\'');
  const size_t from = to == std::string::npos || to == 0 ? to : d.message.rfind('\'', to - 1);
  return from == std::string::npos ? std::string() : d.message.substr(from + 1, to - from - 1);
}

bool isAboutMissingFile(const Diagnostic& d) {
  return std::find(std::begin(kAboutMissingFiles), std::end(kAboutMissingFiles), d.code) !=
         std::end(kAboutMissingFiles);
}

constexpr std::string_view kCapped = "tint-capped";

bool isWithin(const TextRange& part, const TextRange& whole) {
  const auto place = [](uint32_t line, uint32_t column) { return uint64_t{line} << 32 | column; };
  return part.file == whole.file &&
         place(part.line, part.column) >= place(whole.line, whole.column) &&
         place(part.endLine, part.endColumn) <= place(whole.endLine, whole.endColumn);
}

// A name that nothing is known of, and of which nothing better can be said than that.
bool isPlainLeaf(const Diagnostic& d) {
  const std::string name = quotedName(d.message);
  return d.code == "undefined-rule" && d.range && !name.empty() &&
         d.hint.find("'" + name + ".'") != std::string::npos;
}

// Up to so many names of a file are told one by one.
constexpr size_t kFewLeaves = 3;

struct Leaves {
  std::vector<std::string> names;
  std::string list;
};

// One line for all of a file.
std::string rendered(const std::string& file, const Leaves& leaves) {
  return file + ": warning: " + std::to_string(leaves.names.size()) +
         " names are no rules or operations, and become leaves: " + leaves.list +
         " [undefined-rule]\n  hint: write '" + leaves.names[0] +
         ".' if it shall be a leaf, and so on\n";
}

}  // namespace

const char* severityName(Diagnostic::Severity severity) {
  return severityName(static_cast<Severity>(severity));
}

// A file with many leaves would bury what is wrong with it.
std::string render(const DiagnosticList& diagnostics) {
  return guardedValue<std::string>([&] {
    std::map<std::string, Leaves> files;
    for (const Diagnostic& d : diagnostics) {
      if (!isPlainLeaf(d)) continue;
      Leaves& leaves = files[d.range->file];
      const std::string name = quotedName(d.message);
      if (std::find(leaves.names.begin(), leaves.names.end(), name) != leaves.names.end()) continue;
      leaves.names.push_back(name);
      leaves.list += (leaves.list.empty() ? "" : ", ") + name + " (" +
                     std::to_string(d.range->line) + ":" + std::to_string(d.range->column) + ")";
    }
    std::string errors, warnings;
    for (const Diagnostic& d : diagnostics) {
      if (d.isError()) {
        errors += d.rendered;
        continue;
      }
      if (!isPlainLeaf(d) || files[d.range->file].names.size() <= kFewLeaves) {
        warnings += d.rendered;
      }
    }
    for (const auto& [file, leaves] : files) {
      if (leaves.names.size() > kFewLeaves) warnings += rendered(file, leaves);
    }
    return errors + warnings;
  });
}

Diagnostic diagnosticOf(const Diagnostics::Entry& e, const Sources& sources) {
  Diagnostic d;
  d.severity = static_cast<Diagnostic::Severity>(e.severity);
  d.code = e.code;
  d.message = e.message;
  d.hint = e.hint;
  d.shapePath = e.shapePath;
  d.rendered = format(e, sources);
  d.range = rangeOf(e.span, sources);
  if (e.fix) {
    if (auto range = rangeOf(e.fix->span, sources)) d.fix = TextEdit{*range, e.fix->text};
  }
  return d;
}

DiagnosticList listOf(const Diagnostics& diagnostics, const Sources& sources) {
  DiagnosticList out;
  for (const Diagnostics::Entry& e : diagnostics.all()) out.push_back(diagnosticOf(e, sources));
  return out;
}

Diagnostic diagnosticOf(const Error& e) {
  return diagnosticOf({Severity::Error, e.code, Span{}, e.message, e.hint, {}}, Sources{});
}

Diagnostic diagnosticOfException() {
  const char* memory = "there is not enough memory for this";
  const char* smaller = "derive fewer or smaller shapes at a time, or set a limit on memory";
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return diagnosticOf(Error{"out-of-memory", memory, smaller});
  } catch (const std::length_error&) {
    return diagnosticOf(Error{"out-of-memory", memory, smaller});
  } catch (const std::exception& e) {
    return diagnosticOf(Error{"internal-error", std::string("the library failed: ") + e.what(),
                              "this is a mistake of the library; please report it"});
  } catch (...) {
    return diagnosticOf(Error{"internal-error", "the library failed",
                              "this is a mistake of the library; please report it"});
  }
}

Task::Task(const char* doing, std::string_view object, const FileLimits& limits)
    : doing_(doing), object_(object), allowance_({limits.seconds, limits.bytes, limits.cancel}) {}

std::string Task::what() const {
  return object_.empty() ? doing_ : doing_ + (" '" + std::string(object_) + "'");
}

Diagnostic Task::warning() const {
  const Error e = allowance_.reason(what());
  return diagnosticOf({Severity::Warning, e.code, Span{}, e.message, e.hint, {}, {}}, Sources{});
}

Diagnostic Task::diagnosticOfException() const {
  if (allowance_.reached()) return diagnosticOf(allowance_.reason(what()));
  try {
    throw;
  } catch (const Unwinding& u) {
    return diagnosticOf(
        Error{u.why().code(), what() + " cannot be done: " + u.why().message(), u.why().hint()});
  } catch (...) {
    const Diagnostic d = gable::diagnosticOfException();
    return diagnosticOf(Error{d.code, what() + ": " + d.message, d.hint});
  }
}

void ToldOnce::add(const DiagnosticList& told) {
  for (const Diagnostic& d : told) {
    if (isAboutMissingFile(d)) paths_.insert(missingName(d));
    if (d.range && (d.code == kCapped || d.code == "bad-argument")) colours_.push_back(*d.range);
  }
}

bool ToldOnce::has(const Diagnostic& made) const {
  if (made.code != kCapped) return paths_.count(missingName(made)) > 0;
  return made.range && std::any_of(colours_.begin(), colours_.end(), [&](const TextRange& told) {
           return isWithin(told, *made.range);
         });
}

DiagnosticList ToldOnce::without(DiagnosticList made) const {
  std::erase_if(made, [&](const Diagnostic& d) {
    return (d.code == kCapped || isAboutMissingFile(d)) && has(d);
  });
  return made;
}

}  // namespace gable
