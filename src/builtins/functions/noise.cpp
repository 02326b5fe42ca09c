// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Noise, and where in the world a shape is. Noise follows from its arguments alone, so that a rule
// that is given a place as a number can still be shared; only who reads world.* is not.

#include "math/noise.h"

#include <cmath>

#include "builtins/lists.h"
#include "shape/op_call.h"

namespace gable {

namespace {

// Of every field of noise; a third coordinate tells fields apart.
constexpr uint64_t kField = 0x6e6f697365ULL;
constexpr double kMostOctaves = 16;

// Without z the noise is that of a plane.
struct Noise {
  double octaves;
  double x, y;
  std::optional<double> z;
};

Value noise(FunctionCall&, const Noise& args) {
  return Value::of(args.z ? gradientNoise(Vec3{args.x, args.y, *args.z}, kField)
                          : gradientNoise(Vec2{args.x, args.y}, kField));
}

Value fractal(FunctionCall&, const Noise& args) {
  const int n = static_cast<int>(args.octaves);
  return Value::of(args.z ? fractalNoise(Vec3{args.x, args.y, *args.z}, n, kField)
                          : fractalNoise(Vec2{args.x, args.y}, n, kField));
}

template <size_t axis>
Value placeInWorld(FunctionCall& call) {
  return Value::of(call.services().world().point(call.shape().scope.origin)[axis]);
}

constexpr ParamSpec kX = param<&Noise::x>("x", "The first coordinate.");
constexpr ParamSpec kY = param<&Noise::y>("y", "The second coordinate.");
constexpr ParamSpec kZ = param<&Noise::z>("z", "The third one, or the number of a field.");
constexpr ParamSpec kOctaves =
    param<&Noise::octaves>("octaves", "How many times finer noise is added.")
        .between(1, kMostOctaves);
constexpr ParamSpec kPlaneParams[] = {kX, kY};
constexpr ParamSpec kSpaceParams[] = {kX, kY, kZ};
constexpr ParamSpec kFractalPlaneParams[] = {kOctaves, kX, kY};
constexpr ParamSpec kFractalSpaceParams[] = {kOctaves, kX, kY, kZ};
constexpr Signature kNoise[] = {{kPlaneParams, ValueType::Float}, {kSpaceParams, ValueType::Float}};
constexpr Signature kFractal[] = {{kFractalPlaneParams, ValueType::Float},
                                  {kFractalSpaceParams, ValueType::Float}};

constexpr FunctionSpec kFunctions[] = {
    {"noise", "noise", "Smooth noise, -1 to 1, that changes over a distance of about 1.", kNoise,
     typed<noise>, kPure, false, true},
    {"fractalNoise", "noise", "Noise with finer and finer detail, -1 to 1.", kFractal,
     typed<fractal>, kPure, false, true},
};

constexpr AttributeSpec kAttributes[] = {
    {"world.x", ValueType::Float, "Place of the scope's origin in the world: metres to the east.",
     placeInWorld<0>, nullptr, kReadsWorld},
    {"world.y", ValueType::Float, "Metres above the world's zero.", placeInWorld<1>, nullptr,
     kReadsWorld},
    {"world.z", ValueType::Float, "Metres to the south.", placeInWorld<2>, nullptr, kReadsWorld},
};

}  // namespace

extern const FunctionList kFunctions_noise;
const FunctionList kFunctions_noise = {kFunctions, kAttributes};

}  // namespace gable
