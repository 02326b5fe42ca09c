// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/key_hash.h"

namespace gable {

void KeyHash::add(const ShapeExtra& extra) {
  add(uint64_t{extra.trim.size()});
  for (const TrimPlane& t : extra.trim) {
    add(t.normal);
    add(t.distance);
    add(uint64_t{t.horizontal});
  }
  for (const UvProjection& p : extra.projections) {
    add(static_cast<uint64_t>(p.set) + 1);
    add(p.frame);
    for (double v : {p.width, p.height, p.offsetU, p.offsetV, p.uwFactor}) add(v);
  }
  add(uint64_t{extra.deformed});
  if (!extra.deformed) return;
  const Deformation& d = extra.deformation;
  for (const Affine* a : {&d.near, &d.far}) {
    for (const Vec3* v : {&a->x, &a->y, &a->z, &a->origin}) add(*v);
  }
  add(d.front);
  add(d.top);
}

}  // namespace gable
