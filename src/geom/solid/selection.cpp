// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A patch bounds the result where what is before it and what is behind it differ. How often a
// closed shell runs around a point of the patch is a whole number on each side; the mean of both
// comes from solid angles, and the difference from the pieces of the shell that lie there.
#include "geom/solid/selection.h"

#include <algorithm>
#include <tuple>

#include "base/work.h"
#include "geom/solid/surface.h"

namespace gable::solid {
namespace {

/// Whether a point is within operand 0, within operand 1, within any.
struct Within {
  bool a = false, b = false, any = false;
};

bool contains(SolidOp op, const Within& w) {
  switch (op) {
    case SolidOp::Union: return w.a || w.b;
    case SolidOp::Subtract: return w.a && !w.b;
    case SolidOp::Intersect: return w.a && w.b;
    case SolidOp::Unify: return w.any;
  }
  return false;
}

class Selector {
 public:
  Selector(const Facets& facets, const Splits& splits, const std::vector<Piece>& pieces, SolidOp op)
      : facets_(facets), pieces_(pieces), op_(op), surface_(facets, splits, pieces) {}

  Selection run() {
    Selection out;
    out.closed = true;
    for (const Shell& s : surface_.shells()) out.closed = out.closed && s.closed;
    out.cuts = surface_.cuts();
    if (!out.closed && op_ != SolidOp::Unify) collectVotes();
    locatePatches();
    for (const Sheet& sheet : surface_.sheets()) decide(sheet, out.kept);
    return out;
  }

 private:
  struct Vote {
    uint32_t patch, shell;
    double behind;
  };

  double sizeOf(const Sheet& sheet) const {
    const Piece& p = pieces_[sheet.pieces[0]];
    const Vec3 o = facets_.pool[p.edges[0][0]];
    Vec3 area;
    double around = 0;
    for (const Edge& e : p.edges) {
      const Vec3 a = facets_.pool[e[0]], b = facets_.pool[e[1]];
      area += cross(a - o, b - o);
      around += length(b - a);
    }
    work(p.edges.size());
    return around > 0 ? length(area) / around : 0;
  }

  // Where patches meet an open shell at an edge: on which side of it they lie.
  void collectVotes() {
    const std::vector<Side>& sides = surface_.sides();
    for (size_t i = 0; i < sides.size();) {
      size_t end = i;
      while (end < sides.size() && sides[end].edge == sides[i].edge) ++end;
      for (size_t k = i; k < end; ++k) voteAt(sides, i, end, k);
      i = end;
    }
    std::sort(votes_.begin(), votes_.end(), [](const Vote& a, const Vote& b) {
      return std::tie(a.patch, a.shell, a.behind) < std::tie(b.patch, b.shell, b.behind);
    });
  }

  // The votes of all others on the open shells of one sheet.
  void voteAt(const std::vector<Side>& sides, size_t begin, size_t end, size_t at) {
    const Sheet& open = surface_.sheets()[sides[at].sheet];
    for (const uint32_t piece : open.pieces) {
      const uint32_t shell = surface_.shellOf(piece);
      const Shell& s = surface_.shells()[shell];
      if (s.closed || s.torn) continue;
      const Vec3 normal = surface_.facetOf(piece).normal;
      if (bends(sides, begin, end, shell, normal)) continue;
      for (size_t k = begin; k < end; ++k) {
        work();
        const Sheet& other = surface_.sheets()[sides[k].sheet];
        if (isOf(other, shell)) continue;
        const auto u = static_cast<uint32_t>(sides[k].edge >> 32);
        const auto v = static_cast<uint32_t>(sides[k].edge);
        const Vec3 along = facets_.pool[v] - facets_.pool[u];
        const Vec3 inward =
            cross(surface_.facetOf(other.pieces[0]).normal, sides[k].up ? along : -along);
        const double behind = -dot(inward, normal);
        if (std::fabs(behind) > 1e-6 * length(along)) {
          votes_.push_back({other.patch, shell, behind});
        }
      }
    }
  }

  bool isOf(const Sheet& sheet, uint32_t shell) const {
    return std::any_of(sheet.pieces.begin(), sheet.pieces.end(),
                       [&](uint32_t p) { return surface_.shellOf(p) == shell; });
  }

  // At its own edges a shell has no single side.
  bool bends(const std::vector<Side>& sides, size_t begin, size_t end, uint32_t shell,
             const Vec3& normal) const {
    for (size_t k = begin; k < end; ++k) {
      for (const uint32_t p : surface_.sheets()[sides[k].sheet].pieces) {
        work();
        if (surface_.shellOf(p) != shell) continue;
        if (dot(surface_.facetOf(p).normal, normal) < 1 - 1e-9) return true;
      }
    }
    return false;
  }

  bool behind(uint32_t patch, uint32_t shell, const Vec3& p) const {
    const Shell& s = surface_.shells()[shell];
    if (s.torn || op_ == SolidOp::Unify) return false;
    double sum = 0;
    bool any = false;
    auto at = std::lower_bound(votes_.begin(), votes_.end(), std::pair(patch, shell),
                               [](const Vote& v, const std::pair<uint32_t, uint32_t>& key) {
                                 return std::pair(v.patch, v.shell) < key;
                               });
    for (; at != votes_.end() && at->patch == patch && at->shell == shell; ++at) {
      sum += at->behind;
      any = true;
    }
    if (any) return sum > 0;
    return !surface_.isPlane() && windingNumber(s, facets_, p) > 0.5;
  }

  // What runs around each patch as a whole.
  void locatePatches() {
    struct Best {
      double size = -1;
      uint32_t sheet = 0;
    };
    std::vector<Best> best(surface_.patchCount());
    const std::vector<Sheet>& sheets = surface_.sheets();
    for (uint32_t k = 0; k < sheets.size(); ++k) {
      const double size = sizeOf(sheets[k]);
      if (size > best[sheets[k].patch].size) best[sheets[k].patch] = {size, k};
    }
    around_.resize(best.size());
    for (uint32_t patch = 0; patch < best.size(); ++patch) {
      const Sheet& sheet = sheets[best[patch].sheet];
      const Vec3 p = pointWithin(pieces_[sheet.pieces[0]], facets_);
      std::vector<Around>& around = around_[patch];
      for (uint32_t k = 0; k < surface_.shells().size(); ++k) {
        work();
        const Shell& s = surface_.shells()[k];
        Around a{s.operand, 0, false};
        if (s.closed) {
          if (!holds(s.box, p)) continue;
          a.twice = static_cast<int>(std::floor(2 * windingNumber(s, facets_, p) + 0.5));
        } else if (!isOf(sheet, k)) {
          a.behind = behind(patch, k, p);
        }
        if (a.twice != 0 || a.behind) around.push_back(a);
      }
    }
  }

  bool holds(const Box3& b, const Vec3& p) const {
    const double slack = facets_.pool.tolerance();
    return p.x >= b.min.x - slack && p.x <= b.max.x + slack && p.y >= b.min.y - slack &&
           p.y <= b.max.y + slack && p.z >= b.min.z - slack && p.z <= b.max.z + slack;
  }

  // By operand, for one side of a sheet.
  struct Count {
    uint32_t operand = 0;
    int twice = 0;
    bool behind = false;
  };

  Within within(const std::vector<Count>& counts) const {
    Within w;
    for (const Count& c : counts) {
      if (c.twice <= 0 && !c.behind) continue;
      w.any = true;
      if (c.operand == 0) w.a = true;
      if (c.operand == 1) w.b = true;
    }
    return w;
  }

  static Count& countOf(std::vector<Count>& counts, uint32_t operand) {
    for (Count& c : counts) {
      if (c.operand == operand) return c;
    }
    counts.push_back({operand, 0, false});
    return counts.back();
  }

  void decide(const Sheet& sheet, std::vector<Kept>& kept) const {
    std::vector<Count> front;
    for (const Around& a : around_[sheet.patch]) {
      Count& c = countOf(front, a.operand);
      c.twice += a.twice;
      c.behind = c.behind || a.behind;
      work();
    }
    std::vector<Count> back = front;
    bool closed = false;
    for (const auto& [shell, turns] : shellsOn(sheet)) {
      const Shell& s = surface_.shells()[shell];
      if (s.closed) {
        countOf(front, s.operand).twice -= turns;
        countOf(back, s.operand).twice += turns;
        closed = closed || turns != 0;
      } else if (op_ != SolidOp::Unify && turns != 0) {
        countOf(turns > 0 ? back : front, s.operand).behind = true;
      }
    }
    const bool before = contains(op_, within(front)), after = contains(op_, within(back));
    const bool openOnly = op_ == SolidOp::Unify && !closed && isOpen(sheet) && !before && !after;
    if (before == after && !openOnly) return;
    Kept k{sheet.pieces[0], before, {}};
    k.others.assign(sheet.pieces.begin() + 1, sheet.pieces.end());
    kept.push_back(std::move(k));
  }

  bool isOpen(const Sheet& sheet) const {
    return std::any_of(sheet.pieces.begin(), sheet.pieces.end(),
                       [&](uint32_t p) { return !surface_.shells()[surface_.shellOf(p)].closed; });
  }

  std::vector<std::pair<uint32_t, int>> shellsOn(const Sheet& sheet) const {
    std::vector<std::pair<uint32_t, int>> out;
    for (const uint32_t p : sheet.pieces) {
      const uint32_t shell = surface_.shellOf(p);
      const int turns = surface_.turnsOf(sheet, p);
      const auto at = std::find_if(out.begin(), out.end(),
                                   [&](const auto& pair) { return pair.first == shell; });
      if (at == out.end()) {
        out.emplace_back(shell, turns);
      } else {
        at->second += turns;
      }
    }
    return out;
  }

  struct Around {
    uint32_t operand = 0;
    /// Twice the mean winding number of a closed shell.
    int twice = 0;
    /// Behind an open shell.
    bool behind = false;
  };

  const Facets& facets_;
  const std::vector<Piece>& pieces_;
  SolidOp op_;
  Surface surface_;
  std::vector<Vote> votes_;
  std::vector<std::vector<Around>> around_;
};

}  // namespace

Selection select(const Facets& facets, const Splits& splits, const std::vector<Piece>& pieces,
                 SolidOp op) {
  return Selector(facets, splits, pieces, op).run();
}

}  // namespace gable::solid
