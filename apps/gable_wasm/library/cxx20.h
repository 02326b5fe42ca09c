// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the engine uses of C++20's library and emscripten's (libc++ 13) does not have, read before
// each of its files (cmake/wasm.cmake): algorithms of ranges, bit_cast, the order of strings, and
// numbers as texts. Only calls that occur in the engine; another one is an error of the compiler.
#pragma once

#include <algorithm>
#include <charconv>
#include <compare>
#include <cstddef>
#include <functional>
#include <iterator>
#include <string>
#include <type_traits>

namespace std {

template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}

template <class C, class T, class A>
strong_ordering operator<=>(const basic_string<C, T, A>& a, const basic_string<C, T, A>& b) {
  const int order = a.compare(b);
  return order < 0   ? strong_ordering::less
         : order > 0 ? strong_ordering::greater
                     : strong_ordering::equal;
}

// The results are those that the standard asks for: the same texts and numbers as everywhere.
to_chars_result to_chars(char* first, char* last, double value);
to_chars_result to_chars(char* first, char* last, float value);
to_chars_result to_chars(char* first, char* last, double value, chars_format format);
to_chars_result to_chars(char* first, char* last, double value, chars_format format, int precision);
from_chars_result from_chars(const char* first, const char* last, double& value);

namespace ranges {

template <class R, class F>
bool all_of(R&& range, F&& f) {
  return std::all_of(std::begin(range), std::end(range), std::forward<F>(f));
}
template <class R, class F>
bool any_of(R&& range, F&& f) {
  return std::any_of(std::begin(range), std::end(range), std::forward<F>(f));
}
template <class R, class F>
bool none_of(R&& range, F&& f) {
  return std::none_of(std::begin(range), std::end(range), std::forward<F>(f));
}
template <class R, class T, class P>
auto find(R&& range, const T& value, P of) {
  return std::find_if(std::begin(range), std::end(range),
                      [&](const auto& each) { return std::invoke(of, each) == value; });
}
template <class A, class B, class F = std::equal_to<>>
bool equal(A&& a, B&& b, F f = {}) {
  return std::equal(std::begin(a), std::end(a), std::begin(b), std::end(b), f);
}
template <class A, class B>
bool lexicographical_compare(A&& a, B&& b) {
  return std::lexicographical_compare(std::begin(a), std::end(a), std::begin(b), std::end(b));
}
template <class R, class T>
auto lower_bound(R&& range, const T& value) {
  return std::lower_bound(std::begin(range), std::end(range), value);
}
template <class R>
void sort(R&& range) {
  std::sort(std::begin(range), std::end(range));
}
template <class R, class P>
void sort(R&& range, less, P of) {
  std::sort(std::begin(range), std::end(range),
            [&](const auto& a, const auto& b) { return of(a) < of(b); });
}
template <class R, class P>
void stable_sort(R&& range, less, P of) {
  std::stable_sort(std::begin(range), std::end(range),
                   [&](const auto& a, const auto& b) { return of(a) < of(b); });
}

}  // namespace ranges
}  // namespace std
