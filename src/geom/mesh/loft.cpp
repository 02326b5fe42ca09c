// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Each line is turned round where it runs against the one before, and begins at the point that
// makes the sum of distances to the line before least. A bridge then goes along both lines at once,
// and always takes the step on the line that is behind, by share of its length; where both are
// level it makes one face of four corners if these lie in a plane.
#include "geom/mesh/loft.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/work.h"

namespace gable {

namespace {

Vec3 middleOf(const ClosedLine& line) {
  Vec3 sum;
  for (const Vec3& p : line) sum += p;
  return sum * (1.0 / static_cast<double>(line.size()));
}

Vec3 areaNormalOf(const ClosedLine& line) {
  Vec3 sum;
  for (size_t i = 0; i < line.size(); ++i) {
    sum += cross(line[i] - line[0], line[(i + 1) % line.size()] - line[0]);
  }
  return sum;
}

/// By point, and 1 at the end: the share of the length before it.
std::vector<double> sharesOf(const ClosedLine& line) {
  std::vector<double> out{0};
  for (size_t i = 0; i < line.size(); ++i) {
    out.push_back(out.back() + length(line[(i + 1) % line.size()] - line[i]));
  }
  const double whole = out.back();
  for (size_t i = 0; i < out.size(); ++i) {
    out[i] = whole > 0 ? out[i] / whole : static_cast<double>(i) / static_cast<double>(line.size());
  }
  out.back() = 1;
  return out;
}

/// The point at a share of the length.
Vec3 pointAt(const ClosedLine& line, const std::vector<double>& shares, double at) {
  const auto next = std::upper_bound(shares.begin() + 1, shares.end() - 1, at);
  const auto i = static_cast<size_t>(next - shares.begin()) - 1;
  const double long_ = shares[i + 1] - shares[i];
  const double t = long_ > 0 ? (at - shares[i]) / long_ : 0;
  return line[i] + (line[(i + 1) % line.size()] - line[i]) * t;
}

template <class List>
void rotateTo(size_t start, List& list) {
  std::rotate(list.begin(), list.begin() + static_cast<ptrdiff_t>(start), list.end());
}

// The point to begin the line with, where it lies nearest to the one before, middles put on each
// other.
size_t beginOf(const ClosedLine& before, const ClosedLine& line) {
  const std::vector<double> shares = sharesOf(before);
  const Vec3 move = middleOf(before) - middleOf(line);
  size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (size_t start = 0; start < line.size(); ++start) {
    work(line.size());
    ClosedLine turned = line;
    rotateTo(start, turned);
    const std::vector<double> own = sharesOf(turned);
    double sum = 0;
    for (size_t i = 0; i < turned.size(); ++i) {
      const Vec3 d = pointAt(before, shares, own[i]) - turned[i] - move;
      sum += dot(d, d);
    }
    // Rounding must not choose among equals.
    if (sum < least * (1 - 1e-9)) {
      least = sum;
      best = start;
    }
  }
  return best;
}

bool isFlat(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 n = cross(c - a, d - b);
  const double size = length(c - a) + length(d - b);
  return std::fabs(dot(n, b - a)) <= 1e-9 * size * std::max(1e-300, length(n));
}

class Bridge {
 public:
  Bridge(MeshBuilder& b, bool inward) : b_(b), inward_(inward) {}

  void between(const ClosedLine& low, const std::vector<uint32_t>& lowPoints,
               const ClosedLine& high, const std::vector<uint32_t>& highPoints) {
    const std::vector<double> lows = sharesOf(low), highs = sharesOf(high);
    const size_t n = low.size(), m = high.size();
    size_t i = 0, j = 0;
    while (i < n || j < m) {
      work();
      const uint32_t a = lowPoints[i % n], b = lowPoints[(i + 1) % n];
      const uint32_t c = highPoints[(j + 1) % m], d = highPoints[j % m];
      const double nextLow = i < n ? lows[i + 1] : 2, nextHigh = j < m ? highs[j + 1] : 2;
      const bool level = i < n && j < m && std::fabs(nextLow - nextHigh) < 1e-9;
      if ((level || n == m) && i < n && j < m &&
          isFlat(low[i % n], low[(i + 1) % n], high[(j + 1) % m], high[j % m])) {
        face({a, b, c, d});
        ++i;
        ++j;
      } else if (n == m ? i == j : nextLow <= nextHigh) {
        face({a, b, d});
        ++i;
      } else {
        face({a, c, d});
        ++j;
      }
    }
  }

  void face(std::vector<uint32_t> points) {
    if (inward_) std::reverse(points.begin(), points.end());
    b_.addPolygon(points);
  }

 private:
  MeshBuilder& b_;
  bool inward_;
};

}  // namespace

Mesh loft(const std::vector<ClosedLine>& given, const LoftOptions& options) {
  if (given.size() < 2) return {};
  std::vector<ClosedLine> lines = given;
  for (size_t i = 1; i < lines.size(); ++i) {
    if (dot(areaNormalOf(lines[i]), areaNormalOf(lines[i - 1])) < 0) {
      std::reverse(lines[i].begin(), lines[i].end());
    }
    rotateTo(beginOf(lines[i - 1], lines[i]), lines[i]);
  }
  MeshBuilder b;
  std::vector<std::vector<uint32_t>> points;
  for (const ClosedLine& line : lines) {
    std::vector<uint32_t>& own = points.emplace_back();
    for (const Vec3& p : line) own.push_back(b.addPosition(p));
  }
  const Vec3 along = middleOf(lines[1]) - middleOf(lines[0]);
  Bridge bridge(b, dot(areaNormalOf(lines[0]), along) < 0);
  for (size_t i = 0; i + 1 < lines.size(); ++i) {
    bridge.between(lines[i], points[i], lines[i + 1], points[i + 1]);
  }
  if (options.around && lines.size() > 2) {
    ClosedLine first = lines.front();
    std::vector<uint32_t> firstPoints = points.front();
    const size_t start = beginOf(lines.back(), first);
    rotateTo(start, first);
    rotateTo(start, firstPoints);
    bridge.between(lines.back(), points.back(), first, firstPoints);
  } else if (options.capped) {
    std::vector<uint32_t> low = points.front();
    std::reverse(low.begin(), low.end());
    bridge.face(low);
    bridge.face(points.back());
  }
  return b.take();
}

}  // namespace gable
