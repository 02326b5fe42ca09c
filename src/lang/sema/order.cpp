// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The order in which attributes are evaluated: each after those that its expression reads, directly
// or through functions. A depth-first search over attributes and functions with an explicit stack;
// a way back to an attribute that is being evaluated is a cycle. Which way a `case` takes is not
// known here, so what any branch reads counts.

#include <algorithm>

#include "lang/sema/analysis.h"

namespace gable::lang {

namespace {

// Attributes and functions in one numbering: attributes first.
class ReadGraph {
 public:
  ReadGraph(const ResolvedProgram& p) : program_(p), attributes_(p.attributes.size()) {}

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
    for (const NodeId c : program_.tree(module).children(node)) collect(module, c, out);
  }

  const ResolvedProgram& program_;
  size_t attributes_;
};

}  // namespace

void Analysis::orderAttributes() {
  const ReadGraph graph(program_);
  enum class State : uint8_t { New, Open, Done };
  std::vector<State> states(graph.size(), State::New);
  std::vector<AttributeId> order;
  struct Frame {
    size_t vertex;
    std::vector<size_t> reads;
    size_t next;
  };
  for (size_t root = 0; root < program_.attributes.size(); ++root) {
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
        if (!open) continue;
        const AttributeInfo& a = program_.attributes[v];
        error("definition-cycle", nameSpan(program_.tree(a.module), a.node),
              "the value of " + quote(a.qualifiedName) + " depends on itself",
              "break the circle with a constant or a function that does not read it");
        continue;
      }
      states[top.vertex] = State::Done;
      if (graph.isAttribute(top.vertex)) order.push_back(static_cast<AttributeId>(top.vertex));
      stack.pop_back();
    }
  }
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
