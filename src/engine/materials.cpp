// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "gable/materials.h"

#include <array>
#include <utility>

#include "base/files.h"
#include "base/number.h"
#include "engine/guard.h"
#include "engine/impl.h"
#include "io/image/surface.h"
#include "material/library.h"

namespace gable {

namespace {

std::string hexText(uint32_t color) {
  return colorText(
      {(color >> 16 & 255) / 255.0, (color >> 8 & 255) / 255.0, (color & 255) / 255.0});
}

// Options of MTL count tiles a metre.
std::string mtlOf(const LibraryMaterial& m) {
  const std::string scale =
      " -s " + shortestText(1 / m.width) + " " + shortestText(1 / m.height) + " 1 ";
  std::string out = "# " + std::string(m.doc) + "\nnewmtl " + m.name + "\n";
  out += "Kd 1 1 1\nPr 1\nPm " + std::string(m.metallic > 0 ? "1" : "0") + "\n";
  out += "map_Kd" + scale + "color.jpg\nnorm" + scale + "normal.jpg\n";
  out += "map_Ka" + scale + "surface.jpg\nmap_Pr" + scale + "surface.jpg\n";
  out += "map_Pm" + scale + "surface.jpg\n";
  return out;
}

WriteResult write(const std::string& name, const std::string& folder) {
  WriteResult out;
  const auto fail = [&](const Error& error) {
    out.ok = false;
    out.diagnostics = {diagnosticOf(error)};
    return out;
  };
  const LibraryMaterial* m = libraryMaterial(name);
  if (!m) {
    return fail(
        {"unknown-material", "the library has no material '" + name + "'", materialHint(name)});
  }
  const SurfaceField field = drawSurface(*m);
  std::vector<std::pair<std::string, std::string>> files{{"material.mtl", mtlOf(*m)}};
  constexpr std::array<const char*, 3> kNames{"color.jpg", "normal.jpg", "surface.jpg"};
  for (size_t i = 0; i < kNames.size(); ++i) {
    const auto picture = static_cast<MaterialPicture>(i);
    Result<std::string> bytes = encodeMaterialPicture(pictureOf(field, *m, picture), picture);
    if (!bytes.ok()) return fail(bytes.error());
    files.emplace_back(kNames[i], std::move(*bytes));
  }
  for (const auto& [file, bytes] : files) {
    const Result<uint64_t> written = writeFile(folder + "/" + file, bytes);
    if (!written.ok()) return fail(written.error());
    out.bytes += written.value();
  }
  out.ok = true;
  return out;
}

}  // namespace

std::vector<LibraryMaterialInfo> libraryMaterials() {
  std::vector<LibraryMaterialInfo> out;
  for (const LibraryMaterial& m : materialLibrary()) {
    out.push_back({m.name, m.doc, m.width, m.height, hexText(m.color)});
  }
  return out;
}

WriteResult writeLibraryMaterial(const std::string& name, const std::string& folder) {
  return guardedResult<WriteResult>([&] { return write(name, folder); });
}

}  // namespace gable
