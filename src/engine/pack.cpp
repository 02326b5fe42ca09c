// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Rules to a package. Paths of assets may be computed while rules run, so the assets of all
// projects whose rule files are used go along, and files beside assets that lie elsewhere: their
// materials and textures. Where files of several projects are used each has a folder, which makes
// the package a workspace.

#include <algorithm>
#include <set>

#include "base/files.h"
#include "engine/guard.h"
#include "engine/impl.h"

namespace gable {

namespace {

constexpr uint64_t kLargestFile = 1ull << 30;
/// What can be read again, and no more.
constexpr ArchiveLimits kLimits;

// "/ESRI.lib/" of the file of another project, "/" of the own.
std::string projectOf(const std::string& name) {
  return name.starts_with("/") ? name.substr(0, name.find('/', 1) + 1) : "/";
}

class Packer {
 public:
  explicit Packer(const Rules::Impl& rules) : rules_(rules), files_(rules.project->where()) {}

  std::optional<Error> collect() {
    std::set<std::string> projects;
    for (uint32_t i = 0; i < rules_.sources.size(); ++i) {
      const std::string& name = rules_.sources.path(i);
      projects.insert(projectOf(name));
      texts_[name] = std::string(rules_.sources.text(i));
    }
    for (const std::string& p : projects) {
      for (const std::string& asset : files_.filesIn(p + "assets/")) names_.insert(asset);
    }
    for (const AssetUse& use : rules_.assets) {
      if (use.file.empty()) continue;
      projects.insert(projectOf(use.file));
      const std::string name = use.file.starts_with("/") ? use.file : "/" + use.file;
      if (name.starts_with(projectOf(use.file) + "assets/")) continue;
      const std::string folder = folderOf(name);
      for (const std::string& beside : files_.filesIn(folder)) {
        if (folderOf(beside) == folder) names_.insert(beside);
      }
    }
    uint64_t bytes = 0;
    own_ = projects.size() > 1 ? fileNameOf(files_.root()) + "/" : std::string();
    for (auto& [name, text] : texts_) out_[inner(name)] = std::move(text);
    for (const std::string& name : names_) {
      const std::string file = files_.locate(name, "");
      if (out_.count(inner(name)) != 0) continue;
      Result<std::string> read = files_.read(file, kLargestFile);
      if (!read.ok()) return read.error();
      bytes += read.value().size();
      out_[inner(name)] = std::move(read.value());
      if (bytes > kLimits.bytes || out_.size() > kLimits.files) {
        return Error{
            "package-too-large",
            "the assets of '" + files_.root() + "' are too many or too large for a package",
            "if that is not the project's folder, name it with --project"};
      }
    }
    return std::nullopt;
  }

  const ArchiveFiles& files() const { return out_; }

 private:
  // Names of files that begin with a slash are of the own project when they are found there first.
  std::string inner(const std::string& name) const {
    if (!name.starts_with("/")) return own_ + name;
    const bool own = !files_.inside(files_.root() + name).empty();
    return own ? own_ + name.substr(1) : name.substr(1);
  }

  const Rules::Impl& rules_;
  const FileSearch& files_;
  std::map<std::string, std::string> texts_;
  std::set<std::string> names_;
  std::string own_;
  ArchiveFiles out_;
};

}  // namespace

Packed pack(const Rules& rules, const std::string& path, const FileLimits& limits) {
  return guardedResult<Packed>(Task("packing", path, limits), [&] {
    Packed out;
    const auto failed = [&](const Error& e) {
      out.diagnostics.push_back(diagnosticOf(e));
      return out;
    };
    const std::string extension = extensionOf(path);
    if (extension != "rpk" && extension != "zip" && extension != "7z") {
      return failed({"package-kind", "a package is a .rpk, .7z or .zip, and not '" + path + "'",
                     "give it one of these extensions"});
    }
    Packer packer(rules.impl());
    if (const auto why = packer.collect()) return failed(*why);
    const Result<std::string> bytes =
        writeArchive(packer.files(), extension == "zip" ? ArchiveKind::Zip : ArchiveKind::SevenZip);
    if (!bytes.ok()) return failed(bytes.error());
    const Result<uint64_t> written = writeFile(path, bytes.value());
    if (!written.ok()) return failed(written.error());
    out.ok = true;
    out.files = packer.files().size();
    out.bytes = written.value();
    return out;
  });
}

}  // namespace gable
