// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// LeafMerger: takes the leaves of all workers over into the scene, and numbers what they refer to
// as it first meets it. Leaves are most of a scene, so with several workers they are taken over on
// a thread of its own, while merge() walks on through the prototypes.
#pragma once

#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <unordered_map>
#include <vector>

#include "runtime/output.h"

namespace gable {

/// Writes the leaves, meshes, materials, names, sources and attribute sets of the scene; nothing
/// else may use them before finish().
class LeafMerger {
 public:
  /// All must outlive it. The leaves of a single worker stay where they are, unless leaves of the
  /// scene before are put between them. `most`: so many leaves at most will be added.
  LeafMerger(std::vector<Output>& outputs, const MergeInput& input, Scene& scene, size_t most);
  ~LeafMerger();
  LeafMerger(const LeafMerger&) = delete;
  LeafMerger& operator=(const LeafMerger&) = delete;

  /// Some leaves that follow each other in what a worker made or, where the worker's number is that
  /// behind the last, in the scene before.
  struct Range {
    uint32_t worker = 0, first = 0, count = 0;
    /// Those of the scene before with the one set of attributes get the other.
    uint32_t attributesBefore = 0, attributesNow = 0;
  };
  /// The next prototype of the scene, and leaves of it; more of its leaves may follow.
  void addPrototype(StringId name, const Range& leaves);
  void addLeaves(const Range& leaves);
  /// The next root of the scene. The name must outlive the merger.
  void addRoot(const std::string& name);
  /// Returns when all is taken over, and gives the scene's prototypes and roots their names.
  /// What a thread of its own meets (memory that is refused) is thrown here.
  void finish();

  /// After finish():
  bool allAttributes() const { return !attributesFull(); }
  void explain(Recall& recall) const;

 private:
  struct Item {
    const std::string* root = nullptr;
    uint32_t prototypeName = kNoName;
    Range leaves;
  };
  static constexpr uint32_t kNoName = 0xffffffff;
  struct Worker {
    std::vector<uint32_t> meshes, materials;
  };
  /// By number in the scene before.
  struct Before {
    std::vector<uint32_t> meshes, materials, names, sources, attributes;
  };

  void start();
  void put(const Item& item);
  void handOver();
  void makeRoom();
  void takeAll() noexcept;
  void take(const Item& item);
  void takeLeaves(const Range& range);
  void renumber(Leaf& leaf, uint32_t worker);
  void renumberTaken(Leaf& leaf, const Range& range);
  bool staysInPlace() const { return outputs_.size() == 1 && !input_.before; }
  uint32_t meshNumber(const MeshRef& mesh);
  uint32_t materialsNumber(uint64_t pair);
  uint32_t materialNumber(MaterialId id);
  uint32_t nameNumber(StringId id);
  uint32_t sourceNumber(uint32_t instruction);
  uint32_t attributesNumber(uint32_t set);
  uint32_t attributeNumber(const AttributePool::Entry& entry);
  SourcePlace placeOf(uint32_t instruction) const;
  uint64_t bytesOf(const Value& v) const;
  bool attributesFull() const { return attributeBytes_ > input_.mostAttributeBytes; }

  std::vector<Output>& outputs_;
  const MergeInput& input_;
  Scene& scene_;

  // What is handed over, and how that stands.
  std::vector<Item> batch_;
  size_t leavesOfBatch_ = 0, leavesHandedOver_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::vector<Item>> waiting_;
  bool complete_ = false, done_ = false;
  std::atomic<bool> abandoned_{false};
  /// How many leaves the thread has written.
  std::atomic<size_t> taken_{0};
  std::exception_ptr thrown_;
  std::thread thread_;

  // Of who takes over.
  std::vector<Worker> workers_;
  Before before_;
  /// By prototype and root of the scene.
  std::vector<uint32_t> prototypeNames_, rootNames_;
  /// What was asked for last, and its number.
  std::pair<uint32_t, uint32_t> lastName_{kNoName, 0}, lastSource_{kNoName, 0},
      lastAttributes_{kNoName, 0};
  uint64_t attributeBytes_ = 0;
  KeyNumbers meshNumbers_, valueNumbers_;
  std::unordered_map<uint64_t, uint32_t> listNumbers_;
  std::unordered_map<uint32_t, uint32_t> materialNumbers_, nameNumbers_, sourceNumbers_,
      attributeNumbers_;
};

}  // namespace gable
