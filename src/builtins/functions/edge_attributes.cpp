// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/edge_sampling.h"
#include "builtins/lists.h"
#include "shape/op_call.h"

namespace gable {

namespace {

struct EdgeAttribute {
  std::string_view name;
};

// The value of the edge that the shape belongs to; null where there is none of that type.
Value sampled(FunctionCall& call, std::string_view name, ValueType array) {
  const EdgeAttributes* edges = call.services().initialShape().edges.get();
  const Value* list = edges ? edges->find(edgeAttributeName(name)) : nullptr;
  if (!list || list->type != array) return {};
  return edgeValue(*list, EdgeSampler(call.services(), call.shape()).ofShape(),
                   call.services().pool());
}

Value getFloat(FunctionCall& call, const EdgeAttribute& args) {
  const Value v = sampled(call, args.name, ValueType::FloatArray);
  return v.type == ValueType::Float ? v : Value::of(0.0);
}
Value getString(FunctionCall& call, const EdgeAttribute& args) {
  const Value v = sampled(call, args.name, ValueType::StringArray);
  return v.type == ValueType::String ? v : call.services().pool().string("");
}
Value getBool(FunctionCall& call, const EdgeAttribute& args) {
  const Value v = sampled(call, args.name, ValueType::BoolArray);
  return v.type == ValueType::Bool ? v : Value::of(false);
}

constexpr ParamSpec kParams[] = {
    param<&EdgeAttribute::name>("attributeName", "The name of the attribute, without /edgeattr/.")};
constexpr Signature kFloat[] = {{kParams, ValueType::Float}};
constexpr Signature kString[] = {{kParams, ValueType::String}};
constexpr Signature kBool[] = {{kParams, ValueType::Bool}};

constexpr uint32_t kEffects = kReadsWorld | kReadsInitialShape;
constexpr FunctionSpec kFunctions[] = {
    {"edgeAttr.getFloat", "edges",
     "The number that an attribute of edges has at the shape; 0 for none.", kFloat, typed<getFloat>,
     kEffects},
    {"edgeAttr.getString", "edges",
     "The text that an attribute of edges has at the shape; empty for none.", kString,
     typed<getString>, kEffects},
    {"edgeAttr.getBool", "edges",
     "Whether an attribute of edges is true at the shape; false for none.", kBool, typed<getBool>,
     kEffects},
};

}  // namespace

extern const FunctionList kFunctions_edge_attributes;
const FunctionList kFunctions_edge_attributes = {kFunctions, {}};

}  // namespace gable
