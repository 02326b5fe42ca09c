// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "engine/package.h"

#include <algorithm>
#include <filesystem>

#include "base/files.h"
#include "dialects/dialect.h"

namespace gable {

namespace {

constexpr uint64_t kLargestPackage = 2ull << 30;

bool isPackage(const std::string& path) {
  const std::string extension = extensionOf(path);
  return (extension == "rpk" || extension == "zip" || extension == "7z") && fileExists(path);
}

std::string stemOf(const std::string& path) {
  const std::string name = fileNameOf(path);
  return name.substr(0, name.rfind('.'));
}

bool isRuleFile(const std::string& path) {
  return extensionOf(path) == "cga" || dialectOfPath(path) != nullptr;
}

}  // namespace

Package::Place Package::placeOf(const std::string& path) {
  for (size_t slash = path.find('/', 1);; slash = path.find('/', slash + 1)) {
    const std::string head = path.substr(0, slash);
    const bool last = slash == std::string::npos;
    if (isPackage(head)) return {head, last ? std::string() : path.substr(slash + 1)};
    if (last) return {};
  }
}

Result<std::shared_ptr<const Package>> Package::open(const std::string& path) {
  const Result<std::string> bytes = readFile(path, kLargestPackage);
  if (!bytes.ok()) return bytes.error();
  Result<ArchiveFiles> files = readArchive(bytes.value(), path);
  if (!files.ok()) return files.error();
  std::error_code error;
  const std::string canonical = std::filesystem::weakly_canonical(path, error).string();
  return std::shared_ptr<const Package>(
      new Package(error ? path : canonical, std::move(files.value())));
}

const std::string* Package::find(std::string_view inner) const {
  const auto at = files_.find(std::string(inner));
  return at == files_.end() ? nullptr : &at->second;
}

std::vector<std::string> Package::list(std::string_view folder) const {
  std::vector<std::string> out;
  const std::string prefix = folder.empty() ? std::string() : std::string(folder) + "/";
  for (const auto& [path, bytes] : files_) {
    if (path.starts_with(prefix)) {
      out.push_back((prefix.empty() ? "/" : "") + path.substr(prefix.empty() ? 0 : folder.size()));
    }
  }
  return out;
}

bool Package::hasFolder(std::string_view inner) const {
  const std::string prefix = std::string(inner) + "/";
  const auto at = files_.lower_bound(prefix);
  return at != files_.end() && at->first.starts_with(prefix);
}

Result<std::string> Package::mainFile() const {
  const std::string name = fileNameOf(path_);
  std::vector<std::string> rules, compiled;
  for (const auto& [path, bytes] : files_) {
    if (isRuleFile(path)) rules.push_back(path);
    if (extensionOf(path) == "cgb") compiled.push_back(path);
  }
  if (rules.empty() && !compiled.empty()) {
    return Error{
        "package-compiled",
        "'" + name + "' holds compiled rules alone (" + compiled[0] + "), which cannot be read",
        "ask for the package with its rule files (.cga), or for the project's folder"};
  }
  if (rules.empty()) {
    return Error{"package-empty", "'" + name + "' holds no rule file",
                 "a package holds rule files (.cga) and their assets"};
  }
  const auto only = [&](auto&& fits) {
    const auto first = std::find_if(rules.begin(), rules.end(), fits);
    const bool single =
        first != rules.end() && std::find_if(first + 1, rules.end(), fits) == rules.end();
    return single ? *first : std::string();
  };
  std::string found = only([](const std::string&) { return true; });
  if (found.empty() && compiled.size() == 1) {
    found = only([&](const std::string& r) { return stemOf(r) == stemOf(compiled[0]); });
  }
  if (found.empty()) {
    found = only([&](const std::string& r) {
      const std::string end = fileNameOf(r) + "\"";
      return std::none_of(rules.begin(), rules.end(), [&](const std::string& other) {
        return files_.at(other).find(end) != std::string::npos;
      });
    });
  }
  if (found.empty()) found = only([&](const std::string& r) { return stemOf(r) == stemOf(name); });
  if (!found.empty()) return found;
  std::string list;
  for (size_t i = 0; i < std::min<size_t>(rules.size(), 5); ++i) {
    list += (i == 0 ? "" : ", ") + rules[i];
  }
  return Error{"package-ambiguous",
               "'" + name + "' holds " + std::to_string(rules.size()) + " rule files: " + list +
                   (rules.size() > 5 ? ", ..." : ""),
               "name one of them: " + name + "/" + rules[0]};
}

}  // namespace gable
