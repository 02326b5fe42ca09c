// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Occluders lie in a tree of boxes, halved at the median of the longest side.

#include "runtime/context.h"

#include <algorithm>
#include <limits>

#include "runtime/solid_tests.h"

namespace gable {

namespace {

struct BoxNode {
  Box3 box;
  /// Children, or for a leaf (right == 0) the range of the order.
  uint32_t left = 0, right = 0, begin = 0, end = 0;
};

bool isPrefix(const std::vector<uint32_t>& a, const std::vector<uint32_t>& b) {
  return a.size() <= b.size() && std::equal(a.begin(), a.end(), b.begin());
}

bool related(const Occluder& a, const Occluder& b) {
  return a.initialShape == b.initialShape && (isPrefix(a.path, b.path) || isPrefix(b.path, a.path));
}

bool inScope(ContextScope scope, const Occluder& o, const Occluder& asking) {
  const bool same = o.initialShape == asking.initialShape;
  return scope == ContextScope::All || (scope == ContextScope::Intra) == same;
}

}  // namespace

struct OccluderIndex::Impl {
  struct Entry {
    Occluder occluder;
    TriangleSoup soup;
  };
  std::vector<Entry> entries;
  std::vector<uint32_t> order;
  std::vector<BoxNode> nodes;

  void build() {
    order.resize(entries.size());
    for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    if (!order.empty()) buildNode(0, static_cast<uint32_t>(order.size()));
  }

  // Depth is logarithmic: each level halves the range.
  uint32_t buildNode(uint32_t begin, uint32_t end) {
    const auto number = static_cast<uint32_t>(nodes.size());
    nodes.emplace_back();
    Box3 box;
    for (uint32_t i = begin; i < end; ++i) box.include(entries[order[i]].soup.box);
    BoxNode node{box, 0, 0, begin, end};
    if (end - begin > 4 && !box.empty()) {
      const Vec3 size = box.size();
      const size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
      const uint32_t middle = (begin + end) / 2;
      std::nth_element(order.begin() + begin, order.begin() + middle, order.begin() + end,
                       [&](uint32_t a, uint32_t b) {
                         const double ca = entries[a].soup.box.center()[axis];
                         const double cb = entries[b].soup.box.center()[axis];
                         return ca != cb ? ca < cb : a < b;
                       });
      node.left = buildNode(begin, middle);
      node.right = buildNode(middle, end);
    }
    nodes[number] = node;
    return number;
  }

  // Calls visit(entry) for those whose boxes meet; stops when it says so.
  template <class Visit>
  bool anyNear(const Box3& box, Visit&& visit) const {
    std::vector<uint32_t> open;
    if (!nodes.empty()) open.push_back(0);
    while (!open.empty()) {
      const BoxNode& n = nodes[open.back()];
      open.pop_back();
      if (!meet(n.box, box)) continue;
      if (n.right != 0) {
        open.push_back(n.left);
        open.push_back(n.right);
        continue;
      }
      for (uint32_t i = n.begin; i < n.end; ++i) {
        const Entry& e = entries[order[i]];
        if (meet(e.soup.box, box) && visit(e)) return true;
      }
    }
    return false;
  }

  static bool meet(const Box3& a, const Box3& b) {
    for (size_t i = 0; i < 3; ++i) {
      if (a.min[i] > b.max[i] + kContactTolerance || b.min[i] > a.max[i] + kContactTolerance) {
        return false;
      }
    }
    return true;
  }
};

OccluderIndex::OccluderIndex(std::vector<Occluder> occluders) : impl_(std::make_unique<Impl>()) {
  for (Occluder& o : occluders) {
    TriangleSoup soup = soupOf(o.mesh);
    // Open surfaces occlude nothing, but a label can still be counted and measured to.
    if (soup.closed || o.label != 0) impl_->entries.push_back({std::move(o), std::move(soup)});
  }
  impl_->build();
}

OccluderIndex::~OccluderIndex() = default;

bool OccluderIndex::test(ContextTest test, ContextScope scope, StringId label,
                         const Occluder& asking) const {
  const TriangleSoup soup = soupOf(asking.mesh);
  return impl_->anyNear(soup.box, [&](const Impl::Entry& e) {
    if (!e.soup.closed || !inScope(scope, e.occluder, asking)) return false;
    if (label != 0 && e.occluder.label != label) return false;
    if (related(e.occluder, asking)) return false;
    switch (test) {
      case ContextTest::Inside: return insideSolid(soup, e.soup);
      case ContextTest::Overlaps: return overlapsSolid(soup, e.soup);
      default: return touchesSolid(soup, e.soup);
    }
  });
}

double OccluderIndex::minimumDistance(ContextScope scope, StringId label,
                                      const Occluder& asking) const {
  double best = std::numeric_limits<double>::infinity();
  for (const Impl::Entry& e : impl_->entries) {
    const Occluder& o = e.occluder;
    if (label == 0 || o.label != label || !inScope(scope, o, asking)) continue;
    best = std::min(best, boxDistance(o.scope, o.size, asking.scope, asking.size));
  }
  return best;
}

size_t OccluderIndex::count(ContextScope scope, StringId label, const Occluder& asking) const {
  return static_cast<size_t>(
      std::count_if(impl_->entries.begin(), impl_->entries.end(), [&](const Impl::Entry& e) {
        return e.occluder.label == label && inScope(scope, e.occluder, asking);
      }));
}

namespace {

// What an order goes by, least first.
double orderKey(ContextOrder order, const Mesh& m) {
  const Box3 box = m.bounds();
  switch (order) {
    case ContextOrder::Northernmost: return box.min.z;
    case ContextOrder::Southernmost: return -box.max.z;
    case ContextOrder::Easternmost: return -box.max.x;
    case ContextOrder::Westernmost: return box.min.x;
    case ContextOrder::Highest: return -box.max.y;
    case ContextOrder::Lowest: return box.min.y;
    case ContextOrder::LargestArea: return -m.area();
    case ContextOrder::SmallestArea: return m.area();
  }
  return 0;
}

}  // namespace

size_t OccluderIndex::rank(ContextScope scope, StringId label, ContextOrder order,
                           const Occluder& asking) const {
  // The asking shape may itself be among the labelled ones, with the rounding of another path.
  const double key = orderKey(order, asking.mesh) - kContactTolerance;
  return static_cast<size_t>(
      std::count_if(impl_->entries.begin(), impl_->entries.end(), [&](const Impl::Entry& e) {
        return e.occluder.label == label && inScope(scope, e.occluder, asking) &&
               orderKey(order, e.occluder.mesh) < key;
      }));
}

}  // namespace gable
