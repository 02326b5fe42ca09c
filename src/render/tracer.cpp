// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The one file that knows Embree. How many threads build its structures depends on the world alone:
// their number may change the order of primitives in a leaf, and so which of two coinciding faces
// wins. Which thread does what changes nothing.

#include "render/tracer.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <iterator>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "base/work.h"

namespace gable::rt {

namespace {

/// Geometry ids in every part; placements follow in the top scene.
constexpr unsigned kSolid = 0, kClear = 1, kFirstPlacement = 2;

struct ClearGeometry {
  const World* world = nullptr;
  const TriangleSet* set = nullptr;
};

/// What shadow rays gather on their way, by their number.
struct ShadowContext {
  RTCIntersectContext embree;
  float* visibility = nullptr;
};

/// Lets light through clear triangles: takes its share and lets the ray go on.
void passClear(const RTCFilterFunctionNArguments* args) {
  const auto& geometry = *static_cast<const ClearGeometry*>(args->geometryUserPtr);
  auto& shadow = *reinterpret_cast<ShadowContext*>(args->context);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] != -1) continue;
    const unsigned triangle = RTCHitN_primID(args->hit, args->N, i);
    const float u = RTCHitN_u(args->hit, args->N, i), v = RTCHitN_v(args->hit, args->N, i);
    const unsigned instance = RTCHitN_instID(args->hit, args->N, i, 0);
    const uint32_t placement =
        instance == RTC_INVALID_GEOMETRY_ID ? kNone : instance - kFirstPlacement;
    float& visibility = shadow.visibility[RTCRayN_id(args->ray, args->N, i)];
    visibility *= clearness(*geometry.world, *geometry.set, triangle, placement, u, v);
    if (visibility > 1e-3f) args->valid[i] = 0;
  }
}

/// A ray as Embree wants it.
RTCRay embreeRay(const Ray& ray) {
  RTCRay r;
  r.org_x = ray.origin.x;
  r.org_y = ray.origin.y;
  r.org_z = ray.origin.z;
  r.tnear = ray.from;
  r.dir_x = ray.direction.x;
  r.dir_y = ray.direction.y;
  r.dir_z = ray.direction.z;
  r.time = 0;
  r.tfar = ray.to;
  r.mask = 0xffffffff;
  r.id = 0;
  r.flags = 0;
  return r;
}

Hit hitOf(const World& world, const RTCHit& h, float distance) {
  Hit hit;
  hit.distance = distance;
  hit.normal = {h.Ng_x, h.Ng_y, h.Ng_z};
  hit.u = h.u;
  hit.v = h.v;
  hit.triangle = h.primID;
  hit.clear = h.geomID == kClear;
  if (h.instID[0] != RTC_INVALID_GEOMETRY_ID) {
    hit.placement = h.instID[0] - kFirstPlacement;
    const Placement& p = world.placements[hit.placement];
    hit.normal = p.x * hit.normal.x + p.y * hit.normal.y + p.z * hit.normal.z;
  }
  return hit;
}

/// How far from a hit others coincide with it: distances to one plane differ by rounding, the more
/// the flatter the ray meets it.
float slackAt(float distance, const Vec3f& normal, const Vec3f& direction) {
  const float lengths = std::sqrt(dot(normal, normal) * dot(direction, direction));
  const float cosine = std::abs(dot(normal, direction));
  return (5e-5f + 1e-6f * distance) * lengths / std::max(0.05f * lengths, cosine + 1e-30f);
}

/// The nearest faces that a ray has met so far: those that coincide with the nearest of all.
class Coinciding {
 public:
  /// The ray ends there.
  void until(float end) { end_ = end; }
  /// Returns how far the ray has still to be followed. `facing`: whether the face looks at the ray.
  float note(const RTCHit& hit, float distance, float slack, bool facing) {
    end_ = std::min(end_, distance + slack);
    unsigned kept = 0;
    for (unsigned i = 0; i < count_; ++i) {
      if (met_[i].distance <= end_) met_[kept++] = met_[i];
    }
    met_[std::min(kept, kMost - 1)] = {distance, facing, hit};
    count_ = std::min(kept + 1, kMost);
    return end_;
  }

  /// The face that shows where they coincide; false where there is none.
  bool best(const World& world, Hit& hit) const {
    if (count_ == 0) return false;
    const Met* best = met_;
    for (unsigned i = 1; i < count_; ++i) {
      if (shows(met_[i], *best)) best = &met_[i];
    }
    hit = hitOf(world, best->hit, best->distance);
    return true;
  }

 private:
  static constexpr unsigned kMost = 8;
  /// Without values of their own: most are never used.
  struct Met {
    float distance;
    bool facing;
    RTCHit hit;
  };

  static bool shows(const Met& a, const Met& b) {
    if (a.facing != b.facing) return a.facing;
    // Of what is merged the number is -1, and 0 with 1 more: what is placed comes after it.
    const unsigned of = a.hit.instID[0] + 1, other = b.hit.instID[0] + 1;
    if (of != other) return of > other;
    if (a.hit.geomID != b.hit.geomID) return a.hit.geomID == kClear;
    return a.hit.primID > b.hit.primID;
  }

  float end_ = 0;
  unsigned count_ = 0;
  Met met_[kMost];
};

/// The same of rays by their number.
struct OrderContext {
  RTCIntersectContext embree;
  Coinciding* rays = nullptr;
};

/// Keeps a hit, and lets the ray go on as far as others may coincide with it.
void noteHit(const RTCFilterFunctionNArguments* args) {
  auto& order = *reinterpret_cast<OrderContext*>(args->context);
  const unsigned n = args->N;
  for (unsigned i = 0; i < n; ++i) {
    if (args->valid[i] != -1) continue;
    const RTCHit hit = rtcGetHitFromHitN(args->hit, n, i);
    // Both in the frame of the placement.
    const Vec3f normal{hit.Ng_x, hit.Ng_y, hit.Ng_z};
    const Vec3f direction{RTCRayN_dir_x(args->ray, n, i), RTCRayN_dir_y(args->ray, n, i),
                          RTCRayN_dir_z(args->ray, n, i)};
    float& end = RTCRayN_tfar(args->ray, n, i);
    const float slack = slackAt(end, normal, direction);
    end = order.rays[RTCRayN_id(args->ray, n, i)].note(hit, end, slack, dot(normal, direction) < 0);
  }
}

/// Counts the faces that a ray leaves things by, less those it enters them by.
struct WindingContext {
  RTCIntersectContext embree;
  const World* world = nullptr;
  Vec3f direction;
  int left = 0;
};

void countFace(const RTCFilterFunctionNArguments* args) {
  if (args->valid[0] != -1) return;
  args->valid[0] = 0;
  auto& winding = *reinterpret_cast<WindingContext*>(args->context);
  const RTCHit h = rtcGetHitFromHitN(args->hit, 1, 0);
  const Hit hit = hitOf(*winding.world, h, RTCRayN_tfar(args->ray, 1, 0));
  winding.left += dot(hit.normal, winding.direction) > 0 ? 1 : -1;
}

/// How many threads build the structures of large worlds. The thread sanitizer knows nothing of
/// what Embree's own threads tell each other.
#if defined(__SANITIZE_THREAD__)
constexpr int kBuilders = 1;
#elif defined(__has_feature)
constexpr int kBuilders = __has_feature(thread_sanitizer) ? 1 : 4;
#else
constexpr int kBuilders = 4;
#endif
/// In fewer triangles there is a tenth of a second to be had at most: not worth threads of its own,
/// where many small pictures are drawn at a time.
constexpr uint64_t kLargeWorld = 250'000;

RTCDevice makeDevice(const World& world) {
  uint64_t triangles = 0;
  for (const Part& part : world.parts) triangles += part.triangles();
  const int threads = triangles < kLargeWorld ? 1 : kBuilders;
  return rtcNewDevice(("set_affinity=0,threads=" + std::to_string(threads)).c_str());
}

RTCGeometry makeGeometry(RTCDevice device, const TriangleSet& set) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  // Embree reads 16 bytes at the last vertex; sets carry one vertex more than they use.
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                             set.positions.data(), 0, sizeof(Vec3f), set.positions.size() - 1);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                             set.triangles.data(), offsetof(TriangleSet::Triangle, corners),
                             sizeof(TriangleSet::Triangle), set.triangles.size());
  return geometry;
}

}  // namespace

struct Tracer::Impl {
  const World& world;
  RTCDevice device = nullptr;
  /// By part; the first is the top scene, which also holds the placements.
  std::vector<RTCScene> scenes;
  std::vector<ClearGeometry> clears;

  /// Of the thread that asks for the build, which alone asks it.
  WorkMeter* const meter = detail::workState.meter;
  const std::thread::id builder = std::this_thread::get_id();
  std::atomic<bool> stopped = false;

  // What the build has made until it is left is released by the destructor.
  explicit Impl(const World& w) : Impl(w, makeDevice(w)) { build(); }
  Impl(const World& w, RTCDevice d) : world(w), device(d), clears(w.parts.size()) {}

  void build() {
    for (size_t p = 0; p < world.parts.size(); ++p) {
      RTCScene scene = rtcNewScene(device);
      // Without RTC_SCENE_FLAG_ROBUST a ray in some millions may slip through between two
      // triangles. That is seen nowhere, for light of single paths is limited, and saves a tenth of
      // the time.
      rtcSetSceneFlags(scene, RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
      rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
      addSet(scene, world.parts[p].solid, kSolid, nullptr);
      clears[p] = {&world, &world.parts[p].clear};
      addSet(scene, world.parts[p].clear, kClear, &clears[p]);
      scenes.push_back(scene);
      if (p != 0) commit(scene);
    }
    for (size_t i = 0; i < world.placements.size(); ++i) addPlacement(i);
    commit(scenes[0]);
  }

  // No exception may pass through Embree.
  void commit(RTCScene scene) {
    const auto goesOn = [](void* impl, double) {
      auto& self = *static_cast<Impl*>(impl);
      const bool asks = std::this_thread::get_id() == self.builder;
      if (asks && !self.meter->lookAside(0)) self.stopped = true;
      return !self.stopped;
    };
    if (meter) rtcSetSceneProgressMonitorFunction(scene, goesOn, this);
    rtcCommitScene(scene);
    if (stopped) throw Unwinding(Status::failure(kWorkStopped, {}));
  }

  ~Impl() {
    for (RTCScene scene : scenes) rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }

  void addSet(RTCScene scene, const TriangleSet& set, unsigned id, ClearGeometry* clear) {
    work();
    if (set.triangles.empty()) return;
    RTCGeometry geometry = makeGeometry(device, set);
    if (clear) {
      rtcSetGeometryUserData(geometry, clear);
      rtcSetGeometryOccludedFilterFunction(geometry, passClear);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, id);
    rtcReleaseGeometry(geometry);
  }

  void addPlacement(size_t i) {
    work();
    const Placement& p = world.placements[i];
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry, scenes[p.part]);
    const float columns[12] = {p.x.x, p.x.y, p.x.z, p.y.x,      p.y.y,      p.y.z,
                               p.z.x, p.z.y, p.z.z, p.origin.x, p.origin.y, p.origin.z};
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scenes[0], geometry, kFirstPlacement + static_cast<unsigned>(i));
    rtcReleaseGeometry(geometry);
  }
};

Tracer::Tracer(const World& world) : impl_(std::make_unique<Impl>(world)) {}
Tracer::~Tracer() = default;

bool Tracer::intersect(const Ray& ray, Hit& hit) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit r;
  r.ray = embreeRay(ray);
  r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->scenes[0], &context, &r);
  if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  hit = hitOf(impl_->world, r.hit, r.ray.tfar);
  return true;
}

bool Tracer::intersectOrdered(const Ray& ray, Hit& hit) const {
  Coinciding coinciding;
  coinciding.until(ray.to);
  OrderContext order;
  rtcInitIntersectContext(&order.embree);
  order.embree.filter = noteHit;
  order.rays = &coinciding;
  RTCRayHit r;
  r.ray = embreeRay(ray);
  r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->scenes[0], &order.embree, &r);
  return coinciding.best(impl_->world, hit);
}

float Tracer::visibility(const Ray& ray) const {
  float visibility = 1;
  ShadowContext context;
  rtcInitIntersectContext(&context.embree);
  context.visibility = &visibility;
  RTCRay r = embreeRay(ray);
  rtcOccluded1(impl_->scenes[0], &context.embree, &r);
  return r.tfar < 0 ? 0 : visibility;
}

namespace {

// Embree's own way through packets of RTC_INTERSECT_CONTEXT_FLAG_COHERENT is not asked for: in 3.13
// some packets never come back from it.
constexpr size_t kPacket = Tracer::kMostTogether;

struct alignas(64) Valid {
  int lanes[kPacket];
};

template <class Packet>
void setLane(Packet& p, size_t i, const Ray& ray) {
  p.org_x[i] = ray.origin.x;
  p.org_y[i] = ray.origin.y;
  p.org_z[i] = ray.origin.z;
  p.tnear[i] = ray.from;
  p.dir_x[i] = ray.direction.x;
  p.dir_y[i] = ray.direction.y;
  p.dir_z[i] = ray.direction.z;
  p.time[i] = 0;
  p.tfar[i] = ray.to;
  p.mask[i] = 0xffffffff;
  p.id[i] = static_cast<unsigned>(i);
  p.flags[i] = 0;
}

Valid validLanes(std::span<const Ray> rays) {
  Valid valid;
  for (size_t i = 0; i < kPacket; ++i) {
    valid.lanes[i] = i < rays.size() && rays[i].from < rays[i].to ? -1 : 0;
  }
  return valid;
}

void clearHits(RTCHit16& hits) {
  for (size_t i = 0; i < kPacket; ++i) hits.geomID[i] = hits.instID[0][i] = kNone;
}
static_assert(kNone == RTC_INVALID_GEOMETRY_ID);

}  // namespace

uint32_t Tracer::intersectTogether(std::span<const Ray> rays, Hit* hits) const {
  RTCRayHit16 packet;
  const Valid valid = validLanes(rays);
  for (size_t i = 0; i < kPacket; ++i) setLane(packet.ray, i, i < rays.size() ? rays[i] : Ray());
  clearHits(packet.hit);
  Coinciding coinciding[kPacket];
  for (size_t i = 0; i < rays.size(); ++i) coinciding[i].until(rays[i].to);
  OrderContext order;
  rtcInitIntersectContext(&order.embree);
  order.embree.filter = noteHit;
  order.rays = coinciding;
  rtcIntersect16(valid.lanes, impl_->scenes[0], &order.embree, &packet);
  uint32_t found = 0;
  for (size_t i = 0; i < rays.size(); ++i) {
    if (coinciding[i].best(impl_->world, hits[i])) found |= 1u << i;
  }
  return found;
}

void Tracer::visibilityTogether(std::span<const Ray> rays, float* shares) const {
  RTCRay16 packet;
  const Valid valid = validLanes(rays);
  for (size_t i = 0; i < kPacket; ++i) setLane(packet, i, i < rays.size() ? rays[i] : Ray());
  float visibility[kPacket];
  std::fill(std::begin(visibility), std::end(visibility), 1.0f);
  ShadowContext context;
  rtcInitIntersectContext(&context.embree);
  context.visibility = visibility;
  rtcOccluded16(valid.lanes, impl_->scenes[0], &context.embree, &packet);
  for (size_t i = 0; i < rays.size(); ++i) {
    shares[i] = valid.lanes[i] != 0 && packet.tfar[i] < 0 ? 0 : visibility[i];
  }
}

bool Tracer::isInside(const Vec3f& point, const Vec3f& direction) const {
  WindingContext winding;
  rtcInitIntersectContext(&winding.embree);
  winding.embree.filter = countFace;
  winding.world = &impl_->world;
  winding.direction = direction;
  Ray ray;
  ray.origin = point;
  ray.direction = direction;
  RTCRayHit r;
  r.ray = embreeRay(ray);
  r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->scenes[0], &winding.embree, &r);
  return winding.left > 0;
}

}  // namespace gable::rt
