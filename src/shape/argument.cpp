// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "shape/argument.h"

#include <algorithm>

#include "base/random.h"

namespace gable {

namespace {

using Kind = ArgumentTerm::Kind;

Value valueOf(const ValueCode& code, const Services& services, uint64_t address,
              const Shape* as = nullptr) {
  if (code.isConstant()) return code.constant;
  return const_cast<Services&>(services).evaluate(code.entry, address, as);
}

const ArgumentCode& argumentOf(const Value& v, const Services& services) {
  return services.program()->arguments[v.id];
}

}  // namespace

double DrawnNumber::at(uint64_t address) const {
  if (code_) return services_->evaluate(code_->entry, address, nullptr).number;
  return low_ == high_ ? low_ : randomIn(address, low_, high_);
}

std::vector<DrawnNumber> numbersOf(const Value& v, const Services& services, uint64_t address,
                                   bool* isList) {
  std::vector<DrawnNumber> out;
  if (isList) *isList = v.isArray();
  if (v.isArray()) {
    for (const double n : services.pool().array(v).numbers) out.emplace_back(n);
    return out;
  }
  if (v.type != ValueType::Code) {
    out.emplace_back(v.number);
    out.back().unit_ = v.unit;
    return out;
  }
  const ArgumentCode& argument = argumentOf(v, services);
  if (isList) *isList = argument.list;
  for (const ArgumentTerm& t : argument.terms) {
    DrawnNumber n;
    n.unit_ = t.unit;
    const uint64_t own = hashCombine(address, out.size());
    if (t.kind == Kind::Range) {
      n.low_ = valueOf(t.values[0], services, hashCombine(own, 1)).number;
      n.high_ = valueOf(t.values[1], services, hashCombine(own, 2)).number;
    } else if (t.values[0].isConstant()) {
      n.low_ = n.high_ = t.values[0].constant.number;
    } else {
      n.code_ = &t.values[0];
      n.services_ = const_cast<Services*>(&services);
      constexpr uint64_t kDraws = 16;
      n.low_ = n.high_ = n.at(own);
      for (uint64_t k = 1; k < kDraws; ++k) {
        const double x = n.at(hashCombine(own, k));
        n.low_ = std::min(n.low_, x);
        n.high_ = std::max(n.high_, x);
      }
    }
    out.push_back(n);
  }
  return out;
}

DrawnNumber numberOf(const Drawn& d, const Services& services, uint64_t address) {
  const std::vector<DrawnNumber> all = numbersOf(d.value, services, address);
  return all.empty() ? DrawnNumber() : all[0];
}

std::vector<Term> termsOf(const Selection& s, const Services& services, uint64_t address) {
  std::vector<Term> out;
  if (s.value.type == ValueType::Null) return out;
  if (s.value.type != ValueType::Code) {
    Term t;
    if (s.value.type == ValueType::Selector) {
      t.kind = Kind::Term;
      t.name = services.pool().text(s.value.id);
    } else {
      t.values.push_back(s.value);
    }
    out.push_back(std::move(t));
    return out;
  }
  for (const ArgumentTerm& from : argumentOf(s.value, services).terms) {
    Term t;
    t.kind = from.kind;
    if (from.spec) t.name = from.spec->name;
    t.operands = from.operands;
    for (const ValueCode& v : from.values) {
      const uint64_t own = hashCombine(hashCombine(address, out.size()), t.values.size());
      t.values.push_back(valueOf(v, services, own));
    }
    out.push_back(std::move(t));
  }
  return out;
}

DrawnFigure drawFigure(const OpCall& call, uint32_t slot, uint64_t address, const Shape& as) {
  DrawnFigure out;
  const uint32_t root = call.figureCode(slot);
  if (root == 0) return out;
  const std::vector<FigureCode>& all = call.services().program()->figures;
  const FigureCode* f = &all[root - 1];
  const bool choice = f->kind == FigureCode::Kind::Case || f->kind == FigureCode::Kind::Percent;
  for (uint64_t level = 0;
       f->kind == FigureCode::Kind::Case || f->kind == FigureCode::Kind::Percent; ++level) {
    // Choices within choices have addresses of their own.
    const uint64_t own = level == 0 ? address : hashCombine(address, level);
    double left = randomUnit(own) * 100;
    size_t taken = 0;
    for (; taken < f->values.size(); ++taken) {
      const Value v = valueOf(f->values[taken], call.services(), hashCombine(own, taken), &as);
      if (f->kind == FigureCode::Kind::Case) {
        if (v.truth()) break;
      } else {
        left -= std::max(0.0, v.number);
        if (left < 0) break;
      }
    }
    if (taken >= f->children.size()) return out;
    f = &all[f->children[taken]];
  }
  if (choice) out.ordinal = f->ordinal;
  if (f->kind != FigureCode::Kind::Figure) return out;
  out.spec = f->spec;
  out.form = f->form;
  for (const ValueCode& v : f->values) {
    const uint64_t own = hashCombine(hashCombine(address, 0x666967), out.values.size());
    out.values.push_back(valueOf(v, call.services(), own, &as));
  }
  return out;
}

}  // namespace gable
