// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Room: which of the shapes that ask for room get it (`ifFree`).
//
// In the first pass of a derivation each worker collects claims: shapes that ask, and labelled
// shapes, which stand in the way of those that ask for room in a group of that name. A shape that
// asks goes both ways in that pass, with room and without; what comes of either way holds only if
// that way is the one. Between the passes a RoomPlan answers all claims, one after the other:
// by rank, then in the order of the initial shapes, then in path order. A claim gets room where it
// collides with none that has it. In the second pass shapes are found again by their places.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/diagnostic.h"
#include "runtime/room_tree.h"
#include "runtime/room_volume.h"
#include "shape/services.h"

namespace gable {

/// Where a shape stands in the tree of its initial shape: the numbers of the activations from the
/// root down; a prefix marks an ancestor. They are the same in both passes.
using PlacePath = std::vector<uint32_t>;

/// One of the two ways of a claim, as 2 * claim + (1 for the way with room); or always.
using RoomCondition = uint32_t;
inline constexpr RoomCondition kAlways = 0xffffffff;
inline RoomCondition conditionOf(uint32_t claim, bool room) { return 2 * claim + (room ? 1 : 0); }

/// The claims that one worker meets.
class RoomClaims {
 public:
  struct Claim {
    uint32_t initialShape = 0;
    /// When it is made at all.
    RoomCondition condition = kAlways;
    /// A label only stands in the way.
    bool asks = false, byHeight = true;
    /// The block says what becomes of a shape without room.
    bool hasOtherwise = false;
    StringId group = 0;
    double clearance = 0, rank = 0;
    /// The call, for messages.
    Span span;
    /// Of its scope in the world.
    Vec3 origin, size;
    uint32_t pathBegin = 0, pathEnd = 0;
  };

  /// Gives its number. Its volume has the same. Paths come in ascending order.
  uint32_t add(Claim claim, const PlacePath& path, const Shape& s, const Frame& world);
  uint32_t count() const { return static_cast<uint32_t>(claims_.size()); }
  const Claim& claim(uint32_t number) const { return claims_[number]; }
  void goesOnOtherwise(uint32_t number) { claims_[number].hasOtherwise = true; }
  std::span<const uint32_t> path(const Claim& c) const {
    return std::span(paths_).subspan(c.pathBegin, c.pathEnd - c.pathBegin);
  }
  const RoomVolumes& volumes() const { return volumes_; }
  void forgetVolumes() { volumes_ = {}; }

 private:
  std::vector<Claim> claims_;
  std::vector<uint32_t> paths_;
  RoomVolumes volumes_;
};

/// How many of a group had room.
struct RoomCount {
  StringId group = 0;
  /// The call of the first that had none.
  Span span;
  /// `lost` are those dropped for which the block has no `otherwise`.
  uint64_t kept = 0, dropped = 0, lost = 0;
};

/// The answers to all claims. Any number of threads may ask at once.
class RoomPlan {
 public:
  /// The claims of each worker. O(n log n) where few boxes meet that do not collide.
  explicit RoomPlan(std::vector<RoomClaims> workers);

  /// Unknown for a shape that did not ask in the first pass, or not so.
  Room answer(uint32_t initialShape, const PlacePath& path, const Vec3& origin,
              const Vec3& size) const;
  /// Whether what a worker met on that condition comes to be.
  bool holds(size_t worker, RoomCondition condition) const;
  /// In the order in which they first ask. Those that were never made are not counted.
  const std::vector<RoomCount>& counts() const { return counts_; }
  /// Gives the memory of the answers back, which nobody may ask for any more; the counts stay.
  void forgetAnswers();

 private:
  enum class State : uint8_t { NotMade, Taken, Free };
  struct Entry {
    const RoomClaims* from = nullptr;
    uint32_t local = 0;
    /// The number of the group; kNoGroup for a label that nobody asks about.
    uint32_t group = 0;
    uint32_t item = 0;
    State state = State::NotMade;
    const RoomClaims::Claim& claim() const { return from->claim(local); }
    std::span<const uint32_t> path() const { return from->path(claim()); }
    RoomVolumes::Place volume() const { return {from->volumes(), local}; }
  };
  static constexpr uint32_t kNoGroup = 0xffffffff;

  void gather();
  void makeGroups();
  std::vector<uint32_t> inOrder() const;
  bool isMade(uint32_t entry) const;
  bool hasRoom(uint32_t entry);
  void put(uint32_t entry);
  void putLabelsOf(RoomCondition condition);
  void countAnswers();
  RoomCondition conditionOfEntry(uint32_t entry) const;
  bool isUsable(uint32_t entry) const;

  std::vector<RoomClaims> workers_;
  /// In the order of the initial shapes, and of the derivation.
  std::vector<Entry> entries_;
  /// Those that ask, in ascending order of their paths within an initial shape; where those of each
  /// initial shape begin, and one behind the last.
  std::vector<uint32_t> asking_, begins_;
  /// By worker and number there: the entry.
  std::vector<std::vector<uint32_t>> entryOf_;
  struct Group {
    /// The entries that are items of the tree.
    std::vector<uint32_t> entries;
    std::vector<RoomTree> tree;
  };
  std::vector<Group> groups_;
  /// Labels that stand only on a condition, sorted by it.
  std::vector<std::pair<RoomCondition, uint32_t>> labels_;
  std::vector<RoomCount> counts_;
};

}  // namespace gable
