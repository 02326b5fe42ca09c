// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "engine/project.h"

#include <algorithm>
#include <array>

#include "base/allowance.h"
#include "base/files.h"
#include "base/parallel_work.h"
#include "io/image/image.h"
#include "io/image/leaf_pictures.h"
#include "io/image/patterns.h"
#include "io/image/surface.h"
#include "io/importers/asset.h"
#include "io/importers/mtl_file.h"
#include "material/builtin_textures.h"
#include "material/library.h"

namespace gable {

namespace {

constexpr uint64_t kLargestAsset = 1ull << 30;

/// Beyond the last for another path.
size_t numberOfBuiltin(std::string_view path) {
  if (path.substr(0, kBuiltinTexturePrefix.size()) != kBuiltinTexturePrefix) {
    return kBuiltinTextures.size();
  }
  size_t i = 0;
  while (i < kBuiltinTextures.size() && path != builtinTexturePath(i)) ++i;
  return i;
}

/// A texture or a picture of leaves that is drawn when it is asked for.
bool isDrawn(std::string_view path) {
  return numberOfBuiltin(path) < kBuiltinTextures.size() ||
         builtinLeaves(path) < kBuiltinLeaves.size();
}

Metadatum metadatumOf(const std::string& key, const PlainValue& v) {
  const ValueType type = v.kind == PlainValue::Kind::Number ? ValueType::Float
                         : v.kind == PlainValue::Kind::Bool ? ValueType::Bool
                                                            : ValueType::String;
  return {key, type, v.number, v.text};
}

}  // namespace

Project::Project(const std::string& root, const SearchSettings& settings,
                 std::shared_ptr<const Package> package)
    : where_(root, settings, std::move(package)) {}

// Files that the asset names are read through the project, so that none lies outside.
Result<Asset> Project::read(const std::string& file, bool zUp) const {
  Result<std::string> bytes = where_.read(file, kLargestAsset);
  if (!bytes.ok()) return bytes.error();
  AssetOptions options;
  options.path = projectPath(file);
  options.zUp = zUp;
  options.readFile = [this](const std::string& path) -> Result<std::string> {
    const std::string found = locate("/" + path, "");
    if (found.empty()) return Error{"file-unreadable", "there is no file '" + path + "'", ""};
    return where_.read(found, kLargestAsset);
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
  if (asset.ok()) embed(asset->textures);
  return asset;
}

// Those of a model, which are its own from then on. With the lock held.
void Project::embed(std::map<std::string, std::string>& textures) {
  for (auto& [name, bytes] : textures) {
    embedded_.try_emplace(name, std::make_shared<const std::string>(std::move(bytes)));
  }
}

void Project::addTextures(const TextureBytes& textures) {
  std::lock_guard lock(mutex_);
  for (const auto& [name, bytes] : textures) embedded_[name] = bytes;
}

// The pictures of a material come from one field, so all are drawn once one is asked for.
void Project::drawMaterials(const std::vector<std::string>& paths) {
  std::vector<const LibraryMaterial*> wanted;
  {
    std::lock_guard lock(mutex_);
    for (const std::string& path : paths) {
      const LibraryMaterial* m = materialPictureOf(path).material;
      if (m && builtins_.count(path) == 0) wanted.push_back(m);
    }
  }
  // They lie in one table.
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  constexpr std::array kPictures{MaterialPicture::Color, MaterialPicture::Normal,
                                 MaterialPicture::Surface};
  std::vector<std::array<std::string, kPictures.size()>> made(wanted.size());
  parallelWork(wanted.size(), 0, [&](size_t i, unsigned) {
    const SurfaceField field = drawSurface(*wanted[i]);
    for (size_t k = 0; k < kPictures.size(); ++k) {
      made[i][k] = encodeMaterialPicture(field, *wanted[i], kPictures[k]).value();
    }
  });
  std::lock_guard lock(mutex_);
  for (size_t i = 0; i < wanted.size(); ++i) {
    for (size_t k = 0; k < kPictures.size(); ++k) {
      builtins_[materialPicturePath(*wanted[i], kPictures[k])] = std::move(made[i][k]);
    }
  }
}

void Project::drawBuiltins(const std::vector<std::string>& paths) {
  // Drawn once and kept, whoever asks first.
  const UncountedWork uncounted;
  drawMaterials(paths);
  std::vector<std::pair<std::string, std::string>> made;
  {
    std::lock_guard lock(mutex_);
    for (const std::string& path : paths) {
      const bool wanted = isDrawn(path);
      if (wanted && builtins_.count(path) == 0) made.emplace_back(path, "");
    }
  }
  std::sort(made.begin(), made.end());
  made.erase(std::unique(made.begin(), made.end()), made.end());
  // Noise does not get smaller at higher levels, only slower.
  constexpr int kLevel = 3, kLeavesLevel = 6;
  parallelWork(made.size(), 0, [&](size_t i, unsigned) {
    const std::string& path = made[i].first;
    const size_t leaves = builtinLeaves(path);
    made[i].second = leaves < kBuiltinLeaves.size()
                         ? encodePng(drawLeaves(leaves), 4, kLeavesLevel).value()
                         : encodePng(drawPattern(numberOfBuiltin(path)), 3, kLevel).value();
  });
  std::lock_guard lock(mutex_);
  for (auto& [path, bytes] : made) builtins_[path] = std::move(bytes);
}

Result<std::string> Project::texture(const std::string& path) {
  {
    std::lock_guard lock(mutex_);
    const auto at = embedded_.find(path);
    if (at != embedded_.end()) return *at->second;
  }
  if (isDrawn(path) || materialPictureOf(path).material) {
    drawBuiltins({path});
    std::lock_guard lock(mutex_);
    return builtins_[path];
  }
  const std::string file = locate(path, "");
  if (file.empty()) {
    return Error{"texture-not-found", "there is no picture '" + path + "' in the project",
                 "paths count from the project's folder or its assets folder"};
  }
  return where_.read(file, kLargestAsset);
}

Ref<AssetModel> Project::model(std::string_view path, std::string_view fromFile, bool zUp,
                               std::string& why) {
  const std::string file = locate(path, fromFile);
  if (file.empty()) {
    why = "there is no file '" + std::string(path) + "' in the project";
    return {};
  }
  // Whichever shape asks first, the derivation that does so takes as many steps.
  const UncountedWork uncounted;
  std::lock_guard lock(mutex_);
  const std::string key = file + (zUp ? "|z" : "|y");
  auto at = models_.find(key);
  if (at == models_.end()) {
    // Known only when it is read to the end: a limit may stop it.
    Result<Asset> asset = read(file, zUp);
    at = models_.emplace(key, ModelEntry{}).first;
    if (asset.ok()) {
      auto* m = new AssetModel;
      Mesh mesh = *asset->mesh;
      divideSlots(mesh, *asset);
      m->mesh = makeRef<Mesh>(std::move(mesh));
      m->materials = asset->materials;
      m->groups = asset->slotGroups;
      for (const auto& [name, v] : asset->metadata) m->metadata.push_back(metadatumOf(name, v));
      m->warnings = asset->warnings;
      m->bounds = asset->bounds;
      embed(asset->textures);
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
  const UncountedWork uncounted;
  std::lock_guard lock(mutex_);
  const auto [at, fresh] = images_.try_emplace(file);
  if (fresh) {
    const auto bytes = where_.read(file, kLargestAsset);
    if (!bytes.ok()) return at->second;
    const auto info = readImageHeader(bytes.value());
    if (info.ok())
      at->second = {true, info.value().width, info.value().height, info.value().hasAlpha};
  }
  return at->second;
}

Result<Material> Project::material(std::string_view path, std::string_view fromFile) {
  const std::string file = locate(path, fromFile);
  if (file.empty()) {
    return Error{"missing-file", "there is no file '" + std::string(path) + "'", kWherePathsStart};
  }
  // Once, as models are.
  const UncountedWork uncounted;
  std::lock_guard lock(mutex_);
  auto at = materials_.find(file);
  if (at == materials_.end()) at = materials_.emplace(file, readMaterial(file)).first;
  return at->second;
}

Result<Material> Project::readMaterial(const std::string& file) const {
  Result<std::string> text = where_.read(file, kMaxTextLength);
  if (!text.ok()) return text.error();
  std::vector<std::string> losses;
  const std::vector<Material> all = parseMtl(*text, projectPath(file), losses);
  if (all.empty()) {
    return Error{"bad-material", "'" + projectPath(file) + "' has no material",
                 "a material of an MTL file begins with 'newmtl' and its name"};
  }
  return all[0];
}

bool Project::exists(std::string_view path, std::string_view fromFile) {
  return !locate(path, fromFile).empty();
}

std::vector<std::string> Project::assets() const {
  constexpr std::string_view kFolder = "/assets/";
  std::vector<std::string> out;
  for (const std::string& f : where_.files()) {
    out.push_back(f.substr(f.starts_with(kFolder) ? kFolder.size() : 1));
  }
  return out;
}

std::vector<std::string> Project::filesIn(const std::string& folder) const {
  return where_.filesIn(folder);
}

std::vector<std::string> Project::search(std::string_view pattern, std::string_view fromFile) {
  return where_.search(pattern, fromFile);
}

bool Project::text(std::string_view path, std::string_view fromFile, std::string& out) {
  const std::string file = locate(path, fromFile);
  if (file.empty()) return false;
  Result<std::string> content = where_.read(file, kMaxTextLength);
  if (!content.ok()) return false;
  out = std::move(content.value());
  return true;
}

std::string Project::resolve(std::string_view path, std::string_view fromFile) {
  const std::string file = locate(path, fromFile);
  if (file.empty()) return std::string(path);
  std::string name = projectPath(file);
  return name.starts_with("/") ? name : "/" + name;
}

}  // namespace gable
