// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// How it works, for the side below the cut (the other side is the same turned by 180 degrees):
// loops are broken at every corner on the cut into chains that run below it. Just under the cut,
// the ends of the chains alternate between entering and leaving the face; sorted along the cut
// (ends in one place by their slope) they pair up like brackets, whatever touches whatever. Each
// pair is joined along the cut, through all corners of the face that lie between them, so that the
// side above has the same ones. The closed chains are then nested.
#include "geom/region/cut.h"

#include <algorithm>
#include <cmath>

#include "base/work.h"
#include "geom/region/region.h"

namespace gable::cut {
namespace {

struct Item {
  Corner corner;
  Vec2 place;
  int side = 0;
  uint32_t order = 0;
};

struct Chain {
  uint32_t first = 0, count = 0;  // Corners on the cut at both ends included.
};

struct End {
  double x = 0;
  double slope = 0;  // How fast the chain goes to the right for each unit down.
  uint32_t chain = 0;
  bool starts = false;
};

class Side {
 public:
  // `sign` is +1 for the side below and -1 for the one above.
  Side(const std::vector<std::vector<Item>>& loops, const std::vector<Item>& line, int sign,
       uint32_t cutEdge)
      : sign_(sign), cutEdge_(cutEdge) {
    for (const auto& loop : loops) collect(loop);
    if (ends_.empty()) return;
    line_ = line;
    for (Item& i : line_) i.place.x *= sign;
    std::stable_sort(line_.begin(), line_.end(),
                     [](const Item& a, const Item& b) { return a.place.x < b.place.x; });
    for (const auto& loop : loops) collectLineEdges(loop);
    pairEnds();
    join();
  }

  std::vector<std::vector<Item>> takeLoops() { return std::move(done_); }

 private:
  bool isBelow(const Item& i) const { return i.side * sign_ < 0; }

  void collect(const std::vector<Item>& loop) {
    const auto n = static_cast<uint32_t>(loop.size());
    uint32_t start = n;
    bool anyBelow = false;
    for (uint32_t i = 0; i < n; ++i) {
      work();
      if (loop[i].side == 0 && start == n) start = i;
      anyBelow = anyBelow || isBelow(loop[i]);
    }
    if (!anyBelow) return;
    if (start == n) {
      done_.push_back(loop);
      return;
    }
    for (uint32_t k = 0; k < n;) {
      work();
      const uint32_t from = (start + k) % n;
      if (!isBelow(loop[(from + 1) % n])) {
        ++k;
        continue;
      }
      Chain c{static_cast<uint32_t>(items_.size()), 0};
      items_.push_back(loop[from]);
      do {
        ++k;
        items_.push_back(loop[(start + k) % n]);
      } while (items_.back().side != 0);
      c.count = static_cast<uint32_t>(items_.size()) - c.first;
      addEnds(c);
    }
  }

  void addEnds(const Chain& c) {
    const auto id = static_cast<uint32_t>(chains_.size());
    chains_.push_back(c);
    const uint32_t last = c.first + c.count - 1;
    ends_.push_back(end(c.first, c.first + 1, id, true));
    ends_.push_back(end(last, last - 1, id, false));
  }

  End end(uint32_t on, uint32_t off, uint32_t chain, bool starts) const {
    const Vec2 d = (items_[off].place - items_[on].place) * sign_;
    return {items_[on].place.x * sign_, d.y < 0 ? d.x / -d.y : 0, chain, starts};
  }

  // Edges of the input that run along the cut keep their number.
  void collectLineEdges(const std::vector<Item>& loop) {
    for (size_t i = 0; i < loop.size(); ++i) {
      work();
      const Item& a = loop[i];
      const Item& b = loop[(i + 1) % loop.size()];
      if (a.side == 0 && b.side == 0) lineEdges_.push_back(a), lineEdges_.push_back(b);
    }
  }

  uint32_t edgeBetween(uint32_t p, uint32_t q) const {
    for (size_t i = 0; i < lineEdges_.size(); i += 2) {
      work();
      const uint32_t a = lineEdges_[i].corner.point, b = lineEdges_[i + 1].corner.point;
      if ((a == p && b == q) || (a == q && b == p)) return lineEdges_[i].corner.edge;
    }
    return cutEdge_;
  }

  // From left to right a chain starts, then one ends; rounding may swap near neighbours, which the
  // bracket rule survives.
  void pairEnds() {
    std::stable_sort(ends_.begin(), ends_.end(), [](const End& a, const End& b) {
      return a.x != b.x ? a.x < b.x : a.slope < b.slope;
    });
    nextChain_.assign(chains_.size(), 0);
    std::vector<uint32_t> starts, finishes;
    for (const End& e : ends_) {
      work();
      std::vector<uint32_t>& mates = e.starts ? finishes : starts;
      if (mates.empty()) {
        (e.starts ? starts : finishes).push_back(e.chain);
        continue;
      }
      const uint32_t mate = mates.back();
      mates.pop_back();
      if (e.starts) {
        nextChain_[mate] = e.chain;
      } else {
        nextChain_[e.chain] = mate;
      }
    }
  }

  void join() {
    std::vector<bool> used(chains_.size());
    for (uint32_t first = 0; first < chains_.size(); ++first) {
      work();
      if (used[first]) continue;
      std::vector<Item> loop;
      for (uint32_t c = first; !used[c]; c = nextChain_[c]) {
        work();
        used[c] = true;
        const Chain& chain = chains_[c];
        loop.insert(loop.end(), items_.begin() + chain.first,
                    items_.begin() + chain.first + chain.count - 1);
        runAlongLine(items_[chain.first + chain.count - 1], items_[chains_[nextChain_[c]].first],
                     loop);
      }
      done_.push_back(std::move(loop));
    }
  }

  // From the end of a chain leftward to the start of the next one, which is not appended.
  void runAlongLine(const Item& from, const Item& to, std::vector<Item>& loop) const {
    if (from.corner.point == to.corner.point) return;
    const double high = from.place.x * sign_, low = to.place.x * sign_;
    loop.push_back(from);
    for (size_t i = line_.size(); i-- > 0;) {
      const Item& between = line_[i];
      if (!(between.place.x < high && between.place.x > low)) continue;
      if (between.corner.point == loop.back().corner.point) continue;
      loop.back().corner.edge = edgeBetween(loop.back().corner.point, between.corner.point);
      loop.push_back(between);
      loop.back().place.x *= sign_;
    }
    loop.back().corner.edge = edgeBetween(loop.back().corner.point, to.corner.point);
  }

  int sign_;
  uint32_t cutEdge_;
  std::vector<Item> items_, line_, lineEdges_;
  std::vector<Chain> chains_;
  std::vector<End> ends_;
  std::vector<uint32_t> nextChain_;
  std::vector<std::vector<Item>> done_;
};

// Loops with the corners on the cut put in.
std::vector<std::vector<Item>> withCutCorners(const Face& face, Host& host) {
  std::vector<std::vector<Item>> loops;
  loops.reserve(face.size());
  uint32_t order = 0;
  for (const Loop& loop : face) {
    std::vector<Item> items;
    items.reserve(loop.size() + 4);
    const int firstSide = host.side(loop[0]);
    int here = firstSide;
    for (size_t i = 0; i < loop.size(); ++i) {
      work();
      const Corner& a = loop[i];
      const Corner& b = loop[i + 1 == loop.size() ? 0 : i + 1];
      const int next = i + 1 == loop.size() ? firstSide : host.side(b);
      items.push_back({a, host.place(a), here, order++});
      if (here * next < 0) {
        const Corner c = host.split(a, b);
        items.push_back({c, host.place(c), 0, order++});
      }
      here = next;
    }
    loops.push_back(std::move(items));
  }
  return loops;
}

using ItemLoop = std::vector<Item>;

double areaOf(const ItemLoop& loop) {
  double twice = 0;
  for (size_t i = 1; i + 1 < loop.size(); ++i) {
    twice += cross(loop[i].place - loop[0].place, loop[i + 1].place - loop[0].place);
  }
  return twice / 2;
}

bool hasArea(const ItemLoop& loop, double area) {
  if (loop.size() < 3) return false;
  Box2 box;
  for (const Item& i : loop) box.include(i.place);
  const Vec2 size = box.size();
  return std::fabs(area) > 1e-12 * (size.x * size.x + size.y * size.y);
}

// Parts of a loop that visit no point twice.
void splitAtRepeatedPoints(ItemLoop loop, std::vector<ItemLoop>& out) {
  std::vector<uint32_t> points;
  for (const Item& i : loop) points.push_back(i.corner.point);
  std::sort(points.begin(), points.end());
  if (std::adjacent_find(points.begin(), points.end()) == points.end()) {
    out.push_back(std::move(loop));
    return;
  }
  ItemLoop open;
  for (const Item& item : loop) {
    work();
    const auto same = std::find_if(open.begin(), open.end(), [&](const Item& o) {
      return o.corner.point == item.corner.point;
    });
    if (same != open.end()) {
      out.emplace_back(same, open.end());
      open.erase(same, open.end());
    }
    open.push_back(item);
  }
  out.push_back(std::move(open));
}

bool holeIn(const ItemLoop& hole, const ItemLoop& outer) {
  Ring ring;
  for (const Item& i : outer) ring.push_back(i.place);
  for (size_t i = 0; i < hole.size(); ++i) {
    work();
    const Where at = locate(ring, hole[i].place);
    if (at != Where::Boundary) return at == Where::Inside;
  }
  return locate(ring, (hole[0].place + hole[1].place) * 0.5) != Where::Outside;
}

Loop cornersOf(const ItemLoop& loop) {
  Loop out;
  for (const Item& i : loop) out.push_back(i.corner);
  return out;
}

// Loops keep the start of the input where they can: they begin next to its first corner.
void startNear(ItemLoop& loop, Vec2 place) {
  size_t best = 0;
  for (size_t i = 1; i < loop.size(); ++i) {
    work();
    const Vec2 d = loop[i].place - place, e = loop[best].place - place;
    const double di = dot(d, d), db = dot(e, e);
    if (di < db || (di == db && loop[i].order < loop[best].order)) best = i;
  }
  std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(best), loop.end());
}

void nestItems(std::vector<ItemLoop> loops, std::vector<Face>& out) {
  std::vector<ItemLoop> simple;
  for (ItemLoop& l : loops) splitAtRepeatedPoints(std::move(l), simple);
  std::vector<ItemLoop> outers, holes;
  for (ItemLoop& l : simple) {
    const double area = areaOf(l);
    if (!hasArea(l, area)) continue;
    (area > 0 ? outers : holes).push_back(std::move(l));
  }
  const size_t base = out.size();
  for (const ItemLoop& o : outers) out.push_back({cornersOf(o)});
  for (const ItemLoop& h : holes) {
    size_t best = outers.size();
    for (size_t i = 0; i < outers.size(); ++i) {
      work(outers[i].size());
      if (outers.size() > 1 && !holeIn(h, outers[i])) continue;
      if (best == outers.size() || areaOf(outers[i]) < areaOf(outers[best])) best = i;
    }
    if (best < outers.size()) out[base + best].push_back(cornersOf(h));
  }
}

// Most cuts meet a loop in two places: one chain below, one above. No sorting is needed then; false
// when it is not so.
bool cutSimply(const ItemLoop& loop, uint32_t cutEdge, Face& below, Face* above) {
  size_t on[2] = {0, 0}, count = 0;
  for (size_t i = 0; i < loop.size(); ++i) {
    work(loop.size());
    if (loop[i].side != 0) continue;
    if (count == 2) return false;
    on[count++] = i;
  }
  if (count != 2) return false;
  const size_t n = loop.size();
  const int first = loop[(on[0] + 1) % n].side, second = loop[(on[1] + 1) % n].side;
  if (first * second >= 0) return false;
  for (const int k : {0, 1}) {
    const bool low = (k == 0 ? first : second) < 0;
    if (!low && !above) continue;
    ItemLoop part;
    for (size_t i = on[k]; i != on[1 - k]; i = (i + 1) % n) part.push_back(loop[i]);
    part.push_back(loop[on[1 - k]]);
    part.back().corner.edge = cutEdge;
    if (!hasArea(part, areaOf(part))) continue;
    startNear(part, loop[0].place);
    (low ? below : *above).push_back(cornersOf(part));
  }
  return true;
}

// What lies above is left out where nobody asks for it.
void cutInto(const Face& face, Host& host, uint32_t cutEdge, std::vector<Face>& below,
             std::vector<Face>* above) {
  for (const Loop& loop : face) {
    work(loop.size());
    if (loop.empty()) return;
  }
  if (face.empty()) return;
  const std::vector<ItemLoop> loops = withCutCorners(face, host);
  Face low, high;
  if (loops.size() == 1 && cutSimply(loops[0], cutEdge, low, above ? &high : nullptr)) {
    if (!low.empty()) below.push_back(std::move(low));
    if (!high.empty()) above->push_back(std::move(high));
    return;
  }
  ItemLoop line;
  for (const ItemLoop& loop : loops) {
    for (const Item& i : loop) {
      if (i.side == 0) line.push_back(i);
    }
  }
  const Vec2 start = loops[0][0].place;
  for (const int sign : {1, -1}) {
    if (sign < 0 && !above) continue;
    Side side(loops, line, sign, cutEdge);
    std::vector<ItemLoop> parts = side.takeLoops();
    for (ItemLoop& p : parts) startNear(p, start);
    nestItems(std::move(parts), sign > 0 ? below : *above);
  }
}

}  // namespace

void cutFace(const Face& face, Host& host, uint32_t cutEdge, std::vector<Face>& below,
             std::vector<Face>& above) {
  cutInto(face, host, cutEdge, below, &above);
}

void keepBelow(const Face& face, Host& host, uint32_t cutEdge, std::vector<Face>& below) {
  cutInto(face, host, cutEdge, below, nullptr);
}

void nestLoops(std::vector<Loop> loops, const Host& host, std::vector<Face>& out) {
  std::vector<ItemLoop> items;
  for (const Loop& l : loops) {
    ItemLoop il;
    for (const Corner& c : l) il.push_back({c, host.place(c), 0, 0});
    items.push_back(std::move(il));
  }
  nestItems(std::move(items), out);
}

}  // namespace gable::cut
