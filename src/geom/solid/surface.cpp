// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "geom/solid/surface.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/hash.h"
#include "base/work.h"

namespace gable::solid {

Surface::Surface(const Facets& facets, const Splits& splits, const std::vector<Piece>& pieces)
    : facets_(facets), pieces_(pieces) {
  plane_ = findPlane();
  findPlaces(splits);
  findSheets();
  findShells();
  findSides();
  findPatches();
  closeShells();
}

bool Surface::findPlane() const {
  if (facets_.list.empty()) return false;
  const Facet* widest = &facets_.list[0];
  for (const Facet& f : facets_.list) {
    if (length(f.box.size()) > length(widest->box.size())) widest = &f;
  }
  for (uint32_t v = 0; v < facets_.pool.size(); ++v) {
    if (std::fabs(widest->height(facets_.pool[v])) > facets_.pool.tolerance()) return false;
  }
  return true;
}

namespace {

std::vector<uint64_t> outlineOf(const Piece& p) {
  std::vector<uint64_t> out;
  for (const Edge& e : p.edges) out.push_back(edgeKey(e));
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

void Surface::findSheets() {
  std::vector<std::pair<uint64_t, uint32_t>> order;
  for (uint32_t p = 0; p < pieces_.size(); ++p) {
    uint64_t h = 0;
    for (const Edge& e : pieces_[p].edges) h += mix64(edgeKey(e));
    work(pieces_[p].edges.size());
    order.emplace_back(h, p);
  }
  std::sort(order.begin(), order.end());
  for (size_t i = 0; i < order.size(); ++i) {
    const uint32_t piece = order[i].second;
    bool found = false;
    for (size_t k = sheets_.size(); k-- > 0 && !found;) {
      const uint32_t other = sheets_[k].pieces[0];
      if (i == 0 || order[i - 1].first != order[i].first) break;
      work();
      if (pieces_[other].edges.size() != pieces_[piece].edges.size()) break;
      if (outlineOf(pieces_[other]) != outlineOf(pieces_[piece])) break;
      sheets_[k].pieces.push_back(piece);
      found = true;
    }
    if (!found) sheets_.push_back({{piece}, 0});
  }
  std::sort(sheets_.begin(), sheets_.end(),
            [](const Sheet& a, const Sheet& b) { return a.pieces[0] < b.pieces[0]; });
}

void Surface::findShells() {
  struct Use {
    uint32_t operand, vertex, facet;
  };
  std::vector<Use> uses;
  DisjointSets sets(facets_.list.size());
  for (const Piece& p : pieces_) {
    work(p.edges.size());
    for (const Edge& e : p.edges) uses.push_back({facets_.list[p.facet].operand, e[0], p.facet});
  }
  std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
    return std::tie(a.operand, a.vertex, a.facet) < std::tie(b.operand, b.vertex, b.facet);
  });
  for (size_t i = 1; i < uses.size(); ++i) {
    const Use &a = uses[i - 1], &b = uses[i];
    if (a.operand == b.operand && a.vertex == b.vertex) sets.join(a.facet, b.facet);
  }
  shellOf_.assign(facets_.list.size(), 0);
  for (uint32_t f = 0; f < facets_.list.size(); ++f) {
    const uint32_t root = sets.find(f);
    if (root == f) {
      shellOf_[f] = static_cast<uint32_t>(shells_.size());
      shells_.emplace_back();
      shells_.back().operand = facets_.list[f].operand;
    } else {
      shellOf_[f] = shellOf_[root];
    }
    Shell& shell = shells_[shellOf_[f]];
    shell.facets.push_back(f);
    shell.box.include(facets_.list[f].box);
  }
}

void Surface::findSides() {
  for (uint32_t s = 0; s < sheets_.size(); ++s) {
    for (const Edge& e : pieces_[sheets_[s].pieces[0]].edges) {
      sides_.push_back({edgeKey(e), s, e[0] < e[1]});
    }
  }
  work(sides_.size());
  std::sort(sides_.begin(), sides_.end(), [](const Side& a, const Side& b) {
    return std::pair(a.edge, a.sheet) < std::pair(b.edge, b.sheet);
  });
}

bool Surface::alike(const Sheet& a, const Sheet& b) const {
  if (a.pieces.size() != b.pieces.size()) return false;
  std::vector<uint32_t> of, with;
  for (const uint32_t p : a.pieces) of.push_back(shellOf(p));
  for (const uint32_t p : b.pieces) with.push_back(shellOf(p));
  std::sort(of.begin(), of.end());
  std::sort(with.begin(), with.end());
  return of == with;
}

void Surface::findPatches() {
  DisjointSets sets(sheets_.size());
  for (size_t i = 0; i < sides_.size();) {
    size_t end = i;
    while (end < sides_.size() && sides_[end].edge == sides_[i].edge) ++end;
    work(end - i);
    if (end - i == 2) {
      const uint32_t a = sides_[i].sheet, b = sides_[i + 1].sheet;
      // What divides a facet is a contact, even where it ends within the other facet.
      const bool contact =
          pieces_[sheets_[a].pieces[0]].facet == pieces_[sheets_[b].pieces[0]].facet;
      if (!contact && alike(sheets_[a], sheets_[b])) sets.join(a, b);
    }
    i = end;
  }
  for (uint32_t s = 0; s < sheets_.size(); ++s) {
    const uint32_t root = sets.find(s);
    sheets_[s].patch = root == s ? patchCount_++ : sheets_[root].patch;
  }
}

int Surface::turnsOf(const Sheet& sheet, uint32_t piece) const {
  const int turns = pieces_[piece].turns;
  if (plane_) return std::abs(turns);
  const bool same = dot(facetOf(piece).normal, facetOf(sheet.pieces[0]).normal) > 0;
  return same ? turns : -turns;
}

// A shell is closed where its pieces run along every edge as often one way as the other.
void Surface::closeShells() {
  struct Run {
    uint32_t shell;
    uint64_t edge;
    int turns;
  };
  std::vector<Run> runs;
  for (const Piece& p : pieces_) {
    work(p.edges.size());
    for (const Edge& e : p.edges) {
      runs.push_back({shellOf_[p.facet], edgeKey(e), e[0] < e[1] ? p.turns : -p.turns});
    }
  }
  std::sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) {
    return std::tie(a.shell, a.edge, a.turns) < std::tie(b.shell, b.edge, b.turns);
  });
  std::vector<std::pair<uint32_t, uint64_t>> border;
  for (size_t i = 0; i < runs.size();) {
    int sum = 0;
    const Run& first = runs[i];
    for (; i < runs.size() && runs[i].shell == first.shell && runs[i].edge == first.edge; ++i) {
      sum += runs[i].turns;
    }
    if (sum == 0) continue;
    shells_[first.shell].closed = false;
    border.emplace_back(first.shell, first.edge);
  }
  if (!border.empty()) tear(border);
}

void Surface::findPlaces(const Splits& splits) {
  FacetEdges edges;
  for (const Facet& f : facets_.list) {
    solid::edgesOf(f, splits, edges);
    for (const auto* list : {&edges.outline, &edges.inner}) {
      work(list->size());
      for (const Edge& e : *list) {
        atEdge_.emplace_back(edgeKey(e), f.operand);
        for (const uint32_t v : e) atVertex_.emplace_back(v, f.operand);
      }
    }
    for (const uint32_t v : f.points) atVertex_.emplace_back(v, f.operand);
  }
  for (auto* list : {&atVertex_, &atEdge_}) {
    std::sort(list->begin(), list->end());
    list->erase(std::unique(list->begin(), list->end()), list->end());
  }
}

// A border runs into another operand where one of its vertices lies on that and one of its edges
// there does not.
void Surface::tear(const std::vector<std::pair<uint32_t, uint64_t>>& border) {
  const auto others = [](const auto& list, uint64_t key, uint32_t operand) {
    std::vector<uint32_t> out;
    for (auto at = std::lower_bound(list.begin(), list.end(), std::pair(key, uint32_t{0}));
         at != list.end() && at->first == key; ++at) {
      work();
      if (at->second != operand) out.push_back(at->second);
    }
    return out;
  };
  for (const auto& [shell, edge] : border) {
    if (shells_[shell].torn) continue;
    const uint32_t operand = shells_[shell].operand;
    const std::vector<uint32_t> along = others(atEdge_, edge, operand);
    for (const uint64_t v : {edge >> 32, edge & 0xffffffff}) {
      const std::vector<uint32_t> at = others(atVertex_, v, operand);
      if (!std::includes(along.begin(), along.end(), at.begin(), at.end())) {
        shells_[shell].torn = true;
      }
    }
  }
}

std::vector<uint64_t> Surface::cuts() const {
  std::vector<uint64_t> out;
  for (size_t i = 1; i < atEdge_.size(); ++i) {
    const uint64_t edge = atEdge_[i].first;
    if (edge == atEdge_[i - 1].first && (out.empty() || out.back() != edge)) out.push_back(edge);
  }
  return out;
}

}  // namespace gable::solid
