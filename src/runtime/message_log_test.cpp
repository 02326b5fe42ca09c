// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/message_log.h"

#include <gtest/gtest.h>

#include "runtime/derive.h"

namespace gable {
namespace {

const Span kHere{0, 10, 12}, kThere{0, 20, 22};

void warn(MessageLog& log, const Span& at, const std::string& message, uint32_t initialShape) {
  log.add(Severity::Warning, "too-small", at, message, "make it larger", initialShape,
          [] { return "Lot"; });
}

TEST(MessageLog, TellsARepetitionOnceAUnit) {
  MessageLog log;
  log.beginUnit();
  for (int i = 0; i < 3; ++i) warn(log, kHere, "it is small", 0);
  warn(log, kThere, "it is small", 0);
  warn(log, kHere, "it is tiny", 0);
  EXPECT_EQ(log.count(), 3u);
  EXPECT_EQ(log.warnings(), 5u);
  const Diagnostics taken = log.take();
  EXPECT_EQ(taken.all()[0].severity, Severity::Warning);
  EXPECT_EQ(taken.all()[0].shapePath, "Lot");
  EXPECT_EQ(log.count(), 0u);
}

TEST(MessageLog, TellsOfColoursOnceAPlace) {
  MessageLog log;
  log.beginUnit();
  const auto tint = [&](const Span& at, const char* message) {
    log.add(Severity::Warning, "tint-capped", at, message, "", 0, [] { return "Lot"; });
  };
  tint(kHere, "#ffffff becomes #a05f49");
  tint(kHere, "#eeeeee becomes #a05f49");
  tint(kThere, "#eeeeee becomes #a05f49");
  EXPECT_EQ(log.count(), 2u);
}

TEST(MessageLog, TellsOfTheFirstInitialShapeAlone) {
  MessageLog log;
  log.beginUnit();
  warn(log, kHere, "it is small", 1);
  log.beginUnit();
  warn(log, kHere, "it is small", 2);
  EXPECT_EQ(log.take().all().size(), 1u);
  // A shape that comes first in the order of shapes, but later to this worker.
  log.beginUnit();
  warn(log, kHere, "it is small", 0);
  EXPECT_EQ(log.take().all().size(), 1u);
}

TEST(MessageLog, TellsAgainInAnotherUnitOfTheSameShape) {
  MessageLog log;
  log.beginUnit();
  warn(log, kHere, "it is small", 4);
  log.beginUnit();
  // A portion of the same initial shape may come before in path order.
  warn(log, kHere, "it is small", 4);
  EXPECT_EQ(log.count(), 2u);
}

TEST(MessageLog, KeepsNoMoreThanAnybodyIsShown) {
  MessageLog log;
  log.beginUnit();
  int paths = 0;
  for (size_t i = 0; i < kMostDiagnostics + 50; ++i) {
    log.add(Severity::Warning, "too-small", kHere, std::to_string(i), "", 0, [&] {
      ++paths;
      return std::string();
    });
  }
  EXPECT_EQ(log.count(), kMostDiagnostics);
  EXPECT_EQ(log.warnings(), kMostDiagnostics + 50);
  EXPECT_EQ(static_cast<size_t>(paths), kMostDiagnostics);
}

}  // namespace
}  // namespace gable
