// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/light_slots.h"

#include <algorithm>

#include "program/arguments.h"
#include "runtime/door.h"

namespace gable {

namespace {

// Longer chains of calls are not worth following.
constexpr uint8_t kMostCalls = 8;

}  // namespace

// A split that ends its code and has nothing to be computed.
bool LightSlots::isPlainSplit(const Instruction& at) const {
  if (!flat_ || at.code != Code::OperationConstant || at.y == 0) return false;
  const BlockCode& block = program_.blocks[at.y - 1u];
  return block.kind == BlockKind::Split && !block.constantSizes.empty() &&
         (&at)[2].code == Code::End;
}

// False when the operation has no form for light parts, or its arguments are not plain constants.
bool LightSlots::addStep(LightSlot& slot, const Instruction& at) const {
  ValuePool& pool = *program_.pool;
  const auto& operation = program_.operations[at.a];
  const OpSpec& spec = *operation;
  if (!spec.light.apply || at.y > 0) return false;
  if (at.code == Code::Operation && at.x > 0) return false;
  const Value* args = at.x > 0 ? program_.constants.data() + (&at)[1].a : nullptr;
  if (!allHold({args, at.x}, pool)) return false;
  LightSlot::Step step;
  step.apply = spec.light.apply;
  spec.light.construct(step.arguments);
  const ArgumentProblem problem =
      bindArguments(spec.signatures, operation.form, {args, at.x}, pool, step.arguments);
  if (problem.kind != ArgumentProblem::Kind::None) return false;
  slot.steps.push_back(step);
  return true;
}

bool LightSlots::addCall(LightSlot& slot, const Instruction& at) const {
  const RuleCode& called = program_.rules[at.a];
  if (at.x > 0 || (&at)[1].code != Code::End || called.needsPrevious || slot.boundary ||
      slot.calls == kMostCalls) {
    return false;
  }
  // The steps behind it work in the rule's own frame.
  if (called.shared && (!flat_ || !slot.steps.empty())) return false;
  slot.boundary = called.shared;
  ++slot.calls;
  slot.rule = at.a;
  slot.name = called.name;
  slot.source = called.entry;
  return true;
}

const RuleCode* LightSlots::takerAt(const Instruction& at) const {
  if (at.code != Code::CallRule || at.x > 0 || (&at)[1].code != Code::End) return nullptr;
  const RuleCode& called = program_.rules[at.a];
  const bool blind = (called.reads.effects & (kReadsSplit | kReadsPivot)) == 0;
  return called.shared && blind ? &called : nullptr;
}

LightSlot LightSlots::slotAt(uint32_t rule, uint32_t entry) const {
  LightSlot slot;
  slot.rule = rule;
  slot.name = program_.rules[rule].name;
  slot.source = program_.rules[rule].entry;
  const Instruction* at = program_.code.data() + entry;
  for (;; ++at) {
    switch (at->code) {
      case Code::Operation:
      case Code::OperationConstant:
        if (isPlainSplit(*at)) {
          slot.block = at->y;
          slot.light = true;
          return slot;
        }
        if (!addStep(slot, *at)) return {};
        if (at->code == Code::OperationConstant) ++at;
        break;
      case Code::CallRule:
        if (!addCall(slot, *at)) return {};
        at = program_.code.data() + program_.rules[at->a].entry - 1;
        break;
      case Code::Leaf:
        if (at[1].code != Code::End) return {};
        slot.named = true;
        slot.name = program_.constants[at->a].id;
        slot.source = static_cast<uint32_t>(at - program_.code.data());
        slot.light = true;
        return slot;
      case Code::Drop: slot.drop = true; [[fallthrough]];
      case Code::End: slot.light = true; return slot;
      default: return {};
    }
  }
}

void LightSlots::fill(std::vector<LightSlot>& slots, uint32_t block, uint32_t rule) const {
  // All or nothing: memory may be refused.
  std::vector<LightSlot> all;
  for (const uint32_t entry : program_.blocks[block].slots) {
    LightSlot slot = slotAt(rule, entry);
    slot.taker = takerAt(program_.code[entry]);
    const uint32_t own = slot.named ? 1 : 0;
    slot.shapes = slot.block > 0 ? slot.calls : std::max<uint32_t>(slot.calls + own, 1);
    slot.work = slot.shapes + static_cast<uint32_t>(slot.steps.size()) + (slot.block > 0 ? 1 : 0);
    all.push_back(std::move(slot));
  }
  slots = std::move(all);
}

}  // namespace gable
