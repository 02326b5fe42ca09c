// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// OpCall and FunctionCall: what an operation or a function is given when it runs.
//
// An operation edits shape() in place, or gives out child shapes with emit(); it returns a Status.
// On failure it must leave shape() as it was and emit nothing. After an operation that emitted, the
// children run in the order of emission, each on the block slot it was given.
#pragma once

#include <array>
#include <cstddef>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/random.h"
#include "base/status.h"
#include "program/arguments.h"
#include "program/spec.h"
#include "program/value.h"
#include "shape/part.h"
#include "shape/services.h"
#include "shape/shape.h"

namespace gable {

/// One `size : ops` of a split block, or a group `{ ... }` or `{ ... }*` of more of them.
struct SplitItem {
  double size = 0;
  Unit unit = Unit::Absolute;
  /// The slot to run; unused by groups.
  uint32_t slot = 0;
  bool group = false;
  bool repeat = false;
  /// For a group: how many of the following items (groups counted whole, flattened) are inside.
  uint32_t length = 0;
};

/// The last division by a block's sizes, for whoever divides an equal length next.
struct SplitMemo {
  bool known = false;
  double whole = 0;
  std::vector<SplitPiece> pieces;
  /// The operation gave out exactly these as the parts of a box or a rectangle of that kind, and
  /// would do so again for an equal length along the axis.
  GeometryKind givenOutOf = GeometryKind::None;
  PartPlan plan;
};

/// The evaluated braces after a split-like operation, flattened in order of writing.
struct SplitBlock {
  std::span<const SplitItem> items;
  /// A * after the closing brace.
  bool repeat = false;
  /// May be null. What it knows was made with equal items.
  SplitMemo* memo = nullptr;
};

/// How a selector item spreads what it selects: `:` one shape each, `=` all in one, `=:` one for
/// each connected set.
enum class SelectOperator : uint8_t { Each, All, Connected };

/// A node of a selector expression, in postfix order within SelectorItem.
struct SelectorTerm {
  enum class Kind : uint8_t { Word, Index, Boolean, Tagged, Not, And, Or } kind = Kind::Word;
  /// Word: the selector's name ("front", "world.south", "remainder"). Tagged: the tag query.
  StringId word = 0;
  /// Index: the component number. Boolean: 0 or 1, evaluated before the operation. Tagged: 0, or
  /// 1 or 2 when the query is put to the component's edges or vertices.
  double number = 0;
};

struct SelectorItem {
  std::span<const SelectorTerm> terms;
  SelectOperator op = SelectOperator::Each;
  uint32_t slot = 0;
};

/// Whether a block's selector takes in the part of that name, where parts have names and nothing
/// else: by its word or by `all`, which leaves `otherwise` out.
bool selectsWord(const SelectorItem& item, std::string_view word, const ValuePool& pool);

double component(const Vec3& v, Axis a);

/// A child shape and the block slot that works on it.
struct BlockChild {
  Shape shape;
  uint32_t slot = 0;
};

/// The braces after an operation: what stands in them, and where the children go.
struct BlockInput {
  SplitBlock split;
  std::span<const SelectorItem> selectors;
  /// Of a block of operations or operands.
  uint32_t slotCount = 0;
  /// By slot; see OpCall::figureCode. May be shorter.
  std::span<const uint32_t> figures;
  /// By slot; see OpCall::preferredSize. May be shorter.
  std::span<const std::array<double, 3>> preferredSizes;
  std::vector<BlockChild>* children = nullptr;
  /// Where emitParts leaves its pieces and its plan, for the parts to be made later. When null they
  /// are made at once and become children.
  std::vector<SplitPiece>* pieces = nullptr;
  PartPlan* plan = nullptr;
  /// For each component the child that it went to, kNoChild for those not selected. May be null.
  std::vector<uint32_t>* componentChild = nullptr;
  static constexpr uint32_t kNoChild = 0xffffffff;
};

/// The struct of arguments of a call whose values never change, filled by its first run.
struct BoundArguments {
  alignas(std::max_align_t) std::byte room[LightOp::kRoom];
  bool known = false;
};

/// Where an operation is called from.
struct CallPlace {
  /// The scope of the shape below on the shape stack.
  const Frame& previousScope;
  const Vec3& previousSize;
  /// The rule file, for asset paths.
  std::string_view file;
  /// Part of the address of random draws.
  uint64_t site = 0;
  /// The signature that the analysis chose; null where the values decide.
  const Signature* form = nullptr;
  /// For calls with constant arguments; null where nothing is kept.
  BoundArguments* bound = nullptr;
};

/// A leaf that came of an operation's children, in the frame of the rule call.
struct Gathered {
  Shape shape;
  /// Set by the operation: it is no leaf of the result any more.
  bool taken = false;
};

class OpCall {
 public:
  /// `block` may be null for operations without one.
  OpCall(const OpSpec& spec, Shape& shape, std::span<const Value> args, Services& services,
         const CallPlace& place, BlockInput* block = nullptr)
      : spec_(spec),
        shape_(shape),
        args_(args),
        services_(services),
        place_(place),
        block_(block) {}

  const OpSpec& spec() const { return spec_; }
  Shape& shape() { return shape_; }
  /// The scope of the shape below on the shape stack: that of the shape when its rule, its block
  /// slot or its bracket began.
  const Frame& previousScope() const {
    GABLE_DCHECK(services_.mayAsk(kReadsPrevious));
    return place_.previousScope;
  }
  const Vec3& previousSize() const {
    GABLE_DCHECK(services_.mayAsk(kReadsPrevious));
    return place_.previousSize;
  }

  /// Fills the struct of arguments; see program/arguments.h and typed below.
  Status bind(void* arguments) const;
  /// Where they are kept for the next run of this call; null where they are not.
  BoundArguments* bound() const { return place_.bound; }
  /// What this call may ask its services for: the effects of the specification, narrowed or widened
  /// by the words among the arguments and in the block.
  uint32_t effects() const;
  /// Runs the operation, or its second part. Builds with checks hold it to effects().
  Status run();
  Status runGathered(std::span<Gathered> leaves);

  // The block.
  SplitBlock splitBlock() const { return block_ ? block_->split : SplitBlock{}; }
  std::span<const SelectorItem> selectors() const {
    return block_ ? block_->selectors : std::span<const SelectorItem>{};
  }
  /// The number of slots of a block of operations or operands (0 without a block).
  uint32_t slotCount() const { return block_ ? block_->slotCount : 0; }

  /// The size that what comes of a slot is meant to have; 0 along an axis for any.
  Vec3 preferredSize(uint32_t slot) const {
    if (!block_ || slot >= block_->preferredSizes.size()) return {};
    const std::array<double, 3>& p = block_->preferredSizes[slot];
    return {p[0], p[1], p[2]};
  }

  /// The figure that the operations of a slot begin with, as a number of Program::figures plus 1;
  /// 0 for none. See drawFigure in shape/argument.h.
  uint32_t figureCode(uint32_t slot) const {
    return block_ && slot < block_->figures.size() ? block_->figures[slot] : 0;
  }

  /// Gives out a child for a block slot. Its address for randomness is derived from shape().path,
  /// the slot and `piece`, which must differ among children of one slot.
  void emit(Shape child, uint32_t slot, uint32_t piece);
  /// Gives out the parts of shape(), a box or a rectangle without uv coordinates, along an axis.
  /// With `flatten` a rectangle has no extent square to its plane afterwards. `repeatable` when the
  /// pieces follow from the block, the arguments and the extent along the axis alone: the runtime
  /// may then do without the operation next time.
  void emitParts(Axis axis, bool flatten, std::span<const SplitPiece> pieces, bool repeatable);
  /// For component splits, which run as a function too: says how many components there are, and
  /// that one of them is in the child given out last.
  void countComponents(size_t count) {
    if (block_->componentChild) block_->componentChild->assign(count, BlockInput::kNoChild);
  }
  void placeComponent(size_t component) {
    if (block_->componentChild)
      (*block_->componentChild)[component] = static_cast<uint32_t>(block_->children->size() - 1);
  }
  /// The children are derived to their leaves, and OpSpec::gathered then gets these before the rule
  /// goes on with shape(). Where it succeeds the operation counts as one without children.
  /// `origins`: the children have origins (geom/mesh/origins.h). The runtime has the shapes that
  /// come of them begin where their parents end; those that are deleted or that end in others are
  /// given too, marked as deleted.
  void gather(bool origins = false) {
    gathers_ = true;
    keepsOrigins_ = origins;
  }
  bool gathers() const { return gathers_; }
  bool keepsOrigins() const { return keepsOrigins_; }
  /// Deletes the shape (NIL): nothing after the operation runs.
  void drop() { dropped_ = true; }
  bool dropped() const { return dropped_; }

  Services& services() const { return services_; }
  const Frame& world() const { return services_.world(); }
  /// The rule file of the instruction, for asset paths.
  std::string_view file() const { return place_.file; }
  /// The address of the k-th draw of this call.
  uint64_t randomAddress(uint64_t k) const {
    GABLE_DCHECK(services_.mayAsk(kRandom));
    return hashCombine(hashCombine(shape_.path, place_.site), k);
  }

  [[gnu::cold]] Status fail(const char* code, std::string message, std::string hint = {}) const {
    return Status::failure(code, std::move(message), std::move(hint));
  }
  /// For what could not be done: the block's part `otherwise` gets the shape, and all is well; the
  /// failure where there is none.
  Status orElse(Status failure);
  /// For operations after which the shape goes on: where nothing could be done, `otherwise` gets
  /// the shape, which then ends here. False without such a part.
  bool giveToOtherwise();

 private:
  const OpSpec& spec_;
  Shape& shape_;
  std::span<const Value> args_;
  Services& services_;
  const CallPlace& place_;
  BlockInput* block_;
  bool dropped_ = false, gathers_ = false, keepsOrigins_ = false;
};

class FunctionCall {
 public:
  /// `spec` and `form` as with operations; both null for the getters of shape attributes.
  FunctionCall(std::span<const Value> args, const Shape& shape, Services& services,
               const FunctionSpec* spec = nullptr, const Signature* form = nullptr)
      : args_(args), shape_(shape), services_(services), spec_(spec), form_(form) {}

  /// Fills the struct of arguments; false when a value does not fit, which is reported.
  bool bind(void* arguments) const;
  /// What a call gives that cannot be done: 0, false or an empty text, by what it would give.
  Value zero() const;
  /// Runs a function or a getter. Builds with checks hold it to the effects of its specification,
  /// narrowed or widened as OpCall::effects() says.
  Value run(Value (*function)(FunctionCall&), uint32_t effects);

  const Shape& shape() const { return shape_; }
  /// A text or an array; one that is longer than allowed is reported, and empty.
  Value result(std::string_view text) const;
  Value result(Array a) const;

  Services& services() const { return services_; }
  std::string_view file() const { return file_; }
  uint64_t randomAddress(uint64_t k) const {
    GABLE_DCHECK(services_.mayAsk(kRandom));
    return hashCombine(hashCombine(shape_.path, site_), k);
  }
  /// Reports the author's mistake at this call; the caller then gets the returned value.
  [[gnu::cold]] Value fail(const char* code, std::string message, std::string hint,
                           Value otherwise) const;

  void place(std::string_view file, uint64_t site) {
    file_ = file;
    site_ = site;
  }

 private:
  std::span<const Value> args_;
  const Shape& shape_;
  Services& services_;
  const FunctionSpec* spec_ = nullptr;
  const Signature* form_ = nullptr;
  std::string_view file_;
  uint64_t site_ = 0;
};

namespace arguments_detail {

template <auto Call>
struct Typed;

template <class A, Status (*Apply)(OpCall&, const A&)>
struct Typed<Apply> {
  static Status call(OpCall& c) {
    constexpr bool fits = sizeof(A) <= sizeof(BoundArguments::room) &&
                          alignof(A) <= alignof(std::max_align_t) &&
                          std::is_trivially_copyable_v<A>;
    if constexpr (fits) {
      BoundArguments* const kept = c.bound();
      if (kept && kept->known) return Apply(c, *reinterpret_cast<const A*>(kept->room));
    }
    A arguments;
    if (Status s = c.bind(&arguments); !s.ok()) return c.orElse(std::move(s));
    if constexpr (fits) {
      if (BoundArguments* const kept = c.bound()) {
        ::new (static_cast<void*>(kept->room)) A(arguments);
        kept->known = true;
      }
    }
    return Apply(c, arguments);
  }
};

template <class A, Value (*Function)(FunctionCall&, const A&)>
struct Typed<Function> {
  static Value call(FunctionCall& c) {
    A arguments;
    return c.bind(&arguments) ? Function(c, arguments) : c.zero();
  }
};

template <auto Apply>
struct Light;

template <class A, bool (*Apply)(LightPart&, const A&)>
struct Light<Apply> {
  static_assert(sizeof(A) <= LightOp::kRoom && alignof(A) <= alignof(std::max_align_t));
  static_assert(std::is_trivially_copyable_v<A>);
  static void construct(void* room) { ::new (room) A; }
  static bool apply(LightPart& part, const void* arguments) {
    return Apply(part, *static_cast<const A*>(arguments));
  }
};

}  // namespace arguments_detail

/// The entry of a spec for an operation or function that receives its arguments in a struct:
///   Status applyResize(OpCall& call, const Resize& args);   ... typed<applyResize>
template <auto Call>
inline constexpr auto typed = &arguments_detail::Typed<Call>::call;

/// The same for the short form on light parts: bool applyLight(LightPart&, const Resize&).
template <auto Apply>
inline constexpr LightOp typedLight{&arguments_detail::Light<Apply>::construct,
                                    &arguments_detail::Light<Apply>::apply};

}  // namespace gable
