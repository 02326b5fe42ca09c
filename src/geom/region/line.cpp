// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The polygon is cut by one line after the other, each time what is left beyond it; region/cut.h
// does the cutting. New points are found by the two points of their edge, so that both sides agree.
#include "geom/region/line.h"

#include <algorithm>
#include <cmath>

#include "base/work.h"
#include "geom/region/cut.h"

namespace gable {
namespace {

constexpr double kOnLine = 1e-9;

class LineCutter : public cut::Host {
 public:
  LineCutter(const Polygon& p, Vec2 normal) : normal_(normal) {
    face_.push_back(loopOf(p.outer));
    for (const Ring& h : p.holes) {
      if (h.size() >= 3) face_.push_back(loopOf(h));
    }
    const auto [low, high] = std::minmax_element(values_.begin(), values_.end());
    const double reach = std::max(std::fabs(*low), std::fabs(*high));
    tolerance_ = std::max(kOnLine * (*high - *low), 4e-16 * reach);
  }

  std::vector<StripPiece> run(std::span<const double> offsets) {
    std::vector<StripPiece> out;
    std::vector<cut::Face> rest{face_};
    for (uint32_t k = 0; k < offsets.size(); ++k) {
      offset_ = offsets[k];
      work();
      std::vector<cut::Face> below, above;
      for (cut::Face& f : rest) {
        if (!crosses(f)) {
          (liesBelow(f) ? below : above).push_back(std::move(f));
        } else {
          cut::cutFace(f, *this, StripPiece::kOnLine + k, below, above);
        }
      }
      for (const cut::Face& f : below) out.push_back(pieceOf(f, k));
      rest = std::move(above);
    }
    for (const cut::Face& f : rest) {
      out.push_back(pieceOf(f, static_cast<uint32_t>(offsets.size())));
    }
    return out;
  }

  std::vector<StripPiece> before(double offset) {
    offset_ = offset;
    std::vector<cut::Face> below;
    if (crosses(face_)) {
      cut::keepBelow(face_, *this, StripPiece::kOnLine, below);
    } else if (liesBelow(face_)) {
      below.push_back(std::move(face_));
    }
    std::vector<StripPiece> out;
    for (const cut::Face& f : below) out.push_back(pieceOf(f, 0));
    return out;
  }

  int side(const cut::Corner& c) const override {
    const double d = values_[c.point] - offset_;
    return std::fabs(d) <= tolerance_ ? 0 : (d < 0 ? -1 : 1);
  }
  // Along the line with the normal to its left.
  Vec2 place(const cut::Corner& c) const override {
    return {cross(points_[c.point], normal_), values_[c.point]};
  }
  cut::Corner split(const cut::Corner& a, const cut::Corner& b) override {
    // From below to above, so that neighbours that run along the edge both ways agree to the bit.
    const bool up = values_[a.point] < values_[b.point];
    const uint32_t low = up ? a.point : b.point, high = up ? b.point : a.point;
    const double t = (offset_ - values_[low]) / (values_[high] - values_[low]);
    points_.push_back(points_[low] + (points_[high] - points_[low]) * t);
    values_.push_back(offset_);
    return {static_cast<uint32_t>(points_.size() - 1), 0, a.edge};
  }

 private:
  cut::Loop loopOf(const Ring& r) {
    cut::Loop loop;
    for (const Vec2 p : r) {
      const auto i = static_cast<uint32_t>(points_.size());
      points_.push_back(p);
      values_.push_back(dot(normal_, p));
      loop.push_back({i, 0, i});
    }
    return loop;
  }

  bool crosses(const cut::Face& f) const {
    bool below = false, above = false;
    for (const cut::Loop& loop : f) {
      work(loop.size());
      for (const cut::Corner& c : loop) {
        const int s = side(c);
        below = below || s < 0;
        above = above || s > 0;
      }
    }
    return below && above;
  }

  bool liesBelow(const cut::Face& f) const {
    return std::any_of(f[0].begin(), f[0].end(), [&](const cut::Corner& c) { return side(c) < 0; });
  }

  StripPiece pieceOf(const cut::Face& f, uint32_t strip) const {
    StripPiece piece;
    piece.strip = strip;
    for (size_t l = 0; l < f.size(); ++l) {
      work(f[l].size());
      Ring ring;
      for (const cut::Corner& c : f[l]) {
        ring.push_back(points_[c.point]);
        piece.edgeOrigin.push_back(c.edge);
      }
      if (l == 0) {
        piece.polygon.outer = std::move(ring);
      } else {
        piece.polygon.holes.push_back(std::move(ring));
      }
    }
    return piece;
  }

  Vec2 normal_;
  cut::Face face_;
  std::vector<Vec2> points_;
  std::vector<double> values_;
  double tolerance_ = 0;
  double offset_ = 0;
};

}  // namespace

std::vector<StripPiece> splitIntoStrips(const Polygon& p, Vec2 normal,
                                        std::span<const double> offsets) {
  if (p.outer.size() < 3) return {};
  return LineCutter(p, normal).run(offsets);
}

std::vector<StripPiece> splitByLine(const Polygon& p, Vec2 point, Vec2 direction) {
  const Vec2 right = -perpendicular(direction);
  const double offsets[] = {dot(right, point)};
  return splitIntoStrips(p, right, offsets);
}

std::vector<StripPiece> leftOfLine(const Polygon& p, Vec2 point, Vec2 direction) {
  if (p.outer.size() < 3) return {};
  const Vec2 right = -perpendicular(direction);
  return LineCutter(p, right).before(dot(right, point));
}

}  // namespace gable
