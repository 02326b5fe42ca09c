// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The one file that knows Embree. Structures are built by one thread: with several, the order of
// primitives in a leaf, and so which of two coinciding faces wins, would change from run to run.

#include "render/tracer.h"

#include <embree3/rtcore.h>

#include <limits>
#include <vector>

namespace gable::rt {

namespace {

/// Geometry ids in every part; placements follow in the top scene.
constexpr unsigned kSolid = 0, kClear = 1, kFirstPlacement = 2;

struct ClearGeometry {
  const World* world = nullptr;
  const TriangleSet* set = nullptr;
};

/// What a shadow ray gathers on its way.
struct ShadowContext {
  RTCIntersectContext embree;
  float visibility = 1;
};

/// Lets light through clear triangles: takes its share and lets the ray go on.
void passClear(const RTCFilterFunctionNArguments* args) {
  const auto& geometry = *static_cast<const ClearGeometry*>(args->geometryUserPtr);
  if (args->valid[0] != -1) return;
  const unsigned triangle = RTCHitN_primID(args->hit, 1, 0);
  const float u = RTCHitN_u(args->hit, 1, 0), v = RTCHitN_v(args->hit, 1, 0);
  const unsigned instance = RTCHitN_instID(args->hit, 1, 0, 0);
  const uint32_t placement =
      instance == RTC_INVALID_GEOMETRY_ID ? kNone : instance - kFirstPlacement;
  const float share = clearness(*geometry.world, *geometry.set, triangle, placement, u, v);
  auto& shadow = *reinterpret_cast<ShadowContext*>(args->context);
  shadow.visibility *= share;
  if (shadow.visibility > 1e-3f) args->valid[0] = 0;
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
struct OrderContext {
  RTCIntersectContext embree;
  const World* world = nullptr;
  Vec3f direction;
  Hit best;
  bool found = false;

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

/// Looks at every hit of the ray and lets it go on.
void noteHit(const RTCFilterFunctionNArguments* args) {
  if (args->valid[0] != -1) return;
  args->valid[0] = 0;
  auto& order = *reinterpret_cast<OrderContext*>(args->context);
  const RTCHit h = rtcGetHitFromHitN(args->hit, 1, 0);
  const Hit hit = hitOf(*order.world, h, RTCRayN_tfar(args->ray, 1, 0));
  if (!order.found || order.shows(hit, order.best)) order.best = hit;
  order.found = true;
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

  explicit Impl(const World& w) : world(w) {
    device = rtcNewDevice("threads=1,set_affinity=0");
    clears.resize(world.parts.size());
    for (size_t p = 0; p < world.parts.size(); ++p) {
      RTCScene scene = rtcNewScene(device);
      rtcSetSceneFlags(scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST |
                                                         RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
      rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
      addSet(scene, world.parts[p].solid, kSolid, nullptr);
      clears[p] = {&world, &world.parts[p].clear};
      addSet(scene, world.parts[p].clear, kClear, &clears[p]);
      scenes.push_back(scene);
      if (p != 0) rtcCommitScene(scene);
    }
    for (size_t i = 0; i < world.placements.size(); ++i) addPlacement(i);
    rtcCommitScene(scenes[0]);
  }

  ~Impl() {
    for (RTCScene scene : scenes) rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }

  void addSet(RTCScene scene, const TriangleSet& set, unsigned id, ClearGeometry* clear) {
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
  // Distances to one plane differ by rounding, the more the flatter the ray meets it.
  const float cosine = std::abs(dot(normalized(hit.normal), normalized(ray.direction)));
  const float slack = (5e-5f + 1e-6f * hit.distance) / std::max(0.05f, cosine);
  OrderContext order;
  rtcInitIntersectContext(&order.embree);
  order.embree.filter = noteHit;
  order.world = &impl_->world;
  order.direction = ray.direction;
  RTCRayHit r;
  r.ray = embreeRay(ray);
  r.ray.tnear = std::max(ray.from, hit.distance - slack);
  r.ray.tfar = std::min(ray.to, hit.distance + slack);
  r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->scenes[0], &order.embree, &r);
  if (order.found) hit = order.best;
  return true;
}

float Tracer::visibility(const Ray& ray) const {
  ShadowContext context;
  rtcInitIntersectContext(&context.embree);
  RTCRay r = embreeRay(ray);
  rtcOccluded1(impl_->scenes[0], &context.embree, &r);
  return r.tfar < 0 ? 0 : context.visibility;
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
