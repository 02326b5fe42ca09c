// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A path is checked twice: as text, and by where the file system says that it leads.

#include "studio/project_files.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <mutex>

#include "base/files.h"
#include "base/hash.h"

namespace gable::studio {

namespace fs = std::filesystem;

namespace {

constexpr uint64_t kLargestFile = 256u << 20;
constexpr const char* kOwnFolder = ".gable";
/// What a studio may write: rules, shapes, models, pictures, tables and what is shared.
constexpr const char* kWritable[] = {"cga",  "grammar", "pg3d", "gbbg", "park", "geojson",
                                     "json", "obj",     "mtl",  "gltf", "glb",  "png",
                                     "jpg",  "jpeg",    "csv",  "txt",  "md"};

Error outside(const std::string& path) {
  return {"path-outside", "'" + path + "' names no file of the project",
          "paths count from the project's folder and stay in it"};
}

bool startsWith(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first ==
         folder.end();
}

Result<uint64_t> writeWithFolders(const std::string& file, const std::string& content) {
  std::error_code error;
  fs::create_directories(fs::path(file).parent_path(), error);
  return writeFile(file, content);
}

Error refusedKind(const std::string& path) {
  return {"kind-refused", "files like '" + path + "' are not written", ""};
}

Error changedMeanwhile(const std::string& path) {
  return {"version-differs", "'" + path + "' has changed meanwhile", ""};
}

// Removes files, and the folders that held nothing else, up to `root`.
void removeWithFolders(const std::vector<std::string>& files, const fs::path& root) {
  std::error_code ignored;
  for (const std::string& file : files) {
    fs::remove(file, ignored);
    fs::path folder = fs::path(file).parent_path();
    while (folder != root && fs::is_empty(folder, ignored) && fs::remove(folder, ignored)) {
      folder = folder.parent_path();
    }
  }
}

// Files are compared and replaced in one step.
std::mutex& writing() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

bool plainPath(const std::string& path) {
  if (path.empty() || path.size() > 1024 || path[0] == '/') return false;
  for (size_t from = 0; from <= path.size();) {
    const size_t to = std::min(path.find('/', from), path.size());
    if (to == from || path[from] == '.') return false;
    from = to + 1;
  }
  return std::none_of(path.begin(), path.end(), [](char c) {
    return static_cast<unsigned char>(c) < 32 || c == '\\' || c == ':';
  });
}

ProjectFiles::ProjectFiles(const std::string& root) {
  std::error_code error;
  const fs::path found = fs::canonical(root.empty() ? "." : root, error);
  if (!error && fs::is_directory(found, error)) root_ = found.string();
}

Result<std::string> ProjectFiles::place(const std::string& path) const {
  if (!plainPath(path)) return outside(path);
  std::error_code error;
  const fs::path real = fs::weakly_canonical(fs::path(root_) / path, error);
  if (error || !startsWith(real, root_)) return outside(path);
  return real.string();
}

Result<std::string> ProjectFiles::own(const char* folder, const std::string& path) const {
  if (!plainPath(path)) return outside(path);
  std::error_code error;
  fs::path base = fs::path(root_) / kOwnFolder;
  if (*folder) base /= folder;
  const fs::path real = fs::weakly_canonical(base / path, error);
  if (error || !startsWith(real, base)) return outside(path);
  return real.string();
}

std::vector<ProjectFile> ProjectFiles::list() const {
  std::vector<ProjectFile> out;
  std::error_code error;
  const auto options = fs::directory_options::skip_permission_denied;
  fs::recursive_directory_iterator at(root_, options, error);
  // Folders of a whole disk are not walked to their end.
  for (size_t seen = 0; !error && at != fs::end(at) && seen < 20 * kMostFiles; ++seen) {
    const fs::path file = at->path();
    const std::string name = file.filename().string();
    if (name[0] == '.' || name == "node_modules") {
      at.disable_recursion_pending();
    } else if (at->is_regular_file(error)) {
      const std::string path = fs::relative(file, root_, error).generic_string();
      const uint64_t bytes = at->file_size(error);
      // libc++ counts in 128 bits.
      const auto time = static_cast<int64_t>(at->last_write_time(error).time_since_epoch().count());
      if (plainPath(path)) {
        out.push_back({path, bytes, std::to_string(bytes) + "-" + std::to_string(time)});
      }
      if (out.size() >= kMostFiles) break;
    }
    at.increment(error);
  }
  std::sort(out.begin(), out.end(),
            [](const ProjectFile& a, const ProjectFile& b) { return a.path < b.path; });
  return out;
}

Result<std::string> ProjectFiles::read(const std::string& path) const {
  const Result<std::string> file = place(path);
  if (!file.ok()) return file.error();
  return readFile(file.value(), kLargestFile);
}

std::string ProjectFiles::versionOf(const std::string& content) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hashBytes(content)));
  return text;
}

std::string ProjectFiles::version(const std::string& path) const {
  const Result<std::string> content = read(path);
  return content.ok() ? versionOf(content.value()) : "none";
}

Result<std::string> ProjectFiles::write(const std::string& path, const std::string& content,
                                        const std::string& expected) {
  const Result<std::string> file = place(path);
  if (!file.ok()) return file.error();
  if (!writes(path)) return refusedKind(path);
  const std::lock_guard lock(writing());
  const Result<std::string> before = read(path);
  const std::string found = before.ok() ? versionOf(before.value()) : "none";
  if (!expected.empty() && expected != found) {
    return changedMeanwhile(path);
  }
  const std::string version = versionOf(content);
  if (found == version) return version;
  if (before.ok()) {
    const Result<std::string> kept = own("previous", path);
    if (!kept.ok()) return kept.error();
    const Result<uint64_t> copied = writeWithFolders(kept.value(), before.value());
    if (!copied.ok()) return copied.error();
  }
  const Result<uint64_t> written = writeWithFolders(file.value(), content);
  if (!written.ok()) return written.error();
  return version;
}

bool ProjectFiles::writes(const std::string& path) {
  const std::string extension = extensionOf(path);
  return std::any_of(std::begin(kWritable), std::end(kWritable),
                     [&](const char* each) { return extension == each; });
}

Result<uint64_t> ProjectFiles::create(
    const std::vector<std::pair<std::string, std::string>>& files) {
  const std::lock_guard lock(writing());
  // Nothing is written before all of it may be.
  std::vector<std::string> places;
  for (const auto& [path, content] : files) {
    const Result<std::string> file = place(path);
    if (!file.ok()) return file.error();
    if (!writes(path)) return refusedKind(path);
    std::error_code error;
    if (fs::exists(file.value(), error)) return changedMeanwhile(path);
    places.push_back(file.value());
  }
  uint64_t bytes = 0;
  std::vector<std::string> made;
  for (size_t i = 0; i < files.size(); ++i) {
    made.push_back(places[i]);
    const Result<uint64_t> written = writeWithFolders(places[i], files[i].second);
    if (!written.ok()) {
      removeWithFolders(made, root_);
      return written.error();
    }
    bytes += written.value();
  }
  return bytes;
}

Result<std::string> ProjectFiles::previous(const std::string& path) const {
  const Result<std::string> file = own("previous", path);
  if (!file.ok()) return file.error();
  return readFile(file.value(), kLargestFile);
}

Result<std::string> ProjectFiles::recovery(const std::string& path) const {
  const Result<std::string> file = own("recovery", path);
  if (!file.ok()) return file.error();
  return readFile(file.value(), kLargestFile);
}

Result<uint64_t> ProjectFiles::keepRecovery(const std::string& path, const std::string& content) {
  const Result<std::string> file = own("recovery", path);
  if (!file.ok()) return file.error();
  const std::lock_guard lock(writing());
  return writeWithFolders(file.value(), content);
}

void ProjectFiles::dropRecovery(const std::string& path) {
  const Result<std::string> file = own("recovery", path);
  std::error_code ignored;
  if (file.ok()) fs::remove(file.value(), ignored);
}

}  // namespace gable::studio
