// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// One pass counts how often each mesh stands, one how much each batch will hold, and the last one
// sorts leaves into batches, several threads a range of them each. Counting visits what is stored,
// sorting what is flattened. A large place has hundreds of megabytes here: memory that is asked for
// once is touched once.

#include "io/exporters/draw_list.h"

#include <algorithm>
#include <deque>
#include <map>
#include <optional>
#include <string_view>

#include "base/json.h"
#include "base/parallel.h"
#include "base/work.h"
#include "io/exporters/draw_batches.h"

namespace gable {

namespace {

/// A thread has at least so many leaves.
constexpr uint64_t kLeavesAPart = 1 << 16;

// Parts in path order as one list: looks are numbered as one part would, and arrays follow each
// other.
class Joiner {
 public:
  Joiner(const DrawPlan& plan, std::deque<BatchBuilder>& parts)
      : plan_(plan), looks_(plan.paints()) {
    for (BatchBuilder& part : parts) add(part);
  }

  std::string bytes() {
    std::string text;
    JsonWriter json(text);
    json.beginObject().key("leaves").value(plan_.leaves());
    json.key("truncated").value(plan_.truncated());
    json.key("looks").beginArray();
    for (const uint32_t paint : lookOrder_) writeLook(json, plan_.paint(paint).look);
    json.endArray().key("batches").beginArray();
    for (const auto& [key, pieces] : batches_) writeBatch(json, key, pieces);
    json.endArray().endObject();
    text.append((4 - text.size() % 4) % 4, ' ');
    const auto size = static_cast<uint32_t>(text.size());
    std::string out;
    out.reserve(8 + text.size() + arrayBytes_);
    out = "GBL1";
    out.append(reinterpret_cast<const char*>(&size), sizeof size);
    out += text;
    for (const std::string_view array : arrays_) out += array;
    return out;
  }

 private:
  using Pieces = std::vector<Batch*>;

  void add(BatchBuilder& part) {
    for (const uint32_t paint : part.looks()) {
      uint32_t& number = looks_[plan_.paint(paint).group];
      if (number != 0) continue;
      lookOrder_.push_back(paint);
      number = static_cast<uint32_t>(lookOrder_.size());
    }
    for (auto& [key, batch] : part.batches()) {
      if (batch.geometry->indices.empty()) continue;
      BatchKey named = key;
      named.look = looks_[key.look] - 1;
      Pieces& pieces = batches_[named];
      if (named.mesh == kMerged) rebase(batch, pieces);
      pieces.push_back(&batch);
    }
  }
  static void rebase(Batch& batch, const Pieces& before) {
    size_t base = 0;
    for (const Batch* b : before) base += b->own.positions.size() / 3;
    if (base == 0) return;
    for (uint32_t& index : batch.own.indices) index += static_cast<uint32_t>(base);
  }

  void writeBatch(JsonWriter& json, const BatchKey& key, const Pieces& all) {
    json.beginObject().key("look").value(key.look);
    const bool merged = key.mesh == kMerged;
    // Instances have one geometry, which each part has made for itself.
    const size_t geometries = merged ? all.size() : 1;
    const auto geometry = [&](const char* name, auto member) {
      section(
          json, name, geometries, [&](size_t i) -> auto& { return all[i]->geometry->*member; });
    };
    const auto each = [&](const char* name, auto member) {
      section(
          json, name, all.size(), [&](size_t i) -> auto& { return all[i]->*member; });
    };
    geometry("position", &DrawGeometry::positions);
    geometry("normal", &DrawGeometry::normals);
    if (!plan_.paint(lookOrder_[key.look]).look.map.empty()) geometry("uv", &DrawGeometry::uvs);
    geometry("index", &DrawGeometry::indices);
    if (!merged) each("matrix", &Batch::matrices);
    each("color", &Batch::colors);
    each("leaf", &Batch::leaves);
    json.endObject();
  }

  // The arrays of so many pieces, one behind the other.
  template <class ArrayOf>
  void section(JsonWriter& json, const char* name, size_t pieces, ArrayOf&& arrayOf) {
    size_t count = 0;
    const size_t begin = arrayBytes_;
    for (size_t i = 0; i < pieces; ++i) {
      const auto& data = arrayOf(i);
      if (data.empty()) continue;
      arrays_.emplace_back(reinterpret_cast<const char*>(data.data()),
                           data.size() * sizeof data[0]);
      arrayBytes_ += arrays_.back().size();
      count += data.size();
    }
    if (count == 0) return;
    json.key(name).beginArray().value(static_cast<uint64_t>(begin));
    json.value(static_cast<uint64_t>(count)).endArray();
  }

  const DrawPlan& plan_;
  /// By group of paints: one more than the look, 0 for not met yet.
  std::vector<uint32_t> looks_;
  std::vector<uint32_t> lookOrder_;
  std::map<BatchKey, Pieces> batches_;
  std::vector<std::string_view> arrays_;
  size_t arrayBytes_ = 0;
};

}  // namespace

std::string drawList(const Scene& scene, unsigned jobs) {
  DrawPlan plan(scene);
  const uint64_t all = plan.leaves();
  // Where only the first leaves are drawn, nobody knows how much of a batch that is.
  if (!plan.truncated()) plan.tallyBatches();
  const uint64_t most = std::max<uint64_t>(1, all / kLeavesAPart);
  const uint64_t count = jobs ? jobs : std::min<uint64_t>(defaultJobs(), most);
  std::deque<BatchBuilder> parts;
  for (uint64_t i = 0; i < count; ++i) parts.emplace_back(plan);
  WorkMeter* const meter = detail::workState.meter;
  parallelFor(parts.size(), static_cast<unsigned>(count), [&](size_t i, unsigned) {
    std::optional<WorkScope> scope;
    if (meter) scope.emplace(*meter);
    const LeafRange range{all * i / count, all * (i + 1) / count};
    forEachLeafIn(plan, {&range, 1},
                  [&](const Leaf& leaf, const Frame& world, uint64_t number, size_t) {
                    parts[i].add(leaf, world, static_cast<uint32_t>(number));
                  });
    for (auto& [key, batch] : parts[i].batches()) batch.spreadRuns();
  });
  return Joiner(plan, parts).bytes();
}

}  // namespace gable
