// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Project: what derivations and writers read of a project's files, each kept as it was read first.
// Which file a path means is settled by FileSearch.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "engine/drawn_textures.h"
#include "engine/file_search.h"
#include "io/importers/asset.h"
#include "shape/services.h"

namespace gable {

/// The bytes of pictures, by name.
using TextureBytes = std::map<std::string, std::shared_ptr<const std::string>>;

class Project final : public Assets {
 public:
  explicit Project(const std::string& root, const SearchSettings& settings = {},
                   std::shared_ptr<const Package> package = nullptr);

  const FileSearch& where() const { return where_; }
  const std::string& root() const { return where_.root(); }
  std::string locate(std::string_view path, std::string_view fromFile) const {
    return where_.locate(path, fromFile);
  }
  std::string projectPath(const std::string& file) const { return where_.projectPath(file); }
  /// All files below the root, as rules write them: without the folder `assets`.
  std::vector<std::string> assets() const;
  /// The files of the project that a folder such as "/gable/" names, with that folder before them.
  std::vector<std::string> filesIn(const std::string& folder) const;
  /// A model file by its project path, with the textures in it known to texture() from then on.
  Result<Asset> load(std::string_view path);
  /// The bytes of a texture by the path that a material names, those inside of models included.
  Result<std::string> texture(const std::string& path);
  /// Pictures that texture() is to know by these names; their bytes are shared.
  void addTextures(const TextureBytes& textures);
  /// Draws those of the paths that name built-in textures, on several threads; texture() has them
  /// then.
  void drawBuiltins(const std::vector<std::string>& paths);
  /// The picture of a texture; null where there is none that can be read. Those of files are kept
  /// by their bytes, up to half a gigabyte; built-in ones are as they were drawn, without the
  /// losses of a file.
  TexturePicture picture(const std::string& path);
  /// Draws those of the paths that name built-in textures, on several threads; picture() has them
  /// then.
  void drawPictures(const std::vector<std::string>& paths) { pictures_.draw(paths, 0); }

  Ref<AssetModel> model(std::string_view path, std::string_view fromFile, bool zUp,
                        std::string& why) override;
  ImageInfo image(std::string_view path, std::string_view fromFile) override;
  Result<Material> material(std::string_view path, std::string_view fromFile) override;
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
  Result<Material> readMaterial(const std::string& file) const;
  void embed(std::map<std::string, std::string>& textures);
  TexturePicture decoded(const std::string& bytes);

  FileSearch where_;
  mutable std::mutex mutex_;
  std::map<std::string, ModelEntry> models_;
  std::map<std::string, ImageInfo> images_;
  std::map<std::string, Result<Material>> materials_;
  TextureBytes embedded_;
  /// Built-in textures that have been asked for, as files.
  std::map<std::string, std::string> builtins_;
  DrawnTextures pictures_;
  /// Pictures of files by the hash and the number of their bytes.
  std::map<std::pair<uint64_t, size_t>, TexturePicture> decoded_;
  uint64_t decodedBytes_ = 0;
};

}  // namespace gable
