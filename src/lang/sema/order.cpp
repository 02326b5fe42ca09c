// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The order in which attributes are evaluated: each after those that its expression reads, directly
// or through functions. A depth-first search over attributes and functions with an explicit stack;
// a way back to an attribute that is being evaluated is a cycle. Which way a `case` takes is not
// known here. So what any branch reads counts for the order, and only what is read in any case for
// the warning; the machine tells of the other cycles when it comes to them.

#include <algorithm>

#include "lang/sema/analysis.h"

namespace gable::lang {

namespace {

// Attributes and functions in one numbering: attributes first.
class ReadGraph {
 public:
  enum class Reads : uint8_t { Possible, Certain };
  ReadGraph(const ResolvedProgram& p, Reads reads)
      : program_(p), attributes_(p.attributes.size()), certain_(reads == Reads::Certain) {}

  size_t size() const { return attributes_ + program_.functions.size(); }
  bool isAttribute(size_t v) const { return v < attributes_; }

  // What `v` reads, in the order of writing.
  std::vector<size_t> reads(size_t v) const {
    std::vector<size_t> out;
    if (isAttribute(v)) {
      const AttributeInfo& a = program_.attributes[v];
      if (a.source == ValueSource::Given) return out;
      if (a.source == ValueSource::Propagated) return {a.from};
      collect(a.valueModule, a.valueNode, out);
      if (a.source == ValueSource::Own) {
        collect(a.module, localsOf(program_.tree(a.module), a.node), out);
      }
    } else {
      const FunctionInfo& f = program_.functions[v - attributes_];
      collect(f.module, localsOf(program_.tree(f.module), f.node), out);
      collect(f.module, bodyOf(program_.tree(f.module), f.node), out);
    }
    return out;
  }

 private:
  void collect(ModuleId module, NodeId node, std::vector<size_t>& out) const {
    if (node == kNoNode) return;
    const Resolution& r = program_.modules[module].resolutions[node];
    if (r.kind == RefKind::Attribute) out.push_back(r.index);
    if (r.kind == RefKind::Function) out.push_back(attributes_ + r.index);
    const Tree& t = program_.tree(module);
    if (certain_ && t.kind(node) == NodeKind::Choice) {
      // Of a choice only the first condition.
      return collect(module, t.child(t.child(node, 0), 0), out);
    }
    const bool mayEndEarly =
        t.kind(node) == NodeKind::Binary && !t.has(node, kFlagElementwise) &&
        (t.binaryOp(node) == BinaryOp::And || t.binaryOp(node) == BinaryOp::Or);
    if (certain_ && mayEndEarly) return collect(module, t.child(node, 0), out);
    for (const NodeId c : t.children(node)) collect(module, c, out);
  }

  const ResolvedProgram& program_;
  size_t attributes_;
  bool certain_;
};

// The attributes, each after those it reads; `inCircle` is told those that come back to themselves.
template <class InCircle>
std::vector<AttributeId> orderOf(const ReadGraph& graph, size_t attributes, InCircle inCircle) {
  enum class State : uint8_t { New, Open, Done };
  std::vector<State> states(graph.size(), State::New);
  std::vector<AttributeId> order;
  struct Frame {
    size_t vertex;
    std::vector<size_t> reads;
    size_t next;
  };
  for (size_t root = 0; root < attributes; ++root) {
    if (states[root] != State::New) continue;
    std::vector<Frame> stack;
    const auto push = [&](size_t v) {
      states[v] = State::Open;
      stack.push_back({v, graph.reads(v), 0});
    };
    push(root);
    while (!stack.empty()) {
      Frame& top = stack.back();
      if (top.next < top.reads.size()) {
        const size_t v = top.reads[top.next++];
        if (states[v] == State::New) {
          push(v);
          continue;
        }
        // Functions may call themselves; attributes may not need themselves.
        const bool open = states[v] == State::Open && graph.isAttribute(v);
        if (open) inCircle(static_cast<AttributeId>(v));
        continue;
      }
      states[top.vertex] = State::Done;
      if (graph.isAttribute(top.vertex)) order.push_back(static_cast<AttributeId>(top.vertex));
      stack.pop_back();
    }
  }
  return order;
}

}  // namespace

void Analysis::orderAttributes() {
  using Reads = ReadGraph::Reads;
  const size_t count = program_.attributes.size();
  orderOf(ReadGraph(program_, Reads::Certain), count, [&](AttributeId id) {
    const AttributeInfo& a = program_.attributes[id];
    warning("definition-cycle", nameSpan(program_.tree(a.module), a.node),
            "the value of " + quote(a.qualifiedName) + " depends on itself",
            "break the circle with a constant or a function that does not read it");
  });
  const std::vector<AttributeId> order =
      orderOf(ReadGraph(program_, Reads::Possible), count, [](AttributeId) {});
  for (const AttributeId id : order) {
    const AttributeInfo& a = program_.attributes[id];
    if (!program_.modules[a.module].dynamic) program_.initOrder.push_back(id);
  }
  for (DynamicImport& d : program_.dynamicImports) {
    for (const AttributeId id : order) {
      const AttributeInfo& a = program_.attributes[id];
      if (a.source == ValueSource::Given) continue;
      // The target and the modules below it.
      ModuleId m = a.module;
      while (m != kNone && m != d.target) {
        const Module& at = program_.modules[m];
        m = at.dynamic && at.importer != kNone ? at.importer : kNone;
      }
      if (m == d.target) d.initOrder.push_back(id);
    }
  }
}

}  // namespace gable::lang
