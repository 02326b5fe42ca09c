// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Checks for our own mistakes. A failing check prints both sides and stops the program; no input
// may ever reach one (rules, models and attributes end in a Diagnostic or a Status instead).
#pragma once

#include <string>
#include <type_traits>

namespace gable {

[[noreturn]] void checkFailed(const char* file, int line, const char* expression,
                              const std::string& left, const std::string& right);

namespace detail {
std::string checkText(double v);
std::string checkText(long long v);
std::string checkText(unsigned long long v);
std::string checkText(bool v);
std::string checkText(const std::string& v);
std::string checkText(const void* v);

template <class T>
std::string describe(const T& v) {
  if constexpr (std::is_same_v<T, bool>)
    return checkText(v);
  else if constexpr (std::is_enum_v<T>)
    return checkText(static_cast<long long>(v));
  else if constexpr (std::is_floating_point_v<T>)
    return checkText(static_cast<double>(v));
  else if constexpr (std::is_unsigned_v<T>)
    return checkText(static_cast<unsigned long long>(v));
  else if constexpr (std::is_integral_v<T>)
    return checkText(static_cast<long long>(v));
  else if constexpr (std::is_convertible_v<T, std::string>)
    return checkText(std::string(v));
  else if constexpr (std::is_pointer_v<T>)
    return checkText(static_cast<const void*>(v));
  else
    return "?";
}
}  // namespace detail
}  // namespace gable

#define GABLE_CHECK_OP(a, op, b)                                  \
  do {                                                            \
    const auto& check_a = (a);                                    \
    const auto& check_b = (b);                                    \
    if (!(check_a op check_b))                                    \
      ::gable::checkFailed(__FILE__, __LINE__, #a " " #op " " #b, \
                           ::gable::detail::describe(check_a),    \
                           ::gable::detail::describe(check_b));   \
  } while (false)

#define GABLE_CHECK_EQ(a, b) GABLE_CHECK_OP(a, ==, b)
#define GABLE_CHECK_LT(a, b) GABLE_CHECK_OP(a, <, b)
#define GABLE_CHECK_LE(a, b) GABLE_CHECK_OP(a, <=, b)
#define GABLE_CHECK(condition)                                                           \
  do {                                                                                   \
    if (!(condition)) ::gable::checkFailed(__FILE__, __LINE__, #condition, "false", ""); \
  } while (false)

#if GABLE_DCHECKS
#define GABLE_DCHECK(condition) GABLE_CHECK(condition)
#else
#define GABLE_DCHECK(condition) \
  do {                          \
  } while (false)
#endif
