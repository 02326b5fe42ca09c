// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Rules, functions and initialisers are the units of a program; each is hashed on its own, and the
// hashes are folded along the graph of calls. Units that call each other in a circle are folded as
// one: strongly connected components, found in one walk (Tarjan, "Depth-first search and linear
// graph algorithms", 1972), which also gives them in an order where callees come first.

#include "program/reach.h"

#include <algorithm>
#include <bit>

#include "base/hash.h"

namespace gable {

namespace {

struct CodeUnit {
  uint32_t entry = 0, end = 0;
  uint64_t own = 0;
  /// Units that it calls or asks, and attributes that it reads.
  std::vector<uint32_t> calls, attributes;
  bool sets = false;
  /// An operation of it waits for what comes of its children.
  bool gathers = false;
  /// Instructions that ask for room.
  std::vector<uint32_t> asking;
};

// The numbers of the bits that are set.
void appendNumbers(const std::vector<uint64_t>& bits, std::vector<uint32_t>& out) {
  for (uint32_t w = 0; w < bits.size(); ++w) {
    for (uint64_t rest = bits[w]; rest != 0; rest &= rest - 1) {
      out.push_back(w * 64 + static_cast<uint32_t>(std::countr_zero(rest)));
    }
  }
}

class Hash {
 public:
  Hash& add(uint64_t v) {
    h_ = hashCombine(h_, v);
    return *this;
  }
  Hash& add(std::string_view text) { return add(hashBytes(text)); }
  Hash& add(double v) { return add(hashDouble(v)); }
  uint64_t value() const { return h_; }

 private:
  uint64_t h_ = 0;
};

class Units {
 public:
  explicit Units(const Program& p) : p_(p) {
    const auto add = [&](const auto& code) { units_.emplace_back().entry = code.entry; };
    for (const RuleCode& r : p.rules) add(r);
    for (const FunctionCode& f : p.functions) add(f);
    for (const AttributeCode& a : p.attributes) add(a);
    findEnds();
    for (uint32_t u = 0; u < units_.size(); ++u) read(u);
  }

  std::vector<CodeUnit> take() { return std::move(units_); }

 private:
  uint32_t functionUnit(uint32_t f) const { return static_cast<uint32_t>(p_.rules.size()) + f; }
  uint32_t attributeUnit(uint32_t a) const {
    return functionUnit(static_cast<uint32_t>(p_.functions.size())) + a;
  }

  // Units lie in the code one after the other.
  void findEnds() {
    std::vector<uint32_t> entries;
    for (const CodeUnit& u : units_) entries.push_back(u.entry);
    std::sort(entries.begin(), entries.end());
    for (CodeUnit& u : units_) {
      const auto next = std::upper_bound(entries.begin(), entries.end(), u.entry);
      u.end = next == entries.end() ? static_cast<uint32_t>(p_.code.size()) : *next;
    }
  }

  void read(uint32_t number) {
    CodeUnit& u = units_[number];
    Hash h;
    addHead(h, number);
    for (uint32_t at = u.entry; at < u.end; ++at) {
      const Instruction& i = p_.code[at];
      h.add(uint64_t{static_cast<uint8_t>(i.code)} << 8 | i.x).add(p_.sites[at]);
      addOperand(h, u, at);
    }
    u.own = h.value();
  }

  void addHead(Hash& h, uint32_t number) const {
    if (number < p_.rules.size()) {
      const RuleCode& r = p_.rules[number];
      h.add(r.qualifiedName).add(p_.pool->text(r.name)).add(p_.files[r.file]);
      h.add(uint64_t{r.parameters.size()});
      h.add(uint64_t{r.shared} << 1 | uint64_t{r.needsPrevious});
      h.add(uint64_t{r.reads.effects});
    } else if (number < attributeUnit(0)) {
      h.add(uint64_t{p_.functions[number - functionUnit(0)].parameterCount});
    } else {
      const AttributeCode& a = p_.attributes[number - attributeUnit(0)];
      h.add(a.name).add(static_cast<uint64_t>(a.type) << 1 | uint64_t{a.constant});
    }
  }

  template <class Spec>
  void addChoice(Hash& h, const Choice<Spec>& c) const {
    h.add(std::string_view(c->name));
    h.add(c.form ? static_cast<uint64_t>(c.form - c->signatures.data()) + 1 : uint64_t{0});
  }

  void addOperand(Hash& h, CodeUnit& u, uint32_t at) {
    const Instruction& i = p_.code[at];
    switch (i.code) {
      case Code::Constant:
      case Code::Leaf: addValue(h, u, p_.constants[i.a]); break;
      case Code::RuleAttribute: u.attributes.push_back(i.a); [[fallthrough]];
      case Code::Initialise: u.calls.push_back(attributeUnit(i.a)); [[fallthrough]];
      case Code::SetAttribute:
      case Code::Bind:
        u.sets = u.sets || i.code == Code::SetAttribute || i.code == Code::Bind;
        h.add(p_.attributes[i.a].name);
        break;
      case Code::BuiltinAttribute:
      case Code::SetBuiltin: h.add(std::string_view(p_.builtinAttributes[i.a]->name)); break;
      case Code::Function: u.calls.push_back(functionUnit(i.a)); break;
      case Code::BuiltinFunction: addChoice(h, p_.builtinFunctions[i.a]); break;
      case Code::RunRule:
      case Code::CallRule:
        h.add(p_.rules[i.a].qualifiedName);
        u.calls.push_back(i.a);
        break;
      case Code::Operation:
      case Code::OperationConstant:
      case Code::ComponentValues:
        addChoice(h, p_.operations[i.a]);
        u.gathers = u.gathers || p_.operations[i.a]->gathered != nullptr;
        if ((p_.operations[i.a]->effects & kAsksForRoom) != 0) u.asking.push_back(at);
        if (i.code == Code::OperationConstant) addConstants(h, u, p_.code[at + 1].a, i.x);
        if (i.y > 0) addBlock(h, u, p_.blocks[i.y - 1u]);
        break;
      case Code::Jump:
      case Code::JumpIfFalse:
      case Code::JumpIfFalseKeep:
      case Code::JumpIfTrueKeep:
      case Code::BeginTurns:
      case Code::EndTurn: h.add(uint64_t{i.a - u.entry}); break;
      case Code::JumpTable:
        for (const uint32_t to : p_.jumpTables[i.a]) h.add(uint64_t{to - u.entry});
        break;
      case Code::MakeArray:
        for (const uint32_t count : p_.jumpTables[i.a]) h.add(uint64_t{count});
        break;
      case Code::Operand: break;
      default: h.add(uint64_t{i.a} << 16 | i.y); break;
    }
  }

  void addConstants(Hash& h, const CodeUnit& u, uint32_t first, uint32_t count) const {
    for (uint32_t c = first; c < first + count; ++c) addValue(h, u, p_.constants[c]);
  }

  // The code of an argument lies in the unit; here is where it begins.
  void addCode(Hash& h, const CodeUnit& u, const ValueCode& v) const {
    if (v.isConstant()) {
      h.add(v.constant.hash());
    } else {
      h.add(uint64_t{v.entry - u.entry} << 1 | 1);
    }
  }
  void addValue(Hash& h, const CodeUnit& u, const Value& v) const {
    if (v.type != ValueType::Code) {
      h.add(v.hash());
      return;
    }
    const ArgumentCode& argument = p_.arguments[v.id];
    h.add(argument.terms.size() << 1 | uint64_t{argument.list});
    for (const ArgumentTerm& t : argument.terms) {
      h.add(static_cast<uint64_t>(t.kind) << 40 | static_cast<uint64_t>(t.unit) << 32 | t.operands);
      h.add(std::string_view(t.spec ? t.spec->name : ""));
      for (const ValueCode& c : t.values) addCode(h, u, c);
    }
  }
  void addFigure(Hash& h, const CodeUnit& u, uint32_t number) const {
    // Figures of a block are numbered after each other; their order says how they hang together.
    const FigureCode& f = p_.figures[number];
    h.add(static_cast<uint64_t>(f.kind) << 32 | f.ordinal);
    h.add(uint64_t{f.children.size()});
    if (f.spec) addChoice(h, Choice<OpSpec>{f.spec, f.form});
    for (const ValueCode& v : f.values) addCode(h, u, v);
    for (const uint32_t c : f.children) addFigure(h, u, c);
  }

  void addBlock(Hash& h, const CodeUnit& u, const BlockCode& b) const {
    h.add(static_cast<uint64_t>(b.kind) << 34 | uint64_t{b.condition} << 33 |
          uint64_t{b.repeat} << 32 | b.valueCount);
    for (const BlockItem& i : b.items) {
      h.add(uint64_t{i.length} << 32 | uint64_t{i.selectOperator} << 2 | uint64_t{i.group} << 1 |
            uint64_t{i.repeat});
      h.add(uint64_t{i.firstTerm} << 32 | i.termCount).add(uint64_t{i.slot});
    }
    for (const BlockTerm& t : b.terms) {
      h.add(uint64_t{t.kind} << 32 | t.word).add(uint64_t{static_cast<uint32_t>(t.value)});
      h.add(t.number);
    }
    for (const uint32_t s : b.slots) h.add(uint64_t{s - u.entry});
    for (const auto& size : b.preferredSizes) {
      for (const double v : size) h.add(v);
    }
    for (const Value& v : b.constantSizes) h.add(v.hash());
    for (const uint32_t f : b.figures) {
      h.add(uint64_t{f != 0});
      if (f != 0) addFigure(h, u, f - 1);
    }
  }

  const Program& p_;
  std::vector<CodeUnit> units_;
};

// Tarjan's walk with a stack of its own: chains of calls may be long.
class Folding {
 public:
  explicit Folding(const std::vector<CodeUnit>& units, size_t attributes)
      : units_(units), words_((attributes + 63) / 64), state_(units.size()) {}

  /// The hash of a unit's component with all below it, and the attributes it reads as bits.
  struct Component {
    uint64_t code = 0;
    std::vector<uint64_t> attributes;
    bool sets = false;
  };

  const Component& of(uint32_t unit) {
    if (state_[unit].component == kNone) walk(unit);
    return components_[state_[unit].component];
  }

 private:
  static constexpr uint32_t kNone = 0xffffffff;
  struct State {
    uint32_t index = kNone, low = kNone, component = kNone;
  };
  struct Frame {
    uint32_t unit;
    size_t next;
  };

  void walk(uint32_t root) {
    std::vector<Frame> frames;
    const auto enter = [&](uint32_t unit) {
      state_[unit].index = state_[unit].low = count_++;
      open_.push_back(unit);
      frames.push_back({unit, 0});
    };
    enter(root);
    while (!frames.empty()) {
      const uint32_t unit = frames.back().unit;
      State& s = state_[unit];
      if (frames.back().next < units_[unit].calls.size()) {
        const uint32_t to = units_[unit].calls[frames.back().next++];
        if (state_[to].index == kNone)
          enter(to);
        else if (state_[to].component == kNone)
          s.low = std::min(s.low, state_[to].index);
        continue;
      }
      if (s.low == s.index) close(unit);
      frames.pop_back();
      if (!frames.empty()) {
        State& above = state_[frames.back().unit];
        above.low = std::min(above.low, s.low);
      }
    }
  }

  void close(uint32_t unit) {
    const auto number = static_cast<uint32_t>(components_.size());
    std::vector<uint32_t> members;
    do {
      members.push_back(open_.back());
      open_.pop_back();
      state_[members.back()].component = number;
    } while (members.back() != unit);
    Component c;
    c.attributes.assign(words_, 0);
    std::vector<uint64_t> parts;
    for (const uint32_t m : members) {
      parts.push_back(units_[m].own);
      c.sets = c.sets || units_[m].sets;
      for (const uint32_t a : units_[m].attributes) c.attributes[a / 64] |= uint64_t{1} << a % 64;
      for (const uint32_t to : units_[m].calls) {
        if (state_[to].component == number) continue;
        const Component& below = components_[state_[to].component];
        parts.push_back(below.code);
        c.sets = c.sets || below.sets;
        for (size_t w = 0; w < words_; ++w) c.attributes[w] |= below.attributes[w];
      }
    }
    // The order of units in the program does not count.
    std::sort(parts.begin(), parts.end());
    parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
    for (const uint64_t part : parts) c.code = hashCombine(c.code, part);
    components_.push_back(std::move(c));
  }

  const std::vector<CodeUnit>& units_;
  const size_t words_;
  std::vector<State> state_;
  std::vector<uint32_t> open_;
  uint32_t count_ = 0;
  std::vector<Component> components_;
};

// Goes through the rules that are not left out.
class Within {
 public:
  Within(const Program& program, const std::vector<CodeUnit>& units, uint32_t effects)
      : program_(program),
        effects_(effects),
        units_(units),
        folding_(units_, program.attributes.size()),
        met_(program.rules.size()),
        bits_((program.attributes.size() + 63) / 64) {}

  Reach of(std::span<const uint32_t> roots) {
    for (const uint32_t root : roots) meet(root);
    std::vector<uint64_t> parts;
    while (!open_.empty()) {
      const uint32_t rule = open_.back();
      open_.pop_back();
      parts.push_back(hashOf(rule));
    }
    std::sort(parts.begin(), parts.end());
    Reach out;
    for (const uint64_t part : parts) out.code = hashCombine(out.code, part);
    out.setsAttributes = sets_;
    appendNumbers(bits_, out.attributes);
    return out;
  }

 private:
  void meet(uint32_t rule) {
    if (met_[rule]) return;
    met_[rule] = true;
    open_.push_back(rule);
  }

  uint64_t hashOf(uint32_t rule) {
    const CodeUnit& u = units_[rule];
    Hash h;
    h.add(u.own);
    for (const uint32_t at : u.asking) {
      const Span& span = program_.spans[at];
      h.add(uint64_t{span.file}).add(uint64_t{span.begin} << 32 | span.end);
    }
    sets_ = sets_ || u.sets;
    for (const uint32_t to : u.calls) {
      const bool isRule = to < program_.rules.size();
      if (isRule && !u.gathers) {
        if ((program_.rules[to].reads.effects & effects_) != 0) meet(to);
      } else if (isRule || isRead(u, to)) {
        h.add(whole(to));
      }
    }
    for (const uint32_t a : u.attributes) bits_[a / 64] |= uint64_t{1} << a % 64;
    return h.value();
  }

  // What a shape is merely given says nothing.
  bool isRead(const CodeUnit& u, uint32_t unit) const {
    const size_t first = program_.rules.size() + program_.functions.size();
    return unit < first ||
           std::find(u.attributes.begin(), u.attributes.end(), unit - first) != u.attributes.end();
  }

  uint64_t whole(uint32_t unit) {
    const Folding::Component& c = folding_.of(unit);
    for (size_t w = 0; w < bits_.size(); ++w) bits_[w] |= c.attributes[w];
    return hashCombine(c.code, units_[unit].own);
  }

  const Program& program_;
  const uint32_t effects_;
  const std::vector<CodeUnit>& units_;
  Folding folding_;
  std::vector<bool> met_;
  std::vector<uint32_t> open_;
  std::vector<uint64_t> bits_;
  bool sets_ = false;
};

}  // namespace

struct Reaches::Impl {
  const Program& program;
  std::vector<CodeUnit> units;
};

Reaches::Reaches(const Program& program)
    : impl_(std::make_unique<const Impl>(Impl{program, Units(program).take()})) {}

Reaches::~Reaches() = default;

std::vector<Reach> Reaches::all() const {
  const std::vector<CodeUnit>& units = impl_->units;
  const Program& program = impl_->program;
  Folding folding(units, program.attributes.size());
  std::vector<Reach> out(program.rules.size());
  for (uint32_t r = 0; r < out.size(); ++r) {
    const Folding::Component& c = folding.of(r);
    out[r].code = hashCombine(c.code, units[r].own);
    out[r].setsAttributes = c.sets;
    appendNumbers(c.attributes, out[r].attributes);
  }
  return out;
}

Reach Reaches::within(std::span<const uint32_t> roots, uint32_t effects) const {
  return Within(impl_->program, impl_->units, effects).of(roots);
}

}  // namespace gable
