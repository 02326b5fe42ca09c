// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "language/library.h"

#include <algorithm>

#include "base/allowance.h"
#include "lang/lexer.h"
#include "lang/parser.h"
#include "lang/sema/analyse.h"

namespace gable::language {

namespace {

/// Analyses kept: those of open texts and of what a search over the project has looked at.
constexpr size_t kSnapshotsKept = 48;
constexpr size_t kTreesKept = 1024;
/// Revisions of open texts are told from stamps of files by this bit.
constexpr uint64_t kOpen = uint64_t{1} << 63;

/// Nobody who types waits longer; what is usual takes milliseconds.
constexpr double kMostSeconds = 10;
constexpr uint64_t kMostBytes = uint64_t{1} << 30;

/// Why the work on a text came to no end; none when it did.
template <class Body>
std::optional<Error> endsOf(const std::string& path, Body&& body) {
  Allowance allowance({kMostSeconds, kMostBytes});
  const WorkScope scope(allowance);
  const Status status = guarded([&] {
    body();
    return Status();
  });
  if (status.ok()) return std::nullopt;
  if (allowance.reached()) return allowance.reason("analysing '" + path + "'");
  return Error{status.code(), "'" + path + "' cannot be analysed: " + status.message(),
               status.hint()};
}

Span moved(Span span, uint32_t file) {
  if (span.valid()) span.file = file;
  return span;
}

}  // namespace

// Brings imported files to the analysis, and notes what was read and what was not there.
class Library::Loader final : public lang::FileLoader {
 public:
  Loader(Library& library, Snapshot& snapshot) : library_(library), snapshot_(snapshot) {}

  Result<File> load(const std::string& written, const std::string& importer) override {
    const std::string path = library_.locate(written, importer);
    if (path.empty()) {
      snapshot_.looked.push_back({written, importer, false, false});
      return lang::missingImport(written);
    }
    snapshot_.inputs.push_back({path, library_.state(path)});
    const auto at = library_.open_.find(path);
    if (at != library_.open_.end()) return File{path, at->second.text.content()};
    Result<std::string> text = library_.files_->read(path);
    if (!text.ok()) return text.error();
    return File{path, std::move(text.value())};
  }

  bool exists(const std::string& written, const std::string& importer) override {
    const bool found = library_.hasAsset(written, importer);
    snapshot_.looked.push_back({written, importer, true, found});
    return found;
  }

  std::vector<std::string> assets(const std::string& importer) override {
    return library_.files_->assets(importer);
  }

  std::vector<std::string> filesIn(const std::string& folder,
                                   const std::string& importer) override {
    return library_.files_->filesIn(folder, importer);
  }

  lang::TreeRef parse(const Sources& sources, uint32_t file, Diagnostics& diagnostics) override {
    return std::make_shared<const lang::Tree>(treeOf(sources, file, diagnostics));
  }

 private:
  lang::Tree treeOf(const Sources& sources, uint32_t file, Diagnostics& diagnostics) {
    const std::string& path = sources.path(file);
    if (const Dialect* dialect = dialectOfPath(path)) {
      return dialect->parse({sources, file, library_.catalogue_, this}, diagnostics);
    }
    const std::shared_ptr<const Parsed> known = library_.parsed(path);
    if (!known || known->text.content() != sources.text(file)) {
      return lang::parse(sources, file, diagnostics);
    }
    for (const Diagnostics::Entry& d : known->diagnostics.all()) {
      Diagnostics::Entry copy = d;
      copy.span = moved(copy.span, file);
      if (copy.fix) copy.fix->span = moved(copy.fix->span, file);
      diagnostics.add(std::move(copy));
    }
    return known->tree.copy(file);
  }

  Library& library_;
  Snapshot& snapshot_;
};

Library::Library(const Catalogue& catalogue, std::unique_ptr<Files> files)
    : catalogue_(catalogue), files_(std::move(files)) {}

Library::~Library() = default;

// --- Texts ---

void Library::open(const std::string& path, std::string text) {
  Open& o = open_[path];
  o.text = Text(std::move(text));
  o.revision = ++revision_;
  // What was known of another text under this name is of no use to this one.
  const auto known = find(path);
  if (known != snapshots_.end()) snapshots_.erase(known);
}

bool Library::change(const std::string& path, const std::vector<Change>& changes) {
  const auto at = open_.find(path);
  if (at == open_.end()) return false;
  for (const Change& c : changes) at->second.text.apply(c);
  at->second.revision = ++revision_;
  return true;
}

void Library::close(const std::string& path) { open_.erase(path); }

std::vector<std::string> Library::openTexts() const {
  std::vector<std::string> out;
  for (const auto& [path, text] : open_) out.push_back(path);
  return out;
}

uint64_t Library::state(const std::string& path) {
  const auto at = open_.find(path);
  return at != open_.end() ? at->second.revision | kOpen : files_->stamp(path) & ~kOpen;
}

std::optional<std::string> Library::content(const std::string& path) {
  const auto at = open_.find(path);
  if (at != open_.end()) return at->second.text.content();
  Result<std::string> text = files_->read(path);
  if (!text.ok()) return std::nullopt;
  return std::move(text.value());
}

std::string Library::locate(const std::string& written, const std::string& importer) {
  for (const std::string& place : files_->places(written, importer)) {
    if (open_.count(place) != 0) return place;
    if (files_->readable(place, importer)) return files_->canonical(place);
  }
  return {};
}

bool Library::hasAsset(const std::string& written, const std::string& importer) {
  if (written.starts_with("builtin:")) return files_->readable(written, importer);
  const std::vector<std::string> places = files_->places(written, importer);
  return std::any_of(places.begin(), places.end(),
                     [&](const std::string& place) { return files_->readable(place, importer); });
}

// --- Trees ---

// The entry of a text as it is, with its tokens.
Library::KeptTree* Library::kept(const std::string& path) {
  const uint64_t now = state(path);
  if (now == 0) return nullptr;
  const auto known = trees_.find(path);
  if (known != trees_.end() && known->second.state == now) return &known->second;
  std::optional<std::string> text = content(path);
  if (!text) return nullptr;
  auto out = std::make_shared<Lexed>();
  out->text = Text(std::move(*text));
  out->dialect = dialectOfPath(path);
  if (!out->dialect) out->tokens = lang::tokenize(out->text.content(), 0, out->diagnostics);
  if (trees_.size() >= kTreesKept) trees_.clear();
  KeptTree& entry = trees_[path];
  entry = {now, std::move(out), nullptr};
  return &entry;
}

std::shared_ptr<const Lexed> Library::lexed(const std::string& path) {
  const KeptTree* entry = kept(path);
  return entry ? entry->lexed : nullptr;
}

std::shared_ptr<const Parsed> Library::parsed(const std::string& path) {
  KeptTree* entry = kept(path);
  if (!entry) return nullptr;
  if (entry->parsed) return entry->parsed;
  auto out = std::make_shared<Parsed>();
  static_cast<Lexed&>(*out) = *entry->lexed;
  const std::optional<Error> end = endsOf(path, [&] {
    if (out->dialect) {
      Sources sources;
      const uint32_t file = sources.add(path, out->text.content());
      Snapshot reads;
      Loader loader(*this, reads);
      out->tree = out->dialect->parse({sources, file, catalogue_, &loader}, out->diagnostics);
    } else {
      out->tree = lang::parse(out->text.content(), 0, out->tokens, out->diagnostics);
    }
  });
  if (end) out->diagnostics.error(end->code.c_str(), {0, 0, 0}, end->message, end->hint);
  entry->parsed = out;
  return out;
}

// --- Analyses ---

std::list<Library::Kept>::iterator Library::find(const std::string& path) {
  return std::find_if(snapshots_.begin(), snapshots_.end(),
                      [&](const Kept& k) { return k.path == path; });
}

bool Library::holds(const Snapshot& snapshot) {
  return std::all_of(snapshot.inputs.begin(), snapshot.inputs.end(),
                     [&](const Snapshot::Input& i) { return state(i.path) == i.state; }) &&
         std::all_of(snapshot.looked.begin(), snapshot.looked.end(), [&](const auto& l) {
           return l.found == (l.asset ? hasAsset(l.written, l.importer)
                                      : !locate(l.written, l.importer).empty());
         });
}

std::shared_ptr<const Snapshot> Library::analyse(const std::string& path) {
  std::optional<std::string> text = content(path);
  // What came to no end does not come to one a second time.
  const uint64_t now = state(path);
  if (trouble_ && troublePath_ == path && troubleState_ == now) return nullptr;
  trouble_.reset();
  if (!text) return nullptr;
  troublePath_ = path;
  troubleState_ = now;
  auto out = std::make_shared<Snapshot>();
  out->inputs.push_back({path, state(path)});
  out->dialect = dialectOfPath(path);
  const uint32_t file = out->sources.add(path, std::move(*text));
  Loader loader(*this, *out);
  trouble_ = endsOf(path, [&] {
    lang::AnalysisInput input{loader.parse(out->sources, file, out->diagnostics), path, {}};
    out->program = lang::analyse(std::move(input), catalogue_, out->values, &loader, out->sources,
                                 out->diagnostics);
  });
  if (trouble_) return nullptr;
  out->diagnostics = inWordsOf(out->dialect, file, out->diagnostics, out->sources, catalogue_);
  out->diagnostics.sortByPlace();
  return out;
}

std::shared_ptr<const Snapshot> Library::fresh(const std::string& path) {
  const auto known = find(path);
  if (known != snapshots_.end()) {
    snapshots_.splice(snapshots_.begin(), snapshots_, known);
    if (holds(*known->snapshot)) return known->snapshot;
    snapshots_.erase(known);
  }
  std::shared_ptr<const Snapshot> made = analyse(path);
  if (!made) return nullptr;
  snapshots_.push_front({path, made});
  if (snapshots_.size() > kSnapshotsKept) snapshots_.pop_back();
  return made;
}

std::shared_ptr<const Snapshot> Library::latest(const std::string& path) {
  const auto known = find(path);
  return known != snapshots_.end() ? known->snapshot : fresh(path);
}

}  // namespace gable::language
