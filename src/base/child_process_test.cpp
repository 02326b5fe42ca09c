// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "base/child_process.h"

#include <gtest/gtest.h>

namespace gable {
namespace {

std::string codeOf(const std::string& program, const std::vector<std::string>& arguments,
                   const ChildLimits& limits, std::string_view input = {}) {
  const Result<std::string> r = runChild(program, arguments, input, limits);
  return r.ok() ? "ok" : r.error().code;
}

TEST(ChildProcess, givesAndTakesMoreThanPipesHold) {
  const std::string large(3'000'000, 'x');
  const Result<std::string> r = runChild("/bin/cat", {}, large, {});
  ASSERT_TRUE(r.ok()) << r.error().message;
  EXPECT_EQ(r.value(), large);
}

TEST(ChildProcess, isLimited) {
  EXPECT_EQ(codeOf("/bin/sleep", {"100"}, {0.1, 100}), "child-limit");
  EXPECT_EQ(codeOf("/usr/bin/yes", {}, {60, 100'000}), "child-limit");
}

TEST(ChildProcess, failuresAreTold) {
  EXPECT_EQ(codeOf("/no/such/program", {}, {}), "child-missing");
  EXPECT_EQ(codeOf("/bin/sh", {"-c", "exit 127"}, {}), "child-missing");
  EXPECT_EQ(codeOf("/bin/sh", {"-c", "kill -SEGV $$"}, {}), "child-failed");
  const Result<std::string> r = runChild("/bin/sh", {"-c", "printf why; exit 3"}, {}, {});
  ASSERT_FALSE(r.ok());
  EXPECT_EQ(r.error().message, "why");
  // One that takes no input ends neither itself nor us.
  EXPECT_EQ(codeOf("/bin/true", {}, {}, std::string(3'000'000, 'x')), "ok");
}

TEST(ChildProcess, programsAreFoundOnThePath) {
  EXPECT_FALSE(programBeside("sh").empty());
  EXPECT_TRUE(programBeside("no-such-program-of-gable").empty());
}

}  // namespace
}  // namespace gable
