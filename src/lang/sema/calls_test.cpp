// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What is said of calls of rules that do not fit.

#include <gtest/gtest.h>

#include "lang/sema/testing_analysed.h"

namespace gable::lang {
namespace {

TEST(Calls, callsOfRulesThatDoNotFitNameTheRulesForm) {
  const Analysed a(
      "version \"2025.1\"\nLot --> Wide(1, \"a\") Wide(1) Wide(\"a\", 1)\n"
      "Wide(by, tone) --> s(by, 1, 1) color(tone)\n");
  EXPECT_NE(a.messages().find("the argument 'by' must be a float, not a string"),
            std::string::npos);
  EXPECT_NE(a.messages().find("'Wide(by, tone)'"), std::string::npos);
}

TEST(Calls, namesOfImportsThatAreNotThereAreTold) {
  const Analysed a("import walls : \"a.cga\"\nLot --> walls.Winow street.Bench wals.Window\n",
                   {{"a.cga", "Window --> X.\n"}});
  EXPECT_NE(a.messages().find("did you mean 'walls.Window'?"), std::string::npos);
  EXPECT_NE(a.messages().find("nothing is imported as 'street'"), std::string::npos);
  EXPECT_NE(a.messages().find("nothing is imported as 'wals'; did you mean 'walls'?"),
            std::string::npos);
}

}  // namespace
}  // namespace gable::lang
