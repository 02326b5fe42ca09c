// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// OBJ and MTL. Coordinates are world coordinates rounded to a micrometre. MTL can scale and shift a
// texture but not turn it, so where a material turns its colour texture the texture coordinates are
// written as they come out. Leaves are divided into blocks, whatever the number of threads; while
// some are written as text, those before go to the file.
#include <algorithm>
#include <array>
#include <deque>

#include "base/files.h"
#include "base/number.h"
#include "base/parallel_work.h"
#include "io/exporters/obj_lines.h"
#include "io/exporters/surface.h"
#include "io/exporters/textures.h"
#include "io/exporters/write_model.h"
#include "io/uri.h"
#include "material/library.h"
#include "scene/flatten.h"

namespace gable {
namespace {

// Of a block: as many leaves, or as many vertices and corners, and one leaf more. All blocks at
// hand and their texts stay in the caches.
constexpr size_t kMostItems = 256;
constexpr uint64_t kMostNumbers = 1 << 13;
// Blocks at a time, for each thread. More threads than that would wait for the file.
constexpr size_t kBlocksAThread = 4;
constexpr unsigned kMostThreads = 16;

// Leaves, and roots that begin: those have no leaf.
struct Block {
  struct Item {
    const Leaf* leaf;
    const Root* root;
    Frame world;
  };
  std::vector<Item> items;
  ObjCounts before;
  uint64_t numbers = 0;
};

class ObjWriter {
 public:
  ObjWriter(const Scene& scene, const std::string& path, const WriteOptions& options)
      : scene_(scene),
        plan_(scene),
        pool_(std::min(options.jobs ? options.jobs : defaultJobs(), kMostThreads)),
        path_(path),
        stem_(path.substr(0, path.size() - extensionOf(path).size() - 1)),
        out_(path),
        textures_(options, report_.warnings) {}

  Result<WriteReport> write();

 private:
  void putLeaves();
  void put(const Block::Item& item, const ObjCounts& counts);
  void turnToText();
  void writeTexts();
  std::string materialFile();
  void putMap(std::string& out, const char* statement, const Material& m, TextureLayer layer);

  const Scene& scene_;
  const ObjPlan plan_;
  TaskPool pool_;
  std::string path_, stem_;
  WriteReport report_;
  FileWriter out_;
  TextureSet textures_;
  /// By thread.
  std::deque<ObjLines> lines_;
  /// Those before `open_` are full.
  std::vector<Block> blocks_;
  size_t open_ = 0;
  ObjCounts at_;
  /// Of blocks that have been, and of those at hand.
  std::vector<TextBuffer> texts_, next_;
  // Textures that are turned in another way than their material's colour.
  uint64_t misplacedMaps_ = 0;
};

// MTL's options for a texture's scale and shift.
std::string placingOf(const TextureMap& map) {
  std::string out;
  if (map.su != 1 || map.sv != 1) {
    out += " -s " + shortestText(map.su) + " " + shortestText(map.sv) + " 1";
  }
  if (map.tu != 0 || map.tv != 0) {
    out += " -o " + shortestText(map.tu) + " " + shortestText(map.tv) + " 0";
  }
  return out;
}

void ObjWriter::putMap(std::string& out, const char* statement, const Material& m,
                       TextureLayer layer) {
  const TextureMap& map = m.map(layer);
  const int texture = textures_.add(map.path);
  if (texture == TextureSet::kNone) return;
  out += statement;
  const TextureMap& color = m.map(TextureLayer::Color);
  const bool baked = !color.path.empty() && (color.rw != 0 || isLaid(m));
  if (baked) {
    const auto placing = [](const TextureMap& t) {
      return std::array<double, 5>{t.su, t.sv, t.tu, t.tv, t.rw};
    };
    misplacedMaps_ += placing(map) == placing(color) ? 0 : 1;
  } else {
    misplacedMaps_ += map.rw != 0 ? 1 : 0;
  }
  if (!baked) out += placingOf(map);
  const ModelTexture& t = textures_.all()[static_cast<size_t>(texture)];
  out += " " + fileNameOf(stem_) + "-" + t.name + "\n";
}

std::string ObjWriter::materialFile() {
  std::string out = "# written by Gable\n";
  const Material plain;
  const auto color = [&](const char* word, const Vec3& c) {
    out += word;
    for (size_t i = 0; i < 3; ++i) out += " " + shortestText(c[i]);
    out += '\n';
  };
  for (size_t i = 0; i < plan_.materialNames().size(); ++i) {
    const auto uses = [&](const ObjLines& l) { return l.used()[i]; };
    if (std::none_of(lines_.begin(), lines_.end(), uses)) continue;
    const Material& m = i < scene_.materials.size() ? scene_.materials[i] : plain;
    out += "\nnewmtl " + plan_.materialNames()[i] + "\n";
    color("Kd", m.color);
    color("Ka", m.ambient);
    color("Ks", m.specular);
    if (m.emissive != Vec3{}) color("Ke", m.emissive);
    out += "Ns " + shortestText(m.shininess) + "\n";
    out += "d " + shortestText(m.opacity) + "\n";
    out += "Pr " + shortestText(m.roughness) + "\nPm " + shortestText(m.metallic) + "\n";
    putMap(out, "map_Kd", m, TextureLayer::Color);
    putMap(out, "map_bump", m, TextureLayer::Bump);
    putMap(out, "map_Ka", m, TextureLayer::Occlusion);
    putMap(out, "map_Ks", m, TextureLayer::Specular);
    putMap(out, "map_d", m, TextureLayer::Opacity);
    putMap(out, "norm", m, TextureLayer::Normal);
    putMap(out, "map_Ke", m, TextureLayer::Emissive);
    // MTL has no words for the channels of one picture, and readers take the whole of it.
    if (m.map(TextureLayer::Roughness).path == m.map(TextureLayer::Metallic).path) continue;
    putMap(out, "map_Pr", m, TextureLayer::Roughness);
    putMap(out, "map_Pm", m, TextureLayer::Metallic);
  }
  return out;
}

void ObjWriter::put(const Block::Item& item, const ObjCounts& counts) {
  Block& block = blocks_[open_];
  if (block.items.empty()) block.before = at_;
  block.items.push_back(item);
  block.numbers += counts.vertices + counts.uvs + counts.normals;
  at_.vertices += counts.vertices;
  at_.uvs += counts.uvs;
  at_.normals += counts.normals;
  const bool full = block.items.size() >= kMostItems || block.numbers >= kMostNumbers;
  if (full && ++open_ == blocks_.size()) turnToText();
}

void ObjWriter::writeTexts() {
  for (TextBuffer& text : texts_) {
    out_.append(text.text());
    text.clear();
  }
}

// The blocks at hand, while the file takes the text of those before.
void ObjWriter::turnToText() {
  parallelWork(pool_, blocks_.size() + 1, [&](size_t i, unsigned thread) {
    if (i == 0) return writeTexts();
    Block& block = blocks_[i - 1];
    ObjLines& lines = lines_[thread];
    lines.begin(block.before, next_[i - 1]);
    for (const Block::Item& item : block.items) {
      if (item.leaf) {
        lines.add(*item.leaf, item.world);
      } else {
        lines.addRoot(*item.root);
      }
    }
    block.items.clear();
    block.numbers = 0;
  });
  std::swap(texts_, next_);
  open_ = 0;
}

void ObjWriter::putLeaves() {
  const size_t count = pool_.jobs() > 1 ? pool_.jobs() * kBlocksAThread : 1;
  for (unsigned j = 0; j < pool_.jobs(); ++j) lines_.emplace_back(plan_);
  blocks_.resize(count);
  texts_.resize(count);
  next_.resize(count);
  for (const Root& root : scene_.roots) {
    if (out_.failed()) return;
    put({nullptr, &root, {}}, {});
    forEachLeaf(scene_, scene_.prototypes[root.instance.prototype], root.instance.frame,
                [&](const Leaf& leaf, const Frame& world) {
                  put({&leaf, &root, world}, plan_.countsOf(leaf, world));
                });
  }
  turnToText();
  writeTexts();
}

Result<WriteReport> ObjWriter::write() {
  out_.append("# written by Gable; metres, y up\n");
  out_.append("mtllib " + objWord(fileNameOf(stem_), "model") + ".mtl\n");
  // The uv coordinates of unit boxes, numbers 1 to 4.
  out_.append("vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\ns off\n");
  at_.uvs = 4;
  putLeaves();
  for (const ObjLines& l : lines_) report_.triangles += l.triangles();
  const std::string materials = materialFile();
  if (misplacedMaps_ > 0) {
    report_.warnings.push_back(std::to_string(misplacedMaps_) +
                               " textures lie as their material's colour texture does: OBJ has one "
                               "set of texture coordinates, and MTL cannot turn");
  }
  for (const ModelTexture& t : textures_.all()) {
    const std::string file = stem_ + "-" + t.name;
    const Result<uint64_t> bytes = writeFile(file, t.bytes);
    if (!bytes.ok()) return bytes.error();
    report_.bytes += bytes.value();
    report_.files.push_back(file);
  }
  const std::string materialPath = folderOf(stem_) + objWord(fileNameOf(stem_), "model") + ".mtl";
  const Result<uint64_t> more = writeFile(materialPath, materials);
  if (!more.ok()) return more.error();
  const Result<uint64_t> bytes = out_.finish();
  if (!bytes.ok()) return bytes.error();
  report_.bytes += more.value() + bytes.value();
  report_.files.insert(report_.files.begin(), {path_, materialPath});
  return report_;
}

}  // namespace

Result<WriteReport> writeObj(const Scene& scene, const std::string& path,
                             const WriteOptions& options) {
  return ObjWriter(scene, path, options).write();
}

}  // namespace gable
