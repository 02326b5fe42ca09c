// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "engine/project.h"

#include <algorithm>

#include "base/allowance.h"
#include "base/files.h"
#include "base/hash.h"
#include "base/parallel_work.h"
#include "engine/builtin_files.h"
#include "io/image/image.h"
#include "io/importers/asset.h"
#include "io/importers/mtl_file.h"

namespace gable {

namespace {

constexpr uint64_t kLargestAsset = 1ull << 30;

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

void Project::drawBuiltins(const std::vector<std::string>& paths) {
  // Drawn once and kept, whoever asks first.
  const UncountedWork uncounted;
  std::map<std::string, std::vector<std::string>> wanted;
  for (const std::string& path : paths) {
    std::vector<std::string> together = drawnWith(path);
    const std::lock_guard lock(mutex_);
    if (!together.empty() && builtins_.count(path) == 0) wanted[together[0]] = std::move(together);
  }
  struct Drawn {
    std::vector<std::string> paths, files;
  };
  std::vector<Drawn> drawn;
  for (auto& [first, together] : wanted) drawn.push_back({std::move(together), {}});
  parallelWork(drawn.size(), 0, [&](size_t i, unsigned) {
    Drawn& d = drawn[i];
    std::vector<Image> images;
    for (const TexturePicture& p : pictures_.known(d.paths[0])) {
      images.push_back({p->width, p->height, p->rgba});
    }
    if (images.empty()) images = drawTextures(d.paths);
    for (size_t k = 0; k < d.paths.size(); ++k) {
      d.files.push_back(encodeTexture(d.paths[k], std::move(images[k])));
    }
  });
  const std::lock_guard lock(mutex_);
  for (Drawn& d : drawn) {
    for (size_t k = 0; k < d.paths.size(); ++k) builtins_[d.paths[k]] = std::move(d.files[k]);
  }
}

TexturePicture Project::picture(const std::string& path) {
  bool isEmbedded = false;
  {
    const std::lock_guard lock(mutex_);
    isEmbedded = embedded_.count(path) > 0;
  }
  if (!isEmbedded) {
    if (TexturePicture drawn = pictures_.find(path)) return drawn;
  }
  const Result<std::string> bytes = texture(path);
  return bytes.ok() ? decoded(bytes.value()) : nullptr;
}

TexturePicture Project::decoded(const std::string& bytes) {
  const std::pair key(hashBytes(bytes), bytes.size());
  {
    const std::lock_guard lock(mutex_);
    if (const auto at = decoded_.find(key); at != decoded_.end()) return at->second;
  }
  Result<Image> image = decodeImage(bytes);
  if (!image.ok()) return nullptr;
  TexturePicture made = texturePicture(std::move(image.value()));
  constexpr uint64_t kMostKept = 512ull << 20;
  const uint64_t size = made->rgba.size();
  if (size > kMostKept) return made;
  const std::lock_guard lock(mutex_);
  if (decodedBytes_ + size > kMostKept) {
    decoded_.clear();
    decodedBytes_ = 0;
  }
  if (decoded_.emplace(key, made).second) decodedBytes_ += size;
  return made;
}

Result<std::string> Project::texture(const std::string& path) {
  {
    std::lock_guard lock(mutex_);
    const auto at = embedded_.find(path);
    if (at != embedded_.end()) return *at->second;
  }
  if (!drawnWith(path).empty()) {
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
  if (const ImageInfo builtin = builtinImage(path); builtin.found) return builtin;
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
