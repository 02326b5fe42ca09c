// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "shape/provenance.h"

#include "base/hash.h"

namespace gable {

uint64_t EdgeProvenance::hash() const {
  uint64_t h = hashCombine(hashCombine(level, logical), static_cast<uint64_t>(role));
  for (const PeelMark& p : peels) {
    h = hashCombine(h, uint64_t{p.depth} << 8 | static_cast<uint64_t>(p.role));
  }
  return h;
}

uint64_t RegionProvenance::hash() const {
  if (!cell) return depth;
  const CellMark& c = *cell;
  uint64_t h = hashCombine(depth, 1);
  for (const uint32_t v : {c.ix, c.iy, c.nx, c.ny, c.part, c.choice}) h = hashCombine(h, v);
  h = hashCombine(hashCombine(h, hashDouble(c.w)), hashDouble(c.h));
  return hashCombine(
      h, static_cast<uint64_t>(c.pattern) << 2 | (c.free ? 2 : 0) | (c.symmetric ? 1 : 0));
}

uint32_t CellMark::turns() const {
  if (pattern != CellPattern::Radial || free) return 0;
  return iy % 2 == 0 ? ix % 2 : 3 - ix % 2;
}

uint32_t CellMark::side(uint32_t k) const {
  if (mirroredX() && k % 2 == 0) k = 2 - k;
  if (mirroredY() && k % 2 == 1) k = 4 - k;
  return (k + 4 - turns()) % 4;
}

bool CellMark::address(double& u, double& v) const {
  if (free) return true;
  if (!along(false, u) || !along(true, v)) return false;
  for (uint32_t t = turns(); t > 0; --t) {
    const double before = u;
    u = 1 - v;
    v = before;
  }
  return true;
}

bool CellMark::mirrored(uint32_t i, uint32_t n) const {
  if (free) return false;
  switch (pattern) {
    case CellPattern::Local:
    case CellPattern::Radial: return false;
    case CellPattern::Pair: return i % 2 == 1;
    case CellPattern::Auto:
      if (n % 2 == 0) return i % 2 == 1;
      break;
    default: break;
  }
  return 2 * i >= n && !(n % 2 == 1 && i == n / 2);
}

bool CellMark::along(bool y, double& u) const {
  const uint32_t i = y ? iy : ix, n = y ? ny : nx;
  const bool middle = n % 2 == 1 && i == n / 2 && n > 1;
  const bool extend = pattern == CellPattern::Extend || pattern == CellPattern::ExtendL ||
                      pattern == CellPattern::ExtendR;
  if (extend) {
    // The address runs on over cells from the border.
    const uint32_t fromLow = i, fromHigh = n - 1 - i;
    const bool high =
        pattern == CellPattern::ExtendR || (pattern == CellPattern::Extend && fromHigh < fromLow);
    u -= high ? fromHigh : fromLow;
    if (u < 0 || u > 1) return false;
    if (high) u = 1 - u;
    return true;
  }
  if (middle && pattern != CellPattern::Local && pattern != CellPattern::Radial) {
    u = 0.5;
    return true;
  }
  if (mirrored(i, n)) u = 1 - u;
  return true;
}

}  // namespace gable
