// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "lang/compile/dependence.h"

#include <algorithm>
#include <iterator>
#include <set>

namespace gable::lang {

namespace {

constexpr uint32_t kUnshareable = kReadsWorld | kRandom | kReadsContext | kReadsPath | kLabels |
                                  kReadsInitialShape | kAsksForRoom;

/// What the result of a unit depends on, as far as it is known.
struct Closed {
  uint32_t effects = 0;
  /// Ascending.
  std::vector<uint32_t> attributes;
};

std::vector<Closed> ownOf(const std::vector<Uses>& units) {
  std::vector<Closed> out;
  out.reserve(units.size());
  for (const Uses& u : units) {
    out.push_back({u.effects, {u.attributes.begin(), u.attributes.end()}});
  }
  return out;
}

// Rules, functions and initialisers of attributes, as they use each other.
class Closing {
 public:
  Closing(const std::vector<Uses>& rules, const std::vector<Uses>& functions,
          const std::vector<Uses>& initialisers)
      : functions_{functions, ownOf(functions)},
        initialisers_{initialisers, ownOf(initialisers)},
        rules_{rules, ownOf(rules)} {}

  // Chaotic iteration to the least fixed point; sets only grow, so it ends.
  std::vector<Closed> rules() {
    for (bool changed = true; changed;) {
      changed = false;
      for (Kind* kind : {&functions_, &initialisers_, &rules_}) {
        for (size_t u = 0; u < kind->uses.size(); ++u) {
          changed |= includeUsed(kind->closed[u], kind->uses[u]);
        }
      }
    }
    return std::move(rules_.closed);
  }

 private:
  struct Kind {
    const std::vector<Uses>& uses;
    std::vector<Closed> closed;
  };

  bool includeUsed(Closed& to, const Uses& uses) {
    bool changed = false;
    const auto add = [&](const std::set<uint32_t>& used, const Kind& from) {
      for (const uint32_t u : used) {
        if (&from.closed[u] != &to) changed |= include(to, from.closed[u]);
      }
    };
    add(uses.functions, functions_);
    add(uses.initialisers, initialisers_);
    add(uses.rules, rules_);
    return changed;
  }

  // Adds what `from` depends on to `to`; true when that was news.
  bool include(Closed& to, const Closed& from) {
    const uint32_t effects = to.effects;
    // Whether the shape below is looked at matters to the rule itself alone.
    to.effects |= from.effects & ~uint32_t{kReadsPrevious};
    if (std::includes(to.attributes.begin(), to.attributes.end(), from.attributes.begin(),
                      from.attributes.end())) {
      return to.effects != effects;
    }
    scratch_.clear();
    std::set_union(to.attributes.begin(), to.attributes.end(), from.attributes.begin(),
                   from.attributes.end(), std::back_inserter(scratch_));
    to.attributes.assign(scratch_.begin(), scratch_.end());
    return true;
  }

  Kind functions_, initialisers_, rules_;
  std::vector<uint32_t> scratch_;
};

}  // namespace

void closeDependence(Program& program, const std::vector<Uses>& rules,
                     const std::vector<Uses>& functions, const std::vector<Uses>& initialisers) {
  std::vector<Closed> closed = Closing(rules, functions, initialisers).rules();
  for (size_t i = 0; i < program.rules.size(); ++i) {
    RuleCode& code = program.rules[i];
    code.reads.effects = closed[i].effects;
    code.reads.attributes = std::move(closed[i].attributes);
    code.shared = rules[i].branches && (code.reads.effects & kUnshareable) == 0;
  }
}

}  // namespace gable::lang
