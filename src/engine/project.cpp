// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "engine/project.h"

#include <algorithm>
#include <filesystem>

#include "base/allowance.h"
#include "base/files.h"
#include "base/parallel.h"
#include "io/image/image.h"
#include "io/image/patterns.h"
#include "io/importers/asset.h"
#include "material/builtin_textures.h"

namespace gable {

namespace fs = std::filesystem;

namespace {

/// A project of more files than this is no project; listing stops there.
constexpr size_t kMostFiles = 200000;
constexpr uint64_t kLargestAsset = 1ull << 30;

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

/// Beyond the last for another path.
size_t numberOfBuiltin(std::string_view path) {
  if (path.substr(0, kBuiltinTexturePrefix.size()) != kBuiltinTexturePrefix) {
    return kBuiltinTextures.size();
  }
  size_t i = 0;
  while (i < kBuiltinTextures.size() && path != builtinTexturePath(i)) ++i;
  return i;
}

std::string canonical(const fs::path& p) {
  std::error_code error;
  const fs::path c = fs::weakly_canonical(p, error);
  return error ? std::string() : c.string();
}

}  // namespace

Project::Project(std::string root) : root_(canonical(root.empty() ? "." : root)) {
  rootName_ = fs::path(root_).filename().string();
}

std::string Project::rootFor(const std::string& ruleFile) {
  const fs::path folder = fs::path(canonical(ruleFile)).parent_path();
  std::error_code error;
  for (fs::path at = folder; at.has_relative_path(); at = at.parent_path()) {
    if (fs::is_directory(at / "rules", error) || fs::is_directory(at / "assets", error)) {
      return at.string();
    }
  }
  return folder.string();
}

std::string Project::inside(const std::string& candidate) const {
  if (!fileExists(candidate)) return {};
  const std::string real = canonical(candidate);
  const bool below = real.size() > root_.size() && real.compare(0, root_.size(), root_) == 0 &&
                     (root_ == "/" || real[root_.size()] == '/');
  return below && !isHidden(std::string_view(real).substr(root_.size())) ? real : std::string();
}

std::vector<std::string> Project::places(std::string_view path, std::string_view fromFile) const {
  if (path.empty() || climbs(path) || path.find('\0') != std::string_view::npos) return {};
  std::string clean(path);
  std::replace(clean.begin(), clean.end(), '\\', '/');
  std::vector<std::string> candidates;
  if (clean[0] == '/') {
    candidates.push_back(root_ + clean);
    const size_t second = clean.find('/', 1);
    if (second != std::string::npos && clean.substr(1, second - 1) == rootName_) {
      candidates.push_back(root_ + clean.substr(second));
    }
  } else {
    candidates.push_back(root_ + "/assets/" + clean);
    candidates.push_back(root_ + "/" + clean);
    const std::string folder = folderOf(std::string(fromFile));
    if (!folder.empty()) candidates.push_back(root_ + "/" + folder + "/" + clean);
  }
  return candidates;
}

std::string Project::locate(std::string_view path, std::string_view fromFile) const {
  for (const std::string& c : places(path, fromFile)) {
    std::string found = inside(c);
    if (!found.empty()) return found;
  }
  return {};
}

std::string Project::projectPath(const std::string& file) const {
  const std::string real = canonical(file);
  if (real.compare(0, root_.size(), root_) == 0 && real.size() > root_.size()) {
    return real.substr(root_.size() + (root_ == "/" ? 0 : 1));
  }
  return file;
}

// Files that the asset names are read through the project, so that none lies outside.
Result<Asset> Project::read(const std::string& file, bool zUp) const {
  // Whichever shape asks first, the derivation that does so takes as many steps.
  const UncountedWork uncounted;
  Result<std::string> bytes = readFile(file, kLargestAsset);
  if (!bytes.ok()) return bytes.error();
  AssetOptions options;
  options.path = projectPath(file);
  options.zUp = zUp;
  options.readFile = [this](const std::string& path) -> Result<std::string> {
    const std::string found = locate("/" + path, "");
    if (found.empty()) return Error{"file-unreadable", "there is no file '" + path + "'", ""};
    return readFile(found, kLargestAsset);
  };
  return readAsset(bytes.value(), options);
}

Result<Asset> Project::load(std::string_view path) {
  const std::string file = locate(path, "");
  if (file.empty()) {
    return Error{"file-unreadable", "there is no file '" + std::string(path) + "'", ""};
  }
  Result<Asset> asset = read(file, false);
  std::lock_guard lock(mutex_);
  if (asset.ok()) embedded_.insert(asset->textures.begin(), asset->textures.end());
  return asset;
}

void Project::drawBuiltins(const std::vector<std::string>& paths) {
  std::vector<std::pair<std::string, std::string>> made;
  {
    std::lock_guard lock(mutex_);
    for (const std::string& path : paths) {
      const bool wanted = numberOfBuiltin(path) < kBuiltinTextures.size();
      if (wanted && builtins_.count(path) == 0) made.emplace_back(path, "");
    }
  }
  std::sort(made.begin(), made.end());
  made.erase(std::unique(made.begin(), made.end()), made.end());
  // Noise does not get smaller at higher levels, only slower.
  constexpr int kLevel = 3;
  parallelFor(made.size(), 0, [&](size_t i, unsigned) {
    made[i].second = encodePng(drawPattern(numberOfBuiltin(made[i].first)), 3, kLevel).value();
  });
  std::lock_guard lock(mutex_);
  for (auto& [path, bytes] : made) builtins_[path] = std::move(bytes);
}

Result<std::string> Project::texture(const std::string& path) {
  {
    std::lock_guard lock(mutex_);
    const auto at = embedded_.find(path);
    if (at != embedded_.end()) return at->second;
  }
  if (numberOfBuiltin(path) < kBuiltinTextures.size()) {
    drawBuiltins({path});
    std::lock_guard lock(mutex_);
    return builtins_[path];
  }
  const std::string file = locate(path, "");
  if (file.empty()) {
    return Error{"texture-not-found", "there is no picture '" + path + "' in the project",
                 "paths count from the project's folder or its assets folder"};
  }
  return readFile(file, kLargestAsset);
}

Ref<AssetModel> Project::model(std::string_view path, std::string_view fromFile, bool zUp,
                               std::string& why) {
  const std::string file = locate(path, fromFile);
  if (file.empty()) {
    why = "there is no file '" + std::string(path) + "' in the project";
    return {};
  }
  std::lock_guard lock(mutex_);
  const std::string key = file + (zUp ? "|z" : "|y");
  auto at = models_.find(key);
  if (at == models_.end()) {
    // Known only when it is read to the end: a limit may stop it.
    Result<Asset> asset = read(file, zUp);
    at = models_.emplace(key, ModelEntry{}).first;
    if (asset.ok()) {
      auto* m = new AssetModel;
      m->mesh = asset->mesh;
      m->materials = asset->materials;
      m->bounds = asset->bounds;
      embedded_.insert(asset->textures.begin(), asset->textures.end());
      at->second.model = Ref<AssetModel>(m);
    } else {
      at->second.why = asset.error().message;
    }
  }
  why = at->second.why;
  return at->second.model;
}

ImageInfo Project::image(std::string_view path, std::string_view fromFile) {
  const std::string file = locate(path, fromFile);
  if (file.empty()) return {};
  std::lock_guard lock(mutex_);
  const auto [at, fresh] = images_.try_emplace(file);
  if (fresh) {
    const auto bytes = readFile(file, kLargestAsset);
    if (!bytes.ok()) return at->second;
    const auto info = readImageHeader(bytes.value());
    if (info.ok())
      at->second = {true, info.value().width, info.value().height, info.value().hasAlpha};
  }
  return at->second;
}

bool Project::exists(std::string_view path, std::string_view fromFile) {
  return !locate(path, fromFile).empty();
}

const std::vector<std::string>& Project::files() const {
  if (listed_) return files_;
  listed_ = true;
  std::error_code error;
  fs::recursive_directory_iterator it(root_, fs::directory_options::skip_permission_denied, error);
  for (; !error && it != fs::recursive_directory_iterator(); it.increment(error)) {
    if (files_.size() >= kMostFiles) break;
    if (isHidden(it->path().filename().string())) {
      it.disable_recursion_pending();
      continue;
    }
    if (it->is_regular_file(error) && !it->is_symlink(error)) {
      files_.push_back(it->path().string().substr(root_.size()));
    }
  }
  std::sort(files_.begin(), files_.end());
  return files_;
}

std::vector<std::string> Project::assets() const {
  constexpr std::string_view kFolder = "/assets/";
  std::lock_guard lock(mutex_);
  std::vector<std::string> out;
  for (const std::string& f : files()) {
    out.push_back(f.substr(f.starts_with(kFolder) ? kFolder.size() : 1));
  }
  return out;
}

// Relative patterns are matched below assets/ and below the root; results are paths from the root.
std::vector<std::string> Project::search(std::string_view pattern, std::string_view) {
  std::vector<std::string> patterns;
  if (!pattern.empty() && pattern[0] == '/') {
    patterns.emplace_back(pattern);
    const std::string prefix = "/" + rootName_ + "/";
    if (pattern.compare(0, prefix.size(), prefix) == 0) {
      patterns.emplace_back(pattern.substr(prefix.size() - 1));
    }
  } else {
    patterns.push_back("/assets/" + std::string(pattern));
    patterns.push_back("/" + std::string(pattern));
  }
  std::lock_guard lock(mutex_);
  std::vector<std::string> out;
  for (const std::string& file : files()) {
    const auto fits = [&](const std::string& p) { return matchesPattern(p, file); };
    if (std::any_of(patterns.begin(), patterns.end(), fits)) out.push_back(file);
  }
  return out;
}

bool Project::text(std::string_view path, std::string_view fromFile, std::string& out) {
  const std::string file = locate(path, fromFile);
  if (file.empty()) return false;
  Result<std::string> content = readFile(file, kMaxTextLength);
  if (!content.ok()) return false;
  out = std::move(content.value());
  return true;
}

std::string Project::resolve(std::string_view path, std::string_view fromFile) {
  const std::string file = locate(path, fromFile);
  return file.empty() ? std::string(path) : file.substr(root_.size());
}

// Keeps the set of places in the path that the pattern so far can end at: O(pattern x path).
bool matchesPattern(std::string_view pattern, std::string_view path) {
  std::vector<char> reachable(path.size() + 1, 0), next;
  reachable[0] = 1;
  for (char c : pattern) {
    next.assign(path.size() + 1, 0);
    if (c == '*' || c == '$') {
      bool running = false;
      for (size_t i = 0; i <= path.size(); ++i) {
        running = running || reachable[i];
        next[i] = running;
        if (c == '$' && i < path.size() && path[i] == '/') running = false;
      }
    } else {
      for (size_t i = 0; i < path.size(); ++i) next[i + 1] = reachable[i] && path[i] == c;
    }
    reachable.swap(next);
  }
  return reachable[path.size()];
}

}  // namespace gable
