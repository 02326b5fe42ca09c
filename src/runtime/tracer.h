// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Tracer: the tree of what one worker derives, for people: a node for each shape that a rule made,
// and notes of what rules drew and read. Without DeriveOptions::trace it holds nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "program/program.h"
#include "runtime/derive.h"

namespace gable {

class Tracer {
 public:
  /// Both must outlive the tracer.
  Tracer(const Program& program, const DeriveOptions& options)
      : program_(program),
        filter_(options.traceFilter),
        traces_(options.trace),
        tracesShapes_(options.traceShapes) {}

  bool traces() const { return traces_; }
  /// Shapes that rules replace are kept as leaves, and notes are taken.
  bool tracesShapes() const { return tracesShapes_; }

  // A filter shows some shapes with what comes of them. The node of others is kNone where what
  // comes of them may be shown, and kCut where nothing of it is.

  /// Whether a filter chooses the topmost shapes.
  bool choosesTops() const { return filter_.rule || !filter_.path.empty(); }
  /// Whether the rules that made a shape one out of the other make it a topmost one.
  bool isTop(const std::vector<const std::string*>& path) const;
  /// Whether so many levels are shown that one below the node is.
  bool reachesBelow(uint32_t node) const;

  /// A shape where it was made.
  struct Made {
    uint32_t parent = TraceNode::kNone;
    uint32_t initialShape = 0;
    StringId name = 0;
    Span span;
    Frame scope;
    Vec3 size;
    uint32_t tags = 0;
  };
  /// A rule is called on it. Gives the node's number.
  uint32_t addCall(const Made& made, uint32_t rule);
  /// It is a leaf of a block slot, or of a name without a rule. `leafIndex` may be kNone.
  void addLeaf(const Made& made, uint32_t leafIndex);
  /// The rule made nothing, so its shape is the leaf.
  void endAsLeaf(uint32_t node, uint32_t leafIndex);
  void drop(uint32_t node);
  uint32_t tagsOf(uint32_t node) const { return nodes_[node].tags; }
  void setTags(uint32_t node, uint32_t tags) { nodes_[node].tags = tags; }
  /// The shape as the rule got it lies among the leaves.
  void showShape(uint32_t node, uint32_t leafIndex) { nodes_[node].shapeIndex = leafIndex; }

  // Notes. They end where there are too many for anybody to look at; `node` may be kNone.
  void noteParameters(uint32_t node, const RuleCode& rule, const Value* values);
  /// A rule that reads an attribute again saw it already.
  void noteAttribute(uint32_t node, uint32_t attribute, const Value& v);
  void noteDraw(uint32_t node, const Span& span, const char* function, const Value& v);
  /// `chosen` of `choices`, the number behind the last for none of them.
  struct Choice {
    double draw = 0, chance = 0;
    uint32_t chosen = 0, choices = 0;
  };
  void noteChoice(uint32_t node, const Span& span, const Choice& choice);

  // Leaves that are looked at before they are final: those of the nodes from number `from` on.
  size_t size() const { return nodes_.size(); }
  /// Of `count` leaves from `firstLeaf` on: those that are shapes on their way.
  std::vector<bool> shownShapes(size_t from, uint32_t firstLeaf, size_t count) const;
  /// The leaves from `firstLeaf` on have new numbers.
  void renumberLeaves(size_t from, uint32_t firstLeaf, const std::vector<uint32_t>& numbers);

  const std::vector<TraceNode>& nodes() const { return nodes_; }
  std::vector<TraceNote>& notes() { return notes_; }

  static constexpr size_t kMostNotes = 400'000;

 private:
  TraceNode& add(const Made& made);
  TraceNote* note(uint32_t node, TraceNote::Kind kind);

  const Program& program_;
  const TraceFilter& filter_;
  const bool traces_, tracesShapes_;
  /// By node its level below the topmost shown, where a filter counts them.
  std::vector<uint32_t> levels_;
  std::vector<TraceNode> nodes_;
  std::vector<TraceNote> notes_;
};

}  // namespace gable
