// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The language service over the engine's catalogue and the files of projects.

#include "gable/language.h"

#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>

#include "base/encoding.h"
#include "base/files.h"
#include "base/hash.h"
#include "builtins/catalogue.h"
#include "dialects/dialect.h"
#include "engine/builtin_files.h"
#include "engine/file_search.h"
#include "language/workspace.h"

namespace gable::language {

namespace fs = std::filesystem;

namespace {

/// A rule file larger than this is none that people write.
constexpr uint64_t kLargestRuleFile = 32u << 20;
/// Listing a folder stops there.
constexpr size_t kMostFiles = 20000;
constexpr size_t kMostRuleFiles = 2000;

bool isRuleFile(const std::string& path) {
  return extensionOf(path) == "cga" || dialectOfPath(path) != nullptr;
}

bool isAsset(const std::string& path) {
  const std::string e = extensionOf(path);
  for (const char* known : {"obj", "glb", "gltf", "fbx", "dae", "png", "jpg", "jpeg", "webp", "tif",
                            "tiff", "csv", "txt", "cgamat", "geojson"}) {
    if (e == known) return true;
  }
  return false;
}

class ProjectFiles final : public Files {
 public:
  /// `within`: the one project, outside of which nothing is read; empty: that of each text.
  ProjectFiles(const std::string& within, const SearchSettings& search) : search_(search) {
    if (!within.empty()) only_ = std::make_unique<FileSearch>(within, search);
  }

  std::string canonical(const std::string& path) override {
    if (path.empty() || path[0] != '/') return path;
    std::error_code error;
    const fs::path c = fs::weakly_canonical(path, error);
    return error ? path : c.string();
  }

  std::vector<std::string> places(const std::string& written,
                                  const std::string& importer) override {
    const FileSearch* project = projectOf(importer);
    if (!project) return {};
    const std::string from = project->projectPath(importer);
    std::vector<std::string> out = project->places(written, from);
    for (std::string& p : project->places("rules/" + written, from)) out.push_back(std::move(p));
    if (search_.byName) out.push_back(project->locate(written, from));
    return out;
  }

  bool readable(const std::string& path, const std::string& importer) override {
    if (path.starts_with("builtin:")) return isBuiltinFile(path);
    const FileSearch* project = projectOf(importer);
    return project && !project->inside(path).empty();
  }

  Result<std::string> read(const std::string& path) override {
    if (stamp(path) == 0) return Error{"file-missing", "there is no file '" + path + "'", ""};
    Result<std::string> text = readFile(path, kLargestRuleFile);
    if (!text.ok()) return text;
    return utf8Of(std::move(text.value()));
  }

  // Plain files alone: what a pipe or a device says is never read.
  uint64_t stamp(const std::string& path) override {
    struct stat s {};
    if (path.empty() || path[0] != '/' || ::stat(path.c_str(), &s) != 0) return 0;
    if (only_ && only_->inside(path).empty()) return 0;
    if (!S_ISREG(s.st_mode) || static_cast<uint64_t>(s.st_size) > kLargestRuleFile) return 0;
    uint64_t h = hashCombine(static_cast<uint64_t>(s.st_mtim.tv_sec),
                             static_cast<uint64_t>(s.st_mtim.tv_nsec));
    h = hashCombine(h, static_cast<uint64_t>(s.st_size));
    h = hashCombine(h, static_cast<uint64_t>(s.st_ino)) >> 1;
    return h == 0 ? 1 : h;
  }

  std::string root(const std::string& path) override {
    const FileSearch* project = projectOf(path);
    return project ? project->root() : std::string();
  }

  std::vector<std::string> ruleFiles(const std::string& folder) override {
    if (only_ && folder != only_->root()) return {};
    const auto known = ruleFiles_.find(folder);
    if (known != ruleFiles_.end()) return known->second;
    std::vector<std::string> out;
    for (const std::string& f : listed(folder)) {
      if (isRuleFile(f) && out.size() < kMostRuleFiles) out.push_back(f);
    }
    return ruleFiles_[folder] = out;
  }

  // As rules write them: without the folder `assets`, which is looked into first.
  std::vector<std::string> assets(const std::string& path) override {
    const std::string top = root(path);
    if (top.empty()) return {};
    std::vector<std::string> out;
    for (const std::string& f : listed(top)) {
      if (!isAsset(f)) continue;
      std::string name = f.substr(top.size() + 1);
      if (name.starts_with("assets/")) name.erase(0, 7);
      out.push_back(std::move(name));
    }
    return out;
  }

  std::vector<std::string> filesIn(const std::string& folder, const std::string& path) override {
    const FileSearch* project = projectOf(path);
    return project ? project->filesIn(folder) : std::vector<std::string>();
  }

  void refresh() override {
    listings_.clear();
    ruleFiles_.clear();
    projects_.clear();
  }

 private:
  const FileSearch* projectOf(const std::string& path) {
    if (path.empty() || path[0] != '/') return nullptr;
    if (only_) return only_->covers(path) ? only_.get() : nullptr;
    const std::string folder = path.substr(0, path.rfind('/'));
    std::unique_ptr<FileSearch>& known = projects_[folder];
    if (!known) known = std::make_unique<FileSearch>(FileSearch::rootFor(path, search_), search_);
    return known.get();
  }

  const std::vector<std::string>& listed(const std::string& folder) {
    const auto [at, fresh] = listings_.try_emplace(folder);
    if (!fresh) return at->second;
    std::error_code error;
    fs::recursive_directory_iterator it(folder, fs::directory_options::skip_permission_denied,
                                        error);
    // Entries that are looked at are bounded too: a home folder may be opened.
    size_t seen = 0;
    for (; !error && it != fs::recursive_directory_iterator(); it.increment(error)) {
      if (++seen > 10 * kMostFiles || at->second.size() >= kMostFiles) break;
      const std::string name = it->path().filename().string();
      std::error_code ignored;
      if (it->is_directory(ignored)) {
        if (name.starts_with(".") || name == "node_modules" || it->is_symlink(ignored)) {
          it.disable_recursion_pending();
        }
        continue;
      }
      const std::string path = it->path().string();
      const bool wanted = isRuleFile(path) || isAsset(path);
      if (wanted && it->is_regular_file(ignored) && !it->is_symlink(ignored)) {
        at->second.push_back(path);
      }
    }
    std::sort(at->second.begin(), at->second.end());
    return at->second;
  }

  SearchSettings search_;
  std::unique_ptr<FileSearch> only_;
  std::map<std::string, std::unique_ptr<FileSearch>> projects_;
  std::map<std::string, std::vector<std::string>> listings_, ruleFiles_;
};

}  // namespace

Workspace::Workspace(std::vector<std::string> folders, const std::string& project,
                     const SearchSettings& search)
    : impl_(std::make_unique<Impl>(builtinCatalogue(),
                                   std::make_unique<ProjectFiles>(project, search),
                                   std::vector<std::string>())) {
  setFolders(std::move(folders));
}

std::vector<Entry> search(const std::string& words) { return searchIn(builtinCatalogue(), words); }

}  // namespace gable::language
