// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "engine/drawn_textures.h"

#include <algorithm>
#include <array>

#include "base/allowance.h"
#include "base/parallel_work.h"
#include "io/image/leaf_pictures.h"
#include "io/image/patterns.h"
#include "io/image/surface.h"
#include "material/builtin_textures.h"

namespace gable {

namespace {

constexpr std::array kMaterialPictures{MaterialPicture::Color, MaterialPicture::Normal,
                                       MaterialPicture::Surface};

/// Beyond the last for another path.
size_t numberOfBuiltin(std::string_view path) {
  if (path.substr(0, kBuiltinTexturePrefix.size()) != kBuiltinTexturePrefix) {
    return kBuiltinTextures.size();
  }
  size_t i = 0;
  while (i < kBuiltinTextures.size() && path != builtinTexturePath(i)) ++i;
  return i;
}

bool isLeaves(std::string_view path) { return builtinLeaves(path) < kBuiltinLeaves.size(); }

}  // namespace

std::vector<std::string> drawnWith(const std::string& path) {
  std::vector<std::string> paths;
  if (const LibraryMaterial* m = materialPictureOf(path).material) {
    for (const MaterialPicture p : kMaterialPictures) paths.push_back(materialPicturePath(*m, p));
  } else if (isLeaves(path) || numberOfBuiltin(path) < kBuiltinTextures.size()) {
    paths.push_back(path);
  }
  return paths;
}

std::vector<Image> drawTextures(const std::vector<std::string>& paths) {
  const std::string& path = paths.at(0);
  std::vector<Image> images;
  if (const LibraryMaterial* m = materialPictureOf(path).material) {
    const SurfaceField field = drawSurface(*m);
    for (const MaterialPicture p : kMaterialPictures) images.push_back(pictureOf(field, *m, p));
  } else {
    images.push_back(isLeaves(path) ? drawLeaves(builtinLeaves(path))
                                    : drawPattern(numberOfBuiltin(path)));
  }
  return images;
}

std::string encodeTexture(const std::string& path, Image image) {
  const PictureName name = materialPictureOf(path);
  if (name.material) return encodeMaterialPicture(std::move(image), name.picture).value();
  // Noise does not get smaller at higher levels, only slower.
  constexpr int kLevel = 3, kLeavesLevel = 6;
  return (isLeaves(path) ? encodePng(image, 4, kLeavesLevel) : encodePng(image, 3, kLevel)).value();
}

TexturePicture texturePicture(Image image) {
  return std::make_shared<const TextureImage>(
      TextureImage{image.width, image.height, std::move(image.rgba)});
}

DrawnTextures::Entry* DrawnTextures::entryOf(const std::string& path) {
  std::vector<std::string> paths = drawnWith(path);
  if (paths.empty()) return nullptr;
  const std::lock_guard lock(mutex_);
  Entry& entry = entries_[paths[0]];
  if (entry.paths.empty()) entry.paths = std::move(paths);
  return &entry;
}

void DrawnTextures::make(Entry& entry) {
  entry.begun = true;
  // Drawing may be left when it is stopped; then the next one begins again.
  std::call_once(entry.once, [&entry] {
    const UncountedWork uncounted;
    std::vector<TexturePicture> pictures;
    for (Image& image : drawTextures(entry.paths)) {
      pictures.push_back(texturePicture(std::move(image)));
    }
    entry.pictures = std::move(pictures);
    entry.done = true;
  });
}

TexturePicture DrawnTextures::find(const std::string& path) {
  Entry* const entry = entryOf(path);
  if (!entry) return nullptr;
  make(*entry);
  const auto at = std::find(entry->paths.begin(), entry->paths.end(), path);
  return entry->pictures[static_cast<size_t>(at - entry->paths.begin())];
}

void DrawnTextures::draw(const std::vector<std::string>& paths, unsigned jobs) {
  std::vector<Entry*> wanted;
  for (const std::string& path : paths) {
    Entry* const entry = entryOf(path);
    if (entry && !entry->done) wanted.push_back(entry);
  }
  parallelWork(wanted.size(), jobs, [&](size_t i, unsigned) {
    if (!wanted[i]->begun.exchange(true)) make(*wanted[i]);
  });
  for (Entry* const entry : wanted) make(*entry);
}

std::vector<TexturePicture> DrawnTextures::known(const std::string& path) {
  Entry* const entry = entryOf(path);
  return entry && entry->done ? entry->pictures : std::vector<TexturePicture>();
}

}  // namespace gable
