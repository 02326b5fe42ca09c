// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "engine/file_search.h"

#include <algorithm>
#include <filesystem>

#include "base/files.h"
#include "base/text.h"
#include "shape/file_query.h"

namespace gable {

namespace fs = std::filesystem;

namespace {

/// A project of more files than this is no project; listing stops there.
constexpr size_t kMostFiles = 200000;
constexpr const char* kBundledName = "gable";

bool climbs(std::string_view path) {
  size_t from = 0;
  while (from <= path.size()) {
    const size_t to = std::min(path.find_first_of("/\\", from), path.size());
    if (path.substr(from, to - from) == "..") return true;
    from = to + 1;
  }
  return false;
}

// Below a root: what begins with a dot is a tool's own (.git, .env, .gable), and no asset.
bool isHidden(std::string_view path) {
  for (size_t i = 0; i < path.size(); ++i) {
    if (path[i] == '.' && (i == 0 || path[i - 1] == '/')) return true;
  }
  return false;
}

std::string canonical(const fs::path& p) {
  std::error_code error;
  const fs::path c = fs::weakly_canonical(p, error);
  return error ? std::string() : c.string();
}

bool isFolder(const std::string& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

/// What follows the folder in the path of a file below it, with its slash; else empty.
std::string_view below(std::string_view folder, std::string_view path) {
  if (folder.empty() || path.size() <= folder.size() || !path.starts_with(folder)) return {};
  if (folder == "/") return path;
  return path[folder.size()] == '/' ? path.substr(folder.size()) : std::string_view();
}

/// "Name" of "/Name/rest"; empty for a path of another form.
std::string_view firstFolder(std::string_view path) {
  if (path.empty() || path[0] != '/') return {};
  const size_t second = path.find('/', 1);
  return second == std::string_view::npos ? std::string_view() : path.substr(1, second - 1);
}

struct NamedFolder {
  std::string name;
  std::string folder;
};

// "NAME=FOLDER", unless there is a folder of that whole name.
NamedFolder libraryOf(const std::string& written) {
  const size_t equals = written.find('=');
  const bool named = equals != std::string::npos && equals > 0 && !isFolder(written);
  if (named) return {written.substr(0, equals), written.substr(equals + 1)};
  return {fileNameOf(canonical(written)), written};
}

/// How many names, from the last one on, two paths have in common; letters of another case count
/// less than the same.
size_t alike(std::string_view a, std::string_view b) {
  size_t points = 0;
  for (;;) {
    const size_t i = a.rfind('/'), j = b.rfind('/');
    const std::string_view x = a.substr(i + 1), y = b.substr(j + 1);
    if (!equalButForCase(x, y)) return points;
    points += x == y ? 3 : 2;
    if (i == std::string_view::npos || j == std::string_view::npos) return points;
    a = a.substr(0, i), b = b.substr(0, j);
  }
}

}  // namespace

FileSearch::FileSearch(const std::string& root, const SearchSettings& settings,
                       std::shared_ptr<const Package> package)
    : root_(canonical(root.empty() ? "." : root)),
      settings_(settings),
      package_(std::move(package)) {
  rootName_ = fileNameOf(root_);
  if (settings.workspace) workspace_ = canonical(*settings.workspace);
  if (package_ && !settings.workspace) workspace_ = package_->path();
  rootPrefix_ = below(workspace_, root_);
  for (const std::string& written : settings.libraries) {
    const NamedFolder library = libraryOf(written);
    libraries_.push_back({library.name, canonical(library.folder)});
  }
  if (settings.bundled) bundled_ = {kBundledName, canonical(*settings.bundled)};
}

std::string projectFolder(const std::string& ruleFile, const SearchSettings& settings) {
  return FileSearch::rootFor(ruleFile, settings);
}

std::string FileSearch::rootFor(const std::string& ruleFile, const SearchSettings& settings) {
  const std::string file = canonical(ruleFile);
  if (settings.workspace) {
    const std::string workspace = canonical(*settings.workspace);
    const std::string_view project = firstFolder(below(workspace, file));
    if (!project.empty()) return workspace + (workspace == "/" ? "" : "/") + std::string(project);
  }
  const fs::path folder = fs::path(file).parent_path();
  for (fs::path at = folder; at.has_relative_path(); at = at.parent_path()) {
    if (isFolder(at / "rules") || isFolder(at / "assets")) return at.string();
  }
  return folder.string();
}

std::string FileSearch::rootFor(const Package& package, const std::string& inner) {
  for (std::string at = folderOf(inner); !at.empty();) {
    at.pop_back();
    if (package.hasFolder(at + "/rules") || package.hasFolder(at + "/assets")) return at;
    at = folderOf(at);
  }
  const bool atTop = package.hasFolder("rules") || package.hasFolder("assets");
  const std::string folder = folderOf(inner);
  return atTop || folder.empty() ? std::string() : folder.substr(0, folder.size() - 1);
}

std::optional<Error> FileSearch::missingFolder(const SearchSettings& settings) {
  const auto missing = [](const std::string& folder, const char* what, const char* hint) {
    return Error{"folder-missing", std::string("there is no ") + what + " '" + folder + "'", hint};
  };
  if (settings.workspace && !isFolder(*settings.workspace)) {
    return missing(*settings.workspace, "workspace",
                   "name the folder that holds the projects, one folder each");
  }
  for (const std::string& written : settings.libraries) {
    const NamedFolder library = libraryOf(written);
    if (!isFolder(library.folder)) {
      return missing(library.folder, "library", "name a folder of rules, or NAME=FOLDER");
    }
  }
  return std::nullopt;
}

bool FileSearch::covers(const std::string& path) const {
  return !below(root_, path).empty() || !below(workspace_, path).empty() ||
         std::any_of(libraries_.begin(), libraries_.end(),
                     [&](const Library& l) { return !below(l.path, path).empty(); }) ||
         (bundled_ && !below(bundled_->path, path).empty());
}

// The path within the package; empty for what lies elsewhere.
std::string_view FileSearch::inPackage(std::string_view path) const {
  const std::string_view rest = package_ ? below(package_->path(), path) : std::string_view();
  return rest.empty() ? rest : rest.substr(1);
}

Result<std::string> FileSearch::read(const std::string& file, uint64_t maxBytes) const {
  const std::string_view inner = inPackage(file);
  if (inner.empty()) return readFile(file, maxBytes);
  const std::string* bytes = package_->find(inner);
  if (!bytes) return Error{"file-missing", "there is no file '" + file + "'", ""};
  if (bytes->size() <= maxBytes) return *bytes;
  return Error{"file-too-large", "'" + file + "' is larger than the limit", "split it"};
}

std::string FileSearch::inside(const std::string& candidate) const {
  if (const std::string_view inner = inPackage(candidate); !inner.empty()) {
    // Where a path on disk becomes canonical, one of a package becomes plain.
    const std::string plain = fs::path(inner).lexically_normal().string();
    const bool there = !isHidden(plain) && package_->find(plain);
    return there ? package_->path() + "/" + plain : std::string();
  }
  if (!fileExists(candidate)) return {};
  const std::string real = canonical(candidate);
  const auto open = [&](const std::string& folder) {
    const std::string_view rest = below(folder, real);
    return !rest.empty() && !isHidden(rest);
  };
  const bool allowed = open(root_) || open(workspace_) ||
                       std::any_of(libraries_.begin(), libraries_.end(),
                                   [&](const Library& l) { return open(l.path); }) ||
                       (bundled_ && open(bundled_->path));
  return allowed ? real : std::string();
}

const FileSearch::Library* FileSearch::libraryNamed(std::string_view name) const {
  const auto at = std::find_if(libraries_.begin(), libraries_.end(),
                               [&](const Library& l) { return l.name == name; });
  if (at != libraries_.end()) return &*at;
  return bundled_ && bundled_->name == name ? &*bundled_ : nullptr;
}

// The root of the project that a file lies in, by what the file is called.
std::string FileSearch::baseOf(std::string_view fromFile) const {
  const std::string_view name = firstFolder(fromFile);
  if (name.empty()) return root_;
  if (const Library* library = libraryNamed(name)) return library->path;
  if (workspace_.empty()) return root_;
  const std::string other = workspace_ + "/" + std::string(name);
  const std::string_view inner = inPackage(other);
  const bool there = inner.empty() ? isFolder(other) : package_->hasFolder(inner);
  return there ? other : root_;
}

std::vector<std::string> FileSearch::places(std::string_view path,
                                            std::string_view fromFile) const {
  if (path.empty() || climbs(path) || path.find('\0') != std::string_view::npos) return {};
  std::string clean(path);
  std::replace(clean.begin(), clean.end(), '\\', '/');
  const std::string base = baseOf(fromFile);
  std::vector<std::string> candidates;
  if (clean[0] == '/') {
    candidates.push_back(root_ + clean);
    const std::string name(firstFolder(clean));
    const std::string rest = name.empty() ? std::string() : clean.substr(name.size() + 1);
    if (!name.empty() && name == rootName_) candidates.push_back(root_ + rest);
    if (const Library* library = libraryNamed(name)) candidates.push_back(library->path + rest);
    if (!workspace_.empty()) candidates.push_back(workspace_ + clean);
    if (base != root_) candidates.push_back(base + clean);
    for (const Library& l : libraries_) candidates.push_back(l.path + clean);
    return candidates;
  }
  candidates.push_back(base + "/assets/" + clean);
  candidates.push_back(base + "/" + clean);
  const std::string folder = folderOf(std::string(fromFile));
  const std::string_view inBase =
      base == root_ ? std::string_view(folder)
                    : std::string_view(folder).substr(firstFolder(fromFile).size() + 2);
  if (!inBase.empty()) candidates.push_back(base + "/" + std::string(inBase) + "/" + clean);
  for (const Library& l : libraries_) {
    for (const char* within : {"/assets/", "/rules/", "/"}) {
      candidates.push_back(l.path + within + clean);
    }
  }
  return candidates;
}

std::string FileSearch::locate(std::string_view path, std::string_view fromFile) const {
  for (const std::string& c : places(path, fromFile)) {
    std::string found = inside(c);
    if (!found.empty()) return found;
  }
  return settings_.byName && !climbs(path) ? byName(path) : std::string();
}

std::string FileSearch::byName(std::string_view path) const {
  std::string clean(path);
  std::replace(clean.begin(), clean.end(), '\\', '/');
  std::string best;
  size_t most = 0;
  const auto look = [&](const std::string& folder) {
    for (const std::string& file : listed(folder)) {
      const size_t points = alike(file, clean);
      if (points > most) most = points, best = folder + file;
    }
  };
  look(root_);
  for (const Library& l : libraries_) look(l.path);
  if (!workspace_.empty()) look(workspace_);
  return best.empty() ? best : inside(best);
}

std::string FileSearch::projectPath(const std::string& file) const {
  const std::string real = canonical(file);
  if (const std::string_view rest = below(root_, real); !rest.empty()) {
    return std::string(rest.substr(1));
  }
  for (const Library& l : libraries_) {
    const std::string_view rest = below(l.path, real);
    if (!rest.empty()) return "/" + l.name + std::string(rest);
  }
  if (const std::string_view rest = below(workspace_, real); !rest.empty()) {
    return std::string(rest);
  }
  const std::string_view rest = bundled_ ? below(bundled_->path, real) : std::string_view();
  if (!rest.empty()) return "/" + bundled_->name + std::string(rest);
  return file;
}

std::vector<std::string> FileSearch::filesIn(const std::string& folder) const {
  const std::string base = baseOf(folder);
  const std::string prefix = base == root_ ? "" : "/" + std::string(firstFolder(folder));
  std::vector<std::string> out;
  for (const std::string& file : listed(base)) {
    if ((prefix + file).starts_with(folder)) out.push_back(prefix + file);
  }
  return out;
}

const std::vector<std::string>& FileSearch::listed(const std::string& folder) const {
  const std::lock_guard lock(mutex_);
  const auto [at, fresh] = listings_.try_emplace(folder);
  std::vector<std::string>& files = at->second;
  if (!fresh) return files;
  if (package_ && (folder == package_->path() || !inPackage(folder).empty())) {
    for (std::string& file : package_->list(inPackage(folder))) {
      if (!isHidden(file)) files.push_back(std::move(file));
    }
    return files;
  }
  std::error_code error;
  fs::recursive_directory_iterator it(folder, fs::directory_options::skip_permission_denied, error);
  for (; !error && it != fs::recursive_directory_iterator(); it.increment(error)) {
    if (files.size() >= kMostFiles) break;
    if (isHidden(it->path().filename().string())) {
      it.disable_recursion_pending();
      continue;
    }
    if (it->is_regular_file(error) && !it->is_symlink(error)) {
      files.emplace_back(below(folder, it->path().string()));
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> FileSearch::search(std::string_view query,
                                            std::string_view fromFile) const {
  Result<FileQuery> parsed = FileQuery::parse(query);
  if (!parsed.ok()) return {};
  std::vector<std::string> out;
  const auto look = [&](const std::string& folder, const std::string& prefix,
                        const std::string& name, bool own) {
    for (const std::string& file : listed(folder)) {
      if (parsed->matches(file, name, own)) out.push_back(prefix + file);
    }
  };
  const std::string base = baseOf(fromFile);
  const std::string name(base == root_ ? rootName_ : firstFolder(fromFile));
  look(base, base == root_ ? rootPrefix_ : "/" + name, name, true);
  if (parsed->leavesTheProject()) {
    if (base != root_) look(root_, rootPrefix_, rootName_, false);
    for (const Library& l : libraries_) {
      if (l.path != base) look(l.path, "/" + l.name, l.name, false);
    }
    if (!workspace_.empty()) {
      for (const std::string& file : listed(workspace_)) {
        const std::string_view project = firstFolder(file);
        const std::string folder = workspace_ + "/" + std::string(project);
        if (project.empty() || folder == base || folder == root_) continue;
        if (parsed->matches(file.substr(project.size() + 1), project, false)) out.push_back(file);
      }
    }
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace gable
