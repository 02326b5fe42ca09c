// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Where the shape is and how large: scope.* relative to the pivot, pivot.* relative to the object,
// and what became of it in the last split or comp. Scope and pivot lie in the local frame of the
// rule call, so the pivot's place and the world's are read only by what shows them.

#include <cmath>
#include <optional>

#include "base/hash.h"
#include "base/random.h"
#include "builtins/lists.h"
#include "builtins/ops/shared/frames.h"
#include "shape/op_call.h"
#include "shape/seeded_path.h"

namespace gable {

namespace {

template <size_t axis>
Value sizeOf(FunctionCall& call) {
  return Value::of(call.shape().size[axis]);
}

template <size_t axis>
Status setSize(OpCall& call, const Value& v) {
  Vec3 size = call.shape().size;
  size[axis] = v.number;
  resizeScope(call.shape(), size);
  return {};
}

Frame scopeInPivot(const Shape& s) { return inverse(s.pivot) * s.scope; }

template <size_t axis>
Value placeOf(FunctionCall& call) {
  return Value::of(scopeInPivot(call.shape()).origin[axis]);
}

template <size_t axis>
Status setPlace(OpCall& call, const Value& v) {
  Shape& s = call.shape();
  Frame f = scopeInPivot(s);
  f.origin[axis] = v.number;
  s.scope.origin = s.pivot.point(f.origin);
  return {};
}

template <size_t axis>
Value angleOf(FunctionCall& call) {
  return Value::of(anglesXyz(scopeInPivot(call.shape()))[axis]);
}

template <size_t axis>
Status setAngle(OpCall& call, const Value& v) {
  Shape& s = call.shape();
  Vec3 angles = anglesXyz(scopeInPivot(s));
  angles[axis] = v.number;
  Frame f = s.pivot * rotationXyz(angles.x, angles.y, angles.z);
  f.origin = s.scope.origin;
  s.scope = f;
  return {};
}

Value elevation(FunctionCall& call) {
  return Value::of(call.services().world().point(call.shape().scope.origin).y);
}

Frame pivotInObject(const Shape& s, const Services& services) {
  return inverse(objectFrame(services)) * s.pivot;
}

// The scope is carried along: its place relative to the pivot stays what it was.
void movePivot(Shape& s, const Services& services, const Frame& inObject) {
  const Frame scope = scopeInPivot(s);
  s.pivot = objectFrame(services) * inObject;
  s.scope = s.pivot * scope;
}

template <size_t axis>
Value pivotPlaceOf(FunctionCall& call) {
  return Value::of(pivotInObject(call.shape(), call.services()).origin[axis]);
}

template <size_t axis>
Status setPivotPlace(OpCall& call, const Value& v) {
  Frame f = pivotInObject(call.shape(), call.services());
  f.origin[axis] = v.number;
  movePivot(call.shape(), call.services(), f);
  return {};
}

template <size_t axis>
Value pivotAngleOf(FunctionCall& call) {
  return Value::of(anglesXyz(pivotInObject(call.shape(), call.services()))[axis]);
}

template <size_t axis>
Status setPivotAngle(OpCall& call, const Value& v) {
  const Frame old = pivotInObject(call.shape(), call.services());
  Vec3 angles = anglesXyz(old);
  angles[axis] = v.number;
  Frame f = rotationXyz(angles.x, angles.y, angles.z);
  f.origin = old.origin;
  movePivot(call.shape(), call.services(), f);
  return {};
}

Value initialName(FunctionCall& call) { return call.result(call.services().initialShape().name); }
Value initialStartRule(FunctionCall& call) {
  return call.result(call.services().initialShape().startRule);
}
template <size_t axis>
Value originPlaceOf(FunctionCall& call) {
  return Value::of(call.services().initialShape().origin.origin[axis]);
}
template <size_t axis>
Value originAngleOf(FunctionCall& call) {
  return Value::of(anglesXyz(call.services().initialShape().origin)[axis]);
}

Value splitIndex(FunctionCall& call) { return Value::of(double{1} * call.shape().split.index); }
Value splitTotal(FunctionCall& call) { return Value::of(double{1} * call.shape().split.total); }
Value compIndex(FunctionCall& call) { return Value::of(double{1} * call.shape().comp.index); }
Value compTotal(FunctionCall& call) { return Value::of(double{1} * call.shape().comp.total); }
Value compSelector(FunctionCall& call) { return Value::string(call.shape().compSelector); }

Value trimVertical(FunctionCall& call) { return Value::of(call.shape().trimVertical); }
Value trimHorizontal(FunctionCall& call) { return Value::of(call.shape().trimHorizontal); }
Status setTrimVertical(OpCall& call, const Value& v) {
  call.shape().trimVertical = v.truth();
  return {};
}
Status setTrimHorizontal(OpCall& call, const Value& v) {
  call.shape().trimHorizontal = v.truth();
  return {};
}

// Where none was set: a number that rules can print and put elsewhere; the address itself has more
// bits than a float.
Value seedian(FunctionCall& call) {
  const uint64_t path = call.shape().path;
  const std::optional<double> seed = seedOf(path);
  return Value::of(seed ? *seed : static_cast<double>(randomBits(path) >> 33));
}
Status setSeedian(OpCall& call, const Value& v) {
  call.shape().path = seededPath(v.number);
  return {};
}

// A number of its own for each shape. Counting would depend on what else is made, so it comes from
// the shape's address.
Value uid(FunctionCall& call) {
  return Value::of(static_cast<double>(hashCombine(hashBytes("uid"), call.shape().path) >> 40));
}

constexpr ValueType kFloat = ValueType::Float;
constexpr uint32_t kObject = kReadsWorld | kReadsInitialShape | kReadsPivot;

constexpr AttributeSpec kAttributes[] = {
    {"scope.sx", kFloat, "Size of the scope along x, in metres.", sizeOf<0>, setSize<0>},
    {"scope.sy", kFloat, "Size of the scope along y.", sizeOf<1>, setSize<1>},
    {"scope.sz", kFloat, "Size of the scope along z.", sizeOf<2>, setSize<2>},
    {"scope.tx", kFloat, "Place of the scope's origin along the pivot's x axis.", placeOf<0>,
     setPlace<0>, kReadsPivot},
    {"scope.ty", kFloat, "Place of the scope's origin along the pivot's y axis.", placeOf<1>,
     setPlace<1>, kReadsPivot},
    {"scope.tz", kFloat, "Place of the scope's origin along the pivot's z axis.", placeOf<2>,
     setPlace<2>, kReadsPivot},
    {"scope.rx", kFloat, "Turn of the scope about the pivot's x axis, in degrees; done first.",
     angleOf<0>, setAngle<0>, kReadsPivot},
    {"scope.ry", kFloat, "Turn of the scope about the pivot's y axis; done second.", angleOf<1>,
     setAngle<1>, kReadsPivot},
    {"scope.rz", kFloat, "Turn of the scope about the pivot's z axis; done last.", angleOf<2>,
     setAngle<2>, kReadsPivot},
    {"scope.elevation", kFloat, "Height of the scope's origin above the world's zero, in metres.",
     elevation, nullptr, kReadsWorld},
    {"pivot.px", kFloat,
     "Place of the pivot along the object's x axis; the scope keeps its place relative to it.",
     pivotPlaceOf<0>, setPivotPlace<0>, kObject},
    {"pivot.py", kFloat, "Place of the pivot along the object's y axis.", pivotPlaceOf<1>,
     setPivotPlace<1>, kObject},
    {"pivot.pz", kFloat, "Place of the pivot along the object's z axis.", pivotPlaceOf<2>,
     setPivotPlace<2>, kObject},
    {"pivot.ox", kFloat, "Turn of the pivot about the object's x axis, in degrees; done first.",
     pivotAngleOf<0>, setPivotAngle<0>, kObject},
    {"pivot.oy", kFloat, "Turn of the pivot about the object's y axis; done second.",
     pivotAngleOf<1>, setPivotAngle<1>, kObject},
    {"pivot.oz", kFloat, "Turn of the pivot about the object's z axis; done last.", pivotAngleOf<2>,
     setPivotAngle<2>, kObject},
    {"initialShape.name", ValueType::String, "Name of the initial shape.", initialName, nullptr,
     kReadsInitialShape},
    {"initialShape.startRule", ValueType::String, "Rule that the initial shape started with.",
     initialStartRule, nullptr, kReadsInitialShape},
    {"initialShape.symbol", ValueType::String, "Old name of initialShape.startRule.",
     initialStartRule, nullptr, kReadsInitialShape},
    {"initialShape.origin.px", kFloat, "Place of the object's origin along the world's x axis.",
     originPlaceOf<0>, nullptr, kReadsInitialShape},
    {"initialShape.origin.py", kFloat, "Place of the object's origin along the world's y axis.",
     originPlaceOf<1>, nullptr, kReadsInitialShape},
    {"initialShape.origin.pz", kFloat, "Place of the object's origin along the world's z axis.",
     originPlaceOf<2>, nullptr, kReadsInitialShape},
    {"initialShape.origin.ox", kFloat, "Turn of the object about the world's x axis, in degrees.",
     originAngleOf<0>, nullptr, kReadsInitialShape},
    {"initialShape.origin.oy", kFloat, "Turn of the object about the world's y axis.",
     originAngleOf<1>, nullptr, kReadsInitialShape},
    {"initialShape.origin.oz", kFloat, "Turn of the object about the world's z axis.",
     originAngleOf<2>, nullptr, kReadsInitialShape},
    {"split.index", kFloat, "Number of the shape among those of the last split, from 0.",
     splitIndex, nullptr, kReadsSplit},
    {"split.total", kFloat, "How many shapes the last split made.", splitTotal, nullptr,
     kReadsSplit},
    {"comp.sel", ValueType::String,
     "The selector by which the last component split chose the shape.", compSelector, nullptr,
     kReadsComp},
    {"comp.index", kFloat, "Number of the shape among those of its selector, from 0.", compIndex,
     nullptr, kReadsComp},
    {"comp.total", kFloat, "How many shapes its selector chose in the last component split.",
     compTotal, nullptr, kReadsComp},
    {"trim.vertical", ValueType::Bool, "Whether vertical trim planes cut what is inserted.",
     trimVertical, setTrimVertical, kUsesTrim},
    {"trim.horizontal", ValueType::Bool, "Whether horizontal trim planes cut what is inserted.",
     trimHorizontal, setTrimHorizontal, kUsesTrim},
    {"uid", kFloat, "Old: a whole number that no other shape has, as far as 16 million go.", uid,
     nullptr, kRandom},
    {"seedian", kFloat, "Seed of all random draws of the shape and what becomes of it.", seedian,
     setSeedian, kRandom},
};

}  // namespace

extern const FunctionList kFunctions_scope;
const FunctionList kFunctions_scope = {{}, kAttributes};

}  // namespace gable
