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

template <>
struct WordsOf<ContextScope> {
  static constexpr const char* text = "intra inter all";
};

namespace {

// Other shapes: whose, and under which label (0 for any).
struct Others {
  ContextScope target = ContextScope::All;
  Text label;
};

template <ContextTest test>
Value query(FunctionCall& call, const Others& args) {
  return Value::of(call.services().query(test, args.target, args.label.id, call.shape()));
}

Value minimumDistance(FunctionCall& call, const Others& args) {
  if (args.label.text.empty()) return Value::of(std::numeric_limits<double>::infinity());
  return Value::of(call.services().minimumDistance(args.target, args.label.id, call.shape()));
}

Value contextCount(FunctionCall& call, const Others& args) {
  if (args.label.text.empty()) return Value::of(0.0);
  return Value::of(call.services().contextCount(args.target, args.label.id));
}

struct Compare : Others {
  Word comparison;
};

Value contextCompare(FunctionCall& call, const Compare& args) {
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
  if (args.label.text.empty()) return Value::of(0.0);
  for (const auto& [name, order] : kOrders) {
    if (args.comparison.text != name) continue;
    return Value::of(call.services().contextRank(args.target, args.label.id, order, call.shape()));
  }
  return Value::of(0.0);
}

enum class Quantity : uint8_t { Pos, Orient };

}  // namespace

template <>
struct WordsOf<Quantity> {
  static constexpr const char* text = "pos orient";
};

namespace {

// One coordinate of three numbers, or all three of a list.
struct Convert {
  Axis coordinate;
  CoordSystem from, to;
  Quantity kind;
  double x, y, z;
  std::optional<Floats> coordinates;
};

// A position or orientation of one system in another.
Vec3 converted(FunctionCall& call, const Convert& args, const Vec3& v) {
  if (args.from == args.to) return v;
  const Frame from = frameOf(args.from, call.shape(), call.services());
  const Frame to = frameOf(args.to, call.shape(), call.services());
  if (args.kind == Quantity::Orient) {
    return anglesXyz(inverse(to) * from * rotationXyz(v.x, v.y, v.z));
  }
  return to.toLocal(from.point(v));
}

Value convert(FunctionCall& call, const Convert& args) {
  if (!args.coordinates) {
    return Value::of(component(converted(call, args, {args.x, args.y, args.z}), args.coordinate));
  }
  const Array& in = *args.coordinates->array;
  if (in.numbers.size() < 3) {
    return call.fail("bad-argument", "convert needs three coordinates", "write [x, y, z]",
                     call.services().pool().intern(in));
  }
  const Vec3 v = converted(call, args, {in.numbers[0], in.numbers[1], in.numbers[2]});
  Array out;
  out.rows = 1;
  out.columns = 3;
  out.numbers = {v.x, v.y, v.z};
  return call.result(std::move(out));
}

Value treeKey(FunctionCall& call) { return call.result(call.services().treeKey()); }

struct Print {
  Value value;
};

Value print(FunctionCall& call, const Print& args) {
  call.services().print(call.services().pool().str(args.value));
  return args.value;
}

constexpr ParamSpec kTarget =
    param<&Others::target>("target", "Shapes of the same initial shape, of others, or both.");
constexpr ParamSpec kLabel =
    param<&Others::label>("label", "Only shapes that were labelled so; an empty text means any.");
constexpr ParamSpec kNeededLabel = param<&Others::label>("label", "The label of the other shapes.");
constexpr ParamSpec kTargetParams[] = {kTarget};
constexpr ParamSpec kTargetLabelParams[] = {kTarget, kLabel};
constexpr ParamSpec kLabelledParams[] = {kTarget, kNeededLabel};
constexpr Signature kQuery[] = {
    {{}, ValueType::Bool}, {kTargetParams, ValueType::Bool}, {kTargetLabelParams, ValueType::Bool}};
constexpr Signature kOfLabel[] = {{kLabelledParams, ValueType::Float}};

constexpr ParamSpec kCompareParams[] = {
    kTarget, kNeededLabel,
    param<&Compare::comparison>(
        "comparisonType", "What the order goes by; the first has rank 0.", nullptr,
        "world.northernmost world.southernmost world.easternmost world.westernmost world.highest "
        "world.lowest area.largest area.smallest")};
constexpr Signature kCompare[] = {{kCompareParams, ValueType::Float}};

constexpr ParamSpec kAxis = param<&Convert::coordinate>("coordinate", "The coordinate to give.");
constexpr ParamSpec kFrom =
    param<&Convert::from>("fromSystem", "The system that the coordinates are written in.");
constexpr ParamSpec kTo = param<&Convert::to>("toSystem", "The system to give them in.");
constexpr ParamSpec kType =
    param<&Convert::kind>("type", "Whether they are a position, or angles in degrees.");
constexpr ParamSpec kConvertParams[] = {kAxis,
                                        kFrom,
                                        kTo,
                                        kType,
                                        param<&Convert::x>("x", "The first coordinate or angle."),
                                        param<&Convert::y>("y", "The second one."),
                                        param<&Convert::z>("z", "The third one.")};
constexpr ParamSpec kConvertArrayParams[] = {
    kFrom, kTo, kType, param<&Convert::coordinates>("coordinates", "The three of them.")};
constexpr Signature kConvert[] = {{kConvertParams, ValueType::Float},
                                  {kConvertArrayParams, ValueType::FloatArray}};
constexpr Signature kKey[] = {{{}, ValueType::String}};
constexpr ParamSpec kPrintParams[] = {param<&Print::value>("value", "Any value or array.")};
constexpr Signature kPrint[] = {{kPrintParams, ValueType::Null}};

constexpr const char* kFamily = "context";
constexpr FunctionSpec kFunctions[] = {
    {"inside", kFamily, "Whether the shape lies wholly inside a closed one.", kQuery,
     typed<query<ContextTest::Inside>>, kReadsContext, true},
    {"overlaps", kFamily, "Whether the shape lies partly or wholly inside a closed one.", kQuery,
     typed<query<ContextTest::Overlaps>>, kReadsContext, true},
    {"touches", kFamily, "Whether the shape overlaps a closed one or lies on its surface.", kQuery,
     typed<query<ContextTest::Touches>>, kReadsContext, true},
    {"minimumDistance", kFamily,
     "The distance of the scope to the nearest labelled one; infinite when there is none.",
     kOfLabel, typed<minimumDistance>, kReadsContext},
    {"contextCount", kFamily, "How many shapes were labelled so.", kOfLabel, typed<contextCount>,
     kReadsContext},
    {"contextCompare", kFamily,
     "How many labelled shapes lie further north, are higher, larger and so on than this one.",
     kCompare, typed<contextCompare>, kReadsContext},
    {"convert", kFamily, "A position or orientation of one coordinate system in another.", kConvert,
     typed<convert>, kReadsWorld | kReadsWorldByWord | kReadsPivot},
    {"getTreeKey", kFamily, "The path of the shape in the shape tree, a list of child numbers.",
     kKey, treeKey, kReadsPath, true},
    {"print", kFamily, "Writes a value to the console and gives it back.", kPrint, typed<print>,
     kReports},
};

}  // namespace

extern const FunctionList kFunctions_context;
const FunctionList kFunctions_context = {kFunctions, {}};

}  // namespace gable
