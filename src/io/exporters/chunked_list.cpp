// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Threads encode the new chunks, a run of them each. Then all chunks are gone through in order,
// those that are kept by what is remembered of them, and their batches are numbered as they come;
// the numbers are put into the bytes of the new chunks afterwards.

#include "io/exporters/chunked_list.h"

#include <algorithm>
#include <cstring>
#include <deque>
#include <optional>
#include <span>
#include <unordered_map>

#include "base/hash.h"
#include "base/json.h"
#include "base/parallel.h"
#include "base/work.h"
#include "geom/mesh/untagged_hash.h"
#include "io/exporters/draw_batches.h"
#include "io/exporters/draw_chunks.h"
#include "io/exporters/draw_list.h"
#include "io/exporters/normal_table.h"

namespace gable {

namespace {

/// Stands for a chunk, or a batch, that was not there before.
constexpr uint32_t kNew = 0xffffffff;
/// More than most leaves take: bytes that grow move house each time. What is reserved and never
/// touched is free.
constexpr size_t kBytesALeaf = 512;
/// Their numbers have 16 bits, those of more have 32.
constexpr size_t kFewVertices = 1 << 16;

template <class T>
void append(std::string& out, const std::vector<T>& data) {
  out.append(reinterpret_cast<const char*>(data.data()), data.size() * sizeof(T));
}

void append(std::string& out, uint32_t number) {
  out.append(reinterpret_cast<const char*>(&number), sizeof number);
}

/// A batch by what it is, not by its number in one scene.
uint64_t nameOf(const DrawPlan& plan, const BatchKey& key) {
  const uint64_t mesh = key.mesh == kMerged ? 0 : untaggedHash(*plan.scene().meshes[key.mesh]);
  return hashCombine(hashCombine(plan.paint(key.look).look.hash(), mesh),
                     uint64_t{key.slot} << 1 | uint64_t{key.mirrored});
}

/// The bytes of some chunks, one behind the other.
class ChunkWriter {
 public:
  ChunkWriter(const DrawPlan& plan, std::string room)
      : plan_(plan), builder_(plan), bytes_(std::move(room)) {
    bytes_.clear();
  }

  void write(std::span<const LeafRange> ranges) {
    uint64_t leaves = 0;
    for (const LeafRange& r : ranges) leaves += r.to - r.from;
    bytes_.reserve(leaves * kBytesALeaf);
    size_t open = 0;
    forEachLeafIn(plan_, ranges,
                  [&](const Leaf& leaf, const Frame& world, uint64_t number, size_t range) {
                    for (; open < range; ++open) close();
                    builder_.add(leaf, world, static_cast<uint32_t>(number - ranges[range].from));
                  });
    for (; open < ranges.size(); ++open) close();
  }

  /// A piece of a chunk: what it has of a batch.
  struct Piece {
    uint64_t name;
    BatchKey key;
    /// Where the number of the batch belongs.
    size_t at;
  };
  const std::vector<Piece>& pieces() const { return pieces_; }
  /// By chunk: the end of its pieces.
  const std::vector<size_t>& ends() const { return ends_; }
  std::string& bytes() { return bytes_; }
  const DrawGeometry& geometry(const BatchKey& key) const { return builder_.geometries().at(key); }

 private:
  void close() {
    std::vector<std::pair<uint64_t, const std::pair<const BatchKey, Batch>*>> batches;
    for (const auto& batch : builder_.batches()) {
      if (batch.second.empty() || batch.second.geometry->indices.empty()) continue;
      batches.emplace_back(nameOf(plan_, batch.first), &batch);
    }
    // Keys count as this scene happens to; names do not. Two meshes that differ in tags have one.
    std::stable_sort(batches.begin(), batches.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    append(bytes_, static_cast<uint32_t>(batches.size()));
    for (const auto& [name, batch] : batches) {
      pieces_.push_back({name, batch->first, bytes_.size()});
      append(bytes_, kNew);
      if (batch->first.mesh == kMerged)
        addTriangles(batch->second, !plan_.paint(batch->first.look).look.map.empty());
      else
        addInstances(batch->second);
    }
    ends_.push_back(pieces_.size());
    builder_.clear();
  }

  void addInstances(const Batch& batch) {
    append(bytes_, static_cast<uint32_t>(batch.leaves.size()));
    append(bytes_, batch.matrices);
    append(bytes_, batch.colors);
    append(bytes_, batch.leaves);
  }

  void addTriangles(const Batch& batch, bool hasUvs) {
    const size_t vertices = batch.own.positions.size() / 3;
    append(bytes_, static_cast<uint32_t>(vertices));
    append(bytes_, static_cast<uint32_t>(batch.own.indices.size()));
    append(bytes_, static_cast<uint32_t>(batch.runs.size()));
    const std::vector<uint32_t>& normals = normals_.number(batch.own.normals);
    append(bytes_, static_cast<uint32_t>(normals_.normals().size() / 3));
    append(bytes_, batch.own.positions);
    append(bytes_, normals_.normals());
    if (hasUvs) append(bytes_, batch.own.uvs);
    append(bytes_, batch.runs);
    addNumbers(normals, vertices);
    addNumbers(batch.own.indices, vertices);
  }

  // Of vertices or of their normals, of which there are no more than `vertices`.
  void addNumbers(const std::vector<uint32_t>& numbers, size_t vertices) {
    if (vertices > kFewVertices) return append(bytes_, numbers);
    narrow_.assign(numbers.begin(), numbers.end());
    append(bytes_, narrow_);
    bytes_.append(bytes_.size() % 4, '\0');
  }

  const DrawPlan& plan_;
  BatchBuilder builder_;
  NormalTable normals_;
  std::vector<uint16_t> narrow_;
  std::vector<Piece> pieces_;
  std::vector<size_t> ends_;
  std::string bytes_;
};

class Writing {
 public:
  Writing(const DrawPlan& plan, const DrawnChunks& before, unsigned jobs,
          std::vector<std::string> room)
      : plan_(plan), before_(before), jobs_(jobs), chunks_(chunksOf(plan, jobs)) {
    findKept();
    encode(std::move(room));
    number();
  }

  // What all chunks have in common, and the new ones of each writer.
  std::vector<std::string> bytes() {
    std::string arrays, text;
    JsonWriter json(text);
    json.beginObject().key("leaves").value(plan_.leaves());
    json.key("looks").beginArray();
    std::vector<uint32_t> looks;
    std::vector<const DrawLook*> all;
    for (const DrawnChunks::BatchName& batch : drawn_->batches) {
      const auto at =
          std::find_if(all.begin(), all.end(), [&](const auto* l) { return *l == batch.look; });
      looks.push_back(static_cast<uint32_t>(at - all.begin()));
      if (at != all.end()) continue;
      all.push_back(&batch.look);
      writeLook(json, batch.look);
    }
    json.endArray().key("batches").beginArray();
    for (size_t b = 0; b < looks.size(); ++b) writeBatch(json, b, looks[b], arrays);
    json.endArray().key("chunks").beginArray();
    json.value(static_cast<uint64_t>(arrays.size())).value(static_cast<uint64_t>(chunks_.size()));
    json.endArray().endObject();
    text.append((4 - text.size() % 4) % 4, ' ');
    std::string head = "GBU2";
    append(head, static_cast<uint32_t>(text.size()));
    head += text;
    head += arrays;
    append(head, kept_);
    for (const DrawChunk& chunk : chunks_) append(head, chunk.leaves);
    std::vector<std::string> out{std::move(head)};
    for (ChunkWriter& writer : writers_) out.push_back(std::move(writer.bytes()));
    return out;
  }

  std::shared_ptr<const DrawnChunks> drawn() { return std::move(drawn_); }

 private:
  // By chunk: which one of those before it is.
  void findKept() {
    std::unordered_map<uint64_t, uint32_t> known;
    known.reserve(before_.keys.size());
    for (uint32_t i = 0; i < before_.keys.size(); ++i) known.emplace(before_.keys[i], i);
    for (const DrawChunk& chunk : chunks_) {
      const auto at = known.find(chunk.key);
      kept_.push_back(at == known.end() ? kNew : at->second);
    }
  }

  void encode(std::vector<std::string> room) {
    std::vector<LeafRange> ranges;
    uint64_t leaves = 0;
    for (size_t i = 0; i < chunks_.size(); ++i) {
      const uint64_t from = leaves;
      leaves += chunks_[i].leaves;
      if (kept_[i] == kNew) ranges.push_back({from, leaves});
    }
    const size_t count = std::max<size_t>(1, std::min<size_t>(jobs_, ranges.size()));
    // The large ones are those of writers.
    std::sort(room.begin(), room.end(),
              [](const auto& a, const auto& b) { return a.capacity() > b.capacity(); });
    room.resize(count);
    for (std::string& piece : room) writers_.emplace_back(plan_, std::move(piece));
    WorkMeter* const meter = detail::workState.meter;
    parallelFor(count, jobs_, [&](size_t i, unsigned) {
      std::optional<WorkScope> scope;
      if (meter) scope.emplace(*meter);
      const size_t from = ranges.size() * i / count, to = ranges.size() * (i + 1) / count;
      writers_[i].write(std::span(ranges).subspan(from, to - from));
    });
  }

  // Batches as they come, chunk by chunk.
  void number() {
    size_t writer = 0, chunkOfWriter = 0;
    for (size_t i = 0; i < chunks_.size(); ++i) {
      drawn_->keys.push_back(chunks_[i].key);
      if (kept_[i] != kNew) {
        const uint32_t from = kept_[i] ? before_.usedEnd[kept_[i] - 1] : 0;
        for (uint32_t u = from; u < before_.usedEnd[kept_[i]]; ++u) useKept(before_.used[u]);
      } else {
        while (chunkOfWriter == writers_[writer].ends().size()) ++writer, chunkOfWriter = 0;
        usePieces(writers_[writer], chunkOfWriter++);
      }
      drawn_->usedEnd.push_back(static_cast<uint32_t>(drawn_->used.size()));
    }
  }

  void useKept(uint32_t batch) {
    const DrawnChunks::BatchName& name = before_.batches[batch];
    const uint32_t number = numberOf(name.key, name.look);
    keptAs_[number] = batch;
    drawn_->used.push_back(number);
  }

  void usePieces(ChunkWriter& writer, size_t chunk) {
    const size_t from = chunk ? writer.ends()[chunk - 1] : 0;
    for (size_t p = from; p < writer.ends()[chunk]; ++p) {
      const ChunkWriter::Piece& piece = writer.pieces()[p];
      const uint32_t number = numberOf(piece.name, plan_.paint(piece.key.look).look);
      if (piece.key.mesh != kMerged && !geometries_[number]) {
        geometries_[number] = &writer.geometry(piece.key);
      }
      std::memcpy(writer.bytes().data() + piece.at, &number, sizeof number);
      drawn_->used.push_back(number);
    }
  }

  uint32_t numberOf(uint64_t name, const DrawLook& look) {
    const auto [at, fresh] =
        numbers_.try_emplace(name, static_cast<uint32_t>(drawn_->batches.size()));
    if (fresh) {
      drawn_->batches.push_back({name, look});
      keptAs_.push_back(kNew);
      geometries_.push_back(nullptr);
    }
    return at->second;
  }

  void writeBatch(JsonWriter& json, size_t batch, uint32_t look, std::string& arrays) const {
    json.beginObject().key("look").value(look);
    const DrawGeometry* const geometry = geometries_[batch];
    if (keptAs_[batch] != kNew) {
      json.key("kept").value(keptAs_[batch]);
    } else if (geometry) {
      const auto section = [&](const char* name, const auto& data) {
        json.key(name).beginArray().value(static_cast<uint64_t>(arrays.size()));
        json.value(static_cast<uint64_t>(data.size())).endArray();
        append(arrays, data);
      };
      section("position", geometry->positions);
      section("normal", geometry->normals);
      if (!drawn_->batches[batch].look.map.empty()) section("uv", geometry->uvs);
      section("index", geometry->indices);
    }
    json.endObject();
  }

  const DrawPlan& plan_;
  const DrawnChunks& before_;
  const unsigned jobs_;
  const std::vector<DrawChunk> chunks_;
  std::vector<uint32_t> kept_;
  std::deque<ChunkWriter> writers_;
  std::shared_ptr<DrawnChunks> drawn_ = std::make_shared<DrawnChunks>();
  std::unordered_map<uint64_t, uint32_t> numbers_;
  /// By batch: which one of those before it is, where a chunk that is kept has it; its geometry
  /// where a new chunk has instances of it.
  std::vector<uint32_t> keptAs_;
  std::vector<const DrawGeometry*> geometries_;
};

}  // namespace

ChunkedList chunkedList(const Scene& scene, const DrawnChunks* before, unsigned jobs,
                        std::vector<std::string> room) {
  const DrawPlan plan(scene);
  if (plan.truncated() || plan.leaves() < kLeavesWorthChunks)
    return {{drawList(scene, jobs)}, nullptr};
  static const DrawnChunks kNone;
  Writing writing(plan, before ? *before : kNone, jobs ? jobs : defaultJobs(), std::move(room));
  std::vector<std::string> bytes = writing.bytes();
  return {std::move(bytes), writing.drawn()};
}

}  // namespace gable
