// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A pattern is a sequence of sizes and groups. One that is not repeated is read as if its braces
// were not there. A sequence has a rigid length (absolute and ' sizes) and an elastic weight
// (~ sizes); a repeated group within a repetition counts as elastic, by its length once. With n
// repetitions the elastic parts are stretched by
//
//   k = (whole - rigid lengths) / elastic weights,
//
// and the best n is the one with the least |k - 1|. k falls as n grows, so only the two whole
// numbers around the n of k = 1 have to be looked at. Several repeated groups of one sequence get
// equal shares of the room, so that symmetric patterns stay symmetric.
#include "builtins/ops/subdivide/shared/split_sizes.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace gable {

namespace {

// A part of the block's items, [begin, end).
struct Range {
  size_t begin = 0, end = 0;
};

struct Extent {
  double rigid = 0;
  double elastic = 0;
  double whole() const { return rigid + elastic; }
};

// Calls size(item) for the sizes and repeated(item, inside) for the repeated groups of a sequence,
// in order; plain groups are entered.
template <class OnSize, class OnRepeat>
void walk(std::span<const SplitItem> items, Range r, OnSize&& onSize, OnRepeat&& onRepeat) {
  for (size_t i = r.begin; i < r.end; ++i) {
    const SplitItem& item = items[i];
    if (!item.group) {
      onSize(item);
    } else if (item.repeat) {
      onRepeat(Range{i + 1, i + 1 + item.length});
      i += item.length;
    }
  }
}

class Divider {
 public:
  Divider(std::span<const SplitItem> items, double whole, SplitPieces& out)
      : items_(items), whole_(whole), tolerance_(1e-9 * (1 + whole)), out_(out) {}

  // Divides [start, start + length] by a sequence.
  void sequence(Range r, double start, double length);
  void size(const SplitItem& item, double start, double length);
  // Divides it by a sequence repeated.
  void repetition(Range r, double start, double length);
  // Divides [0, length] by all items in braces: a repeated group that is the only element of a
  // sequence.
  void braces(double length);
  Status takeStatus() { return std::move(status_); }

 private:
  double rigidSize(const SplitItem& item) const {
    return std::max(0.0, item.unit == Unit::Relative ? item.size * whole_ : item.size);
  }
  // Lengths of one run through a sequence; groups repeated within it count as elastic, once.
  Extent extentOf(Range r) const {
    Extent e;
    walk(
        items_, r,
        [&](const SplitItem& item) {
          if (item.unit == Unit::Floating) {
            e.elastic += std::max(0.0, item.size);
          } else {
            e.rigid += rigidSize(item);
          }
        },
        [&](Range inner) { e.elastic += extentOf(inner).whole(); });
    return e;
  }
  // Rounding alone cuts nothing: equal parts are to stay bit-equal.
  double cut(double size, double room) const { return size <= room + tolerance_ ? size : room; }
  void place(double start, double size, double limit, uint32_t slot) {
    count();
    size = cut(size, limit - start);
    if (!(size > tolerance_)) return;
    if (out_.size() == kMaxSplitPieces) {
      failTooMany();
    } else {
      out_.push_back({start, size, slot});
    }
  }
  void failTooMany() {
    if (!status_.ok()) return;
    status_ =
        Status::failure("split-too-many",
                        "split would make more than " + std::to_string(kMaxSplitPieces) + " shapes",
                        "make the repeated sizes larger");
  }
  void failEndless() {
    if (!status_.ok()) return;
    status_ = Status::failure("split-endless", "the repeated part of this split has no length",
                              "give one of its sizes a positive value");
  }
  // Counts the work as well as the pieces: parts too small to be made still take time.
  void count() {
    if (++steps_ > 4 * kMaxSplitPieces) failTooMany();
  }
  // True when n repetitions are more than may be made.
  bool excessive(double n) {
    if (n <= kMaxSplitPieces) return false;
    failTooMany();
    return true;
  }

  struct Plan {
    // Length of an elastic weight of 1.
    double stretch = 0;
    // The room of each repeated group, and whether the number of repetitions is rounded down (-1)
    // or up (1); 0: as often as it fits, the last one cut.
    double groupRoom = 0;
    int rounding = 0;
    // 1 when nothing but the repeated groups could fill the room.
    double fewest = 0;
  };
  Plan planOf(Range r, double length);
  void repeat(Range r, const Extent& once, double n, double stretch, double start, double limit);
  // The same, made once for repetitions of one length.
  const Plan& planAsBefore(Range r, double length) {
    if (r.begin != planned_.begin || r.end != planned_.end || length != plannedLength_) {
      plan_ = planOf(r, length);
      planned_ = r;
      plannedLength_ = length;
    }
    return plan_;
  }

  std::span<const SplitItem> items_;
  double whole_;
  double tolerance_;
  SplitPieces& out_;
  uint32_t steps_ = 0;
  Status status_;
  // What was planned last; no range is empty at the end of none.
  Plan plan_;
  Range planned_{1, 0};
  double plannedLength_ = 0;
};

// Of a sequence whose elastic parts are stretched.
double lengthOf(const Extent& e, double stretch) { return e.rigid + e.elastic * stretch; }

// The badness of a stretch, by which the published examples choose: the change of a length.
double strain(double k) { return k > 0 ? std::fabs(k - 1) : HUGE_VAL; }

// How often a group is repeated when its share of the room holds `ratio` of it.
double repetitions(double ratio, bool up) {
  const double nearest = std::nearbyint(ratio);
  if (std::fabs(ratio - nearest) <= 1e-9 * (1 + std::fabs(ratio))) return std::max(0.0, nearest);
  return std::max(0.0, up ? std::ceil(ratio) : std::floor(ratio));
}

Divider::Plan Divider::planOf(Range r, double length) {
  Extent own;
  size_t groups = 0;
  double groupElastic = 0;
  walk(
      items_, r,
      [&](const SplitItem& item) {
        if (item.unit == Unit::Floating) {
          own.elastic += std::max(0.0, item.size);
        } else {
          own.rigid += rigidSize(item);
        }
      },
      [&](Range inner) {
        ++groups;
        const Extent e = extentOf(inner);
        if (!(e.whole() > 0)) failEndless();
        groupElastic += e.elastic;
      });
  Plan plan;
  const double room = std::max(0.0, length - own.rigid);
  if (groups == 0 || !status_.ok()) {
    plan.stretch = own.elastic > 0 ? room / own.elastic : 0;
    return plan;
  }
  const double share = 1.0 / static_cast<double>(groups);
  if (own.elastic + groupElastic == 0) {
    plan.groupRoom = room * share;
    return plan;
  }
  plan.fewest = own.elastic == 0 ? 1 : 0;
  double best = HUGE_VAL;
  for (const bool up : {false, true}) {
    double rigid = own.rigid, elastic = own.elastic, count = 0;
    walk(
        items_, r, [](const SplitItem&) {},
        [&](Range inner) {
          const Extent e = extentOf(inner);
          double n = repetitions((room - own.elastic) * share / e.whole(), up);
          n = std::max(n, plan.fewest);
          count = std::max(count, n);
          rigid += n * e.rigid;
          elastic += n * e.elastic;
        });
    if (excessive(count)) return plan;
    const double k = elastic > 0 ? (length - rigid) / elastic : 0;
    if (plan.rounding != 0 && !(strain(k) < best)) continue;
    best = strain(k);
    plan.stretch = std::max(0.0, k);
    plan.rounding = up ? 1 : -1;
  }
  // Repetitions are counted again with the same numbers when the parts are placed.
  plan.groupRoom = (room - own.elastic) * share;
  return plan;
}

void Divider::sequence(Range r, double start, double length) {
  count();
  if (!(length > tolerance_) || !status_.ok()) return;
  const Plan plan = planAsBefore(r, length);
  const double limit = start + length;
  double at = start;
  walk(
      items_, r,
      [&](const SplitItem& item) {
        if (!status_.ok()) return;
        const double size =
            item.unit == Unit::Floating ? std::max(0.0, item.size) * plan.stretch : rigidSize(item);
        place(at, size, limit, item.slot);
        at += size;
      },
      [&](Range inner) {
        if (!status_.ok()) return;
        const Extent e = extentOf(inner);
        if (plan.rounding == 0) {
          repetition(inner, at, cut(plan.groupRoom, limit - at));
          at += plan.groupRoom;
          return;
        }
        double n = repetitions(plan.groupRoom / e.whole(), plan.rounding > 0);
        n = std::max(n, plan.fewest);
        repeat(inner, e, n, plan.stretch, at, limit);
        at += n * lengthOf(e, plan.stretch);
      });
}

// Sequences n times over, with their elastic parts stretched.
void Divider::repeat(Range r, const Extent& once, double n, double stretch, double start,
                     double limit) {
  const double each = lengthOf(once, stretch);
  const bool single = r.end == r.begin + 1 && !items_[r.begin].group;
  for (double i = 0; i < n && status_.ok(); ++i) {
    const double begin = start + i * each, length = cut(each, limit - begin);
    if (single)
      size(items_[r.begin], begin, length);
    else
      sequence(r, begin, length);
  }
}

// A sequence of one size, which most repeated ones are.
void Divider::size(const SplitItem& item, double start, double length) {
  count();
  if (!(length > tolerance_)) return;
  const double own = item.unit == Unit::Floating ? std::max(0.0, item.size) : rigidSize(item);
  const bool stretched = item.unit == Unit::Floating && own > 0;
  place(start, stretched ? own * (length / own) : own, start + length, item.slot);
}

// As planOf() does it for such a sequence: nothing but the group could fill the room.
void Divider::braces(double length) {
  count();
  if (!(length > tolerance_)) return;
  const Range all{0, items_.size()};
  const Extent once = extentOf(all);
  if (!(once.whole() > 0)) return failEndless();
  if (once.elastic == 0) return repetition(all, 0, length);
  const double ratio = length / once.whole();
  const double fewer = std::max(1.0, repetitions(ratio, false));
  const double more = std::max(1.0, repetitions(ratio, true));
  if (excessive(more)) return;
  const auto stretchOf = [&](double n) { return (length - n * once.rigid) / (n * once.elastic); };
  const bool up = strain(stretchOf(more)) < strain(stretchOf(fewer));
  const double n = up ? more : fewer;
  repeat(all, once, n, std::max(0.0, stretchOf(n)), 0, length);
}

void Divider::repetition(Range r, double start, double length) {
  if (!(length > tolerance_) || !status_.ok()) return;
  const Extent e = extentOf(r);
  if (!(e.whole() > 0)) return failEndless();
  if (excessive(length / e.whole())) return;
  const auto n = static_cast<uint32_t>(repetitions(length / e.whole(), true));
  for (uint32_t i = 0; i < n && status_.ok(); ++i) {
    const double begin = start + i * e.whole();
    sequence(r, begin, cut(e.whole(), start + length - begin));
  }
}

}  // namespace

void mirrorPieces(SplitPieces& pieces, double whole) {
  for (SplitPiece& p : pieces) p.start = std::max(0.0, whole - p.start - p.size);
}

double overflowOf(const SplitBlock& block, double whole) {
  double sum = 0;
  for (const SplitItem& item : block.items) {
    if (block.repeat || item.repeat) return 0;
    if (item.group || item.unit == Unit::Floating) continue;
    sum += std::max(0.0, item.unit == Unit::Relative ? item.size * whole : item.size);
  }
  return sum - whole;
}

namespace {

Status divide(const SplitBlock& block, double whole, SplitPieces& out) {
  bool finite = std::isfinite(whole);
  for (const SplitItem& item : block.items) {
    if (!item.group) finite &= std::isfinite(item.size);
  }
  if (!finite) {
    return Status::failure("split-size-number", "a size of this split is not a finite number",
                           "check the expression for a division by zero");
  }
  Divider divider(block.items, whole, out);
  if (block.repeat)
    divider.braces(whole);
  else
    divider.sequence({0, block.items.size()}, 0, whole);
  return divider.takeStatus();
}

}  // namespace

Status dividePattern(const SplitBlock& block, double whole, SplitPieces& out) {
  SplitMemo* memo = block.memo;
  if (memo && memo->known && memo->whole == whole) {
    out.assign(memo->pieces);
    return {};
  }
  Status status = divide(block, whole, out);
  if (memo && status.ok() && out.size() <= out.capacityHere()) {
    memo->known = true;
    memo->givenOutOf = GeometryKind::None;
    memo->whole = whole;
    memo->pieces.assign(out.begin(), out.end());
  }
  return status;
}

}  // namespace gable
