// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/message_log.h"

#include "base/hash.h"
#include "runtime/derive.h"

namespace gable {

bool MessageLog::isNews(const char* code, const Span& at, const std::string& message,
                        uint32_t initialShape) {
  ++warnings_;
  if (count() >= kMostDiagnostics) return false;
  const std::string_view what = isToldOncePerPlace(code) ? std::string_view() : message;
  const uint64_t key = hashBytes(what, hashBytes(code, uint64_t{at.file} << 32 | at.begin));
  const auto [known, fresh] = told_.try_emplace(key, Told{initialShape, unit_});
  if (fresh) return true;
  Told& last = known->second;
  if (last.initialShape < initialShape || last.unit == unit_) return false;
  last = {initialShape, unit_};
  return true;
}

}  // namespace gable
