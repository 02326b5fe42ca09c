// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The pieces of a tile's buffer are made first, so that the JSON before them knows all offsets:
// vertices and triangles of each stream, the columns of places, those of the table of features.
// Each begins at a multiple of eight bytes, as EXT_structural_metadata wants it. Pictures are files
// that the tiles of a place share.
//
// Compressed, all but the table lies in views of a second buffer that no file holds
// (EXT_meshopt_compression calls it a fallback), and their extension says where the bytes are.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "base/bytes.h"
#include "base/files.h"
#include "base/json.h"
#include "base/work.h"
#include "io/exporters/quaternion.h"
#include "io/gltf_format.h"
#include "tiles/compress.h"
#include "tiles/tile_images.h"
#include "tiles/tile_streams.h"

namespace gable {
namespace {

using namespace gltf;

// Stands in the table where a number is not known.
constexpr float kNoNumber = -1;
// Translations, rotations, scales and features of instances.
constexpr std::array<const char*, 4> kPlaceTypes = {"VEC3", "VEC4", "VEC3", "SCALAR"};
constexpr std::array<uint32_t, 4> kPlaceBytes = {12, 16, 12, 4};

struct Piece {
  std::string bytes;
  uint64_t offset = 0;
  uint32_t stride = 0;
  int target = 0;
  // Of what is compressed: what it becomes, and where that lies in the second buffer.
  const char* mode = nullptr;
  uint64_t count = 0, rawBytes = 0, rawOffset = 0;
};

// A mesh of the file: 0, or that of instances `mesh` - 1. Where they are nodes, it has a feature.
struct ShownMesh {
  size_t mesh = 0;
  uint32_t feature = 0;
};

void putFloat(std::string& to, double v) {
  const auto f = static_cast<float>(v);
  to.append(reinterpret_cast<const char*>(&f), sizeof f);
}

class TileWriter {
 public:
  TileWriter(const TileMesh& mesh, const std::string& name, const TileForm& form,
             const std::vector<std::string>& images)
      : mesh_(mesh),
        name_(name),
        images_(images),
        compressed_(form.compressed),
        nodes_(form.instancing == TileInstancing::Nodes),
        streams_(mesh, form) {}

  /// The whole file.
  Result<std::string> bytes() {
    layOut();
    const std::string json = text();
    const uint64_t jsonBytes = (json.size() + 3) / 4 * 4;
    const uint64_t all = kGlbHead + jsonBytes + kGlbChunkHead + bytes_;
    if (all > kGlbLimit) {
      return Error{"model-too-large",
                   "the tile '" + name_ + "' would hold " + std::to_string(all >> 20) +
                       " MiB, but a .glb file ends at 4096 MiB",
                   "make rules that build less on one shape"};
    }
    workMemory(all);
    std::string out;
    out.reserve(all);
    const auto word = [](uint64_t v) { return static_cast<uint32_t>(v); };
    const uint32_t head[5] = {kGlbMagic, kGlbVersion, word(all), word(jsonBytes), kJsonChunk};
    out.append(reinterpret_cast<const char*>(head), sizeof head);
    out += json;
    out.resize(kGlbHead + jsonBytes, ' ');
    const uint32_t chunk[2] = {word(bytes_), kBinaryChunk};
    out.append(reinterpret_cast<const char*>(chunk), sizeof chunk);
    const uint64_t begin = out.size();
    for (const Piece& p : pieces_) {
      out.resize(begin + p.offset, '\0');
      out += p.bytes;
    }
    out.resize(all, '\0');
    return out;
  }

 private:
  Piece& add(std::string bytes, int target = 0, uint32_t stride = 0) {
    Piece piece;
    piece.offset = (bytes_ + 7) / 8 * 8;
    piece.bytes = std::move(bytes);
    piece.target = target;
    piece.stride = stride;
    bytes_ = piece.offset + piece.bytes.size();
    pieces_.push_back(std::move(piece));
    return pieces_.back();
  }

  void addCompressed(std::string bytes, int target, uint32_t stride, const char* mode,
                     uint64_t count) {
    Piece& piece = add(std::move(bytes), target, stride);
    piece.mode = mode;
    piece.count = count;
    piece.rawBytes = count * stride;
    piece.rawOffset = (rawBytes_ + 7) / 8 * 8;
    rawBytes_ = piece.rawOffset + piece.rawBytes;
  }

  // Vertices, or columns of places, of `stride` bytes each.
  void addRows(std::string bytes, uint32_t stride, int target) {
    const uint64_t count = bytes.size() / stride;
    if (compressed_) {
      addCompressed(compressedVertices(bytes, stride), target, stride, "ATTRIBUTES", count);
    } else {
      add(std::move(bytes), target, stride);
    }
  }

  void addTriangles(const TileStream& stream) {
    const uint32_t stride = stream.isShort() ? 2 : 4;
    if (compressed_) {
      addCompressed(compressedTriangles(stream.indices, stream.count()), kElementArrayBuffer,
                    stride, "TRIANGLES", stream.indices.size());
      return;
    }
    std::string bytes;
    bytes.reserve(stream.indices.size() * stride);
    for (const uint32_t i : stream.indices) {
      bytes.append(reinterpret_cast<const char*>(&i), stride);
    }
    add(std::move(bytes), kElementArrayBuffer);
  }

  // Where a part stands: at its lowest corner, and as large as its steps, where it has some.
  Vec3 cornerOf(size_t mesh, const Frame& at) const {
    return at.point(streams_.steps(mesh).corner());
  }
  double scaleOf(size_t mesh) const {
    return streams_.steps(mesh).on ? streams_.steps(mesh).size : 1;
  }

  // A column each, of all instances.
  void addPlaces() {
    std::array<std::string, 4> columns;
    for (size_t i = 0; i < mesh_.instances.size(); ++i) {
      for (const TileInstances::Place& p : mesh_.instances[i].places) {
        const Vec3 at = cornerOf(i + 1, p.frame);
        for (size_t k = 0; k < 3; ++k) putFloat(columns[0], at[k]);
        for (const double q : quaternionOf(p.frame)) putFloat(columns[1], q);
        for (size_t k = 0; k < 3; ++k) putFloat(columns[2], scaleOf(i + 1));
        putFloat(columns[3], p.feature);
      }
    }
    for (size_t k = 0; k < 4; ++k) addRows(std::move(columns[k]), kPlaceBytes[k], 0);
  }

  // Of meshes that are nodes: the feature of each, as often as its streams have vertices.
  void addFeatureColumn() {
    std::string column;
    eachColumn([&](const ShownMesh& shown, const TileStream& stream) {
      for (uint32_t v = 0; v < stream.count(); ++v) putFloat(column, shown.feature);
    });
    addRows(std::move(column), 4, kArrayBuffer);
  }

  // Calls `column` with the mesh and the stream, in the order of their accessors.
  template <class Column>
  void eachColumn(Column column) const {
    for (const ShownMesh& shown : shown_) {
      if (shown.mesh == 0) continue;
      for (const size_t s : streams_.of(shown.mesh)) column(shown, streams_.all()[s]);
    }
  }

  void findMeshes() {
    if (!streams_.of(0).empty()) shown_.push_back({});
    for (size_t i = 0; i < mesh_.instances.size(); ++i) {
      std::set<uint32_t> features;
      if (!nodes_) features.insert(0);
      for (const TileInstances::Place& p : mesh_.instances[i].places) {
        if (nodes_) features.insert(p.feature);
      }
      for (const uint32_t f : features) shown_.push_back({i + 1, f});
    }
  }

  template <class Get>
  void addTexts(Get get) {
    std::string values, offsets;
    const auto addOffset = [&] {
      const auto at = static_cast<uint32_t>(values.size());
      offsets.append(reinterpret_cast<const char*>(&at), 4);
    };
    for (const TileFeature& f : mesh_.features) {
      addOffset();
      values += get(f);
    }
    addOffset();
    // A view must not be empty.
    if (values.empty()) values.push_back('\0');
    add(std::move(values));
    add(std::move(offsets));
  }

  template <class Get>
  void addNumbers(Get get) {
    std::string values;
    for (size_t i = 0; i < mesh_.features.size(); ++i) {
      const double v = get(i);
      const float f = std::isfinite(v) ? static_cast<float>(v) : kNoNumber;
      values.append(reinterpret_cast<const char*>(&f), 4);
    }
    add(std::move(values));
  }

  void layOut() {
    findMeshes();
    for (const TileStream& s : streams_.all()) {
      addRows(s.vertices, s.layout.stride, kArrayBuffer);
      addTriangles(s);
      accessors_ += s.layout.attributes();
    }
    firstRange_ = accessors_;
    firstPlace_ = firstRange_ + streams_.ranges().size();
    firstPlaces_ = pieces_.size();
    if (!mesh_.instances.empty()) {
      nodes_ ? addFeatureColumn() : addPlaces();
    }
    firstColumn_ = pieces_.size();
    if (!mesh_.features.empty()) {
      addTexts([](const TileFeature& f) { return f.id; });
      addTexts([](const TileFeature& f) { return f.shape; });
      addTexts([](const TileFeature& f) { return f.name; });
      addTexts([](const TileFeature& f) { return f.type; });
      addTexts([](const TileFeature& f) { return f.attributes; });
      addNumbers([&](size_t i) { return mesh_.features[i].levels; });
      addNumbers([&](size_t i) { return mesh_.features[i].height; });
    }
    bytes_ = (bytes_ + 7) / 8 * 8;
  }

  void writeSchema(JsonWriter& w) const {
    w.key("schema").beginObject().field("id", "gable");
    w.key("classes").beginObject().key("feature").beginObject().key("properties").beginObject();
    const std::pair<const char*, const char*> texts[] = {{"id", "What identifies it in the map"},
                                                         {"shape", "What it is to the rules"},
                                                         {"name", "Its name"},
                                                         {"type", "Its kind, as the map has it"},
                                                         {"attributes", "All attributes, as JSON"}};
    for (const auto& [name, about] : texts) {
      w.key(name).beginObject().field("type", "STRING").field("description", about).endObject();
    }
    const std::pair<const char*, const char*> numbers[] = {
        {"levels", "Storeys"}, {"height", "Metres from its lowest to its highest point"}};
    for (const auto& [name, about] : numbers) {
      w.key(name).beginObject().field("type", "SCALAR").field("componentType", "FLOAT32");
      w.field("noData", kNoNumber).field("description", about).endObject();
    }
    w.endObject().endObject().endObject().endObject();
  }

  void writeTable(JsonWriter& w) const {
    w.key("extensions").beginObject().key("EXT_structural_metadata").beginObject();
    writeSchema(w);
    w.key("propertyTables").beginArray().beginObject().field("class", "feature");
    w.field("count", uint64_t{mesh_.features.size()}).key("properties").beginObject();
    uint64_t view = firstColumn_;
    for (const char* name : {"id", "shape", "name", "type", "attributes"}) {
      w.key(name).beginObject().field("values", view).field("stringOffsets", view + 1).endObject();
      view += 2;
    }
    for (const char* name : {"levels", "height"}) {
      w.key(name).beginObject().field("values", view++).endObject();
    }
    w.endObject().endObject().endArray().endObject().endObject();
  }

  // The first accessor of a stream: its position; the others follow.
  uint64_t accessorOf(size_t stream) const {
    uint64_t accessor = 0;
    for (size_t s = 0; s < stream; ++s) accessor += streams_.all()[s].layout.attributes();
    return accessor;
  }

  void writeMeshes(JsonWriter& w) const {
    w.key("meshes").beginArray();
    uint64_t column = firstPlace_;
    for (const ShownMesh& shown : shown_) {
      w.beginObject().key("primitives").beginArray();
      const std::vector<size_t> own = streams_.of(shown.mesh);
      for (size_t r = 0; r < streams_.ranges().size(); ++r) {
        const TileRange& range = streams_.ranges()[r];
        if (range.mesh != shown.mesh) continue;
        const auto at = std::find(own.begin(), own.end(), range.stream) - own.begin();
        writePrimitive(w, range, firstRange_ + r, column + static_cast<uint64_t>(at));
      }
      if (nodes_ && shown.mesh > 0) column += own.size();
      w.endArray().endObject();
    }
    w.endArray();
  }

  // `column`: the accessor of its features, where they are not among the vertices.
  void writePrimitive(JsonWriter& w, const TileRange& range, uint64_t indices,
                      uint64_t column) const {
    const TileLayout& layout = streams_.all()[range.stream].layout;
    uint64_t accessor = accessorOf(range.stream);
    w.beginObject().key("attributes").beginObject();
    w.field("POSITION", accessor).field("NORMAL", accessor + 1).field("COLOR_0", accessor + 2);
    accessor += 3;
    const bool features = layout.features || nodes_;
    if (features) w.field("_FEATURE_ID_0", layout.features ? accessor++ : column);
    for (uint32_t i = 0; i < layout.uvCount; ++i) {
      w.field("TEXCOORD_" + std::to_string(i), accessor++);
    }
    w.endObject().field("indices", indices);
    w.field("material", mesh_.materials->materialOf(range.primitive->variant));
    if (features) {
      w.key("extensions").beginObject().key("EXT_mesh_features").beginObject();
      writeFeatureIds(w);
      w.endObject().endObject();
    }
    w.endObject();
  }

  void writeFeatureIds(JsonWriter& w) const {
    w.key("featureIds").beginArray().beginObject();
    w.field("featureCount", uint64_t{mesh_.features.size()});
    w.field("attribute", 0).field("propertyTable", 0).endObject().endArray();
  }

  static void writeAccessor(JsonWriter& w, uint64_t view, uint64_t offset, int component,
                            uint64_t count, const char* type) {
    w.beginObject().field("bufferView", view);
    if (offset) w.field("byteOffset", offset);
    w.field("componentType", component).field("count", count).field("type", type);
  }

  static void writeStreamAccessors(JsonWriter& w, const TileStream& stream, uint64_t view) {
    const TileLayout& l = stream.layout;
    const auto accessor = [&](const TileField& f, const char* type) {
      writeAccessor(w, view, f.offset, f.component, stream.count(), type);
      if (f.normalized) w.field("normalized", true);
      if (f.offset == 0) {
        for (const auto& [name, v] : {std::pair{"min", stream.low}, {"max", stream.high}}) {
          w.key(name).beginArray().value(v[0]).value(v[1]).value(v[2]).endArray();
        }
      }
      w.endObject();
    };
    accessor(l.position, "VEC3");
    accessor(l.normal, "VEC3");
    accessor(l.color, "VEC4");
    if (l.features) accessor(l.feature, "SCALAR");
    for (uint32_t i = 0; i < l.uvCount; ++i) {
      TileField uv = l.uv;
      uv.offset += 8 * i;
      accessor(uv, "VEC2");
    }
  }

  void writeAccessors(JsonWriter& w) const {
    w.key("accessors").beginArray();
    for (size_t s = 0; s < streams_.all().size(); ++s) {
      writeStreamAccessors(w, streams_.all()[s], 2 * s);
    }
    for (const TileRange& r : streams_.ranges()) {
      const bool isShort = streams_.all()[r.stream].isShort();
      writeAccessor(w, 2 * r.stream + 1, r.firstIndex * (isShort ? 2 : 4),
                    isShort ? kUnsignedShort : kUnsignedInt, r.indexCount, "SCALAR");
      w.endObject();
    }
    nodes_ ? writeColumnAccessors(w) : writePlaceAccessors(w);
    w.endArray();
  }

  void writeColumnAccessors(JsonWriter& w) const {
    uint64_t offset = 0;
    eachColumn([&](const ShownMesh&, const TileStream& stream) {
      writeAccessor(w, firstPlaces_, offset, kFloat, stream.count(), "SCALAR");
      w.endObject();
      offset += uint64_t{4} * stream.count();
    });
  }

  void writePlaceAccessors(JsonWriter& w) const {
    uint64_t first = 0;
    for (const TileInstances& i : mesh_.instances) {
      for (size_t k = 0; k < kPlaceTypes.size(); ++k) {
        writeAccessor(w, firstPlaces_ + k, first * kPlaceBytes[k], kFloat, i.places.size(),
                      kPlaceTypes[k]);
        w.endObject();
      }
      first += i.places.size();
    }
  }

  void writeViews(JsonWriter& w) const {
    w.key("bufferViews").beginArray();
    for (const Piece& p : pieces_) {
      w.beginObject().field("buffer", p.mode ? 1 : 0);
      w.field("byteOffset", p.mode ? p.rawOffset : p.offset);
      w.field("byteLength", p.mode ? p.rawBytes : uint64_t{p.bytes.size()});
      if (p.target == kArrayBuffer) w.field("byteStride", p.stride);
      if (p.target) w.field("target", p.target);
      if (p.mode) {
        w.key("extensions").beginObject().key("EXT_meshopt_compression").beginObject();
        w.field("buffer", 0).field("byteOffset", p.offset);
        w.field("byteLength", uint64_t{p.bytes.size()}).field("byteStride", p.stride);
        w.field("mode", p.mode).field("count", p.count).endObject().endObject();
      }
      w.endObject();
    }
    w.endArray();
    w.key("buffers").beginArray();
    w.beginObject().field("byteLength", bytes_).endObject();
    if (compressed_) {
      w.beginObject().field("byteLength", (rawBytes_ + 7) / 8 * 8).key("extensions").beginObject();
      w.key("EXT_meshopt_compression").beginObject().field("fallback", true).endObject();
      w.endObject().endObject();
    }
    w.endArray();
  }

  // Whether vertices are other than glTF alone has them.
  bool quantized() const {
    const std::vector<TileStream>& all = streams_.all();
    return std::any_of(all.begin(), all.end(), [](const TileStream& s) {
      return s.layout.normal.component != kFloat || s.layout.position.component != kFloat;
    });
  }

  void writeExtensions(JsonWriter& w) const {
    w.key("extensionsUsed").beginArray();
    w.value("EXT_mesh_features").value("EXT_structural_metadata");
    const bool instanced = !nodes_ && !mesh_.instances.empty();
    if (instanced) w.value("EXT_instance_features").value("EXT_mesh_gpu_instancing");
    if (mesh_.materials->usesTransforms()) w.value("KHR_texture_transform");
    if (compressed_) w.value("EXT_meshopt_compression");
    if (quantized()) w.value("KHR_mesh_quantization");
    w.endArray();
    if (!compressed_ && !instanced && !quantized()) return;
    w.key("extensionsRequired").beginArray();
    if (instanced) w.value("EXT_mesh_gpu_instancing");
    if (compressed_) w.value("EXT_meshopt_compression");
    if (quantized()) w.value("KHR_mesh_quantization");
    w.endArray();
  }

  // Steps of integers become metres from the middle of the tile.
  static void beginNode(JsonWriter& w, size_t mesh, const Vec3& at) {
    w.beginObject().field("mesh", uint64_t{mesh});
    w.key("translation").beginArray().value(at.x).value(at.y).value(at.z).endArray();
  }
  static void writeScale(JsonWriter& w, double scale) {
    if (scale != 1) w.key("scale").beginArray().value(scale).value(scale).value(scale).endArray();
  }

  void writeNodes(JsonWriter& w) {
    w.key("nodes").beginArray();
    for (size_t m = 0; m < shown_.size(); ++m) {
      if (shown_[m].mesh == 0) {
        beginNode(w, m, mesh_.center + streams_.steps(0).corner());
        writeScale(w, scaleOf(0));
        w.endObject();
        ++nodeCount_;
      } else if (nodes_) {
        writePlacedNodes(w, m);
      } else {
        writeInstancedNode(w, m);
      }
    }
    w.endArray();
  }

  void writeInstancedNode(JsonWriter& w, size_t m) {
    uint64_t accessor = firstPlace_ + kPlaceTypes.size() * (shown_[m].mesh - 1);
    beginNode(w, m, mesh_.center);
    w.key("extensions").beginObject();
    w.key("EXT_mesh_gpu_instancing").beginObject().key("attributes").beginObject();
    for (const char* name : {"TRANSLATION", "ROTATION", "SCALE", "_FEATURE_ID_0"}) {
      w.field(name, accessor++);
    }
    w.endObject().endObject();
    w.key("EXT_instance_features").beginObject();
    writeFeatureIds(w);
    w.endObject().endObject().endObject();
    ++nodeCount_;
  }

  void writePlacedNodes(JsonWriter& w, size_t m) {
    const auto [mesh, feature] = shown_[m];
    for (const TileInstances::Place& p : mesh_.instances[mesh - 1].places) {
      if (p.feature != feature) continue;
      beginNode(w, m, mesh_.center + cornerOf(mesh, p.frame));
      w.key("rotation").beginArray();
      for (const double q : quaternionOf(p.frame)) w.value(static_cast<float>(q));
      w.endArray();
      writeScale(w, scaleOf(mesh));
      w.endObject();
      ++nodeCount_;
    }
  }

  void writeImages(JsonWriter& w) const {
    if (images_.empty()) return;
    w.key("images").beginArray();
    for (const std::string& image : images_) {
      w.beginObject().field("uri", addressFrom(name_, image)).endObject();
    }
    w.endArray();
  }

  std::string text() {
    std::string out;
    JsonWriter w(out);
    w.beginObject();
    w.key("asset").beginObject().field("version", "2.0").field("generator", "Gable").endObject();
    writeExtensions(w);
    writeTable(w);
    writeNodes(w);
    w.field("scene", 0).key("scenes").beginArray().beginObject().key("nodes").beginArray();
    for (uint64_t n = 0; n < nodeCount_; ++n) w.value(n);
    w.endArray().endObject().endArray();
    writeMeshes(w);
    mesh_.materials->write(w);
    writeImages(w);
    writeAccessors(w);
    writeViews(w);
    w.endObject();
    return out;
  }

  const TileMesh& mesh_;
  const std::string& name_;
  const std::vector<std::string>& images_;
  const bool compressed_, nodes_;
  TileStreams streams_;
  std::vector<ShownMesh> shown_;
  std::vector<Piece> pieces_;
  // Accessors: of vertices, from where those of triangles, and of places or of their features.
  uint64_t accessors_ = 0, firstRange_ = 0, firstPlace_ = 0;
  // Pieces.
  size_t firstPlaces_ = 0, firstColumn_ = 0;
  uint64_t nodeCount_ = 0, bytes_ = 0, rawBytes_ = 0;
};

}  // namespace

Result<TileFile> writeTile(const TileMesh& mesh, const std::string& folder, const std::string& name,
                           const TileForm& form, TileImages& images) {
  const Result<std::vector<std::string>> pictures = images.write(mesh.materials->images());
  if (!pictures.ok()) return pictures.error();
  const Result<std::string> bytes = TileWriter(mesh, name, form, pictures.value()).bytes();
  if (!bytes.ok()) return bytes.error();
  const Result<uint64_t> written = writeFile(folder + name, bytes.value());
  if (!written.ok()) return written.error();
  return TileFile{name, written.value(), checksum(bytes.value())};
}

}  // namespace gable
