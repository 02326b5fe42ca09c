// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "tiles/tile_part.h"

#include <algorithm>

#include "base/bytes.h"
#include "base/files.h"
#include "base/work.h"
#include "math/frame_bytes.h"

namespace gable {
namespace {

constexpr uint64_t kPartMark = 0x3230747261706c67;
// Squares are divided so often, and a tile of one unit into quarters of it again.
constexpr int kDeepestNode = 4 * kDeepestSquare;

void write(ByteWriter& w, const TileNode& node) {
  w.value(node.box);
  w.value(node.error);
  w.text(node.uri);
  w.value(node.cost);
  w.value(node.levels);
  w.value(node.nodes);
  w.value(uint64_t{node.children.size()});
  for (const TileNode& child : node.children) write(w, child);
}

bool read(ByteReader& r, TileNode& node, int depth) {
  node.box = r.value<Box3>();
  node.error = r.value<double>();
  node.uri = r.text();
  node.cost = r.value<uint64_t>();
  node.levels = r.value<uint32_t>();
  node.nodes = r.value<uint64_t>();
  const size_t children = r.count(sizeof(Box3));
  if (children > 4 || depth > kDeepestNode) return false;
  node.children.resize(children);
  return r.ok() && std::all_of(node.children.begin(), node.children.end(),
                               [&](TileNode& child) { return read(r, child, depth + 1); });
}

void write(ByteWriter& w, const TileFeature& f) {
  for (const std::string* text : {&f.id, &f.shape, &f.name, &f.type, &f.attributes}) w.text(*text);
  for (const double v : {f.levels, f.height, f.middle.x, f.middle.y}) w.value(v);
}

TileFeature readFeature(ByteReader& r) {
  TileFeature f;
  for (std::string* text : {&f.id, &f.shape, &f.name, &f.type, &f.attributes}) *text = r.text();
  for (double* v : {&f.levels, &f.height, &f.middle.x, &f.middle.y}) *v = r.value<double>();
  return f;
}

void write(ByteWriter& w, const CoarseModel& model) {
  w.value(uint64_t{model.features.size()});
  for (const TileFeature& f : model.features) write(w, f);
  w.value(uint64_t{model.parts.size()});
  for (const CoarsePart& p : model.parts) {
    w.value(p.feature);
    w.value(p.finish);
    w.value(p.area);
    w.value(uint8_t{p.isPanel});
    writeFrame(w, p.frame);
    w.value(p.box);
    for (const uint32_t v : {p.firstVertex, p.vertexCount, p.firstTriangle, p.triangleCount}) {
      w.value(v);
    }
  }
  w.list(model.vertices);
  w.list(model.triangles);
  w.value(model.error);
}

void write(ByteWriter& w, const std::vector<TileFile>& files) {
  w.value(uint64_t{files.size()});
  for (const TileFile& f : files) {
    w.text(f.name);
    w.value(f.bytes);
    w.value(f.checksum);
  }
}

void read(ByteReader& r, std::vector<TileFile>& files) {
  files.resize(r.count(3 * sizeof(uint64_t)));
  for (TileFile& f : files) {
    f.name = r.text();
    f.bytes = r.value<uint64_t>();
    f.checksum = r.value<uint64_t>();
  }
}

// Whether the numbers of a part name what is there.
bool fits(const CoarsePart& p, const CoarseModel& model) {
  const auto within = [](uint64_t first, uint64_t count, size_t size) {
    return first + count <= size;
  };
  if (p.feature >= model.features.size() ||
      !within(p.firstVertex, p.vertexCount, model.vertices.size()) ||
      !within(p.firstTriangle, p.triangleCount, model.triangles.size())) {
    return false;
  }
  const auto first = model.triangles.begin() + p.firstTriangle;
  return std::all_of(first, first + p.triangleCount, [&](const auto& t) {
    return std::all_of(t.begin(), t.end(), [&](uint32_t v) { return v < p.vertexCount; });
  });
}

bool read(ByteReader& r, CoarseModel& model) {
  constexpr size_t kLeastFeature = 5 * sizeof(uint64_t), kLeastPart = sizeof(Frame);
  model.features.resize(r.count(kLeastFeature));
  for (TileFeature& f : model.features) f = readFeature(r);
  model.parts.resize(r.count(kLeastPart));
  for (CoarsePart& p : model.parts) {
    p.feature = r.value<uint32_t>();
    p.finish = r.value<Finish>();
    p.area = r.value<double>();
    p.isPanel = r.value<uint8_t>() != 0;
    p.frame = readFrame(r);
    p.box = r.value<Box3>();
    for (uint32_t* v : {&p.firstVertex, &p.vertexCount, &p.firstTriangle, &p.triangleCount}) {
      *v = r.value<uint32_t>();
    }
  }
  model.vertices = r.list<Vec3>();
  model.triangles = r.list<std::array<uint32_t, 3>>();
  model.error = r.value<double>();
  return r.ok() && std::all_of(model.parts.begin(), model.parts.end(),
                               [&](const CoarsePart& p) { return fits(p, model); });
}

}  // namespace

std::string partBytes(const TilePart& part, uint64_t plan) {
  std::string out;
  ByteWriter w(out);
  w.value(kPartMark);
  w.value(plan);
  w.value(uint64_t{part.root.has_value()});
  if (part.root) write(w, *part.root);
  write(w, part.coarse);
  write(w, part.files);
  write(w, part.images);
  for (const uint64_t v : {part.tiles, part.bytes, part.triangles, part.coarseTriangles}) {
    w.value(v);
  }
  w.value(uint64_t{part.warnings.size()});
  for (const std::string& text : part.warnings) w.text(text);
  w.value(checksum(out));
  return out;
}

std::optional<TilePart> partOf(std::string_view bytes, uint64_t plan) {
  const size_t most = bytes.size() - sizeof(uint64_t);
  if (bytes.size() < sizeof(uint64_t)) return std::nullopt;
  if (ByteReader(bytes.substr(most)).value<uint64_t>() != checksum(bytes.substr(0, most))) {
    return std::nullopt;
  }
  ByteReader r(bytes.substr(0, most));
  if (r.value<uint64_t>() != kPartMark || r.value<uint64_t>() != plan) return std::nullopt;
  TilePart part;
  if (r.value<uint64_t>() != 0) {
    part.root.emplace();
    if (!read(r, *part.root, 0)) return std::nullopt;
  }
  if (!read(r, part.coarse)) return std::nullopt;
  read(r, part.files);
  read(r, part.images);
  for (uint64_t* v : {&part.tiles, &part.bytes, &part.triangles, &part.coarseTriangles}) {
    *v = r.value<uint64_t>();
  }
  part.warnings.resize(r.count(sizeof(uint64_t)));
  for (std::string& text : part.warnings) text = r.text();
  if (!r.ok() || !r.atEnd()) return std::nullopt;
  return part;
}

std::string damagedFile(const TilePart& part, const std::string& folder) {
  for (const std::vector<TileFile>* files : {&part.files, &part.images}) {
    for (const TileFile& f : *files) {
      work();
      const Result<std::string> bytes = readFile(folder + f.name, f.bytes + 1);
      if (!bytes.ok() || bytes.value().size() != f.bytes || checksum(bytes.value()) != f.checksum) {
        return f.name;
      }
    }
  }
  return {};
}

}  // namespace gable
