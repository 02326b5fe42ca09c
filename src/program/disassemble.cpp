// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <map>

#include "program/program.h"

namespace gable {

namespace {

constexpr const char* kNames[] = {"constant",   "parameter",
                                  "attribute",  "shape-attribute",
                                  "function",   "builtin",
                                  "negate",     "not",
                                  "binary",     "array",
                                  "range",      "index",
                                  "with-unit",  "to-bool",
                                  "jump",       "jump-if-false",
                                  "and-jump",   "or-jump",
                                  "choose",     "jump-table",
                                  "return",     "component-values",
                                  "operation",  "operation-constant",
                                  "operand",    "call",
                                  "run",        "begin-turns",
                                  "end-turn",   "begin-locals",
                                  "bind",       "end-locals",
                                  "leaf",       "set",
                                  "initialise", "set-shape-attribute",
                                  "push-shape", "pop-shape",
                                  "drop",       "end"};
static_assert(std::size(kNames) == static_cast<size_t>(Code::End) + 1);

std::string quoted(const Value& v, const ValuePool& pool) {
  if (v.type == ValueType::Code) return "argument " + std::to_string(v.id);
  const bool text = v.type == ValueType::String;
  const char* unit = v.unit == Unit::Relative ? "'" : v.unit == Unit::Floating ? "~" : "";
  return unit + (text ? "\"" + pool.str(v) + "\"" : pool.str(v));
}

std::string operandText(const Program& p, const Instruction& i) {
  switch (i.code) {
    case Code::Constant:
    case Code::Leaf: return quoted(p.constants[i.a], *p.pool);
    case Code::RuleAttribute:
    case Code::SetAttribute:
    case Code::Bind:
    case Code::Initialise: return p.attributes[i.a].name;
    case Code::BuiltinAttribute:
    case Code::SetBuiltin: return p.builtinAttributes[i.a]->name;
    case Code::Function: return std::string(p.pool->text(p.functions[i.a].name));
    case Code::BuiltinFunction: return p.builtinFunctions[i.a]->name;
    case Code::Operation:
    case Code::OperationConstant: return p.operations[i.a]->name;
    case Code::ComponentValues: return "block " + std::to_string(i.a);
    case Code::RunRule:
    case Code::CallRule: return p.rules[i.a].qualifiedName;
    case Code::Binary: return std::to_string(i.x);
    case Code::Parameter:
    case Code::Jump:
    case Code::JumpIfFalse:
    case Code::JumpIfFalseKeep:
    case Code::JumpIfTrueKeep:
    case Code::JumpTable:
    case Code::BeginTurns:
    case Code::EndTurn:
    case Code::Operand:
    case Code::MakeArray: return std::to_string(i.a);
    default: return {};
  }
}

}  // namespace

std::string disassemble(const Program& p) {
  std::map<uint32_t, std::string> labels;
  for (const RuleCode& r : p.rules) {
    labels[r.entry] += "rule " + r.qualifiedName + (r.shared ? " (shared)" : "") + ":\n";
  }
  for (const FunctionCode& f : p.functions) {
    labels[f.entry] += "function " + std::string(p.pool->text(f.name)) + ":\n";
  }
  for (const AttributeCode& a : p.attributes) labels[a.entry] += "attribute " + a.name + ":\n";
  for (size_t b = 0; b < p.blocks.size(); ++b) {
    for (size_t s = 0; s < p.blocks[b].slots.size(); ++s) {
      labels[p.blocks[b].slots[s]] +=
          "slot " + std::to_string(s) + " of block " + std::to_string(b) + ":\n";
    }
  }
  std::string out;
  for (uint32_t at = 0; at < p.code.size(); ++at) {
    const Instruction& i = p.code[at];
    if (const auto label = labels.find(at); label != labels.end()) out += label->second;
    out += "  " + std::to_string(at) + " " + kNames[static_cast<size_t>(i.code)];
    const std::string operand = operandText(p, i);
    if (!operand.empty()) out += " " + operand;
    const bool takesBlock = i.code == Code::Operation || i.code == Code::OperationConstant;
    if (takesBlock && i.y > 0) out += " block " + std::to_string(i.y - 1);
    out += "\n";
  }
  return out;
}

}  // namespace gable
