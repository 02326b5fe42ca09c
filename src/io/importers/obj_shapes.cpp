// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Initial shapes from OBJ: the faces of the file by object or group, each with its own positions,
// so that many parts of one long list of positions stay linear.
#include <algorithm>

#include "base/work.h"
#include "io/importers/obj_parts.h"
#include "io/importers/shape_parts.h"
#include "shape/losses.h"

namespace gable {
namespace {

std::string firstBadLine(const ObjFile& file) {
  return "line " + std::to_string(file.firstBadLine) + ": " + file.firstBadReason;
}

void noteBadLines(ShapeFile& out, const ObjFile& file) {
  if (file.badLines == 0) return;
  out.diagnostics.warning("shape-line-broken", {},
                          std::to_string(file.badLines) +
                              " lines of the file cannot be read; the first is " +
                              firstBadLine(file));
}

// An OBJ file without a face: which line is to blame, or what it has in the place of faces.
Error withoutFaces(const ObjFile& file, const std::string& path, uint64_t dropped) {
  Error error = emptyShapes(path);
  if (file.badLines > 0) {
    error.message += "; " + firstBadLine(file);
    error.hint = "mend the line; a polygon is written 'f 1 2 3', with vertices 'v x y z' before it";
  } else if (dropped > 0) {
    error.message += ": its " + std::to_string(dropped) + " faces have no area";
    error.hint = "give them corners that do not lie on one line";
  } else if (file.lines > 0) {
    error.message += ": it has lines ('l') and no faces ('f')";
    error.hint = "close the outline and save it as a polygon";
  } else {
    error.message +=
        ": it has " + std::to_string(file.positions.size()) + " vertices and no faces ('f')";
    error.hint = "a polygon is written 'f 1 2 3', with vertices 'v x y z' before it";
  }
  return error;
}

// Faces by part, parts in the order of their first face; the name of each, or the last of all.
struct Parts {
  std::vector<std::vector<uint32_t>> faces;
  std::vector<uint32_t> names;
};

Parts partsOf(const ObjFile& file, bool byObject) {
  const size_t names = (byObject ? file.objects : file.groups).size();
  Parts parts;
  std::vector<uint32_t> partOf(names + 1, ObjCorner::kNone);
  for (uint32_t f = 0; f < file.faces.size(); ++f) {
    const uint32_t raw = byObject ? file.faces[f].object : file.faces[f].group;
    const auto name = static_cast<uint32_t>(std::min<size_t>(raw, names));
    if (partOf[name] == ObjCorner::kNone) {
      partOf[name] = static_cast<uint32_t>(parts.faces.size());
      parts.faces.emplace_back();
      parts.names.push_back(name);
    }
    parts.faces[partOf[name]].push_back(f);
  }
  return parts;
}

}  // namespace

Result<ShapeFile> readObjShapes(std::string_view text, const AssetOptions& options) {
  const ObjFile file = parseObj(text);
  ShapeFile out;
  std::vector<std::string> missing, losses;
  Result<ObjMaterials> materials = objMaterials(file, options, missing, losses);
  if (!materials.ok()) return materials.error();
  for (const std::string& w : missing) out.diagnostics.warning("shape-material-missing", {}, w);
  if (!losses.empty()) {
    out.diagnostics.warning("read-with-loss", {}, lossesOf(options.path, losses), kWithoutThem);
  }
  const bool byObject = !file.objects.empty();
  const std::vector<std::string>& names = byObject ? file.objects : file.groups;
  const Parts parts = partsOf(file, byObject);
  // A shape that is a group has none inside it.
  const ObjPartWishes wishes{byObject && !file.groups.empty(), true, false};
  uint64_t dropped = 0;
  for (size_t i = 0; i < parts.faces.size(); ++i) {
    Result<ObjPart> part = objPart(file, parts.faces[i], *materials, wishes, options);
    if (!part.ok()) return part.error();
    dropped += part->dropped;
    ShapeInput shape;
    shape.name = parts.names[i] < names.size() ? names[parts.names[i]] : stemOf(options.path);
    shape.mesh = std::move(part->mesh);
    if (shape.mesh.empty()) continue;
    takeMaterials(shape, std::move(part->asset));
    out.shapes.push_back(std::move(shape));
  }
  noteDropped(out, dropped);
  noteBadLines(out, file);
  if (out.shapes.empty()) return withoutFaces(file, options.path, dropped);
  turnFootprintsUp(out);
  return out;
}

}  // namespace gable
