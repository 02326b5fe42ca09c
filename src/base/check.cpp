// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "base/check.h"

#include <cstdio>
#include <cstdlib>

#include "base/check_context.h"

namespace gable {

namespace {

constinit thread_local const char* atWork = nullptr;

}  // namespace

CheckContext::CheckContext(const char* name) : before_(atWork) { atWork = name; }
CheckContext::~CheckContext() { atWork = before_; }

void checkFailed(const char* file, int line, const char* expression, const std::string& left,
                 const std::string& right) {
  std::fprintf(stderr, "%s:%d: internal check failed: %s (left %s, right %s)%s%s%s\n", file, line,
               expression, left.c_str(), right.c_str(), atWork ? " in '" : "", atWork ? atWork : "",
               atWork ? "'" : "");
  std::abort();
}

namespace detail {
std::string checkText(double v) {
  char text[64];
  std::snprintf(text, sizeof text, "%.17g", v);
  return text;
}
std::string checkText(long long v) { return std::to_string(v); }
std::string checkText(unsigned long long v) { return std::to_string(v); }
std::string checkText(bool v) { return v ? "true" : "false"; }
std::string checkText(const std::string& v) { return v; }
std::string checkText(const void* v) {
  char text[32];
  std::snprintf(text, sizeof text, "%p", v);
  return text;
}
}  // namespace detail
}  // namespace gable
