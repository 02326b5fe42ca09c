// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Where the shape is among others: coordinates in other systems, queries about neighbours, its
// place in the tree.

#include <limits>

#include "builtins/lists.h"
#include "builtins/ops/shared/frames.h"
#include "shape/op_call.h"

namespace gable {

namespace {

ContextScope scopeOf(const FunctionCall& call, size_t argument) {
  const std::string_view word = call.text(argument, "all");
  return word == "intra"   ? ContextScope::Intra
         : word == "inter" ? ContextScope::Inter
                           : ContextScope::All;
}

template <ContextTest test>
Value query(FunctionCall& call) {
  const StringId label = call.has(1) ? call.arg(1).id : 0;
  return Value::of(call.services().query(test, scopeOf(call, 0), label, call.shape()));
}

Value minimumDistance(FunctionCall& call) {
  if (call.text(1).empty()) return Value::of(std::numeric_limits<double>::infinity());
  return Value::of(call.services().minimumDistance(scopeOf(call, 0), call.arg(1).id, call.shape()));
}

Value contextCount(FunctionCall& call) {
  if (call.text(1).empty()) return Value::of(0.0);
  return Value::of(call.services().contextCount(scopeOf(call, 0), call.arg(1).id));
}

Value contextCompare(FunctionCall& call) {
  static constexpr std::pair<std::string_view, ContextOrder> kOrders[] = {
      {"world.northernmost", ContextOrder::Northernmost},
      {"world.southernmost", ContextOrder::Southernmost},
      {"world.easternmost", ContextOrder::Easternmost},
      {"world.westernmost", ContextOrder::Westernmost},
      {"world.highest", ContextOrder::Highest},
      {"world.lowest", ContextOrder::Lowest},
      {"area.largest", ContextOrder::LargestArea},
      {"area.smallest", ContextOrder::SmallestArea},
  };
  if (call.text(1).empty()) return Value::of(0.0);
  for (const auto& [name, order] : kOrders) {
    if (call.text(2) != name) continue;
    return Value::of(
        call.services().contextRank(scopeOf(call, 0), call.arg(1).id, order, call.shape()));
  }
  return call.fail("unknown-selector",
                   "contextCompare knows no order '" + std::string(call.text(2)) + "'",
                   "use world.highest, area.largest or another of its words", Value::of(0.0));
}

// A position or orientation of one system in another.
Vec3 converted(FunctionCall& call, size_t first, const Vec3& v) {
  Frame systems[2];
  for (size_t i = 0; i < 2; ++i) {
    const std::string_view word = call.text(first + i);
    const int system = wordIndex(WordsOf<CoordSystem>::text, word);
    if (system < 0) {
      call.fail("unknown-selector",
                "convert knows no coordinate system '" + std::string(word) + "'",
                "use scope, pivot, object or world", {});
      return v;
    }
    systems[i] = frameOf(static_cast<CoordSystem>(system), call.shape(), call.services());
  }
  const auto& [from, to] = systems;
  if (call.arg(first).id == call.arg(first + 1).id) return v;
  if (call.text(first + 2) == "orient") {
    return anglesXyz(inverse(to) * from * rotationXyz(v.x, v.y, v.z));
  }
  return to.toLocal(from.point(v));
}

Value convert(FunctionCall& call) {
  if (call.argCount() == 7) {
    const Vec3 v = converted(call, 1, {call.number(4), call.number(5), call.number(6)});
    const std::string_view axis = call.text(0);
    return Value::of(axis == "x" ? v.x : axis == "y" ? v.y : v.z);
  }
  const Array& in = call.array(3);
  if (in.numbers.size() < 3) {
    return call.fail("bad-argument", "convert needs three coordinates", "write [x, y, z]",
                     call.arg(3));
  }
  const Vec3 v = converted(call, 0, {in.numbers[0], in.numbers[1], in.numbers[2]});
  Array out;
  out.rows = 1;
  out.columns = 3;
  out.numbers = {v.x, v.y, v.z};
  return call.result(std::move(out));
}

Value treeKey(FunctionCall& call) { return call.result(call.services().treeKey()); }

Value print(FunctionCall& call) {
  call.services().print(call.services().pool().str(call.arg(0)));
  return call.arg(0);
}

constexpr ParamSpec kTarget = {"target", ParamType::Selector,
                               "Shapes of the same initial shape, of others, or both.", nullptr,
                               "intra inter all"};
constexpr ParamSpec kLabel = {"label", ParamType::String,
                              "Only shapes that were labelled so; an empty text means any."};
constexpr ParamSpec kNeededLabel = {"label", ParamType::String, "The label of the other shapes."};
constexpr ParamSpec kTargetParams[] = {kTarget};
constexpr ParamSpec kTargetLabelParams[] = {kTarget, kLabel};
constexpr ParamSpec kLabelledParams[] = {kTarget, kNeededLabel};
constexpr Signature kQuery[] = {
    {{}, ValueType::Bool}, {kTargetParams, ValueType::Bool}, {kTargetLabelParams, ValueType::Bool}};
constexpr Signature kOfLabel[] = {{kLabelledParams, ValueType::Float}};

constexpr ParamSpec kCompareParams[] = {
    kTarget,
    kNeededLabel,
    {"comparisonType", ParamType::Selector, "What the order goes by; the first has rank 0.",
     nullptr,
     "world.northernmost world.southernmost world.easternmost world.westernmost world.highest "
     "world.lowest area.largest area.smallest"}};
constexpr Signature kCompare[] = {{kCompareParams, ValueType::Float}};

constexpr const char* kSystems = "scope pivot object world";
constexpr ParamSpec kAxis = {"coordinate", ParamType::Selector, "The coordinate to give.", nullptr,
                             "x y z"};
constexpr ParamSpec kFrom = {"fromSystem", ParamType::Selector,
                             "The system that the coordinates are written in.", nullptr, kSystems};
constexpr ParamSpec kTo = {"toSystem", ParamType::Selector, "The system to give them in.", nullptr,
                           kSystems};
constexpr ParamSpec kType = {"type", ParamType::Selector,
                             "Whether they are a position, or angles in degrees.", nullptr,
                             "pos orient"};
constexpr ParamSpec kConvertParams[] = {kAxis,
                                        kFrom,
                                        kTo,
                                        kType,
                                        {"x", ParamType::Float, "The first coordinate or angle."},
                                        {"y", ParamType::Float, "The second one."},
                                        {"z", ParamType::Float, "The third one."}};
constexpr ParamSpec kConvertArrayParams[] = {
    kFrom, kTo, kType, {"coordinates", ParamType::FloatArray, "The three of them."}};
constexpr Signature kConvert[] = {{kConvertParams, ValueType::Float},
                                  {kConvertArrayParams, ValueType::FloatArray}};
constexpr Signature kKey[] = {{{}, ValueType::String}};
constexpr ParamSpec kPrintParams[] = {{"value", ParamType::Any, "Any value or array."}};
constexpr Signature kPrint[] = {{kPrintParams, ValueType::Null}};

constexpr const char* kFamily = "context";
constexpr FunctionSpec kFunctions[] = {
    {"inside", kFamily, "Whether the shape lies wholly inside a closed one.", kQuery,
     query<ContextTest::Inside>, kReadsContext, true},
    {"overlaps", kFamily, "Whether the shape lies partly or wholly inside a closed one.", kQuery,
     query<ContextTest::Overlaps>, kReadsContext, true},
    {"touches", kFamily, "Whether the shape overlaps a closed one or lies on its surface.", kQuery,
     query<ContextTest::Touches>, kReadsContext, true},
    {"minimumDistance", kFamily,
     "The distance of the scope to the nearest labelled one; infinite when there is none.",
     kOfLabel, minimumDistance, kReadsContext},
    {"contextCount", kFamily, "How many shapes were labelled so.", kOfLabel, contextCount,
     kReadsContext},
    {"contextCompare", kFamily,
     "How many labelled shapes lie further north, are higher, larger and so on than this one.",
     kCompare, contextCompare, kReadsContext},
    {"convert", kFamily, "A position or orientation of one coordinate system in another.", kConvert,
     convert, kReadsWorld | kReadsWorldByWord | kReadsPivot},
    {"getTreeKey", kFamily, "The path of the shape in the shape tree, a list of child numbers.",
     kKey, treeKey, kReadsPath, true},
    {"print", kFamily, "Writes a value to the console and gives it back.", kPrint, print, kReports},
};

}  // namespace

extern const FunctionList kFunctions_context;
const FunctionList kFunctions_context = {kFunctions, {}};

}  // namespace gable
