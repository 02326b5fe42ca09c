// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Project: the folder that rules may read from, and the models, pictures and tables in it.
//
// A path that a rule writes is looked up as "/a/b" from the project's root (with or without the
// project folder's own name in front), else in `assets/`, in the root, and beside the rule file.
// Nothing outside of the root is ever read: no "..", no links that lead out; and nothing hidden, by
// a name that begins with a dot.
#pragma once

#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "io/importers/asset.h"
#include "shape/services.h"

namespace gable {

class Project final : public Assets {
 public:
  explicit Project(std::string root);

  /// The project root for a rule file that names none: the nearest folder above that holds a
  /// `rules` or an `assets` folder, else the file's own.
  static std::string rootFor(const std::string& ruleFile);

  const std::string& root() const { return root_; }
  /// The file on disk of a project path; empty when there is none inside of the project.
  std::string locate(std::string_view path, std::string_view fromFile) const;
  /// Where on disk that may be, in the order of looking; whether there is a file is not asked.
  std::vector<std::string> places(std::string_view path, std::string_view fromFile) const;
  /// The canonical path of a file on disk when it is a plain file below the root and not hidden,
  /// else empty.
  std::string inside(const std::string& candidate) const;
  /// All files below the root, as rules write them: without the folder `assets`.
  std::vector<std::string> assets() const;
  /// "rules/town.cga" for a file below the root, else the path itself.
  std::string projectPath(const std::string& file) const;
  /// A model file by its project path, with the textures in it known to texture() from then on.
  Result<Asset> load(std::string_view path);
  /// The bytes of a texture by the path that a material names, those inside of models included.
  Result<std::string> texture(const std::string& path);
  /// Draws those of the paths that name built-in textures, on several threads; texture() has them
  /// then.
  void drawBuiltins(const std::vector<std::string>& paths);

  Ref<AssetModel> model(std::string_view path, std::string_view fromFile, bool zUp,
                        std::string& why) override;
  ImageInfo image(std::string_view path, std::string_view fromFile) override;
  bool exists(std::string_view path, std::string_view fromFile) override;
  std::vector<std::string> search(std::string_view pattern, std::string_view fromFile) override;
  bool text(std::string_view path, std::string_view fromFile, std::string& out) override;
  std::string resolve(std::string_view path, std::string_view fromFile) override;

 private:
  struct ModelEntry {
    Ref<AssetModel> model;
    std::string why;
  };
  Result<Asset> read(const std::string& file, bool zUp) const;
  const std::vector<std::string>& files() const;

  std::string root_;
  std::string rootName_;
  mutable std::mutex mutex_;
  std::map<std::string, ModelEntry> models_;
  std::map<std::string, ImageInfo> images_;
  std::map<std::string, std::string> embedded_;
  /// Built-in textures that have been asked for, as PNG.
  std::map<std::string, std::string> builtins_;
  mutable std::vector<std::string> files_;
  mutable bool listed_ = false;
};

/// Whether a project path matches a pattern: $ is any run of characters but '/', * is any run.
bool matchesPattern(std::string_view pattern, std::string_view path);

}  // namespace gable
