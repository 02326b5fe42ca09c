// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Points on a surface fall on its triangles by area; points in a volume are drawn in its box until
// they lie inside. A normal distribution is drawn directly where the domain is the scope, and
// elsewhere by accepting uniform points in the proportion of its density. Each try of each point
// has an address of its own.
#include <algorithm>
#include <cmath>

#include "base/work.h"
#include "builtins/lists.h"
#include "builtins/ops/shared/refit.h"
#include "builtins/ops/subdivide/shared/parts.h"
#include "geom/mesh/face_triangles.h"
#include "geom/mesh/topology.h"
#include "math/trig.h"
#include "shape/op_call.h"

namespace gable {

namespace {

constexpr double kMostPoints = 100000;
// After so many tries the best point so far is taken.
constexpr uint32_t kTries = 64;
// Draws of a try.
constexpr uint32_t kDraws = 4;

struct Spread {
  bool gaussian = false;
  Vec3 mean;
  Vec3 deviation;
};

struct Point {
  Vec3 at;
  Vec3 normal{0, 1, 0};
};

class Draws {
 public:
  Draws(const OpCall& call, uint32_t point) : call_(call), point_(point) {}
  double unit(uint32_t attempt, uint32_t k) const { return randomUnit(address(attempt, k)); }
  double normal(uint32_t attempt, uint32_t k) const { return randomNormal(address(attempt, k)); }

 private:
  uint64_t address(uint32_t attempt, uint32_t k) const {
    return call_.randomAddress((uint64_t{point_} << 32) | (attempt * kDraws + k));
  }
  const OpCall& call_;
  uint32_t point_;
};

// The share of the greatest density; 1 for uniform spreads.
double density(const Spread& s, const Vec3& p) {
  if (!s.gaussian) return 1;
  double squares = 0;
  for (size_t a = 0; a < 3; ++a) {
    if (!(s.deviation[a] > 0)) continue;
    const double d = (p[a] - s.mean[a]) / s.deviation[a];
    squares += d * d;
  }
  return expOf(-0.5 * squares);
}

class Surface {
 public:
  explicit Surface(const Mesh& m) : mesh_(m) {
    FaceTriangulator triangulator;
    for (size_t f = 0; f < m.faceCount(); ++f) {
      work();
      triangulator.add(m, f, triangles_);
      faceOf_.resize(triangles_.size(), f);
    }
    for (const auto& t : triangles_) {
      work();
      total_ += length(cross(m.at(t[1]) - m.at(t[0]), m.at(t[2]) - m.at(t[0])));
      upTo_.push_back(total_);
    }
  }
  bool empty() const { return !(total_ > 0); }

  Point at(double which, double u, double v) const {
    const auto found = std::upper_bound(upTo_.begin(), upTo_.end(), which * total_);
    const size_t i = std::min(static_cast<size_t>(found - upTo_.begin()), triangles_.size() - 1);
    const auto& t = triangles_[i];
    const double root = std::sqrt(u);
    const Vec3 p = mesh_.at(t[0]) * (1 - root) + mesh_.at(t[1]) * (root * (1 - v)) +
                   mesh_.at(t[2]) * (root * v);
    return {p, mesh_.normal(faceOf_[i])};
  }

  // Counts the triangles above a point; exact hits of edges are rare enough to be left.
  bool contains(const Vec3& p) const {
    bool inside = false;
    for (const auto& t : triangles_) {
      work();
      const Vec3 a = mesh_.at(t[0]) - p, b = mesh_.at(t[1]) - p, c = mesh_.at(t[2]) - p;
      const double ab = a.x * b.z - a.z * b.x, bc = b.x * c.z - b.z * c.x,
                   ca = c.x * a.z - c.z * a.x;
      if ((ab > 0) != (bc > 0) || (bc > 0) != (ca > 0)) continue;
      const double sum = ab + bc + ca;
      if (sum != 0 && (a.y * bc + b.y * ca + c.y * ab) / sum > 0) inside = !inside;
    }
    return inside;
  }

 private:
  const Mesh& mesh_;
  std::vector<std::array<uint32_t, 3>> triangles_;
  std::vector<size_t> faceOf_;
  std::vector<double> upTo_;
  double total_ = 0;
};

Vec3 inBox(const Vec3& size, const Draws& draws, uint32_t attempt) {
  return {size.x * draws.unit(attempt, 0), size.y * draws.unit(attempt, 1),
          size.z * draws.unit(attempt, 2)};
}

bool within(double v, double size) { return v >= std::min(0.0, size) && v <= std::max(0.0, size); }

Point inScope(const Shape& s, const Spread& spread, const Draws& draws) {
  if (!spread.gaussian) return {inBox(s.size, draws, 0)};
  Vec3 p;
  for (uint32_t a = 0; a < 3; ++a) {
    for (uint32_t attempt = 0; attempt < kTries; ++attempt) {
      work(4);
      p[a] = spread.mean[a] + spread.deviation[a] * draws.normal(attempt, a);
      if (within(p[a], s.size[a])) break;
    }
    p[a] = std::clamp(p[a], std::min(0.0, s.size[a]), std::max(0.0, s.size[a]));
  }
  return {p};
}

Point onSurface(const Surface& surface, const Spread& spread, const Draws& draws) {
  Point best;
  double most = -1;
  for (uint32_t attempt = 0; attempt < kTries; ++attempt) {
    work(4);
    const Point p =
        surface.at(draws.unit(attempt, 0), draws.unit(attempt, 1), draws.unit(attempt, 2));
    const double d = density(spread, p.at);
    if (draws.unit(attempt, 3) < d) return p;
    if (d > most) {
      most = d;
      best = p;
    }
  }
  return best;
}

Point inVolume(const Surface& surface, const Box3& box, const Spread& spread, const Draws& draws) {
  Point best{box.center()};
  double most = -1;
  for (uint32_t attempt = 0; attempt < kTries; ++attempt) {
    work(4);
    const Vec3 p = box.min + inBox(box.size(), draws, attempt);
    if (!surface.contains(p)) continue;
    const double d = density(spread, p);
    if (draws.unit(attempt, 3) < d) return {p};
    if (d > most) {
      most = d;
      best.at = p;
    }
  }
  return best;
}

enum class Domain : uint8_t { Surface, Volume, Scope };
enum class Distribution : uint8_t { Uniform, Gaussian };

}  // namespace

template <>
struct WordsOf<Domain> {
  static constexpr const char* text = "surface volume scope";
};
template <>
struct WordsOf<Distribution> {
  static constexpr const char* text = "uniform gaussian";
};

namespace {

struct Scatter {
  Domain domain;
  double count;
  Distribution distribution;
  Word mean{"center"};
  Size deviation;
};

Spread spreadOf(const Scatter& args, const Shape& s) {
  Spread spread;
  spread.gaussian = args.distribution == Distribution::Gaussian;
  spread.mean = s.size * 0.5;
  const std::string_view at = args.mean.text;
  if (at == "left") spread.mean.x = 0;
  if (at == "right") spread.mean.x = s.size.x;
  if (at == "bottom") spread.mean.y = 0;
  if (at == "top") spread.mean.y = s.size.y;
  if (at == "back") spread.mean.z = 0;
  if (at == "front") spread.mean.z = s.size.z;
  for (size_t a = 0; a < 3; ++a) {
    const double whole = std::fabs(s.size[a]);
    spread.deviation[a] = std::fabs(args.deviation.of(whole));
  }
  return spread;
}

Ref<Mesh> pointMesh() {
  MeshBuilder b;
  const uint32_t p = b.addPosition({});
  b.addPolygon({&p, 1});
  return makeRef<Mesh>(b.take());
}

Status applyScatter(OpCall& call, const Scatter& args) {
  const Shape& s = call.shape();
  const auto count = static_cast<uint32_t>(std::max(0.0, std::floor(args.count)));
  const MeshRef mesh = meshInScope(s);
  const Surface surface(*mesh);
  const bool volume = args.domain == Domain::Volume && Topology(*mesh).closed();
  const bool scope = args.domain == Domain::Scope;
  if (!scope && surface.empty()) {
    return call.fail("no-geometry", "the shape has no surface to scatter points on",
                     "scatter in the scope, or insert a primitive first");
  }
  const Spread spread = spreadOf(args, s);
  const Box3 box = mesh->bounds();
  const Ref<Mesh> geometry = pointMesh();
  for (uint32_t i = 0; i < count; ++i) {
    work(16);
    const Draws draws(call, i);
    const Point p = scope    ? inScope(s, spread, draws)
                    : volume ? inVolume(surface, box, spread, draws)
                             : onSurface(surface, spread, draws);
    Shape child = s;
    child.scope.origin = s.scope.point(p.at);
    if (!scope && !volume) {
      Frame axes = axesWithY(straightened(p.normal), {1, 0, 0});
      axes.origin = p.at;
      child.scope = s.scope * axes;
    }
    child.size = {};
    setMesh(child, geometry, ScopeFit::Keep);
    forgetFarTrimPlanes(child);
    call.emit(std::move(child), 0, i);
  }
  return {};
}

constexpr ParamSpec kUniform[] = {
    param<&Scatter::domain>("domain", "Where the points fall."),
    param<&Scatter::count>("nPoints", "How many.").atMost(kMostPoints),
    param<&Scatter::distribution>("distributionType", "How they are spread."),
};
constexpr ParamSpec kGaussian[] = {
    param<&Scatter::domain>("domain", "Where the points fall."),
    param<&Scatter::count>("nPoints", "How many.").atMost(kMostPoints),
    param<&Scatter::distribution>("distributionType", "How they are spread.", nullptr, "gaussian"),
    param<&Scatter::mean>("scatterMean", "The middle of the cluster, as a place in the scope.",
                          "center", "center front back left right top bottom"),
    param<&Scatter::deviation>(
        "scatterStddev", "The standard deviation, in metres or as a share of the scope.", "'0.16"),
};
constexpr Signature kSignatures[] = {{kUniform}, {kGaussian}};

constexpr OpSpec kSpecs[] = {
    {"scatter", "subdivide", "Gives out points at random places on or in the shape.", kSignatures,
     typed<applyScatter>, BlockKind::Operations, kRandom},
};

}  // namespace

extern const OpList kOps_scatter;
const OpList kOps_scatter = kSpecs;

}  // namespace gable
