// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Files with very many of a kind: the analysis takes time in proportion.

#include <gtest/gtest.h>

#include <ctime>
#include <functional>
#include <string>

#include "lang/parser.h"
#include "lang/sema/analyse.h"
#include "lang/sema/testing_catalogue.h"

namespace gable::lang {
namespace {

// Of this thread: others may keep the machine busy.
double processorSeconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void analysed(const std::string& text, Diagnostics& diagnostics) {
  Sources sources;
  ValuePool values;
  const uint32_t file = sources.add("main.cga", text);
  AnalysisInput input{
      std::make_shared<const Tree>(parse(sources, file, diagnostics)), "main.cga", {}};
  analyse(std::move(input), testCatalogue(), values, nullptr, sources, diagnostics);
  diagnostics.sortByPlace();
}

// Ten thousand of a kind, each naming the one before. Quadratic time took 40 seconds for styles.
TEST(Many, manyOfAKindTakeLinearTime) {
  constexpr int kMany = 10000;
  struct Kind {
    const char* first;
    std::function<std::string(const std::string& own, const std::string& before)> next;
  };
  const Kind kinds[] = {
      {"style S0\n", [](auto& i, auto& j) { return "style S" + i + " extends S" + j + "\n"; }},
      {"attr a = 0 style S0\n", [](auto& i, auto&) { return "style S" + i + " attr a = 1\n"; }},
      {"A0 --> X.\n", [](auto& i, auto& j) { return "A" + i + " --> A" + j + "\n"; }},
      {"A0 --> X.\n", [](auto& i, auto&) { return "Wall" + i + " --> Wal" + i + "\n"; }},
      {"attr a0 = 0\n", [](auto& i, auto& j) { return "attr a" + i + " = a" + j + " + 1\n"; }},
      {"const a0 = 0\n", [](auto& i, auto& j) { return "const a" + i + " = a" + j + " + 1\n"; }},
      {"f0(x) = x\n", [](auto& i, auto& j) { return "f" + i + "(x) = f" + j + "(x)\n"; }},
      {"R(p0", [](auto& i, auto&) { return ", p" + i; }}};
  for (const Kind& kind : kinds) {
    std::string text = kind.first;
    for (int i = 1; i < kMany; ++i) text += kind.next(std::to_string(i), std::to_string(i - 1));
    text += kind.first[0] == 'R' ? ") --> X.\n" : "";
    const double start = processorSeconds();
    Diagnostics diagnostics;
    analysed("Lot --> X.\n" + text, diagnostics);
    EXPECT_LT(processorSeconds() - start, 8) << text.substr(0, 60);
    EXPECT_FALSE(diagnostics.hasErrors()) << text.substr(0, 60);
  }
}

TEST(Many, styleCyclesAreFoundWhereTheyAre) {
  Diagnostics found;
  analysed(
      "Lot --> X.\nstyle A extends B\nstyle B extends C\nstyle C extends A\n"
      "style D extends A\nstyle E\nstyle F extends E",
      found);
  size_t cycles = 0;
  for (const Diagnostics::Entry& d : found.all()) cycles += d.code == "style-cycle" ? 1 : 0;
  EXPECT_EQ(cycles, 4u);
  EXPECT_EQ(found.errorCount(), 4u);
}

}  // namespace
}  // namespace gable::lang
