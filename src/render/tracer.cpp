// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The one file that knows Embree. Structures are built by one thread: with several, the order of
// primitives in a leaf, and so which of two coinciding faces wins, would change from run to run.

#include "render/tracer.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <iterator>
#include <limits>
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

/// What a ray gathers among coinciding faces.
struct Coinciding {
  Vec3f direction;
  Hit best;
  bool found = false;

  void note(const Hit& hit) {
    if (!found || shows(hit, best)) best = hit;
    found = true;
  }

 private:
  /// Whether `a` shows where `a` and `b` coincide.
  bool shows(const Hit& a, const Hit& b) const {
    const bool af = dot(a.normal, direction) < 0, bf = dot(b.normal, direction) < 0;
    if (af != bf) return af;
    // kNone + 1 is 0: what is placed comes after what is merged.
    if (a.placement != b.placement) return a.placement + 1 > b.placement + 1;
    if (a.clear != b.clear) return a.clear;
    return a.triangle > b.triangle;
  }
};

/// The same of rays by their number.
struct OrderContext {
  RTCIntersectContext embree;
  const World* world = nullptr;
  Coinciding* rays = nullptr;
};

/// Looks at every hit of a ray and lets it go on.
void noteHit(const RTCFilterFunctionNArguments* args) {
  auto& order = *reinterpret_cast<OrderContext*>(args->context);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] != -1) continue;
    args->valid[i] = 0;
    const RTCHit h = rtcGetHitFromHitN(args->hit, args->N, i);
    const Hit hit = hitOf(*order.world, h, RTCRayN_tfar(args->ray, args->N, i));
    order.rays[RTCRayN_id(args->ray, args->N, i)].note(hit);
  }
}

/// How far from a hit others coincide with it: distances to one plane differ by rounding, the more
/// the flatter the ray meets it.
float slackAt(const Ray& ray, const Hit& hit) {
  const float cosine = std::abs(dot(normalized(hit.normal), normalized(ray.direction)));
  return (5e-5f + 1e-6f * hit.distance) / std::max(0.05f, cosine);
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

RTCGeometry makeGeometry(RTCDevice device, const TriangleSet& set) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  // Embree reads 16 bytes at the last vertex; sets carry one vertex more than they use.
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                             set.positions.data(), 0, sizeof(Vec3f), set.positions.size() - 1);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                             set.corners.data(), 0, sizeof(set.corners[0]), set.corners.size());
  return geometry;
}

}  // namespace

struct Tracer::Impl {
  const World& world;
  RTCDevice device = nullptr;
  /// By part; the first is the top scene, which also holds the placements.
  std::vector<RTCScene> scenes;
  std::vector<ClearGeometry> clears;

  /// Of the thread that builds.
  WorkMeter* const meter = detail::workState.meter;
  bool stopped = false;

  // What the build has made until it is left is released by the destructor.
  explicit Impl(const World& w) : Impl(w, rtcNewDevice("threads=1,set_affinity=0")) { build(); }
  Impl(const World& w, RTCDevice d) : world(w), device(d), clears(w.parts.size()) {}

  void build() {
    for (size_t p = 0; p < world.parts.size(); ++p) {
      RTCScene scene = rtcNewScene(device);
      rtcSetSceneFlags(scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST |
                                                         RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
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
      self.stopped = self.stopped || !self.meter->lookAside(0);
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
    if (set.corners.empty()) return;
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
  if (!intersect(ray, hit)) return false;
  const float slack = slackAt(ray, hit);
  Coinciding coinciding{ray.direction, {}, false};
  OrderContext order;
  rtcInitIntersectContext(&order.embree);
  order.embree.filter = noteHit;
  order.world = &impl_->world;
  order.rays = &coinciding;
  RTCRayHit r;
  r.ray = embreeRay(ray);
  r.ray.tnear = std::max(ray.from, hit.distance - slack);
  r.ray.tfar = std::min(ray.to, hit.distance + slack);
  r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->scenes[0], &order.embree, &r);
  if (coinciding.found) hit = coinciding.best;
  return true;
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
  Valid valid = validLanes(rays);
  for (size_t i = 0; i < kPacket; ++i) setLane(packet.ray, i, i < rays.size() ? rays[i] : Ray());
  clearHits(packet.hit);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect16(valid.lanes, impl_->scenes[0], &context, &packet);

  Coinciding coinciding[kPacket];
  uint32_t found = 0;
  for (size_t i = 0; i < rays.size(); ++i) {
    if (valid.lanes[i] == 0 || packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) {
      valid.lanes[i] = 0;
      continue;
    }
    found |= 1u << i;
    const RTCHit h = rtcGetHitFromHitN(reinterpret_cast<RTCHitN*>(&packet.hit), kPacket,
                                       static_cast<unsigned>(i));
    hits[i] = hitOf(impl_->world, h, packet.ray.tfar[i]);
    coinciding[i].direction = rays[i].direction;
    const float slack = slackAt(rays[i], hits[i]);
    packet.ray.tnear[i] = std::max(rays[i].from, hits[i].distance - slack);
    packet.ray.tfar[i] = std::min(rays[i].to, hits[i].distance + slack);
  }
  if (found == 0) return 0;
  clearHits(packet.hit);
  OrderContext order;
  rtcInitIntersectContext(&order.embree);
  order.embree.filter = noteHit;
  order.world = &impl_->world;
  order.rays = coinciding;
  rtcIntersect16(valid.lanes, impl_->scenes[0], &order.embree, &packet);
  for (size_t i = 0; i < rays.size(); ++i) {
    if (coinciding[i].found) hits[i] = coinciding[i].best;
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
