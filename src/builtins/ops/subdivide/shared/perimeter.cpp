// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The faces get a vertex wherever a section ends within an edge. Then each section is set back by
// itself, with all other edges standing still, the deepest first; each keeps what those before it
// have left.
#include "builtins/ops/subdivide/shared/perimeter.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/work.h"
#include "builtins/ops/shared/set_back.h"
#include "geom/region/piece.h"

namespace gable {

namespace {

// A part of a face's edge, from the corner at which it starts to the next one.
struct ChainEdge {
  uint32_t corner = 0, next = 0;
  /// Along the chain.
  double from = 0, to = 0;
};

struct Chain {
  std::vector<ChainEdge> edges;
  double length = 0;
};

Chain chainOf(const Mesh& m, double firstEdge, const std::vector<double>* mask) {
  std::vector<ChainEdge> all;
  for (const MeshLoop& loop : m.loops) {
    for (uint32_t i = 0; i < loop.cornerCount; ++i) {
      work();
      const uint32_t c = loop.firstCorner + i;
      all.push_back({c, loop.firstCorner + (i + 1) % loop.cornerCount});
    }
  }
  const auto count = static_cast<double>(all.size());
  const double turned = firstEdge - std::floor(firstEdge / count) * count;
  const auto first = std::min(static_cast<size_t>(turned), all.size() - 1);
  Chain chain;
  for (size_t k = 0; k < all.size(); ++k) {
    work();
    const size_t i = (first + k) % all.size();
    if (mask && (i >= mask->size() || (*mask)[i] == 0)) continue;
    ChainEdge e = all[i];
    e.from = chain.length;
    e.to = chain.length += length(m.at(e.next) - m.at(e.corner));
    chain.edges.push_back(e);
  }
  return chain;
}

// Which section each part of the chain belongs to.
class Sections {
 public:
  Sections(const SplitPieces& pieces, double offset, double whole)
      : whole_(whole), tolerance_(1e-9 * (1 + whole)) {
    for (uint32_t i = 0; i < pieces.size(); ++i) {
      work();
      double from = std::fmod(pieces[i].start + offset, whole);
      if (from < 0) from += whole;
      if (whole - from <= tolerance_) from = 0;
      const double to = from + pieces[i].size;
      spans_.push_back({from, std::min(to, whole), i});
      if (to > whole + tolerance_) spans_.push_back({0, to - whole, i});
    }
    std::stable_sort(spans_.begin(), spans_.end(),
                     [](const Span& a, const Span& b) { return a.from < b.from; });
  }

  /// Where sections begin and end strictly between two places, ascending.
  std::vector<double> bordersBetween(double from, double to) const {
    std::vector<double> out;
    const auto add = [&](double at) {
      if (at <= from + tolerance_ || at >= to - tolerance_) return;
      if (out.empty() || at > out.back() + tolerance_) out.push_back(at);
    };
    for (size_t i = firstEndingAfter(from); i < spans_.size() && spans_[i].from < to; ++i) {
      work();
      add(spans_[i].from);
      add(spans_[i].to);
    }
    return out;
  }
  /// The section at a place; kNoGroup for none.
  uint32_t at(double place) const {
    const size_t i = firstEndingAfter(place);
    return i < spans_.size() && spans_[i].from <= place ? spans_[i].section : kNoGroup;
  }

 private:
  struct Span {
    double from, to;
    uint32_t section;
  };
  // They do not overlap, so their ends ascend as well.
  size_t firstEndingAfter(double place) const {
    const auto at = std::partition_point(spans_.begin(), spans_.end(),
                                         [&](const Span& s) { return s.to <= place; });
    return static_cast<size_t>(at - spans_.begin());
  }

  double whole_, tolerance_;
  std::vector<Span> spans_;
};

// The mesh with a vertex wherever a section ends, and the section of each edge by its corner.
struct Divided {
  Mesh mesh;
  std::vector<uint32_t> section;
};

class Divider {
 public:
  Divider(const Mesh& m, const Chain& chain, const Sections& sections)
      : mesh_(m), chain_(chain), sections_(sections), place_(m.corners.size(), kNoGroup) {
    for (uint32_t i = 0; i < chain.edges.size(); ++i) place_[chain.edges[i].corner] = i;
  }

  Divided run() {
    for (size_t f = 0; f < mesh_.faceCount(); ++f) {
      builder_.beginFace(mesh_.faces[f].materialSlot, mesh_.faces[f].tags, mesh_.faces[f].smooth);
      for (const MeshLoop& loop : mesh_.loopsOf(f)) {
        builder_.beginLoop();
        for (uint32_t i = 0; i < loop.cornerCount; ++i) addEdge(loop.firstCorner + i);
      }
    }
    return {builder_.take(), std::move(section_)};
  }

 private:
  void addEdge(uint32_t corner) {
    work();
    uint32_t& position = positions_.try_emplace(mesh_.corners[corner], kNoGroup).first->second;
    if (position == kNoGroup) position = builder_.addPosition(mesh_.at(corner));
    if (place_[corner] == kNoGroup) return add(position, corner, corner, 0, kNoGroup);
    const ChainEdge& e = chain_.edges[place_[corner]];
    const std::vector<double> borders = sections_.bordersBetween(e.from, e.to);
    double from = e.from;
    for (size_t k = 0; k <= borders.size(); ++k) {
      const double to = k < borders.size() ? borders[k] : e.to;
      const double share = k == 0 ? 0 : (from - e.from) / (e.to - e.from);
      const uint32_t at = k == 0
                              ? position
                              : builder_.addPosition(mesh_.at(corner) +
                                                     (mesh_.at(e.next) - mesh_.at(corner)) * share);
      add(at, corner, e.next, share, sections_.at((from + to) / 2));
      from = to;
    }
  }
  // A corner between two others.
  void add(uint32_t position, uint32_t a, uint32_t b, double share, uint32_t section) {
    const uint32_t made =
        builder_.addCorner(position, mesh_.edgeTags.empty() ? 0 : mesh_.edgeTags[a]);
    for (int set = 0; set < kUvSets; ++set) {
      if (!mesh_.hasUv(set)) continue;
      const auto& uvs = mesh_.uvs[static_cast<size_t>(set)];
      builder_.setUv(made, set, uvs[a] + (uvs[b] - uvs[a]) * share);
    }
    section_.push_back(section);
  }

  const Mesh& mesh_;
  const Chain& chain_;
  const Sections& sections_;
  // By corner: its edge in the chain.
  std::vector<uint32_t> place_;
  std::map<uint32_t, uint32_t> positions_;
  MeshBuilder builder_;
  std::vector<uint32_t> section_;
};

// One face: the polygons of its sections, and of what remains. Tags are kept in a table, and the
// source of a polygon's edge is its place there.
class FaceParts {
 public:
  FaceParts(const Divided& divided, size_t face, const Services& services)
      : divided_(divided),
        face_(face),
        plane_(std::make_unique<PatchPlane>(divided.mesh, face)),
        services_(services),
        tags_(services, "setback") {}

  /// The sections at this face, the deepest first.
  std::vector<uint32_t> sectionsByDepth(const std::vector<double>& depth) const {
    std::vector<uint32_t> out;
    for (const uint32_t c : corners()) {
      const uint32_t s = divided_.section[c];
      if (s != kNoGroup && depth[s] > 0) out.push_back(s);
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    std::stable_sort(out.begin(), out.end(),
                     [&](uint32_t a, uint32_t b) { return depth[a] > depth[b]; });
    return out;
  }

  /// Sets a section back and keeps what no section before it has.
  Status add(uint32_t section, double depth) {
    const std::vector<uint32_t> all = corners();
    std::vector<double> distance(divided_.mesh.corners.size(), 0);
    std::vector<uint32_t> group(divided_.mesh.corners.size(), kNoGroup);
    for (const uint32_t c : all) {
      if (divided_.section[c] != section) continue;
      distance[c] = depth;
      group[c] = 0;
    }
    SetBack job(divided_.mesh, services_, true);
    const Status status = job.addFace(face_, distance, group);
    if (!status.ok()) return status;
    std::vector<RegionPiece> pieces;
    for (const PatchFace& p : job.strips(0)) pieces.push_back(pieceOf(p));
    for (const Taken& before : taken_) pieces = without(std::move(pieces), before);
    Taken taken{section, std::move(pieces), {}};
    for (const RegionPiece& p : taken.pieces) {
      for (const Vec2 v : p.polygon.outer) taken.box.include(v);
    }
    taken_.push_back(std::move(taken));
    return {};
  }

  /// The polygons of a section.
  std::vector<PatchFace> partsOf(uint32_t section) {
    std::vector<PatchFace> out;
    for (const Taken& t : taken_) {
      if (t.section != section) continue;
      for (const RegionPiece& p : t.pieces) out.push_back(patchOf(p));
    }
    return out;
  }
  /// What no section has.
  std::vector<PatchFace> remainders() {
    RegionPiece whole;
    whole.polygon = plane_->polygon();
    for (const uint32_t c : corners())
      whole.edges.push_back(origin(tags_.with(tagsOf(c), "remainder")));
    std::vector<PatchFace> out;
    if (taken_.empty()) {
      out.push_back(patchOf(whole));
      return out;
    }
    Region parts;
    EdgeSource sources[2] = {sourceOf(whole), {}};
    for (const Taken& t : taken_) {
      for (const RegionPiece& p : t.pieces) {
        parts.push_back(p.polygon);
        for (Ring& r : ringsOf(p.polygon)) sources[1].rings.push_back(std::move(r));
        sources[1].origins.insert(sources[1].origins.end(), p.edges.begin(), p.edges.end());
      }
    }
    const Region left = subtract({whole.polygon}, parts);
    const auto edges = originsOf(left, sources, origin(tags_.with(0, "side")));
    for (size_t i = 0; i < left.size(); ++i) {
      RegionPiece p;
      p.polygon = left[i];
      p.edges = edges[i];
      out.push_back(patchOf(p));
    }
    return out;
  }

 private:
  struct Taken {
    uint32_t section = 0;
    std::vector<RegionPiece> pieces;
    Box2 box;
  };

  std::vector<uint32_t> corners() const {
    std::vector<uint32_t> out;
    for (const MeshLoop& loop : divided_.mesh.loopsOf(face_)) {
      for (uint32_t i = 0; i < loop.cornerCount; ++i) {
        work();
        out.push_back(loop.firstCorner + i);
      }
    }
    return out;
  }
  uint32_t tagsOf(uint32_t corner) const {
    return divided_.mesh.edgeTags.empty() ? 0 : divided_.mesh.edgeTags[corner];
  }
  EdgeOrigin origin(uint32_t tags) {
    const auto [at, fresh] = numbers_.try_emplace(tags, static_cast<uint32_t>(table_.size()));
    if (fresh) table_.push_back(tags);
    return {at->second, EdgeRole::Kept, EdgeOrigin::kNoSide};
  }

  RegionPiece pieceOf(const PatchFace& face) {
    RegionPiece out;
    for (const PatchLoop& loop : face.patch.loops) {
      Ring ring;
      for (const PatchEdge& e : loop) {
        work();
        ring.push_back(face.plane->points[e.from]);
        out.edges.push_back(origin(e.tags));
      }
      if (&loop == &face.patch.loops.front()) {
        out.polygon.outer = std::move(ring);
      } else {
        out.polygon.holes.push_back(std::move(ring));
      }
    }
    return out;
  }

  // Sections that only touch keep their points to the bit.
  std::vector<RegionPiece> without(std::vector<RegionPiece> pieces, const Taken& other) {
    Region region;
    for (const RegionPiece& p : other.pieces) region.push_back(p.polygon);
    std::vector<RegionPiece> out;
    for (RegionPiece& p : pieces) {
      work();
      const Box2 box = bounds(p.polygon);
      const bool apart = box.min.x >= other.box.max.x || box.max.x <= other.box.min.x ||
                         box.min.y >= other.box.max.y || box.max.y <= other.box.min.y;
      const Region common = apart ? Region() : intersect({p.polygon}, region);
      const bool overlaps = std::any_of(common.begin(), common.end(), [](const Polygon& c) {
        return thickness(c) > 4 * kRegionGrid;
      });
      if (!overlaps) {
        out.push_back(std::move(p));
        continue;
      }
      for (RegionPiece& left :
           combineTraced(BooleanOp::Difference, p, region, origin(tags_.with(0, "side")))) {
        if (thickness(left.polygon) > 4 * kRegionGrid) out.push_back(std::move(left));
      }
    }
    return out;
  }

  PatchFace patchOf(const RegionPiece& piece) {
    PatchFace out{plane_.get(), {}, divided_.mesh.faces[face_].tags};
    size_t edge = 0;
    for (const Ring& ring : ringsOf(piece.polygon)) {
      PatchLoop loop;
      for (const Vec2 p : ring) {
        work();
        const uint32_t source = piece.edges[edge++].source;
        const auto [at, fresh] =
            points_.try_emplace(std::pair{p.x, p.y}, static_cast<uint32_t>(plane_->points.size()));
        if (fresh) plane_->points.push_back(p);
        loop.push_back({at->second, 0, table_[source], 0});
      }
      for (size_t i = 0; i < loop.size(); ++i) loop[i].to = loop[(i + 1) % loop.size()].from;
      out.patch.loops.push_back(std::move(loop));
    }
    return out;
  }

  const Divided& divided_;
  size_t face_;
  std::unique_ptr<PatchPlane> plane_;
  const Services& services_;
  AutoTags tags_;
  std::vector<uint32_t> table_;
  std::map<uint32_t, uint32_t> numbers_;
  std::map<std::pair<double, double>, uint32_t> points_;
  std::vector<Taken> taken_;
};

void append(std::vector<PatchFace>& to, std::vector<PatchFace> more) {
  for (PatchFace& p : more) to.push_back(std::move(p));
}

}  // namespace

struct Perimeter::State {
  const Mesh& mesh;
  const Services& services;
  Chain chain;
  Divided divided;
  std::vector<FaceParts> faces;
};

Perimeter::Perimeter(const Mesh& m, double firstEdge, const std::vector<double>* mask,
                     const Services& services)
    : state_(new State{m, services, chainOf(m, firstEdge, mask), {}, {}}) {}

Perimeter::~Perimeter() = default;

double Perimeter::length() const { return state_->chain.length; }

Status Perimeter::setBack(const SplitPieces& sections, double offset,
                          const std::vector<double>& depth) {
  State& s = *state_;
  const Sections along(sections, offset, s.chain.length);
  s.divided = Divider(s.mesh, s.chain, along).run();
  for (size_t f = 0; f < s.divided.mesh.faceCount(); ++f) {
    if (s.divided.mesh.normal(f) == Vec3{}) continue;
    s.faces.emplace_back(s.divided, f, s.services);
    for (const uint32_t section : s.faces.back().sectionsByDepth(depth)) {
      Status status = s.faces.back().add(section, depth[section]);
      if (!status.ok()) return status;
    }
  }
  return {};
}

Mesh Perimeter::section(uint32_t number) {
  std::vector<PatchFace> parts;
  for (FaceParts& f : state_->faces) append(parts, f.partsOf(number));
  return meshOfPatches(state_->divided.mesh, parts);
}

Mesh Perimeter::remainder() {
  std::vector<PatchFace> parts;
  for (FaceParts& f : state_->faces) append(parts, f.remainders());
  return meshOfPatches(state_->divided.mesh, parts);
}

}  // namespace gable
