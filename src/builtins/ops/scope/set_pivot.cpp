// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Corners are numbered 0..3 around the bottom from the origin by way of +x, and 4..7 above them.
// The word fixes which new axis lies along the old y axis; all new axes point into the scope, so
// that the handedness leaves one choice for the other two.

#include "builtins/lists.h"
#include "builtins/ops/shared/frames.h"
#include "shape/op_call.h"

namespace gable {

namespace {

struct Corner {
  bool x, y, z;
};
constexpr Corner kCorners[8] = {{false, false, false}, {true, false, false}, {true, false, true},
                                {false, false, true},  {false, true, false}, {true, true, false},
                                {true, true, true},    {false, true, true}};

// The last two are the words of CGA before 2010.1.
enum class AxisMap : uint8_t { Xyz, Yzx, Zxy, YUp, ZUp };

}  // namespace

template <>
struct WordsOf<AxisMap> {
  static constexpr const char* text = "xyz yzx zxy yUp zUp";
};

namespace {

struct SetPivot {
  AxisMap axes;
  double corner;
};

Status applySetPivot(OpCall& call, const SetPivot& args) {
  Shape& s = call.shape();
  const Corner& corner = kCorners[static_cast<size_t>(args.corner)];
  const Vec3 at{corner.x ? s.size.x : 0, corner.y ? s.size.y : 0, corner.z ? s.size.z : 0};
  const auto inward = [](const Vec3& axis, bool far, double size) {
    return far != (size < 0) ? -axis : axis;
  };
  const Vec3 x = inward(s.scope.x, corner.x, s.size.x);
  const Vec3 y = inward(s.scope.y, corner.y, s.size.y);
  const Vec3 z = inward(s.scope.z, corner.z, s.size.z);

  // With x, y, z right-handed the cyclic orders are; else the two axes beside y change places.
  const bool right = dot(cross(x, y), z) > 0;
  const Vec3 a = right ? x : z, c = right ? z : x;
  const Vec3 origin = s.scope.point(at);
  Frame pivot = Frame::of(origin, a, y, c);
  const bool zUp = args.axes == AxisMap::Yzx || args.axes == AxisMap::ZUp;
  if (zUp) pivot = Frame::of(origin, c, a, y);
  if (args.axes == AxisMap::Zxy) pivot = Frame::of(origin, y, c, a);
  realignScope(s, pivot);
  s.pivot = s.scope;
  return {};
}

constexpr ParamSpec kParams[] = {
    param<&SetPivot::axes>(
        "axisMap",
        "Which new axis runs along the old y axis: the second (xyz), the third (yzx) or the first "
        "(zxy). Old: yUp for xyz, zUp for yzx."),
    param<&SetPivot::corner>(
        "cornerIndex",
        "The corner of the scope, 0 to 3 around the bottom from the origin along x, 4 to 7 above.")
        .between(0, 7),
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr OpSpec kSpecs[] = {
    {"setPivot", "scope",
     "Puts the pivot to a corner of the scope with all axes pointing inward; the scope takes the "
     "same axes, the geometry stays.",
     kSignatures, typed<applySetPivot>},
};

}  // namespace

extern const OpList kOps_set_pivot;
const OpList kOps_set_pivot = kSpecs;

}  // namespace gable
